"""Every built-in law of the contact pipeline, named here and imported when somebody chooses it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from lambda_core.plugins import LazyModel, Model, hookimpl

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lambda_core.registry.chart import ViewData
    from lambda_core.registry.method import Method
    from lambda_core.registry.scene import Scene
    from lambda_core.registry.view import Figure, View

# role -> name -> module:attribute; the first of a role is its default.
_LAWS: dict[str, dict[str, str]] = {
    "normal_contact": {
        "hamrock-brewe": "normal_contact:HAMROCK_BREWE",
        "hertz-exact": "normal_contact:HERTZ_EXACT",
    },
    "damping": {"cubic": "damping:CUBIC", "none": "damping:NONE"},
    "rheology": {
        "vogel-dicke": "vogel_dicke:VOGEL_DICKE",
        "bode": "bode:RHEOLOGY",
        "roelands": "generic_oils:ROELANDS",
        "barus-limited": "generic_oils:BARUS_LIMITED",
    },
    "film_thickness": {
        "chittenden": "film_thickness:CHITTENDEN",
        "hamrock-dowson": "film_thickness:HAMROCK_DOWSON",
    },
    "thermal_correction": {
        "murch-wilson": "thermal_correction:MURCH_WILSON",
        "zhu-cheng": "thermal_correction:ZHU_CHENG",
        "none": "thermal_correction:NONE",
    },
    "contact_temperature": {
        "shear-heating": "contact_temperature:SHEAR_HEATING",
        "isothermal": "contact_temperature:ISOTHERMAL",
    },
    "traction": {
        "ree-eyring": "traction:REE_EYRING",
        "bair-winer": "traction:BAIR_WINER",
        "newtonian": "traction:NEWTONIAN",
    },
    "rolling_resistance": {
        "biboulet-houpert": "rolling_resistance:BIBOULET_HOUPERT",
        "goksem-hargreaves": "rolling_resistance:GOKSEM_HARGREAVES",
        "none": "rolling_resistance:NONE",
    },
    "elastic_hysteresis": {
        "loss-factor": "elastic_hysteresis:LOSS_FACTOR",
        "houpert": "elastic_hysteresis:HOUPERT",
        "scheuermann": "elastic_hysteresis:SCHEUERMANN",
        "none": "elastic_hysteresis:NONE",
    },
    "asperity_load": {"zhou-hoeprich": "mixed_friction:ZHOU_HOEPRICH", "none": "mixed_friction:NO_ASPERITIES"},
    "boundary_friction": {
        "cubic": "mixed_friction:CUBIC",
        "coulomb-regularised": "mixed_friction:COULOMB_REGULARISED",
    },
    "cage_contact": {
        "spherical-pocket": "cage_contact:SPHERICAL_POCKET",
        "cylindrical-pocket": "cage_contact:CYLINDRICAL_POCKET",
        "land-guidance": "cage_contact:LAND_GUIDANCE",
        "ball-ball": "cage_contact:BALL_BALL",
        "none": "cage_contact:NONE",
    },
    "fluid_drag": {
        "skf-catalogue": "fluid_drag:SKF_CATALOGUE",
        "schaeffler-catalogue": "fluid_drag:SCHAEFFLER_CATALOGUE",
        "sphere-drag": "sphere_drag:SPHERE_DRAG",
        "none": "fluid_drag:NONE",
    },
    "permittivity": {"bode": "bode:PERMITTIVITY", "constant": "bode:CONSTANT_PERMITTIVITY"},
    "capacitance": {
        "schneider": "capacitance:SCHNEIDER",
        "constant-factor": "capacitance:CONSTANT_FACTOR",
        "gap-integral": "capacitance:GAP_INTEGRAL",
    },
    "surface": {"none": "surface:NONE", "waviness": "surface:WAVINESS", "defect": "surface:DEFECT"},
}


@hookimpl
def lambda_models(register: Callable[[Model | LazyModel], None]) -> None:
    """Name every built-in law."""
    for role, laws in _LAWS.items():
        for name, target in laws.items():
            register(LazyModel(role, name, f"lambda_plugins.{target}"))


@hookimpl
def lambda_methods(register: Callable[[Method], None]) -> None:
    """Register every built-in comparison method."""
    from lambda_plugins.methods import register_methods

    register_methods(register)


@hookimpl
def lambda_views(register: Callable[[View], None]) -> None:
    """Register every built-in view."""
    from lambda_plugins.views import register_views

    register_views(register)


@hookimpl
def lambda_figure(data: ViewData) -> Figure | None:
    """Draw a view with matplotlib."""
    from lambda_plugins.views.drawing import draw

    return draw(data)


@hookimpl
def lambda_frames(scene: Scene) -> Iterator[NDArray[np.uint8]]:
    """Draw the frames of an animation with matplotlib."""
    from lambda_plugins.views.animation import frames

    return frames(scene)

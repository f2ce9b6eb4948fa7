"""List the built-in laws; import each when it is chosen."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from lambda_core.plugins import LazyLaw, hookimpl

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lambda_core.plugins import Figure, Method, Scene, View, ViewData


# role -> name -> module:function; the first of a role is its default.
_LAWS: dict[str, dict[str, str]] = {
    "normal_contact": {
        "hamrock-brewe": "normal_contact:hamrock_brewe",
        "hertz-exact": "normal_contact:hertz_exact",
        "iso-line": "line_contact:iso_line",
        "hertz-line": "line_contact:hertz_line_contact",
    },
    "damping": {
        "cubic": "damping:cubic",
        "hunt-crossley": "damping:hunt_crossley",
        "none": "damping:none",
        "squeeze-film": "damping:squeeze_film",
        "squeeze-line": "line_contact:squeeze_line",
    },
    "rheology": {
        "vogel-dicke": "vogel_dicke:vogel_dicke",
        "bode": "bode:bode_rheology",
        "roelands": "generic_oils:roelands",
        "barus-limited": "generic_oils:barus_limited",
    },
    "film_thickness": {
        "chittenden": "film_thickness:chittenden",
        "hamrock-dowson": "film_thickness:hamrock_dowson",
        "moes-line": "line_contact:moes_line",
        "dowson-toyoda": "line_contact:dowson_toyoda",
    },
    "thermal_correction": {
        "murch-wilson": "thermal_correction:murch_wilson",
        "zhu-cheng": "thermal_correction:zhu_cheng",
        "none": "thermal_correction:none",
    },
    "supply": {
        "skf-replenishment": "supply:skf_replenishment",
        "constant": "supply:constant",
        "inlet-distance": "supply:inlet_distance",
        "oil-layer": "supply_layers:oil_layer",
        "side-flow": "supply_layers:side_flow_layer",
    },
    "contact_temperature": {
        "shear-heating": "contact_temperature:shear_heating",
        "isothermal": "contact_temperature:isothermal",
    },
    "traction": {
        "ree-eyring": "traction:ree_eyring",
        "bair-winer": "traction:bair_winer",
        "newtonian": "traction:newtonian",
    },
    "rolling_resistance": {
        "biboulet-houpert": "rolling_resistance:biboulet_houpert",
        "biboulet-houpert-line": "line_contact:biboulet_houpert_line",
        "biboulet-houpert-point": "rolling_fits:biboulet_houpert_point",
        "goksem-hargreaves": "rolling_resistance:goksem_hargreaves",
        "matsuyama": "rolling_fits:matsuyama",
        "zhou-hoeprich": "rolling_fits:zhou_hoeprich",
        "aihara": "rolling_fits:aihara",
        "matsuyama-line": "line_contact:matsuyama_line",
        "zhou-hoeprich-line": "line_contact:zhou_hoeprich_line",
        "aihara-line": "line_contact:aihara_line",
        "none": "rolling_resistance:none",
    },
    "elastic_hysteresis": {
        "loss-factor": "elastic_hysteresis:loss_factor",
        "houpert": "elastic_hysteresis:houpert",
        "johnson-line": "line_contact:johnson_line",
        "scheuermann": "elastic_hysteresis:scheuermann",
        "none": "elastic_hysteresis:none",
    },
    "asperity_load": {
        "spikes-olver": "mixed_friction:spikes_olver",
        "zhou-hoeprich": "mixed_friction:zhou_hoeprich",
        "none": "mixed_friction:none",
    },
    "boundary_friction": {
        "micro-slip": "mixed_friction:micro_slip",
        "cubic": "mixed_friction:cubic",
        "coulomb-regularised": "mixed_friction:coulomb_regularised",
    },
    "mixing": {"load-share": "mixing:load_share", "contact-area": "mixing:contact_area"},
    "contact_state": {"none": "contact_state:none"},
    "cage_contact": {
        "spherical-pocket": "cage_contact:spherical_pocket",
        "cylindrical-pocket": "cage_contact:cylindrical_pocket",
        "land-guidance": "cage_contact:land_guidance",
        "ball-ball": "cage_contact:ball_ball",
        "roller-pocket": "roller_pocket:roller_pocket",
        "roller-roller": "roller_pocket:roller_roller",
        "none": "cage_contact:none",
    },
    "force_element": {
        "bushing": "force_element:bushing",
    },
    "time_function": {"chirp": "time_function:chirp"},
    "fluid_drag": {
        "skf-catalogue": "fluid_drag:skf_catalogue",
        "schaeffler-catalogue": "fluid_drag:schaeffler_catalogue",
        "skf-rollers": "roller_drag:skf_rollers",
        "sphere-drag": "sphere_drag:sphere_drag",
        "cavity-mixture": "cavity_drag:cavity_mixture",
        "none": "fluid_drag:none",
    },
    "permittivity": {"bode": "bode:bode_permittivity", "constant": "bode:constant"},
    "capacitance": {
        "schneider": "capacitance:schneider",
        "constant-factor": "capacitance:constant_factor",
        "gap-integral": "capacitance:gap_integral",
        "line-gap": "line_contact:line_gap",
    },
    "surface": {"none": "surface:none", "waviness": "surface:waviness", "defect": "surface:defect"},
    "breakdown": {
        "statistical": "breakdown:statistical",
        "field": "breakdown:field",
        "particles": "breakdown:particles",
    },
    "discharge": {"resistance": "discharge:resistance", "arc-voltage": "discharge:arc_voltage"},
}


@hookimpl
def lambda_laws(register: Callable[[LazyLaw], None]) -> None:
    """Name every built-in law."""
    for role, laws in _LAWS.items():
        for name, target in laws.items():
            register(LazyLaw(role, name, f"lambda_plugins.{target}"))


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

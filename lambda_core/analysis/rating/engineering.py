"""Compute life, safety and catalogue friction of an equilibrium."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.rating.compare_methods import comparison_inputs, equilibrium_state
from lambda_core.domain.elements import SPIN
from lambda_core.model.laws.method_inputs import bearing_load
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.settings.contamination import known_contamination
from lambda_core.results.rating import Rating
from lambda_core.results.verdict import limits_of
from lambda_core.solver.arrays.bundle import elements_in
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.roller_reaction import RollerReaction, rollers_between
from lambda_core.views.method import Method, evaluate_methods

if TYPE_CHECKING:
    from lambda_core.elements.roller.roller_bearing import RollerBearing
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.machine_statics import MachineState

# Field of the rating -> method that answers it, group and name of the row.
_ROWS: dict[str, tuple[str, str, str]] = {
    "basic_life_h": ("iso-281", "life", "basic rating life, hours"),
    "reference_life_h": ("iso-ts-16281", "life", "reference rating life, hours"),
    "modified_life_h": ("iso-281", "life", "modified rating life, hours"),
    "modified_reference_life_h": ("iso-ts-16281", "life", "reference modified rating life, hours"),
    "life_factor": ("iso-281", "life", "life modification factor"),
    "equivalent_load_N": ("iso-281", "life", "equivalent load"),
    "static_safety": ("iso-281", "rating", "static safety"),
    "viscosity_ratio": ("iso-281", "life", "viscosity ratio"),
    "skf_torque_Nmm": ("skf", "friction", "total"),
    "skf_torque_without_step_Nmm": ("skf", "friction", "total, continuous"),
    "schaeffler_torque_Nmm": ("schaeffler", "friction", "total"),
}


def rating_of(found: Equilibrium, methods: Mapping[str, Method], loads: tuple[float, float] | None = None) -> Rating:
    """Ask the installed methods about an equilibrium.

    They are the methods of life and catalogue friction.

    Parameters
    ----------
    methods : mapping
        Installed comparison methods by name; numbers of one that is not there are None.
    loads : (float, float), optional
        Sizes of the radial and axial load [N]; default: those of the bearing's case. A bearing of a machine carries
        what the equilibrium of its shaft says.
    """
    if found.context.model.rollers is not None:
        return _of_rollers(found, found.context.model.rollers)
    asked = [methods[name] for name in dict.fromkeys(row[0] for row in _ROWS.values()) if name in methods]
    model = found.context.model
    contamination = known_contamination(model.contamination, model.geometry.pitch_diameter)
    answers = evaluate_methods(
        asked, comparison_inputs(found, contamination=contamination, stiffness=False, loads=loads)
    )
    rows = {
        (answer.method.name, str(row.group), row.name): row.value
        for answer in answers
        if answer.table is not None
        for row in answer.table.rows
        if math.isfinite(row.value)
    }
    notes = [f"{answer.method.title}: {answer.reason}" for answer in answers if answer.reason]
    return Rating(
        **{name: rows.get(key) for name, key in _ROWS.items()},
        contamination=contamination,
        contamination_given=model.contamination is not None,
        limits=limits_of(model),
        notes=notes,
    )


def mounted_rating(model: MachineModel, state: MachineState, number: int, found: Equilibrium) -> Rating:
    """Rate a bearing of a machine.

    The bearing has the loads that it carries on the shaft.

    Parameters
    ----------
    found : Equilibrium
        Of this bearing, with the load of every ball.
    """
    from lambda_core.analysis.rotor.rollers_on_shaft import rollers_on_shaft
    from lambda_core.discovery.api import registry

    ring = state.rings[number]
    if isinstance(ring, RollerReaction):
        return rollers_on_shaft(ring).rating
    x, y, z = state.reactions[number][:3]
    return rating_of(found, registry().methods, (float(np.hypot(y, z)), abs(float(x))))


def _of_rollers(found: Equilibrium, rollers: RollerBearing) -> Rating:
    """Rate rollers as their quasi-static answer does.

    They stand between the rings, at the places that these have in the equilibrium.
    """
    from lambda_core.elements.roller.roller_motion import rolling_motion
    from lambda_core.results.roller_quasistatic import limits_of_rollers, roller_rating

    model, oil = found.context.model, found.context.oil
    radial, axial = bearing_load(model, equilibrium_state(found))
    inner, outer = (initial(body.dofs[SPIN].motion) for body in (model.inner_ring, model.outer_ring))
    azimuth = float(elements_in(found.context.bundle, found.state)["azimuth"][0])
    try:
        state = rollers_between(rollers, rolling_motion(rollers, inner, outer), found.pose, azimuth)
    except (ValueError, ArithmeticError) as error:
        return Rating(limits=limits_of(model), notes=[f"rating lives: {error}"])
    rating = roller_rating(
        rollers, state, (radial, axial), found.relative_speed, oil.viscosity / oil.density, model.contamination
    )
    limits = limits_of_rollers(model, rollers, (radial, axial), found.relative_speed)
    return rating.model_copy(update={"limits": limits})

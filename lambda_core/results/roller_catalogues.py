"""Ask the methods of catalogues about rollers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.views.method import Method, RollerMethodInputs, evaluate_methods

if TYPE_CHECKING:
    from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium
    from lambda_core.elements.roller.roller_friction import RollerFriction
    from lambda_core.model.roller_case import RollerModel

# Field of the rating -> method that states this friction torque.
_TORQUES = {"skf_torque_Nmm": "skf", "schaeffler_torque_Nmm": "schaeffler"}


def roller_inputs(
    model: RollerModel, state: RollerEquilibrium, friction: RollerFriction | None, contamination: float | None = None
) -> RollerMethodInputs:
    """Collect the inputs of comparison methods.

    Parameters
    ----------
    state, friction
        Of its operating point.
    contamination : float, optional
        e_C of ISO 281, which lives need.
    """
    radial, axial = state.carried
    return RollerMethodInputs(
        title=model.title,
        bearing=model.bearing,
        oil=model.oil,
        base_type=model.base_type,
        radial_load=radial,
        axial_load=axial,
        inner_speed=model.speeds[0],
        outer_speed=model.speeds[1],
        lubrication=model.lubrication,
        oil_height=model.friction.oil_height,
        state=state,
        friction=friction,
        contamination=contamination,
    )


def catalogue_torques(inputs: RollerMethodInputs, methods: Mapping[str, Method]) -> dict[str, Any]:
    """Return fields of a rating: torques [N mm] and notes.

    A method that is not installed, or does not answer, has no torque.
    """
    answers = {one: evaluate_methods([methods[one]], inputs)[0] for one in _TORQUES.values() if one in methods}
    totals = {
        name: row.value
        for name, answer in answers.items()
        if answer.table is not None
        for row in answer.table.rows
        if (row.group, row.name) == ("friction", "total")
    }
    notes = [f"{answer.method.title}: {answer.reason}" for answer in answers.values() if answer.reason]
    return {**{field: totals.get(name) for field, name in _TORQUES.items()}, "notes": notes}

"""Apply every comparison method to one case."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from lambda_core.domain.channels import LOSSES
from lambda_core.model.laws.method_inputs import method_inputs, permittivity_over_pressure
from lambda_core.views.method import (
    ContactLoad,
    EquilibriumState,
    MethodInputs,
)

if TYPE_CHECKING:
    from lambda_core.solver.drivers.equilibrium import Equilibrium

Announce = Callable[[str], None] | None


def equilibrium_state(
    equilibrium: Equilibrium, stiffness: tuple[tuple[float, ...], ...] | None = None
) -> EquilibriumState:
    """Hand the quasi-static solution to methods as plain numbers.

    Parameters
    ----------
    stiffness : 5 x 5 tuple of tuples, optional
        d(load)/d(displacement) of the inner ring, order x, y, z, tilt_y, tilt_z [SI].
    """
    from lambda_core.solver.arrays.bundle import elements_in

    arcs, elements = equilibrium.arcs, elements_in(equilibrium.context.bundle, equilibrium.state)
    sides = arcs.shape[1] // 2
    contacts = tuple(
        ContactLoad(
            azimuth=float(elements["azimuth"][ball]),
            load_inner=float(arcs[ball, side, 0]),
            load_outer=float(arcs[ball, sides + side, 0]),
            angle_inner=float(arcs[ball, side, 1]),
            angle_outer=float(arcs[ball, sides + side, 1]),
        )
        for side in range(sides)
        for ball in range(arcs.shape[0])
    )
    speed = equilibrium.relative_speed
    parts = zip(LOSSES, equilibrium.losses, strict=True)
    friction = tuple((name.replace("_", " "), float(power) / speed) for name, power in parts) if speed > 0.0 else ()
    return EquilibriumState(contacts, equilibrium.displacement, stiffness, friction)


def comparison_inputs(
    equilibrium: Equilibrium,
    *,
    contamination: float | None = None,
    stiffness: bool = True,
    loads: tuple[float, float] | None = None,
) -> MethodInputs:
    """Collect the equilibrium's inputs of comparison methods.

    They are loads, stiffness, oil and the permittivity of the inner contact.

    The `stiffness` takes more equilibria, and can be left out; `loads` are the sizes of radial and axial load [N], by
    default those of the bearing's case.
    """
    from lambda_core.model.laws.law_context import build_context, prepare
    from lambda_core.solver.drivers.stiffness import stiffness_matrix

    context = equilibrium.context
    model, oil = context.model, context.oil
    laws = model.laws["ball_inner"]
    inner = build_context(model, "ball_inner", context.frame, oil)
    permittivity, rheology = laws["permittivity"], laws["rheology"]
    found = method_inputs(
        model,
        oil,
        state=equilibrium_state(equilibrium, stiffness_matrix(equilibrium) if stiffness else None),
        permittivity=permittivity_over_pressure(
            permittivity.model,
            prepare(permittivity, inner),
            rheology.model,
            prepare(rheology, inner),
            oil.temperature,
        ),
        contamination=contamination,
    )
    return found if loads is None else replace(found, radial_load=loads[0], axial_load=loads[1])

"""Bring one bearing into equilibrium for comparison methods."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from lambda_core.analysis.thermal.temperatures import ready_machine_of, ready_model, ready_rollers
from lambda_core.case.case_io import is_machine, refuse_bearing
from lambda_core.domain.errors import SolverError
from lambda_core.views.method import MethodInputs, RollerMethodInputs

if TYPE_CHECKING:
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.roller_quasistatic import SolvedRollers
    from lambda_core.solver.drivers.equilibrium import Equilibrium


@dataclass(frozen=True)
class ComparedBearing:
    """One bearing at the start of its case.

    It is alone, or in a machine under the load that it carries there.

    Attributes
    ----------
    bearing : str
        Its name in a machine; empty where it is alone.
    case, title, headline, assumptions
        As in a :class:`~lambda_core.runs.comparison.Comparison`.
    inputs : MethodInputs or RollerMethodInputs
        What methods are asked about.
    contamination : float
        e_C of ISO 281 for modified lives.
    contamination_given : bool
        Whether case or caller gives it.
    """

    bearing: str
    case: str
    title: str
    headline: str
    assumptions: tuple[str, ...]
    inputs: MethodInputs | RollerMethodInputs
    contamination: float
    contamination_given: bool

    @property
    def has_rollers(self) -> bool:
        """Choice of methods: those for rollers, or for balls."""
        return isinstance(self.inputs, RollerMethodInputs)


def compared_bearing(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str],
    bearing: str | None,
    contamination: float | None,
    announce: Callable[[str], None] | None,
) -> ComparedBearing:
    """Return the bearing that a comparison is about.

    The arguments and errors are those of :func:`~lambda_core.runs.compare.compare`.
    """
    from lambda_core.results.roller_quasistatic import solve_rollers

    if is_machine(source):
        return _in_machine(ready_machine_of(source, overrides, announce), bearing, contamination, announce)  # type: ignore[arg-type]
    refuse_bearing(bearing)
    rollers = ready_rollers(source, overrides, announce)
    if rollers is not None:
        return _of_rollers(rollers[0], solve_rollers(rollers[0]), contamination)
    model = ready_model(source, overrides, announce, is_static=True)  # type: ignore[arg-type]
    return _of_balls(model, _solved(model, announce), contamination)


def _in_machine(
    machine: MachineModel, bearing: str | None, contamination: float | None, announce: Callable[[str], None] | None
) -> ComparedBearing:
    """Return one bearing of a machine at its pose there."""
    from lambda_core.analysis.rotor.bearing_alone import alone_under_load, bearing_number
    from lambda_core.analysis.rotor.rollers_on_shaft import rollers_on_shaft
    from lambda_core.solver.drivers.machine_statics import solve_machine
    from lambda_core.solver.drivers.roller_reaction import RollerReaction

    number = bearing_number(machine, bearing)
    state = solve_machine(machine, announce)
    name, ring = machine.bearings[number].name, state.rings[number]
    case = f"{machine.name}, {name}"
    if isinstance(ring, RollerReaction):
        found = rollers_on_shaft(ring)
        one = _of_rollers(replace(found.model, name=case), found.solved, contamination)
    else:
        x, y, z = state.reactions[number][:3]
        model = replace(alone_under_load(machine, state, number), name=case)
        one = _of_balls(model, ring.equilibrium(), contamination, (math.hypot(y, z), abs(float(x))))
    return replace(one, bearing=name)


def _solved(model: BearingModel, announce: Callable[[str], None] | None) -> Equilibrium:
    """Return the equilibrium of a bearing alone.

    Without loads per ball the comparison would be of different cases: then a SolverError.
    """
    from lambda_core.solver.drivers.equilibrium import solve

    try:
        return solve(model, announce=announce)
    except SolverError as error:
        raise SolverError(f"{model.name}: nothing to compare: {error}") from error


def _of_balls(
    model: BearingModel,
    equilibrium: Equilibrium,
    contamination: float | None,
    loads: tuple[float, float] | None = None,
) -> ComparedBearing:
    """Return a bearing with balls.

    `model` describes it; `loads` are those of a machine on it [N].
    """
    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.model.checks.describe import headline

    clean, is_given = _clean(contamination, model.contamination, model.geometry.pitch_diameter)
    return ComparedBearing(
        bearing="",
        case=model.name,
        title=model.title,
        headline="\n".join(headline(model)),
        assumptions=model.assumptions,
        inputs=comparison_inputs(equilibrium, contamination=clean, loads=loads),
        contamination=clean,
        contamination_given=is_given,
    )


def _of_rollers(model: RollerModel, solved: SolvedRollers, contamination: float | None) -> ComparedBearing:
    """Return a bearing with rollers."""
    from lambda_core.results.roller_quasistatic import headline_of

    radial, axial = solved.state.carried
    clean, is_given = _clean(contamination, model.contamination, model.bearing.pitch_diameter)
    inputs = RollerMethodInputs(
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
        state=solved.state,
        friction=solved.friction,
        contamination=clean,
    )
    return ComparedBearing(
        bearing="",
        case=model.name,
        title=model.title,
        headline=headline_of(model, radial, axial),
        assumptions=model.assumptions,
        inputs=inputs,
        contamination=clean,
        contamination_given=is_given,
    )


def _clean(asked: float | None, given: float | None, pitch_diameter: float) -> tuple[float, bool]:
    """Return the decisive e_C and its origin.

    Caller or case gives it: otherwise it is that of normal cleanliness.
    """
    from lambda_core.model.settings.contamination import known_contamination

    known = given if asked is None else asked
    return known_contamination(known, pitch_diameter), known is not None

"""Compare a case or its result with methods."""

from __future__ import annotations

import math
from os import PathLike
from typing import TYPE_CHECKING, Any

from lambda_core.analysis.thermal.temperatures import ready_model, ready_rollers
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.lists import listed
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.runs.comparison import Comparison
    from lambda_core.views.method import Method


@answers
def compare(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    methods: Sequence[str] = (),
    result: str | PathLike[str] | None = None,
    contamination: float | None = None,
    bearing: str | None = None,
    announce: Callable[[str], None] | None = None,
) -> Comparison:
    """Apply every comparison method to one case, at its start.

    Parameters
    ----------
    source, overrides
        As for :func:`check`, or a resolved model.
    methods : sequence of str
        Names of methods; every installed one when empty.
    result : path-like, optional
        Result of the same case, or its file: its simulation becomes the first column.
    contamination : float, optional
        e_C of ISO 281, for modified lives; default: that of the case, or else the lower end of normal cleanliness.
    bearing : str, optional
        Which one of a machine: under the load that it carries there.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Comparison
        One column per method, rows with units; methods that do not apply with the reason.

    Raises
    ------
    UsageError
        For an unknown method, a contamination outside 0 to 1, or a result of another case.
    CaseError, SolverError
        With a sentence about the case, or about why there is no equilibrium.
    """
    from lambda_core.analysis.rating.compare_methods import compare as ask
    from lambda_core.case.case_io import is_machine, refuse_bearing
    from lambda_core.discovery.api import registry
    from lambda_core.results.reader import Result
    from lambda_core.results.roller_quasistatic import solve_rollers
    from lambda_core.runs.compare_rollers import compare_rollers
    from lambda_core.runs.comparison import comparison_of, simulated_by

    if contamination is not None and not 0.0 <= contamination <= 1.0:
        raise UsageError(f"contamination {contamination:g}: e_C lies between 0 and 1")
    known, methods = registry().methods, listed(methods, "methods")
    unknown = next((name for name in methods if name not in known), None)
    if unknown is not None:
        raise UsageError(unknown_name("comparison method", unknown, known))
    every = list(known.values())
    chosen, of_rollers = (
        [known[name] for name in methods] or [one for one in every if one.is_about(rollers=rollers)]
        for rollers in (False, True)
    )
    if is_machine(source):
        if result is not None:
            raise UsageError(
                "a result can only be compared with a case of one bearing: leave the result out for a machine"
            )
        return _compare_in_machine(source, overrides, bearing, (chosen, of_rollers), contamination, announce)
    refuse_bearing(bearing)
    found = ready_rollers(source, overrides, announce)
    simulated = result if result is None or isinstance(result, Result) else Result(result)
    if found is not None:
        rollers, _ = found
        clean = _clean(contamination, rollers.contamination, rollers.bearing.pitch_diameter)
        columns = []
        if simulated is not None:
            columns.append(simulated_by(ready_model(source, overrides, announce, is_static=True), simulated))  # type: ignore[arg-type]
        return compare_rollers(rollers, solve_rollers(rollers), of_rollers, clean, columns)
    model = ready_model(source, overrides, announce, is_static=True)  # type: ignore[arg-type]
    clean = _clean(contamination, model.contamination, model.geometry.pitch_diameter)
    answers = ask(model, chosen, contamination=clean[0], announce=announce)
    return comparison_of(model, answers, clean, simulated)


def _clean(asked: float | None, given: float | None, pitch_diameter: float) -> tuple[float, bool]:
    """Return the decisive e_C and its origin.

    Caller or case gives it: otherwise it is that of normal cleanliness.
    """
    from lambda_core.model.settings.contamination import known_contamination

    known = given if asked is None else asked
    return known_contamination(known, pitch_diameter), known is not None


def _compare_in_machine(
    source: Any, overrides: Iterable[str], bearing: str | None, methods: tuple[Sequence[Method], ...],
    contamination: float | None, announce: Callable[[str], None] | None,
) -> Comparison:  # fmt: skip
    """Compare methods on one bearing of a machine.

    The methods are those for balls and those for rollers, at its pose there.
    """
    import dataclasses

    from lambda_core.analysis.rating.compare_methods import comparison_inputs
    from lambda_core.analysis.rotor.bearing_alone import alone_under_load, bearing_number
    from lambda_core.analysis.rotor.rollers_on_shaft import rollers_on_shaft
    from lambda_core.analysis.thermal.temperatures import ready_machine_of
    from lambda_core.runs.compare_rollers import compare_rollers
    from lambda_core.runs.comparison import comparison_of
    from lambda_core.solver.drivers.machine_statics import solve_machine
    from lambda_core.solver.drivers.roller_reaction import RollerReaction
    from lambda_core.views.method import evaluate_methods

    machine = ready_machine_of(source, overrides, announce)
    number = bearing_number(machine, bearing)
    state = solve_machine(machine, announce)
    mounted = machine.bearings[number].model
    clean = _clean(contamination, mounted.contamination, mounted.geometry.pitch_diameter)
    ring, (for_balls, for_rollers) = state.rings[number], methods
    if isinstance(ring, RollerReaction):
        found = rollers_on_shaft(ring)
        name = f"{machine.name}, {machine.bearings[number].name}"
        return compare_rollers(dataclasses.replace(found.model, name=name), found.solved, for_rollers, clean)
    x, y, z = state.reactions[number][:3]
    loads = (math.hypot(y, z), abs(float(x)))
    inputs = comparison_inputs(ring.equilibrium(), contamination=clean[0], loads=loads)
    alone = alone_under_load(machine, state, number)
    return comparison_of(
        dataclasses.replace(alone, name=f"{machine.name}, {machine.bearings[number].name}"),
        evaluate_methods(for_balls, inputs),
        clean,
    )

"""Compare a case or its result with methods."""

from __future__ import annotations

from os import PathLike
from typing import TYPE_CHECKING

from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.lists import listed
from lambda_core.results.answer import answers

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.runs.comparison import Comparison


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
        Result of the same case, or its file: its simulation becomes the first column, of a machine that of the bearing.
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
    from lambda_core.analysis.thermal.temperatures import ready
    from lambda_core.discovery.api import registry
    from lambda_core.results.reader import Result
    from lambda_core.runs.compared_bearing import compared_bearing
    from lambda_core.runs.comparison import Comparison, compared, simulated_by
    from lambda_core.views.method import evaluate_methods

    if contamination is not None and not 0.0 <= contamination <= 1.0:
        raise UsageError(f"contamination {contamination:g}: e_C lies between 0 and 1")
    known, methods = registry().methods, listed(methods, "methods")
    unknown = next((name for name in methods if name not in known), None)
    if unknown is not None:
        raise UsageError(unknown_name("comparison method", unknown, known))
    one = compared_bearing(source, overrides, bearing, contamination, announce)
    columns = []
    if result is not None:
        run = result if isinstance(result, Result) else Result(result)
        columns = [simulated_by(ready(source, overrides, announce, is_static=True), one.bearing, run)]
    chosen = [known[name] for name in methods] or [
        each for each in known.values() if each.is_about(rollers=one.has_rollers)
    ]
    return Comparison(
        case=one.case,
        title=one.title,
        headline=one.headline,
        methods=[*columns, *map(compared, evaluate_methods(chosen, one.inputs))],
        assumptions=list(one.assumptions),
        contamination=one.contamination,
        contamination_given=one.contamination_given,
    )

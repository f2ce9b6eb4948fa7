"""Leave out operating points without a solution."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

from lambda_core.domain.errors import SolverError
from lambda_core.fitting.problem import CaseProblem, RowsWithoutSolution

_LISTED = 5  # lines that have a sentence of their own
T = TypeVar("T")


def with_solvable_rows(
    problem: CaseProblem, compute: Callable[[CaseProblem], T], least: int, announce: Callable[[str], None] | None = None
) -> tuple[CaseProblem, T, dict[int, str]]:
    """Compute something, without points that have no solution.

    It begins again where a point turns out to have none; what is solved stays known.

    Parameters
    ----------
    compute : callable
        Takes the problem; raises RowsWithoutSolution.
    least : int
        Measured values that must be left.

    Returns
    -------
    tuple of (CaseProblem, T, dict of int to str)
        Problem without those points, result, and why each line was left out.

    Raises
    ------
    SolverError
        When too few values are left.
    """
    reasons: dict[int, str] = {}
    while True:
        try:
            return problem, compute(problem), reasons
        except RowsWithoutSolution as error:
            reasons |= error.reasons
            left = problem.measurements.without(error.rows)
            count = left.count
            if count < least:
                few = f"{count} of at least {least} measured values are left without points that have no solution"
                raise SolverError(f"{error}; {few}") from None
            if announce is not None:
                announce(f"{error}: left out, {count} measured values are left")
            problem = problem.without(error.rows)


def left_out_sentences(name: str, reasons: Mapping[int, str], count: int) -> list[str]:
    """Return a warning for each line that was left out.

    Parameters
    ----------
    name : str
        Of the file.
    reasons : mapping of int to str
        By line.
    count : int
        Measured values that are left.
    """
    lines = sorted(reasons)
    found = [
        f"{name} line {line} has no solution and is left out, {count} measured values are left: {reasons[line]}"
        for line in lines[:_LISTED]
    ]
    rest = lines[_LISTED:]
    return [*found, *([f"so are lines {', '.join(map(str, rest))}"] if rest else [])]

"""Interpolate the points of a table over time.

The module also reports how far the curve goes beyond the range of its points.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.case.signals import Table, TimeTable, summands
from lambda_core.domain.units import show
from lambda_core.model.bearing_model import TableTerm
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

# A spline leaves the points by so much of their range before a warning appears: through a sine of 32 points per
# period, none of them on a crest, it does so by 0.0024, and is right.
_SILENT = 3e-3


def table_term(signal: Table[Any]) -> TableTerm:
    """Return a table of a case as a term."""
    return TableTerm("table", tuple(number for row in signal.rows for number in row), signal.interpolation)


def curve(term: TableTerm) -> PPoly[np.float64]:
    """Return the cubics that join the points of a table.

    Parameters
    ----------
    term : TableTerm
        Times [s] and values in turn, SI.

    Returns
    -------
    scipy.interpolate.PPoly
        Value over time [s], with a continuous first derivative; two points give a straight line.

    Notes
    -----
    ``monotone`` takes the slopes of Fritsch and Butland 1984 (SIAM J. Sci. Stat. Comput. 5, 300) at inner points: the
    weighted harmonic mean of the slopes to both neighbours, 0 where these differ in sign. They are at most three
    times the slope of either chord, under which no cubic leaves the values at its ends (Fritsch and Carlson 1980, SIAM
    J. Numer. Anal. 17, 238). ``spline`` has a continuous second derivative and no such bound. Both begin
    and end with slope 0: the value is held outside, and what a motion moves has no jump in its velocity there.
    """
    from scipy.interpolate import (  # a third of a second to import, and most runs have no table
        CubicHermiteSpline,
        CubicSpline,
        PchipInterpolator,
    )

    times, values = np.array(term.values[0::2]), np.array(term.values[1::2])
    if term.interpolation == "spline" and times.size > 2:
        return CubicSpline(times, values, bc_type="clamped")
    with np.errstate(over="ignore"):  # a harmonic mean with next to nothing is nothing
        monotone = PchipInterpolator(times, values)
    if times.size == 2:
        return monotone
    inner = monotone.c[2, 1:]
    return CubicHermiteSpline(times, values, np.concatenate([[0.0], inner, [0.0]]))


def extremes(term: TableTerm) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return where a table is smallest and largest.

    Parameters
    ----------
    term : TableTerm
        A table.

    Returns
    -------
    tuple of (float, float)
        Time [s] and value of the smallest and of the largest one; those of a spline from the roots of its derivative.
    """
    times, values = np.array(term.values[0::2]), np.array(term.values[1::2])
    if term.interpolation == "spline":
        spline = curve(term)
        turns = spline.derivative().roots(extrapolate=False)
        turns = turns[np.isfinite(turns)]  # not a number where a piece is constant
        times, values = np.concatenate([times, turns]), np.concatenate([values, spline(turns)])
    low, high = int(values.argmin()), int(values.argmax())
    return (float(times[low]), float(values[low])), (float(times[high]), float(values[high]))


def say_overshoot(signals: Iterable[tuple[str, float | TimeTable | None]], ledger: Ledger) -> None:
    """Say where a table's spline leaves its points' range.

    Parameters
    ----------
    signals : iterable of (str, time function)
        Paths in the case, and what stands there.
    ledger : Ledger
        Takes the sentences.
    """
    for path, signal in summands(signals):
        if not isinstance(signal, Table) or signal.interpolation != "spline":
            continue
        values = [value for _, value in signal.rows]
        low, high = min(values), max(values)
        beyond = [
            f"{show(value, signal.quantity, 4)} at {show(time, 'time', 4)}"
            for time, value in extremes(table_term(signal))
            if max(low - value, value - high) > _SILENT * (high - low)
        ]
        if beyond:
            least, most = (show(value, signal.quantity, 4) for value in (low, high))
            ledger.contradict(
                f"{path}: the spline through the points reaches {' and '.join(beyond)}, the points go from {least} to "
                f'{most}: leave out interpolation = "spline" (the default stays between them), or give more points'
            )

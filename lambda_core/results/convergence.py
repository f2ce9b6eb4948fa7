"""Decide when a run is converged.

Each condition that fails has a sentence.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.model.bearing_model import Solver
from lambda_core.results.averages import Estimate, Interval, estimate, torque_by_revolution

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

DISCARDED_AT_LEAST = 1
AVERAGED_AT_LEAST = 4
TORQUE_TOLERANCE = 0.01  # 95 % half-width over the mean
NEGLIGIBLE = 0.1  # of the same of several bearings together: what one may be off by, however little torque it has
ENERGY_TOLERANCE = 1e-3  # |energy residual|


@dataclass(frozen=True)
class Window:
    """The revolutions that the averages are taken over.

    Attributes
    ----------
    interval : Interval
        Whole cage revolutions after the discarded ones; the whole run while there are none.
    torque : Estimate
        Over the revolutions of the window; NaN without any [N m].
    revolutions : int
        Whole cage revolutions in the window.
    discarded : int
        Whole cage revolutions before it.
    """

    interval: Interval
    torque: Estimate
    revolutions: int
    discarded: int


def window(solver: Solver, boundaries: FloatArray, last: FloatArray) -> Window:
    """Choose the averaging window.

    Parameters
    ----------
    solver : Solver
        With the revolutions to discard; a part of a revolution counts as a whole one.
    boundaries : ndarray, shape (n + 1, len(COLUMNS))
        Running integrals at t = 0 and after each of n whole cage revolutions.
    last : ndarray, shape (len(COLUMNS),)
        Running integrals now.
    """
    discard = math.ceil(solver.discard_revolutions)
    kept = boundaries[discard:]
    if kept.shape[0] >= 2:
        torque = estimate(torque_by_revolution(kept))
        return Window(Interval(kept[0], kept[-1]), torque, kept.shape[0] - 1, discard)
    return Window(Interval(boundaries[0], last), Estimate(math.nan, math.nan, 0), 0, 0)


def settings_of(result: Result) -> Solver:
    """Return the solver's options that a result was computed with."""
    return Solver(**{name: float(value) for name, value in result.model["solver"].items()})


def window_of(result: Result) -> Window:
    """Return the revolutions of a result's averages."""
    return window(settings_of(result), result.revolutions(), result.integrals()[-1])


def _allowed(chosen: Window, together: float) -> float:
    """Return the largest allowed half-width [N m].

    It holds for a bearing's torque, in a machine or alone.
    """
    return TORQUE_TOLERANCE * max(abs(chosen.interval.torque()), NEGLIGIBLE * abs(together))


def shortfalls(
    solver: Solver, chosen: Window, residual: float, together: float = 0.0, turns: str = "cage revolutions"
) -> list[str]:
    """Return the unmet conditions of convergence.

    A sentence for each, without that of the end.

    Parameters
    ----------
    solver : Solver
    chosen : Window
    residual : float
        Energy residual [-].
    together : float
        Torque of all bearings of a shaft, of which this is one [N m]: a bearing that hardly bears anything need not be
        known to a hundredth of its own torque where a thousandth of all is more. Contributions to an uncertainty that
        are a tenth of what is asked of the sum change none of its digits (JCGM 100:2008, 5.1.2 and 7.2.6).
    turns : str
        What is averaged over: orbits of the rollers where no cage turns.
    """
    found = []
    if chosen.revolutions and chosen.discarded < DISCARDED_AT_LEAST:
        found.append(f"{chosen.discarded} {turns} were discarded, at least {DISCARDED_AT_LEAST} is needed")
    needed = max(AVERAGED_AT_LEAST, math.ceil(solver.average_revolutions))
    if chosen.revolutions < needed:
        found.append(f"{chosen.revolutions} whole {turns} were averaged, at least {needed} are needed")
    else:
        torque = chosen.torque
        if not torque.half_width <= _allowed(chosen, together):
            share = torque.half_width / abs(chosen.interval.torque())
            wanted = revolutions_wanted(solver, chosen, together)
            do = f"; about {wanted} would do" if wanted > chosen.revolutions + chosen.discarded else ""
            found.append(
                f"the friction torque is known to {_beyond(100 * share, 100 * TORQUE_TOLERANCE)} % (95 % half-width "
                f"over {torque.count} {turns}{do}), at most {100 * TORQUE_TOLERANCE:g} % is allowed"
                + (f", or {100 * NEGLIGIBLE * TORQUE_TOLERANCE:g} % of the torque of all bearings" if together else "")
            )
    if not abs(residual) <= ENERGY_TOLERANCE:
        what = _beyond(residual, ENERGY_TOLERANCE)
        found.append(
            f"the energy residual is {what} of the input, at most {ENERGY_TOLERANCE:g} is allowed: "
            "lower solver.tolerance"
        )
    return found


def _beyond(value: float, limit: float) -> str:
    """Write a value beyond its limit.

    It has enough digits to show this, two at least.
    """
    texts = (f"{value:.{digits}g}" for digits in range(2, 17))
    return next((text for text in texts if abs(float(text)) > limit), f"{value:g}")


def shortfalls_together(windows: Sequence[Window]) -> list[str]:
    """Return the unmet condition of the total torque.

    A sentence where the torque of several bearings together is not known.

    Their half-widths are added up, not their squares: bearings on one shaft swing together, and how much so is not
    known (JCGM 100:2008, 5.2.2, note 1, for inputs that are correlated altogether).
    """
    if len(windows) < 2:
        return []
    width, torque = half_width_together(windows), abs(torque_together(windows))
    if width <= TORQUE_TOLERANCE * torque or not math.isfinite(width):  # who has none says so
        return []
    return [
        f"the friction torque of all bearings is known to {_beyond(100 * width / torque, 100 * TORQUE_TOLERANCE)} % "
        f"(sum of their half-widths), at most {100 * TORQUE_TOLERANCE:g} % is allowed"
    ]


def revolutions_wanted(solver: Solver, chosen: Window, together: float = 0.0) -> int:
    """Return the expected whole cage revolutions.

    They are those of the complete run, as far as is known now.

    The half-width falls with the root of the number of revolutions. `together` is that of :func:`shortfalls`.
    """
    average = max(AVERAGED_AT_LEAST, math.ceil(solver.average_revolutions))
    allowed = _allowed(chosen, together)
    if chosen.revolutions >= average and allowed > 0.0 and math.isfinite(chosen.torque.half_width):
        share = chosen.torque.half_width / allowed
        average = max(average, math.ceil(chosen.revolutions * share * share))
    return max(DISCARDED_AT_LEAST, math.ceil(solver.discard_revolutions)) + average


def torque_together(windows: Sequence[Window]) -> float:
    """Return the torque of several bearings together [N m]."""
    return sum(chosen.interval.torque() for chosen in windows)


def half_width_together(windows: Sequence[Window]) -> float:
    """Return the total torque's half-width [N m].

    It adds up all bearings, as in :func:`shortfalls_together`.
    """
    return sum(chosen.torque.half_width for chosen in windows)


def are_converged(
    solvers: Sequence[Solver],
    windows: Sequence[Window],
    known: Sequence[Sequence[FloatArray]],
    last: Sequence[FloatArray],
) -> bool:
    """Tell whether all bearings are converged.

    They meet the options of a machine, each in its window.
    """
    together = torque_together(windows) if len(windows) > 1 else 0.0
    return not shortfalls_together(windows) and not any(
        shortfalls(solver, chosen, Interval(rows[0], now).energy_residual(), together)
        for solver, chosen, rows, now in zip(solvers, windows, known, last, strict=True)
    )


def are_converged_by(
    solvers: Sequence[Solver], known: Sequence[Sequence[FloatArray]], last: Sequence[FloatArray]
) -> bool:
    """Tell whether all bearings are converged.

    Only the integrals kept and the last ones decide.
    """
    each = zip(solvers, known, last, strict=True)
    windows = [window(solver, np.stack(rows), now) for solver, rows, now in each]
    return are_converged(solvers, windows, known, last)

"""Repeat each coupling step until both sides agree.

``python -m benchmarks.coupling_repeated``: the rotor of ``benchmarks.coupling``.

The host takes the mean of the reactions at both ends of a step, which it knows only after the step: the FMU takes it
back and repeats it. Either the last answer is put in (by itself), or stiffness and damping that the FMU's directional
derivatives give say where both will agree (with slopes). These are slopes with the balls where they stand; in longer
steps balls follow the ring, and two contacts in a row are half as stiff as one (half of them). Needs FMPy.
"""

from __future__ import annotations

import itertools
import math
import sys
import tempfile
from collections.abc import Iterator, Sequence

import numpy as np

from benchmarks.coupling import CASE, COMMON, END, FromUnit, Path, changes, error, inside, load
from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError

STEPS = (480e-6, 320e-6, 160e-6, 80e-6, 40e-6, 20e-6, 8e-6)  # [s]
SHARES = {"by itself": 0.0, "with slopes": 1.0, "with half of them": 0.5}
_MOST = 40  # repetitions
_RUNS_AWAY = 10.0  # a change that has grown by this does not get smaller again
_CLOSE = 1e-6  # change of the acceleration, over the largest one, at which both sides agree


class Repeatable(FromUnit):
    """The bearing of an FMU that takes steps back."""

    def save(self) -> tuple[float, object]:
        """Return the state."""
        return self._time, self._unit.getFMUState()

    def back_to(self, state: tuple[float, object]) -> None:
        """Take back what was done since."""
        self._time = state[0]
        self._unit.setFMUState(state[1])

    def forget(self, state: tuple[float, object]) -> None:
        """Give a state back."""
        self._unit.freeFMUState(state[1])

    def slopes(self, which: int) -> FloatArray:
        """Return the slopes of the ring's force.

        With its place (0) [N/m] or speed (1) [N s/m].
        """
        knowns = self._given[3 * which : 3 * which + 3]
        rows = [self._unit.getDirectionalDerivative(self._answer, [known], [1.0]) for known in knowns]
        return np.array(rows).T


def hosted(step: float, bearing: Repeatable, tolerance: float, share: float) -> tuple[Path, int]:
    """Return the rotor's path and most repetitions.

    The repetitions are those of a step.

    Parameters
    ----------
    share : float
        Of the slopes that the host counts on, 0 to 1.

    Raises
    ------
    SolverError
        When both sides do not come to agree.
    """
    ring = api.check(CASE, changes(tolerance)).inner_ring
    rest = np.array([sum(term.values[0] for term in ring.force[0].terms), 0.0, 0.0])  # the load of the case [N]
    x, v, reaction, a = bearing.begin(), np.zeros(3), -rest, np.zeros(3)
    places, most = [x], 0
    for k in range(round(END / step)):
        begin, largest, by, first = bearing.save(), 0.0, np.eye(3), math.inf
        if share > 0.0:
            answer = 0.5 * step**2 * bearing.slopes(0) + step * bearing.slopes(1)
            by = np.linalg.inv(np.eye(3) - 0.5 * share * answer / ring.mass)
        for count in itertools.count(1):
            bearing.back_to(begin)
            found = bearing.step((k + 1) * step, x, v, a)
            change = by @ ((0.5 * (reaction + found) + rest + load(k * step)) / ring.mass - a)
            a = a + change
            largest = max(largest, float(np.abs(a).max()))
            most = max(most, count)
            if np.abs(change).max() <= _CLOSE * largest:
                break
            first = min(first, _RUNS_AWAY * float(np.abs(change).max()))
            if count > _MOST or np.abs(change).max() > first:
                raise SolverError(f"both sides do not agree in the step from {k * step:.6g} s")
        bearing.forget(begin)
        x, v, reaction = x + step * v + 0.5 * step**2 * a, v + step * a, found
        places.append(x)
    return Path(np.array(places)), most


def study(steps: Sequence[float] = STEPS, tolerance: float = 1e-4) -> Iterator[tuple[str, float, float, int]]:
    """Yield (way, step [s], error, most repetitions).

    Of every step; where both do not agree, infinite.
    """
    reference = inside(COMMON, tolerance)
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-") as folder:
        bearing = Repeatable(tolerance, folder)
        for name, share in SHARES.items():
            for step in steps:
                try:
                    path, most = hosted(step, bearing, tolerance, share)
                except SolverError:
                    yield name, step, math.inf, _MOST
                    continue
                yield name, step, error(path, reference, step, COMMON), most


def main() -> int:
    """Print the study; returns the exit code."""
    print("| repeated | communication step [us] | displacement, off by [%] | repetitions, at most |")
    print("|---|---|---|---|")
    for name, step, off, most in study():
        print(f"| {name} | {1e6 * step:g} | {100.0 * off:.3g} | {most} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Compare stiffness and damping of an FMU with differences.

``python -m benchmarks.unit_slopes``.

All reactions of both rings with all poses and rates and the speed, by the FMU's directional derivatives (one call for
each input), and by a host that sets each input to both sides and reads. Both in turn, the shortest of several,
processor time. Needs FMPy.
"""

from __future__ import annotations

import sys
import tempfile
import time
from typing import Any

import numpy as np

from benchmarks.coupling import FromUnit
from lambda_core.domain.arrays import FloatArray

STEP, STEPS, ROUNDS, REPEATS = 2e-5, 50, 20, 8
_RINGS = ("inner_ring", "outer_ring")
_DOFS = ("x", "y", "z", "tilt_y", "tilt_z")
_BY = {"x": 1e-9, "x_rate": 1e-6, "tilt": 1e-8, "tilt_rate": 1e-5, "spin": 1e-4}


class Asked(FromUnit):
    """Bearing of an FMU asked for slopes."""

    def __init__(self, folder: str) -> None:
        super().__init__(1e-4, folder)
        named: dict[str, int] = self.named
        self._knowns = {
            named[f"{ring}.{dof}{more}"]: _BY[("tilt" if "tilt" in dof else "x") + more]
            for more in ("", "_rate")
            for ring in _RINGS
            for dof in _DOFS
        } | {named["inner_ring.spin"]: _BY["spin"]}
        self._unknowns = [reference for name, reference in named.items() if ".reaction_" in name]

    def moving(self) -> None:
        """Go into the middle of a motion."""
        place = self.begin()
        for k in range(STEPS):
            self.step((k + 1) * STEP, place, np.array([0.0, 0.0, -2e-3]), np.zeros(3))
            place = place + STEP * np.array([0.0, 0.0, -2e-3])

    def touch(self) -> None:
        """Set an input to its value.

        Results are then computed anew.
        """
        (first, *_) = self._knowns
        self._unit.setReal([first], self._unit.getReal([first]))

    def told(self) -> FloatArray:
        """Return the slopes that the FMU gives."""
        self.touch()
        unit: Any = self._unit
        return np.array([unit.getDirectionalDerivative(self._unknowns, [known], [1.0]) for known in self._knowns]).T

    def found(self) -> FloatArray:
        """Return central differences by the host."""
        columns = []
        for known, by in self._knowns.items():
            (value,), seen = self._unit.getReal([known]), []
            for side in (by, -by):
                self._unit.setReal([known], [value + side])
                seen.append(np.array(self._unit.getReal(self._unknowns)))
            self._unit.setReal([known], [value])
            columns.append((seen[0] - seen[1]) / (2.0 * by))
        return np.array(columns).T


def main() -> int:
    """Print cost and difference of both.

    Return the exit code.
    """
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-") as folder:
        bearing = Asked(folder)
        bearing.moving()
        ways, best = {"directional derivatives": bearing.told, "differences by the host": bearing.found}, {}
        for _ in range(REPEATS):
            for name, way in ways.items():
                begin = time.process_time()
                for _ in range(ROUNDS):
                    way()
                best[name] = min(best.get(name, np.inf), (time.process_time() - begin) / ROUNDS)
        told, found = bearing.told(), bearing.found()
    print(f"matrix of {told.shape[0]} reactions with {told.shape[1]} inputs")
    for name, seconds in best.items():
        print(f"{name}: {1e6 * seconds:.0f} us")
    print(f"apart by {np.abs(told - found).max() / np.abs(found).max():.1e} of the largest")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Repeat converged cases with a hundredth of the tolerance.

``python -m benchmarks.false_convergence --count 200``.

Draws operating points as :mod:`benchmarks.static_points` does, runs each until it says "converged", and runs it again
with `solver.tolerance` a hundred times smaller for twice as long. The friction torques agree within the combined 95 %
half-width in at least 91 % of the cases (or within 0.1 %), and none differs by more than three half-widths and 1 %
without a warning. Exit code 1 where that does not hold. A case takes from 10 s to minutes: `--most` limits the wall
time of its first run, and its second may take twenty times as long. A second run that ends earlier is not compared.
"""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.static_points import SEED, Point, points
from lambda_core import api
from lambda_core.domain.errors import LambdaError

_FINER = 100.0
_LONGER = 2.0
_PATIENCE = 20.0  # of the wall time of the second run: up to 5 times the steps per second, twice the time, other work
_NEAR, _FAR = 1e-3, 1e-2  # of the torque
_SHARE = 0.91


@dataclass(frozen=True)
class Pair:
    """Friction torque of one case, coarse and fine [N mm]."""

    coarse: float
    fine: float
    half_width: float  # of both together
    warnings: tuple[str, ...] = ()

    @property
    def agrees(self) -> bool:
        """True if both results agree.

        They are within their half-width, or nearly equal.
        """
        return abs(self.coarse - self.fine) <= max(self.half_width, _NEAR * abs(self.fine))

    @property
    def is_false(self) -> bool:
        """True for a wrong result without warning.

        It reports "converged" and is far off.
        """
        off = abs(self.coarse - self.fine)
        return off > 3.0 * self.half_width and off > _FAR * abs(self.fine) and not self.warnings


def compared(point: Point, folder: Path, most: float) -> Pair | str:
    """Run a point twice.

    Return the reason where the first run has not converged, or the second is not long enough.
    """
    case = api.init_case("point", path=folder / "point.toml", bearing=point.bearing, overwrite=True)
    changes = [*point.changes, f"solver.max_wall={most:g} s"]
    first = api.run(case, changes, out=folder / "coarse.h5", overwrite=True).summary()
    if not first.converged or first.friction_torque_Nmm is None:
        return f"not converged: {'; '.join(first.reasons)}"
    tolerance = api.check(case, point.changes).solver.tolerance / _FINER
    longest = _PATIENCE * most
    finer = [f"solver.tolerance={tolerance:g}", f"solver.duration={1e3 * _LONGER * first.simulated_s:.9g} ms"]
    changes = [*point.changes, *finer, f"solver.max_wall={longest:g} s"]
    second = api.run(case, changes, out=folder / "fine.h5", overwrite=True).summary()
    if second.friction_torque_Nmm is None or second.simulated_s < 0.999 * _LONGER * first.simulated_s:
        return f"second run too short: {second.simulated_s:.3g} s; {'; '.join(second.reasons)}"
    widths = (first.friction_torque_ci_Nmm or 0.0, second.friction_torque_ci_Nmm or 0.0)
    return Pair(first.friction_torque_Nmm, second.friction_torque_Nmm, math.hypot(*widths), tuple(first.warnings))


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare the cases.

    Print a line for each, then the share that agrees.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.false_convergence", description=__doc__)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="points before this one are not run")
    parser.add_argument("--slowest", type=float, default=1.0, help="points of lower speed are not run [1/min]")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--most", type=float, default=600.0, help="wall time of one run [s]")
    options = parser.parse_args(arguments)
    found: list[Pair] = []
    tried = 0
    with TemporaryDirectory() as folder:
        for number, point in enumerate(points(options.count, options.seed)):
            if number < options.first:
                continue
            if float(point.changes[0].split("=")[1].split()[0]) < options.slowest:
                continue
            tried += 1
            told = f"{number}: {point.bearing} {' '.join(point.changes)}"
            try:
                pair = compared(point, Path(folder), options.most)
            except LambdaError as error:
                pair = " ".join(str(error).split())
            if isinstance(pair, str):
                print(f"{told}: {pair}", flush=True)
                continue
            found.append(pair)
            word = "agrees" if pair.agrees else "FALSE" if pair.is_false else "differs"
            numbers = f"{pair.coarse:.5g} and {pair.fine:.5g} ± {pair.half_width:.2g} N mm"
            print(f"{told}: {word}, {numbers}, {len(pair.warnings)} warnings", flush=True)
            if not pair.agrees:
                print("".join(f"    {warning}\n" for warning in pair.warnings), end="", flush=True)
    share = sum(pair.agrees for pair in found) / len(found) if found else math.nan
    false = sum(pair.is_false for pair in found)
    print(f"{len(found)} of {tried} comparable: {100.0 * share:.1f} % agree, {false} far off without a warning")
    return 0 if found and share >= _SHARE and not false else 1


if __name__ == "__main__":
    sys.exit(main())

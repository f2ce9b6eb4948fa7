"""Solve random operating points of the catalogue.

``python -m benchmarks.static_points --count 2000``; ``--rollers`` draws roller bearings.

Draws bearings of all kinds, 1 to 20 000 1/min, oils, 20 to 90 degC, and radial, axial or combined loads from 1 to 25 %
of the basic dynamic rating (self-aligning and double-row bearings included). Every point has a quasi-static solution
with friction, or is refused as a case with the reason. Prints the points without a solution; exit code 1 where one was
not refused.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np

from lambda_core import api
from lambda_core.catalogue.protocol import RollerRow
from lambda_core.domain.errors import CaseError, LambdaError

SEED = 35
_RPM = 30.0 / np.pi
_STEEL = 7800.0  # density [kg/m3]
_FASTEST = 20_000.0  # 1/min
_ROLLER_SPEED = 500.0  # n d_m [m/min] up to which rollers without a limiting speed are drawn
_RIBBED = ("NJ", "NUP", "NCF")  # cylindrical roller bearings that take thrust
_STEEPEST = 0.4  # their thrust over the radial load
# Thrust over F_r tan(alpha) at which half of a tapered bearing's circumference is loaded (Harris and Kotzalas, vol. 1,
# ch. 7: 1.215), and some more: with less the bearing alone opens. Centrifugal force of the rollers counts like F_r.
_HALF_LOADED = 1.3


@dataclass(frozen=True)
class Point:
    """One operating point."""

    bearing: str
    kind: str
    changes: tuple[str, ...]


def points(count: int, seed: int = SEED, *, rollers: bool = False) -> Iterator[Point]:
    """Yield operating points from the catalogue.

    Speeds stay below twice the limiting speed; those of rollers without one below 500 m/min times 1/d_m.
    Rollers get the thrust that their ribs or their angle can carry.
    """
    generator = np.random.default_rng(seed)
    catalogue = api.catalogue()
    rows: list[Any] = list(catalogue.rollers() if rollers else catalogue.bearings("", limit=100_000))
    rows = [row for row in rows if row.dynamic_rating is not None]
    oils = [row.name for row in catalogue.lubricants(limit=10_000)]
    catalogue.close()
    kinds = sorted({row.kind for row in rows})
    by_kind = {kind: [row for row in rows if row.kind == kind] for kind in kinds}
    for _ in range(count):
        kind = kinds[generator.integers(len(kinds))]
        row = by_kind[kind][generator.integers(len(by_kind[kind]))]
        speed = float(np.exp(generator.uniform(0.0, np.log(_fastest(row)))))
        load = float(row.dynamic_rating.value) * float(np.exp(generator.uniform(np.log(0.01), np.log(0.25))))
        angle = {0: 0.0, 1: 0.5 * np.pi, 2: generator.uniform(0.1, 1.4)}[int(generator.integers(3))]
        if rollers:
            angle = _carried(row, angle)
        radial, axial = load * np.cos(angle), load * np.sin(angle)
        if rollers and row.contact_angle is not None:
            axial += _HALF_LOADED * _flung(row, speed) * np.tan(row.contact_angle.value)
        yield Point(
            f"{row.maker} {row.designation}",
            kind,
            (
                f"operation.speed={speed:.6g} rpm",
                f"loads.radial={radial:.6g} N",
                f"loads.axial={axial:.6g} N",
                f"lubricant.name={oils[generator.integers(len(oils))]}",
                f"lubricant.temperature={generator.uniform(20.0, 90.0):.4g} degC",
            ),
        )


def _fastest(row: Any) -> float:
    """Return the highest speed to draw [1/min]."""
    if row.limiting_speed is not None:
        return min(_FASTEST, 2.0 * _RPM * float(row.limiting_speed.value))
    if isinstance(row, RollerRow):
        return min(_FASTEST, _ROLLER_SPEED / float(row.pitch_diameter.value))
    return _FASTEST


def _carried(row: RollerRow, angle: float) -> float:
    """Return the load's angle that a roller bearing can carry."""
    if row.contact_angle is not None:
        return max(angle, float(np.arctan(_HALF_LOADED * np.tan(row.contact_angle.value))))
    return min(angle, float(np.arctan(_STEEPEST))) if row.kind in _RIBBED else 0.0


def _flung(row: RollerRow, speed: float) -> float:
    """Return the centrifugal force of all rollers [N].

    Steel cylinders of the mean diameter; the cage turns with (1 - gamma)/2 of the inner ring's speed [1/min].
    """
    diameter, pitch = float(row.roller_diameter.value), float(row.pitch_diameter.value)
    mass = row.roller_count.value * _STEEL * 0.25 * np.pi * diameter**2 * float(row.roller_length.value)
    cage = 0.5 * (1.0 - diameter / pitch) * speed / _RPM
    return float(mass * 0.5 * pitch * cage**2)


def main(arguments: Sequence[str] | None = None) -> int:
    """Solve the points.

    Print a line for each that is refused or has no solution, then the counts.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.static_points", description=__doc__)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--rollers", action="store_true", help="roller bearings in place of ball bearings")
    options = parser.parse_args(arguments)
    outcomes: Counter[str] = Counter()
    slowest = 0.0
    for number, point in enumerate(points(options.count, options.seed, rollers=options.rollers)):
        begun = time.process_time()
        outcome, sentence = _solved(point)
        spent = time.process_time() - begun
        outcomes[outcome] += 1
        slowest = max(slowest, spent)
        if outcome != "solved":
            changes = " ".join(point.changes)
            print(f"{number}: {point.bearing} ({point.kind}) {changes}: {outcome}, {sentence}", flush=True)
    told = ", ".join(f"{count} {outcome}" for outcome, count in outcomes.items())
    print(f"{options.count} points: {told}; slowest {slowest:.1f} s of processor time")
    return 1 if outcomes["no solution"] else 0


def _solved(point: Point) -> tuple[str, str]:
    """Return the outcome and its sentence.

    "solved", "refused" (an invalid case, with the reason) or "no solution".
    """
    try:
        with TemporaryDirectory() as folder:
            path = api.init_case("point", path=Path(folder) / "point.toml", bearing=point.bearing)
            found: Any = api.quasistatic(path, point.changes)
    except CaseError as error:
        return "refused", str(error)
    except LambdaError as error:
        return "no solution", " ".join(str(error).split())
    return ("solved", "") if found.friction_torque_Nmm is not None else ("no solution", "no friction torque")


if __name__ == "__main__":
    sys.exit(main())

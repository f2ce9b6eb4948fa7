"""Solve random operating points of the catalogue.

``python -m benchmarks.static_points --count 2000``.

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
from lambda_core.domain.errors import CaseError, LambdaError

SEED = 35
_RPM = 30.0 / np.pi


@dataclass(frozen=True)
class Point:
    """One operating point."""

    bearing: str
    kind: str
    changes: tuple[str, ...]


def points(count: int, seed: int = SEED) -> Iterator[Point]:
    """Yield operating points from the catalogue.

    Speeds stay below twice the limiting speed.
    """
    generator = np.random.default_rng(seed)
    catalogue = api.catalogue()
    rows = [row for row in catalogue.bearings("", limit=100_000) if row.dynamic_rating is not None]
    oils = [row.name for row in catalogue.lubricants(limit=10_000)]
    catalogue.close()
    kinds = sorted({row.kind for row in rows})
    by_kind = {kind: [row for row in rows if row.kind == kind] for kind in kinds}
    for _ in range(count):
        kind = kinds[generator.integers(len(kinds))]
        row = by_kind[kind][generator.integers(len(by_kind[kind]))]
        fastest = 20_000.0
        if row.limiting_speed is not None:
            fastest = min(fastest, 2.0 * _RPM * float(row.limiting_speed.value))
        speed = float(np.exp(generator.uniform(0.0, np.log(fastest))))
        load = float(row.dynamic_rating.value) * float(np.exp(generator.uniform(np.log(0.01), np.log(0.25))))
        angle = {0: 0.0, 1: 0.5 * np.pi, 2: generator.uniform(0.1, 1.4)}[int(generator.integers(3))]
        yield Point(
            f"{row.maker} {row.designation}",
            kind,
            (
                f"operation.speed={speed:.6g} rpm",
                f"loads.radial={load * np.cos(angle):.6g} N",
                f"loads.axial={load * np.sin(angle):.6g} N",
                f"lubricant.name={oils[generator.integers(len(oils))]}",
                f"lubricant.temperature={generator.uniform(20.0, 90.0):.4g} degC",
            ),
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Solve the points.

    Print a line for each that is refused or has no solution, then the counts.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.static_points", description=__doc__)
    parser.add_argument("--count", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=SEED)
    options = parser.parse_args(arguments)
    outcomes: Counter[str] = Counter()
    slowest = 0.0
    for number, point in enumerate(points(options.count, options.seed)):
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

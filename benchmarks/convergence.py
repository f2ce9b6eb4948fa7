"""Measure how power converges with grid and tolerance.

``python -m benchmarks.convergence``.

Grid: every point is brought to its quasi-static equilibrium again; the tangential forces at a frozen state would say
nothing. Tolerance: the same stretch of time of the same bearing without a cage, whose motion would be chaotic.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import solve

PAGE = Path(__file__).parent.parent / "docs" / "convergence.md"
CASES = ("6319-cp10-500", "6319-cp10-3000", "6208-axial-1300")
GRIDS = ((7, 1), (15, 1), (31, 1), (61, 1), (31, 3), (21, 11), (41, 21))  # strips, rows
FINEST = (101, 51)
TOLERANCES = (1e-2, 3e-3, 1e-3, 1e-4, 1e-5)
TIGHTEST = 1e-6
SETTLED, SPAN = 0.02, 0.06  # [s] left out at the start; averaged
DEFAULT_GRID, DEFAULT_TOLERANCE = (31, 1), 1e-3


def grid_power(case: str, strips: int, rows: int) -> float:
    """Return the power that the raceways dissipate in equilibrium [W]."""
    found = solve(api.check(case, (f"depth.strips={strips}", f"depth.rows={rows}")))
    return float(found.losses[: LOSSES.index("damping_inner")].sum())


@dataclass(frozen=True)
class Stretch:
    """Results of an integration's stretch of time."""

    power: float  # dissipated by everything, mean [W]
    residual: float  # of the energy, from the start, over the input
    steps: int
    newton_iterations: int


def tolerance_power(case: str, tolerance: float, settled: float = SETTLED, span: float = SPAN) -> Stretch:
    """Integrate without a cage to a tolerance."""
    engine = BearingEngine(api.check(case, ("depth.cage=false", f"solver.tolerance={tolerance!r}")))
    lost: list[tuple[float, float]] = []
    for until in (settled, settled + span):
        done = engine.advance(until)
        if not done.ok:
            raise RuntimeError(f"{case} at tolerance {tolerance:g}: {done.message}")
        integrals = engine.integrals()
        lost.append((engine.time, sum(integrals[f"loss.{name}"] for name in LOSSES)))
    (begin, before), (end, after) = lost
    missing = integrals["input"] - after - integrals["stored"]
    counts = engine.statistics()
    return Stretch(
        (after - before) / (end - begin),
        missing / integrals["input_abs"],
        int(counts["steps"]),
        int(counts["newton_iterations"]),
    )


def _percent(value: float, exact: float) -> str:
    return f"{100.0 * (value / exact - 1.0):+.3f} %"


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    lines = [f"| {' | '.join(head)} |", f"|{'---|' * len(head)}"]
    return [*lines, *(f"| {' | '.join(row)} |" for row in rows)]


def _marked(text: str, default: bool) -> str:
    return f"**{text}** (default)" if default else text


def grid_table() -> list[str]:
    """Return the lines of the table of grids."""
    exact = {case: grid_power(case, *FINEST) for case in CASES}
    rows = []
    for strips, count in GRIDS:
        deviations = [_percent(grid_power(case, strips, count), exact[case]) for case in CASES]
        rows.append([_marked(f"{count} x {strips}", (strips, count) == DEFAULT_GRID), *deviations])
    reference = [f"{FINEST[1]} x {FINEST[0]}", *(f"{exact[case]:.4f} W" for case in CASES)]
    return _table(("rows x strips", *CASES), [*rows, reference])


def tolerance_table() -> list[str]:
    """Return the lines of the table of tolerances."""
    lines: list[str] = []
    for case in ("6319-cp10-3000", "6208-axial-1300"):
        exact = tolerance_power(case, TIGHTEST)
        rows = []
        for tolerance in TOLERANCES:
            found = tolerance_power(case, tolerance)
            rows.append(
                [
                    _marked(f"{tolerance:g}", tolerance == DEFAULT_TOLERANCE),
                    _percent(found.power, exact.power),
                    f"{found.residual:.1e}",
                    str(found.steps),
                    str(found.newton_iterations),
                ]
            )
        counts = (str(exact.steps), str(exact.newton_iterations))
        rows.append([f"{TIGHTEST:g}", f"{exact.power:.4f} W", f"{exact.residual:.1e}", *counts])
        head = ("tolerance", "dissipated power", "energy residual", "steps", "Newton iterations")
        lines += [f"### {case}", "", *_table(head, rows), ""]
    return lines


def page() -> str:
    """Measure and return the page."""
    text = [
        "# Convergence of grid and tolerance",
        "",
        "This page compares the dissipated power with that of a much finer computation, for readers who choose a grid",
        "or a tolerance. Written by `python -m benchmarks.convergence --write`; counts and deviations, no timings.",
        "",
        "## Grid",
        "",
        "Power dissipated in the raceways, each grid in its own quasi-static equilibrium: the forces at a frozen state",
        "are small differences of large stresses and tell nothing.",
        "",
        *grid_table(),
        "",
        "## Tolerance",
        "",
        f"Mean dissipated power from {SETTLED * 1e3:g} ms to {(SETTLED + SPAN) * 1e3:g} ms, without a cage, whose",
        "motion is chaotic and would hide the error of the integration behind its own scatter. The energy residual is",
        "counted from the start.",
        "",
        *tolerance_table(),
    ]
    return "\n".join(text).rstrip() + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the page, or write it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.convergence", description=__doc__)
    parser.add_argument("--write", action="store_true", help="write docs/convergence.md")
    if parser.parse_args(arguments).write:
        PAGE.write_text(page())
    else:
        print(page(), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())

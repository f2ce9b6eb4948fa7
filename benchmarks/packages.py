"""Measure the cost of the example packages.

``python -m benchmarks.packages``: wall time per simulated second over the same case.

Runs without and with each package take turns, and of each the fastest counts.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from lambda_core import api
from lambda_core.results.summary import Summary

EXAMPLES = Path(__file__).parents[1] / "examples"
BEARING = "6208-axial-1300"
_LINK = ("elements.own.first=outer_ring", "elements.own.second=inner_ring")
# package -> (what it is, changes of the case, most that it may cost)
PACKAGES: dict[str, tuple[str, tuple[str, ...], float]] = {
    "sliding-wear": ("observer", ("observers.sliding-wear.coefficient=1e-8",), 1.15),
    "cage-whirl": ("event", ("events.cage-whirl.action=record",), 1.15),
    "magnetic-pull": ("force element", (*_LINK, "elements.own.law=magnetic-pull"), 1.3),
    "spring-damper": ("force element", (*_LINK, "elements.own.law=spring-damper"), 1.3),
    "warm-contact": ("state", ("models.contact_state=warm", "models.traction=warm-eyring"), 1.3),
}


def run(changes: Sequence[str], seconds: float, folder: Path) -> Summary:
    """Return the summary of one run."""
    overrides = [*changes, f"solver.duration={seconds} s"]
    return api.run(BEARING, overrides, out=folder / "run.h5", overwrite=True).summary()


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a line for each package.

    Return 1 when one costs more than it may, or an energy balance does not close.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.packages", description=__doc__)
    parser.add_argument("--repeats", type=int, default=6, help="runs of each kind")
    parser.add_argument("--duration", type=float, default=0.1, help="simulated time of a run [s]")
    options = parser.parse_args(arguments)
    kinds = {"": (), **{name: changes for name, (_, changes, _) in PACKAGES.items()}}
    fastest, residuals = dict.fromkeys(kinds, float("inf")), dict.fromkeys(kinds, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        for name in PACKAGES:
            module = name.replace("-", "_")
            api.use_plugin(shutil.copy(EXAMPLES / name / module / "__init__.py", Path(folder) / f"{module}.py"))
        for _ in range(options.repeats):
            for name, changes in kinds.items():
                found = run(changes, options.duration, Path(folder))
                fastest[name] = min(fastest[name], found.wall_per_simulated_second)
                residuals[name] = abs(found.energy_residual or 0.0)
    print(f"{BEARING}: {fastest['']:.2f} s per simulated second, energy residual {residuals['']:.1e}")
    missed = False
    for name, (what, _, most) in PACKAGES.items():
        ratio = fastest[name] / fastest[""]
        missed |= ratio > most or residuals[name] > 1e-3
        print(f"  {name:14} {what:14} {ratio:.2f} of the time (at most {most}), residual {residuals[name]:.1e}")
    return int(missed)


if __name__ == "__main__":
    raise SystemExit(main())

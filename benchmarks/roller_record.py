"""Run the roller bearings of the record.

``python -m benchmarks.roller_record [ROW ...]``; without a row all of them, which takes an hour of processor time.

Prints a row of docs/roller-record.md for each: torque and power loss of the run with the 95 % half-width, the same at
the operating point and by SKF's model, cage slip against rollers that roll, energy residual.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from lambda_core import api
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.results.summary import Summary

_DRY = "models.fluid_drag=none"
_LONG = "solver.max_duration=3.5 s"  # 90 turns of the rollers round the bearing; 30 are the default
_CAGED = ("bearing.rollers.kind=NJ", "bearing.rollers.roller_count=18", "depth.cage=true")


@dataclass(frozen=True)
class Row:
    """One run of a bearing."""

    designation: str
    radial: str
    speed: str
    temperature: str = "70 degC"
    changes: tuple[str, ...] = ()

    def case(self) -> dict[str, Any]:
        """Return the case."""
        return {
            "name": self.designation.lower().replace(" ", "-"),
            "bearing": {"designation": f"SKF {self.designation}"},
            "lubricant": {"name": "FVA3", "temperature": self.temperature},
            "loads": {"radial": self.radial},
            "operation": {"speed": self.speed},
        }


ROWS = {
    "power-loss": Row("NU 208", "5 kN", "3000 rpm", "60 degC"),
    **{f"light-{load}": Row("NU 208", f"{load} N", "9000 rpm") for load in (1000, 300, 100, 50)},
    **{f"dry-{load}": Row("NU 208", f"{load} N", "9000 rpm", changes=(_DRY,)) for load in (1000, 300, 100, 50)},
    "caged-18": Row("NCF 3008 CV", "5 kN", "1000 rpm", changes=(_DRY, *_CAGED)),
    "full-23": Row("NCF 3008 CV", "5 kN", "1000 rpm", changes=(_DRY,)),
    "needle": Row("NA 4905", "2 kN", "1000 rpm", changes=(_DRY,)),
    "needle-full": Row("NA 4905", "2 kN", "1000 rpm", changes=(_DRY, "depth.cage=false", _LONG)),
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the rows and print them.

    0, 1 where one did not converge, 2 for a wrong name.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.roller_record", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="ROW", help=f"default all: {', '.join(ROWS)}")
    names = parser.parse_args(arguments).names or list(ROWS)
    for name in names:
        if name not in ROWS:
            print(UsageError(unknown_name("row", name, ROWS)), file=sys.stderr)
            return 2
    print("| row | run N mm | operating point | SKF | power loss W | cage slip | energy residual | CPU s |")
    print("|---|---|---|---|---|---|---|---|")
    converged = [_shown(name, ROWS[name]) for name in names]
    return 0 if all(converged) else 1


def _shown(name: str, row: Row) -> bool:
    """Print a row; tell whether its torque converged."""
    begun = time.process_time()
    with TemporaryDirectory() as folder:
        found = api.run(row.case(), row.changes, out=Path(folder) / "rollers.h5").summary()
    spent = time.process_time() - begun
    still = api.quasistatic(row.case(), row.changes)
    skf = api.compare(row.case(), row.changes, methods=["skf"]).value("skf", "friction", "total")
    assert found.cage_speed_ratio is not None
    assert found.epicyclic_ratio is not None
    slip = 1.0 - found.cage_speed_ratio / found.epicyclic_ratio
    cells = (
        _with_half_width(found),
        f"{still.friction_torque_Nmm:.1f}",
        "-" if skf is None else f"{skf:.1f}",
        f"{found.power_loss_W:.2f}",
        f"{100.0 * slip:.2f} %",
        f"{found.energy_residual:.1e}",
        f"{spent:.0f}",
    )
    print(f"| {name} | {' | '.join(cells)} |", flush=True)
    for reason in found.reasons:
        print(f"{name}: {reason}", file=sys.stderr)
    return bool(found.converged)


def _with_half_width(found: Summary) -> str:
    """Return the torque with its half-width."""
    half = found.friction_torque_ci_Nmm
    return f"{found.friction_torque_Nmm:.1f}" + ("" if half is None else f" +- {half:.1f}")


if __name__ == "__main__":
    sys.exit(main())

"""Run hard regimes; check events and energy balance.

``python -m benchmarks.regimes [--write]`` runs all of them and prints or writes the page; tests/solver/test_regimes.py
runs the same table.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.regime_list import RADIAL, REFUSED, REGIMES, Regime, Samples
from benchmarks.roller_regimes import ROLLER_REGIMES
from lambda_core import api
from lambda_core.domain.channels import LOSSES
from lambda_core.domain.errors import LambdaError
from lambda_core.solver.drivers.dynamics import BearingEngine

PAGE = Path(__file__).parents[1] / "docs" / "regimes.md"
BOUND = 1e-3  # of the energy that flowed
FINE = "solver.tolerance=1e-4"


@dataclass(frozen=True)
class Outcome:
    """Outcome of a regime."""

    reached: bool
    message: str  # of the engine, when it could not go on
    samples: Samples
    residual: float  # over the energy that flowed: the larger of external work (absolute) and dissipation
    least_loss: float  # smallest dissipation of any mechanism [J]
    steps: int
    quasistatic: bool  # whether friction was in equilibrium at the start
    wall: float  # [s]


def run(regime: Regime, *options: str) -> Outcome:
    """Simulate a regime.

    With more options set; take its energy balance.
    """
    engine = BearingEngine(regime.model(*options))
    began = time.perf_counter()
    done = engine.advance(regime.duration)
    wall = time.perf_counter() - began
    found = engine.integrals()
    lost = {name: found[f"loss.{name}"] for name in LOSSES} | {"dampers to the ground": found["support"]}
    missing = found["input"] - sum(lost.values()) - found["stored"]
    flow = max(found["input_abs"], sum(lost.values()))
    steps = int(engine.statistics()["steps"])
    quasistatic = bool(engine.equilibrium()["converged"])
    return Outcome(
        done.ok, done.message, engine.samples(), missing / flow, min(lost.values()), steps, quasistatic, wall
    )


def refusal(changes: Sequence[str]) -> str:
    """Return the message of a refused case.

    "" when it can be simulated.
    """
    try:
        BearingEngine(api.check(RADIAL, changes))
    except LambdaError as error:
        return str(error)
    return ""


_TEXT = """# Standstill, overspeed and shocks

This page lists hard regimes that the dynamics pass, for readers whose case stops, reverses or is shaken. The energy
balance is input minus dissipation minus the change of kinetic and elastic energy, over the energy that flowed (the
larger of the external work, counted positive, and the dissipation). Every row is a test
(`tests/solver/test_regimes.py`): the run reaches its end, the event in the name of the row happens, no mechanism gains
energy, the balance closes within 1e-3. Written by
`python -m benchmarks.regimes --write`.

All at the default tolerance of 1e-3; the last column is the balance at a tenth of it. Work and losses are integrated by
the same formula as the motion, with the powers that each step's own equations transfer. In each step the dissipation of
the scheme and the remainder of its Newton iteration are each kept within 0.4 tolerances of the energy that flows
([theory](theory/dynamics.md#energy-balance)).

"""
_REFUSALS = """
## What is refused

Some regimes have no answer. The program says so before it integrates:

"""


def _size(value: float) -> str:
    return f"{abs(value):.0e}"


def page() -> str:
    """Run everything and return the page."""
    lines = [
        "| regime | simulated | steps | balance | at 1e-4 |",
        "|---|---|---|---|---|",
    ]
    for regime in (*REGIMES, *ROLLER_REGIMES):
        found, fine = run(regime), run(regime, FINE)
        assert found.reached
        assert regime.seen(found.samples)
        lines.append(
            f"| {regime.name} | {1e3 * regime.duration:g} ms | {found.steps} | {_size(found.residual)} | "
            f"{_size(fine.residual)} |"
        )
    refused = ["| case | message |", "|---|---|"]
    for name, (changes, words) in REFUSED.items():
        said = next(line for line in refusal(changes).splitlines() if words in line)
        refused.append(f"| {name} | {' '.join(said.split())} |")
    return _TEXT + "\n".join(lines) + "\n" + _REFUSALS + "\n".join(refused) + "\n"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the page, or write it."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.regimes", description=__doc__)
    parser.add_argument("--write", action="store_true", help=f"write {PAGE.name}")
    wanted = parser.parse_args(arguments)
    text = page()
    if wanted.write:
        PAGE.write_text(text, encoding="utf-8")
    else:
        print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Compare this version with another one in turn.

The ratios of times also hold on a machine that others use.

Both run with the laws and constants named that b7aec9b had by default (:mod:`benchmarks.endstates`), so that later
defaults do not count as a difference. Counts of evaluations depend on no clock at all.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

from benchmarks.endstates import constants
from benchmarks.tables import Cell, Section, Table
from benchmarks.timing import Effort
from lambda_core.domain.errors import UsageError

WORKER = Path(__file__).parent / "against_worker.py"
# Case, what is changed in it, simulated time of the short and of the long comparison [s].
POINTS: dict[str, tuple[str, dict[str, Any], float, float]] = {
    "6319, 3000 1/min": ("6319-cp10-3000", {}, 0.05, 0.2),
    "6319, 500 1/min": ("6319-cp10-500", {}, 0.1, 0.4),
    "6319, 10 1/min": ("6319-cp10-500", {"operation": {"speed": "10 rpm"}}, 0.1, 1.0),
    "6208 axial, 2750 1/min": ("6208-axial-1300", {}, 0.04, 0.15),
    "6220 excited, 1500 1/min": ("6220-excited", {}, 0.02, 0.08),
}
COLUMNS = (
    "point", "s per simulated s", "there", "times as fast", "evaluations/s", "there", "times fewer",
    "energy residual", "there", "loss, difference %",
)  # fmt: skip
Answer = dict[str, Any]


def interpreter(environment: Path) -> Path:
    """Return the interpreter of an environment.

    Raises
    ------
    UsageError
        When there is none.
    """
    for place in (environment, environment / ".venv"):
        for name in ("bin/python", "Scripts/python.exe"):
            if (place / name).exists():
                return place / name
    raise UsageError(f"--against: there is no Python in {environment} (bin/python, .venv/bin/python)")


def own_laws(overrides: dict[str, Any], newer: bool) -> dict[str, Any]:
    """Return changes with commonly known laws.

    They are changes of a case; both versions know the laws.
    """
    changed = constants(newer)
    for section, values in overrides.items():
        changed[section] = {**changed.get(section, {}), **values}
    return changed


class Version:
    """Integrating process of one version."""

    def __init__(self, python: Path | str) -> None:
        clean = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        self._process = subprocess.Popen(
            [str(python), "-P", str(WORKER)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=clean
        )
        self._newer = True

    def ask(self, case: str, overrides: dict[str, Any], duration: float) -> Answer:
        """Return the cost of one integration.

        A version that lacks later options is asked without them.
        """
        found = self._answer(case, overrides, duration)
        if "error" in found and self._newer:
            self._newer = False
            again = self._answer(case, overrides, duration)
            self._newer = "error" in again
            return found if self._newer else again
        return found

    def _answer(self, case: str, overrides: dict[str, Any], duration: float) -> Answer:
        question = {"case": case, "overrides": own_laws(overrides, self._newer), "duration": duration}
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps(question) + "\n")
            self._process.stdin.flush()
            line = self._process.stdout.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            raise RuntimeError("--against: the other version ended; start its interpreter by hand to see why")
        answer: Answer = json.loads(line)
        return answer

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._process.stdin is not None:
            self._process.stdin.close()
        self._process.wait()


@dataclass
class Pair:
    """Results of one point.

    The fastest repeat of each version, and why a version has none.
    """

    name: str
    mine: Answer = field(default_factory=dict)
    theirs: Answer = field(default_factory=dict)

    def keep(self, mine: Answer, theirs: Answer) -> None:
        """Keep the shorter times."""
        self.mine, self.theirs = _faster(self.mine, mine), _faster(self.theirs, theirs)

    def row(self) -> tuple[Cell, ...]:
        """Return the cells of COLUMNS."""
        one, other = self.mine, self.theirs

        def of(name: str, combine: Callable[[float, float], float]) -> float | None:
            return combine(one[name], other[name]) if name in one and name in other else None

        return (
            self.name, one.get("seconds"), other.get("seconds"), of("seconds", lambda a, b: b / a),
            one.get("evaluations"), other.get("evaluations"), of("evaluations", lambda a, b: b / a),
            one.get("residual"), other.get("residual"), of("loss", lambda a, b: 100.0 * (a / b - 1.0)),
        )  # fmt: skip


def _faster(before: Answer, now: Answer) -> Answer:
    return before if before.get("seconds", float("inf")) <= now.get("seconds", float("inf")) and before else now


def measure(environment: Path, effort: Effort) -> Section:
    """Integrate every point with both versions in turn, several times."""
    python = interpreter(environment)
    pairs = [Pair(name) for name in POINTS]
    with Version(sys.executable) as mine, Version(python) as theirs:
        for _ in range(effort.repeats):
            for pair, (case, overrides, short, long) in zip(pairs, POINTS.values(), strict=True):
                duration = effort.pick(0, 1) * (long - short) + short
                pair.keep(mine.ask(case, overrides, duration), theirs.ask(case, overrides, duration))
    failed = [
        f"{pair.name}, {who}: {found['error']}"
        for pair in pairs
        for who, found in (("this version", pair.mine), ("the other", pair.theirs))
        if "error" in found
    ]
    table = Table(
        f"This version and the one in {environment}",
        COLUMNS,
        tuple(pair.row() for pair in pairs),
        (
            "Processor time of the integration alone, the fastest of several repeats taken in turn, from the "
            "quasi-static equilibrium, with the laws named that both know. Evaluations depend on no clock.",
            *failed,
        ),
    )
    return Section("against", (table,), failed=any("this version" in text for text in failed))

"""Time cold and warm starts of all commands."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks.cases import DEFAULT
from benchmarks.commands import measure_commands
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort


@dataclass(frozen=True)
class Start:
    """Messages of a run over time.

    [s after the start of the process].
    """

    compiling: float  # seconds between the first word of compiling and the equilibrium; 0 without
    integrating: float  # the equilibrium is found, the first step begins
    total: float


def start(cache: Path | None, changes: Sequence[str] = ()) -> Start:
    """Run a millisecond in a new process.

    The default case, with compiled code in `cache` (None: the user's).
    """
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "lambda_cli", "run", DEFAULT, "--duration", "1 ms", "--progress", "plain"]
        command += ["--json", "--out", f"{folder}/start.h5"]
        for change in changes:
            command += ["--set", change]
        began = time.perf_counter()
        process = subprocess.Popen(
            command, env=_environment(cache), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
        )
        assert process.stderr is not None
        compiling = integrating = 0.0
        said = []
        for line in process.stderr:
            now = time.perf_counter() - began
            said.append(line)
            if line.startswith("compiling") and not compiling:
                compiling = now
            if line.startswith("equilibrium"):
                integrating = now
        code = process.wait()
        total = time.perf_counter() - began
    if code not in (0, 5) or not integrating:  # a millisecond is no converged run
        raise RuntimeError(f"exit {code}: {''.join(said)[-2000:]}")
    return Start(integrating - compiling if compiling else 0.0, integrating, total)


def help_seconds(repeats: int) -> float:
    """Return the time of ``lambda-bearing --help`` [s]."""
    found = []
    for _ in range(repeats):
        began = time.perf_counter()
        subprocess.run([sys.executable, "-m", "lambda_cli", "--help"], check=True, stdout=subprocess.DEVNULL)
        found.append(time.perf_counter() - began)
    return min(found)


def _environment(cache: Path | None) -> dict[str, str]:
    if cache is None:
        return dict(os.environ)
    return {**os.environ, "LAMBDA_BEARING_CACHE": str(cache), "LAMBDA_BEARING_DATA": str(cache / "data")}


def measure(effort: Effort) -> Section:
    """Time cold and warm starts.

    Cold not with --quick, also with another law: then hold every command against its budget.
    """
    rows: list[tuple[Cell, ...]] = [("--help", None, None, help_seconds(effort.repeats))]
    targets: list[Target] = []
    with tempfile.TemporaryDirectory() as folder:
        cache = None if effort.quick else Path(folder)
        first = start(cache)  # with --quick only what makes the next one warm
        if not effort.quick:
            rows.append(("cold: nothing on disk", first.compiling, first.integrating, first.total))
            targets.append(Target("cold start, compilation", "s", first.compiling, None, 15.0))
        warm = min((start(cache) for _ in range(effort.repeats)), key=lambda s: s.integrating)
        rows.append(("warm", warm.compiling, warm.integrating, warm.total))
        targets.append(Target("warm run, from the command to the first step", "s", warm.integrating, 1.5))
        if not effort.quick:
            other = start(cache, ("models.traction=bair-winer",))
            rows.append(("warm, a law for the first time", other.compiling, other.integrating, other.total))
            targets.append(
                Target("another law, more than a warm start", "s", other.integrating - warm.integrating, 1.0)
            )
        commands, budgets = measure_commands(_environment(cache), max(effort.repeats, 3))
    table = Table(
        f"Start of lambda-bearing run {DEFAULT}",
        ("start", "compiling s", "first step after s", "1 ms simulated after s"),
        tuple(rows),
        ("New processes, wall time. Cold includes building the catalogue; parts are compiled in parallel.",),
    )
    return Section("startup", (table, commands), (*targets, *budgets))

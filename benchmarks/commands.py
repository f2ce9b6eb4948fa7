"""What a warm command costs before and beside its work: processor time of the process, imports, against budgets."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from benchmarks.cases import DEFAULT
from benchmarks.tables import Table, Target

_PAINT = """
import os, sys
from lambda_gui.app import BuilderApp
class Painted(BuilderApp):
    async def _leave(self):
        sys.stdout.flush()
        os._exit(0)
    def on_ready(self):
        self.run_worker(self._leave())
Painted("6208-axial-1300").run(headless=True, size=(80, 24))
"""


@dataclass(frozen=True)
class Budget:
    """What a command may take, warm: code compiled, catalogue built, bytecode written.

    Attributes
    ----------
    python : tuple of str
        Arguments of the interpreter; ``{folder}`` is a folder with the result of a run, ``run.h5``.
    processor : float
        User and system time of the process [s].
    importing : float
        Of its imports, as ``-X importtime`` adds them up, which itself takes a tenth [s].
    modules : int
        How many it imports.
    """

    name: str
    python: tuple[str, ...]
    processor: float
    importing: float
    modules: int


def _command(name: str, arguments: str, processor: float, importing: float, modules: int) -> Budget:
    return Budget(name, ("-m", "lambda_cli", *arguments.split()), processor, importing, modules)


RUN = f"run {DEFAULT} --duration 1ms --progress none"
BUDGETS = (
    _command("--help", "--help", 0.4, 0.25, 420),
    _command("init", "init fresh --out {folder}/fresh.toml --force", 0.6, 0.4, 480),
    _command("check", f"check {DEFAULT}", 1.2, 0.8, 860),
    _command("show", "show {folder}/run.h5", 1.2, 0.5, 580),
    _command("db search", "db search 6208", 1.2, 0.7, 780),
    _command("quasistatic", f"quasistatic {DEFAULT}", 1.2, 1.0, 1220),
    _command("run, 1 ms", f"{RUN} --out {{folder}}/again.h5 --force", 1.5, 1.1, 1280),
    Budget("first picture of the builder", ("-c", _PAINT), 1.0, 0.8, 1000),
)


def processor_time(command: Sequence[str], environment: Mapping[str, str], codes: Sequence[int] = (0, 5)) -> float:
    """Run a process and return its user and system time, with that of all it waited for [s]."""
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=said)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in codes:  # a millisecond is no converged run
            said.seek(0)
            words = said.read()[-2000:].decode(errors="replace")
            raise RuntimeError(f"{' '.join(command[:8])}: exit {process.returncode}: {words}")
    return usage.ru_utime + usage.ru_stime


def imports(command: Sequence[str], environment: Mapping[str, str]) -> tuple[int, float]:
    """Return how many modules a process imports, and the time of that [s]."""
    done = subprocess.run(
        [command[0], "-X", "importtime", *command[1:]],
        env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False,
    )  # fmt: skip
    lines = (line.partition("import time:")[2].split("|") for line in done.stderr.splitlines())
    own = [int(first) for first, *_ in lines if first.strip().isdigit()]
    return len(own), 1e-6 * sum(own)


def measure_commands(environment: Mapping[str, str], repeats: int) -> tuple[Table, tuple[Target, ...]]:
    """Return what each command takes, and how it stands to its budget.

    Parameters
    ----------
    environment : mapping of str to str
        Of the processes; the code that they need is compiled.
    repeats : int
        Of which the shortest counts.
    """
    rows, targets = [], []
    with tempfile.TemporaryDirectory() as folder:
        # The interpreter keeps what it reads, also where the surroundings have switched that off.
        here = {**environment, "PYTHONPYCACHEPREFIX": f"{folder}/bytecode"}
        here.pop("PYTHONDONTWRITEBYTECODE", None)
        run = f"{RUN} --out {folder}/run.h5".split()
        processor_time([sys.executable, "-m", "lambda_cli", *run], here)
        for budget in BUDGETS:
            command = [sys.executable, *(word.replace("{folder}", folder) for word in budget.python)]
            imports(command, here)  # writes the bytecode
            modules, importing = min(imports(command, here) for _ in range(repeats))
            spent = min(processor_time(command, here) for _ in range(repeats))
            rows.append((budget.name, spent, importing, modules))
            targets.append(Target(f"{budget.name}, warm: processor time", "s", spent, budget.processor))
            targets.append(Target(f"{budget.name}, warm: imports", "s", importing, budget.importing))
            targets.append(Target(f"{budget.name}, warm: imports", "modules", modules, budget.modules))
    table = Table(
        "What a warm command costs",
        ("command", "processor time s", "imports s", "modules"),
        tuple(rows),
        ("Processor time is user and system; imports are wall time, by -X importtime. Minima over repeats.",),
    )
    return table, tuple(targets)

"""Measure processor time and imports of warm commands against budgets."""

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
from lambda_gui.app import BuilderApp
class Painted(BuilderApp):
    async def _leave(self):
        self.exit()
    def on_ready(self):
        self.run_worker(self._leave())
Painted("6208-axial-1300").run(headless=True, size=(80, 24))
"""
_COMMAND = "import sys; from lambda_cli.main import main; sys.exit(main())"
# Before the program: processor time of every import that no other import asks for, and how much there is at the end.
_COUNTED = """
import atexit, builtins, importlib, sys, time
spent, depth = 0.0, 0
def counted(function):
    def call(*arguments, **options):
        global spent, depth
        began, depth = time.process_time(), depth + 1
        try:
            return function(*arguments, **options)
        finally:
            depth -= 1
            spent += 0.0 if depth else time.process_time() - began
    return call
builtins.__import__, importlib.import_module = counted(builtins.__import__), counted(importlib.import_module)
atexit.register(lambda: print(len(sys.modules), spent, file=sys.stderr))
"""


@dataclass(frozen=True)
class Budget:
    """Limits of a command, warm.

    Code compiled, catalogue built, bytecode written.

    Attributes
    ----------
    code : str
        What the interpreter runs.
    arguments : tuple of str
        After it; ``{folder}`` is a folder with the result of a run, ``run.h5``.
    processor : float
        User and system time of the process [s].
    importing : float
        Of that, for imports [s].
    modules : int
        How many it imports.
    """

    name: str
    code: str
    arguments: tuple[str, ...]
    processor: float
    importing: float
    modules: int


def _command(name: str, arguments: str, processor: float, importing: float, modules: int) -> Budget:
    return Budget(name, _COMMAND, tuple(arguments.split()), processor, importing, modules)


RUN = f"run {DEFAULT} --duration 1ms --progress none --band none"
BUDGETS = (
    _command("--help", "--help", 0.4, 0.2, 440),
    _command("init", "init fresh --out {folder}/fresh.toml --force", 0.6, 0.4, 500),
    _command("check", f"check {DEFAULT}", 1.2, 0.7, 860),
    _command("show", "show {folder}/run.h5", 1.2, 0.4, 560),
    _command("db search", "db search 6208", 1.2, 0.6, 780),
    _command("quasistatic, no band", f"quasistatic {DEFAULT} --band none", 1.2, 0.9, 1220),
    _command("run, 1 ms, no band", f"{RUN} --out {{folder}}/again.h5 --force", 1.5, 1.0, 1280),
    Budget("first picture of the builder", _PAINT, (), 1.0, 0.6, 800),
)


def processor_time(command: Sequence[str], environment: Mapping[str, str], codes: Sequence[int] = (0, 5)) -> float:
    """Return the processor time of a process [s].

    User and system time, with that of all it waited for.
    """
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=said)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode not in codes:  # a millisecond is no converged run
            said.seek(0)
            words = said.read()[-2000:].decode(errors="replace")
            raise RuntimeError(f"{' '.join(command[:8])}: exit {process.returncode}: {words}")
    return usage.ru_utime + usage.ru_stime


def imports(code: str, arguments: Sequence[str], environment: Mapping[str, str]) -> tuple[int, float]:
    """Return a program's import count and time.

    The modules, and their processor time [s].
    """
    command = [sys.executable, "-c", _COUNTED + code, *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    modules, spent = done.stderr.splitlines()[-1].split()
    return int(modules), float(spent)


def measure_commands(environment: Mapping[str, str], repeats: int) -> tuple[Table, tuple[Target, ...]]:
    """Return each command's cost and budget.

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
        processor_time([sys.executable, "-c", _COMMAND, *run], here)
        for budget in BUDGETS:
            words = [word.replace("{folder}", folder) for word in budget.arguments]
            imports(budget.code, words, here)  # writes the bytecode
            modules, importing = min(imports(budget.code, words, here) for _ in range(repeats))
            command = [sys.executable, "-c", budget.code, *words]
            spent = min(processor_time(command, here) for _ in range(repeats))
            rows.append((budget.name, spent, importing, modules))
            targets.append(Target(f"{budget.name}, warm: processor time", "s", spent, budget.processor))
            targets.append(Target(f"{budget.name}, warm: of it imports", "s", importing, budget.importing))
            targets.append(Target(f"{budget.name}, warm: imports", "modules", modules, budget.modules))
    table = Table(
        "What a warm command costs",
        ("command", "processor time s", "of it imports s", "modules"),
        tuple(rows),
        ("Processor time of the process, user and system, and the part of it that imports take; minima over repeats.",),
    )
    return table, tuple(targets)

"""Measure the response time to a signal, state by state.

``python tests/trust/answering.py`` prints the table of docs/security.md. In addition to the
wall time it has the processor time from the signal to the end, which does not depend on other load of the machine.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

CASE = "6208-axial-700"
SLOW = ("--set", "operation.speed=0.01 rpm")  # one record is 1/40 of a cage turn of four hours
# Row C2.4: 6016, 5.8 kN, -10 degC, 500 to 0 rpm in 7 ms.
STOP = (
    "--set", "bearing.designation=6016", "--set", "bearing.maker=SKF", "--set", "loads.axial=5.8 kN",
    "--set", "lubricant.temperature=-10 degC", "--set", "solver.duration=10 s",
    "--set", 'operation.speed={kind = "ramp", start = "500 rpm", end = "0 rpm", end_time = "7 ms"}',
)  # fmt: skip
STUDY = """name = "turns"
case = "6208-axial-700"
mode = "dynamic"

[[parameters]]
path = "operation.speed"
values = ["0.01 rpm", "0.011 rpm"]
"""
_TICK = 1.0 / os.sysconf("SC_CLK_TCK") if hasattr(os, "sysconf") else 0.01


@dataclass(frozen=True)
class State:
    """Command with the moment of its signal.

    After so much time of the processor [s], or once a file is there.
    """

    name: str
    command: tuple[str, ...]
    after: float = 0.0
    file: str = ""


# Friction smoothed at 10 mm/s of slip, with which a bearing at rest takes its time.
SMOOTHED = ("--set", "models.boundary_friction=cubic", "--set", "models.asperity_load=zhou-hoeprich")
STATES = (
    State("start", ("check", CASE), 0.3),
    State("catalogue", ("check", CASE), 0.7),
    State("compiling, with an empty cache", ("quasistatic", CASE), 0.6, "cache/catalogue-*"),
    State("equilibrium and loading of compiled code", ("quasistatic", CASE, *SLOW), 1.0),
    State("a record of minutes", ("run", CASE, *SLOW, "--out", "r.h5"), 0.3, "r.h5"),
    State("6016 from 500 rpm to rest in 7 ms", ("run", CASE, *STOP, "--out", "r.h5"), 0.3, "r.h5"),
    State("standstill under axial load", ("run", CASE, "--set", "operation.speed=0 rpm", "--set", "solver.duration=1 h",
                                          *SMOOTHED, "--out", "r.h5"), 0.3, "r.h5"),
    State("a study of runs", ("study", "run", "s.toml", "--workers", "1"), 0.02, "turns/runs/*.h5"),
    State("drawing", ("view", "whole.h5", "--format", "png"), 2.0),
    State("a report", ("report", "whole.h5"), 2.0),
    State("reproducing", ("reproduce", "table4", "--quick"), 0.02, "reproduction/**/*.h5"),
)  # fmt: skip


@dataclass(frozen=True)
class Answer:
    """Times [s] from signal to end.

    And how the process ended.
    """

    wall: float
    processor: float
    code: int
    said: str


def time_of(pid: int) -> float:
    """Return a process's processor time [s].

    Nothing where it has gone.
    """
    try:
        fields = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
    except OSError:
        return 0.0
    return _TICK * (int(fields[11]) + int(fields[12]))


def answer(state: State, number: int, folder: Path, environment: dict[str, str]) -> Answer:
    """Start, signal and await a command.

    The signal comes in a state.
    """
    process = subprocess.Popen(
        [sys.executable, "-m", "lambda_cli", *state.command], cwd=folder, env=environment, text=True,
        stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
    )  # fmt: skip
    assert process.stderr is not None
    while process.poll() is None and state.file and not list(folder.glob(state.file)):
        time.sleep(0.01)
    from_here = time_of(process.pid) if state.file else 0.0
    while process.poll() is None and time_of(process.pid) - from_here < state.after:
        time.sleep(0.01)
    if process.returncode is not None:
        raise RuntimeError(f"{state.name}: ended before the signal: {process.stderr.read()}")
    before, start = time_of(process.pid), time.monotonic()
    process.send_signal(number)
    said = process.stderr.read()
    os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)  # its times can be read until somebody asks for its end
    wall, spent = time.monotonic() - start, time_of(process.pid) - before
    code = process.wait()
    return Answer(wall, spent, code, said.strip().splitlines()[-1] if said.strip() else "")


def measure(folder: Path, wanted: tuple[str, ...] = (), number: int = signal.SIGINT) -> dict[str, Answer]:
    """Return the answers of the states.

    Those whose names begin with one of `wanted`, of all without any.
    """
    here = folder / "whole"
    here.mkdir()
    subprocess.run(
        [sys.executable, "-m", "lambda_cli", "run", CASE, "--duration", "5 ms", "--out", "whole.h5", "--quiet"],
        cwd=here, env=os.environ, check=False, capture_output=True,
    )  # fmt: skip
    found = {}
    for place, state in enumerate(STATES):
        if wanted and not state.name.startswith(wanted):
            continue
        own = folder / f"{place}"
        own.mkdir()
        os.link(here / "whole.h5", own / "whole.h5")
        (own / "s.toml").write_text(STUDY, encoding="utf-8")
        empty = {"LAMBDA_BEARING_CACHE": str(own / "cache")} if "empty cache" in state.name else {}
        found[state.name] = answer(state, number, own, os.environ | empty)
    return found


def main(wanted: list[str]) -> int:
    """Print the table.

    The exit code is 1 where an answer took more than a second of the processor.
    """
    late = False
    print("| state | wall time | processor time | exit code |\n|---|---|---|---|")
    for number in (signal.SIGINT, signal.SIGTERM):
        with tempfile.TemporaryDirectory() as name:
            for state, found in measure(Path(name), tuple(wanted), number).items():
                late = late or found.processor > 1.0
                times = f"{found.wall:.2f} s | {found.processor:.2f} s"
                print(f"| {state}, {number.name} | {times} | {found.code} |", flush=True)
    return int(late)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

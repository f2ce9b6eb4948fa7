"""Try the wheel on every Python of this machine.

``python tests/smoke.py [--whole] [--others | 3.12 ...]``

Needs nothing but Python. For each version that is found: a new environment, the wheel with the tested versions of its
dependencies, Numba's reading of the solver and the laws, the forces on all bodies, the same again by the code that the
first process kept, a check of laws, the builder's first picture; with ``--whole`` the complete solver and a short run.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSIONS = ("3.11", "3.12", "3.13", "3.14")
REQUIRED = VERSIONS[:3]  # on a newer one the tested versions of the dependencies may not install
OTHERS = "--others"  # than the Python that runs this
WHOLE = "--whole"
CASE = "6208-axial-1300"
KEPT = "kept"  # for the second process, which need not read all functions again
INSTALL, COMMAND = 900.0, 1200.0  # [s] at most on a busy machine, the second with compiling; alone it is a tenth
PIP = ["-m", "pip", "--disable-pip-version-check"]
# Machine code belongs to one version of Python, and compiling the complete solver takes minutes. What differs from one
# Python to the next is its bytecode: Numba reads that of every function of the solver and of all laws, and compiles the
# forces on all bodies. Looking for garbage would take a sixth of the time.
FORCES = f"""
import gc, sys
gc.disable()
import numpy as np
from numba.core.compiler import run_frontend
from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import ROLES
from lambda_core.laws.jit.reach import reach
from lambda_core.solver import core, entry
from lambda_core.solver.arrays.bundle import power_count
from lambda_core.solver.drivers.compiled_laws import Kernels, derive_oils
from lambda_core.solver.drivers.first_state import first_frame, first_state
from lambda_core.solver.drivers.solver_context import assemble
from lambda_core.solver.roller import units
read = set()
if "{KEPT}" not in sys.argv:
    starts = [unit for unit, _ in (*entry.UNITS.values(), *units.UNITS.values())]
    starts += [law.kernel for role in ROLES for law in registry().models(role).values()]
    read = {{getattr(one, "py_func", one) for start in starts for one in (start, *reach(start, lenient=True).helpers)}}
    for function in read:
        run_frontend(function)
needed = ("wrench", "tangent", "evaluate")
compiled = []
def find(name):
    return core.Unit(*entry.call_and_pointer(name, compiled.append)) if name in needed else core.Unit(None, None)
core._loaded[""] = core.Core.of(find)
model = api.check("{CASE}")
kernels, frame = Kernels(model), first_frame(model)
context = assemble(model, kernels, frame, derive_oils(model, kernels, frame))
state = first_state(context)
slope, powers = np.zeros(state.size), np.zeros(power_count(context.bundle))
assert core.core().evaluate(0.0, state, context.bundle, slope, powers, 1) == 1
print(abs(slope).max(), abs(powers).max(), len(read), "functions", len(compiled), "compiled")
"""
PAINT = f"""
from lambda_gui.app import BuilderApp
class Once(BuilderApp):
    async def _end(self):
        self.exit("painted")
    def on_ready(self):
        self.run_worker(self._end())
print(Once("{CASE}").run(headless=True, size=(80, 24)))
"""


def interpreters() -> dict[str, str]:
    """Return the Pythons of this system.

    On PATH and of pyenv, version -> path.
    """
    found: dict[str, str] = {}
    for version in VERSIONS:
        places = [shutil.which(f"python{version}"), sys.executable]
        places += sorted(map(str, Path.home().glob(f".pyenv/versions/{version}.*/bin/python")), reverse=True)
        for place in filter(None, places):
            code = "import sys, venv, ensurepip; print('.'.join(map(str, sys.version_info[:2])))"
            said = subprocess.run([place, "-c", code], capture_output=True, text=True, check=False).stdout.strip()
            if said == version:
                found[version] = place
                break
    return found


class Smoke:
    """The program on one Python."""

    def __init__(self, python: str, folder: Path) -> None:
        self._folder = folder
        folder.mkdir()
        subprocess.run([python, "-m", "venv", "--without-pip", str(folder / "venv")], check=True, timeout=INSTALL)
        scripts = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        self._base, self.python, self._program = python, str(scripts / "python"), str(scripts / "lambda-bearing")

    def install(self, wheel: Path) -> str:
        """Install the wheel by the Python's pip.

        Return what went wrong.
        """
        command = [self._base, *PIP, "--python", self.python, "install", "-q", "--no-compile"]
        done = self._run([*command, "-c", str(ROOT / "constraints.txt"), str(wheel)], INSTALL)
        return "" if done.returncode == 0 else done.stderr.strip()

    def faults(self, *, is_complete: bool) -> list[str]:
        """Return what does not work."""
        found: list[str] = []
        first = self._tried(found, "forces", [self.python, "-c", FORCES], "compiled")
        second = self._tried(found, "forces by kept code", [self.python, "-c", FORCES, KEPT], " 0 compiled")
        if first.split()[:2] != second.split()[:2]:
            found.append(f"kept code gives {second} instead of {first}")
        self._tried(found, "plugins check", [self._program, "plugins", "check", "damping"], "ok  damping/cubic")
        self._tried(found, "gui", [self.python, "-c", PAINT], "painted")
        if is_complete:
            self._tried(found, "quasistatic", [self._program, "quasistatic", CASE, "--json", "--quiet"], "max_load_N")
            run = [self._program, "run", CASE, "--duration", "2 ms", "--quiet", "--json", "--out", "r.h5"]
            said = self._tried(found, "run", run, "friction_torque_Nmm", code=5)  # 5: too short for an average
            if said and not json.loads(said)["friction_torque_Nmm"] > 0.0:
                found.append("run gives no friction torque")
        return found

    def _tried(self, found: list[str], name: str, command: list[str], word: str, code: int = 0) -> str:
        """Return the output of a command.

        Its faults are added to `found`.
        """
        try:
            done = self._run(command, COMMAND)
        except subprocess.TimeoutExpired:
            found.append(f"{name} takes more than {COMMAND:g} s")
            return ""
        if done.returncode == code and word in done.stdout:
            return done.stdout
        last = (done.stderr.strip().splitlines() or [done.stdout.strip() or "nothing was printed"])[-1]
        found.append(f"{name} ends with {done.returncode}, expected {code} and '{word}': {last}")
        return ""

    def _run(self, command: list[str], seconds: float) -> subprocess.CompletedProcess[str]:
        own = {"LAMBDA_BEARING_CACHE": str(self._folder / "cache"), "LAMBDA_BEARING_DATA": str(self._folder / "data")}
        # Neither the modules of this folder nor those of whoever called are seen.
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | own
        return subprocess.run(
            command, cwd=self._folder, env=environment, stdin=subprocess.DEVNULL,
            capture_output=True, text=True, timeout=seconds, check=False,
        )  # fmt: skip


def build(python: str, folder: Path) -> Path:
    """Return the wheel of this source tree.

    Without machine code: each Python compiles.
    """
    command = [python, *PIP, "wheel", "-q", "--no-deps", "-w", str(folder), str(ROOT)]
    subprocess.run(command, check=True, timeout=INSTALL, env=os.environ | {"LAMBDA_BEARING_PACK": "0"})
    (wheel,) = folder.glob("*.whl")
    return wheel


def smoke(version: str, python: str, wheel: Path, *, is_complete: bool) -> bool:
    """Try one Python and print the result.

    Return whether all works.
    """
    start = time.monotonic()
    one = Smoke(python, wheel.parent / version)
    why = one.install(wheel)
    if why and version not in REQUIRED:
        print(f"== smoke: {version} left out, its dependencies do not install: {why.splitlines()[-1]}")
        return True
    faults = [why] if why else one.faults(is_complete=is_complete)
    took = f"== smoke: {version} {'FAILED' if faults else 'ok'} in {time.monotonic() - start:.0f} s"
    print("\n   ".join([took, *faults]), flush=True)
    return not faults


def main(arguments: list[str]) -> int:
    """Try every Python.

    The exit code is 0 when all of them work.
    """
    wanted = [word for word in arguments if word != WHOLE]
    all_ = interpreters()
    print(f"== smoke: found {', '.join(f'{version} ({path})' for version, path in all_.items()) or 'no Python'}")
    if wanted == [OTHERS]:
        own = ".".join(map(str, sys.version_info[:2]))
        print(f"== smoke: {own} runs the tests, with those of the wheel")
        wanted = [version for version in all_ if version != own]
        if not wanted:
            return 0
    found = {version: path for version, path in all_.items() if not wanted or version in wanted}
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-smoke-") as name, ThreadPoolExecutor(2) as both:
        wheel = build(next(iter(found.values()), sys.executable), Path(name))
        tries = [
            both.submit(smoke, version, path, wheel, is_complete=WHOLE in arguments) for version, path in found.items()
        ]
        works = [one.result() for one in tries]
    if os.name == "posix":
        times = os.times()
        print(f"== smoke: {times.children_user + times.children_system:.0f} s of processor time in all")
    return int(not works or not all(works))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

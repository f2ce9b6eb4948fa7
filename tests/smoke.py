"""The program from its wheel on every Python of this machine: ``python tests/smoke.py [--others | 3.12 ...]``.

Needs nothing but Python. For each version that is found: a new environment, the wheel with the tested versions of its
dependencies, a short run, a check of laws, a quasi-static solution, the builder's first picture.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VERSIONS = ("3.11", "3.12", "3.13", "3.14")
REQUIRED = VERSIONS[:3]  # on a newer one the tested versions of the dependencies may not install
OTHERS = "--others"  # than the Python that runs this
CASE = "6208-axial-1300"
INSTALL, COMMAND = 900.0, 1200.0  # [s] at most on a busy machine, the second with compiling; alone it is a tenth
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
    """Return the Pythons on PATH and of pyenv, version -> path."""
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
        subprocess.run([python, "-m", "venv", str(folder / "venv")], check=True, timeout=INSTALL)
        scripts = folder / "venv" / ("Scripts" if os.name == "nt" else "bin")
        self.python, self._program = str(scripts / "python"), str(scripts / "lambda-bearing")

    def install(self, wheel: Path) -> str:
        """Install the wheel; returns what went wrong."""
        command = [self.python, "-m", "pip", "install", "-q", "--disable-pip-version-check"]
        done = self._run([*command, "-c", str(ROOT / "constraints.txt"), str(wheel)], INSTALL)
        return "" if done.returncode == 0 else done.stderr.strip()

    def faults(self) -> list[str]:
        """Return what does not work."""
        short = ["--duration", "2 ms", "--quiet", "--json", "--out", "r.h5"]
        tries: dict[str, tuple[list[str], int, str]] = {
            "run": ([self._program, "run", CASE, *short], 5, "friction_torque_Nmm"),  # 5: too short for an average
            "plugins check": ([self._program, "plugins", "check", "damping"], 0, "ok  damping/cubic"),
            "quasistatic": ([self._program, "quasistatic", CASE, "--json", "--quiet"], 0, "max_load_N"),
            "gui": ([self.python, "-c", PAINT], 0, "painted"),
        }
        found = []
        for name, (command, code, word) in tries.items():
            try:
                done = self._run(command, COMMAND)
            except subprocess.TimeoutExpired:
                found.append(f"{name} takes more than {COMMAND:g} s")
                continue
            if done.returncode != code or word not in done.stdout:
                last = (done.stderr.strip().splitlines() or ["nothing said"])[-1]
                found.append(f"{name} ends with {done.returncode} instead of {code}: {last}")
            elif name == "run" and not json.loads(done.stdout)["friction_torque_Nmm"] > 0.0:
                found.append("run gives no friction torque")
        return found

    def _run(self, command: list[str], seconds: float) -> subprocess.CompletedProcess[str]:
        own = {"LAMBDA_BEARING_CACHE": str(self._folder / "cache"), "LAMBDA_BEARING_DATA": str(self._folder / "data")}
        # Neither the modules of this folder nor those of whoever called are seen.
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | own
        return subprocess.run(
            command, cwd=self._folder, env=environment, stdin=subprocess.DEVNULL,
            capture_output=True, text=True, timeout=seconds, check=False,
        )  # fmt: skip


def build(python: str, folder: Path) -> Path:
    """Return the wheel of this source tree."""
    subprocess.run([python, "-m", "venv", str(folder / "build")], check=True)
    pip = [str(folder / "build" / ("Scripts" if os.name == "nt" else "bin") / "python"), "-m", "pip"]
    command = [*pip, "wheel", "-q", "--disable-pip-version-check", "--no-deps", "-w", str(folder), str(ROOT)]
    subprocess.run(command, check=True, timeout=INSTALL)
    (wheel,) = folder.glob("*.whl")
    return wheel


def main(wanted: list[str]) -> int:
    """Try every Python; the exit code is 0 when all of them work."""
    all_ = interpreters()
    print(f"== smoke: found {', '.join(f'{version} ({path})' for version, path in all_.items()) or 'no Python'}")
    if wanted == [OTHERS]:
        own = ".".join(map(str, sys.version_info[:2]))
        print(f"== smoke: {own} runs the whole suite, with tests of the wheel")
        wanted = [version for version in all_ if version != own]
        if not wanted:
            return 0
    found = {version: path for version, path in all_.items() if not wanted or version in wanted}
    failed = not found
    with tempfile.TemporaryDirectory(prefix="lambda-bearing-smoke-") as name:
        wheel = build(next(iter(found.values()), sys.executable), Path(name))
        for version, path in found.items():
            start = time.monotonic()
            folder = Path(name) / version
            folder.mkdir()
            smoke = Smoke(path, folder)
            why = smoke.install(wheel)
            if why and version not in REQUIRED:
                print(f"== smoke: {version} left out, its dependencies do not install: {why.splitlines()[-1]}")
                continue
            faults = [why] if why else smoke.faults()
            failed |= bool(faults)
            print(f"== smoke: {version} {'FAILED' if faults else 'ok'} in {time.monotonic() - start:.0f} s", flush=True)
            for fault in faults:
                print(f"   {fault}", flush=True)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

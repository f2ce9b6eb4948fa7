"""Run all checks: ``python -m tests [arguments of pytest]``.

Style and layers while the solver compiles, then the tests on four processes; with arguments, only the tests
that they choose. Each part runs whatever became of the others.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).parent.parent
PYTHON = sys.executable
PACKAGES = ("lambda_core", "plugins", "db", "gui", "cli")
# Where tests/conftest.py keeps compiled code.
CACHE = ROOT / ".pytest_cache" / "d" / "lambda-bearing"
LOOKING = {
    "ruff": [PYTHON, "-m", "ruff", "check", "."],
    "format": [PYTHON, "-m", "ruff", "format", "--check", "."],
    "layers": [str(Path(PYTHON).parent / "lint-imports")],
}
# Once, before the processes of tests would do it side by side.
COMPILING = {
    "bytecode": [PYTHON, "-m", "compileall", "-q", *PACKAGES],
    "compile": [PYTHON, "-m", "lambda_cli", "warmup", "--quiet"],
}
COLLECTING = {"collect": [PYTHON, "-m", "pytest", "--collect-only", "-qq"]}
# One file stays in one process: what a file prepares for its tests is prepared once. A quarter of the time tests wait
# (for programs, timers, helpers): two processes more than the two cores of CI.
TESTING = {"pytest": [PYTHON, "tests/second_try.py", "-n", "4", "--dist", "loadfile", "--no-loadscope-reorder"]}


def environment() -> dict[str, str]:
    """Return the environment of every part."""
    # Every process of pytest rewrites assertions, its own and those of its plugins, unless it finds that done.
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    # One thread each, as the program itself has it: the processes share the cores.
    return kept | {"LAMBDA_BEARING_CACHE": str(CACHE), "OPENBLAS_NUM_THREADS": "1"}


def run(parts: dict[str, list[str]], *, is_shown: bool = False) -> list[str]:
    """Run parts in order, return the failed ones.

    A part that passes without being shown prints a line.
    """
    failed = []
    pipe = None if is_shown else subprocess.PIPE
    for name, command in parts.items():
        print(f"== {name}: {' '.join(command[command[0] == PYTHON :])}", flush=True)
        start = time.monotonic()
        done = subprocess.run(
            command, cwd=ROOT, env=environment(), check=False, text=True,
            stdin=subprocess.DEVNULL, stdout=pipe, stderr=None if is_shown else subprocess.STDOUT,
        )  # fmt: skip
        took = f"{time.monotonic() - start:.0f} s"
        if done.returncode == 0:
            print(f"== {name}: ok in {took}", flush=True)
        else:
            print(f"{done.stdout or ''}== {name}: FAILED ({done.returncode}) in {took}", flush=True)
            failed.append(name)
    return failed


def main() -> int:
    """Run every part.

    The exit code is 0 only if all of them passed.
    """
    arguments = sys.argv[1:]
    is_first = not arguments and not any(ROOT.glob("tests/*/__pycache__/*-pytest-*.pyc"))
    looked = {} if arguments else LOOKING | (COLLECTING if is_first else {})
    with ThreadPoolExecutor() as pool:
        looking = pool.submit(run, looked)
        compiling = pool.submit(run, COMPILING)
    failed = looking.result() + compiling.result()
    failed += run({name: [*command, *arguments] for name, command in TESTING.items()}, is_shown=True)
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

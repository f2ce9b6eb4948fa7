"""Everything that must hold, in one command: ``python -m tests [arguments of pytest]``.

Style, types, layers, then the tests on two processes. Each part runs whatever the others said.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).parent.parent
PYTHON = sys.executable
PACKAGES = ("lambda_core", "plugins", "db", "gui", "cli")
# Where tests/conftest.py keeps compiled code.
CACHE = ROOT / ".pytest_cache" / "d" / "lambda-bearing"


def parts(arguments: list[str]) -> dict[str, list[str]]:
    """Return the commands by name."""
    layers = str(Path(PYTHON).parent / "lint-imports")
    return {
        "ruff": [PYTHON, "-m", "ruff", "check", "."],
        "format": [PYTHON, "-m", "ruff", "format", "--check", "."],
        "mypy": [PYTHON, "-m", "mypy"],
        "layers": [layers],
        # Read by every program that the tests start, also where nothing writes it while programs run.
        "bytecode": [PYTHON, "-m", "compileall", "-q", *PACKAGES],
        # Once, before two processes of tests would do it side by side.
        "compile": [PYTHON, "-m", "lambda_cli", "warmup", "--quiet"],
        # One file stays in one process: what a file prepares for its tests is prepared once.
        "pytest": [PYTHON, "-m", "pytest", "-n", "2", "--dist", "loadfile", *arguments],
    }


def main() -> int:
    """Run every part; the exit code is 0 only if all of them passed."""
    failed = []
    for name, command in parts(sys.argv[1:]).items():
        print(f"== {name}: {' '.join(command[1:] if name != 'layers' else command)}", flush=True)
        start = time.monotonic()
        # One thread each, as the program itself has it: two processes share two cores.
        environment = os.environ | {"LAMBDA_BEARING_CACHE": str(CACHE), "OPENBLAS_NUM_THREADS": "1"}
        code = subprocess.run(command, cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, check=False).returncode
        print(f"== {name}: {'ok' if code == 0 else f'FAILED ({code})'} in {time.monotonic() - start:.0f} s", flush=True)
        if code != 0:
            failed.append(name)
    if failed:
        print(f"failed: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

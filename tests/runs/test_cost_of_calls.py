"""Test that Python calls cost no more than commands."""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

CASE = "6208-axial-1300"
TOGETHER = 1.10
CALLS = {
    "quasistatic": (["quasistatic", CASE], f"api.quasistatic({CASE!r})"),
    "modes": (["modes", "box.toml"], "api.modes('box.toml')"),
}


def spent(command: list[str], folder: Path, threads: str) -> float:
    """Return a process's processor time [s].

    The smallest of three.
    """
    found = []
    environment = {**os.environ, "OMP_NUM_THREADS": threads, "OPENBLAS_NUM_THREADS": threads}
    if not threads:
        environment = {name: value for name, value in environment.items() if not name.endswith("NUM_THREADS")}
    for _ in range(3):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        found.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return min(found)


@pytest.mark.clock
@pytest.mark.parametrize("threads", ["", "8"], ids=["unset", "eight threads"])
@pytest.mark.parametrize("name", CALLS)
def test_a_call_costs_as_much_as_the_command(name: str, threads: str, tmp_path: Path) -> None:
    from lambda_core import api

    api.init_case("box", path=tmp_path / "box.toml", template="geared-shaft")
    words, call = CALLS[name]
    by_command = spent([sys.executable, "-m", "lambda_cli", *words], tmp_path, threads)
    by_call = spent([sys.executable, "-c", f"from lambda_core import api; print({call}.text())"], tmp_path, threads)
    assert by_call <= TOGETHER * by_command, (by_call, by_command)

"""Test linear algebra of every call from Python.

One thread meanwhile, the threads of whoever calls before and after it.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lambda_cli.main import main
from threadpoolctl import threadpool_info, threadpool_limits

from lambda_core import api
from lambda_core.formulas.elastic import whirl
from lambda_core.model.machine_templates import shaft_text
from lambda_core.solver.drivers import equilibrium

CASE = "6208-axial-1300"
TIMED = """
import sys, time
from lambda_core import api
model = api.check(sys.argv[1])
api.quasistatic(model)
clock, processor = time.perf_counter(), time.process_time()
api.quasistatic(model)
print(time.process_time() - processor, time.perf_counter() - clock)
"""


def threads() -> set[int]:
    """Return the linear algebra's thread numbers.

    Of the libraries that are loaded.
    """
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def two_threads() -> Iterator[None]:
    """Set two threads.

    As on a machine of two cores where nothing is set.
    """
    with threadpool_limits(2, user_api="blas"):
        if threads() != {2}:
            pytest.skip("the linear algebra library of this machine has a fixed number of threads")
        yield


@pytest.fixture
def seen(monkeypatch: pytest.MonkeyPatch) -> set[int]:
    """Return thread numbers from now on.

    Of linear algebra.
    """
    found: set[int] = set()

    def watched(function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: Any, **options: Any) -> Any:
            found.update(threads())
            return function(*arguments, **options)

        return call

    of_numpy = ("solve", "eig", "eigvals", "eigvalsh", "eigh")
    for owner, names in ((np.linalg, of_numpy), (whirl, ("eig", "eigh")), (equilibrium, ("continue_static",))):
        for name in names:
            monkeypatch.setattr(owner, name, watched(getattr(owner, name)))
    return found


@pytest.mark.full
@pytest.mark.parametrize(
    "call",
    [
        lambda shaft, out: api.quasistatic(shaft),
        lambda shaft, out: api.run(shaft, ["solver.duration=0.1 ms"], out=out),
        lambda shaft, out: api.quasistatic(CASE),
        lambda shaft, out: api.run(CASE, ["solver.duration=0.1 ms"], out=out),
        lambda shaft, out: api.thermal(CASE),
    ],
    ids=["shaft", "run of a shaft", "quasistatic", "run", "thermal"],
)
def test_a_call_computes_with_one_thread_and_gives_the_others_back(
    call: Callable[[Any, Path], object], seen: set[int], tmp_path: Path
) -> None:
    call(tomllib.loads(shaft_text("geared-shaft", "box")), tmp_path / "r.h5")
    assert seen == {1}
    assert threads() == {2}


@pytest.mark.full
def test_a_run_begun_from_python_is_gone_on_with_on_the_command_line(tmp_path: Path) -> None:
    """Continue a Python run on the command line.

    Whatever the number of threads: a run begins with the same bits.
    """
    api.run(tomllib.loads(shaft_text("geared-shaft", "box")), ["solver.duration=0.1 ms"], out=tmp_path / "run.h5")
    with threadpool_limits(1, user_api="blas"):
        assert main(["resume", str(tmp_path / "run.h5"), "--quiet", "--duration", "0.5 ms"]) == 5


@pytest.mark.clock
def test_a_shaft_takes_no_more_processor_time_than_time_and_than_with_one_thread(tmp_path: Path) -> None:
    (tmp_path / "box.toml").write_text(shaft_text("geared-shaft", "box"))
    installed = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    command = [sys.executable, "-c", TIMED, str(tmp_path / "box.toml")]
    found = [
        [float(text) for text in subprocess.check_output(command, env=environment, text=True).split()]
        for environment in (installed, installed | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
    ]
    assert found[0][0] < 1.2 * found[0][1], found
    assert found[0][0] < 2.0 * found[1][0], found

"""Test that each command imports no more than it needs."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CASE = "6208-axial-700"
# Libraries, packages of SciPy (Numba imports only its top level), and our own packages that take long to import.
HEAVY = (
    "numpy",
    "pydantic",
    "tomlkit",
    "rich",
    "textual",
    "sqlalchemy",
    "h5py",
    "numba",
    "matplotlib",
    "PIL",
    "jinja2",
    "xarray",
    "pandas",
    "dask",
    "sksundae",
    *(f"scipy.{room}" for room in ("integrate", "interpolate", "linalg", "optimize", "sparse", "spatial", "special")),
    "scipy.stats",
    "lambda_core.case.case",
    "lambda_core.discovery.manager",
    "lambda_core.model.resolve",
    "lambda_core.model.resolve_machine",  # machines: never for one bearing
    "lambda_core.solver.drivers.machine_statics",
    "lambda_core.solver.entry",
    "lambda_core.export.report.page",
    "lambda_core.studies.folders",
    "lambda_db.catalogue",
)
CASES = {"numpy", "pydantic", "tomlkit", "lambda_core.case.case"}
PLUGINS = {"numpy", "pydantic", "lambda_core.discovery.manager", "lambda_db.catalogue"}
CHECKED = CASES | PLUGINS | {"lambda_core.model.resolve"}
SOLVED = CHECKED | {"numba", "lambda_core.solver.entry"}
NEEDED = {
    "init": CASES,
    "check": CHECKED,
    "show": {"numpy", "pydantic", "h5py"},
    "db": PLUGINS | {"rich", "sqlalchemy"},
    "quasistatic": SOLVED,
    "run": SOLVED | {"h5py"},
}
ARGUMENTS = {
    "init": ["init", "fresh"],
    "check": ["check", CASE],
    "show": ["show", "run.h5"],
    "db": ["db", "search", "6208"],
    "quasistatic": ["quasistatic", CASE],
    "run": ["run", CASE, "--duration", "1 ms", "--out", "again.h5", "--progress", "none"],
}
CODE = """
import sys
from lambda_cli.main import main
code = main(sys.argv[2:])
print(code, *(name for name in sys.argv[1].split() if name in sys.modules))
"""


@pytest.fixture(scope="module")
def folder_of_a_run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    from lambda_core import api

    folder = tmp_path_factory.mktemp("imports")
    api.run(CASE, ["solver.duration=1 ms"], out=folder / "run.h5")
    return folder


@pytest.mark.parametrize("command", NEEDED)
def test_a_command_imports_what_it_needs_and_no_more(command: str, folder_of_a_run: Path, tmp_path: Path) -> None:
    shutil.copy(folder_of_a_run / "run.h5", tmp_path)
    done = subprocess.run(
        [sys.executable, "-c", CODE, " ".join(HEAVY), *ARGUMENTS[command]],
        cwd=tmp_path, capture_output=True, text=True, check=True,
    )  # fmt: skip
    code, *imported = done.stdout.splitlines()[-1].split()
    assert code == ("5" if command == "run" else "0"), done.stderr  # a millisecond is no converged run
    assert set(imported) == NEEDED[command]


def test_the_collector_begins_after_the_start_and_leaves_out_what_was_imported() -> None:
    code = (
        "import gc; usual = gc.get_threshold(); import lambda_cli.main; waits = gc.get_threshold()[0] > 100 * usual[0];"
        "gc.collect(); print(waits, gc.get_threshold() == usual, gc.get_freeze_count() > 10_000, gc.callbacks)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["True", "True", "True", "[]"]

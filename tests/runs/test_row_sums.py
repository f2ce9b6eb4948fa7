"""Test that changed bytes in a result are found."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from lambda_core import api
from lambda_core.results.opening import ResultError
from lambda_core.results.reader import Result
from lambda_core.results.row_sums import RowSums, check_rows, sums_of


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sums") / "begun.h5"
    api.run("6208-axial-1300", ["solver.duration=3 ms"], out=path)
    return path


def test_sums_do_not_depend_on_how_rows_come() -> None:
    rows, complete, parts = np.random.default_rng(1).random((10, 3)), RowSums(), RowSums()
    complete.add("/load", rows)
    for start in (0, 4, 9):
        parts.add("/load", rows[start : {0: 4, 4: 9, 9: 10}[start]])
    assert complete.by_name() == parts.by_name()


def test_the_checkpoint_knows_what_stands_in_the_file(begun: Path) -> None:
    result = Result(begun)
    checkpoint = result.checkpoint()
    assert checkpoint is not None
    position = checkpoint.position
    assert len(position.sums) > 40
    with h5py.File(begun, "r") as file:
        assert sums_of(file, position.summed).by_name() == position.sums
    check_rows(begun, position)


def test_an_undamaged_run_goes_on_twice(begun: Path, tmp_path: Path) -> None:
    path = tmp_path / "on.h5"
    shutil.copy(begun, path)
    api.resume(path, ["solver.duration=4 ms"])
    assert api.resume(path, ["solver.duration=5 ms"])["time"][-1] > 4.5e-3


@pytest.mark.parametrize("name", ["load", "ball_azimuth", "time", "integrals/input", "revolutions/time"])
def test_a_changed_number_is_found(begun: Path, tmp_path: Path, name: str) -> None:
    path = tmp_path / "changed.h5"
    shutil.copy(begun, path)
    with h5py.File(path, "r+") as file:
        data = file[name]
        place = (len(data) // 2, *(0 for _ in data.shape[1:]))
        data[place] = np.nextafter(data[place], np.inf)
    with pytest.raises(ResultError, match=f"is damaged: the numbers of {name} are not those that the run wrote"):
        api.resume(path, ["solver.duration=5 ms"])

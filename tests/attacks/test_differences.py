"""Test the comparison of results that the attacks use."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import h5py
import pytest

from lambda_core import api
from tests.attacks.damage import differences


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    folder = tmp_path_factory.mktemp("twice")
    for name in ("one", "two"):
        api.run("6208-axial-1300", ["solver.duration=1 ms"], out=folder / f"{name}.h5")
    return folder / "one.h5", folder / "two.h5"


def _delete(file: h5py.File) -> None:
    del file["ring"]


def _integer(file: h5py.File) -> None:
    file["ball"][0] = 77


def _text(file: h5py.File) -> None:
    file["body"][0] = "ghost"


def _unit(file: h5py.File) -> None:
    file["load"].attrs["units"] = "kN"


def _title(file: h5py.File) -> None:
    file.attrs["title"] = "another"


def _more(file: h5py.File) -> None:
    file["extra"] = 1.0


@pytest.mark.full
@pytest.mark.parametrize("change", [_delete, _integer, _text, _unit, _title, _more])
def test_every_kind_of_difference_is_seen(
    change: Callable[[h5py.File], None], runs: tuple[Path, Path], tmp_path: Path
) -> None:
    one, two = runs
    assert differences(one, two) == []
    other = Path(shutil.copy(two, tmp_path / "other.h5"))
    with h5py.File(other, "r+") as file:
        change(file)
    assert differences(one, other)
    assert differences(other, one)

"""Test cases that name files, from other folders."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.case_io import bearing_case, read_case, toml_tables
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text

LOAD = "time [ms],load [kN]\n0,1.0123456789\n0.333333333333,2\n7,2.5\n"
VOLTS = "time [us],voltage [V]\n0,0\n100.123456789,5\n200,0\n"
BEARING = """
name = "rig"
[bearing]
designation = "SKF 6208"
[lubricant]
name = "FVA3"
temperature = "60 degC"
[operation]
speed = "1500 rpm"
[loads]
radial = { kind = "table", file = "data/load.csv" } # measured
[electric.series]
file = "data/volts.csv"
repeat = true
"""
MACHINE = """
[loads.belt]
at = "100 mm"
radial = { kind = "table", file = "data/load.csv" }
[electric.series]
file = "data/volts.csv"
repeat = true
"""


@pytest.fixture
def rig(tmp_path: Path) -> Path:
    """Return a folder with both cases and their series."""
    folder = tmp_path / "rig"
    (folder / "data").mkdir(parents=True)
    (folder / "data" / "load.csv").write_text(LOAD)
    (folder / "data" / "volts.csv").write_text(VOLTS)
    (folder / "rig.toml").write_text(BEARING)
    (folder / "box.toml").write_text(shaft_text("geared-shaft", "box") + MACHINE)
    return folder


@pytest.mark.parametrize("as_machine", [False, True])
def test_a_new_case_names_the_files_of_its_source(rig: Path, tmp_path: Path, as_machine: bool) -> None:
    """Write a path that leads to the source's file.

    The new case kept `data/load.csv`, which does not exist in its own folder.
    """
    (tmp_path / "new").mkdir()
    new = api.init_case("mine", str(rig / "rig.toml"), tmp_path / "new" / "mine.toml", as_machine=as_machine)
    assert 'file = "../rig/data/load.csv"' in new.read_text()
    assert api.check(new).name == "mine"
    (tmp_path / "rig").rename(tmp_path / "gone")
    assert (tmp_path / "new").rename(tmp_path / "rig").is_dir()  # both folders are moved together, names are relative
    assert "../rig/data" in (tmp_path / "rig" / "mine.toml").read_text()


def test_a_case_saved_in_its_own_folder_keeps_its_words(rig: Path, tmp_path: Path) -> None:
    api.save(bearing_case(rig / "rig.toml").with_(name="other"), rig / "rig.toml")
    assert (rig / "rig.toml").read_text() == BEARING.replace('"rig"', '"other"')
    api.save(read_case(rig / "box.toml"), tmp_path / "box.toml")
    assert tomllib.loads((tmp_path / "box.toml").read_text())["electric"]["series"]["file"] == "rig/data/volts.csv"


def test_the_case_in_a_result_of_a_machine_needs_no_file(rig: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Resume a machine from the case in its result.

    `data/load.csv` was not found, and a path of the series counted as a change.
    """
    first = api.check(rig / "box.toml")
    assert ".csv" not in first.case_toml
    monkeypatch.chdir(rig.parent)
    again = api.check(toml_tables(first.case_toml, "box"))
    assert isinstance(first, MachineModel)
    assert isinstance(again, MachineModel)
    assert first.electric is not None
    assert again.electric is not None
    assert again.electric.options == first.electric.options
    assert len(again.varying) == len(first.varying) == 1
    assert np.array_equal(again.loads, first.loads)


@pytest.mark.parametrize("designation", ["SKF 32208", "SKF NJ 208 ECP"])
def test_a_roller_bearing_of_one_direction_is_written_as_a_machine(designation: str, tmp_path: Path) -> None:
    """Write `takes` for a roller bearing of one direction.

    The check of machines requires it.
    """
    new = api.init_case("m", path=tmp_path / "m.toml", bearing=designation, as_machine=True)
    machine = api.check(new)
    assert isinstance(machine, MachineModel)
    assert [one.takes for one in machine.bearings] == [1]

"""Test the one reader of bearings and machines."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.case import case_io
from lambda_core.case.case_io import bearing_case, read_case
from lambda_core.model.machine_templates import shaft_text


@pytest.fixture
def box(tmp_path: Path) -> Path:
    """Return the file of a machine."""
    path = tmp_path / "box.toml"
    path.write_text(shaft_text("geared-shaft", "box"))
    return path


def test_a_file_tables_and_a_name_are_read_alike(box: Path) -> None:
    for source in (box, str(box), tomllib.loads(box.read_text())):
        assert isinstance(read_case(source), api.MachineCase)
    assert isinstance(read_case("6208-axial-1300"), api.Case)
    one = read_case("6208-axial-1300", ["operation.speed=900 rpm"])
    assert isinstance(one, api.Case)
    assert one.written()["operation"] == {"speed": "900 rpm"}


def test_check_and_with_take_either(box: Path) -> None:
    machine = api.case(box).with_(operation={"speed": "900 rpm"})
    assert machine.folder == box.parent
    found = api.check(machine)
    assert isinstance(found, api.MachineModel)
    assert found.speed == pytest.approx(900.0 * 3.14159265 / 30.0)
    assert isinstance(api.check("6208-axial-1300"), api.BearingModel)
    assert api.problems(tomllib.loads(box.read_text())) == ()


def test_a_machine_is_saved_with_its_comments(box: Path) -> None:
    api.save(api.case(box).with_(shaft={"temperature": "50 degC"}), box)
    text = box.read_text()
    assert 'temperature = "50 degC"' in text
    assert "# Gears: the program computes the tooth forces from power (or torque) and geometry." in text


def test_what_is_about_one_bearing_refuses_machines(box: Path) -> None:
    with pytest.raises(api.CaseError, match="is a machine, and this needs the case of one bearing"):
        bearing_case(box)


def test_modes_of_what_cannot_be_read_say_why(tmp_path: Path) -> None:
    """Name the missing file or the wrong line.

    Both counted as cases without a shaft.
    """
    with pytest.raises(api.UsageError, match="neither a file nor a built-in case"):
        api.modes(tmp_path / "box.toml")
    (tmp_path / "box.toml").write_text('name = "box')
    with pytest.raises(api.CaseError, match=r"line 1|end of the file"):
        api.modes(tmp_path / "box.toml")
    with pytest.raises(api.UsageError, match="NoneType is not a case"):
        api.modes(None)  # type: ignore[arg-type]


def test_an_option_of_one_bearing_is_none_of_a_machine(box: Path) -> None:
    """Refuse the option by name.

    With it the machine counted as one bearing.
    """
    for question in (api.check, api.case):
        with pytest.raises(api.CaseError, match=r"bearing +is not a known option; nearest: bearings"):
            question(box, ["bearing.designation=SKF 6208"])


def test_one_schema_says_which_of_both_a_file_is() -> None:
    schema = api.schema()
    assert schema["if"] == {"required": ["bearing"]}
    names = [schema[key]["$ref"].rpartition("/")[2] for key in ("then", "else")]
    assert names == ["Case", "MachineCase"]
    assert set(names) < set(schema["$defs"])


@pytest.mark.parametrize(
    ("bearing", "change", "warned"),
    [
        ({"designation": "6208/C3"}, "6308", True),
        ({"designation": "6208/C3"}, "6308/C4", False),
        ({"designation": "6208"}, "6308", False),
        ({"designation": "6208/C3", "clearance": "14 um"}, "6309", False),
    ],
)
def test_a_clearance_class_that_goes_with_its_designation_is_named(
    bearing: dict[str, str], change: str, warned: bool, caplog: pytest.LogCaptureFixture
) -> None:
    case_io._warn_once.cache_clear()
    tables = {
        "name": "one",
        "bearing": bearing,
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "operation": {"speed": "1500 rpm"},
    }
    read_case(tables, [f"bearing.designation={change}"])
    assert ('write "6308/C3" to keep C3' in caplog.text) == warned

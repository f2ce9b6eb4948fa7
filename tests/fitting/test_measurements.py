"""Test files of measurements.

Columns, units, and a message for every mistake.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.fitting.measurements import parse_measurements, read_measurements
from lambda_core.fitting.subjects import subject_of

_TORQUE = "friction torque [N m],friction torque error [%]"
GOOD = f"""# run of 3 May
label,speed [1/min],radial load [kN],oil temperature [°C],oil temperature error [K],{_TORQUE}
a,500,16,62.5,2,0.925,2
b,1500,16,62.5,2,1.306,2
c,3000,24.6,62.5,2,,2
"""


def test_columns_are_read_in_their_units() -> None:
    text = GOOD.replace("3000,24.6,62.5,2,,2", "3000,24.6,62.5,2,1.847,2")
    found = parse_measurements(text, "rig.csv")
    assert len(found) == 3
    assert found.lines == (3, 4, 5)
    assert found.labels == ("a", "b", "c")
    np.testing.assert_allclose(found.conditions["speed"], np.array([500, 1500, 3000]) * np.pi / 30)
    np.testing.assert_allclose(found.conditions["radial load"], [16e3, 16e3, 24.6e3])
    np.testing.assert_allclose(found.conditions["oil temperature"], 335.65)
    np.testing.assert_allclose(found.condition_errors["oil temperature"], 2.0)
    np.testing.assert_allclose(found.measured["friction torque"], [925.0, 1306.0, 1847.0])
    np.testing.assert_allclose(found.shares["friction torque"], 0.02)


def test_semicolons_and_quotes_around_cells_are_read() -> None:
    found = parse_measurements('"speed [rpm]";"power loss [kW]"\n"500";"0.1"\n', "rig.csv")
    np.testing.assert_allclose(found.measured["power loss"], [100.0])


@pytest.mark.parametrize(
    ("coded", "said"),
    [
        ("speed [rpm],oil temperature [degC]\n1,2\n".encode("utf-16"), r"line 1 +is text in UTF-16: save"),
        ("speed [rpm],power loss [W]\n# Öl\n1,2\n".encode("latin-1"), r"line 2 +has a character that is not UTF-8"),
    ],
)
def test_other_codes_of_characters_are_named_with_their_line(coded: bytes, said: str, tmp_path: Path) -> None:
    (tmp_path / "rig.csv").write_bytes(coded)
    with pytest.raises(CaseError, match=said):
        read_measurements(tmp_path / "rig.csv")


def test_two_columns_that_set_one_option_are_refused() -> None:
    """Refuse the name of a condition and its path.

    One of the two was taken without a word.
    """
    words = subject_of("6319-cp10-1500").words
    text = "speed [rpm],operation.speed [rpm],friction torque [N mm]\n500,600,900\n"
    with pytest.raises(CaseError, match=r'column 2 +"operation\.speed" sets what "speed" sets: keep one'):
        parse_measurements(text, "rig.csv", words)


def test_a_condition_may_have_two_errors() -> None:
    """Read errors of single points and of all points."""
    head = (
        "speed [rpm],oil temperature [degC],oil temperature error [K],oil temperature common error [K],power loss [W]"
    )
    found = parse_measurements(f"{head}\n500,60,0.5,2,3\n600,70,0.5,2,4\n", "rig.csv")
    np.testing.assert_allclose(found.condition_errors["oil temperature"], 0.5)
    np.testing.assert_allclose(found.without({0}).common_errors["oil temperature"], [2.0])


def test_one_of_several_quantities_may_be_missing() -> None:
    found = parse_measurements("speed [rpm],power loss [W],capacitance [pF]\n500,3,\n600,,900\n", "rig.csv")
    np.testing.assert_allclose(found.measured["capacitance"], [np.nan, 0.9])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1"),
        ("speed [rpm],power loss [W]\n", "no measured point follows"),
        ("speed [rpm],radial load [N]\n1,2\n", "has no measured quantity"),
        ("speed,power loss [W]\n1,2\n", 'line 1, column 1       "speed" has no unit: write "speed [rpm]"'),
        ("sped [rpm],power loss [W]\n1,2\n", '"sped [rpm]" is not a known column; nearest: speed'),
        ("xyz [rpm],power loss [W]\n1,2\n", '"xyz [rpm]" is not a known column; allowed: speed, radial load,'),
        ("speed (rpm),power loss [W]\n1,2\n", 'write the unit in square brackets: "speed [rpm]"'),
        ("speed [kN],power loss [W]\n1,2\n", "kN is not a unit of rotational_speed"),
        ("speed [rpm],speed [rpm],power loss [W]\n1,1,2\n", 'column 2       "speed" appears twice'),
        ("power loss [W],speed error [rpm]\n1,2\n", 'no column "speed" it belongs to'),
        ("power loss [W],speed common error [rpm]\n1,2\n", 'no column "speed" it belongs to'),
        ("speed [rpm],power loss common error [W]\n1,2\n", 'no column "power loss" it belongs to'),
        ("power loss [W],power loss common error [W]\n1,-2\n", '"-2": an error must be above zero'),
        ("speed [rpm];power loss [W]\n1;2\n1,5;2\n", 'column 1       speed [rpm]: "1,5": write a decimal point'),
        ("speed [rpm],power loss [W]\n1,2\n1,5,2\n", "has 3 cells, the header 2; write decimal points"),
        ("speed [rpm],power loss [W]\n1\n", "line 2                 has 1 cells, the header 2"),
        ("speed [rpm],power loss [W]\n,2\n", 'line 2, column 1       "speed [rpm]" is empty: write a number'),
        ('speed [rpm],power loss [W]\n1,"2\n', "line 2                 has a single quote mark at character 3"),
        ("speed [rpm],power loss [W]\n1,two\n", 'line 2, column 2       power loss [W]: "two" is not a number'),
        ("speed [rpm],power loss [W]\n1,nan\n", '"nan" is not a finite number'),
        ("oil temperature [K],power loss [W]\n-3,1\n", "below absolute zero"),
        ("speed [rpm],power loss [W]\n1,\n", "line 2                 has no measured value"),
        ("friction torque [N mm]\n-100\n", 'friction torque [N mm]: "-100": must be 0 or above'),
        ("power loss [W],power loss error [%]\n1,0\n", "an error must be above zero"),
        ("power loss [W],power loss error [%]\n1,-3\n", '"-3": an error must be above zero'),
        ("power loss [W],power loss error [%]\n1,1e+300\n", '"1e+300": a number other than 0 lies between 1e-15 and'),
        ("power loss [W],power loss error [%]\n1,1e-300\n", '"1e-300": a number other than 0 lies between 1e-15 and'),
        ("power loss [W],\n1,\n", "line 1, column 2       has no name: name the column"),
        ("power loss [W]\n1_0\n", '"1_0" is not a number'),
        (f"power loss [W]\n{400 * '9'}\n", '"99999999999999999999..." has 400 characters'),
        (f"power loss [W]\n{30_000 * 'x'}\n", "line 2                 has 30000 characters: a line has at most"),
        (f"{500 * 'x'} [W]\n1\n", 'line 1, column 1       "xxxxxxxxxxxxxxxxxxxx..." is not a known column'),
        ("label,power loss [W]\na\u2028b,1\nc,x\n", "line 3, column 2       power loss [W]"),
    ],
)  # fmt: skip
def test_every_mistake_has_line_column_and_remedy(text: str, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        parse_measurements(text, "rig.csv")
    assert said in str(caught.value)
    assert str(caught.value).startswith("rig.csv: ")


def test_a_row_of_empty_cells_is_an_empty_line() -> None:
    """Ignore rows of commas, as spreadsheets write them.

    The last one gave three errors.
    """
    found = parse_measurements(",,\nspeed [rpm],power loss [W],label\n1,2,a\n , ,\n3,4,b\n,,\n", "rig.csv")
    assert found.lines == (3, 5)


def test_all_mistakes_of_a_file_are_reported_at_once() -> None:
    with pytest.raises(CaseError) as caught:
        parse_measurements("speed [rpm],power loss [W]\nx,1\n2,y\n", "rig.csv")
    assert len(caught.value.problems) == 2


def test_a_missing_file_is_a_mistake_of_the_call(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="No such file"):
        read_measurements(tmp_path / "none.csv")

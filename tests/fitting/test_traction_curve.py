"""Test traction over slide-roll ratio."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.fitting.traction_curve import BALL

POINT = ("FVA3", "1.2 GPa", "60 degC", "3 m/s")


def test_small_slip_is_that_of_a_newtonian_film() -> None:
    """Compare every law with Newton's at tiny slip.

    Nothing heats or limits the film there (Johnson 1985, section 8).
    """
    found = api.traction("FVA3", "0.4 GPa", "80 degC", "1 m/s")
    slopes = {law: values[1] / found.slide_roll_ratio[1] for law, values in found.coefficient.items()}
    assert slopes["bair-winer"] == pytest.approx(slopes["newtonian"], rel=0.05)
    assert slopes["ree-eyring"] == pytest.approx(slopes["newtonian"], rel=0.05)


def test_no_law_carries_more_than_its_limit() -> None:
    """Limit the coefficient to zeta = 0.065.

    tau <= zeta p everywhere (Johnson and Tevaarwerk 1977).
    """
    found = api.traction(*POINT)
    for law in ("ree-eyring", "bair-winer", "newtonian"):  # another test may have handed over a law without a limit
        values = found.coefficient[law]
        assert values[0] == 0.0
        assert 0.03 < max(values) < 0.065
    eyring, newtonian = (np.array(found.coefficient[law]) for law in ("ree-eyring", "newtonian"))
    assert np.all(eyring <= newtonian + 1e-12)


def test_the_load_is_that_of_the_pressure() -> None:
    """Compare with Johnson 1985, eq. 4.24.

    p = (6 W E*^2/(pi^3 R^2))^(1/3), E* = 115.4 GPa of steel on steel (E' = 2 E*).
    """
    found = api.traction(*POINT)
    reduced = 0.5 * 210e9 / (1.0 - 0.3**2)
    load = np.pi**3 * (1e9 * found.pressure_GPa) ** 3 * (0.5 * BALL) ** 2 / (6.0 * reduced**2)
    assert found.load_N == pytest.approx(load, rel=0.02)


def test_measured_points_stand_in_text_and_picture(tmp_path: Path) -> None:
    file = tmp_path / "mtm.csv"
    file.write_text(
        "slide-roll ratio [%],traction coefficient [-],traction coefficient error [%]\n1,0.03,5\n5,0.04,5\n"
    )
    found = api.traction(*POINT, measured=file)
    assert found.measured is not None
    assert found.measured.slide_roll_ratio == [0.01, 0.05]
    assert found.measured.error == pytest.approx([0.0015, 0.002])
    assert {0.01, 0.05} <= set(found.slide_roll_ratio)
    assert "mtm.csv: 2 measured points" in found.text()
    names = [series.name for series in found.picture().panels[0].series]
    assert names == [*found.coefficient, "mtm.csv"]


def test_mistakes_have_their_line(tmp_path: Path) -> None:
    file = tmp_path / "mtm.csv"
    file.write_text("slide-roll ratio [%],traction coefficient [-]\n1,0.03\n5,forty\n")
    with pytest.raises(CaseError, match="line 3, column 2"):
        api.traction(*POINT, measured=file)
    with pytest.raises(UsageError, match="pressure: "):
        api.traction("FVA3", "1.2", "60 degC", "3 m/s")
    with pytest.raises(CaseError, match="FVA"):
        api.traction("FVA 333", "1.2 GPa", "60 degC", "3 m/s")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({1: "1e30 Pa"}, r"pressure 1e\+24 MPa: is out of the range of traction machines; allowed: 1 MPa to 10 GPa"),
        ({1: "-1 GPa"}, "pressure -1 GPa"),
        ({3: "1e30 m/s"}, "speed .* allowed: "),
        ({3: "0 m/s"}, "speed 0 m/s"),
    ],
)
def test_conditions_of_no_traction_machine_are_refused(change: dict[int, str], words: str) -> None:
    """Refuse conditions that gave a table of zeros."""
    with pytest.raises(UsageError, match=words):
        api.traction(*(change.get(i, value) for i, value in enumerate(POINT)))


@pytest.mark.parametrize(
    ("row", "words"),
    [("5,1e9", "a traction coefficient is above 1: is the unit"), ("1e9,0.05", "a slide-roll ratio is above 20")],
)
def test_a_measured_value_of_a_wrong_unit_is_refused(row: str, words: str, tmp_path: Path) -> None:
    """Refuse a value whose square overflows."""
    path = tmp_path / "rig.csv"
    path.write_text(f"slide-roll ratio [%],traction coefficient [-]\n1,0.02\n{row}\n", encoding="utf-8")
    with pytest.raises(UsageError, match=f"rig.csv line 3: {words}"):
        api.traction(*POINT, measured=path)


def test_parameters_of_a_law_change_it_alone() -> None:
    one, other = api.traction(*POINT), api.traction(*POINT, parameters={"tau_eyring": "4 MPa"})
    assert max(other.coefficient["ree-eyring"]) < max(one.coefficient["ree-eyring"])
    assert other.coefficient["newtonian"] == one.coefficient["newtonian"]

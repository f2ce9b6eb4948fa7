"""Test what pages say of roller bearings."""

from __future__ import annotations

from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.case.case_io import Source

SHAFT = Path(__file__).parents[2] / "examples" / "roller-shafts"


def case(designation: str, radial: str = "5 kN", axial: str = "0 N", speed: str = "3000 rpm") -> Source:
    return {
        "name": "rollers",
        "bearing": {"designation": designation},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"radial": radial, "axial": axial},
        "operation": {"speed": speed},
    }


@pytest.mark.parametrize(
    ("designation", "axial"), [("SKF NU 208 ECP", "0 N"), ("SKF 32216", "6 kN"), ("SKF NA 4905", "0 N")]
)
def test_torques_of_catalogues_stand_next_to_that_of_rollers(designation: str, axial: str) -> None:
    """Compare them with the methods themselves.

    The pages of rollers had none, though both catalogues cover rollers.
    """
    source = case(designation, axial=axial)
    found, methods = api.quasistatic(source, band=False), api.compare(source)
    assert found.rating.skf_torque_Nmm == methods.value("skf", "friction", "total")
    assert found.rating.schaeffler_torque_Nmm == methods.value("schaeffler", "friction", "total")
    assert (found.rating.skf_torque_Nmm is None) == ("NA" in designation)
    assert f"Schaeffler {found.rating.schaeffler_torque_Nmm:,.0f}".replace(",", " ") in found.text()


def test_a_run_of_rollers_and_its_view_have_the_torques_of_catalogues(tmp_path: Path) -> None:
    """Draw the view that refused every roller bearing."""
    source = case("SKF NU 208 ECP")
    run = api.run(source, ["solver.duration=2 ms"], out=tmp_path / "rollers.h5")
    (panel,) = api.view(run, "catalogues").panels
    (total,) = (series for series in panel.series if series.name == "total")
    expected = [api.compare(source).value(name, "friction", "total") for name in ("skf", "schaeffler")]
    assert panel.x.categories == ("simulation", "SKF", "Schaeffler")
    assert total.y[1:].tolist() == expected


def test_the_curve_over_speed_has_the_torque_of_skf() -> None:
    found = api.stribeck(case("SKF NU 208 ECP"), speeds_rpm=[1500.0, 3000.0])
    assert found.skf_Nmm[1] == pytest.approx(api.compare(case("SKF NU 208 ECP")).value("skf", "friction", "total"))


@pytest.mark.parametrize(("name", "bearing", "speed"), [("motor", "belt", 2950.0), ("gearbox", "left", 1500.0)])
def test_the_curve_of_a_bearing_on_a_shaft_has_the_torque_of_skf(name: str, bearing: str, speed: float) -> None:
    """Compare it at the same speed; it varies with speed."""
    path = SHAFT / f"{name}.toml"
    found = api.stribeck(path, bearing=bearing, speeds_rpm=[0.5 * speed, speed])
    expected = api.compare(path, bearing=bearing).value("skf", "friction", "total")
    assert found.skf_Nmm[1] == pytest.approx(expected, rel=1e-9)
    assert found.skf_Nmm[0] < 0.9 * expected


@pytest.mark.parametrize(("axial", "words"), [("-1 kN", "axial -1 kN"), ("1 kN", "axial 1 kN")])
def test_thrust_has_its_direction(axial: str, words: str) -> None:
    """Write it; both directions read alike."""
    found = api.quasistatic(case("SKF NUP 208", axial=axial), band=False)
    assert words in found.text()
    assert words in api.compare(case("SKF NUP 208", axial=axial)).text()


def test_one_roller_is_no_plural() -> None:
    found = api.quasistatic(case("SKF NU 208 ECP", radial="5 N"), band=False)
    assert found.loaded_elements == 1
    assert "1 roller loaded" in found.text()


@pytest.mark.parametrize(
    ("name", "absent", "present"),
    [
        ("motor", ("contact angles   0.0..0.0",), ("contact angles   10.7..11.7 deg", "clearance        37.5 um")),
        ("gearbox", ("clearance",), ("contact angles   9.93..13.9 deg",)),
    ],
)
def test_a_shaft_says_nothing_of_what_its_rollers_do_not_have(
    name: str, absent: tuple[str, ...], present: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    """Leave out angles of cylinders and the clearance of cones."""
    assert main(["quasistatic", str(SHAFT / f"{name}.toml"), "--band", "none"]) == 0
    told = capsys.readouterr().out
    for words in present:
        assert words in told
    for words in absent:
        assert words not in told


def test_shorted_needles_are_no_balls_and_have_no_dashes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Say why a run has no capacitance.

    Its page had dashes for numbers, and "at both rings of a ball".
    """
    source = case("SKF NA 4905", radial="2 kN", speed="1000 rpm")
    run = api.run(source, ["solver.duration=1 ms"], out=tmp_path / "na.h5")
    main(["show", str(run.path)])
    told = " ".join(capsys.readouterr().out.split())
    assert "some at both rings of a roller: the bearing has no capacitance" in told
    assert "contacts -" not in told


def test_a_report_of_rollers_has_their_ribs_and_no_power_of_ten(tmp_path: Path) -> None:
    """Read load and film of a rib, and thrust.

    The report left ribs out, and wrote a thrust of 1 kN as 1e+03 N.
    """
    changes = ["loads.radial=5 kN", "loads.axial=1 kN"]
    source = api.init_case("rollers", bearing="SKF NJ 208", path=tmp_path / "rollers.toml", changes=changes)
    page = api.report(source, out=tmp_path / "rollers.html").read_text(encoding="utf-8")
    found = api.quasistatic(source, band=False)
    assert "e+03" not in page
    assert "1 000 N" in page
    for words in ("largest load of a rib", f"{found.rollers.rib_load_N:.3g}", "smallest film of a rib"):
        assert words in page


def test_ratings_of_rollers_have_their_sources() -> None:
    """Name case or catalogue; all were "of the rollers"."""
    own = {"dynamic_rating": "70 kN"}
    source = case("SKF NU 208 ECP")
    written = source | {"bearing": {"designation": "SKF NU 208 ECP", "geometry": own}}
    for given, sources in ((source, ("SKF", "SKF", "SKF")), (written, ("case", "SKF", "SKF"))):
        model = api.check(given)
        found = {value.path: value for value in model.values}
        each = [found[f"bearing.{name}"] for name in ("dynamic_rating", "static_rating", "fatigue_limit")]
        assert [value.source.replace(",", " ").split()[0] for value in each] == list(sources)
    assert model.rollers.dynamic_rating == 70_000.0

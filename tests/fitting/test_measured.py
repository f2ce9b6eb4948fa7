"""Test the measured series.

Their data, and the comparison without any fit.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from lambda_cli.main import main
from lambda_syla2026.published import MEASURED, TABLE_4

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.model.machine_templates import shaft_text

PAGE = Path(__file__).parents[2] / "docs/validation.md"


def test_every_series_names_source_licence_and_uncertainty() -> None:
    found = {series.name: series for series in api.measured_series()}
    known = {"6319-friction", "32216-axial", "32216-combined", "32008-axial", "lm12700-axial", "32208-rib"}
    assert known | {"tnd7870-cage", "balls-51205-rolling"} <= set(found)
    for series in found.values():
        assert all((series.title, series.source, series.licence, series.how_read, series.uncertainty))
        assert series.case or series.bearing


def test_the_6319_is_the_printed_table_and_near_it() -> None:
    (one,) = api.compare_measured(["6319-friction"], band=False).compared
    assert [point.measured for point in one.points] == list(TABLE_4[MEASURED])
    assert one.mean_absolute_error_pct is not None
    assert one.mean_absolute_error_pct < 10.0


@pytest.mark.parametrize(
    ("name", "why"), [("32208-rib", "oil"), ("tnd7870-cage", "load"), ("balls-51205-rolling", "speeds")]
)
def test_series_without_points_or_conditions_say_what_is_missing(name: str, why: str) -> None:
    (found,) = api.compare_measured([name]).compared
    assert not found.points
    assert re.search(rf"there is no case for it: .*{why}.* not", found.reason)


def test_series_without_a_case_have_the_reason() -> None:
    found = api.compare_measured(["lm12700-axial"]).compared[0]
    assert found.reason.startswith("there is no case for it: tapered roller bearing LM12700, oil SAE 75W")
    assert found.mean_error_pct is None


@pytest.mark.parametrize(
    ("name", "most"),
    [
        ("32216-axial", 17.0),
        pytest.param("32216-combined", 18.0, marks=pytest.mark.full),
        pytest.param("32008-axial", 24.0, marks=pytest.mark.full),
    ],
)
def test_tapered_bearings_are_compared_with_a_band(name: str, most: float) -> None:
    found = api.compare_measured([name])
    (one,) = found.compared
    assert one.mean_absolute_error_pct is not None
    assert one.mean_absolute_error_pct < most
    assert one.inside is not None
    assert f"{one.inside} of {len(one.points)} inside the 90 % band" in found.text()
    (row,) = (row for row in PAGE.read_text(encoding="utf-8").splitlines() if row.startswith(f"| {name} |"))
    assert row.endswith(f"| {one.inside} of {len(one.points)} inside |")
    for point in one.points:
        assert 0.5 * point.predicted < point.band[0] <= point.predicted <= point.band[1] < 1.6 * point.predicted


def test_the_page_about_validation_has_the_errors_of_today() -> None:
    page = PAGE.read_text(encoding="utf-8")
    rows = page.partition("<!-- measured:begin -->")[2].partition("<!-- measured:end -->")[0].splitlines()
    for one in api.compare_measured(band=False).compared:
        (row,) = (row for row in rows if row.startswith(f"| {one.series.name} |"))
        if one.reason:
            assert one.reason in row
            continue
        assert f"mean size {one.mean_absolute_error_pct:.1f} %" in row


def test_a_plugin_brings_series_next_to_its_catalogue_rows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "measured"
    folder.mkdir()
    (folder / "rig.toml").write_text(
        'title = "rig"\nsource = "us"\nlicence = "CC0"\nhow_read = "sensor"\nuncertainty = "2 %"\n'
        '[case]\nname = "own"\nbearing = { designation = "SKF 6208" }\noperation = { speed = "1500 rpm" }\n'
        'lubricant = { name = "FVA3", temperature = "60 degC" }\nloads = { radial = "2 kN" }\n'
    )
    (folder / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,50\n")
    (folder / "6319-friction.toml").write_text((folder / "rig.toml").read_text())  # a name that is taken
    monkeypatch.setattr(registry(), "data_folders", (("rig-plugin", tmp_path),))
    names = [series.name for series in api.measured_series()]
    assert names.count("6319-friction") == 1
    (one,) = api.compare_measured(["rig"], band=False).compared
    assert one.series.case != ""
    assert 30.0 < one.points[0].predicted < 100.0
    (folder / "rig.csv").unlink()
    with pytest.raises(UsageError, match=r"rig\.csv with its points is missing"):
        api.compare_measured(["rig"])


def test_a_series_of_ones_own_is_compared_with_its_band(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "rig.toml").write_text(
        'title = "rig"\ncase = "6319-cp10-1500"\nsource = "us"\nlicence = "CC0"\n'
        'how_read = "sensor"\nuncertainty = "2 %"\n'
    )
    (tmp_path / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,1250\n1500,9999\n")
    assert main(["measured", "compare", str(tmp_path / "rig.toml"), "--json", "-q"]) == 0
    (one,) = json.loads(capsys.readouterr().out)["compared"]
    assert one["inside"] == 1
    assert one["interval_score"] > 1.0


def test_points_that_the_case_was_fitted_to_do_not_test_it(tmp_path: Path) -> None:
    """Name a comparison with the points of a fit.

    Its small errors looked like those of a prediction.
    """
    points = "speed [1/min],friction torque [N mm]\n500,925\n1500,1306\n3000,1564\n"
    for name in ("own", "other"):
        (tmp_path / f"{name}.csv").write_text(points + "2000,1400\n" * (name == "other"))
        (tmp_path / f"{name}.toml").write_text(
            'title = "t"\ncase = "fitted.toml"\nsource = "s"\nlicence = "l"\nhow_read = "h"\nuncertainty = "u"\n'
        )
    report = api.fit("6319-cp10-1500", tmp_path / "own.csv", ["loss_factor"], suggest=False)
    api.fitted_case("6319-cp10-1500", report, tmp_path / "fitted.toml")
    own, other = (api.compare_measured([str(tmp_path / f"{name}.toml")], band=False) for name in ("own", "other"))
    assert own.compared[0].is_fitted
    assert not other.compared[0].is_fitted
    assert "the case was fitted to these points" in own.text()
    assert "fitted" not in other.text()


def test_an_unknown_series_is_refused() -> None:
    with pytest.raises(UsageError, match="nearest: 32216-axial"):
        api.compare_measured(["32216-axail"])


@pytest.mark.parametrize("name", ["nofile.toml", "rig.csv"])
def test_a_file_that_describes_no_series_is_not_taken_for_a_name(name: str) -> None:
    with pytest.raises(UsageError, match=rf"{name} is not a TOML file that describes a series: correct the path"):
        api.compare_measured([name])


def test_a_description_without_its_entries_says_what_is_missing(tmp_path: Path) -> None:
    (tmp_path / "rig.toml").write_text('title = "rig"\nsorce = "us"\n')
    with pytest.raises(
        CaseError, match=r'licence +is required: write a text\n(.*\n)*.*"sorce" is not a known entry; near'
    ):
        api.compare_measured([str(tmp_path / "rig.toml")])


def test_an_entry_of_another_type_is_told_in_one_line(tmp_path: Path) -> None:
    """Say what to write.

    Each type that would do had a line of pydantic's own, under the place "case.dict[str,any]".
    """
    (tmp_path / "rig.toml").write_text(
        'title = 5\ncase = 7\nsource = "s"\nlicence = "l"\nhow_read = "h"\nuncertainty = "u"\n'
    )
    with pytest.raises(CaseError) as caught:
        api.compare_measured([str(tmp_path / "rig.toml")])
    assert [(one.where, one.message) for one in caught.value.problems] == [
        ("title", "must be a text"),
        ("case", "must be the name of a case, or its tables"),
    ]


def test_a_series_that_was_asked_for_and_not_computed_is_a_partial_result(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Tell scripts that a case of a series has mistakes."""
    (tmp_path / "rig.toml").write_text(
        'title = "t"\nsource = "s"\nlicence = "l"\nhow_read = "h"\nuncertainty = "u"\n'
        'case = { bearing = { designation = "SKF 6208" } }\n'
    )
    (tmp_path / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,50\n")
    assert main(["measured", "compare", str(tmp_path / "rig.toml"), "--quiet"]) == 5
    out, err = capsys.readouterr()
    assert "not computed: case: 3 errors" in out
    assert err == "asked for and not computed: rig\n"


def test_the_list_has_every_series(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["measured", "list"]) == 0
    text = capsys.readouterr().out
    assert all(series.name in text for series in api.measured_series())


def test_an_added_series_is_listed_and_compared(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(tmp_path / "data"))
    (tmp_path / "rig.toml").write_text(
        'title = "rig"\ncase = "6319-cp10-1500"\nsource = "us"\nlicence = "CC0"\n'
        'how_read = "sensor"\nuncertainty = "2 %"\n'
    )
    (tmp_path / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,1250\n")
    assert main(["measured", "add", str(tmp_path / "rig.toml")]) == 0
    assert "rig" in [series.name for series in api.measured_series()]
    (one,) = api.compare_measured(["rig"], band=False).compared
    assert one.points[0].measured == 1250.0
    assert main(["measured", "add", str(tmp_path / "rig.toml")]) == 2
    assert "--force" in capsys.readouterr().err
    assert main(["measured", "add", str(tmp_path / "rib.toml")]) == 2
    assert "rib.toml does not exist" in capsys.readouterr().err
    (tmp_path / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,1300\n")
    assert main(["measured", "add", str(tmp_path / "rig.toml"), "--force"]) == 0
    (one,) = api.compare_measured(["rig"], band=False).compared
    assert one.points[0].measured == 1300.0


def test_an_added_series_brings_its_case_along(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Compare a series from another folder, and replace its case.

    The case was not stored: the series was computed in its own folder only.
    """
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(tmp_path / "data"))
    rig, away = tmp_path / "rig", tmp_path / "away"
    rig.mkdir()
    away.mkdir()
    monkeypatch.chdir(away)
    head = 'title = "rig"\nsource = "us"\nlicence = "CC0"\nhow_read = "sensor"\nuncertainty = "2 %"\n'
    (rig / "motor.toml").write_text(
        'name = "motor"\nbearing = { designation = "SKF 6208" }\noperation = { speed = "1500 rpm" }\n'
        'lubricant = { name = "FVA3", temperature = "60 degC" }\nloads = { radial = "2 kN" }\n'
    )
    (rig / "rig.toml").write_text(f'{head}case = "motor.toml"\n')
    (rig / "rig.csv").write_text("speed [1/min],friction torque [N mm]\n1500,50\n")

    def predicted(name: str) -> float:
        (one,) = api.compare_measured([name], band=False).compared
        assert not one.reason
        return one.points[0].predicted

    alone = predicted(str(rig / "rig.toml"))
    assert main(["measured", "add", str(rig / "rig.toml")]) == 0
    (rig / "motor.toml").unlink()
    assert predicted("rig") == alone
    assert main(["measured", "compare", "rig", "--band", "none", "-q"]) == 0
    assert "not computed" not in capsys.readouterr().out
    (rig / "rig.toml").write_text(f'{head}case = "6319-cp10-1500"\n')
    assert main(["measured", "add", str(rig / "rig.toml"), "--force"]) == 0
    assert predicted("rig") > 10.0 * alone
    (rig / "rig.toml").write_text(f'{head}case = "motor.toml"\n')
    assert main(["measured", "add", str(rig / "rig.toml"), "--force"]) == 2
    assert "motor.toml" in capsys.readouterr().err
    assert predicted("rig") > 10.0 * alone


@pytest.mark.parametrize("name", ["none.toml", "6319-friction.toml"])
def test_a_series_without_points_or_with_a_taken_name_is_not_added(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("LAMBDA_BEARING_DATA", str(tmp_path / "data"))
    if name.startswith("6319"):
        (tmp_path / name).write_text(
            'title = "x"\nsource = "us"\nlicence = "CC0"\nhow_read = "sensor"\nuncertainty = "2 %"\n'
        )
        (tmp_path / "6319-friction.csv").write_text("speed [1/min],friction torque [N mm]\n1500,1250\n")
    with pytest.raises(UsageError):
        api.add_measured(tmp_path / name)
    assert not (tmp_path / "data" / "measured" / name).exists()


ROLLERS = (
    'title = "rig"\nsource = "us"\nlicence = "CC0"\nhow_read = "sensor"\nuncertainty = "2 %"\n'
    '[case]\nname = "own"\nbearing = { designation = "SKF NU 208 ECP" }\n'
    'operation = { speed = "3000 rpm", temperatures = "computed" }\n'
    'lubricant = { name = "FVA3", temperature = "60 degC" }\nloads = { radial = "2 kN" }\n'
)


def test_rollers_at_computed_temperatures_are_compared_there(tmp_path: Path) -> None:
    """Compare torques and temperatures of rollers that warm up.

    The given temperature was kept, and a measured one had no column.
    """
    (tmp_path / "rig.toml").write_text(ROLLERS)
    (tmp_path / "rig.csv").write_text(
        "speed [1/min],friction torque [N mm],oil temperature [degC],oil temperature error [K]\n3000,150,75,1\n"
    )
    (one,) = api.compare_measured([str(tmp_path / "rig.toml")]).compared
    torque, oil = one.points
    answer = api.quasistatic(one.series.case, band=True)
    assert torque.predicted == pytest.approx(answer.friction_torque_Nmm, rel=1e-6)
    assert oil.band == pytest.approx(answer.oil_temperature_degC_band, rel=1e-3)
    assert oil.band[0] < oil.predicted < oil.band[1]
    assert abs(oil.predicted - 60.0) > 1.0


def test_a_series_of_a_machine_is_compared_with_its_bands(tmp_path: Path) -> None:
    (tmp_path / "box.toml").write_text(shaft_text("geared-shaft", "box"))
    (tmp_path / "rig.toml").write_text(
        f'title = "rig"\ncase = "{tmp_path / "box.toml"}"\nsource = "us"\nlicence = "CC0"\n'
        'how_read = "sensor"\nuncertainty = "2 %"\n'
    )
    (tmp_path / "rig.csv").write_text("friction torque [N mm],left friction torque [N mm]\n150,75\n")
    (one,) = api.compare_measured([str(tmp_path / "rig.toml")]).compared
    for point in one.points:
        assert point.band[0] < point.predicted < point.band[1]
    both, left = one.points
    assert both.predicted > left.predicted

"""Test the command stribeck.

Torque over speed with its parts and SKF's model.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.results.model_band import Band, Contributor, MachineBand, ModelBand

CASE = "6319-cp10-500"
CHANGES = (
    "bearing.designation=6316",
    "bearing.maker=SKF",
    "loads.radial=13.24 kN",
    "lubricant.name=mineral-vg68",
    "lubricant.temperature=60 degC",
    "lubricant.oil_level=-0.1 m",
    "models.boundary_friction=micro-slip",
    "models.asperity_load=spikes-olver",
)


def test_a_curve_falls_in_mixed_lubrication_and_rises_with_the_film() -> None:
    found = api.stribeck(CASE, CHANGES, speeds_rpm=[1.0, 10.0, 50.0, 3000.0])
    torque = found.torque_Nmm
    assert torque[0] > torque[1] > torque[2] < torque[3]
    assert np.allclose(torque, np.sum(list(found.parts_Nmm.values()), axis=0), rtol=1e-12)
    asperities = found.parts_Nmm["sliding on asperities"]
    assert sorted(asperities, reverse=True) == asperities
    assert sorted(found.film_parameter) == found.film_parameter
    # SKF, Rolling bearings (2018): mu_bl G_sl alone at 1 1/min.
    assert found.skf_Nmm[0] == pytest.approx(727.0, rel=0.01)


def test_speeds_reach_from_the_slowest_to_the_usual_limit() -> None:
    found = api.stribeck(CASE, CHANGES, points=3)
    assert found.speeds_rpm[0] == pytest.approx(1.0)
    assert found.speeds_rpm[-1] * 125.0 == pytest.approx(5e5)  # d_m of a 6316 in mm


def test_the_curve_tells_where_the_torque_lies_at_the_end_of_its_band(monkeypatch: pytest.MonkeyPatch) -> None:
    """Print the sentence of the band with its speeds."""
    cause = Contributor(name="law of fluid_drag", share=1.0, low=5.0, high=100.0, source="")
    band = Band(quantity="friction torque", unit="N mm", value=100.0, low=10.0, high=100.0, contributors=[cause])
    found = MachineBand(case="c", bearings={"": ModelBand(case="c", coverage=0.9, bands=[band], left_out=[])})
    monkeypatch.setattr("lambda_core.analysis.band.over_points.bands_of", lambda *_: found)
    curve = api.stribeck(CASE, CHANGES, speeds_rpm=[10.0, 1000.0], band=True)
    assert f"at 10 to 1000 1/min {band.at_end()}" in curve.text()
    assert band.at_end().startswith("the value is near the upper end")


def test_the_picture_has_a_logarithmic_speed() -> None:
    picture = api.stribeck_picture(api.stribeck(CASE, CHANGES, speeds_rpm=[10.0, 1000.0]))
    assert all(panel.x.log for panel in picture.panels)
    names = {series.name for series in picture.panels[0].series}
    assert {"total", "SKF", "hysteresis", "drag", "sliding on asperities"} <= names


def test_the_command_prints_and_draws(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["stribeck", CASE, "--speed", "10 rpm", "--speed", "1000 rpm", "--quiet", "--json", "--draw", str(tmp_path)]
    assert main(words) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["speeds_rpm"] == pytest.approx([10.0, 1000.0])
    pairs = zip(printed["torque_Nmm_band"], printed["torque_Nmm"], strict=True)
    assert all(low < torque < high for (low, high), torque in pairs)
    assert {path.suffix for path in tmp_path.iterdir()} == {".svg", ".png"}
    assert main(["stribeck", CASE, "--points", "2", "--band", "none", "--quiet"]) == 0
    assert "Lambda" in (text := capsys.readouterr().out)
    assert "model band" not in text
    assert main(["stribeck", CASE, "--points", "2", "--band", "none", "--quiet", "--json"]) == 0
    plain = json.loads(capsys.readouterr().out)
    assert plain["torque_Nmm_band"] == plain["band_notes"] == []  # as in the answers of other commands
    assert main(["stribeck", CASE, "--speed", "10 rpm", "--speed", "1000 rpm", "--quiet", "--units", "us"]) == 0
    customary = capsys.readouterr().out
    assert "friction torque over speed [lbf in]" in customary
    shown_ones = [line.split()[1] for line in customary.splitlines()[3:5]]
    for shown, torque, (low, high) in zip(shown_ones, printed["torque_Nmm"], printed["torque_Nmm_band"], strict=True):
        # no more digits than the band leaves
        assert float(shown) == pytest.approx(torque / 112.98483, abs=0.05 * (high - low) / 112.98483)
        assert len(shown) <= 4


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--speed", "0 rpm", "--speed", "1 rpm"], "above zero"),
        (["--speed", "5 rpm"], "two speeds or more"),
        (["--speed", "5 furlong"], "--speed"),
    ],
)
def test_mistakes_are_named(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stribeck", CASE, *words, "--quiet"]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.full
def test_no_point_of_rollers_depends_on_the_others() -> None:
    """Follow the skewed rollers of a belt to low speeds.

    A start at the fastest speed that was asked for had another equilibrium, or none, at low ones.
    """
    shaft = Path(__file__).parents[2] / "examples" / "roller-shafts" / "motor.toml"
    few, more = (api.stribeck(shaft, bearing="belt", speeds_rpm=speeds) for speeds in ([300.0, 100.0], [3e3, 100.0]))
    assert few.torque_Nmm[1] == more.torque_Nmm[1] == pytest.approx(25.7, rel=0.02)
    assert few.note == more.note
    assert "continues the one at 8333 1/min" in few.note

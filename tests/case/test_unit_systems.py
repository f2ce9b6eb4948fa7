"""Test units in cases, and customary units in answers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.unit_systems import SI, US, unit_system
from lambda_core.domain.units import CUSTOMARY, UNITS, from_si, parse, show
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData
from lambda_core.views.other_units import in_units


@pytest.mark.parametrize(
    ("text", "quantity", "si"),
    [
        ("1 lbf", "force", 0.45359237 * 9.80665),  # BIPM, The International System of Units, 9th ed.; NIST SP 811, B.8
        ("1 lbf in", "moment", 0.45359237 * 9.80665 * 0.0254),
        ("1 ft lbf", "moment", 0.45359237 * 9.80665 * 0.3048),
        ("1 psi", "pressure", 0.45359237 * 9.80665 / 0.0254**2),
        ("1 hp", "power", 550.0 * 0.3048 * 0.45359237 * 9.80665),
        ("2 inch", "length", 0.0508),
        ("1 lbf/in", "stiffness", 0.45359237 * 9.80665 / 0.0254),
        ("1 gal/min", "volume_flow", 231.0 * 0.0254**3 / 60.0),
        ("32 degF", "temperature", 273.15),
        ("140 °F", "temperature", 333.15),
        ("-40 degF", "temperature", 233.15),
        ("68 cSt", "kinematic_viscosity", 68e-6),
    ],
)
def test_customary_units_are_read(text: str, quantity: str, si: float) -> None:
    assert parse(text, quantity) == pytest.approx(si, rel=1e-14)
    unit = text.partition(" ")[2]
    if unit in CUSTOMARY.get(quantity, {}):
        assert from_si(parse(text, quantity), quantity, unit) == pytest.approx(float(text.split()[0]), rel=1e-12)


def test_customary_units_are_never_written() -> None:
    assert show(parse("100 lbf", "force"), "force").split()[1] in UNITS["force"]
    written = api.case("6319-cp10-1500").with_(loads={"radial": "562 lbf"}).written()
    assert written["loads"]["radial"] == f"{562 * 4.4482216152605 / 1e3!r} kN"


def test_numbers_are_shown_in_customary_units_about_as_fine() -> None:
    assert US.text(160.0, "N mm") == "1.416 lbf in"
    assert US.text(60.0, "degC", 0) == "140 degF"
    assert US.interval([0.69, 1.14], "um", 2) == "27..45 uin"
    assert US.plus_minus(160.0, 1.5, "N mm") == "1.416 ± 0.013 lbf in"
    assert SI.plus_minus(160.0, 1.5, "N mm") == "160.0 ± 1.5 N mm"
    assert US.text(None, "N") == "- lbf"
    assert US.text(1500.0, "rpm", 0) == "1 500 rpm"  # the same everywhere


@pytest.mark.parametrize(
    ("sentence", "shown"),
    [
        ("radial 2.5 kN   inner ring 6000 rpm", "radial 562 lbf   inner ring 6000 rpm"),
        ("middle of C3 (15 to 33 um)", "middle of C3 (591 to 1300 uin)"),
        ("8 x 15.081 mm", "8 x 0.59374 in"),  # 8 is a number of balls
        ("outside -20 to 200 degC", "outside -4 to 392 degF"),
        ("0.137 W/(m K), 3 N s/m, 5 kJ", "0.137 W/(m K), 0.0171 lbf s/in, 5 kJ"),  # no part of a longer unit
        ("12 000 N of C0 = 24 kN", "2697.7 lbf of C0 = 5400 lbf"),
    ],
)
def test_sentences_are_put_into_customary_units(sentence: str, shown: str) -> None:
    assert US.sentence(sentence) == shown
    assert SI.sentence(sentence) == sentence


def test_an_unknown_system_is_named() -> None:
    with pytest.raises(api.UsageError, match='"uk" is not a known system of units'):
        unit_system("uk")


def test_a_view_is_drawn_in_customary_units() -> None:
    x = np.array([0.0, 100.0])
    panel = Panel(
        "",
        Axis("temperature", "degC", low=0.0, least=10.0),
        Axis("film", "um", ticks=(1.0,)),
        (Series("s", x, x, "line", "", x - 1.0, x + 1.0),),
        (Mark("at 25.4 um", 25.4),),
    )
    data = ViewData("film", "Film", "radial 4.4482216 N", (panel,), 1, ("band of 1 mm",))
    shown = in_units(data, US)
    (found,) = shown.panels
    assert (found.x.unit, found.y.unit, found.x.low, found.x.least) == ("degF", "uin", 32.0, 18.0)
    assert found.series[0].x.tolist() == [32.0, 212.0]
    assert found.series[0].y[1] == pytest.approx(100.0 / 0.0254)
    assert found.marks[0].value == pytest.approx(1000.0)
    assert found.marks[0].label == "at 1000 uin"
    assert (shown.source, shown.notes) == ("radial 1 lbf", ("band of 0.0394 in",))
    assert in_units(data, SI) is data


def test_a_case_is_checked_in_customary_units(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    changes = ["--set", "loads.radial=500 lbf", "--set", "lubricant.temperature=140 degF"]
    assert main(["check", "6319-cp10-1500", *changes, "--units", "us"]) == 0
    asked = capsys.readouterr().out
    assert "radial 500 lbf" in asked
    assert "at 140 degF" in asked
    monkeypatch.setenv("LAMBDA_BEARING_UNITS", "us")
    assert main(["check", "6319-cp10-1500", *changes]) == 0
    assert capsys.readouterr().out == asked
    assert main(["check", "6319-cp10-1500", *changes, "--units", "si"]) == 0
    assert "radial 2.22411 kN" in capsys.readouterr().out


def test_factors_are_those_of_the_units_they_are_made_of() -> None:
    for quantity, units in CUSTOMARY.items():
        assert not set(units) & set(UNITS[quantity])
        assert all(math.isfinite(factor) and factor > 0.0 for factor in units.values())

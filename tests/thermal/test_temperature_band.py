"""Test the model band of computed temperatures."""

from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.operating import BearingLoop
from lambda_core.analysis.thermal.temperatures import ready_model
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results.model_band import ModelBand
from lambda_core.results.quasistatic import QuasiStatic

WARM = {
    "name": "warm",
    "bearing": {"designation": "SKF 6208"},
    "loads": {"radial": "2 kN"},
    "operation": {"speed": "3000 rpm", "temperatures": "computed"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
}


@cache
def _found(*changes: str) -> FoundTemperatures:
    found = ready_model(WARM, changes, is_static=True).found_temperatures
    assert isinstance(found, FoundTemperatures)
    return found


def _band(tables: dict[str, Any], quantities: list[str], changes: Sequence[str] = ()) -> ModelBand:
    found = api.model_band(tables, changes, quantities=quantities)
    assert isinstance(found, ModelBand)
    return found


def test_temperatures_answer_to_conductances_as_a_new_search_does() -> None:
    """Compare first order with a new search.

    A small change, with the loop of temperature and loss.
    """
    found = _found()
    moved = found.by_network(lambda section: section.model_copy(update={"seat_conductance": 2500.0}))
    again = _found("thermal.seat_conductance=2500 W/(m2 K)").steady.temperatures - found.steady.temperatures
    assert moved == pytest.approx(again, rel=0.02, abs=2e-3)


def test_temperatures_answer_to_losses_as_a_new_search_does(monkeypatch: pytest.MonkeyPatch) -> None:
    found, more = _found(), 0.02
    assert isinstance(found.loop, BearingLoop)
    moved = more * found.by_loss()[:, 0]
    at = found.loop.losses.at

    def lossier(inlet: float, clearance: float) -> Point:
        point = at(inlet, clearance)
        return point.with_losses({name: math.exp(more) * value for name, value in point.losses.items()})

    monkeypatch.setattr(found.loop.losses, "at", lossier)
    again = found.loop.steady(found.steady.temperatures).temperatures - found.steady.temperatures
    assert moved == pytest.approx(again, rel=0.03, abs=2e-3)
    assert moved.max() > 0.3


def test_an_exchanged_set_ends_near_its_own_temperatures() -> None:
    found, other = _found(), _found("thermal.conductances=palmgren")
    moved = found.by_network(lambda section: section.model_copy(update={"conductances": "palmgren"}))
    rise = other.steady.temperatures - found.section.ambient
    assert moved == pytest.approx(other.steady.temperatures - found.steady.temperatures, abs=0.12 * rise.max())


def test_what_the_case_gives_of_the_network_has_no_range() -> None:
    band = _band(WARM, ["oil temperature", "friction torque"])
    names = {one.name for one in band.band("oil temperature").contributors}
    assert {"thermal.conductances"} <= names
    assert "lubricant.temperature" not in names | {one.name for one in band.band("friction torque").contributors}
    given = ("thermal.housing_area=0.05 m2", "thermal.emissivity=0.9", "thermal.seat_conductance=2600 W/(m2 K)")
    known = _band(WARM, ["oil temperature"], given).band("oil temperature")
    assert not {one.name for one in known.contributors} & {
        f"thermal.{one.split('.')[1].split('=')[0]}" for one in given
    }
    assert known.low < known.value < known.high


def test_a_network_of_links_has_the_band_of_its_losses_alone() -> None:
    links = {"out": {"between": ["outer_ring", "ambient"], "conductance": "0.8 W/K"}}
    tables = {**WARM, "thermal": {"conductances": "none", "links": links}}
    band = _band(tables, ["outer ring temperature"]).band("outer ring temperature")
    assert not any(one.name.startswith("thermal.") for one in band.contributors)
    assert band.low < band.value < band.high


def test_thermal_prints_the_band_of_every_temperature(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = tmp_path / "warm.toml"
    path.write_text(
        'name = "warm"\nbearing = { designation = "SKF 6208" }\nloads = { radial = "2 kN" }\n'
        'operation = { speed = "3000 rpm" }\nlubricant = { name = "FVA3", temperature = "60 degC" }\n'
    )
    assert main(["thermal", str(path), "--json", "-q"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert set(found["temperatures_degC_band"]) == set(found["temperatures_degC"]) - {"ambient"}
    for node, (low, high) in found["temperatures_degC_band"].items():
        assert low < found["temperatures_degC"][node] < high, node
    assert "thermal.conductances" in {c["name"] for c in found["model_band"]["bands"][0]["contributors"]}
    assert main(["thermal", str(path), "-q", "--band", "none"]) == 0
    assert "model" not in capsys.readouterr().out


def test_a_result_at_computed_temperatures_has_their_bands() -> None:
    found = api.quasistatic(WARM, band=True)
    assert isinstance(found, QuasiStatic)
    assert found.model_band is not None
    low, high = found.oil_temperature_degC_band
    assert low < found.model_band.band("oil temperature").value < high
    assert f"oil {found.model_band.band('oil temperature').value:.0f} degC (model" in found.text()
    given = {**WARM, "operation": {"speed": "3000 rpm"}}
    plain = api.quasistatic(given, band=True)
    assert isinstance(plain, QuasiStatic)
    assert plain.oil_temperature_degC_band == []


@pytest.mark.full
def test_every_node_of_a_machine_has_a_band() -> None:
    found = api.thermal(tomllib.loads(shaft_text("geared-shaft", "box")), band=True)
    for node in ("left.oil", "right.oil", "left.inner_ring", "housing"):
        low, high = found.temperatures_degC_band[node]
        assert low < found.temperatures_degC[node] < high
    assert found.model_band is not None
    sources = {one.name for band in found.model_band.bands for one in band.contributors}
    assert {"thermal.housing_area", "thermal.conductances"} <= sources


@pytest.mark.full
def test_laws_of_balls_and_of_rollers_are_told_apart() -> None:
    """Their laws of one role have other alternatives."""
    found = api.thermal(tomllib.loads(shaft_text("motor-shaft", "motor")), band=True)
    assert found.model_band is not None
    names = [one.name for one in found.model_band.band("housing temperature").contributors]
    assert len(set(names)) == len(names)
    assert {f"law of rolling_resistance of {bearing}" for bearing in ("fan", "belt")} <= set(names)


def test_rollers_at_computed_temperatures_have_their_bands() -> None:
    rollers = {**WARM, "bearing": {"designation": "SKF NU 208 ECP"}}
    found, model = api.quasistatic(rollers, band=True), ready_model(rollers, is_static=True)
    assert isinstance(found, QuasiStatic)
    assert found.model_band is not None
    value = found.model_band.band("oil temperature").value
    assert value == pytest.approx(model.oil.temperature - 273.15, abs=1e-3)
    assert abs(value - 60.0) > 1.0
    low, high = found.oil_temperature_degC_band
    assert low < value < high
    given = {**rollers, "operation": {"speed": "3000 rpm"}}
    cold = api.quasistatic({**given, "lubricant": {"name": "FVA3", "temperature": f"{value:.4f} degC"}})
    assert isinstance(cold, QuasiStatic)
    assert found.friction_torque_Nmm == pytest.approx(cold.friction_torque_Nmm, rel=0.02)


def test_methods_on_rollers_are_compared_at_computed_temperatures() -> None:
    """Compare methods where the bearing runs.

    They were asked at the temperature that the case gives as a start.
    """
    rollers = {**WARM, "bearing": {"designation": "SKF NU 208 ECP"}}
    answer = api.quasistatic(rollers)
    assert isinstance(answer, QuasiStatic)
    compared = api.compare(rollers)
    assert compared.value("quasi-static", "friction", "total") == pytest.approx(answer.friction_torque_Nmm)
    model = ready_model(rollers, is_static=True)
    assert f"{model.oil.temperature - 273.15:.4g} degC" in compared.headline
    resolved = api.compare(api.check(rollers, ["operation.temperatures=given"], is_static=True))
    assert resolved.value("skf", "friction", "total") != compared.value("skf", "friction", "total")

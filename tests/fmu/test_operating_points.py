"""Test more than one operating point in one FMU.

Starts with other inputs, options of the case that a host changes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.export.fmu.curves import constants, points
from lambda_core.export.fmu.varied import Varied, varied

CASE, CHANGES = "6208-axial-1300", ("solver.duration=0.2 s",)
STEP = 1e-4  # [s]
WARM, WIDE, SPEED, PUSH = 273.15 + 55.0, 18e-6, 200.0, -500.0
Export = Callable[[int, str], Path]


@pytest.fixture(scope="module")
def unit(host: Any, exported: Export, tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Return the FMU whose oil and clearance vary."""
    return host.Unit(exported(2, "force"), tmp_path_factory.mktemp("varied"))


def moved(bearing: Any) -> Any:
    """Give a bearing another operating point."""
    values = {
        "lubricant.temperature": WARM,
        "bearing.clearance": WIDE,
        "inner_ring.spin": SPEED,
        "inner_ring.force_z": PUSH,
    }
    assert [bearing.set(name, value) for name, value in values.items()] == [0, 0, 0, 0]
    return bearing


@pytest.mark.full
def test_a_start_elsewhere_is_that_of_the_case_there(host: Any, unit: Any) -> None:
    """Solve the equilibrium of another point in the FMU.

    Contacts keep the frame of the exported case, which costs some 1e-4.
    """
    bearing = moved(host.Instance(unit)).ready()
    changes = ("lubricant.temperature=55 degC", "bearing.clearance=18 um", f"operation.speed={SPEED} rad/s")
    there = api.iterate(CASE, (*CHANGES, *changes, f"loads.radial={-PUSH} N"), exact=True)
    for _ in range(10):
        step = there.step_to(bearing.time + STEP)
        assert bearing.step(STEP) == host.OK
        found = bearing.get(["inner_ring.x", "inner_ring.z", "bearing.film_minimum", "bearing.max_pressure"])
        films = step["film_minimum"]
        expected = [*step["body_position"][0, ::2], films[films > 0.0].min(), step["max_pressure"].max()]
        assert found == pytest.approx(expected, rel=1e-3)
    assert bearing.get(["cage.spin"])[0] == pytest.approx(step["body_spin"][2], rel=1e-4)
    at_start = host.Instance(unit).get(["bearing.film_minimum"])[0]
    assert found[2] < 0.8 * at_start  # another point indeed


@pytest.mark.full
def test_values_of_the_case_leave_the_bits_of_the_case(host: Any, unit: Any) -> None:
    bearings = [host.Instance(unit), host.Instance(unit), host.Instance(unit)]
    starts = {n: float(v[0].get("start")) for n, v in unit.variables.items() if len(v) and v[0].get("start")}
    assert {"lubricant.temperature", "bearing.clearance", "inner_ring.spin"} <= starts.keys()
    for name, value in starts.items():
        assert bearings[0].set(name, value) == host.OK
    moved(bearings[2]).do("Reset")
    for bearing in bearings:
        if bearing is bearings[2]:
            bearing.do("EnterInitializationMode")
        bearing.ready()
        assert [bearing.step(STEP) for _ in range(3)] == [host.OK] * 3
    outputs = unit.named("output")
    assert bearings[0].get(outputs) == bearings[1].get(outputs) == bearings[2].get(outputs)


@pytest.mark.full
def test_temperature_is_an_input_that_changes_while_the_bearing_turns(host: Any, unit: Any) -> None:
    bearing, film = host.Instance(unit).ready(), ["bearing.film_minimum"]
    bearing.step(STEP)
    cold, state = bearing.get(film), bearing.packed()
    assert bearing.set("lubricant.temperature", WARM) == host.OK
    (warm,) = bearing.get(film)
    assert 0.4 * cold[0] < warm < 0.8 * cold[0]
    assert bearing.slope(film[0], "lubricant.temperature") < 0.0
    assert bearing.step(STEP) == host.OK
    other = host.Instance(unit).ready()
    kept = bearing.packed()
    assert other.unpack(kept, bearing.time) == host.OK
    assert other.get(["lubricant.temperature", *film]) == [WARM, *bearing.get(film)]
    assert bearing.unpack(state, STEP) == host.OK
    assert bearing.get(film) == cold
    about = unit.variables["lubricant.temperature"]
    assert (about.get("causality"), about[0].get("unit")) == ("input", "K")
    about = unit.variables["bearing.clearance"]
    assert (about.get("causality"), about.get("variability")) == ("parameter", "tunable")
    assert float(about[0].get("max")) == 19e-6


@pytest.mark.full
def test_what_cannot_be_is_answered_with_a_sentence(host: Any, unit: Any) -> None:
    bearing = host.Instance(unit)
    assert bearing.set("lubricant.temperature", 273.15 + 90.0) == host.ERROR
    assert bearing.said[-1] == "lubricant.temperature is to be 363.15 K: it was exported for 303.15 to 333.15 K"
    assert bearing.set("inner_ring.force_x", -1e12) == host.OK
    assert bearing.do("ExitInitializationMode") == host.ERROR
    assert "there is no equilibrium at the start with these inputs" in bearing.said[-1]
    assert bearing.set("inner_ring.force_x", 0.0) == host.OK
    assert bearing.ready().step(STEP) == host.OK


@pytest.mark.full
def test_a_prescribed_bearing_starts_where_its_host_has_the_rings(host: Any, exported: Export, tmp_path: Path) -> None:
    unit = host.Unit(exported(2, "motion"), tmp_path)
    bearing, names = host.Instance(unit), ["inner_ring.reaction_force_x", "inner_ring.reaction_force_z"]
    (x,), before = bearing.get(["inner_ring.x"]), bearing.get(names)
    assert bearing.set("inner_ring.x", x + 5e-6) == host.OK
    assert bearing.set("inner_ring.z", -5e-6) == host.OK
    after = bearing.get(names)
    assert after[0] < 1.1 * before[0] < 0.0
    assert after[1] > abs(before[1]) + 50.0
    bearing.ready()
    assert bearing.step(STEP) == host.OK
    assert bearing.get(names) == pytest.approx(after, rel=2e-2)  # it is an equilibrium


OIL = Varied("oil", "temperature", 300.0, 320.0, 360.0)
GAP = Varied("gap", "length", 1e-6, 4e-6, 9e-6)


def words(values: Mapping[str, float]) -> Any:
    """Return constants that follow options.

    Alone, in a sum, in a product, and one that is a count.
    """
    t, g = values.get("oil", OIL.start), values.get("gap", GAP.start)
    eta = math.exp(900.0 / (t - 180.0))
    return np.array([7.0, eta, 1e6 * g, t + 1e6 * g, eta * g, 5e-324])


def test_curves_follow_what_they_were_made_from() -> None:
    found = {c.word: c for c in constants([OIL, GAP], words({}), words)}
    assert set(found) == {1, 2, 3, 4}
    assert [len(found[w].curves) for w in (1, 2, 3, 4)] == [1, 1, 2, 2]
    assert (found[3].scales, found[4].scales) == (False, True)
    curve = found[1].curves[0]
    where = points(OIL.lowest, OIL.highest, curve.values.size - 1)
    assert curve.values == pytest.approx([words({"oil": t})[1] for t in where], rel=1e-15)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda w, t, g: w * 0.0 + 1.0, "has no effect"),
        (lambda w, t, g: np.append(w, [t] * (t > 330.0)), "selects a model"),
        (lambda w, t, g: w + abs(t - 333.0) * np.array([1, 0, 0, 0, 0, 0]), "a jump or a bend between 300 and 360 K"),
        (lambda w, t, g: w + np.exp(1e-3 * t * g * 1e6) * np.array([1, 0, 0, 0, 0, 0]), "oil and gap act together"),
    ],
)
def test_options_that_no_curve_follows_are_refused(change: Any, sentence: str) -> None:
    def sample(values: Mapping[str, float]) -> Any:
        return change(words(values), values.get("oil", OIL.start), values.get("gap", GAP.start))

    with pytest.raises(UsageError, match=sentence):
        constants([OIL, GAP], sample({}), sample)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("lubricant.temperature", "write path=low..high"),
        ("lubricant.temperature=50..90 degC", "40 degC, is not between 50 degC and 90 degC"),
        ("lubricant.temperature=90..20 degC", "must be below"),
        ("lubricant.temperature=20..90", "the limits have no unit; the case has 40 degC; write .*=20..90 degC"),
        ("lubricant.temperature=20 degC..90 um", "cannot vary"),
        ("lubricant.temperature=cold..90 degC", "is not a number with a unit"),
        ("bearing.designation=1..2", "6208, is not between 1 and 2"),
        ("surface.roughness=0.1..0.2 um", "add --set surface.roughness"),
        ("lubricant.temprature=20..90 degC", "lubricant.temprature is not a known option; nearest: temperature"),
        ("lubricnt.temperature=20..90 degC", "lubricnt is not a known option; nearest: lubricant"),
        ("clearance=4..9 um", "did you mean bearing.clearance"),
    ],
)
def test_a_range_that_is_none_is_refused(text: str, sentence: str) -> None:
    from lambda_core.case.api import case

    with pytest.raises(UsageError, match=sentence):
        varied([text], case(CASE))

"""Test the network of a shaft in several bearings.

Closed forms, balance, symmetry, one bearing as the case of one.
"""

from __future__ import annotations

import math
import tomllib
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from warm_machines import pair

from lambda_core import api
from lambda_core.analysis.thermal.conductances import rod
from lambda_core.analysis.thermal.feedback import Runaway
from lambda_core.analysis.thermal.machine_temperatures import MachineLoop
from lambda_core.analysis.thermal.network import Network
from lambda_core.analysis.thermal.report import SteadyTemperatures
from lambda_core.analysis.thermal.surroundings import long_fin
from lambda_core.analysis.thermal.temperatures import ready_machine_of
from lambda_core.case.written import merged
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.formulas.elastic.sections import BodyMaterial
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.settings.machine_heat import stretch

AIR = 293.15
STEEL = 46.0  # [W/(m K)], 100Cr6
COMPUTED = {"operation": {"temperatures": "computed"}}


@pytest.fixture(scope="module")
def warm() -> SteadyTemperatures:
    """Find the temperatures of the pair once."""
    return api.thermal(pair())


@pytest.fixture(scope="module")
def ready() -> MachineModel:
    """Resolve the pair at its computed temperatures once."""
    return ready_machine_of(pair(**COMPUTED))


def test_a_rod_with_two_sources_and_convection_has_its_closed_form() -> None:
    """Compare a rod with its closed form.

    Three pieces with k A T'' = h P (T - T_a); held at both ends, heat q_1 and q_2 put in between them.

    theta = T - T_a is c_i cosh(m s) + d_i sinh(m s) on each piece; the six numbers follow from the ends, from
    continuity, and from the jumps k A [theta'] = -q at the sources.
    """
    lengths, heat, ends = (0.07, 0.11, 0.05), (40.0, 15.0), (30.0, 5.0)
    diameter, h = 0.03, 35.0
    area, perimeter = math.pi / 4.0 * diameter**2, math.pi * diameter
    m, ka = math.sqrt(h * perimeter / (STEEL * area)), STEEL * area
    matrix, right = np.zeros((6, 6)), np.zeros(6)
    matrix[0, 0], right[0] = 1.0, ends[0]
    for i in range(2):
        c, s = math.cosh(m * lengths[i]), math.sinh(m * lengths[i])
        matrix[1 + 2 * i, 2 * i : 2 * i + 3] = c, s, -1.0
        matrix[2 + 2 * i, 2 * i : 2 * i + 4] = s, c, 0.0, -1.0
        right[2 + 2 * i] = heat[i] / (ka * m)
    matrix[5, 4:], right[5] = (math.cosh(m * lengths[2]), math.sinh(m * lengths[2])), ends[1]
    expected = np.linalg.solve(matrix, right)[[2, 4]] + AIR
    conductance = np.zeros((5, 5))  # left end, two sources, right end, air
    for i, length in enumerate(lengths):
        through, side = rod(length, area, perimeter, h, STEEL)
        conductance[i, i + 1] = conductance[i + 1, i] = through
        conductance[[i, i + 1], 4] += side
        conductance[4, [i, i + 1]] += side
    held = np.array([AIR + ends[0], math.nan, math.nan, AIR + ends[1], AIR])
    network = Network(("a", "b", "c", "d", "air"), conductance, np.array([0.0, *heat, 0.0, 0.0]), held)
    assert network.steady()[1:3] == pytest.approx(expected, rel=1e-12)
    assert network.leaving(network.steady()) == pytest.approx(sum(heat), rel=1e-11)


def test_a_long_rod_is_the_fin_of_a_bearing_alone() -> None:
    d, h = 0.04, 20.0
    through, side = rod(50.0, math.pi / 4.0 * d**2, math.pi * d, h, STEEL)
    assert 2.0 * side == pytest.approx(long_fin(d, h, STEEL), rel=1e-12)
    assert through < 1e-100
    assert rod(0.2, 1e-3, 0.1, 0.0, STEEL) == (pytest.approx(STEEL * 1e-3 / 0.2), 0.0)
    thin = rod(0.2, 1e-3, 0.1, 1e-9, STEEL)
    assert thin == (pytest.approx(STEEL * 1e-3 / 0.2), pytest.approx(0.5 * 1e-9 * 0.1 * 0.2))


def test_growth_is_the_integral_of_the_temperature() -> None:
    steel = BodyMaterial(210e9, 0.3, 7850.0, 12e-6)
    at, warm = np.array([0.1, 0.3]), np.array([20.0, 60.0]) + 273.15
    found = stretch(np.array([0.0, 0.1, 0.2, 0.4]), at, warm, steel)
    # 0 to 0.1 m at 20 degC; to 0.2 m the mean of 0 and 20 K; to 0.4 m the rest of the ramp and 0.1 m at 40 K
    assert found == pytest.approx([0.0, 0.0, 12e-6 * 0.1 * 10.0, 12e-6 * (0.2 * 20.0 + 0.1 * 40.0)], abs=1e-15)


@pytest.mark.full
def test_losses_that_leave_by_the_ends_of_the_shaft_have_their_closed_form() -> None:
    """Compare a shaft's temperatures with its closed form.

    Only the shaft joins the bearings: a rod with two point sources and held ends.

    T = T_0 + (T_L - T_0) x/L + sum q_i/(k A) G(x, x_i), G = x (L - x_i)/L below x_i, x_i (L - x)/L above it.
    """
    joints = {
        name: {"between": [f"{name}.inner_ring", f"{name}.shaft"], "conductance": "9 W/K"} for name in ("left", "right")
    }
    ends = {"shaft_begin": {"temperature": "25 degC"}, "shaft_end": {"temperature": "45 degC"}}
    # what is lost in the belt's bearing differs from the other one's
    case = pair(
        loads={"belt": {"at": "80 mm", "force_z": "-600 N"}}, operation={"speed": "500 rpm"},
        thermal={"conductances": "none", "links": joints, "nodes": ends},
    )  # fmt: skip
    found = api.thermal(case)
    q = [found.bearings[name].state.power_loss_W for name in ("left", "right")]
    assert q[0] > 1.05 * q[1] > 0.1
    length, places = 0.2, (0.05, 0.15)
    ka = api.check(case).heat.material.thermal_conductivity * math.pi / 4.0 * 0.04**2

    def green(x: float, source: float) -> float:
        return min(x, source) * (length - max(x, source)) / length

    for name, x in zip(("left", "right"), places, strict=True):
        rise = sum(heat / ka * green(x, source) for heat, source in zip(q, places, strict=True))
        expected = 25.0 + 20.0 * x / length + rise
        assert found.temperatures_degC[f"{name}.shaft"] == pytest.approx(expected, abs=2e-3)  # the search ends at 1e-3
    assert abs(found.energy_residual) < 1e-9


def test_equal_bearings_have_equal_temperatures(warm: SteadyTemperatures) -> None:
    found = warm
    at = found.temperatures_degC
    for part in ("inner_ring", "outer_ring", "balls", "oil", "shaft"):
        assert at[f"left.{part}"] == pytest.approx(at[f"right.{part}"], abs=0.01)
    along = [place.temperature_degC for place in found.shaft]
    assert along == pytest.approx(along[::-1], abs=0.01)
    assert at["left.balls"] > at["left.inner_ring"] > at["left.shaft"] > at["shaft_begin"] > at["ambient"]
    losses = sum(one.state.power_loss_W for one in found.bearings.values())
    assert sum(found.heat_W.values()) == pytest.approx(losses, rel=1e-9)
    assert abs(found.energy_residual) < 1e-9
    out = sum(flow.heat_W for flow in found.flows if flow.target == "ambient")
    assert out == pytest.approx(losses, rel=1e-9)


def test_a_machine_of_one_bearing_is_the_bearing_alone() -> None:
    """Compare a machine of one bearing with it.

    The shaft has no way out for heat.
    """
    alone = api.thermal(
        {
            "name": "alone",
            "bearing": {"designation": "SKF 6208", "clearance": "12 um"},
            "lubricant": {"name": "FVA3A", "temperature": "50 degC"},
            "loads": {"radial": "2 kN"},
            "operation": {"speed": "3000 rpm"},
            "depth": {"cage": False},
            "thermal": {"conductances": "palmgren"},
        }
    )
    case = {
        "name": "one",
        "shaft": {"sections": [{"length": "60 mm", "diameter": "40 mm"}]},
        "bearings": {"only": {"designation": "SKF 6208", "at": "30 mm", "clearance": "12 um"}},
        "loads": {"weight": {"at": "30 mm", "force_z": "-2 kN"}},
        "connections": {"guide": {"at": "30 mm", "tilt_y": "1000 N m/mrad", "tilt_z": "1000 N m/mrad"}},
        "operation": {"speed": "3000 rpm"},
        "lubricant": {"name": "FVA3A", "temperature": "50 degC"},
        "gravity": {"z": "0 m/s2"},
        "thermal": {"conductances": "palmgren"},
    }
    found = api.thermal(case)
    assert found.power_loss_W == pytest.approx(alone.power_loss_W, rel=1e-3)
    for name in ("inner_ring", "outer_ring", "balls", "oil", "cage", "shaft"):
        assert found.temperatures_degC[f"only.{name}"] == pytest.approx(alone.temperatures_degC[name], abs=0.05)
    assert found.temperatures_degC["housing"] == pytest.approx(alone.temperatures_degC["housing"], abs=0.05)
    assert found.gain.viscosity == pytest.approx(alone.gain.viscosity, rel=0.05)  # slopes of 2 K away


@pytest.mark.full
def test_the_loss_of_a_gear_warms_the_shaft(warm: SteadyTemperatures) -> None:
    """Add a gear's loss as another source.

    The small force of its mesh aside, the pair is the same.
    """
    gear = {"gears": {"wheel": {"at": "100 mm", "pitch_diameter": "90 mm", "torque": "20 N m", "role": "driven"}}}
    gear["gears"]["wheel"]["mesh"] = "90 deg"
    hot = api.thermal(merged(pair(thermal={"nodes": {"wheel": {"heat": "60 W"}}}), gear))
    assert hot.heat_W["wheel"] == pytest.approx(60.0)
    assert hot.temperatures_degC["wheel"] > max(place.temperature_degC for place in warm.shaft) + 5.0
    assert hot.bearings["left"].state.clearance_um < warm.bearings["left"].state.clearance_um
    grown = [case.bearings["right"].growth_um - case.bearings["left"].growth_um for case in (warm, hot)]
    assert grown[1] > grown[0]


@pytest.mark.full
def test_oil_of_one_bearing_takes_its_heat_along() -> None:
    flow = {"oil_flow": "1 l/min", "oil_supply": "30 degC"}
    found = api.thermal(pair(bearings={"left": {"thermal": flow}}))
    at = found.temperatures_degC
    assert at["left.oil"] < at["right.oil"] - 2.0
    carried = next(flow for flow in found.flows if flow.target == "left.oil_supply")
    assert carried.heat_W == pytest.approx(carried.conductance_W_per_K * (at["left.oil"] - 30.0))
    assert "right.oil_supply" not in at


def test_computed_temperatures_reach_the_equilibrium(warm: SteadyTemperatures, ready: MachineModel) -> None:
    found, said = warm, list[str]()
    static = api.quasistatic(pair(**COMPUTED), announce=said.append)
    torques = [bearing.friction_torque_Nmm for bearing in static.bearings.values()]
    expected = [one.state.friction_torque_Nmm for one in found.bearings.values()]
    assert torques == pytest.approx(expected, rel=1e-4)
    assert [bearing.clearance_um for bearing in static.bearings.values()] == pytest.approx(
        [one.state.clearance_um for one in found.bearings.values()], abs=5e-3
    )
    assert any("temperatures found by the thermal network (harris): left inner ring" in line for line in said)
    found_ready = [bearing.friction_torque_Nmm for bearing in api.quasistatic(ready).bearings.values()]
    assert found_ready == pytest.approx(torques, rel=1e-6)


def test_points_found_next_to_others_are_those_of_a_search_anew(warm: SteadyTemperatures) -> None:
    """Move inlets and lengths by the steps of slopes."""
    loop = MachineLoop(api.check(pair(**COMPUTED)))
    seen = loop.seen(np.array([warm.temperatures_degC[name] for name in loop.nodes.names]) + 273.15)
    moved = seen + loop.steps
    anew = loop.solved(moved)
    loop.solved(seen)
    for near, other in zip(loop.solved_near(moved), anew, strict=True):
        assert near.power == pytest.approx(other.power, rel=1e-6)
    assert loop.count == 3


def test_the_case_of_a_warm_machine_needs_no_second_search(ready: MachineModel) -> None:
    assert not ready.awaits_temperatures
    assert "computed" not in ready.case_toml
    again = api.check(tomllib.loads(ready.case_toml))
    assert np.array_equal(again.growth, ready.growth)
    assert ready.growth.any()


@pytest.mark.full
def test_the_losses_of_a_run_give_temperatures_near_its_own(
    warm: SteadyTemperatures, ready: MachineModel, tmp_path: Path
) -> None:
    run = api.run(tomllib.loads(ready.case_toml), ["solver.duration=0.3 ms"], out=tmp_path / "pair.h5")
    assert "computed" not in run.case_toml
    found = api.thermal(run.path)
    assert found.losses_from == f"averages of {run.path}"
    expected = warm
    assert found.power_loss_W == pytest.approx(expected.power_loss_W, rel=0.1)
    assert found.temperatures_degC["housing"] == pytest.approx(expected.temperatures_degC["housing"], abs=4.0)
    with pytest.raises(UsageError, match="accept no overrides"):
        api.thermal(run.path, ["operation.speed=1 rpm"])


def test_a_warm_up_balances_its_heat_and_rises() -> None:
    course = api.warm_up(pair(), 10.0)
    assert course.ended == "finished"
    assert course.time_s[-1] == 10.0
    assert abs(course.energy_residual) < 1e-6
    assert course.heat_in_J == pytest.approx(course.heat_out_J + course.heat_stored_J, rel=1e-6)
    rise = course.temperatures_degC["left.balls"]
    assert rise[0] == pytest.approx(20.0)
    assert all(b > a for a, b in pairwise(rise))
    assert course.bearings["left"].power_loss_W == pytest.approx(course.bearings["right"].power_loss_W, rel=1e-3)
    (picture,) = api.thermal_pictures(course)
    assert [series.name for series in picture.panels[1].series] == ["left", "right"]


@pytest.mark.full
def test_a_machine_settles_in_its_steady_state(warm: SteadyTemperatures) -> None:
    """Cool a machine to its steady state.

    In a housing of little heat capacity, which takes an hour in place of eight.
    """
    light = {"start": "60 degC", "nodes": {"housing": {"heat_capacity": "100 J/K"}}}
    steady, course = warm, api.warm_up(pair(thermal=light), 3600.0)
    for name, value in steady.temperatures_degC.items():
        assert course.temperatures_degC[name][-1] == pytest.approx(value, abs=0.3)


def test_a_machine_that_gets_too_hot_is_refused_in_words() -> None:
    hot = pair(thermal={"limit": "50 degC", "nodes": {"left.inner_ring": {"heat": "400 W"}}})
    with pytest.raises(Runaway, match=r"pair: .*left\.inner ring at .* is beyond thermal.limit = 50 degC"):
        api.thermal(hot)


@pytest.mark.full
def test_the_warm_up_of_a_machine_ends_where_it_gets_too_hot() -> None:
    """End the warm-up at the limit.

    tests/thermal/test_loop.py tests the same for one bearing.
    """
    hot = pair(thermal={"start": "46 degC", "limit": "50 degC", "nodes": {"left.inner_ring": {"heat": "400 W"}}})
    course = api.warm_up(hot, 600.0)
    assert course.ended == "limit"
    assert "passed thermal.limit = 50 degC" in course.reason


@pytest.mark.full
def test_red_heat_is_beyond_the_limit() -> None:
    """End at `thermal.limit` under 2 kW.

    Radiation there once swung the temperatures of the network until it did not settle.
    """
    glowing = pair(thermal={"limit": "80 degC", "nodes": {"left.inner_ring": {"heat": "2 kW"}}})
    with pytest.raises(Runaway, match=r"is beyond thermal\.limit"):
        api.thermal(glowing)


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"thermal": {"ambiant": "20 degC"}}, "thermal.ambiant", "nearest: ambient"),
        ({"thermal": {"ambient": "35 K"}}, "thermal.ambient", "is another unit meant?"),
        ({"thermal": {"conductances": "iso-15312"}}, "thermal.conductances", 'use "harris"'),
        ({"thermal": {"shaft_length": "1 m"}}, "thermal.shaft_length", "has no effect"),
        ({"thermal": {"oil_supply": "40 degC"}}, "thermal.oil_supply", "has no effect without thermal.oil_flow"),
        ({"thermal": {"nodes": {"ambient": {}}}}, "thermal.nodes.ambient", "change that"),
        ({"thermal": {"nodes": {"flange": {}}}}, "thermal.nodes.flange", "has no heat path"),
        ({"thermal": {"conductances": "none"}}, "thermal.links", "a bearing has no heat path"),
        (
            {"thermal": {"links": {"a": {"between": ["left.oil", "housng"], "conductance": "1 W/K"}}}},
            "thermal.links.a.between",
            "nearest: housing",
        ),
        (
            {"bearings": {"left": {"thermal": {"nodes": {"housing": {}}}}}},
            "bearings.left.thermal.nodes.housing",
            "is not a known node",
        ),
        (
            {"bearings": {"left": {"thermal": {"oil_supply": "40 degC"}}}},
            "bearings.left.thermal.oil_supply",
            "has no effect without oil_flow",
        ),
        (
            {"bearings": {"left": {"temperatures": {"balls": "60 degC"}}}} | COMPUTED,
            "bearings.left.temperatures.balls",
            "bearings.left.thermal.nodes.balls.temperature",
        ),
        ({"shaft": {"temperature": "60 degC"}} | COMPUTED, "shaft.temperature", "leave it out"),
        ({"housing": {"temperature": "60 degC"}} | COMPUTED, "housing.temperature", "leave it out"),
        (
            {"bearings": {"left": {"lubricant": {"name": "FVA3X"}}}},
            "bearings.left.lubricant.name",
            "FVA3X",
        ),
        (
            {"shaft": {"temperatures": [["9 mm", "9 degC"]] * 2}},
            "shaft.temperatures",
            "the places must increase",
        ),
    ],
)  # fmt: skip
def test_a_mistake_has_its_path(changes: dict[str, Any], where: str, said: str) -> None:
    with pytest.raises(CaseError) as caught:
        api.check(pair(**changes))
    found = {problem.where: problem.message for problem in caught.value.problems}
    assert list(found) == [where]
    assert said in found[where]


def test_the_oil_of_one_bearing_is_its_own() -> None:
    machine = api.check(pair(bearings={"left": {"lubricant": {"temperature": "80 degC"}}}))
    assert [round(one.model.oil.temperature - 273.15, 6) for one in machine.bearings] == [80.0, 50.0]

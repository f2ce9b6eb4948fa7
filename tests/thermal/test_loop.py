"""Test torque and temperature together: steady, transient, runaway."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from warm_bearings import preloaded

from lambda_core import api
from lambda_core.analysis.thermal.feedback import Runaway
from lambda_core.analysis.thermal.losses import LossMap
from lambda_core.analysis.thermal.operating import BearingLoop
from lambda_core.analysis.thermal.report import State, SteadyTemperatures
from lambda_core.case.written import merged
from lambda_core.domain.errors import CaseError, SolverError


def loop_of(case: dict[str, Any]) -> BearingLoop:
    from lambda_core.case.case_io import bearing_case

    return BearingLoop(api.check(case), bearing_case(case).thermal)


def state_of(found: SteadyTemperatures) -> State:
    """Return the state of the only bearing."""
    return found.bearings["bearing"].state


def test_steady_temperatures_close_the_loop(ordinary: dict[str, Any]) -> None:
    found = api.thermal(ordinary)
    assert abs(found.energy_residual) < 1e-9
    assert sum(found.heat_W.values()) == pytest.approx(found.power_loss_W, rel=1e-9)
    # The quasi-static point at the temperatures found loses what the network was given, to the tolerance of 1e-3 K.
    again = api.quasistatic(
        merged(
            ordinary,
            {
                "bearing": {"clearance": f"{state_of(found).clearance_um!r} um"},
                "lubricant": {"temperature": f"{state_of(found).inlet_degC!r} degC"},
            },
        )
    )
    assert again.friction_torque_Nmm == pytest.approx(state_of(found).friction_torque_Nmm, rel=1e-4)
    assert found.temperatures_degC["balls"] > found.temperatures_degC["outer_ring"] > found.temperatures_degC["ambient"]
    assert found.gain.loop < 1.0
    assert found.gain.viscosity < 0.0


def test_a_hotter_ring_takes_clearance(ordinary: dict[str, Any]) -> None:
    found = api.thermal(merged(ordinary, {"thermal": {"nodes": {"inner_ring": {"heat": "40 W"}}}}))
    t = found.temperatures_degC
    steel, d_i, d_o, ball = 11.5e-6, 0.0480, 0.0719, 0.0119
    taken = steel * ((t["inner_ring"] - 20.0) * d_i - (t["outer_ring"] - 20.0) * d_o + 2.0 * (t["balls"] - 20.0) * ball)
    assert state_of(found).clearance_um == pytest.approx(12.0 - 1e6 * taken, abs=0.15 * 1e6 * abs(taken))
    assert state_of(found).clearance_um < state_of(api.thermal(ordinary)).clearance_um


def test_oil_that_flows_takes_its_heat_along(ordinary: dict[str, Any]) -> None:
    flowing = {"thermal": {"oil_flow": "1 l/min", "oil_supply": "40 degC"}}
    found = api.thermal(merged(ordinary, flowing))
    carried = next(flow for flow in found.flows if flow.target == "oil_supply")
    assert carried.heat_W == pytest.approx(carried.conductance_W_per_K * (found.temperatures_degC["oil"] - 40.0))
    assert carried.conductance_W_per_K == pytest.approx(860.0 / 6e4 * 1950.0, rel=0.05)  # m c of one litre a minute
    assert abs(found.temperatures_degC["oil"] - 40.0) < 5.0


def test_the_surfaces_can_be_what_the_contacts_see(ordinary: dict[str, Any]) -> None:
    found = api.thermal(merged(ordinary, {"thermal": {"inlet": "surfaces"}}))
    t = found.temperatures_degC
    expected = 0.25 * (t["inner_ring"] + t["outer_ring"]) + 0.5 * t["balls"]
    assert state_of(found).inlet_degC == pytest.approx(expected, abs=2e-3)


def test_a_further_node_stands_between_its_neighbours(ordinary: dict[str, Any]) -> None:
    further = {
        "nodes": {"flange": {"heat_capacity": "500 J/K", "heat": "3 W"}},
        "links": {
            "foot": {"between": ["housing", "flange"], "conductance": "2 W/K"},
            "air": {"between": ["flange", "ambient"], "conductance": "1 W/K"},
        },
    }
    t = api.thermal(merged(ordinary, {"thermal": further})).temperatures_degC
    assert t["flange"] == pytest.approx((2.0 * t["housing"] + 1.0 * 20.0 + 3.0) / 3.0, abs=1e-6)


def test_preload_runs_away_and_is_named() -> None:
    calm = api.thermal(preloaded("3000 rpm"))
    assert 0.0 < calm.gain.clearance < 1.0
    with pytest.raises(Runaway, match="thermal runaway through the clearance") as caught:
        api.thermal(preloaded("9000 rpm"))
    assert caught.value.exit_code == SolverError.exit_code
    assert caught.value.gain is not None
    assert caught.value.gain.loop >= 1.0
    assert caught.value.gain.cause == "clearance"
    assert f"{caught.value.gain.loop:.2f}" in str(caught.value)


@pytest.mark.full
def test_the_same_bearing_runs_away_over_time() -> None:
    course = api.warm_up(preloaded("9000 rpm"), 3600.0)
    assert course.ended == "limit"
    assert "thermal runaway through the clearance" in course.reason
    assert course.gain is not None
    assert course.gain.loop >= 1.0
    assert course.time_s[-1] < 3600.0
    assert max(course.temperatures_degC["inner_ring"]) == pytest.approx(200.0, abs=0.01)
    assert abs(course.energy_residual) < 1e-6


def test_a_stable_one_warms_up_to_its_steady_state() -> None:
    """Compare the end of warming with steady state.

    Two ways, to the error of the interpolated map of losses.
    """
    case = preloaded("3000 rpm")
    steady, course = api.thermal(case), api.warm_up(case, 4 * 3600.0)
    for name, value in steady.temperatures_degC.items():
        assert course.temperatures_degC[name][-1] == pytest.approx(value, abs=0.3)
    assert course.ended == "finished"
    assert abs(course.energy_residual) < 1e-6
    assert course.heat_in_J == pytest.approx(course.heat_out_J + course.heat_stored_J, rel=1e-6)


def test_a_loss_too_high_without_feedback_is_no_runaway() -> None:
    held = {"thermal": {"nodes": {"inner_ring": {"heat": "400 W"}}, "limit": "120 degC"}}
    with pytest.raises(Runaway, match=r"does not feed itself|thermal runaway") as caught:
        api.thermal(preloaded("500 rpm", **held))
    assert "thermal.limit = 120 degC" in str(caught.value)


def test_the_map_of_losses_is_what_it_interpolates(ordinary: dict[str, Any]) -> None:
    loop = loop_of(ordinary)
    known = LossMap(loop.losses.at, 313.15, 12e-6)
    corner, middle = known.at(313.15, 12e-6), known.at(314.15, 12.5e-6)
    assert corner.values == pytest.approx(loop.losses.at(313.15, 12e-6).values)
    exact = loop.losses.at(314.15, 12.5e-6)
    assert middle.power == pytest.approx(exact.power, rel=1.5e-3)
    assert middle["viscosity"] == pytest.approx(exact["viscosity"], rel=2.5e-3)


def test_a_point_that_cannot_be_solved_says_where(ordinary: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*arguments: object) -> None:
        raise SolverError("no quasi-static equilibrium")

    monkeypatch.setattr("lambda_core.analysis.thermal.losses.solve", fail)
    with pytest.raises(SolverError, match=r"at 40\.0 degC in the inlets and a clearance of 12\.0 um: no quasi-static"):
        loop_of(ordinary).losses.at(313.15, 12e-6)


def test_over_time_a_further_node_needs_a_capacity(ordinary: dict[str, Any]) -> None:
    link = {"foot": {"between": ["housing", "flange"], "conductance": "2 W/K"}}
    case = merged(ordinary, {"thermal": {"nodes": {"flange": {"heat": "1 W"}}, "links": link}})
    with pytest.raises(CaseError, match=r"thermal\.nodes\.flange\.heat_capacity"):
        api.warm_up(case, 10.0)


def test_computed_temperatures_reach_statics_and_runs(ordinary: dict[str, Any], tmp_path: Path) -> None:
    case = merged(ordinary, {"operation": {"temperatures": "computed"}, "solver": {"duration": "2 ms"}})
    found, said = api.thermal(ordinary), list[str]()
    static = api.quasistatic(case, announce=said.append)
    assert static.friction_torque_Nmm == pytest.approx(state_of(found).friction_torque_Nmm, rel=1e-4)
    assert any("temperatures found by the thermal network (harris): inner ring" in line for line in said)
    run = api.run(case, out=tmp_path / "run.h5")
    assert any("temperatures found by the thermal network" in line for line in run.assumptions)
    assert run.model["oil"]["temperature"] - 273.15 == pytest.approx(state_of(found).inlet_degC, abs=2e-3)
    assert 1e6 * run.model["geometry"]["clearance"] == pytest.approx(state_of(found).clearance_um, abs=5e-3)
    assert "computed" not in run.case_toml  # a result goes on without another search
    longer = api.resume(run.path, ["solver.duration=3 ms"])
    assert longer.integrals()[-1][0] >= 3e-3
    # The run's own losses give temperatures near those that it was made with.
    own = api.thermal(run.path)
    assert own.losses_from.startswith("averages of")
    assert own.power_loss_W == pytest.approx(found.power_loss_W, rel=0.2)
    assert own.temperatures_degC["outer_ring"] == pytest.approx(found.temperatures_degC["outer_ring"], abs=8.0)


def test_nothing_runs_before_the_temperatures_are_found(ordinary: dict[str, Any]) -> None:
    from lambda_core.solver.drivers.equilibrium import solve

    model = api.check(merged(ordinary, {"operation": {"temperatures": "computed"}}))
    with pytest.raises(SolverError, match="temperatures must be computed"):
        solve(model)


def test_pictures_have_what_was_found(ordinary: dict[str, Any], tmp_path: Path) -> None:
    steady, course = api.thermal(ordinary), api.warm_up(ordinary, 30.0)
    (heat,), (time,) = api.thermal_pictures(steady), api.thermal_pictures(course)
    panels = {panel.title: panel for panel in heat.panels}
    assert list(panels) == ["temperatures", "where the heat comes from", "which node gets it", "where it goes"]
    drawn = panels["where it goes"]
    flows = dict(zip(drawn.x.categories, drawn.series[0].y, strict=True))
    assert flows["housing - ambient"] == pytest.approx(
        next(f.heat_W for f in steady.flows if (f.source, f.target) == ("housing", "ambient"))
    )
    balls = next(series for series in time.panels[0].series if series.name == "balls")
    assert balls.y == pytest.approx(np.array(course.temperatures_degC["balls"]))
    assert all(path.stat().st_size > 1000 for view in (heat, time) for path in api.draw(view, tmp_path, "x", ("svg",)))

"""Test the data of each view against run and mechanics."""

from __future__ import annotations

import json
import math
import subprocess
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from lambda_plugins.views.catalogues import catalogues

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import UsageError
from lambda_core.export.report.gallery import data_of
from lambda_core.model.checking import check_bearing
from lambda_core.views.chart import Panel, Series, ViewData
from lambda_core.views.method import NotApplicable

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

OF_A_RESULT = [name for name, view in registry().views.items() if view.subject == "result" and view.offered is None]


def data(run: Any, name: str, **options: Any) -> ViewData:
    return data_of(registry().view(name), run, options)


def series(panel: Panel, name: str) -> Series:
    return next(s for s in panel.series if s.name == name)


@pytest.mark.parametrize("name", OF_A_RESULT)
def test_every_view_shows_a_real_run(radial_run: Result, name: str) -> None:
    found = data(radial_run, name)
    assert found.view == name
    assert found.panels
    for words in (radial_run.case, radial_run.title, "radial 16 kN", "1500 rpm", "FVA3A at", "clearance "):
        assert words in found.source  # what it was: case, bearing, load, speed, oil and temperature, clearance
    for panel in found.panels:
        assert panel.series or panel.field
        for axis in (panel.x, panel.y):
            assert axis.label or axis.categories
        for one in panel.series:
            assert np.isfinite(one.y).any(), one.name
    text = json.dumps(found.as_dict(), allow_nan=False)  # NaN is null
    assert json.loads(text)["view"] == name


@pytest.mark.parametrize("name", OF_A_RESULT)
def test_every_view_shows_a_short_run(combined_run: Result, name: str) -> None:
    assert data(combined_run, name).panels


def test_views_are_data_without_matplotlib(radial_run: Result) -> None:
    code = f"""
import sys
from lambda_core import api
names = {OF_A_RESULT!r}
for name in names:
    api.view({str(radial_run.path)!r}, name)
assert len(names) >= 14 and "matplotlib" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=600)


def test_loads_balance_the_applied_force(radial_run: Result) -> None:
    panel = data(radial_run, "load-distribution").panels[0]
    end = series(panel, "inner ring, end state")
    angle = np.radians(end.x)
    # 16 kN downwards on the inner ring; its balls push back. Its weight and the shaft's add a little.
    weight = -9.81e-3 * radial_run.model["inner_ring"]["mass"]
    assert np.sum(end.y * np.sin(angle)) == pytest.approx(-16.0 + weight, rel=0.01)
    assert abs(np.sum(end.y * np.cos(angle))) < 0.2
    mean = series(panel, "inner ring")
    assert mean.x[np.nanargmax(mean.y)] == pytest.approx(270.0, abs=5.0)
    assert mean.low is not None
    assert mean.high is not None
    assert np.all(mean.low[np.isfinite(mean.y)] <= mean.high[np.isfinite(mean.y)])


def test_any_channel_over_time(radial_run: Result) -> None:
    load = radial_run["load"]
    inner, outer = data(radial_run, "channel", channel="load", ball="2").panels[0].series
    assert (inner.name, outer.name) == ("ball 2, inner", "ball 2, outer")
    assert inner.y[0] == load[0, 1, 0]
    assert outer.y.max() <= load[:, 1, 1].max()
    (every,) = data(radial_run, "channel", channel="load").panels[0].series
    assert every.low is not None
    assert every.high is not None
    assert every.low[0] == load[0].min()
    assert every.high[0] == load[0].max()
    (torque,) = data(radial_run, "channel", channel="bearing_capacitance").panels[0].series
    assert torque.y[0] == radial_run["bearing_capacitance"][0]
    with pytest.raises(UsageError, match='"laod" is not a known channel of this run; nearest: load'):
        data(radial_run, "channel", channel="laod")
    with pytest.raises(NotApplicable, match="has no values of single balls: leave `ball` out"):
        data(radial_run, "channel", channel="bearing_capacitance", ball="2")


def test_points_are_the_contacts_of_the_summary(combined_run: Result) -> None:
    summary = combined_run.summary()
    found = {
        "load": (series(data(combined_run, "load-distribution").panels[0], "outer ring, end state"), 1e-3),
        "angle": (series(data(combined_run, "contact-angle").panels[0], "outer ring, end state"), 1.0),
        "film": (series(data(combined_run, "film").panels[0], "outer ring, end state"), 1.0),
        "capacitance": (series(data(combined_run, "capacitance").panels[0], "outer ring, end state"), 1.0),
    }
    contacts = sorted((c for c in summary.contacts if c.ring == "outer"), key=lambda c: c.azimuth_deg)
    expected = {
        "load": [c.load_N for c in contacts],
        "angle": [c.contact_angle_deg for c in contacts],
        "film": [c.film_um for c in contacts],
        "capacitance": [c.capacitance_pF for c in contacts],
    }
    for name, (points, factor) in found.items():
        np.testing.assert_allclose(points.y, factor * np.array(expected[name], float), rtol=1e-12)
        np.testing.assert_allclose(points.x, [c.azimuth_deg for c in contacts], rtol=1e-12)
    assert 13.0 < np.mean(found["angle"][0].y) < 18.0


def test_lambda_is_film_over_roughness_and_pressure_peaks_as_the_summary_says(radial_run: Result) -> None:
    film, parameter = data(radial_run, "film").panels
    for ring in ("inner ring", "outer ring"):
        np.testing.assert_allclose(
            series(parameter, ring).y, series(film, ring).y * 1e-6 / radial_run.model["roughness"], rtol=1e-12
        )
    highest = series(data(radial_run, "pressure").panels[0], "inner ring").high
    assert highest is not None
    assert np.nanmax(highest) == pytest.approx(radial_run.summary().max_pressure_GPa, rel=1e-12)


def test_simulation_and_catalogues_stand_on_one_axis(radial_run: Result, combined_run: Result) -> None:
    summary = radial_run.summary()
    assert summary.rating is not None
    panel = data(radial_run, "catalogues").panels[0]
    assert panel.x.categories == ("simulation", "SKF", "Schaeffler")
    sums = np.nansum([s.y for s in panel.series], axis=0)
    expected = [summary.friction_torque_Nmm, summary.rating.skf_torque_Nmm, summary.rating.schaeffler_torque_Nmm]
    np.testing.assert_allclose(sums, np.array(expected, float), rtol=1e-9)
    neighbour = api.view([radial_run, combined_run], "comparison").panels[1]
    assert [s.name for s in neighbour.series] == ["simulation", "SKF", "Schaeffler"]
    assert series(neighbour, "SKF").y[0] == summary.rating.skf_torque_Nmm


@pytest.mark.parametrize(
    ("torque", "words"), [(None, "no mean friction torque"), (3.0, "neither SKF's nor Schaeffler's")]
)
def test_a_missing_comparison_has_one_reason(torque: float | None, words: str) -> None:
    """Do not suspect a bearing that turns to stand still."""
    run: Any = SimpleNamespace(summary=lambda: SimpleNamespace(rating=None, friction_torque_Nmm=torque))
    with pytest.raises(NotApplicable, match=words):
        catalogues(run, {})


def test_friction_adds_up_and_its_mean_is_the_summarys(radial_run: Result) -> None:
    summary = radial_run.summary()
    panel = data(radial_run, "friction-breakdown").panels[0]
    assert np.nansum([s.y for s in panel.series]) == pytest.approx(summary.friction_torque_Nmm, rel=1e-9)
    names = panel.x.categories
    rolling = sum(np.nan_to_num(s.y)[names.index("rolling")] for s in panel.series)
    parts = summary.friction_breakdown_Nmm
    assert rolling == pytest.approx(parts["rolling_inner"] + parts["rolling_outer"], rel=1e-12)
    found = data(radial_run, "convergence").panels[0]
    mean = found.series[-1]
    assert mean.y[0] == summary.friction_torque_Nmm
    assert mean.high is not None
    assert mean.high[0] - mean.y[0] == pytest.approx(summary.friction_torque_ci_Nmm, rel=1e-9)
    turns = series(found, "one cage revolution").y
    assert np.mean(turns[summary.revolutions_discarded :]) == pytest.approx(summary.friction_torque_Nmm, rel=1e-3)


def test_energies_close_as_the_summary_says(radial_run: Result) -> None:
    flow, rest = data(radial_run, "energy-balance").panels
    put, gone, stored = (s.y for s in flow.series)
    assert 1e-3 * rest.series[0].y[-1] == pytest.approx(radial_run.summary().energy_residual, rel=1e-9)
    assert abs(put[-1] - gone[-1] - stored[-1]) < 1e-3 * put[-1]


def test_speeds_over_kinematics_are_near_one_where_balls_are_loaded(radial_run: Result, combined_run: Result) -> None:
    orbit, spin, slip = data(combined_run, "element-speeds").panels
    for panel in (orbit, spin):
        np.testing.assert_allclose(panel.series[0].y[np.isfinite(panel.series[0].y)], 1.0, atol=0.01)
    assert np.nanmax(np.abs(series(slip, "outer ring").y)) < 0.1
    loaded = data(radial_run, "element-speeds").panels[0].series[0]
    bottom = (loaded.x > 240.0) & (loaded.x < 300.0)
    np.testing.assert_allclose(loaded.y[bottom], 1.0, atol=0.01)


def test_the_cage_stays_in_its_clearance_and_turns_as_the_summary_says(radial_run: Result) -> None:
    orbit, close_up, _, speed = data(radial_run, "cage-orbit").panels
    assert close_up.series[0].x is orbit.series[0].x  # the weight keeps the cage in a corner: shown enlarged
    path, circle = series(orbit, "centre of the cage"), series(orbit, "pocket clearance")
    radius = math.hypot(circle.x[0], circle.y[0])
    assert radius == pytest.approx(0.5e6 * radial_run.model["cage"]["pocket_clearance"], rel=1e-9)
    assert np.hypot(path.x, path.y).max() < 1.3 * radius  # balls lead and lag: the circle is not sharp
    mean = np.mean(series(speed, "cage speed").y)
    assert mean == pytest.approx(radial_run.summary().cage_speed_over_epicyclic, rel=1e-3)


@pytest.mark.parametrize(("turns", "spin"), [(0.5, 60.0), (1.0, -60.0), (-2.0, 60.0)])
def test_whirl_is_the_speed_of_the_centre_over_that_of_the_cage(turns: float, spin: float) -> None:
    """Compare whirl with turns on a circle.

    The centre goes round `turns` times while the cage turns once.
    """
    from lambda_plugins.views.cage import _whirl

    time = np.linspace(0.0, 0.5, 2001)
    angle = turns * spin * time
    away = 80.0 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    (found,) = _whirl(time, away, np.full(time.size, spin))
    np.testing.assert_allclose(found.y, turns, rtol=1e-4)
    assert found.x[0] == pytest.approx(1e3 * 0.05 * 2.0 * math.pi / 60.0, rel=1e-3)


def test_the_ring_orbits_its_mean_place(radial_run: Result) -> None:
    orbit, over_time = data(radial_run, "ring-orbit").panels
    path = series(orbit, "whole span")
    assert (orbit.x.unit, orbit.y.unit, over_time.x.unit) == ("um", "um", "ms")
    assert path.x.mean() == pytest.approx(0.0, abs=0.05)
    assert path.y.mean() == pytest.approx(0.0, abs=0.05)
    end = 1e6 * radial_run["body_position"][-1, 0]
    traces = {name: series(over_time, name) for name in "xyz"}
    since = radial_run["time"] >= 1e-3 * traces["z"].x[0] - 1e-12
    mean = 1e6 * radial_run["body_position"][since, 0].mean(axis=0)
    for k, name in enumerate("xyz"):
        assert traces[name].y[-1] == pytest.approx(end[k] - mean[k], abs=1e-6)
    # Balls that pass one by one and in pairs move the ring across the load more than along it.
    assert np.ptp(path.x) > 3.0 * np.ptp(path.y)


def test_a_spectrum_reads_the_amplitude_of_a_sine() -> None:
    from lambda_plugins.views.common import spectrum

    time = np.arange(4096) / 2048.0
    values = 3.0 + 0.7 * np.sin(2.0 * np.pi * 100.0 * time) + 0.01 * np.sin(2.0 * np.pi * 333.0 * time)
    frequency, amplitude = spectrum(time, values)
    assert frequency[np.argmax(amplitude)] == pytest.approx(100.0, abs=0.5)
    assert amplitude.max() == pytest.approx(0.7, rel=1e-3)
    assert amplitude[np.argmin(np.abs(frequency - 333.0))] == pytest.approx(0.01, rel=1e-3)
    with pytest.raises(NotApplicable, match="too few"):
        spectrum(time[:5], values[:5])


def test_the_ring_moves_with_the_balls_passing_the_outer_ring(radial_run: Result) -> None:
    panels = data(radial_run, "ring-spectrum").panels
    assert [panel.title for panel in panels] == ["along x", "along y", "along z"]
    panel = panels[1]
    marks = {mark.label: mark.value for mark in panel.marks}
    # Harris and Kotzalas, ch. 10: BPFO = Z/2 (1 - gamma) n, BPFI = Z/2 (1 + gamma) n, gamma = D cos(alpha)/d_m. Nothing
    # loads the bearing axially, but rounding grows to contact angles of milliradians: 1e-6 of the frequencies.
    _, over_time = data(radial_run, "ring-orbit").panels
    first = 1e-3 * over_time.series[0].x[0]
    since = radial_run["time"] >= first - 1e-12
    load, angle = radial_run["load"][since], radial_run["contact_angle"][since]
    cosine = (load * np.cos(angle)).sum() / load.sum()
    gamma = cosine * radial_run.model["geometry"]["ball_diameter"] / radial_run.model["geometry"]["pitch_diameter"]
    assert marks["BPFO"] == pytest.approx(4.5 * (1.0 - gamma) * 25.0, rel=1e-6)
    assert marks["BPFI"] == pytest.approx(4.5 * (1.0 + gamma) * 25.0, rel=1e-6)
    assert marks["2 BSF"] == pytest.approx(2.0 * marks["BSF"], rel=1e-12)
    assert marks["FTF"] == pytest.approx(0.5 * (1.0 - gamma) * 25.0, rel=1e-6)
    assert marks["BSF"] == pytest.approx(0.5 * cosine / gamma * (1.0 - gamma**2) * 25.0, rel=1e-6)
    across = series(panel, "y")
    step = across.x[1] - across.x[0]
    assert across.x[np.argmax(across.y)] == pytest.approx(marks["BPFO"], abs=1.5 * step)


def test_the_capacitance_swings_with_the_balls_passing(radial_run: Result) -> None:
    contacts, spectrum, complete = data(radial_run, "capacitance").panels
    marks = {mark.label: mark.value for mark in spectrum.marks}
    line = spectrum.series[0]
    assert line.x[np.argmax(line.y)] == pytest.approx(marks["BPFO"], rel=0.05)
    values = radial_run["bearing_capacitance"]
    assert complete.series[0].y[-1] == pytest.approx(1e12 * values[-1])
    inner = series(contacts, "inner ring")
    assert inner.x[np.nanargmax(inner.y)] == pytest.approx(270.0, abs=10.0)


def test_pocket_forces_are_those_of_the_channel(radial_run: Result) -> None:
    along, over_time = data(radial_run, "pocket-forces").panels
    rows = radial_run["time"] >= over_time.series[0].x[0] * 1e-3 - 1e-12
    force = radial_run["pocket_force"][rows]
    assert over_time.series[0].y.max() == pytest.approx(np.linalg.norm(force, axis=2).max(), rel=1e-12)
    assert along.series[0].high is not None
    assert np.nanmax(along.series[0].high) == pytest.approx(force[:, :, 2].max(), rel=1e-12)


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_a_contact_map_is_the_contact_of_the_run(radial_run: Result, ring: str) -> None:
    found = data(radial_run, "contact-map", ring=ring)
    index = 0 if ring == "inner" else 1
    load = radial_run["load"][-1, :, index]
    ball = int(load.argmax())
    assert f"ball {ball + 1}," in found.notes[0]
    pressure = found.panels[0].field
    assert pressure is not None
    assert pressure.values.max() == pytest.approx(1e-9 * radial_run["max_pressure"][-1, ball, index], rel=5e-3)
    slip = found.panels[1].field
    assert slip is not None
    assert slip.lines is not None
    centre = slip.lines.shape[0] // 2
    middle = slip.lines[centre].mean()
    assert middle == pytest.approx(radial_run["slip"][-1, ball, index], abs=2e-3)
    # Heathcote: two lines without slip, symmetric to the middle when there is no spin.
    signs = np.sign(slip.lines[:, 0])
    assert np.count_nonzero(np.diff(signs)) == 2
    film = found.panels[3].field
    assert film is not None
    assert film.values.min() == pytest.approx(1e6 * radial_run["film_central"][-1, ball, index], rel=1e-5)
    assert film.values.max() > 3.0 * film.values.min()


def test_the_contact_field_carries_the_load_and_the_loss(radial_run: Result) -> None:
    from lambda_core.solver.drivers.contact_field import contact_field, contact_state
    from lambda_core.solver.drivers.equilibrium import solve

    context = solve(check_bearing(api.case("6319-cp10-1500"))).context
    names = [channel.name for channel in radial_run.channels]
    sample = radial_run.sample(-1, names)
    ball = int(sample["load"][:, 0].argmax())
    depth = radial_run.model["depth"]
    for index, ring in enumerate(("inner", "outer")):
        state = contact_state(sample, ball, ring)
        same = contact_field(context, *state, index, depth["strips"], depth["rows"])
        # The contact angles at which the radii are frozen are found again, to 1e-4 rad.
        assert same.load == pytest.approx(sample["load"][ball, index], rel=1e-6)
        assert same.film == pytest.approx(sample["film_central"][ball, index], rel=1e-5)
        # Sliding is a small difference of large speeds.
        assert same.loss == pytest.approx(sample["contact_loss"][ball, index], rel=1e-3)
        fine = contact_field(context, *state, index, 81, 41)
        assert fine.loss == pytest.approx(same.loss, rel=0.03)
        # The pressure carries the elastic load; the recorded load has the small damping force in it too.
        assert np.sum(fine.pressure * fine.area) == pytest.approx(fine.load, rel=2e-3)
        assert np.sum(fine.area) == pytest.approx(math.pi * fine.semi_axis_a * fine.semi_axis_b, rel=1e-9)


def test_options_of_a_view_are_checked(radial_run: Result) -> None:
    with pytest.raises(UsageError, match='"bal" is not a known option; nearest: ball'):
        data(radial_run, "contact-map", bal=1)
    with pytest.raises(UsageError, match="ball 12 does not exist: this bearing has 9"):
        data(radial_run, "contact-map", ball=12)
    with pytest.raises(UsageError, match="after the end of the run"):
        data(radial_run, "contact-map", time=9.0)
    unloaded = int(radial_run["load"][-1, :, 0].argmin()) + 1
    with pytest.raises(NotApplicable, match=f"ball {unloaded} does not touch the inner ring"):
        data(radial_run, "contact-map", ball=unloaded)
    with pytest.raises(UsageError, match="'inner' or 'outer'"):
        data(radial_run, "contact-map", ring="upper")


def test_results_are_compared_side_by_side(radial_run: Result, combined_run: Result) -> None:
    found = data([radial_run, combined_run], "comparison")
    assert found.panels[0].x.categories == (radial_run.case, combined_run.case)
    total = sum(s.y for s in found.panels[0].series)
    expected = [run.summary().friction_torque_Nmm for run in (radial_run, combined_run)]
    np.testing.assert_allclose(total, expected, rtol=1e-9)
    assert any("not converged" in note for note in found.notes)
    with pytest.raises(NotApplicable, match="at least two"):
        data([radial_run], "comparison")

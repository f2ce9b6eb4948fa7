"""Test the capacitance and circuit of rollers in motion."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lambda_core import api
from lambda_core.analysis.thermal.temperatures import ready_model
from lambda_core.elements.roller.roller_capacitance import penetrations
from lambda_core.elements.roller.roller_equilibrium import single_contact_constant
from lambda_core.formulas.between_rings import between_rings
from lambda_core.formulas.gap_capacitance import VACUUM_PERMITTIVITY
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.results.reader import Result
from lambda_core.results.roller_quasistatic import solve_rollers, with_friction
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.records import CONTACT_CHANNELS

PERMITTIVITY = 2.2  # the law constant's default
SMOOTH = ["surface.roughness=0.02 um", "models.permittivity=constant", "solver.duration=3 ms"]

MOTOR = {
    "name": "motor",
    "operation": {"speed": "3000 rpm"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "surface": {"roughness": "0.02 um"},
    "shaft": {"sections": [{"length": "280 mm", "diameter": "40 mm"}]},
    "bearings": {
        "drive": {"designation": "SKF NU 208 ECP", "at": "20 mm"},
        "other": {"designation": "SKF 6308", "at": "260 mm"},
    },
    "loads": {"belt": {"at": "5 mm", "force_z": "-3 kN"}},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Result:
    folder = tmp_path_factory.mktemp("rollers")
    case = api.init_case("nu", bearing="SKF NU 208 ECP", path=folder / "nu.toml")
    return api.run(case, SMOOTH, out=folder / "nu.h5")


@pytest.fixture(scope="module")
def still(run: Result) -> QuasiStatic:
    found = api.quasistatic(run.path.with_name("nu.toml"), SMOOTH[:2], band=False)
    assert isinstance(found, QuasiStatic)
    return found


def test_the_quasi_static_capacitance_is_that_of_the_run_at_its_start(run: Result, still: QuasiStatic) -> None:
    """Compare the same laws with films of slices."""
    assert still.bearing_capacitance_nF == pytest.approx(1e9 * float(run["bearing_capacitance"][0]), rel=0.03)
    for ring, name in enumerate(("inner", "outer")):
        found = max(one.capacitance_pF for one in still.contacts if one.ring == name)
        assert found == pytest.approx(1e12 * float(run["capacitance"][0, :, ring].max()), rel=0.05)
    open_one = min(one.capacitance_pF for one in still.contacts)
    assert open_one == pytest.approx(1e12 * float(run["capacitance"][0].min()), rel=0.02)


def test_the_quasi_static_contact_is_flats_of_slices_and_the_gaps_at_their_sides(still: QuasiStatic) -> None:
    """Compute the most loaded inner contact by hand.

    Its film and Hertz's widths of its laminae are those of the friction; Hertz's gaps are integrated numerically.
    """
    model = still.solved()
    solved = solve_rollers(model)
    carried = solved.state.inner[0] > 0.0
    loads, film = solved.state.inner[0][carried], float(solved.friction.contact_film["inner"][0])
    width, radius = model.bearing.effective_length / carried.size, model.bearing.radius("inner")
    half = np.sqrt(8.0 * loads / width * radius / (math.pi * model.bearing.modulus("inner")))
    oil = VACUUM_PERMITTIVITY * PERMITTIVITY
    flats = oil * float(np.sum(2.0 * half * width)) / film
    x = half.max() * np.cosh(np.linspace(0.0, math.acosh(radius / half.max()), 200_001))
    xi = np.maximum(x / half.max(), 1.0)
    gap = film + half.max() ** 2 / (2.0 * radius) * (xi * np.sqrt(xi**2 - 1.0) - np.arccosh(xi))
    sides = 2.0 * oil * model.bearing.effective_length * float(np.trapezoid(1.0 / gap, x))
    first = next(one for one in still.contacts if (one.element, one.ring) == (1, "inner"))
    assert first.capacitance_pF == pytest.approx(1e12 * (flats + sides), rel=1e-4)


def test_rollers_in_series_and_parallel_make_the_quasi_static_bearing(still: QuasiStatic) -> None:
    each = np.array([one.capacitance_pF for one in still.contacts]).reshape(-1, 2)
    first = 1e-3 * float(np.sum(1.0 / np.sum(1.0 / each, axis=1)))
    means = [1e9 * one.bearing for one in solve_rollers(still.solved()).electric]
    assert means[0] == pytest.approx(first, rel=1e-9)
    assert still.bearing_capacitance_nF == pytest.approx(float(np.mean(means)), rel=1e-9)


def test_ribs_of_a_tapered_bearing_count_in_its_quasi_static_capacitance() -> None:
    source = {
        "name": "cone",
        "bearing": {"designation": "SKF 32208"},
        "lubricant": {"name": "FVA3", "temperature": "60 degC"},
        "loads": {"axial": "4 kN"},
        "operation": {"speed": "2000 rpm"},
    }
    found, started = api.quasistatic(source, band=False), solve(ready_model(source, is_static=True))
    each = started.contacts[:, :, CONTACT_CHANNELS.index("capacitance")]
    assert found.bearing_capacitance_nF == pytest.approx(1e9 * between_rings(each), rel=0.05)
    means = [np.mean([one.capacitance_pF for one in found.contacts if one.ring == name]) for name in ("inner", "outer")]
    assert means[0] > 2.0 * means[1]  # the raceways alone differ by a tenth


def test_the_quasi_static_capacitance_is_continuous_where_rollers_lift_off(still: QuasiStatic) -> None:
    model = still.solved()
    solved = solve_rollers(model, (0.0,))
    deep = penetrations(model.bearing, solved.state)["inner"].max(axis=1)
    roller = int(np.argmin(np.where(deep > 0.0, deep, np.inf)))
    steps = np.array([-1e-9, -1e-12, 1e-12, 1e-9])
    found = []
    for step in steps:
        moved = solved.state.rollers.copy()
        moved[roller, 1] += deep[roller] - step
        closed = np.maximum(penetrations(model.bearing, replace(solved.state, rollers=moved))["inner"], 0.0)
        inner = single_contact_constant(model.bearing.effective_length) / closed.shape[1] * closed ** (10.0 / 9.0)
        at = replace(solved, states=(replace(solved.state, rollers=moved, inner=inner),))
        found.append(with_friction(model, at).electric[0].contacts[roller, 0])
    np.testing.assert_allclose(found, found[1], rtol=1e-3)


def test_rollers_of_a_tilted_ring_lean_on_ribs_in_the_circuit_alone(tmp_path: Path) -> None:
    """Compare single contacts with and without friction.

    Those with the inner ring agree; the outer ring of the NU has the ribs, whose films the operating point leaves out
    and says so.
    """
    case = api.init_case("nu", bearing="SKF NU 208 ECP", path=tmp_path / "nu.toml")
    tilted = [*SMOOTH[:2], "loads.radial=5 kN", "loads.moment_y=5 N m", "bodies.inner_ring.tilt_y=free"]
    still, found = api.quasistatic(case, tilted, band=False), solve(ready_model(case, tilted, is_static=True))
    each = 1e12 * found.contacts[:, :, CONTACT_CHANNELS.index("capacitance")]
    own = np.array([one.capacitance_pF for one in still.contacts]).reshape(-1, 2)
    pressed = found.contacts[:, 0, CONTACT_CHANNELS.index("load")] > 100.0
    np.testing.assert_allclose(each[pressed, 0], own[pressed, 0], rtol=0.05)
    assert (each[pressed, 1] > 1.2 * own[pressed, 1]).all()
    assert "lean on ribs: electric and run count these films" in still.capacitance_note
    assert api.quasistatic(case, tilted[:3], band=False).capacitance_note == ""


def test_asperities_that_short_slow_rollers_leave_no_capacitance(run: Result) -> None:
    slow = api.quasistatic(run.path.with_name("nu.toml"), ["operation.speed=20 rpm"], band=False)
    assert slow.bearing_capacitance_nF is None
    assert "of a roller: the bearing has no capacitance" in slow.capacitance_note


def test_rollers_at_rest_have_no_capacitance(run: Result) -> None:
    still = api.quasistatic(run.path.with_name("nu.toml"), ["operation.speed=0 rpm"], band=False)
    assert still.bearing_capacitance_nF is None
    assert {one.capacitance_pF for one in still.contacts} == {None}


def test_the_flat_is_a_plate_capacitor_of_the_area_that_carries(run: Result) -> None:
    """Compare C h/(eps_0 eps_r) with the slices' 2 b L.

    It is at most that of the full line, near F/(pi/4 p_max) (Johnson 1985).
    """
    load, a, b = run["load"][-1], run["semi_axis_a"][-1], run["semi_axis_b"][-1]
    carries = load > 100.0
    area = run["capacitance_hertz"][-1] * run["film_central"][-1] / (VACUUM_PERMITTIVITY * PERMITTIVITY)
    assert np.count_nonzero(carries) >= 6
    assert (area[carries] <= 4.0 * (a * b)[carries] * (1.0 + 1e-9)).all()
    mean = load[carries] / (0.25 * math.pi * run["max_pressure"][-1][carries])
    np.testing.assert_allclose(area[carries], mean, rtol=0.15)  # of slices under less than the largest pressure


def test_gaps_at_the_sides_add_to_the_flat_and_open_rollers_have_less(run: Result) -> None:
    load, found, flat = run["load"][-1], run["capacitance"][-1], run["capacitance_hertz"][-1]
    assert np.isfinite(found).all()
    assert (found[load > 0.0] > flat[load > 0.0]).all()
    open_ones = found[load == 0.0]
    assert open_ones.size
    assert open_ones.min() > 0.0
    assert open_ones.max() < found[load > 100.0].min()


def test_rollers_are_two_contacts_in_series_and_parallel_to_each_other(run: Result) -> None:
    inner, outer = run["capacitance"][-1].T
    assert float(run["bearing_capacitance"][-1]) == pytest.approx(
        float((inner * outer / (inner + outer)).sum()), rel=1e-9
    )
    summary = run.summary()
    assert summary.bearing_capacitance_nF == pytest.approx(1e9 * float(run["bearing_capacitance"][-1]))


def test_a_bearing_with_rollers_stands_in_a_circuit(run: Result) -> None:
    """Compare the circuit's capacitance with the run's mean.

    The mean lies between the ends of the capacitance.
    """
    outcome = api.electric(run.path).outcome
    low, *_, high = outcome.bearing_capacitance_pF
    assert 0.9 * low <= 1e12 * float(np.mean(run["bearing_capacitance"])) <= 1.1 * high
    assert abs(outcome.charge_residual) < 1e-6


@pytest.mark.full
def test_a_motor_of_rollers_and_balls_has_one_circuit() -> None:
    outcome = api.electric(MOTOR).outcome
    assert set(outcome.bearings) == {"drive", "other"}
    assert min(outcome.bearings["drive"].bearing_capacitance_pF) > 0.0
    assert abs(outcome.energy_residual) < 1e-6


def test_rollers_at_rest_pass_nothing() -> None:
    with pytest.raises(api.UsageError, match="at rest no roller passes"):
        api.electric(MOTOR, ["operation.speed=0 rpm"])

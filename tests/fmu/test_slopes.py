"""Test directional derivatives.

The solver's Jacobian against differences, this instant, the start, seeds of any size.
"""

from __future__ import annotations

import ctypes as c
import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.stiffness import stiffness_matrix

CASE = "6208-axial-1300"
STEP = 2e-5  # [s]
Export = Callable[[int, str], Path]
RINGS = ("inner_ring", "outer_ring")
POSES = [f"{ring}.{dof}" for ring in RINGS for dof in ("x", "y", "z", "tilt_y", "tilt_z")]
# Along and about the same axes; nothing prescribes rings about the shaft.
REACTIONS = [
    f"{ring}.reaction_{kind}" for ring in RINGS for kind in ("force_x", "force_y", "force_z", "moment_y", "moment_z")
]
BY = {"": (1e-9, 1e-8), "_rate": (1e-6, 1e-5)}  # [m, rad], [m/s, rad/s] steps of differences


def unit_of(host: Any, exported: Export, tmp_path: Path, couple: str) -> Any:
    """Return an unpacked FMU."""
    return host.Unit(exported(2, couple), tmp_path / couple)


def slopes(bearing: Any, unknowns: Sequence[str], knowns: Sequence[str]) -> FloatArray:
    """Return derivatives by unknown.

    One row for each, in one call for each known.
    """
    references, n = bearing.unit.references, len(unknowns)
    rows, found, one = (c.c_uint * n)(*(references[name] for name in unknowns)), (c.c_double * n)(), c.c_size_t(1)
    columns = []
    for known in knowns:
        seed = (c.c_double * 1)(1.0)
        assert (
            bearing.do(
                "GetDirectionalDerivative", rows, c.c_size_t(n), (c.c_uint * 1)(references[known]), one, seed, found
            )
            == 0
        )
        columns.append(list(found))
    return np.array(columns).T


def differences(bearing: Any, known: str, by: float) -> FloatArray:
    """Return all reactions' central differences.

    With an input that was set at this communication point.
    """
    (value,) = bearing.get([known])
    found = []
    for side in (1.0, -1.0):
        assert bearing.set(known, value + side * by) == 0
        found.append(bearing.get(REACTIONS))
    assert bearing.set(known, value) == 0
    return (np.array(found[0]) - np.array(found[1])) / (2.0 * by)


def moving(host: Any, unit: Any) -> Any:
    """Return a bearing with prescribed motion.

    Its inner ring is pushed and tilted as it goes.
    """
    bearing = host.Instance(unit).ready()
    (z,) = bearing.get(["inner_ring.z"])
    for name, value in (("z", z), ("z_rate", -2e-3), ("tilt_y_rate", 1e-2), ("x_rate", 1e-3)):
        assert bearing.set(f"inner_ring.{name}", value) == host.OK
    assert [bearing.step(STEP) for _ in range(40)] == [host.OK] * 40
    return bearing


@pytest.mark.full
def test_stiffness_and_damping_are_those_of_differences(host: Any, exported: Export, tmp_path: Path) -> None:
    """Compare both rings' matrices with differences.

    Each entry is over the root of the product of its diagonals; differences are exact to 1e-7.

    The Jacobian itself moves contacts by 1e-8 m and 1e-5 of their penetration, one-sided: 2e-4 in stiffness.
    """
    bearing = moving(host, unit_of(host, exported, tmp_path, "motion"))
    for name in POSES:  # from here on
        for more in ("", "_rate"):
            bearing.set(name + more, bearing.get([name + more])[0])
    before = bearing.get(bearing.unit.named("output"))
    for more, tolerance in (("", 5e-4), ("_rate", 1e-5)):
        knowns = [name + more for name in POSES]
        found = slopes(bearing, REACTIONS, knowns)
        expected = np.array([differences(bearing, name, BY[more]["tilt" in name]) for name in knowns]).T
        size = np.sqrt(-np.diag(expected))
        assert np.isfinite(size).all()
        assert np.abs(found - expected).max() > 0.0  # they are not the same numbers
        assert (np.abs(found - expected) / np.outer(size, size)).max() < tolerance
    speed = differences(bearing, "inner_ring.spin", 1e-4)
    assert slopes(bearing, REACTIONS, ["inner_ring.spin"])[:, 0] == pytest.approx(speed, abs=1e-4 * np.abs(speed).max())
    assert not slopes(bearing, REACTIONS, ["inner_ring.x_acceleration", "inner_ring.spin_rate"]).any()
    assert bearing.get(bearing.unit.named("output")) == before


@pytest.mark.full
def test_slopes_with_rates_are_those_of_this_instant(host: Any, exported: Export, tmp_path: Path) -> None:
    """Compare with central differences about the motion.

    The step goes on without setting anew; set and restore give the differences.
    """
    unit, step = unit_of(host, exported, tmp_path, "motion"), 1e-4
    bearing, forces, rate, acceleration = host.Instance(unit).ready(), REACTIONS[0], 1e-3, 5.0
    (x,) = bearing.get(["inner_ring.x"])
    for name, value in (("x", x), ("x_rate", rate), ("x_acceleration", acceleration)):
        assert bearing.set(f"inner_ring.{name}", value) == host.OK
    assert bearing.step(step) == host.OK
    now = {
        "inner_ring.x": x + rate * step + 0.5 * acceleration * step**2,
        "inner_ring.x_rate": rate + acceleration * step,
        "inner_ring.x_acceleration": acceleration,
    }
    before = bearing.get(unit.named("output"))
    for known, by in (("inner_ring.x_rate", 1e-6), ("inner_ring.x", 1e-9)):
        for unknown in (forces, "bearing.loss"):  # by the Jacobian, by differences of the library's own
            found, seen = bearing.slope(unknown, known), []
            for side in (1, -1):
                state = bearing.save()
                for name, value in now.items():
                    bearing.set(name, value + side * by * (name == known))
                seen += bearing.get([unknown])
                bearing.restore(state, bearing.time)
            assert found == pytest.approx((seen[0] - seen[1]) / (2.0 * by), rel=5e-4)
        assert bearing.slope(forces, known) < 0.0
    assert bearing.get(unit.named("output")) == before


@pytest.mark.full
def test_who_asks_for_slopes_changes_nothing(host: Any, exported: Export, tmp_path: Path) -> None:
    """Ask for slopes in motion and compare the bits."""
    unit = unit_of(host, exported, tmp_path, "motion")
    asked, left = moving(host, unit), moving(host, unit)
    outputs = unit.named("output")
    assert asked.get(outputs) == left.get(outputs)
    for _ in range(5):
        slopes(asked, [*REACTIONS, "bearing.film_minimum"], [*POSES, "inner_ring.spin"])
        assert asked.get(outputs) == left.get(outputs)
        assert [asked.step(STEP), left.step(STEP)] == [host.OK] * 2
        assert asked.get(outputs) == left.get(outputs)


@pytest.mark.full
def test_before_it_steps_balls_follow(host: Any, exported: Export, tmp_path: Path) -> None:
    """Derive outputs from an equilibrium during initialisation.

    The slope is the bearing's own stiffness.

    That of the program leaves out friction and centrifugal force's change: 1e-3.
    """
    bearing = host.Instance(unit_of(host, exported, tmp_path, "motion"))
    forces, places = [f"inner_ring.reaction_force_{axis}" for axis in "xyz"], [f"inner_ring.{axis}" for axis in "xyz"]
    start = slopes(bearing, forces, places)
    expected = np.array(stiffness_matrix(solve(api.check(CASE))))[:3, :3]
    assert np.diag(start) == pytest.approx(-np.diag(expected), rel=1e-3)
    (x,) = bearing.get(places[:1])
    seen = []
    for by in (1e-7, -1e-7):
        bearing.set(places[0], x + by)
        seen.append(bearing.get(forces))
    bearing.set(places[0], x)
    assert start[:, 0] == pytest.approx((np.array(seen[0]) - seen[1]) / 2e-7, abs=1e-6 * abs(start[0, 0]))
    bearing.ready()
    at_once = slopes(bearing, forces, places)
    assert 2.0 < at_once[0, 0] / start[0, 0] < 2.3  # both contacts in a row, and the inner one alone
    free = host.Instance(unit_of(host, exported, tmp_path, "force"))
    yields = slopes(free, places, ["inner_ring.force_x"])[:, 0]
    assert yields[0] == pytest.approx(np.linalg.inv(expected)[0, 0], rel=2e-3)
    free.ready()
    assert not slopes(free, [*places, *forces], ["inner_ring.force_x"]).any()  # a force moves nothing at once


@pytest.mark.full
@pytest.mark.parametrize(("couple", "unknown", "known"), [
    ("motion", "inner_ring.reaction_force_x", "inner_ring.x"),
    ("motion", "bearing.loss", "inner_ring.x"),
    ("force", "bearing.film_minimum", "lubricant.temperature"),
])  # fmt: skip
def test_seeds_of_any_size(host: Any, exported: Export, tmp_path: Path, couple: str, unknown: str, known: str) -> None:
    """Scale seeds down to tiny numbers.

    A slope is linear in its seed; seeds beyond all bounds are refused.
    """
    bearing = host.Instance(unit_of(host, exported, tmp_path, couple)).ready()
    one = bearing.slope(unknown, known)
    assert one != 0.0
    for along in (1e-290, -1e-9, 3.0, 1e200):
        assert bearing.slope(unknown, known, along) == pytest.approx(along * one, rel=1e-9)
    if abs(one) > 1e3:
        assert bearing.slope(unknown, known, 1e-310) == pytest.approx(1e-310 * one, rel=1e-9)
        with pytest.raises(ArithmeticError, match=f"the slope of {unknown} is beyond any number"):
            bearing.slope(unknown, known, 1e306)
    for along in (math.nan, math.inf):
        with pytest.raises(ArithmeticError, match=f"a slope along .* of {known}: must be finite"):
            bearing.slope(unknown, known, along)
    with pytest.raises(ArithmeticError, match=r"bearing\.load is no input: there are no slopes with it"):
        bearing.slope(unknown, "bearing.load")

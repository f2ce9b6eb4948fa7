"""Test compiled functions of rollers against rigid-body mechanics."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numba
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import single_springs
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.slices import slice_positions
from lambda_core.solver import records
from lambda_core.solver.drivers.roller_tables import write_rib
from lambda_core.solver.roller import kinematics, motion

TAPERED = RollerBearing(
    *("tapered", 16, 17e-3, 22.7e-3, 20.7e-3, 108.5e-3, 80e-3, 140e-3, 35.25e-3, 187e3, 245e3, 28.5e3),
    contact_angle=math.radians(15.64),
)
NU = RollerBearing("NU", 14, 11e-3, 11e-3, 9.56e-3, 60.5e-3, 40e-3, 80e-3, 18e-3, 62e3, 53e3, 6.7e3, rib_height=2e-3)
BEARINGS = pytest.mark.parametrize("bearing", [NU, TAPERED], ids=["NU", "tapered"])


@numba.njit
def line(roller: Any, ring: Any, row: Any, raceway: Any, kin: Any) -> float:
    return kinematics.line_kinematics(roller[0], ring[0], row[0], raceway[0], kin[0])  # type: ignore[no-any-return]


@numba.njit
def rib(roller: Any, ring: Any, row: Any, raceway: Any, kin: Any) -> float:
    return kinematics.rib_kinematics(roller[0], ring[0], row[0], raceway[0], kin[0])  # type: ignore[no-any-return]


@numba.njit
def apply(kin: Any, roller: Any, ring: Any, wrench: Any, on_roller: Any, on_ring: Any) -> None:
    kinematics.apply_roller_wrench(kin[0], roller[0], ring[0], wrench[0], on_roller[0], on_ring[0])


@numba.njit
def rates(roller: Any, wrench: Any, row: Any, rate: Any) -> float:
    motion.roller_rates(roller[0], wrench[0], row[0], rate[0])
    return motion.roller_energy(roller[0], row[0])  # type: ignore[no-any-return]


def make(kind: np.dtype[Any]) -> Any:
    return np.zeros(1, dtype=kind).view(np.recarray)


def row_of(bearing: RollerBearing) -> Any:
    row, polar = make(records.ROW), bearing.inertias
    row.ball_radius, row.ball_mass, row.ball_inertia = 0.5 * bearing.diameter, bearing.mass, polar[0]
    row.transverse_inertia, row.axis_angle, row.cone_angle = polar[1], bearing.angles.roller, bearing.angles.half
    row.length, row.total_length = bearing.effective_length, bearing.length
    row.end_radius = bearing.ribs[0].contact.radius_y if bearing.kind == "tapered" else 0.5
    return row


def roller_of(bearing: RollerBearing, speed: float = 0.0) -> Any:
    """Return a roller at its nominal place.

    With a speed of the inner ring it rolls on both raceways.
    """
    roller, axis = make(records.ROLLER), bearing.angles.roller
    roller.radius = bearing.centre
    roller.azimuth = 0.7
    if speed != 0.0:
        moves = rolling_motion(bearing, speed)
        roller.velocity[0, 2] = moves.cage * bearing.centre
        roller.spin[0] = (
            -math.copysign(moves.spin, speed) + moves.cage * math.cos(axis),
            -moves.cage * math.sin(axis),
            0,
        )
    return roller


def raceway_of(bearing: RollerBearing, ring: str) -> Any:
    """Return a raceway.

    The radius grows with x, so that x is the quasi-static -a.
    """
    raceway, angles, half = make(records.RACEWAY), bearing.angles, 0.5 * bearing.diameter
    side = 1.0 if ring == "outer" else -1.0
    raceway.side, raceway.kind = side, records.LINE
    raceway.cone = angles.outer if ring == "outer" else angles.inner
    raceway.groove_circle = bearing.centre + side * half * math.cos(angles.roller)
    raceway.axial_offset = -side * half * math.sin(angles.roller)
    return raceway


def body(spin: float = 0.0) -> Any:
    found = make(records.BODY_STATE)
    found.spin = spin
    return found


@BEARINGS
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_slices_approach_as_the_quasi_static_springs(bearing: RollerBearing, ring: str) -> None:
    """Compare derivatives of approach with differences.

    Every slice's approach with the roller's place and tilt, from the compiled geometry.
    """
    count, row, raceway, kin = 40, row_of(bearing), raceway_of(bearing, ring), make(records.KINEMATICS)
    along = slice_positions(bearing.effective_length, count)

    def approaches(x: float, r: float, tilt: float, skew: float = 0.0) -> FloatArray:
        roller = roller_of(bearing)
        roller.x, roller.radius = x, bearing.centre + r
        roller.tilt[0] = (tilt, skew)
        middle = line(roller, body(), row, raceway, kin)
        large_end = np.array([math.cos(raceway.cone[0]), math.sin(raceway.cone[0])]) @ kin.s[0, :2]
        return np.asarray(middle + math.copysign(1.0, large_end) * along * kin.line_tilt[0])

    springs = single_springs(bearing, count)
    half = slice(0, count) if ring == "outer" else slice(count, 2 * count)
    wanted = springs.roller[half] * [-1.0, 1.0, -1.0]  # a = -x, and its turn from a to r is -tilt
    assert approaches(0.0, 0.0, 0.0) == pytest.approx(np.zeros(count), abs=1e-15)
    h = 1e-6
    for column, step in enumerate(h * np.eye(3)):
        found = (approaches(*step) - approaches(*(-step))) / (2.0 * h)
        assert found == pytest.approx(wanted[:, column], abs=1e-5 * max(1.0, float(np.abs(wanted[:, column]).max())))
    assert np.abs(approaches(0.0, 0.0, 0.0, 1e-3)).max() < 2e-8  # skew is of the second order


@BEARINGS
def test_rolling_cones_do_not_slide(bearing: RollerBearing) -> None:
    moves, kin = rolling_motion(bearing, 150.0), make(records.KINEMATICS)
    for ring, spin in (("inner", 150.0), ("outer", 0.0)):
        line(roller_of(bearing, 150.0), body(spin), row_of(bearing), raceway_of(bearing, ring), kin)
        assert kin.slip_t[0] == pytest.approx(0.0, abs=1e-9 * moves.entrainment)
        assert kin.slip_s[0] == pytest.approx(0.0, abs=1e-9 * moves.entrainment)
        assert abs(kin.entrainment_t[0]) == pytest.approx(moves.entrainment, rel=1e-9)
        # cones with one apex turn against each other about their common line: no spin about the normal
        assert kin.rotation_n[0] == pytest.approx(0.0, abs=1e-9 * moves.spin)
        assert abs(kin.rotation_s[0]) == pytest.approx(moves.roller_speed(ring), rel=1e-9)  # type: ignore[arg-type]
        slope = moves.entrainment * math.tan(bearing.angles.half) / (0.5 * bearing.diameter)
        assert abs(kin.entrainment_slope[0]) == pytest.approx(slope, rel=1e-2, abs=1e-9)


@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_a_tilted_roller_keeps_its_rolling_radius(ring: str) -> None:
    """Compare the speed of a leaning cylinder.

    Its material passes everywhere with the speed of its own generatrix.
    """
    moves, kin, tilt = rolling_motion(NU, 150.0), make(records.KINEMATICS), 1e-3
    roller = roller_of(NU, 150.0)
    roller.tilt[0, 0] = tilt
    roller.spin[0] = moves.cage - moves.spin * math.sqrt(1.0 - tilt**2), -moves.spin * tilt, 0.0
    line(roller, body(150.0 if ring == "inner" else 0.0), row_of(NU), raceway_of(NU, ring), kin)
    assert abs(kin.line_tilt[0]) == pytest.approx(tilt, rel=1e-3)
    assert kin.rotation_n[0] == pytest.approx(0.0, abs=1e-3 * moves.spin * tilt)


def test_the_rib_slides_with_its_height() -> None:
    moves, kin, one = rolling_motion(TAPERED, 150.0), make(records.KINEMATICS), TAPERED.ribs[0]
    raceway, row = make(records.RACEWAY), row_of(TAPERED)
    raceway.kind, raceway.side = records.RIB, 1.0
    # the normal of the rib's force on the roller points to -x: that of the roller on the rib to +x
    raceway.rib_angle = math.atan2(-one.normal[1], one.normal[0])
    raceway.rib_radius, raceway.axial_offset = one.contact.distance, -one.place[0]
    delta = rib(roller_of(TAPERED, 150.0), body(150.0), row, raceway, kin)
    assert delta == pytest.approx(0.0, abs=1e-4)  # the end's sphere touches where the pure geometry says, within 0.1 mm
    arm = kin.arm[0]
    height = (arm[1] - one.contact.distance) * math.cos(TAPERED.angles.inner) + one.contact.height
    assert abs(kin.slip_t[0]) == pytest.approx(moves.turning[0] * height, rel=0.02)


@BEARINGS
def test_forces_are_equal_and_opposite(bearing: RollerBearing) -> None:
    """Cancel force and moment of roller and ring.

    About any point.
    """
    rng = np.random.default_rng(3)
    roller, ring, kin, wrench = roller_of(bearing), body(), make(records.KINEMATICS), make(records.WRENCH)
    roller.x, roller.tilt[0] = 1e-5, (1e-3, -2e-3)
    ring.position[0], ring.tilt[0] = rng.normal(size=3) * 1e-5, (1e-3, 5e-4)
    line(roller, ring, row_of(bearing), raceway_of(bearing, "outer"), kin)
    wrench.force[0], wrench.moment[0] = rng.normal(size=3), 1e-2 * rng.normal(size=3)
    on_roller, on_ring = make(records.WRENCH), make(records.WRENCH)
    apply(kin, roller, ring, wrench, on_roller, on_ring)
    c, s = math.cos(roller.azimuth[0]), math.sin(roller.azimuth[0])
    turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
    force, moment = turn @ on_roller.force[0], turn @ on_roller.moment[0]
    centre = np.array([roller.x[0], roller.radius[0] * c, roller.radius[0] * s])
    assert force + on_ring.force[0] == pytest.approx(np.zeros(3), abs=1e-14)
    about_origin = moment + np.cross(centre, force)
    about_origin = about_origin + on_ring.moment[0] + np.cross(ring.position[0], on_ring.force[0])
    assert about_origin == pytest.approx(np.zeros(3), abs=1e-14)


@pytest.mark.parametrize("end", [-1, 1])
@pytest.mark.parametrize("ring", ["inner", "outer"])
def test_ribs_stand_where_the_quasi_static_answer_has_them(ring: str, end: int) -> None:
    """Compare ribs with the quasi-static answer.

    Gap, place, lever and sliding speed of an end on a rib; its force does not turn the roller about its axis.
    """
    bearing, number = replace(NU, kind="NUP"), ("inner", "outer").index(ring)
    one = next(rib for rib in bearing.ribs if (rib.ring, rib.end) == (ring, end))
    row, raceway, kin = row_of(bearing), make(records.RACEWAY), make(records.KINEMATICS)
    row.end_radius = one.contact.end_radius
    write_rib(raceway[0], bearing, number, end)
    spin = 150.0 if ring == "inner" else 0.0
    roller = roller_of(bearing, 150.0)
    assert rib(roller, body(spin), row, raceway, kin) == pytest.approx(-one.gap, rel=1e-4)
    # slip of the end is that of the roller's turning about the line of its contact, the height of the rib's contact
    height, moves = one.contact.height, rolling_motion(bearing, 150.0)
    assert abs(kin.slip_t[0]) == pytest.approx(moves.roller_speed(ring) * height, rel=1e-3)  # type: ignore[arg-type]
    entrainment, _ = moves.rib(one, bearing)
    assert abs(kin.entrainment_t[0]) == pytest.approx(entrainment, rel=1e-3)
    wrench, on_roller, on_ring = make(records.WRENCH), make(records.WRENCH), make(records.WRENCH)
    wrench.force[0] = (0.0, 0.0, -100.0)
    roller.tilt[0] = (2e-3, -1e-3)
    rib(roller, body(spin), row, raceway, kin)
    apply(kin, roller, body(spin), wrench, on_roller, on_ring)
    axis = np.array([math.sqrt(1.0 - 5e-6), 2e-3, -1e-3])
    assert on_roller.moment[0] @ axis == pytest.approx(0.0, abs=1e-12)
    assert on_ring.moment[0, 0] == pytest.approx(0.0, abs=1e-12)
    assert np.sign(on_roller.force[0, 0]) == -end


@BEARINGS
def test_a_free_roller_keeps_energy_and_angular_momentum(bearing: RollerBearing) -> None:
    row, wrench, rate = row_of(bearing), make(records.WRENCH), make(records.ROLLER)
    start = roller_of(bearing, 300.0)
    start.tilt[0] = (5e-3, -3e-3)
    start.spin[0] += (0.0, 40.0, -25.0)

    def slope(_: float, y: FloatArray) -> FloatArray:
        rates(y.view(records.ROLLER).view(np.recarray), wrench, row, rate)
        return rate.view(np.float64).copy()

    def momentum(y: FloatArray) -> FloatArray:
        roller = y.view(records.ROLLER).view(np.recarray)
        b, c, s = bearing.angles.roller, math.cos(roller.azimuth[0]), math.sin(roller.azimuth[0])
        own = np.array([[math.cos(b), -math.sin(b), 0.0], [math.sin(b), math.cos(b), 0.0], [0.0, 0.0, 1.0]])
        turn = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        spin, tilt = roller.spin[0], roller.tilt[0]
        axis = np.array([math.sqrt(1.0 - tilt @ tilt), *tilt])
        polar, transverse = bearing.inertias
        return np.asarray(turn @ own @ (transverse * spin + (polar - transverse) * (spin @ axis) * axis))

    first = start.view(np.float64).copy()
    found = solve_ivp(slope, (0.0, 2e-3), first, rtol=1e-11, atol=1e-13).y[:, -1].copy()
    energy = [rates(y.copy().view(records.ROLLER).view(np.recarray), wrench, row, rate) for y in (first, found)]
    assert energy[1] == pytest.approx(energy[0], rel=1e-9)
    assert momentum(found) == pytest.approx(momentum(first), rel=1e-7, abs=1e-7 * np.linalg.norm(momentum(first)))


def test_the_gyroscopic_moment_is_the_quasi_static_one() -> None:
    """Compare the gyroscopic moment of a cone.

    It keeps the cone on its raceways: without it the axis leaves them at once.
    """
    row, wrench, rate = row_of(TAPERED), make(records.WRENCH), make(records.ROLLER)
    inertial = rolling_motion(TAPERED, 400.0).inertial(TAPERED)
    wrench.force[0, 1], wrench.moment[0, 2] = -inertial[1], inertial[2]  # a = -x turns the sense of the moment
    rates(roller_of(TAPERED, 400.0), wrench, row, rate)
    assert rate.spin[0] == pytest.approx(np.zeros(3), abs=1e-6 * 400.0**2)
    assert rate.tilt[0] == pytest.approx(np.zeros(2), abs=1e-12)
    assert rate.velocity[0] == pytest.approx(np.zeros(3), abs=1e-6 * 400.0**2 * 0.05)

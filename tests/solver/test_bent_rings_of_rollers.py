"""Test elastic rings of roller bearings in the quasi-static equilibrium."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import Ring, RollerBearing
from lambda_core.elements.roller.roller_equilibrium import (
    RollerEquilibrium,
    amplitudes,
    balance,
    single_contact_constant,
)
from lambda_core.formulas.elastic.ring import ElasticRing, RingWaves, shape

from .ring_of_beams import waves_of_beams

NU = RollerBearing(
    "NU", 14, 11e-3, 11e-3, 9.5e-3, 60.5e-3, 40e-3, 80e-3, 18e-3, 62e3, 53e3, 6.7e3, clearance=35e-6, rib_height=2e-3
)
TAPERED = RollerBearing(
    *("tapered", 16, 17e-3, 22.7e-3, 20.7e-3, 108.5e-3, 80e-3, 140e-3, 35.25e-3, 187e3, 245e3, 28.5e3),
    contact_angle=math.radians(15.64),
)
BEARINGS = {"NU": NU, "NJ": replace(NU, kind="NJ"), "needle": replace(NU, kind="needle"), "tapered": TAPERED}
LOADS = {"NU": (0.0, 5e3), "NJ": (1e3, 5e3), "needle": (0.0, 5e3), "tapered": (9e3, 4e3)}
RINGS: tuple[Ring, ...] = ("inner", "outer")


def waves(bearing: RollerBearing, ring: Ring, housing: float, orders: int = 6) -> RingWaves:
    """Return the waves of a ring in a housing [N/m]."""
    side, seat = (-1.0, bearing.bore) if ring == "inner" else (1.0, bearing.outside)
    raceway = bearing.centre + side * 0.5 * bearing.diameter
    height, radius = abs(0.5 * seat - raceway), 0.5 * (0.5 * seat + raceway)
    section = ElasticRing.rectangle(radius, height, bearing.width, 210e9, 7850.0, housing=housing)
    return RingWaves(section, orders, 0.02)


def bent(bearing: RollerBearing, housing: float, rings: tuple[Ring, ...] = RINGS) -> RollerBearing:
    inner, outer = (waves(bearing, ring, housing) if ring in rings else None for ring in RINGS)
    return replace(bearing, inner_waves=inner, outer_waves=outer)


def solved(kind: str, housing: float | None = None, rings: tuple[Ring, ...] = RINGS) -> RollerEquilibrium:
    bearing = BEARINGS[kind] if housing is None else bent(BEARINGS[kind], housing, rings)
    return balance(bearing, np.array([LOADS[kind][0], 0.6 * LOADS[kind][1], 0.8 * LOADS[kind][1], 0.0, 0.0]))


@pytest.mark.parametrize("kind", [*BEARINGS])
def test_in_a_rigid_housing_rings_are_rigid(kind: str) -> None:
    """Compare with rigid rings: loads, place, stiffness.

    1e-5 in a housing of 1e15 N/m, 1e-8 in one of 1e18 N/m.
    """
    rigid = solved(kind)
    assert rigid.waves.shape == (0, 2)
    for housing, slack in ((1e15, 1e-5), (1e18, 1e-8)):
        stiff = solved(kind, housing)
        for name in ("inner", "outer", "ribs", "ring", "stiffness"):
            theirs = getattr(rigid, name)
            assert getattr(stiff, name) == pytest.approx(theirs, abs=slack * float(np.abs(theirs).max(initial=1e-9)))


@pytest.mark.parametrize("kind", [*BEARINGS])
def test_a_soft_housing_spreads_the_load(kind: str) -> None:
    """Give way more, under a smaller largest load.

    The forces stay what they are.
    """
    rigid, firm, soft = solved(kind), solved(kind, 1e9), solved(kind, 1e8)
    largest = [float(state.inner.sum(axis=1).max()) for state in (rigid, firm, soft)]
    assert largest[0] > largest[1] > largest[2]
    moved = [float(np.hypot(*state.ring[1:3])) for state in (rigid, firm, soft)]
    assert moved[0] < moved[1] < moved[2]
    assert soft.loads[:3] == pytest.approx(rigid.loads[:3], abs=1e-5 * largest[0])


@pytest.mark.parametrize("ring", RINGS)
@pytest.mark.parametrize("kind", [*BEARINGS])
def test_the_shape_is_that_of_a_ring_of_beams(kind: str, ring: Ring) -> None:
    """Compare with finite elements.

    They bend as the waves do under the equilibrium's own loads: 1 % of the largest amplitude. Of ribs, too, the radial
    part counts.
    """
    bearing = bent(BEARINGS[kind], 1e8, (ring,))
    state = balance(bearing, np.array([LOADS[kind][0], LOADS[kind][1], 0.0, 0.0, 0.0]))
    side = -1.0 if ring == "inner" else 1.0
    angle = bearing.angles.inner if ring == "inner" else bearing.angles.outer
    outwards = side * math.cos(angle) * getattr(state, ring).sum(axis=1)
    for one, load in zip(bearing.ribs, state.ribs.T, strict=True):
        outwards = outwards - (one.normal[1] * load if one.ring == ring else 0.0)
    section = waves(bearing, ring, 1e8).ring
    bending = section.youngs_modulus * section.second_moment
    forces = np.stack([outwards, np.zeros_like(outwards)], axis=1)
    found = amplitudes(bearing, state)[ring]
    for i, count in enumerate((2, 3)):
        beams = waves_of_beams(
            section.radius, bending, section.bedding, forces, state.azimuths, count, 24 * bearing.count
        )
        assert np.abs(beams - found[i]).max() < 0.01 * float(np.abs(found).max())


def test_two_opposite_rollers_stretch_a_free_ring() -> None:
    """Compare with Timoshenko, Strength of Materials.

    The ring widens by (pi/4 - 2/pi) F R^3/(E I) and narrows across by (2/pi - 1/2) of it.

    Two rollers thicker than the gap between rigid inner and free outer ring press it apart like those of a planet gear;
    the force follows from the widening and the approach of the contacts alone. Orders up to 12 leave out 0.07 % of the
    widening.
    """
    interference = 40e-6  # of each roller
    pair = replace(NU, count=2, profile="none", clearance=-2.0 * interference)
    ring = waves(pair, "outer", 0.0, orders=12)
    state = balance(replace(pair, outer_waves=ring), np.zeros(5), held=(True,) * 5)
    unit = ring.ring.radius**3 / (ring.ring.youngs_modulus * ring.ring.second_moment)
    widening, constant = math.pi / 4.0 - 2.0 / math.pi, single_contact_constant(pair.effective_length)

    def gap(force: float) -> float:
        return 2.0 * float((force / constant) ** 0.9) + 0.5 * widening * force * unit - interference

    force = float(brentq(gap, 1.0, 1e5))
    assert state.outer.sum(axis=1) == pytest.approx([force, force], rel=1e-3)
    where: FloatArray = np.array([0.0, 0.5 * math.pi])
    along, across = shape(amplitudes(replace(pair, outer_waves=ring), state)["outer"], where)
    assert 2.0 * along == pytest.approx(widening * force * unit, rel=2e-3)
    assert -2.0 * across == pytest.approx((2.0 / math.pi - 0.5) * force * unit, rel=3e-3)


@pytest.mark.parametrize("kind", [*BEARINGS])
def test_the_stiffness_lets_waves_follow(kind: str) -> None:
    """Take differences of loads at held places.

    1e-3 of the largest entry of their unit.
    """
    bearing, state = bent(BEARINGS[kind], 1e8), solved(kind, 1e8)
    step, scale = np.array([1e-9, 1e-9, 1e-9, 1e-7, 1e-7]), np.array([1.0, 1.0, 1.0, 0.03, 0.03])
    for i in range(5):
        moved = [state.ring + sign * step * (np.arange(5) == i) for sign in (1.0, -1.0)]
        ahead, back = (balance(bearing, np.zeros(5), held=(True,) * 5, displacement=at).loads for at in moved)
        slope = (ahead - back) / (2.0 * step[i])
        size = state.stiffness[1, 1] * scale * scale[i]
        assert np.abs((slope - state.stiffness[:, i]) / size).max() < 1e-3

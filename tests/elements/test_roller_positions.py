"""Test answers over one pitch of the rollers."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_friction import FrictionParameters, OilState, RollerFriction, friction
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.roller_positions import PLACES, mean_friction, over_a_pitch

NU = RollerBearing(
    *("NU", 14, 11e-3, 11e-3, 9.56e-3, 60.5e-3, 40e-3, 80e-3, 18e-3, 62e3, 53e3, 6.7e3),
    rib_height=2e-3,
    clearance=37e-6,
)
OIL = OilState(0.035, 860.0, 18e-9, 0.04, 0.13)
HELD = (True, False, False, True, True)


def answer(direction: float, force: float = 5e3) -> tuple[FloatArray, list[RollerFriction]]:
    """Return load and friction at every place.

    The largest load.
    """
    loads = np.array([0.0, force * math.cos(direction), force * math.sin(direction), 0.0, 0.0])
    motion = rolling_motion(NU, 300.0)
    found = over_a_pitch(NU, loads, held=HELD, inertial=motion.inertial(NU))
    largest = np.array([one.inner.sum(axis=1).max() for one in found])
    return largest, [friction(NU, one, motion, OIL, FrictionParameters()) for one in found]


def test_the_direction_of_the_load_does_not_matter() -> None:
    """Compare with rollers that begin at one azimuth.

    Their loads differ by a tenth.
    """
    down, oblique = answer(-0.5 * math.pi), answer(0.3)
    assert down[0] == pytest.approx(oblique[0], rel=1e-6)
    assert mean_friction(down[1]).total == pytest.approx(mean_friction(oblique[1]).total, rel=1e-6)


def test_the_first_place_has_the_largest_load_and_torque_is_the_mean() -> None:
    largest, parts = answer(0.0)
    assert len(largest) == len(PLACES)
    assert np.argmax(largest) == 0
    assert np.argmin(largest) == 2
    torques = [one.total for one in parts]
    assert max(torques) > 1.05 * min(torques)
    assert mean_friction(parts).total == pytest.approx(np.mean(torques))


def test_one_place_is_enough_where_all_rollers_carry_alike() -> None:
    tapered = RollerBearing(
        *("tapered", 16, 17e-3, 22.7e-3, 20.7e-3, 108.5e-3, 80e-3, 140e-3, 35.25e-3, 187e3, 245e3, 28.5e3),
        contact_angle=math.radians(15.64),
    )
    axial = np.array([6e3, 0.0, 0.0, 0.0, 0.0])
    assert len(over_a_pitch(tapered, axial, held=(False, False, False, True, True))) == 1

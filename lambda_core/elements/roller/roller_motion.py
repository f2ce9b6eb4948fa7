"""Compute kinematics and inertial loads of rolling rollers."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import Rib, Ring, RollerBearing


@dataclass(frozen=True)
class RollerMotion:
    """Speeds of a row of rollers.

    Attributes
    ----------
    inner, outer, cage : float
        About the bearing's axis [rad/s].
    spin : float
        Of a roller about its own axis against the cage [rad/s], above zero.
    entrainment : float
        Surface speed of both raceway contacts at the roller's middle in the cage's frame [m/s], above zero.
    turning : tuple of float
        Speed of the roller against the inner and the outer ring about their common generatrix [rad/s], above zero.
    """

    inner: float
    outer: float
    cage: float
    spin: float
    entrainment: float
    turning: tuple[float, float]

    @property
    def relative(self) -> float:
        """Speed of the inner ring against the outer one [rad/s]."""
        return self.inner - self.outer

    def roller_speed(self, ring: Ring) -> float:
        """Return the roller's speed against a ring [rad/s].

        It is positive.
        """
        return self.turning[0 if ring == "inner" else 1]

    def rib(self, rib: Rib, bearing: RollerBearing) -> tuple[float, float]:
        """Return the speeds at a rib.

        The mean surface speed [m/s] in the cage's frame, and the turning behind its sliding [rad/s].

        The rib moves with its ring; the roller's end slides behind by turning times the height above the generatrix.
        """
        ring = self.inner if rib.ring == "inner" else self.outer
        turning = self.roller_speed(rib.ring)
        surface = abs(ring - self.cage) * rib.contact.distance
        return abs(surface - 0.5 * turning * rib.contact.height), turning

    def inertial(self, bearing: RollerBearing) -> FloatArray:
        """Return inertial force and moment on a roller.

        They are the centrifugal force and the gyroscopic moment in its plane, (a, r, moment) [N, N, N m].

        The moment is -omega_c x H of the angular momentum H = I_p omega_p e0 + I_t omega_t e1 of a body with two equal
        transverse inertias, its axis carried round by the cage (Euler's equations).
        """
        polar, transverse = bearing.inertias
        axis = bearing.angles.roller
        along = self.spin * math.copysign(1.0, self.relative) - self.cage * math.cos(axis)
        across = self.cage * math.sin(axis)
        e0 = np.array([-math.cos(axis), math.sin(axis), 0.0])
        e1 = np.array([math.sin(axis), math.cos(axis), 0.0])
        momentum = polar * along * e0 + transverse * across * e1
        moment = -float(np.cross([self.cage, 0.0, 0.0], momentum)[2])
        return np.array([0.0, bearing.mass * self.cage**2 * bearing.centre, moment])


def rolling_motion(bearing: RollerBearing, inner_speed: float, outer_speed: float = 0.0) -> RollerMotion:
    """Return the motion without sliding.

    With r_i, r_o the raceways' radii at the roller's middle, omega_c = (omega_i r_i + omega_o r_o)/(r_i + r_o), the
    surface speed |omega_i - omega_c| r_i, and against a ring the roller turns with the vector sum of its spin and the
    ring's speed, along the common generatrix: sin(axis angle)/sin(half angle) of the ring's speed against the cage, for
    cylinders the sum of both speeds.
    """
    angles = bearing.angles
    lever = 0.5 * bearing.diameter * math.cos(angles.roller)
    inner, outer = bearing.centre - lever, bearing.centre + lever
    cage = (inner_speed * inner + outer_speed * outer) / (inner + outer)
    entrainment = abs(inner_speed - cage) * inner
    spin = entrainment / (0.5 * bearing.diameter)
    if angles.half > 0.0:
        ratio = math.sin(angles.roller) / math.sin(angles.half)
        turning = (abs(inner_speed - cage) * ratio, abs(outer_speed - cage) * ratio)
    else:
        turning = (spin + abs(inner_speed - cage), abs(spin - abs(outer_speed - cage)))
    return RollerMotion(inner_speed, outer_speed, cage, spin, entrainment, turning)

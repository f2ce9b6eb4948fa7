"""Compute the static load distribution independently."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from lambda_core.formulas.hertz import (
    HertzContact,
    ball_raceway_radii,
    hertz_contact,
    reduced_modulus,
    stiffness_constant,
)

STEEL = reduced_modulus(210e9, 0.3, 210e9, 0.3)


class Loaded(NamedTuple):
    """One loaded contact with its reduced radii."""

    contact: HertzContact
    R_x: float
    R_y: float


@dataclass(frozen=True)
class Bearing:
    """Deep-groove ball bearing, steel, SI."""

    balls: int
    ball_diameter: float
    pitch_diameter: float
    groove_inner: float
    groove_outer: float

    def radii(self, inner: bool, angle: float = 0.0) -> tuple[float, float]:
        """Return R_x, R_y of a contact at a contact angle."""
        groove = self.groove_inner if inner else self.groove_outer
        return ball_raceway_radii(self.ball_diameter, self.pitch_diameter, groove, angle, inner=inner)

    def mean_velocity(self, speed: float, angle: float = 0.0) -> float:
        """Return the mean surface velocity [m/s].

        Of either contact in pure rolling; `speed` of the inner ring [rad/s].
        """
        gamma = self.ball_diameter * math.cos(angle) / self.pitch_diameter
        return speed * self.pitch_diameter / 4.0 * (1.0 - gamma**2)

    def contacts(self, force: float, clearance: float, turn: float) -> list[Loaded]:
        """Return the contacts under radial force.

        Every loaded one: `turn` is the azimuth of one ball from the load line.
        """
        inner, outer = (stiffness_constant(*self.radii(side), STEEL) for side in (True, False))
        both = (inner ** (-2.0 / 3.0) + outer ** (-2.0 / 3.0)) ** -1.5
        psi = turn + 2.0 * math.pi * np.arange(self.balls) / self.balls

        def loads(shift: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
            return np.asarray(both * np.maximum(shift * np.cos(psi) - 0.5 * clearance, 0.0) ** 1.5)

        shift = brentq(lambda d: float(loads(d) @ np.cos(psi)) - force, 0.5 * clearance, 1e-3)
        return [
            Loaded(hertz_contact(float(load), *self.radii(side), STEEL), *self.radii(side))
            for load in loads(shift)
            if load > 0.0
            for side in (True, False)
        ]

    def positions(self) -> list[float]:
        """Return eight azimuths over one pitch.

        For averages over the position of the balls.
        """
        return [float(step) * 2.0 * math.pi / self.balls / 8.0 for step in range(8)]


# Syla et al. 2026, Lubricants 14, 154, Tables 3 and 6.
B6319 = Bearing(9, 30.0e-3, 147.5e-3, 15.375e-3, 15.75e-3)
B6208 = Bearing(9, 11.91e-3, 60.0e-3, 6.19e-3, 6.31e-3)

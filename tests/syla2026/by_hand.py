"""Derive the friction torque of the 6319 again.

With numpy and scipy alone, under radial load.

Nothing here calls the program: geometry, oil and constants are written out, every contact is integrated over a fine
grid, the heating of each cell is solved exactly, and every ball rolls so that its own forces and moments balance. Left
out: gravity of the balls, drag, cage, asperities (their share is below 1e-3).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy.optimize import brentq, fsolve

from lambda_core.domain.arrays import FloatArray

# 6319 of Syla et al. 2026, Table 3; clearance in the middle of CN, as in the blind set.
BALLS, BALL, PITCH, GROOVES, CLEARANCE = 9, 30e-3, 147.5e-3, (15.375e-3, 15.75e-3), 24e-6
E_EFF = 210e9 / (1.0 - 0.3**2)  # steel on steel, 2/E' = 2 (1 - nu^2)/E
BALL_MASS = 7850.0 * math.pi / 6.0 * BALL**3
STEEL = 43.0 * 7850.0 * 460.0  # k rho c
TEMPERATURE, CONDUCTIVITY = 62.5, 0.137  # oil [degC], [W/(m K)]
TAU_EYRING, LIMIT, LOSS_FACTOR = 6e6, 0.065, 0.01
INNER, OUTER = 0, 1


def ln_eta(p: FloatArray | float, t: FloatArray | float) -> Any:
    """Return ln(eta) of FVA3.

    Wingertszahn et al. 2023, Lubricants 11, 369, Table A1; p [Pa], t [degC], eta [Pa s].
    """
    bar = np.asarray(p) / 1e5
    pressure = bar / (327.7918 + 2.9862 * t + (4.419e-3 + 3.0115e-4 * t) * bar)
    return np.log(0.062e-3) + 1021.7 / (101.5517 + t) + pressure


ETA = float(np.exp(ln_eta(0.0, TEMPERATURE)))
ALPHA = 1e-5 / (327.7918 + 2.9862 * TEMPERATURE)  # slope of ln(eta) at ambient pressure
BETA = 1021.7 / (101.5517 + TEMPERATURE) ** 2


def _grid() -> tuple[FloatArray, FloatArray]:
    """Return cells of the unit circle.

    s = y/a, weights of ds dt and the pressure over p_0.
    """
    s, ws = np.polynomial.legendre.leggauss(40)
    u, wu = np.polynomial.legendre.leggauss(12)
    chord = np.sqrt(1.0 - s * s)
    area = ws[:, None] * chord[:, None] * wu[None, :]
    pressure = chord[:, None] * np.sqrt(1.0 - u[None, :] ** 2)
    return np.stack([np.broadcast_to(s[:, None], area.shape), area]), pressure


CELLS, PRESSURE = _grid()
STRIPS, WEIGHTS = np.polynomial.legendre.leggauss(100)


@dataclass(frozen=True)
class Contact:
    """Ball-raceway contact at zero contact angle.

    Hertz after Hamrock and Brewe (Syla et al. 2026, eq. 1-11).
    """

    side: int
    load: float

    @property
    def R_x(self) -> float:
        gamma = BALL / PITCH
        return 0.5 * BALL * ((1.0 - gamma) if self.side == INNER else (1.0 + gamma))

    @property
    def R_y(self) -> float:
        return 1.0 / (2.0 / BALL - 1.0 / GROOVES[self.side])

    @cached_property
    def shape(self) -> tuple[float, float, float, float]:
        """k, eps, F and 1/R' of the ellipse."""
        ratio, q = self.R_y / self.R_x, 0.5 * math.pi - 1.0
        return (
            ratio ** (2.0 / math.pi),
            1.0 + q / ratio,
            0.5 * math.pi + q * math.log(ratio),
            1 / self.R_x + 1 / self.R_y,
        )

    @cached_property
    def semi_axes(self) -> tuple[float, float]:
        k, eps, _, curvature = self.shape
        b = (6.0 * eps * self.load / (math.pi * k * E_EFF * curvature)) ** (1.0 / 3.0)
        return k * b, b

    @property
    def stiffness(self) -> float:
        """K in Q = K delta^(3/2)."""
        k, eps, F, curvature = self.shape
        return math.pi * k * E_EFF * math.sqrt(eps / (4.5 * F**3 * curvature))

    def film(self, u: float) -> float:
        """Return the film after Chittenden.

        Chittenden et al. 1985 with Murch and Wilson 1975, u the mean velocity.
        """
        U, W, G = ETA * u / (E_EFF * self.R_x), self.load / (E_EFF * self.R_x**2), ALPHA * E_EFF
        side = 1.0 - math.exp(-1.23 * (self.R_y / self.R_x) ** (2.0 / 3.0))
        L = ETA * BETA * u * u / CONDUCTIVITY
        return 4.31 * self.R_x * G**0.49 * U**0.68 * W**-0.073 * side * 3.94 / (3.94 + L**0.62)

    def rolling(self, u: float) -> float:
        """Return rolling force on each surface.

        Biboulet and Houpert 2010 strip by strip, Goksem and Hargreaves' thermal factor.
        """
        a, _ = self.semi_axes
        W = 0.75 * self.load / a * (1.0 - STRIPS**2) / (E_EFF * self.R_x)
        U2 = 2.0 * ETA * u / (E_EFF * self.R_x)
        M = W / math.sqrt(U2)
        per_length = 1.4 * E_EFF * self.R_x * np.sqrt(U2 * W) / (0.985 * (1.0 + (0.966 * np.sqrt(M)) ** 10) ** 0.1)
        L = ETA * BETA * u * u / CONDUCTIVITY
        return float(per_length @ WEIGHTS) * a / (1.0 + 0.29 * L**0.78)

    @property
    def hysteresis(self) -> float:
        """Couple (3/16) alpha_h Q b (Johnson 1985, section 9.2)."""
        return 3.0 / 16.0 * LOSS_FACTOR * self.load * self.semi_axes[1]

    def shear(self, centre: float, turning: float, u: float, heated: bool) -> tuple[float, float]:
        """Return traction [N] and slip power [W].

        On the ball; slip centre + turning s^2/(2 R_def) (Heathcote).
        """
        a, b = self.semi_axes
        s, area = CELLS
        groove = GROOVES[self.side]
        height = (
            (a * s) ** 2 * (groove + 0.5 * BALL) / (2.0 * groove * BALL)
        )  # s^2/(2 R_def), R_def = 2 r_g r_b/(r_g+r_b)
        slip = centre + turning * height
        p = 1.5 * self.load / (math.pi * a * b) * PRESSURE
        tau = _stress(np.abs(slip), p, self.film(u), b, u, heated)
        force = tau * area * a * b
        return float((np.sign(slip) * force).sum()), float((np.abs(slip) * force).sum())


def _stress(slip: FloatArray, p: FloatArray, h: float, b: float, u: float, heated: bool) -> FloatArray:
    """Return the Eyring stress by bisection.

    Below zeta p at the temperature that it causes itself, over the rise in every cell.

    Rise: q h/(12 lambda) in the film and 0.376 q sqrt(2 b/(u k rho c)) of each surface, q = tau v.
    """
    per_heat = h / (12.0 * CONDUCTIVITY) + 0.376 * math.sqrt(2.0 * b / (u * STEEL)) if heated else 0.0

    def stress(rise: FloatArray) -> FloatArray:
        rate = np.exp(np.minimum(ln_eta(p, TEMPERATURE + rise), 27.6)) * slip / h
        return np.minimum(TAU_EYRING * np.arcsinh(rate / TAU_EYRING), LIMIT * p)

    low, high = np.zeros_like(slip), per_heat * stress(np.zeros_like(slip)) * slip
    for _ in range(40):
        middle = 0.5 * (low + high)
        short = per_heat * stress(middle) * slip > middle
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return stress(0.5 * (low + high))


def loads(force: float, speed: float, turn: float) -> list[tuple[float, float]]:
    """Return every ball's inner and outer load.

    Under a radial force; centrifugal force at nominal cage speed.
    """
    stiffness = [Contact(side, 1.0).stiffness for side in (INNER, OUTER)]
    pull = BALL_MASS * 0.5 * PITCH * (0.5 * speed * (1.0 - BALL / PITCH)) ** 2
    psi = turn + 2.0 * math.pi * np.arange(BALLS) / BALLS

    def of_ball(approach: float) -> float:
        """Return the inner load of a ball.

        Both penetrations add up to the approach of the rings.
        """

        def miss(load: float) -> float:
            both = (load / stiffness[0]) ** (2.0 / 3.0) + ((load + pull) / stiffness[1]) ** (2.0 / 3.0)
            return float(both - approach)

        return brentq(miss, 0.0, 1e6) if miss(0.0) < 0.0 else 0.0

    def inner(shift: float) -> FloatArray:
        return np.array([of_ball(shift * math.cos(x) - 0.5 * CLEARANCE) for x in psi])

    shift = brentq(lambda d: float(inner(d) @ np.cos(psi)) - force, 0.0, 1e-3, xtol=1e-12)
    return [(float(q), float(q) + pull) for q in inner(shift)]


def ball_losses(inner: float, outer: float, speed: float, *, heated: bool = True) -> dict[str, float]:
    """Return the power that one ball dissipates [W], by mechanism."""
    gamma = BALL / PITCH
    orbit, spin = 0.5 * speed * (1.0 - gamma), 0.5 * speed * (1.0 - gamma**2) / gamma
    u = 0.5 * BALL * spin
    contacts = [Contact(side, q) for side, q in ((INNER, inner), (OUTER, outer)) if q > 0.0]
    rolling = [contact.rolling(u) for contact in contacts]
    found = {
        "rolling": 2.0 * u * sum(rolling),
        "hysteresis": sum(c.hysteresis * u / c.R_x for c in contacts),
        "sliding": 0.0,
    }
    if inner == 0.0:
        return found  # it rolls on the outer ring, pushed by the cage: hardly any slip
    races = (0.5 * PITCH - 0.5 * BALL, 0.5 * PITCH + 0.5 * BALL)

    def sheared(change: FloatArray) -> list[tuple[float, float]]:
        w_c, w_b = orbit + change[0], spin + change[1]
        centre = ((speed - w_c) * races[0] - w_b * 0.5 * BALL, w_b * 0.5 * BALL - w_c * races[1])
        turning = (speed - w_c + w_b, w_c - w_b)
        return [c.shear(centre[c.side], turning[c.side], u, heated) for c in contacts]

    def balance(change: FloatArray) -> list[float]:
        (t_i, _), (t_o, _) = sheared(change)
        push = sum(
            sign * f * (4.0 * c.R_x / BALL - 1.0) for sign, f, c in zip((1.0, -1.0), rolling, contacts, strict=True)
        )
        couple = sum(f + 2.0 * c.hysteresis / BALL for f, c in zip(rolling, contacts, strict=True))
        return [t_i + t_o + push, t_i - t_o - couple]

    change = fsolve(balance, np.array([0.0, 0.0]), epsfcn=1e-8, xtol=1e-10)
    found["sliding"] = sum(power for _, power in sheared(change))
    return found


def torques(force: float, rpm: float, *, heated: bool = True, unloaded: bool = True) -> dict[str, float]:
    """Return the friction torque by mechanism [N mm].

    Mean over eight positions of the balls.

    Parameters
    ----------
    unloaded : bool
        Count the balls that the inner ring does not touch; centrifugal force presses them on the outer ring.
    """
    speed = rpm * math.pi / 30.0
    total = {"sliding": 0.0, "rolling": 0.0, "hysteresis": 0.0}
    for step in range(8):
        for inner, outer in loads(force, speed, step * 2.0 * math.pi / BALLS / 8.0):
            if inner > 0.0 or unloaded:
                for name, power in ball_losses(inner, outer, speed, heated=heated).items():
                    total[name] += 1e3 * power / speed / 8.0
    return total

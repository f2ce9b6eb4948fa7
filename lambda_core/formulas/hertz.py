"""Solve Hertz's elliptic contact exactly.

Complete elliptic integrals; for set-up, never per step.

Directions as everywhere in this package: x along rolling, y across; ``semi_a`` is the semi-axis of the contact
ellipse across rolling (y), ``semi_b`` along rolling (x). ``e_eff`` is E' with 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

_ROUNDING = 1e-15
_NEAR = 1e-9  # a secant step of this length ends within rounding


@dataclass(frozen=True)
class HertzShape:
    """Constants of one geometry.

    They do not depend on the load.

    Attributes
    ----------
    ratio : float
        k = semi_a / semi_b.
    first, second : float
        Complete elliptic integrals K(m) and E(m), m = 1 - (minor/major)^2.
    """

    ratio: float
    first: float
    second: float


@dataclass(frozen=True)
class HertzContact:
    """One loaded contact, SI."""

    load: float  # [N]
    semi_a: float  # across rolling [m]
    semi_b: float  # along rolling [m]
    p_max: float  # [Pa]
    approach: float  # mutual approach of distant points [m]

    @property
    def area(self) -> float:
        """Area of the ellipse [m2]."""
        return math.pi * self.semi_a * self.semi_b


def reduced_modulus(youngs_1: float, poisson_1: float, youngs_2: float, poisson_2: float) -> float:
    """Return the modulus E' [Pa] of two solids.

    It follows from 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2.
    """
    return 2.0 / ((1.0 - poisson_1**2) / youngs_1 + (1.0 - poisson_2**2) / youngs_2)


def ball_raceway_radii(
    ball_diameter: float, pitch_diameter: float, groove_radius: float, contact_angle: float, *, inner: bool
) -> tuple[float, float]:
    """Return the reduced radii of a ball contact [m].

    They are R_x along rolling and R_y across, of a ball in a raceway groove.

    1/R_x = 2/D_w +- 2 gamma / (D_w (1 -+ gamma)), gamma = D_w cos(alpha)/d_m, upper signs for the inner
    ring; 1/R_y = 2/D_w - 1/r_g (Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, ch. 2).
    """
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    sign = 1.0 if inner else -1.0
    radius_x = 0.5 * ball_diameter * (1.0 - sign * gamma)
    radius_y = 1.0 / (2.0 / ball_diameter - 1.0 / groove_radius)
    return radius_x, radius_y


def hertz_shape(radius_x: float, radius_y: float) -> HertzShape:
    """Solve for the axis ratio of the contact ellipse.

    It solves (R_major/R_minor) = (kappa^2 E - K)/(K - E) with kappa = major/minor >= 1 (Johnson, Contact Mechanics,
    1985, eq. 4.28) to machine precision.

    Parameters
    ----------
    radius_x, radius_y : float
        Reduced radii along and across rolling [m].

    Returns
    -------
    HertzShape
        Axis ratio and elliptic integrals.

    Raises
    ------
    ValueError
        If a radius is not positive: the surfaces would conform and Hertz theory does not hold.
    """
    if not (radius_x > 0.0 and radius_y > 0.0):
        raise ValueError(f"Hertz contact needs positive reduced radii, got R_x {radius_x:g} m, R_y {radius_y:g} m")
    wide = radius_y >= radius_x
    log_kappa = _log_axis_ratio(abs(math.log(radius_y / radius_x)))
    first, share = _integrals(log_kappa)
    second = first * (1.0 + math.expm1(-2.0 * log_kappa) * share)
    return HertzShape(math.exp(log_kappa if wide else -log_kappa), first, second)


def _log_axis_ratio(log_target: float) -> float:
    """Return ln(kappa) of ln(R_major/R_minor).

    The secant method finds it; both grow together, almost in proportion.
    """

    def residual(log_kappa: float) -> float:
        # (kappa^2 E - K)/(K - E) = kappa^2 (K - D)/D with D = (K - E)/m: no cancellation near the circle
        _, share = _integrals(log_kappa)
        return 2.0 * log_kappa + math.log((1.0 - share) / share) - log_target

    # kappa lies between target^(1/2) and target^(2/3)
    before, now = 0.5 * log_target, 2.0 / 3.0 * log_target + 1e-6
    left_before, left = residual(before), residual(now)
    while abs(now - before) > _NEAR and left != left_before:
        before, now = now, now - left * (now - before) / (left - left_before)
        left_before, left = left, residual(now)
    return now


def _integrals(log_kappa: float) -> tuple[float, float]:
    """Return both elliptic integrals of an axis ratio.

    They are K(m) and (K - E)/(m K) at m = 1 - exp(-2 log_kappa).

    By the arithmetic-geometric mean, K = pi/(2 agm(1, k')) and (K - E)/K = sum of 2^(n-1) c_n^2 with c_0^2 = m,
    c_(n+1) = c_n^2/(4 a_(n+1)) (Abramowitz and Stegun 1964, 17.6): every term is positive.
    """
    smaller, m = math.exp(-log_kappa), -math.expm1(-2.0 * log_kappa)
    mean, other = 0.5 * (1.0 + smaller), math.sqrt(smaller)
    term = -0.25 * math.expm1(-log_kappa) / (1.0 + smaller)  # c_n^2/m
    share, weight = 0.5 + term, 2.0
    while term * weight > _ROUNDING:
        mean, other = 0.5 * (mean + other), math.sqrt(mean * other)
        term *= term * m / (16.0 * mean * mean)
        share += weight * term
        weight *= 2.0
    return math.pi / (mean + other), share


def hertz_contact(load: float, radius_x: float, radius_y: float, e_eff: float) -> HertzContact:
    """Return ellipse, pressure and approach of a contact.

    The contact is elliptic, under `load` [N] (Johnson 1985, eq. 4.26).

    semi_minor^3 = 6 Q R' E(m)/(pi kappa E'), p_max = 3 Q/(2 pi a b), approach = 3 Q K(m)/(pi semi_major E'),
    1/R' = 1/R_x + 1/R_y.
    """
    shape = hertz_shape(radius_x, radius_y)
    return _contact(load, radius_x, radius_y, e_eff, shape)


def _contact(load: float, radius_x: float, radius_y: float, e_eff: float, shape: HertzShape) -> HertzContact:
    kappa = max(shape.ratio, 1.0 / shape.ratio)
    reduced = 1.0 / (1.0 / radius_x + 1.0 / radius_y)
    minor = (6.0 * load * reduced * shape.second / (math.pi * kappa * e_eff)) ** (1.0 / 3.0)
    major = kappa * minor
    semi_a, semi_b = (major, minor) if shape.ratio >= 1.0 else (minor, major)
    p_max = 1.5 * load / (math.pi * major * minor) if load > 0.0 else 0.0
    approach = 3.0 * load * shape.first / (math.pi * major * e_eff) if load > 0.0 else 0.0
    return HertzContact(load, semi_a, semi_b, p_max, approach)


def load_at_pressure(p_max: float, radius_x: float, radius_y: float, e_eff: float) -> float:
    """Return the load [N] at a maximum pressure.

    The pressure is `p_max` [Pa]; it grows with Q^(1/3).
    """
    unit = hertz_contact(1.0, radius_x, radius_y, e_eff)
    return (p_max / unit.p_max) ** 3


def stiffness_constant(radius_x: float, radius_y: float, e_eff: float) -> float:
    """Return the stiffness constant K of one contact.

    It is K [N/m^1.5] of Q = K delta^1.5.
    """
    return float(hertz_contact(1.0, radius_x, radius_y, e_eff).approach ** -1.5)

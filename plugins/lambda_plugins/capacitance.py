"""Extend the Hertzian capacitance of a contact by its surroundings."""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import (
    OK,
    VACUUM_PERMITTIVITY,
    Context,
    FloatArray,
    NoParameters,
    Parameters,
    gap_capacitance,
    law,
    parameter,
)
from lambda_plugins.shapes import at_least, at_most

_STEPS = 160
_LEAST_GAP = 1e-10  # [m] below which a gap counts as this one (numerical)


class Ball(NamedTuple):
    """The ball of a contact."""

    radius: float  # [m]


def prepare_ball(parameters: NoParameters, context: Context) -> Ball:
    """Return the ball."""
    return Ball(0.5 * context.ball_diameter)


def open_gap(film: float, R_x: float, R_y: float, ball_radius: float, eps_r0: float) -> float:
    """Return the capacitance [F] of an unloaded contact.

    Ball and raceway are a film apart (:func:`gap_capacitance`).
    """
    return eps_r0 * gap_capacitance(at_least(film, _LEAST_GAP), R_x, R_y, ball_radius)


@law(
    "capacitance",
    "schneider",
    role_api=3,
    reference="Schneider et al. 2021, Tribol. Int. 154, 106714; Syla et al. 2026, Lubricants 14, 154, eq. 34",
    validity="radial deep groove ball bearings, fully flooded; light loads are those of the gap without load",
    prepare=prepare_ball,
)
def schneider(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: Ball,
    out: FloatArray,
) -> int:
    """Capacitance by Schneider's correction factor.

    C = k_c C_Hertz after Schneider et al., at least the gap's capacitance.

    k_c = 9.5923 U^0.3305 G^0.3431 W^-0.3342 k_e^0.1391 with Hamrock and Dowson's U, G, W (R_x, mean velocity) and
    k_e = a/b: Schneider, Liu, Bader, Furtmann and Poll 2021, Tribol. Int. 154, 106714; Syla et al. 2026, eq. 34. Held
    at 1 and above: the surroundings cannot take capacitance away (slow or heavily loaded contacts outside the fit).
    A power of the load has no limit where the load vanishes, and the fit falls to a third of the truth there. So C is
    at least that of ball and raceway without load, a film apart (:func:`gap_capacitance`, Derjaguin 1934).
    """
    if C_hertz <= 0.0 or W <= 0.0 or semi_b <= 0.0:
        out[0] = C_hertz
        return OK
    factor = 9.5923 * U**0.3305 * G**0.3431 * W**-0.3342 * (semi_a / semi_b) ** 0.1391
    out[0] = at_least(C_hertz * at_least(factor, 1.0), open_gap(h, R_x, R_y, par.radius, eps_r0))
    return OK


class Factor(NamedTuple):
    """A factor and the ball of a contact."""

    k_c: float
    radius: float  # of the ball [m]


class ConstantFactor(Parameters):
    """Parameter of the constant factor."""

    k_c: float = parameter(
        3.5,
        "whole capacitance over that of the Hertzian area",
        source="Barz 1996 and later (common value, original not seen)",
        status="unconfirmed",
        published_range=(1.5, 5.0),
        ge=1.0,
    )


def prepare_factor(parameters: ConstantFactor, context: Context) -> Factor:
    """Return the factor and the ball."""
    return Factor(parameters.k_c, 0.5 * context.ball_diameter)


@law(
    "capacitance",
    "constant-factor",
    ConstantFactor,
    role_api=3,
    reference="Barz 1996 (thesis, Hannover)",
    validity="order of magnitude; the true factor falls with load and rises with film thickness",
    prepare=prepare_factor,
)
def constant_factor(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: Factor,
    out: FloatArray,
) -> int:
    """Capacitance by a constant correction factor.

    C = k_c C_Hertz, at least the gap's capacitance.

    Barz 1996 (thesis, Hannover), as cited by Syla et al. 2026, section 3. At least that of ball and raceway without
    load, a film apart (:func:`gap_capacitance`, Derjaguin 1934).
    """
    out[0] = par.k_c * C_hertz
    if C_hertz > 0.0:
        out[0] = at_least(out[0], open_gap(h, R_x, R_y, par.radius, eps_r0))
    return OK


class GapIntegral(Parameters):
    """Parameter of the gap integral."""

    extent: float = parameter(
        1.0,
        "outer edge of the integral over the ball radius",
        source="assumption: the ball's projection; the integral grows with its logarithm",
        status="assumed",
        published_range=(0.5, 1.2),
        gt=0.0,
        le=2.0,
    )


class Region(NamedTuple):
    """End of the integral."""

    outer: float  # semi-axis along the ellipse's major one [m]


def prepare_gap_integral(parameters: GapIntegral, context: Context) -> Region:
    """Return the outer edge."""
    return Region(0.5 * parameters.extent * context.ball_diameter)


def gap_scale(major: float, minor: float, R_x: float, R_y: float) -> float:
    """Return the scale P of the gap integral.

    P = 1/(2 sqrt(R_x R_y I_A I_B)) with the integrals of :func:`gap_integral` taken to infinity.

    Hertz demands 2 P I_A and 2 P I_B to be the curvatures along both axes; with a fitted ellipse both hold only in the
    geometric mean. The integrands are even and analytic in w, so the trapezoidal rule converges exponentially (1e-9).
    """
    i_a = 0.5 / (major * major * major)
    i_b = 0.5 / (minor * minor * major)
    growth = math.exp(0.25)
    grown = 1.0
    for _ in range(60):
        grown *= growth
        t = 0.5 * minor * (grown - 1.0 / grown)
        A2 = major * major + t * t
        A = math.sqrt(A2)
        i_a += 1.0 / (A2 * A)
        i_b += 1.0 / ((minor * minor + t * t) * A)
    return 2.0 / math.sqrt(R_x * R_y * i_a * i_b)


@law(
    "capacitance",
    "gap-integral",
    GapIntegral,
    role_api=3,
    reference="gap: Johnson, Contact Mechanics (1985), section 3.5 and 4.2; plates: Syla et al. 2026, eq. 31-32",
    validity="surroundings filled with oil; the outer edge is an assumption and counts by its logarithm",
    prepare=prepare_gap_integral,
)
def gap_integral(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: Region,
    out: FloatArray,
) -> int:
    """Capacitance of the Hertzian area and its surroundings.

    The integral of eps_0 eps_r dA/gap covers the surroundings, at ambient permittivity.

    Confocal ellipses with semi-axes A^2 = a^2 + t^2, B^2 = b^2 + t^2, t = b sinh w, x = A cos phi, y = B sin phi, a the
    major one. Outside the contact Hertz's surfaces stand apart by g = h + P (x^2 I_A + y^2 I_B - I_1), where I_A, I_B,
    I_1 are the integrals of 1/A^3, 1/(B^2 A) and 1/A over w from the edge (Johnson, Contact Mechanics (1985), section
    3.5) and P gives the curvatures their geometric mean. Around one ellipse the integral over phi is closed,
    int (alpha + beta cos 2 phi)/(gamma + kappa cos 2 phi) = 2 pi [alpha/s - beta kappa/(s (s + gamma))],
    s^2 = gamma^2 - kappa^2; the trapezoidal rule takes the one over w, out to a major semi-axis of `extent` ball radii.
    Parallel plates in each element, no fringes, oil everywhere, the film's constriction at the outlet left out.
    """
    outer = par.outer
    major = at_least(semi_a, semi_b)
    minor = at_most(semi_a, semi_b)
    if C_hertz <= 0.0 or minor <= 0.0 or major >= outer:
        out[0] = C_hertz
        return OK
    film = at_least(h, _LEAST_GAP)
    P = gap_scale(major, minor, R_x, R_y)
    step = math.asinh(math.sqrt(outer * outer - major * major) / minor) / _STEPS
    i_a = 0.0
    i_b = 0.0
    i_1 = 0.0
    last_a = 1.0 / (major * major * major)
    last_b = 1.0 / (minor * minor * major)
    last_1 = 1.0 / major
    total = 0.0  # the integrand vanishes at the edge
    growth = math.exp(step)
    grown = 1.0
    for i in range(1, _STEPS + 1):
        grown *= growth
        t = 0.5 * minor * (grown - 1.0 / grown)  # b sinh(i step)
        A2 = major * major + t * t
        B2 = minor * minor + t * t
        A = math.sqrt(A2)
        f_a = 1.0 / (A2 * A)
        f_b = 1.0 / (B2 * A)
        f_1 = 1.0 / A
        i_a += 0.5 * step * (last_a + f_a)
        i_b += 0.5 * step * (last_b + f_b)
        i_1 += 0.5 * step * (last_1 + f_1)
        last_a, last_b, last_1 = f_a, f_b, f_1
        gamma = film + P * (0.5 * (B2 * i_b + A2 * i_a) - i_1)
        kappa = 0.5 * P * (A2 * i_a - B2 * i_b)
        root = math.sqrt(gamma * gamma - kappa * kappa)
        ring = 0.5 * (A2 + B2) / root - 0.5 * (B2 - A2) * kappa / (root * (root + gamma))
        total += (0.5 if i == _STEPS else 1.0) * t / A * ring
    out[0] = C_hertz + VACUUM_PERMITTIVITY * eps_r0 * 2.0 * math.pi * step * total
    return OK

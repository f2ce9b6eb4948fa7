"""Define hydrodynamic rolling resistance by strips of the ellipse.

A strip at s = y/a carries the load per length w(s) = 3 Q/(4 a) (1 - s^2) of Hertz's pressure; a line-contact formula
gives its resistance, and the sum over the ellipse depends on one number alone: it is integrated once, before the run,
and read from polynomials (relative error below 1e-9). Without entrainment the force goes to zero in proportion to the
speed.
"""

from __future__ import annotations

import functools
import itertools
import math
from typing import Annotated, NamedTuple

import numpy as np

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, Quantity, law, parameter, power
from lambda_plugins.shapes import POLYNOMIAL_TERMS, at_least, at_most, polynomial, series

# Of q = (0.966)^2 M of the middle strip, the sum has a polynomial for each half of an octave of these.
_OCTAVE_LOW, _OCTAVE_HIGH = -8, 28
_HALVES_BELOW = 2 * (1023 + _OCTAVE_LOW)  # exponent and first bit of the mantissa, as they stand in a float
_LEAST = 1e-290  # of what a power is taken of, or is divided by
# Integral of (1 - s^2)^0.0126 ds over -1..1: the beta function B(1/2, 1.0126).
_STRIPS = math.sqrt(math.pi) * math.gamma(1.0126) / math.gamma(1.5126)


class InletShear(Parameters):
    """Parameters of rolling resistance."""

    thermal_coefficient: float = parameter(
        0.29,
        "c in the thermal factor 1/(1 + c L^0.78); 0 for an isothermal inlet",
        source="Aihara 1987, J. Tribol. 109, 471",
        ge=0.0,
    )
    speed_floor: Annotated[float, Quantity("velocity")] = parameter(
        "1 mm/s", "speed below which the force is linear in the speed", status="numerical", gt=0.0
    )


class Strips(NamedTuple):
    """The sum over all strips."""

    inlet: InletShear
    halves: FloatArray  # polynomials over the halves of octaves, 13 coefficients each


@functools.cache
def _gauss() -> tuple[FloatArray, FloatArray]:
    """Return cos t at 400 Gauss points, and weights.

    The search for them takes twenty times the sum itself.
    """
    nodes, weights = np.polynomial.legendre.leggauss(400)
    return np.cos(0.25 * math.pi * (nodes + 1.0)), weights


def strip_sum(q: FloatArray) -> FloatArray:
    """Return the strips' sum of the thermal factor.

    It is the integral of sqrt(1 - s^2) [1 + q^5 (1 - s^2)^5]^-0.1 ds over -1..1.

    By 400 Gauss points in t, s = sin t, where the integrand is smooth up to the ellipse's tips.
    """
    cosine, weights = _gauss()
    strips = cosine**2 * (1.0 + (np.multiply.outer(q, cosine**2)) ** 5) ** -0.1
    found: FloatArray = strips @ (0.5 * math.pi * weights)
    return found


@functools.cache
def _halves() -> FloatArray:
    """Return the polynomials of :func:`strip_sum`.

    They hold for q from 2^_OCTAVE_LOW to 2^_OCTAVE_HIGH (once per process).
    """
    edges = [2.0**k * m for k in range(_OCTAVE_LOW, _OCTAVE_HIGH) for m in (1.0, 1.5)] + [2.0**_OCTAVE_HIGH]
    return np.concatenate([series(strip_sum, low, high) for low, high in itertools.pairwise(edges)])


def prepare(parameters: InletShear, context: Context) -> Strips:
    """Return the polynomials of the sum over the strips."""
    return Strips(parameters, _halves())


def summed(q: float, halves: FloatArray) -> float:
    """Return :func:`strip_sum` of one q > 0.

    It is constant far below 1 and falls with the root far above; NaN gives NaN.
    """
    held = at_most(q, 2.0**_OCTAVE_HIGH * (1.0 - 1e-15)) if q > 2.0**_OCTAVE_LOW else 2.0**_OCTAVE_LOW
    bits = np.float64(held).view(np.int64)
    half = (bits >> 51) - _HALVES_BELOW
    middle = np.int64((bits >> 51 << 51) + (1 << 50)).view(np.float64)
    start = np.int64(bits >> 52 << 52).view(np.float64)
    first = POLYNOMIAL_TERMS * half
    value = polynomial(4.0 * (held - middle) / start, halves[first : first + POLYNOMIAL_TERMS])
    beyond = value * math.sqrt(held / q) if q > held else value
    return float(beyond) if q > 0.0 else math.nan


def regular_speed(u_mean: float, floor: float) -> float:
    """Return sqrt(u^2 + floor^2)."""
    return math.sqrt(u_mean * u_mean + floor * floor)


def thermal_factor(coefficient: float, speed: float, eta0: float, beta: float, k_oil: float) -> float:
    """Return 1/(1 + c L^0.78), L = eta0 beta u^2/lambda.

    It follows Aihara 1987, J. Tribol. 109, 471 (c = 0.29).
    """
    L = eta0 * beta * speed * speed / k_oil
    return 1.0 / (1.0 + coefficient * power(at_least(L, _LEAST), 0.78))


@law(
    "rolling_resistance",
    "biboulet-houpert",
    InletShear,
    role_api=3,
    reference="Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded inlet, rigid-isoviscous to piezoviscous-elastic line contact applied strip by strip",
    prepare=prepare,
)
def biboulet_houpert(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: Strips,
    out: FloatArray,
) -> int:
    """Rolling resistance after Biboulet and Houpert.

    It is computed strip by strip, with Aihara's thermal factor.

    F/l = 1.4 E' R_x sqrt(U2 W)/{0.985 [1 + (0.966 sqrt(M))^10]^0.1}, U2 = 2 eta0 u_m/(E' R_x), W = w/(E' R_x),
    M = W/sqrt(U2): Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1: line contacts, doi 10.1243/13506501JET790,
    eq. 40-42, as used by Wingertszahn et al. 2023, Lubricants 11, 369, eq. 16 (whose printed inner root must be
    sqrt(M)). It lies 0..56 % above Goksem and Hargreaves.
    """
    speed = regular_speed(u_mean, par.inlet.speed_floor)
    U2 = 2.0 * eta0 * speed / (E_eff * R_x)
    peak = 0.75 * load / (at_least(semi_a, _LEAST) * E_eff * R_x)
    # the strip in the middle has W = `peak`; what is in brackets falls with 1 - s^2 to the sides
    total = math.sqrt(U2 * peak) * summed(0.966 * 0.966 * peak / math.sqrt(U2), par.halves)
    force = 1.4 / 0.985 * E_eff * R_x * semi_a * total
    heated = force * thermal_factor(par.inlet.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    # a choice, no early return: all contacts of a raceway take the same way through the kernel, several at once
    out[0] = 0.0 if load <= 0.0 or semi_a <= 0.0 else heated
    return OK


@law(
    "rolling_resistance",
    "goksem-hargreaves",
    InletShear,
    role_api=3,
    reference="Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346; Zhou and Hoeprich 1991, J. Tribol. 113, 590",
    validity="fully flooded inlet, piezoviscous-elastic line contact applied strip by strip",
)
def goksem_hargreaves(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: InletShear,
    out: FloatArray,
) -> int:
    """Rolling resistance after Goksem and Hargreaves.

    It is computed strip by strip, with Aihara's thermal factor.

    F/l = 4.318 (R_x/alpha_p) (G U)^0.658 W^0.0126, U = eta0 u_m/(E' R_x) with the mean velocity, W = w/(E' R_x):
    Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346; Zhou and Hoeprich 1991, J. Tribol. 113, 590.
    """
    if load <= 0.0 or semi_a <= 0.0 or alpha_p <= 0.0:
        out[0] = 0.0
        return OK
    speed = regular_speed(u_mean, par.speed_floor)
    U = eta0 * speed / (E_eff * R_x)
    peak = 0.75 * load / (semi_a * E_eff * R_x)
    force = 4.318 * R_x / alpha_p * (alpha_p * E_eff * U) ** 0.658 * semi_a * peak**0.0126 * _STRIPS
    out[0] = force * thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return OK


@law("rolling_resistance", "none", role_api=3, reference="-", contact="any")
def none(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    beta: float,
    k_oil: float,
    par: NoParameters,
    out: FloatArray,
) -> int:
    """No rolling resistance."""
    out[0] = 0.0
    return OK

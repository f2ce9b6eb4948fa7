"""Hertzian point contact: load, ellipse and pressure from penetration."""

from __future__ import annotations

import functools
import math

import numpy as np

from lambda_core.physics.hertz import hertz_shape
from lambda_core.plugins import Context, NoParameters, model
from lambda_plugins.fields import FloatArray

_Q = math.pi / 2.0 - 1.0
_MAX_RATIO = 2.0e4  # of the principal radii; range of the exact model's fit
_DEGREE = 28


def chebyshev(x: float, coefficients: FloatArray, start: int, count: int) -> float:
    """Return the Chebyshev series at `x` in -1..1 of `count` coefficients from `start` on (Clenshaw's recurrence)."""
    b1 = 0.0
    b2 = 0.0
    for i in range(start + count - 1, start, -1):
        b1, b2 = 2.0 * x * b1 - b2 + coefficients[i], b1
    value: float = x * b1 - b2 + coefficients[start]
    return value


def ellipse_from_penetration(
    delta: float, R_x: float, R_y: float, E_eff: float, k: float, first: float, second: float, out: FloatArray
) -> None:
    """Write load, semi-axes and pressure for an ellipse of ratio `k` >= 1 and elliptic integrals `first`, `second`.

    Syla et al. 2026, eq. 1-3: delta = F [4.5/(eps R') (Q/(pi k E'))^2]^(1/3), major semi-axis
    (6 k^2 eps Q R'/(pi E'))^(1/3), solved for Q and written in s = sqrt(delta/F), so that nothing divides by a
    vanishing number at first touch. The longer axis lies along the larger radius.
    """
    if delta <= 0.0:
        out[0] = 0.0
        out[1] = 0.0
        out[2] = 0.0
        out[3] = 0.0
        return
    R = R_x * R_y / (R_x + R_y)
    s = math.sqrt(delta / first)
    scale = math.sqrt(second * R / 4.5)
    root = (6.0 * second * R * scale) ** (1.0 / 3.0)
    minor = root * s
    major = minor * k
    out[0] = math.pi * k * E_eff * scale * s * s * s
    out[1] = major if R_y >= R_x else minor
    out[2] = minor if R_y >= R_x else major
    # Q/(major minor) with the powers of s cancelled by hand: finite for the smallest penetration.
    out[3] = 1.5 * E_eff * scale * s / (root * root)


def hamrock_brewe(delta: float, R_x: float, R_y: float, E_eff: float, par: FloatArray, out: FloatArray) -> int:
    """Hertz with Hamrock and Brewe's fits of ellipse ratio and elliptic integrals.

    k = a_H^(2/pi), F = pi/2 + q ln a_H, eps = 1 + q/a_H, q = pi/2 - 1, a_H = R_y/R_x or its inverse, whichever is
    >= 1: Syla et al. 2026, eq. 4-11. Against exact integrals, for ratios 12..60 and equal load: p_max -0.2..+1.4 %,
    a -2.5..+0.5 %; load at equal penetration -2..+4 %.
    """
    ratio = R_y / R_x if R_y >= R_x else R_x / R_y
    logarithm = math.log(ratio)
    k = math.exp(2.0 / math.pi * logarithm)
    ellipse_from_penetration(delta, R_x, R_y, E_eff, k, math.pi / 2.0 + _Q * logarithm, 1.0 + _Q / ratio, out)
    return 1


def hertz_exact(delta: float, R_x: float, R_y: float, E_eff: float, par: FloatArray, out: FloatArray) -> int:
    """Hertz with complete elliptic integrals.

    Hertz 1881; Johnson, Contact Mechanics (1985), eq. 4.25-4.28. `par` holds Chebyshev series in ln(ratio of the
    principal radii), fitted once to scipy.special over 1..20 000 with a relative error below 1e-9.
    """
    ratio = R_y / R_x if R_y >= R_x else R_x / R_y
    if ratio > _MAX_RATIO:
        return 2
    x = 2.0 * math.log(ratio) / math.log(_MAX_RATIO) - 1.0
    n = _DEGREE + 1
    k = math.exp(chebyshev(x, par, 0, n))
    first = chebyshev(x, par, n, n)
    second = chebyshev(x, par, 2 * n, n)
    ellipse_from_penetration(delta, R_x, R_y, E_eff, k, first, second, out)
    return 1


@functools.cache
def _exact_series() -> tuple[float, ...]:
    """Return the Chebyshev coefficients of ln k, K and E over ln(ratio), one series after the other."""
    nodes = np.cos((np.arange(80) + 0.5) * math.pi / 80)
    shapes = [hertz_shape(1.0, math.exp((x + 1.0) / 2.0 * math.log(_MAX_RATIO))) for x in nodes]
    values = np.array([(math.log(shape.ratio), shape.first, shape.second) for shape in shapes])
    return tuple(np.polynomial.chebyshev.chebfit(nodes, values, _DEGREE).T.ravel().tolist())


def prepare_exact(parameters: NoParameters, context: Context) -> FloatArray:
    """Return the series of the exact integrals (computed once per process)."""
    return np.array(_exact_series())


def stiffness(load: float, radius_x: float, radius_y: float, e_eff: float) -> float:
    """Return dQ/d(delta) [N/m] of the Hamrock-Brewe contact at `load` [N]; Q goes with delta^1.5."""
    unit, no_par = np.empty(4), np.empty(0)
    hamrock_brewe(1e-6, radius_x, radius_y, e_eff, no_par, unit)
    penetration: float = 1e-6 * (load / float(unit[0])) ** (2.0 / 3.0)
    return 1.5 * load / penetration


HAMROCK_BREWE = model(
    "normal_contact",
    "hamrock-brewe",
    hamrock_brewe,
    NoParameters,
    reference="Hamrock and Brewe 1983, J. Lubr. Technol. 105, 171; Syla et al. 2026, Lubricants 14, 154, eq. 1-11",
    validity="elliptical contact of smooth elastic half-spaces; fit error: pressure -0.2..+1.4 %, load -2..+4 %",
)

HERTZ_EXACT = model(
    "normal_contact",
    "hertz-exact",
    hertz_exact,
    NoParameters,
    reference="Hertz 1881; Johnson, Contact Mechanics (1985), eq. 4.25-4.28",
    validity="elliptical contact of smooth elastic half-spaces; ratio of principal radii up to 20 000",
    prepare=prepare_exact,
    errors={2: "the ratio of the principal radii exceeds 20 000: use a line-contact law"},
)

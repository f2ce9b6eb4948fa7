"""Define smooth shapes that several laws share.

Plain Python, compiled with the kernels that call them.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lambda_core.plugins import FloatArray


def at_least(value: float, low: float) -> float:
    """Return the larger of both.

    NaN stays NaN, so that a bad input is seen in the output.
    """
    return low if value < low else value


def at_most(value: float, high: float) -> float:
    """Return the smaller of both; NaN stays NaN."""
    return high if value > high else value


def smooth_min(value: float, limit: float, width: float) -> float:
    """Return min(value, limit) with a rounded corner.

    The corner is a parabola within `limit` -+ `width`.

    Continuous with its first derivative; exact outside the rounded corner, low by `width`/4 at its middle.
    """
    # the quotient first: it need not wait for the value
    return smooth_min_by(1.0 / corner(width), value, limit, width)


def corner(width: float) -> float:
    """Return what :func:`smooth_min` divides by; never zero."""
    return 4.0 * width + 1e-300


def smooth_min_by(per_corner: float, value: float, limit: float, width: float) -> float:
    """Return :func:`smooth_min` by the inverse of :func:`corner`.

    Callers that divide by more at once use it.
    """
    held = at_most(value, limit + width)
    inside = at_least(held - (limit - width), 0.0)
    return held - inside * inside * per_corner


def cubic_friction_slope(speed: float, mu_s: float, mu_d: float, v_s: float, v_d: float) -> float:
    """Return mu(v)/v [s/m] of Teutsch's cubic law.

    It holds at `speed` >= 0 [m/s] and is finite at rest.

    Teutsch 2005 in the form of Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21 (with the factor that is
    missing in print): a cubic from 0 at rest to `mu_s` at `v_s`, a second one down to `mu_d` at `v_d`, constant
    above; the slope is continuous and zero at both joints.
    """
    if speed < v_s:
        x = speed / v_s
        return mu_s * (3.0 - x * x) / (2.0 * v_s)
    d = at_most((speed - v_s) / (v_d - v_s), 1.0)
    return (mu_s + (mu_d - mu_s) * d * d * (3.0 - 2.0 * d)) / speed


def cubic_friction(speed: float, mu_s: float, mu_d: float, per_v_s: float, per_fall: float) -> float:
    """Return mu(v) of the law of :func:`cubic_friction_slope`.

    `per_v_s` is 1/v_s, `per_fall` is 1/(v_d - v_s).
    """
    x = speed * per_v_s
    d = at_most(at_least((speed - 1.0 / per_v_s) * per_fall, 0.0), 1.0)
    rise = 0.5 * mu_s * x * (3.0 - x * x)
    return rise if x < 1.0 else mu_s + (mu_d - mu_s) * d * d * (3.0 - 2.0 * d)


POLYNOMIAL_TERMS = 13


def series(function: Callable[[FloatArray], FloatArray], low: float, high: float) -> FloatArray:
    """Return the coefficients of a polynomial for `function`.

    It covers low..high mapped to -1..1 (Chebyshev points).
    """
    nodes = np.cos((np.arange(64) + 0.5) * math.pi / 64)
    values = function(0.5 * (low + high) + 0.5 * (high - low) * nodes)
    fit = np.polynomial.chebyshev.chebfit(nodes, values, POLYNOMIAL_TERMS - 1)
    return np.asarray(np.polynomial.chebyshev.cheb2poly(fit), dtype=np.float64)


def polynomial(x: float, c: FloatArray) -> float:
    """Return sum c[i] x^i of 13 terms.

    The sum is spelled out, so that loops over cells vectorise.
    """
    low = c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * (c[4] + x * (c[5] + x * c[6])))))
    high = c[7] + x * (c[8] + x * (c[9] + x * (c[10] + x * (c[11] + x * c[12]))))
    x2 = x * x
    value: float = low + x2 * x2 * x2 * x * high
    return value

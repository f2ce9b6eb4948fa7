"""Compute load, ellipse and pressure of Hertzian contacts."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, hertz_shape, law
from lambda_plugins.shapes import at_least

_Q = math.pi / 2.0 - 1.0
_MAX_RATIO = 2.0e4  # of the principal radii; range of the exact model's fit
_DEGREE = 28


def chebyshev(x: float, coefficients: FloatArray) -> float:
    """Return the Chebyshev series at `x` in -1..1 (Clenshaw's recurrence)."""
    b1 = 0.0
    b2 = 0.0
    for i in range(coefficients.size - 1, 0, -1):
        b1, b2 = 2.0 * x * b1 - b2 + coefficients[i], b1
    value: float = x * b1 - b2 + coefficients[0]
    return value


class Shape(NamedTuple):
    """Load-independent numbers of a contact of given radii."""

    R_x: float  # [m]
    R_y: float  # [m]
    k: float  # ratio of the semi-axes, at least 1
    first: float  # complete elliptic integral of the first kind
    scale: float  # sqrt(eps R'/4.5) [m^0.5]
    root: float  # shorter semi-axis over sqrt(delta/F) [m^0.5]


def proportions(R_x: float, R_y: float, k: float, first: float, second: float) -> tuple[float, float, float, float]:
    """Return (k, first, scale, root) of :class:`Shape`.

    They follow from ellipse ratio and elliptic integrals.
    """
    R = R_x * R_y / (R_x + R_y)
    scale = math.sqrt(second * R / 4.5)
    return k, first, scale, (6.0 * second * R * scale) ** (1.0 / 3.0)


def ellipse_from_penetration(
    delta: float, R_x: float, R_y: float, E_eff: float, shape: tuple[float, float, float, float], out: FloatArray
) -> None:
    """Write load, semi-axes and pressure for a penetration.

    The ellipse has the given :func:`proportions`.

    Syla et al. 2026, eq. 1-3: delta = F [4.5/(eps R') (Q/(pi k E'))^2]^(1/3), major semi-axis
    (6 k^2 eps Q R'/(pi E'))^(1/3), solved for Q and written in s = sqrt(delta/F), so that nothing divides by a
    vanishing number at first touch. The longer axis lies along the larger radius.
    """
    k, first, scale, root = shape
    s = math.sqrt(at_least(delta, 0.0) / first)
    minor = root * s
    major = minor * k
    out[0] = math.pi * k * E_eff * scale * s * s * s
    out[1] = major if R_y >= R_x else minor
    out[2] = minor if R_y >= R_x else major
    # Q/(major minor) with the powers of s cancelled by hand: finite for the smallest penetration.
    out[3] = 1.5 * E_eff * scale * s / (root * root)


def fitted(R_x: float, R_y: float) -> tuple[float, float, float, float]:
    """Return the :func:`proportions` of radii by Hamrock and Brewe's fits."""
    ratio = R_y / R_x if R_y >= R_x else R_x / R_y
    logarithm = math.log(ratio)
    k = math.exp(2.0 / math.pi * logarithm)
    return proportions(R_x, R_y, k, math.pi / 2.0 + _Q * logarithm, 1.0 + _Q / ratio)


def known(radii: tuple[float, float], find: Callable[[float, float], tuple[float, float, float, float]]) -> Shape:
    """Return the shape of a contact.

    Without known radii it is the shape of radii that cannot occur.
    """
    if not (math.isfinite(radii[0]) and math.isfinite(radii[1])):
        return Shape(0.0, 0.0, 1.0, 1.0, 1.0, 1.0)
    return Shape(*radii, *find(*radii))


def prepare_fitted(parameters: NoParameters, context: Context) -> Shape:
    """Return the shape for the radii of the contact.

    Powers and logarithms are thus computed once.
    """
    return known((context.radius_x, context.radius_y), fitted)


@law(
    "normal_contact",
    "hamrock-brewe",
    role_api=3,
    reference="Hamrock and Brewe 1983, J. Lubr. Technol. 105, 171; Syla et al. 2026, Lubricants 14, 154, eq. 1-11",
    validity="elliptical contact of smooth elastic half-spaces; fit error: pressure -0.2..+1.4 %, load -2..+4 %",
    prepare=prepare_fitted,
)
def hamrock_brewe(delta: float, R_x: float, R_y: float, E_eff: float, par: Shape, out: FloatArray) -> int:
    """Hertz by the fits of Hamrock and Brewe.

    The fits give ellipse ratio and elliptic integrals.

    k = a_H^(2/pi), F = pi/2 + q ln a_H, eps = 1 + q/a_H, q = pi/2 - 1, a_H = R_y/R_x or its inverse, whichever is
    >= 1: Syla et al. 2026, eq. 4-11. Against exact integrals, for ratios 12..60 and equal load: p_max -0.2..+1.4 %,
    a -2.5..+0.5 %; load at equal penetration -2..+4 %.
    """
    shape = (par.k, par.first, par.scale, par.root) if R_x == par.R_x and R_y == par.R_y else fitted(R_x, R_y)
    ellipse_from_penetration(delta, R_x, R_y, E_eff, shape, out)
    return OK


class ExactSeries(NamedTuple):
    """Chebyshev series over ln(ratio of the principal radii)."""

    ln_ellipticity: FloatArray  # ln k
    first: FloatArray  # complete elliptic integral K
    second: FloatArray  # complete elliptic integral E


@functools.cache
def _exact_series() -> ExactSeries:
    """Return the series, fitted to the integrals."""
    nodes = np.cos((np.arange(80) + 0.5) * math.pi / 80)
    shapes = [hertz_shape(1.0, math.exp((x + 1.0) / 2.0 * math.log(_MAX_RATIO))) for x in nodes]
    values = np.array([(math.log(shape.ratio), shape.first, shape.second) for shape in shapes])
    return ExactSeries(*np.polynomial.chebyshev.chebfit(nodes, values, _DEGREE).T)


def exact(R_x: float, R_y: float, series: ExactSeries) -> tuple[float, float, float, float]:
    """Return the exact :func:`proportions` of radii.

    They use elliptic integrals; the ratio of the radii is at most 20 000.
    """
    ratio = R_y / R_x if R_y >= R_x else R_x / R_y
    x = 2.0 * math.log(ratio) / math.log(_MAX_RATIO) - 1.0
    k = math.exp(chebyshev(x, series.ln_ellipticity))
    return proportions(R_x, R_y, k, chebyshev(x, series.first), chebyshev(x, series.second))


class Exact(NamedTuple):
    """Series of the integrals and shape of the contact."""

    shape: Shape
    series: ExactSeries


def prepare_exact(parameters: NoParameters, context: Context) -> Exact:
    """Return the exact integrals' series and the contact's shape.

    A process computes the series once.
    """
    series = _exact_series()

    def held(R_x: float, R_y: float) -> tuple[float, float, float, float]:
        """Return a series that the kernel accepts.

        The kernel refuses longer ones.
        """
        return exact(R_x, min(max(R_y, R_x / _MAX_RATIO), R_x * _MAX_RATIO), series)

    return Exact(known((context.radius_x, context.radius_y), held), series)


@law(
    "normal_contact",
    "hertz-exact",
    role_api=3,
    reference="Hertz 1881; Johnson, Contact Mechanics (1985), eq. 4.25-4.28",
    validity="elliptical contact of smooth elastic half-spaces; ratio of principal radii up to 20 000",
    prepare=prepare_exact,
    errors={2: "the ratio of the principal radii exceeds 20 000: use a line-contact law"},
)
def hertz_exact(delta: float, R_x: float, R_y: float, E_eff: float, par: Exact, out: FloatArray) -> int:
    """Hertz with complete elliptic integrals.

    Hertz 1881; Johnson, Contact Mechanics (1985), eq. 4.25-4.28. The integrals are Chebyshev series in
    ln(ratio of the principal radii), fitted once to the integrals over 1..20 000 with a relative error below 1e-9.
    """
    if R_y > _MAX_RATIO * R_x or R_x > _MAX_RATIO * R_y:
        return 2
    if R_x == par.shape.R_x and R_y == par.shape.R_y:
        shape = par.shape.k, par.shape.first, par.shape.scale, par.shape.root
    else:
        shape = exact(R_x, R_y, par.series)
    ellipse_from_penetration(delta, R_x, R_y, E_eff, shape, out)
    return OK


def stiffness(load: float, radius_x: float, radius_y: float, e_eff: float) -> float:
    """Return dQ/d(delta) [N/m] of the Hamrock-Brewe contact.

    It holds at `load` [N]; Q is proportional to delta^1.5.
    """
    unit = np.empty(4)
    hamrock_brewe(1e-6, radius_x, radius_y, e_eff, known((radius_x, radius_y), fitted), unit)
    penetration: float = 1e-6 * (load / float(unit[0])) ** (2.0 / 3.0)
    return 1.5 * load / penetration

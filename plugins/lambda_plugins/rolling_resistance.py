"""Hydrodynamic rolling resistance of the inlet: force on each surface, by strips of the ellipse.

A strip at s = y/a carries the load per length w(s) = 3 Q/(4 a) (1 - s^2) of Hertz's pressure; a line-contact formula
gives its resistance, and the sum over the ellipse is taken at eight Gauss points in t, s = sin t, where the integrand
is smooth up to the ellipse's tips (error at most 1.1e-3 over all loads and speeds). Without entrainment the force goes
to zero in proportion to the speed.
"""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from lambda_core.plugins import Context, NoParameters, Quantity, model
from lambda_plugins.fields import FloatArray, Parameters, parameter
from lambda_plugins.shapes import at_least, polynomial, series

_POINTS = 8


class InletShear(Parameters):
    """Parameters of rolling resistance."""

    thermal_coefficient: float = parameter(
        0.29,
        "c in the thermal factor 1/(1 + c L^0.78); 0 for an isothermal inlet",
        source="Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346",
        ge=0.0,
    )
    speed_floor: Annotated[float, Quantity("velocity")] = parameter(
        "1 mm/s", "speed below which the force is linear in the speed", status="numerical", gt=0.0
    )


def prepare(parameters: InletShear, context: Context) -> FloatArray:
    """Return [c, speed floor], then at the points 1 - s^2, its inverse, the weights of ds over -1..1 without and with
    sqrt(1 - s^2), then the polynomial of (1 + q)^-0.1 over 0..1."""
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    t = 0.25 * math.pi * (nodes + 1.0)
    # symmetric in s: the half 0..1 counts twice
    cosines = np.cos(t)
    head = [parameters.thermal_coefficient, parameters.speed_floor]
    transition = series(lambda q: np.asarray((1.0 + q) ** -0.1, dtype=np.float64), 0.0, 1.0)
    weights = 0.5 * math.pi * weights * cosines
    return np.concatenate([head, cosines**2, cosines**-2, weights, weights * cosines, transition])


def regular_speed(u_mean: float, floor: float) -> float:
    """Return sqrt(u^2 + floor^2)."""
    return math.sqrt(u_mean * u_mean + floor * floor)


def thermal_factor(coefficient: float, speed: float, eta0: float, beta: float, k_oil: float) -> float:
    """Return 1/(1 + c L^0.78), L = eta0 beta u^2/lambda: Goksem and Hargreaves 1978 (c = 0.29)."""
    L = eta0 * beta * speed * speed / k_oil
    load_term: float = at_least(L, 0.0) ** 0.78
    return 1.0 / (1.0 + coefficient * load_term)


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
    par: FloatArray,
    out: FloatArray,
) -> int:
    """Rolling resistance after Biboulet and Houpert, strip by strip, with Goksem and Hargreaves' thermal factor.

    F/l = 1.4 E' R_x sqrt(U2 W)/{0.985 [1 + (0.966 sqrt(M))^10]^0.1}, U2 = 2 eta0 u_m/(E' R_x), W = w/(E' R_x),
    M = W/sqrt(U2): Biboulet and Houpert 2010, Proc. IMechE J 224, 777, as used by Wingertszahn et al. 2023, Lubricants
    11, 369, eq. 16 (whose printed inner root must be sqrt(M)). Not confirmed from its original; it lies 0..56 % above
    Goksem and Hargreaves, which is the uncertainty of this term.
    """
    if load <= 0.0 or semi_a <= 0.0:
        out[0] = 0.0
        return 1
    speed = regular_speed(u_mean, par[1])
    U2 = 2.0 * eta0 * speed / (E_eff * R_x)
    root = math.sqrt(U2)
    peak = 0.75 * load / (semi_a * E_eff * R_x)
    thin = math.sqrt(U2 * peak)
    thick = root * math.sqrt(root) / 0.966
    square = 0.966 * 0.966 * peak / root
    inverse = 1.0 / square
    total = 0.0
    for i in range(_POINTS):
        # the two branches are one function, written so that neither overflows
        low = square * par[2 + i] < 1.0
        x = square * par[2 + i] if low else inverse * par[2 + _POINTS + i]
        x2 = x * x
        branch = thin * par[2 + 3 * _POINTS + i] if low else thick * par[2 + 2 * _POINTS + i]
        total += branch * polynomial(2.0 * x2 * x2 * x - 1.0, par, 2 + 4 * _POINTS)
    force = 1.4 / 0.985 * E_eff * R_x * semi_a * total
    out[0] = force * thermal_factor(par[0], speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return 1


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
    par: FloatArray,
    out: FloatArray,
) -> int:
    """Rolling resistance after Goksem and Hargreaves, strip by strip, with their thermal factor.

    F/l = 4.318 (R_x/alpha_p) (G U)^0.658 W^0.0126, U = eta0 u_m/(E' R_x) with the mean velocity, W = w/(E' R_x):
    Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346; Zhou and Hoeprich 1991, J. Tribol. 113, 590.
    """
    if load <= 0.0 or semi_a <= 0.0 or alpha_p <= 0.0:
        out[0] = 0.0
        return 1
    speed = regular_speed(u_mean, par[1])
    U = eta0 * speed / (E_eff * R_x)
    peak = 0.75 * load / (semi_a * E_eff * R_x)
    # integral of (1 - s^2)^0.0126 ds over -1..1 is the beta function B(1/2, 1.0126)
    total = peak**0.0126 * math.sqrt(math.pi) * math.gamma(1.0126) / math.gamma(1.5126)
    force = 4.318 * R_x / alpha_p * (alpha_p * E_eff * U) ** 0.658 * semi_a * total
    out[0] = force * thermal_factor(par[0], speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return 1


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
    par: FloatArray,
    out: FloatArray,
) -> int:
    """No rolling resistance."""
    out[0] = 0.0
    return 1


BIBOULET_HOUPERT = model(
    "rolling_resistance",
    "biboulet-houpert",
    biboulet_houpert,
    InletShear,
    reference="Biboulet and Houpert 2010, Proc. IMechE J 224, 777; thermal: Goksem and Hargreaves 1978",
    validity="fully flooded inlet, rigid-isoviscous to piezoviscous-elastic; not confirmed from its original",
    prepare=prepare,
)

GOKSEM_HARGREAVES = model(
    "rolling_resistance",
    "goksem-hargreaves",
    goksem_hargreaves,
    InletShear,
    reference="Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346; Zhou and Hoeprich 1991, J. Tribol. 113, 590",
    validity="fully flooded inlet, piezoviscous-elastic line contact applied strip by strip",
)

NONE = model("rolling_resistance", "none", none, NoParameters, reference="-")

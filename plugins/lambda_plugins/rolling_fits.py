"""Define more published laws of rolling resistance.

Fits to solved line contacts, strip by strip, and one of point contacts.

A power law in the load per length, F/l = c W^m, sums over Hertz's ellipse in closed form: the strips carry
w(s) = 3 Q/(4 a) (1 - s^2), and the integral of (1 - s^2)^m ds over -1..1 is sqrt(pi) Gamma(m + 1)/Gamma(m + 1.5).
"""

from __future__ import annotations

import math

from lambda_core.plugins import (
    OK,
    FloatArray,
    aihara_rolling_force,
    law,
    matsuyama_rolling_force,
    zhou_hoeprich_rolling_force,
)
from lambda_plugins.rolling_resistance import InletShear, regular_speed, thermal_factor
from lambda_plugins.shapes import at_most


def strips(exponent: float) -> float:
    """Return the integral of (1 - s^2)^m ds over -1..1."""
    return math.sqrt(math.pi) * math.gamma(exponent + 1.0) / math.gamma(exponent + 1.5)


# Compiled kernels take these as numbers: gamma functions are none of the C library's that machine code calls.
_MATSUYAMA, _ZHOU_HOEPRICH, _AIHARA = strips(0.08), strips(0.246), strips(0.31)


@law(
    "rolling_resistance",
    "matsuyama",
    InletShear,
    role_api=3,
    reference="Matsuyama, as in Manjunath et al. 2023, Machines 11, 801, table 1; heat: "
    "Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded piezoviscous-elastic line contact applied strip by strip; original not seen",
)
def matsuyama(
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
    """Rolling resistance after Matsuyama.

    It is computed strip by strip, with Aihara's thermal factor.

    :func:`matsuyama_rolling_force` of the load per length of each strip.
    """
    if load <= 0.0 or semi_a <= 0.0 or alpha_p <= 0.0:
        out[0] = 0.0
        return OK
    speed = regular_speed(u_mean, par.speed_floor)
    peak = matsuyama_rolling_force(0.75 * load / semi_a, R_x, speed, eta0, alpha_p, E_eff)
    force = semi_a * _MATSUYAMA * peak
    out[0] = force * thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return OK


@law(
    "rolling_resistance",
    "zhou-hoeprich",
    InletShear,
    role_api=3,
    reference="Zhou and Hoeprich 1991, J. Tribol. 113, 590, eq. 17; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded piezoviscous-elastic line contact applied strip by strip; fitted from W 1e-4 to 3e-4, U "
    "1e-11 to 1e-9",
)
def zhou_hoeprich(
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
    """Rolling resistance after Zhou and Hoeprich.

    It is computed strip by strip, with Aihara's thermal factor.

    :func:`zhou_hoeprich_rolling_force` of the load per length of each strip. Their thermal factor, Zhu and Cheng's,
    needs the sliding; here it is that of the other laws.
    """
    if load <= 0.0 or semi_a <= 0.0 or alpha_p <= 0.0:
        out[0] = 0.0
        return OK
    speed = regular_speed(u_mean, par.speed_floor)
    peak = zhou_hoeprich_rolling_force(0.75 * load / semi_a, R_x, speed, eta0, alpha_p, E_eff)
    force = semi_a * _ZHOU_HOEPRICH * peak
    out[0] = force * thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return OK


@law(
    "rolling_resistance",
    "aihara",
    InletShear,
    role_api=3,
    reference="Aihara 1987, J. Tribol. 109, 471, section 2.4",
    validity="tapered roller bearings; line contact applied strip by strip; constants second-hand",
)
def aihara(
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
    """Rolling resistance after Aihara, strip by strip.

    :func:`aihara_rolling_force` of the load per length of each strip, times 1/(1 + 0.29 L^0.78). His radius of the
    roller and R_x differ by up to 6 % in balls.
    """
    if load <= 0.0 or semi_a <= 0.0 or alpha_p <= 0.0:
        out[0] = 0.0
        return OK
    speed = regular_speed(u_mean, par.speed_floor)
    peak = aihara_rolling_force(0.75 * load / semi_a, R_x, speed, eta0, alpha_p, E_eff)
    force = semi_a * _AIHARA * peak
    out[0] = force * thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return OK


def ellipse_perimeter(ratio: float) -> float:
    """Return the complete elliptic integral E.

    It is of the second kind, with modulus squared 1 - r^2 and r = b/a from 0 to 1.

    Abramowitz and Stegun, 17.3.36: within 2e-8.
    """
    m = ratio * ratio
    if m <= 0.0:
        return 1.0
    smooth = 1.0 + m * (0.44325141463 + m * (0.06260601220 + m * (0.04757383546 + m * 0.01736506451)))
    steep = m * (0.24998368310 + m * (0.09200180037 + m * (0.04069697526 + m * 0.00526449639)))
    return smooth - steep * math.log(m)


@law(
    "rolling_resistance",
    "biboulet-houpert-point",
    InletShear,
    role_api=3,
    reference="Biboulet and Houpert 2010, Proc. IMechE J 224, Part 2; heat: Aihara 1987, J. Tribol. 109, 471",
    validity="fully flooded point contact, rigid-isoviscous to piezoviscous-elastic, wider across rolling than along "
    "it; oil on both sides of the ellipse (truncation left out)",
)
def biboulet_houpert_point(
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
    """Rolling resistance of a point after Biboulet and Houpert.

    Aihara's thermal factor applies.

    F/(E' R_x^2) = (2 a/R_x) {[0.77 b^(-1/3) k^0.12 U2^(-1/12) - 1.8 b^(-1/4)]/(1 + M/6.6) + 1.8 b^(-1/4)} U2^0.75,
    b = (4/pi) E/(1 + R_x/R_y), M = b^(1/4) k W/U2^0.75, U2 = 2 eta0 u_m/(E' R_x), W = Q/(E' R_x^2), k = semi_b/semi_a,
    E the complete elliptic integral: Biboulet and Houpert 2010, Proc. IMechE J 224, Part 2: point contacts, doi
    10.1243/13506501JET791. Slow or heavily loaded it is 1.15 times its line law on the width 2 a: oil outside the
    ellipse resists too.
    """
    if load <= 0.0 or semi_a <= 0.0:
        out[0] = 0.0
        return OK
    speed = regular_speed(u_mean, par.speed_floor)
    U2 = 2.0 * eta0 * speed / (E_eff * R_x)
    k = at_most(semi_b / semi_a, 1.0)
    b = 4.0 / math.pi * ellipse_perimeter(k) / (1.0 + R_x / R_y)
    M = b**0.25 * k * load / (E_eff * R_x * R_x) / U2**0.75
    elastic = 1.8 * b**-0.25
    rigid = 0.77 * b ** (-1.0 / 3.0) * k**0.12 * U2 ** (-1.0 / 12.0)
    force = 2.0 * semi_a * R_x * E_eff * ((rigid - elastic) / (1.0 + M / 6.6) + elastic) * U2**0.75
    out[0] = force * thermal_factor(par.thermal_coefficient, speed, eta0, beta, k_oil) * abs(u_mean) / speed
    return OK

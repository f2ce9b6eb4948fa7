"""Compute Hertz line contact and approach of finite rollers.

Lengths in m, forces in N, pressures in Pa. ``e_eff`` is E' with 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2, as in
:mod:`lambda_core.formulas.hertz`; ``radius`` is the reduced radius R, 1/R = 1/R_1 + 1/R_2. Every argument may be an
array; arrays broadcast.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray

# ISO 16281:2025: c_L = 35948 L_we^(8/9) N/mm^(10/9), steel rollers between two steel raceways.
ISO_CONSTANT = 35948.0
ISO_EXPONENT = 10.0 / 9.0
STEEL_MODULUS = 206e9 / (1.0 - 0.3**2)  # E' of the steel bodies behind that constant [Pa]
_MM = 1e3  # millimetres in a metre

# A strip of even pressure with this share of Hertz's half width has the semi-ellipse's mean of ln|s| across rolling,
# and so its deflection far from the edges.
EVEN_WIDTH = 0.5 * math.exp(0.5)


def raceway_radius(roller_diameter: float, pitch_diameter: float, contact_angle: float = 0.0, *, inner: bool) -> float:
    """Return the reduced radius of a raceway contact [m].

    It is R of a roller on its raceway.

    R = (D_we/2) (1 -+ gamma), gamma = D_we cos(alpha)/D_pw, upper sign for the inner ring (Harris and Kotzalas,
    Rolling Bearing Analysis, 5th ed., vol. 1, ch. 2).
    """
    gamma = roller_diameter * math.cos(contact_angle) / pitch_diameter
    return 0.5 * roller_diameter * (1.0 - gamma if inner else 1.0 + gamma)


def half_width(line_load: FloatArray | float, radius: FloatArray | float, e_eff: float) -> FloatArray:
    """Return Hertz's half width of a line [m].

    It is b = sqrt(8 w R/(pi E')).

    Johnson, Contact Mechanics, 1985, eq. 4.43. Valid for half spaces: b much smaller than R and than the length.

    Parameters
    ----------
    line_load : array or float
        Load per length w [N/m], zero or more.
    radius : array or float
        Reduced radius [m].
    e_eff : float
        Reduced modulus E' [Pa].
    """
    found: FloatArray = np.sqrt(8.0 * np.asarray(line_load) * radius / (math.pi * e_eff))
    return found


def peak_pressure(line_load: FloatArray | float, radius: FloatArray | float, e_eff: float) -> FloatArray:
    """Return Hertz's maximum pressure of a line [Pa].

    It is 2 w/(pi b) = sqrt(w E'/(2 pi R)) (Johnson 1985, eq. 4.45).
    """
    found: FloatArray = np.sqrt(np.asarray(line_load) * e_eff / (2.0 * math.pi * np.asarray(radius)))
    return found


def iso_load(approach: FloatArray | float, length: float) -> FloatArray:
    """Return the load of a roller [N].

    The approach of both raceways is in m.

    Q = c_L delta^(10/9), c_L = 35948 L_we^(8/9) (N, mm; ISO 16281:2025). Valid for steel; both contacts together,
    without profile; zero where the approach is negative. The constant contains no diameter: Lundberg's logarithm,
    :func:`finite_line_approach`, varies by few percent over a roller's usual loads and proportions.
    """
    closed = np.maximum(approach, 0.0) * _MM
    found: FloatArray = ISO_CONSTANT * (length * _MM) ** (8.0 / 9.0) * closed**ISO_EXPONENT
    return found


def iso_approach(load: FloatArray | float, length: float) -> FloatArray:
    """Return the approach of both raceways [m].

    The load is in N; the function is the inverse of :func:`iso_load`.
    """
    found: FloatArray = (np.asarray(load) / (ISO_CONSTANT * (length * _MM) ** (8.0 / 9.0))) ** (
        1.0 / ISO_EXPONENT
    ) / _MM
    return found


def palmgren_approach(load: FloatArray | float, length: float) -> FloatArray:
    """Return Palmgren's approach of one raceway [m].

    It is 3.84e-5 Q^0.9/l^0.8 (mm, N).

    Palmgren, Ball and Roller Bearing Engineering, 3rd ed., 1959; Harris and Kotzalas, vol. 1, ch. 6. Valid for steel
    and rollers of usual proportions. A check of ISO 16281, whose approach is 2.07 times this one: twice and 3.4 %.
    """
    found: FloatArray = 3.84e-5 * np.asarray(load) ** 0.9 / (length * _MM) ** 0.8 / _MM
    return found


def finite_line_approach(load: float, length: float, radius: float, e_eff: float) -> float:
    """Return the half-space approach of one raceway [m].

    The load on the line is even.

    delta = 4 w/(pi E') [ln(2 L/b) + 1/2]: the deflection below the middle of a strip of length L with Hertz's pressure
    across (Lundberg 1939, Forschung auf dem Gebiete des Ingenieurwesens 10, 201; follows from Johnson 1985, eq. 3.19).
    Valid for L much larger than b.
    """
    line_load = load / length
    width = float(half_width(line_load, radius, e_eff))
    return 4.0 * line_load / (math.pi * e_eff) * (math.log(2.0 * length / width) + 0.5)

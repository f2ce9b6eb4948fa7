"""Compute the thermal reference speed by ISO 15312.

A bearing in oil reaches 70 degC by its own loss at this speed.
"""

from __future__ import annotations

import math

AMBIENT = 293.15  # theta_Ar, 20 degC [K]
BEARING = 343.15  # theta_r, 70 degC [K]
VISCOSITY = 12e-6  # nu_r of radial bearings at 70 degC [m2/s]
LOAD_SHARE = 0.05  # P_1r/C_0r of radial bearings
# Annex A, open single-row deep-groove ball bearings in an oil bath: series -> (f_0r, f_1r). The pairs of the annex as
# catalogues of bearings repeat them; the standard itself was not at hand.
COEFFICIENTS = {"60": (1.7, 1.5e-4), "62": (2.0, 2e-4), "63": (2.3, 2e-4)}


def reference_area(bore: float, outside: float, width: float) -> float:
    """Return the heat emitting reference surface A_r [m2].

    A radial bearing has A_r = pi B (D + d) (clause 4.2).
    """
    return math.pi * width * (outside + bore)


def heat_flow_density(area: float) -> float:
    """Return the reference heat flow density [W/m2].

    It is q_r of radial bearings.

    0.016 W/mm2 up to A_r = 50 000 mm2, above 0.016 (A_r/50 000)^-0.34 (clause 4.3).
    """
    square_mm = area * 1e6
    return 16e3 * (1.0 if square_mm <= 5e4 else (square_mm / 5e4) ** -0.34)


def conductance(bore: float, outside: float, width: float) -> float:
    """Return q_r A_r/(50 K) [W/K].

    Shaft and housing take away this heat per kelvin.
    """
    area = reference_area(bore, outside, width)
    return heat_flow_density(area) * area / (BEARING - AMBIENT)


def speed_rating(
    bore: float,
    outside: float,
    width: float,
    static_rating: float,
    f_0r: float,
    f_1r: float,
    viscosity: float = VISCOSITY,
) -> float:
    """Return the thermal speed rating n_theta,r [rad/s].

    The speed n [1/min] that solves (pi n/30e3) [1e-7 f_0r (nu n)^(2/3) d_m^3 + f_1r P_1r d_m] = q_r A_r, with mm, N,
    mm2/s and W; d_m = (d + D)/2, P_1r = 0.05 C_0r (ISO 15312:2018, clause 5).

    Parameters
    ----------
    bore, outside, width : float
        [m].
    static_rating : float
        C_0r [N].
    f_0r, f_1r : float
        Coefficients of viscous and of load-dependent loss (:data:`COEFFICIENTS`).
    viscosity : float
        nu_r [m2/s].
    """
    from scipy.optimize import brentq

    area = reference_area(bore, outside, width)
    emitted = heat_flow_density(area) * area
    diameter, nu = 0.5e3 * (bore + outside), viscosity * 1e6
    loaded = f_1r * LOAD_SHARE * static_rating * diameter

    def surplus(rpm: float) -> float:
        viscous = 1e-7 * f_0r * math.pow(nu * rpm, 2.0 / 3.0) * diameter**3
        return math.pi * rpm / 30e3 * (viscous + loaded) - emitted

    return float(brentq(surplus, 1.0, 1e7, xtol=1e-6)) * math.pi / 30.0

"""Compute films of line contacts and their reductions.

Scalars or arrays; written with NumPy's functions alone, so that they compile as they stand.
"""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray

# Of a power of the film parameter, far beyond what leaves nothing to asperities: steep exponents overflow.
_LARGEST_LOGARITHM = 600.0


def moes_line_film(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return the central film of a line contact [m].

    It covers all regimes from rigid-isoviscous to elastic-piezoviscous.

    H = [(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(-7/2) + H_EP^(-7/2))^(-2s/7)]^(1/s), s = (7 + 8 exp(-2 H_EI/H_RI))/5,
    H_RI = 3/M, H_RP = 1.287 L^(2/3), H_EI = 2.621 M^(-1/5), H_EP = 1.311 M^(-1/8) L^(3/4) with H = (h/R) U^(-1/2),
    M = W U^(-1/2), L = G U^(1/4), U = eta (u_1 + u_2)/(E' R), W = w/(E' R), G = alpha E': Moes 1992, Wear 159, 57, and
    Moes, Lubrication and Beyond, Twente 2000. Fully flooded, isothermal, smooth.

    Parameters
    ----------
    line_load : array or float
        w [N/m], above zero.
    radius : array or float
        Reduced radius along rolling [m].
    speed : array or float
        Mean u of the surface speeds [m/s], above zero.
    viscosity, pressure_viscosity : float
        eta [Pa s] and alpha [1/Pa] at the inlet.
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * radius
    flow = 2.0 * viscosity * speed / stiffness
    load = line_load / stiffness / np.sqrt(flow)
    material = pressure_viscosity * e_eff * flow**0.25
    rigid, piezo = 3.0 / load, 1.287 * material ** (2.0 / 3.0)
    elastic, both = 2.621 * load**-0.2, 1.311 * load**-0.125 * material**0.75
    blend = 0.2 * (7.0 + 8.0 * np.exp(-2.0 * elastic / rigid))
    isoviscous = (rigid ** (7.0 / 3.0) + elastic ** (7.0 / 3.0)) ** (3.0 * blend / 7.0)
    piezoviscous = (piezo**-3.5 + both**-3.5) ** (-2.0 * blend / 7.0)
    return radius * np.sqrt(flow) * (isoviscous + piezoviscous) ** (1.0 / blend)


def dowson_toyoda_film(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return the elastic-piezoviscous film of a line [m].

    The central film is 3.06 R U^0.69 G^0.56 W^-0.10.

    Dowson and Toyoda 1979, 5th Leeds-Lyon Symposium, 60, with the mean speed in U. It checks
    :func:`moes_line_film` in its commonest regime.

    Parameters
    ----------
    line_load : array or float
        Load per length [N/m].
    radius : array or float
        Reduced radius in the rolling direction [m].
    speed : array or float
        Mean speed of the surfaces [m/s].
    viscosity : float
        At the inlet [Pa s].
    pressure_viscosity : float
        Pressure-viscosity coefficient [1/Pa].
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * radius
    flow = viscosity * speed / stiffness
    film: FloatArray = (
        3.06 * radius * flow**0.69 * (pressure_viscosity * e_eff) ** 0.56 * (line_load / stiffness) ** -0.10
    )
    return film


def minimum_share(
    line_load: FloatArray | float,
    radius: FloatArray | float,
    speed: FloatArray | float,
    viscosity: float,
    pressure_viscosity: float,
    e_eff: float,
) -> FloatArray:
    """Return the minimum over the central film [-].

    Dowson's minimum 2.65 U^0.70 G^0.54 W^-0.13 (Dowson 1968, Proc. IMechE 182, 151) over the central film of
    :func:`dowson_toyoda_film`, with its parameters; at most 1.
    """
    stiffness = e_eff * radius
    flow, load = viscosity * speed / stiffness, line_load / stiffness
    share = 2.65 / 3.06 * flow**0.01 * (pressure_viscosity * e_eff) ** -0.02 * load**-0.03
    return np.asarray(np.minimum(share, 1.0))


def inlet_heat_film(
    speed: FloatArray | float,
    slide: FloatArray | float,
    peak: FloatArray | float,
    e_eff: float,
    viscosity: float,
    temperature_slope: float,
    conductivity: float,
) -> FloatArray:
    """Return the factor of inlet heating on the film [-].

    [1 - 13.2 (p/E') L^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L^0.64], L = eta beta u^2/k, S = slide over mean speed, at
    most 2: Gupta, Cheng, Zhu, Forster and Schrand 1992, Tribol. Trans. 35, 269, for line contacts. The numerator stays
    above 0.05: far beyond its range the fit would turn negative.

    Parameters
    ----------
    speed, slide : array or float
        Mean and sliding speed [m/s].
    peak : array or float
        Maximum pressure [Pa].
    e_eff : float
        E' [Pa].
    viscosity : float
        eta at the inlet [Pa s].
    temperature_slope : float
        beta = -d ln(eta)/dT [1/K].
    conductivity : float
        k of the oil [W/(m K)].
    """
    heat = viscosity * temperature_slope * speed**2 / conductivity
    share = np.minimum(np.abs(slide) / (speed + 1e-9), 2.0)
    top = np.maximum(1.0 - 13.2 * (peak / e_eff) * heat**0.42, 0.05)
    found: FloatArray = top / (1.0 + 0.213 * (1.0 + 2.23 * share**0.83) * heat**0.64)
    return found


def inlet_heat_rolling_film(
    speed: FloatArray | float, viscosity: float, temperature_slope: float, conductivity: float
) -> FloatArray:
    """Return the factor of inlet heating in pure rolling [-].

    3.94/(3.94 + L^0.62), L = eta beta u^2/k: Murch and Wilson 1975, J. Lubr. Technol. 97, 212, for line contacts that
    roll. Arguments as for :func:`inlet_heat_film`.
    """
    found: FloatArray = 3.94 / (3.94 + (viscosity * temperature_slope * np.asarray(speed) ** 2 / conductivity) ** 0.62)
    return found


def inlet_heat_rolling(
    speed: FloatArray | float, viscosity: float, temperature_slope: float, conductivity: float, factor: float = 0.29
) -> FloatArray:
    """Return the factor of inlet heating.

    It multiplies the rolling resistance: 1/(1 + 0.29 L^0.78).

    L = eta beta u^2/k: Aihara 1987, J. Tribol. 109, 471, measured with tapered roller bearings.

    Parameters
    ----------
    speed : array or float
        Mean speed of the surfaces [m/s].
    viscosity : float
        eta at the inlet [Pa s].
    temperature_slope : float
        beta = -d ln(eta)/dT [1/K].
    conductivity : float
        k of the oil [W/(m K)].
    factor : float
        The 0.29 of the formula [-].
    """
    heat = viscosity * temperature_slope * speed**2 / conductivity
    found: FloatArray = 1.0 / (1.0 + factor * heat**0.78)
    return found


def asperity_share(film_parameter: FloatArray | float, scale: float, exponent: float) -> FloatArray:
    """Return the share of the load on asperities.

    It is exp(-B Lambda^C) (Zhou and Hoeprich 1991, J. Tribol. 113, 590).
    """
    largest = np.exp(_LARGEST_LOGARITHM / max(exponent, 1.0))
    found: FloatArray = np.exp(-scale * np.minimum(np.maximum(film_parameter, 0.0), largest) ** exponent)
    return found

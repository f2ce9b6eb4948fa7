"""Compute conductances inside a bearing.

They belong to rolling contacts, oil on surfaces, solid parts and seats. Units are SI throughout.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.laws.context import Material

_STRIPS = 24  # Gauss-Legendre points across the ellipse: the integrand falls off as a fourth root at its ends
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(_STRIPS)


def effusivity(material: Material) -> float:
    """Return the effusivity of a solid [W s^0.5/(m2 K)].

    It is e = sqrt(k rho c).
    """
    return math.sqrt(material.thermal_conductivity * material.density * material.specific_heat)


def exchanged(time: FloatArray, film: float, one: float, other: float) -> FloatArray:
    """Return the heat that two half-spaces exchange [J/(m2 K)].

    The heat is that of a time, per area and per difference of temperature.

    Two half-spaces with effusivities e_1, e_2 meet at t = 0 through a film of conductance h per area. The flux is
    h dT exp(b^2 t) erfc(b sqrt t), b = h (1/e_1 + 1/e_2) (Carslaw and Jaeger 1959, Conduction of Heat in Solids,
    sections 2.7 and 12.8); integrated over the time of contact

    Q/dT = (h/b^2) [exp(b^2 t) erfc(b sqrt t) - 1 + 2 b sqrt(t/pi)].

    Without a film (h -> inf) it is 2 e_1 e_2/(e_1 + e_2) sqrt(t/pi), for short times h t.

    Parameters
    ----------
    time : float64[:]
        Of contact [s].
    film : float
        h [W/(m2 K)].
    one, other : float
        Effusivities [W s^0.5/(m2 K)].
    """
    from scipy.special import erfcx  # most commands need no temperatures

    rate = film * (1.0 / one + 1.0 / other)
    x = rate * np.sqrt(time)
    # erfcx - 1 + 2 x/sqrt(pi) loses its digits below x = 0.01; its series starts x^2 - 4 x^3/(3 sqrt(pi)) + x^4/2
    series = x * x * (1.0 - 4.0 * x / (3.0 * math.sqrt(math.pi)) + 0.5 * x * x)
    full = erfcx(x) - 1.0 + 2.0 * x / math.sqrt(math.pi)
    found: FloatArray = film / rate**2 * np.where(x < 1e-2, series, full)
    return found


def rolling_contact(a: float, b: float, speed: float, film: float, one: float, other: float) -> float:
    """Return the conductance of an elliptic rolling contact [W/K].

    It joins two bodies that roll over each other.

    Every strip of the surfaces passes the ellipse in 2 b sqrt(1 - (s/a)^2)/u and exchanges heat meanwhile
    (:func:`exchanged`); the strips together carry u int ds Q/dT. Valid where surfaces pass faster than heat spreads
    (Peclet number u b/kappa above about 5, always so in a running bearing) and each body is at one temperature
    outside a thin skin.

    Parameters
    ----------
    a, b : float
        Semi-axes across and along rolling [m].
    speed : float
        Mean speed of the surfaces through the contact [m/s].
    film : float
        Conductance of the oil film per area, k_oil/h [W/(m2 K)].
    one, other : float
        Effusivities of the two bodies.
    """
    if speed <= 0.0 or a <= 0.0:
        return 0.0
    time = 2.0 * b / speed * np.sqrt(1.0 - _PLACES * _PLACES)
    return float(speed * a * (_WEIGHTS * exchanged(time, film, one, other)).sum())


def resting_contact(a: float, b: float, conductivity: float) -> float:
    """Return the conductance of a contact at rest [W/K].

    The contact is elliptic and conducts 2 k sqrt(a b).

    Constriction into two half-spaces of conductivity k, exact for a circle (Carslaw and Jaeger 1959, section 8.2:
    4 k a each, two in series).
    """
    return 2.0 * conductivity * math.sqrt(a * b)


def rolling_line(length: float, b: float, speed: float, film: float, one: float, other: float) -> float:
    """Return the conductance of a rolling line contact [W/K].

    It joins two bodies that roll over each other.

    As :func:`rolling_contact`, with one time of contact 2 b/u for all strips of the line.

    Parameters
    ----------
    length, b : float
        Length of the line, and half width along rolling [m].
    speed, film, one, other : float
        As of an ellipse.
    """
    if speed <= 0.0 or b <= 0.0:
        return 0.0
    return float(speed * length * exchanged(np.array(2.0 * b / speed), film, one, other))


def resting_line(length: float, b: float, conductivity: float) -> float:
    """Return the conductance of a line contact at rest [W/K].

    Constriction of a rectangle of sides L and 2 b with even flux into two half-spaces in series, by the mean
    temperature of the rectangle: R k sqrt(A) = sqrt(e)/pi {asinh(1/e) + asinh(e)/e + (e/3) [1 + 1/e^3 - (1 +
    1/e^2)^(3/2)]} of each, e = L/(2 b) (Carslaw and Jaeger 1959, section 10.5; Yovanovich and Marotta, in Bejan and
    Kraus, Heat Transfer Handbook, 2003, ch. 4). 0.473 for a square.
    """
    e = length / (2.0 * b)
    edges = e / 3.0 * (1.0 + 1.0 / e**3 - math.pow(1.0 + 1.0 / e**2, 1.5))
    resistance = math.sqrt(e) / math.pi * (math.asinh(1.0 / e) + math.asinh(e) / e + edges)
    return conductivity * math.sqrt(2.0 * b * length) / (2.0 * resistance)


def oil_film_coefficient(speed: float, length: float, viscosity: float, conductivity: float, prandtl: float) -> float:
    """Return the oil's heat transfer coefficient [W/(m2 K)].

    It acts between the oil and a surface that it flows along.

    Laminar flow along a plate, Nu = 0.332 Pr^(1/3) Re^(1/2) (Pohlhausen 1921), with the surface speed of the cage and
    the pitch diameter as speed and length: the reading of Harris (Rolling Bearing Analysis, chapter "Rolling Bearing
    Temperatures", after Eckert) for oil in a bearing, a third of that speed for the oil on the housing. Pr >= 0.6,
    Re < 5e5. Oil that does not move still conducts: never below k/length.

    Parameters
    ----------
    speed, length : float
        [m/s], [m].
    viscosity : float
        Kinematic [m2/s].
    conductivity : float
        Of the oil [W/(m K)].
    prandtl : float
        rho nu c/k.
    """
    reynolds = abs(speed) * length / viscosity
    return max(0.332 * math.pow(prandtl, 1.0 / 3.0) * math.sqrt(reynolds), 1.0) * conductivity / length


def wall(inner_diameter: float, outer_diameter: float, width: float, conductivity: float) -> float:
    """Return the conductance through a hollow cylinder [W/K].

    It is 2 pi k B/ln(D/d).
    """
    return 2.0 * math.pi * conductivity * width / math.log(outer_diameter / inner_diameter)


def in_series(*conductances: float) -> float:
    """Return the conductance of several in series [W/K].

    0 when one of them is.
    """
    if min(conductances) <= 0.0:
        return 0.0
    return 1.0 / sum(1.0 / one for one in conductances)


def rod(length: float, area: float, perimeter: float, coefficient: float, conductivity: float) -> tuple[float, float]:
    """Return the conductances of a rod [W/K].

    One joins both ends, and one joins each end to what surrounds it.

    The exact two-port of a fin, k A T'' = h P (T - T_a): with m = sqrt(h P/(k A)) the ends exchange k A m/sinh(m L),
    and each passes k A m tanh(m L/2) to the surroundings (Carslaw and Jaeger 1959, section 4.5; Harper and Brown 1922,
    NACA report 158). Without convection it is k A/L. Valid where the temperature is even across the rod,
    h A/(P k) < 0.1.

    Parameters
    ----------
    length, area, perimeter : float
        [m], [m2], [m].
    coefficient : float
        h [W/(m2 K)].
    conductivity : float
        k [W/(m K)].
    """
    if coefficient <= 0.0:
        return conductivity * area / length, 0.0
    m = math.sqrt(coefficient * perimeter / (conductivity * area))
    return conductivity * area * m / math.sinh(m * length), conductivity * area * m * math.tanh(0.5 * m * length)

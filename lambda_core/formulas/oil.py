"""Compute oil properties from two viscosities and a density.

The module has Gold's coefficient and the meaning of alpha_p, too.

SI in and out; the standards' own units inside.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

_ZERO_CELSIUS = 273.15
_WALTHER_SHIFT = 0.7  # [mm2/s], ASTM D341 above 2 mm2/s


@dataclass(frozen=True)
class Walther:
    """Kinematic viscosity over temperature after Walther.

    It is log10 log10(nu + 0.7) = a - b log10(T), with nu in mm2/s and T in K.
    """

    a: float
    b: float

    def kinematic_viscosity(self, temperature: float) -> float:
        """Return the kinematic viscosity [m2/s].

        It holds at a temperature [K].

        Raises
        ------
        ValueError
            Where the line gives no viscosity (far too hot) or no finite one (far too cold).
        """
        loglog = self.a - self.b * math.log10(temperature)
        if loglog > 2.0:
            raise ValueError(f"the ASTM D341 line gives no finite viscosity at {temperature - _ZERO_CELSIUS:g} degC")
        nu = 10.0 ** (10.0**loglog) - _WALTHER_SHIFT
        if nu <= 0.0:
            raise ValueError(f"the ASTM D341 line gives no viscosity at {temperature - _ZERO_CELSIUS:g} degC")
        return float(nu * 1e-6)

    def log_slope(self, temperature: float) -> float:
        """Return -d ln(nu)/dT [1/K].

        It holds at a temperature [K].
        """
        shifted = self.kinematic_viscosity(temperature) * 1e6 + _WALTHER_SHIFT
        nu = shifted - _WALTHER_SHIFT
        return self.b / temperature * math.log(shifted) * shifted / nu


def walther(temperature_1: float, viscosity_1: float, temperature_2: float, viscosity_2: float) -> Walther:
    """Fit ASTM D341 (Walther 1931) through two kinematic viscosities.

    Parameters
    ----------
    temperature_1, temperature_2 : float
        [K], different from each other.
    viscosity_1, viscosity_2 : float
        Kinematic viscosity [m2/s]; the form holds above 2 mm2/s (ASTM D341; below it the standard adds terms).

    Raises
    ------
    ValueError
        For equal temperatures, viscosities at or below 0.3 mm2/s, or a viscosity that rises with temperature.
    """
    if temperature_1 == temperature_2:
        raise ValueError("two viscosities at the same temperature do not give a viscosity-temperature line")
    if min(viscosity_1, viscosity_2) <= 0.3e-6:
        raise ValueError("ASTM D341 needs kinematic viscosities above 0.3 mm2/s")
    w1, w2 = (math.log10(math.log10(nu * 1e6 + _WALTHER_SHIFT)) for nu in (viscosity_1, viscosity_2))
    x1, x2 = math.log10(temperature_1), math.log10(temperature_2)
    b = (w1 - w2) / (x2 - x1)
    if b <= 0.0:
        raise ValueError("the viscosity must fall with temperature")
    return Walther(w1 + b * x1, b)


def density(temperature: float, density_15: float, slope: float) -> float:
    """Return the density at ambient pressure [kg/m3].

    It is rho_15 + slope (T - 15 degC); the slope in kg/(m3 K) is negative.
    """
    return density_15 + slope * (temperature - (_ZERO_CELSIUS + 15.0))


def viscosity_grade_midpoint(grade: int) -> float:
    """Return the viscosity of an ISO grade [m2/s].

    It is kinematic, at 40 degC: its number in mm2/s (ISO 3448).
    """
    return grade * 1e-6


# alpha_p [1/GPa] = s nu^t with nu [mm2/s]: Gold, Schmidt, Dicke, Loos and Assmann, J. Synth. Lubr. 18 (2001) 51.
GOLD: dict[str, tuple[float, float]] = {
    "mineral": (9.904, 0.139),
    "PAO": (7.382, 0.1335),
    "ester": (6.605, 0.136),
    "PAG": (5.489, 0.1485),
}


def gold_alpha(kinematic_viscosity: float, s: float, t: float) -> float:
    """Return the pressure-viscosity coefficient after Gold [1/Pa].

    It is s nu^t (1/GPa, nu in mm2/s; Gold et al. 2001).

    A secant coefficient, ln(eta(p)/eta_0)/p over 0 to 0.2 GPa, at the temperature of `kinematic_viscosity` [m2/s].
    """
    return float(s * (kinematic_viscosity * 1e6) ** t * 1e-9)


LogViscosity = Callable[[float], float]


def alpha_tangent(log_viscosity: LogViscosity, step: float = 1e5) -> float:
    """Return the tangent coefficient alpha_0 [1/Pa].

    It is d ln(eta)/dp at p = 0, by a forward difference of second order over `step` [Pa].
    """
    f0, f1, f2 = (log_viscosity(p) for p in (0.0, step, 2.0 * step))
    return (-3.0 * f0 + 4.0 * f1 - f2) / (2.0 * step)


def alpha_secant(log_viscosity: LogViscosity, pressure: float = 0.2e9) -> float:
    """Return the secant coefficient [1/Pa].

    It is ln(eta(p)/eta_0)/p, by custom at 0.2 GPa (Gold's definition).
    """
    return (log_viscosity(pressure) - log_viscosity(0.0)) / pressure


def alpha_reciprocal(log_viscosity: LogViscosity, highest: float = 3e9) -> float:
    """Return the reciprocal pressure coefficient [1/Pa].

    It is the asymptotic isoviscous one: 1 / int_0^inf eta_0/eta dp (Blok 1963).

    Integrated to `highest` [Pa]; the tail beyond is added as an exponential with the last slope.
    """
    from scipy.integrate import quad

    ln0 = log_viscosity(0.0)
    integral = float(quad(lambda p: math.exp(ln0 - log_viscosity(p)), 0.0, highest, limit=200, epsrel=1e-9)[0])
    width = 1e-3 * highest
    slope = (log_viscosity(highest) - log_viscosity(highest - width)) / width
    tail = math.exp(ln0 - log_viscosity(highest)) / slope if slope > 0.0 else 0.0
    return 1.0 / (integral + tail)

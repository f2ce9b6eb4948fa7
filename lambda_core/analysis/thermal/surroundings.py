"""Define conductances from housing and shaft to surroundings.

All values are in SI.
"""

from __future__ import annotations

import math

STEFAN_BOLTZMANN = 5.670374419e-8  # [W/(m2 K4)], CODATA 2018
GRAVITY = 9.80665  # [m/s2]
# Dry air at 320 K and 1 bar (VDI Heat Atlas, D2.2); the coefficients move by 3 % from 290 to 360 K.
AIR_CONDUCTIVITY = 0.0277  # [W/(m K)]
AIR_VISCOSITY = 1.79e-5  # kinematic [m2/s]
AIR_PRANDTL = 0.71
# One factor for convection and radiation of a housing in still air (Palmgren 1957, Grundlagen der
# Waelzlagertechnik, as SKF uses it: dT = loss/W_s, W_s = 17e-6 W/(K mm2) of outer surface).
PALMGREN_COEFFICIENT = 17.0  # [W/(m2 K)]
# A pillow block of usual proportions (height and width over the bearing's outside diameter): plummer block housings of
# the SNL 5 series lie between 1.3 and 1.6, and 0.9 and 1.1. Assumed where the case does not say.
HEIGHT_RATIO, WIDTH_RATIO = 1.5, 1.0
CAST_IRON_DENSITY, CAST_IRON_HEAT = 7200.0, 500.0  # [kg/m3], [J/(kg K)]
CAST_IRON_CONDUCTIVITY = 50.0  # [W/(m K)], grey iron (VDI Heat Atlas, D6.2: 46 to 58)


def housing_area(outside_diameter: float) -> float:
    """Return the outer surface of a pillow block [m2].

    It is S = pi H (W + H/2) (Palmgren; Harris, Rolling Bearing Analysis, chapter "Rolling Bearing Temperatures"), that
    of a cylinder of diameter H and length W with its two ends.
    """
    height, width = HEIGHT_RATIO * outside_diameter, WIDTH_RATIO * outside_diameter
    return math.pi * height * (width + 0.5 * height)


def housing_mass(outside_diameter: float) -> float:
    """Return the mass of the pillow block [kg].

    It is a cast-iron cylinder without the bearing's seat.
    """
    height, width = HEIGHT_RATIO * outside_diameter, WIDTH_RATIO * outside_diameter
    return CAST_IRON_DENSITY * math.pi / 4.0 * (height**2 - outside_diameter**2) * width


def natural_convection(diameter: float, surface: float, air: float) -> float:
    """Return the natural convection of a cylinder [W/(m2 K)].

    The coefficient holds for a horizontal cylinder in still air.

    Nu = 0.53 (Gr Pr)^(1/4), 1e4 < Gr Pr < 1e9 (McAdams 1954, Heat Transmission, 3rd ed., chapter 7).

    Parameters
    ----------
    diameter : float
        [m].
    surface, air : float
        Temperatures [K].
    """
    grashof = GRAVITY * abs(surface - air) * diameter**3 / (0.5 * (surface + air) * AIR_VISCOSITY**2)
    return float(0.53 * (grashof * AIR_PRANDTL) ** 0.25 * AIR_CONDUCTIVITY / diameter)


def forced_convection(diameter: float, speed: float) -> float:
    """Return the forced convection of a cylinder [W/(m2 K)].

    Coefficient in a cross flow of air.

    Churchill and Bernstein 1977, J. Heat Transfer 99, 300: Nu = 0.3 + 0.62 Re^(1/2) Pr^(1/3)/[1 + (0.4/Pr)^(2/3)]^(1/4)
    [1 + (Re/282000)^(5/8)]^(4/5), Re Pr > 0.2.
    """
    reynolds = speed * diameter / AIR_VISCOSITY
    front = 0.62 * math.sqrt(reynolds) * AIR_PRANDTL ** (1.0 / 3.0) / (1.0 + (0.4 / AIR_PRANDTL) ** (2.0 / 3.0)) ** 0.25
    return float((0.3 + front * (1.0 + (reynolds / 282000.0) ** 0.625) ** 0.8) * AIR_CONDUCTIVITY / diameter)


def radiation(emissivity: float, surface: float, walls: float) -> float:
    """Return the coefficient of radiation [W/(m2 K)].

    It is e sigma (T^2 + T_a^2)(T + T_a) towards large surroundings.
    """
    return emissivity * STEFAN_BOLTZMANN * (surface**2 + walls**2) * (surface + walls)


def rotating_shaft(diameter: float, speed: float) -> float:
    """Return the convection of a rotating shaft [W/(m2 K)].

    Coefficient of a horizontal shaft that turns in still air.

    Nu = 0.133 Re^(2/3) Pr^(1/3), Re = omega d^2/(2 nu) from 1e3 to 1e5 (Becker 1963, Int. J. Heat Mass Transfer 6,
    1053); below that rotation matters less than natural convection.

    Parameters
    ----------
    diameter : float
        [m].
    speed : float
        [rad/s].
    """
    reynolds = 0.5 * abs(speed) * diameter**2 / AIR_VISCOSITY
    return float(0.133 * reynolds ** (2.0 / 3.0) * AIR_PRANDTL ** (1.0 / 3.0) * AIR_CONDUCTIVITY / diameter)


def long_fin(diameter: float, coefficient: float, conductivity: float) -> float:
    """Return the conductance into a long shaft [W/K].

    The heat leaves a bearing seat; the shaft is long on both sides.

    A fin of infinite length on each side, sqrt(h P k A) with P = pi d, A = pi d^2/4 (Harper and Brown 1922).
    """
    return 2.0 * math.sqrt(coefficient * math.pi * diameter * conductivity * math.pi * diameter**2 / 4.0)


def housing_coefficient(height: float, housing: float, air: float, air_speed: float, emissivity: float) -> float:
    """Return the coefficient of a housing [W/(m2 K)].

    A housing of a height [m] has the larger convection and the radiation.

    Parameters
    ----------
    height : float
        [m].
    housing, air : float
        Temperatures [K].
    air_speed : float
        [m/s].
    emissivity : float
        Of the housing's surface.
    """
    convection = natural_convection(height, housing, air)
    if air_speed > 0.0:
        convection = max(convection, forced_convection(height, air_speed))
    return convection + radiation(emissivity, housing, air)


def shaft_coefficient(diameter: float, speed: float, surface: float, air: float) -> float:
    """Return the coefficient of a shaft [W/(m2 K)].

    Turning [rad/s] or in still air, whichever is larger.
    """
    still = natural_convection(diameter, surface, air)
    return max(rotating_shaft(diameter, speed), still)

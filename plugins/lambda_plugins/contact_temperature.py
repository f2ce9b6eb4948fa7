"""Compute the temperature of the oil inside the contact."""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Material, NoParameters, law
from lambda_plugins.shapes import at_least

_BAND_MEAN = 4.0 / 3.0 / math.sqrt(math.pi)  # 0.752: two thirds of the largest value, at the trailing edge
_PECLET_AT_REST = 0.02


class Solid(NamedTuple):
    """Thermal properties of a solid body."""

    conductivity: float  # [W/(m K)]
    diffusivity: float  # [m2/s]


class Heated(NamedTuple):
    """The film and both bodies."""

    film_conductivity: float  # [W/(m K)]
    ball: Solid
    ring: Solid


def solid(material: Material) -> Solid:
    """Return conductivity and diffusivity of a material."""
    conductivity = material.thermal_conductivity
    return Solid(conductivity, conductivity / (material.density * material.specific_heat))


def prepare_shear_heating(parameters: NoParameters, context: Context) -> Heated:
    """Return the thermal constants of oil, ball and ring."""
    return Heated(context.oil.thermal_conductivity, solid(context.ball), solid(context.partner))


def band_rise(semi_b: float, speed: float, body: Solid) -> float:
    """Return the mean temperature rise under a moving band.

    The band of length 2b moves over a half-space; the rise is per heat flux [K m2/W].

    0.752 (b/k)/sqrt(Pe), Pe = u b/(2 kappa), which is 0.752 sqrt(2b/(u k rho c)): the mean over 0..2b of
    2 q sqrt(x/(pi u k rho c)) (Jaeger 1942; Carslaw and Jaeger 1959, section 10.7). Pe^2 + 0.02 under the root ends the
    growth at 2 b/k, the mean of an ellipse of axis ratio 8 at rest (ibid., section 10.5). 7 % low for Pe = 0.2 to 1.
    """
    peclet = 0.5 * speed * semi_b / body.diffusivity
    return _BAND_MEAN * semi_b / body.conductivity / math.sqrt(math.sqrt(peclet * peclet + _PECLET_AT_REST))


@law(
    "contact_temperature",
    "shear-heating",
    role_api=3,
    reference="Jaeger 1942; Archard 1959, Wear 2, 438; Carslaw and Jaeger 1959, sections 10.5 and 10.7",
    validity="thin film, heat flow across the film only; mean over the length of the contact",
    prepare=prepare_shear_heating,
)
def shear_heating(
    T_in: float,
    u_mean: float,
    h: float,
    semi_b: float,
    tau: FloatArray,
    slip: FloatArray,
    par: Heated,
    T: FloatArray,
) -> int:
    """Mean film temperature from shear heat.

    It is the rise across the film plus the flash rise of both surfaces.

    The heat q = tau v per area is made evenly across the film. Film: T(z) is a parabola over the straight line between
    both surfaces, its mean q h/(12 lambda) above their average (its maximum q h/(8 lambda)). Surfaces: the mean over
    the band of :func:`band_rise` (its maximum, the flash temperature, is 3/2 of that); with half the heat to each
    surface it is the well-known 0.376 q sqrt(2b/(u k rho c)). The share of each surface follows from conduction through
    the film between surfaces of unequal temperature (steel against ceramic), q_1 - q_2 = 2 (lambda/h)(T_2 - T_1), and
    is one half for equal materials. Jaeger 1942; Archard 1959, Wear 2, 438. Mean over the length of the contact in
    every cell; side flow of heat and the rise in the bulk of the bodies are left out.
    """
    film = at_least(h, 1e-10)
    s_1 = band_rise(semi_b, u_mean, par.ball)
    s_2 = band_rise(semi_b, u_mean, par.ring)
    g = par.film_conductivity / film
    share = (0.5 + g * s_2) / (1.0 + g * (s_1 + s_2))
    rise = 0.5 * (share * s_1 + (1.0 - share) * s_2) + film / (12.0 * par.film_conductivity)
    for i in range(T.size):
        T[i] = T_in + rise * tau[i] * slip[i]
    return OK


@law("contact_temperature", "isothermal", role_api=3, reference="-")
def isothermal(
    T_in: float,
    u_mean: float,
    h: float,
    semi_b: float,
    tau: FloatArray,
    slip: FloatArray,
    par: NoParameters,
    T: FloatArray,
) -> int:
    """Film at the temperature of the inlet."""
    for i in range(T.size):
        T[i] = T_in
    return OK

"""Temperature of the oil inside the contact."""

from __future__ import annotations

import numpy as np

from lambda_core.plugins import Context, Material, NoParameters, model
from lambda_plugins.fields import FloatArray

# Mean over a band 0 <= x <= 2b of 2 q sqrt(x/(pi u k rho c)): 2/3 of the largest value at the trailing edge.
_BAND_MEAN = 4.0 / 3.0 / np.pi**0.5


def prepare_shear_heating(parameters: NoParameters, context: Context) -> FloatArray:
    """Return [lambda_oil, k rho c of the ball, its diffusivity, k rho c of the ring, its diffusivity]."""

    def solid(material: Material) -> tuple[float, float]:
        heat = material.density * material.specific_heat
        return material.thermal_conductivity * heat, material.thermal_conductivity / heat

    return np.array([context.oil.thermal_conductivity, *solid(context.ball), *solid(context.partner)])


def shear_heating(
    T_in: float,
    u_mean: float,
    h: float,
    semi_b: float,
    tau: FloatArray,
    slip: FloatArray,
    par: FloatArray,
    T: FloatArray,
) -> int:
    """Mean film temperature from shear heat: rise across the film plus flash rise of both surfaces.

    The heat q = tau v per area is made evenly across the film. Film: T(z) is a parabola over the straight line between
    both surfaces, its mean q h/(12 lambda) above their average (its maximum q h/(8 lambda)). Surfaces: a band of length
    2b and even flux q_s on a half-space that moves at u heats it by 2 q_s sqrt(x/(pi u k rho c)) (Jaeger 1942; Archard
    1959, Wear 2, 438); the mean over the band is 0.752 q_s sqrt(2b/(u k rho c)), its maximum 3/2 of that. With half the
    heat to each surface this is the well-known 0.376 q sqrt(2b/(u k rho c)). The share of each surface follows from
    conduction through the film between surfaces of unequal temperature (steel against ceramic), q_1 - q_2 =
    2 (lambda/h)(T_2 - T_1), and is one half for equal materials. Towards rest u becomes u + 2 kappa/b (Tian and Kennedy
    1994, J. Tribol. 116, 167): the stationary band. The mean over the contact length is used for every cell; side flow
    of heat and the rise in the bulk of the bodies are left out.
    """
    film = h if h > 1e-10 else 1e-10
    # sqrt(2b/((u + 2 kappa/b) k rho c)), written so that b = 0 gives 0
    s_1 = _BAND_MEAN * semi_b * (2.0 / ((u_mean * semi_b + 2.0 * par[2]) * par[1])) ** 0.5
    s_2 = _BAND_MEAN * semi_b * (2.0 / ((u_mean * semi_b + 2.0 * par[4]) * par[3])) ** 0.5
    g = par[0] / film
    share = (0.5 + g * s_2) / (1.0 + g * (s_1 + s_2))
    rise = 0.5 * (share * s_1 + (1.0 - share) * s_2) + film / (12.0 * par[0])
    for i in range(T.size):
        T[i] = T_in + rise * tau[i] * slip[i]
    return 1


def isothermal(
    T_in: float,
    u_mean: float,
    h: float,
    semi_b: float,
    tau: FloatArray,
    slip: FloatArray,
    par: FloatArray,
    T: FloatArray,
) -> int:
    """The film keeps the temperature of the inlet."""
    for i in range(T.size):
        T[i] = T_in
    return 1


SHEAR_HEATING = model(
    "contact_temperature",
    "shear-heating",
    shear_heating,
    NoParameters,
    reference="Jaeger 1942; Archard 1959, Wear 2, 438; Tian and Kennedy 1994, J. Tribol. 116, 167",
    validity="thin film, heat flow across the film only; mean over the length of the contact",
    prepare=prepare_shear_heating,
)

ISOTHERMAL = model("contact_temperature", "isothermal", isothermal, NoParameters, reference="-")

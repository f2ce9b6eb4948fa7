"""Compute isothermal, flooded films of elliptical contacts."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, Quantity, exp, law, log, parameter, power
from lambda_plugins.shapes import at_least, at_most


class Floors(Parameters):
    """Regularisation of the power laws at rest and without load.

    The speed enters as sqrt(u^2 + speed_floor^2), the load as sqrt(Q^2 + load_floor^2), and the film as
    sqrt(h^2 + film_floor^2): nothing divides by zero, every derivative is bounded, and at 1 m/s, 100 N and 0.1 um
    the film changes by less than 1e-4 of itself.
    """

    speed_floor: Annotated[float, Quantity("velocity")] = parameter(
        "1 mm/s", "entrainment speed below which the film no longer thins", status="numerical", gt=0.0
    )
    load_floor: Annotated[float, Quantity("force")] = parameter(
        "1 N", "load below which the film no longer thickens", status="numerical", gt=0.0
    )
    film_floor: Annotated[float, Quantity("small_length")] = parameter(
        "1 nm", "thinnest film", source="size of an oil molecule", status="numerical", gt=0.0
    )


class FilmFloors(NamedTuple):
    """Lower limits of the film.

    The limit of the film is stored twice, since a square used once fuses with its sum.
    """

    speed: float  # [m/s]
    load: float  # [N]
    central: float  # [m]
    minimum: float  # [m]


def prepare(parameters: Floors, context: Context) -> FilmFloors:
    """Return the floors of speed, load and both films."""
    return FilmFloors(parameters.speed_floor, parameters.load_floor, parameters.film_floor, parameters.film_floor)


@law(
    "film_thickness",
    "chittenden",
    Floors,
    role_api=3,
    reference="Chittenden, Dowson, Dunn and Taylor 1985, Proc. R. Soc. A 397, 245 and 271",
    validity="piezoviscous-elastic regime, fully flooded, isothermal; floors at rest and without load are numerical",
    prepare=prepare,
)
def chittenden(
    u_mean: float,
    cos2: float,
    load: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    par: FilmFloors,
    out: FloatArray,
) -> int:
    """Film after Chittenden et al.

    The entrainment may have any angle to the axes of the ellipse.

    h = C R_e G^0.49 U^0.68 W^-0.073 {1 - exp[-c (R_s/R_e)^(2/3)]}, C = 4.31, c = 1.23 in the centre and 3.68, 0.67 at
    the minimum; U = eta0 u_m/(E' R_e) with the MEAN velocity, W = Q/(E' R_e^2), G = alpha_p E'; R_e and R_s along and
    across the entrainment. Chittenden et al. 1985, Proc. R. Soc. A 397, 245 and 271. Syla et al. 2026 (eq. 25-26,
    Table 2) print the exponent 0.67 and the sum velocity, which together give 1.9 times this film.
    """
    sin2 = 1.0 - cos2
    R_e = 1.0 / (cos2 / R_x + sin2 / R_y)
    R_s = 1.0 / (sin2 / R_x + cos2 / R_y)
    speed = math.sqrt(u_mean * u_mean + par.speed * par.speed)
    force = math.sqrt(load * load + par.load * par.load)
    U = eta0 * speed / (E_eff * R_e)
    W = force / (E_eff * R_e * R_e)
    G = at_least(alpha_p * E_eff, 1e-200)
    common = R_e * exp(0.49 * log(G) + 0.68 * log(U) - 0.073 * log(W))
    shape = power(R_s / R_e, 2.0 / 3.0)
    central = 4.31 * common * (1.0 - exp(-at_most(1.23 * shape, 700.0)))
    minimum = 3.68 * common * (1.0 - exp(-at_most(0.67 * shape, 700.0)))
    out[0] = math.sqrt(central * central + par.central * par.central)
    out[1] = math.sqrt(minimum * minimum + par.minimum * par.minimum)
    return OK


@law(
    "film_thickness",
    "hamrock-dowson",
    Floors,
    role_api=3,
    reference="Hamrock and Dowson 1977, J. Lubr. Technol. 99, 264",
    validity="piezoviscous-elastic regime, k >= 1, entrainment along the minor axis, fully flooded, isothermal",
    prepare=prepare,
)
def hamrock_dowson(
    u_mean: float,
    cos2: float,
    load: float,
    R_x: float,
    R_y: float,
    E_eff: float,
    eta0: float,
    alpha_p: float,
    par: FilmFloors,
    out: FloatArray,
) -> int:
    """Film after Hamrock and Dowson.

    The entrainment is along the minor axis.

    h_cen = 2.69 R_x U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k)), h_min = 3.63 R_x U^0.68 G^0.49 W^-0.073
    (1 - exp(-0.68 k)), k = 1.03 (R_y/R_x)^0.64; U with the mean velocity. Hamrock and Dowson 1977, J. Lubr. Technol.
    99, 264. The direction of entrainment is not used.
    """
    speed = math.sqrt(u_mean * u_mean + par.speed * par.speed)
    force = math.sqrt(load * load + par.load * par.load)
    U = eta0 * speed / (E_eff * R_x)
    G = alpha_p * E_eff
    W = force / (E_eff * R_x * R_x)
    k = 1.03 * (R_y / R_x) ** 0.64
    central = 2.69 * R_x * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * math.exp(-0.73 * k))
    minimum = 3.63 * R_x * U**0.68 * G**0.49 * W**-0.073 * (1.0 - math.exp(-0.68 * k))
    out[0] = math.sqrt(central * central + par.central * par.central)
    out[1] = math.sqrt(minimum * minimum + par.minimum * par.minimum)
    return OK

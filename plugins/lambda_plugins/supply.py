"""Define loss of film and rolling resistance by starvation."""

from __future__ import annotations

import math
from typing import NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, exp, law, parameter
from lambda_plugins.methods.skf_drag import K_Z_OF_KINDS
from lambda_plugins.shapes import at_least, at_most
from lambda_plugins.starved_inlet import INLET, ROLLING, meniscus, starved_rolling


class FilmFactor(Parameters):
    """A film factor that is given."""

    film_factor: float | None = parameter(
        None, "factor on the film; absent: lubricant.starvation", source="of the case", gt=0.0, le=1.0
    )


class Given(NamedTuple):
    """Film factor and the gap at the meniscus.

    The gap leaves this film.
    """

    film: float
    gap: float  # over the flooded central film


def given(parameters: FilmFactor, context: Context) -> Given:
    """Return the factor of the case and its meniscus.

    The meniscus is at infinity in a flooded contact.
    """
    film = context.starvation if parameters.film_factor is None else parameters.film_factor
    return Given(film, meniscus(film))


@law(
    "supply",
    "constant",
    FilmFactor,
    role_api=3,
    reference=f"{INLET}; rolling: {ROLLING}",
    validity="the same share of the flooded film at every speed and load; Grubin's inlet and rolling of line contacts, "
    "the inlet derived anew",
    prepare=given,
)
def constant(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    h_cen: float,
    h_min: float,
    par: Given,
    out: FloatArray,
) -> int:
    """Constant film factor.

    The rolling resistance is that of the inlet that leaves this film.

    Where the oil has to begin follows from Grubin's inlet (:func:`meniscus`, Wolveridge et al. 1971), the rolling
    resistance from the gap there (:func:`starved_rolling`, Biboulet and Houpert 2010, Part 1, eq. 44).
    """
    out[0] = par.film
    out[1] = starved_rolling(par.gap * h_cen / h_min)
    return OK


class InletDistance(Parameters):
    """Start of the inlet."""

    distance: float = parameter(
        ..., "m, inlet meniscus from the centre over semi-axis b", source="to be given", gt=1.0, le=1e12
    )


class Meniscus(NamedTuple):
    """Start of the inlet and its gap.

    The gap is that of Hertz's dry contact.
    """

    distance: float  # over b
    gap: float  # times 2 R_x/b^2


def prepare_distance(parameters: InletDistance, context: Context) -> Meniscus:
    """Return place and gap of the meniscus."""
    m = parameters.distance
    root = math.sqrt(m * m - 1.0)
    return Meniscus(m, m * root - math.log(m + root))


@law(
    "supply",
    "inlet-distance",
    InletDistance,
    role_api=3,
    reference=f"Hamrock and Dowson 1977, J. Lubr. Technol. 99, 15 (part IV); rolling: {ROLLING}",
    validity="entrainment along the minor axis",
    prepare=prepare_distance,
)
def inlet_distance(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    h_cen: float,
    h_min: float,
    par: Meniscus,
    out: FloatArray,
) -> int:
    """Starvation by the meniscus, after Hamrock and Dowson.

    The distance of the inlet meniscus decides.

    h/h_ff = [(m - 1)/(m* - 1)]^0.29 below m* = 1 + 3.06 [(R_x/b)^2 H_c]^0.58, H_c = h_cen/R_x, 1 above: Hamrock and
    Dowson 1977, J. Lubr. Technol. 99, 15 (part IV). The oil at the inlet fills the gap there, h + b^2/(2 R_x)
    [m sqrt(m^2 - 1) - ln(m + sqrt(m^2 - 1))] (Hertz, line contact), from which :func:`starved_rolling` follows.
    """
    reach = 3.06 * (R_x / (semi_b * semi_b) * h_cen) ** 0.58
    factor = at_most(((par.distance - 1.0) / reach) ** 0.29, 1.0)
    out[0] = factor
    out[1] = starved_rolling((h_cen * factor + 0.5 * semi_b * semi_b / R_x * par.gap) / h_min)
    return OK


class Replenishment(FilmFactor):
    """Constants of SKF's kinematic replenishment."""

    k_rs: float = parameter(
        3e-8,
        "replenishment constant K_rs: 3e-8 oil bath at low level and oil jet, 6e-8 grease and oil-air",
        source="SKF, Rolling bearings, catalogue 17000 EN (2018), Friction",
        published_range=(3e-8, 6e-8),
        ge=0.0,
    )
    k_z: float = parameter(
        3.1,
        "geometry constant K_Z; of single row angular contact 4.4, of self-aligning bearings 4.8",
        source="SKF: ball bearings 3.1, single row angular contact 4.4, self-aligning 4.8",
        by_kind=K_Z_OF_KINDS,
        gt=0.0,
    )


class Decay(NamedTuple):
    """Decay of the rolling resistance, and a prescribed film.

    The resistance falls with speed; the case prescribes the film.
    """

    per_speed: float  # -ln(phi_rs) over the mean surface velocity [s/m]
    film: float  # factor on the film
    gap: float  # at the meniscus that leaves this film, over the flooded central film


def prepare_replenishment(parameters: Replenishment, context: Context) -> Decay:
    """Return the decay with the mean surface velocity.

    The contact's surfaces move at d_m/4 (1 - gamma^2) of the rings' relative speed, gamma = D_w/d_m.
    """
    gamma = context.ball_diameter / context.pitch_diameter
    rpm_per_speed = 30.0 / math.pi * 4.0 / (context.pitch_diameter * (1.0 - gamma * gamma))
    d, D = 1e3 * context.bore_diameter, 1e3 * context.outside_diameter
    nu = 1e6 * context.oil.viscosity / context.oil.density
    per_rpm = parameters.k_rs * nu * (d + D) * math.sqrt(parameters.k_z / (2.0 * (D - d)))
    film, gap = given(parameters, context)
    return Decay(per_rpm * rpm_per_speed, film, gap)


@law(
    "supply",
    "skf-replenishment",
    Replenishment,
    role_api=3,
    reference="SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction; "
    f"prescribed film: {INLET}; its rolling: {ROLLING}",
    validity="series and speeds of the catalogue; the film itself is left as flooded where the case prescribes none",
    prepare=prepare_replenishment,
)
def skf_replenishment(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    h_cen: float,
    h_min: float,
    par: Decay,
    out: FloatArray,
) -> int:
    """Starvation by SKF's kinematic replenishment.

    The factor of rolling resistance is phi_rs; the film is as flooded or as the case prescribes.

    phi_rs = exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), mm, mm2/s, 1/min: the inlet does not refill between two
    balls. SKF, Rolling bearings, catalogue 17000 EN (2018), Friction. n from the mean surface velocity of the contact.

    A prescribed film says where the oil begins, and so does phi_rs: both are about the same meniscus, and the nearer
    one counts. The rolling resistance therefore has the smaller of phi_rs and the factor of `supply/constant`.
    """
    out[0] = par.film
    kinematic = exp(-at_most(par.per_speed * at_least(u_mean, 0.0), 700.0))
    out[1] = at_most(kinematic, starved_rolling(par.gap * h_cen / h_min))
    return OK

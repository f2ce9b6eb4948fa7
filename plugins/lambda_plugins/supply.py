"""Supply of oil to a contact: how much the film and the rolling resistance lose where the inlet is not full.

Film and rolling resistance starve differently: the film forms close to the contact, the resistance comes from the whole
inlet. The rolling factor is that of Biboulet and Houpert over the oil that reaches the inlet, so that both laws fall
together and both are exactly 1 for a flooded contact.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, Quantity, law, parameter
from lambda_plugins.shapes import at_least, at_most

_ROLLING = "Biboulet and Houpert 2010, Proc. IMechE J 224, Part 1, eq. 44"
_CHEVALIER = "Chevalier, Lubrecht, Cann, Colin and Dalmaz 1998, J. Tribol. 120, 126"


def starved_rolling(inlet: float) -> float:
    """Rolling resistance over that of a flooded inlet, F/F* = (S^2 + 162.8 S)/(S^2 + 193.1 S + 1257).

    S is the thickness of the oil at the inlet over the minimum film. Biboulet and Houpert 2010, Proc. IMechE J 224
    (Part 1, line contacts, doi 10.1243/13506501JET790), eq. 44: 0 without oil, 1 for endless oil.
    """
    s = at_least(inlet, 0.0)
    if s > 1e9:
        return 1.0
    return (s * s + 162.8 * s) / (s * s + 193.1 * s + 1257.0)


def starved_film(layer: float, gamma: float) -> float:
    """Film over the flooded one, r/(1 + r^gamma)^(1/gamma), of a layer r times as thick as the flooded film.

    Chevalier et al. 1998: all of a thin layer goes through the contact, of a thick one as much as a flooded film takes.
    """
    if layer > 1.0:
        return float((1.0 + layer**-gamma) ** (-1.0 / gamma))
    return float(layer * (1.0 + at_least(layer, 0.0) ** gamma) ** (-1.0 / gamma))


class Gamma(Parameters):
    """How sharply a contact passes from starved to flooded."""

    gamma: float = parameter(
        3.5,
        "exponent of Chevalier's film: 2 soft, 5 sharp",
        source=f"{_CHEVALIER}: 2 to 5 by load and ellipse, middle",
        status="assumed",
        published_range=(2.0, 5.0),
        ge=1.0,
        le=20.0,
    )


class Constant(Gamma):
    """A film factor that is given."""

    film_factor: float | None = parameter(
        None, "factor on the film; absent: lubricant.starvation", source="of the case", gt=0.0, le=1.0
    )


class Given(NamedTuple):
    """A film factor and the layer of oil over the flooded film that leaves it."""

    film: float
    layer: float


def prepare_constant(parameters: Constant, context: Context) -> Given:
    """Return the factor and its layer, which is endless in a flooded contact."""
    factor = context.starvation if parameters.film_factor is None else parameters.film_factor
    loss = 1.0 - factor**parameters.gamma
    return Given(factor, factor / loss ** (1.0 / parameters.gamma) if loss > 0.0 else 1e300)


@law(
    "supply",
    "constant",
    Constant,
    role_api=2,
    reference=f"{_ROLLING}; {_CHEVALIER}",
    validity="the same share of the flooded film at every speed and load",
    prepare=prepare_constant,
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
    """Film factor as given; the rolling resistance of the layer of oil that leaves this film.

    The layer follows from Chevalier's film backwards; the rolling factor is :func:`starved_rolling` of it.
    """
    out[0] = par.film
    out[1] = starved_rolling(par.layer * h_cen / h_min)
    return OK


class OilLayer(Gamma):
    """A layer of oil on the track."""

    layer: Annotated[float, Quantity("small_length")] = parameter(
        ...,
        "thickness of the oil ahead of the contact, both surfaces together",
        source="to be given",
        gt=0.0,
    )


@law(
    "supply",
    "oil-layer",
    OilLayer,
    role_api=2,
    reference=f"{_CHEVALIER}; rolling: {_ROLLING}",
    validity="an even layer of known thickness; the line-contact relation of the rolling resistance on an ellipse",
)
def oil_layer(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    h_cen: float,
    h_min: float,
    par: OilLayer,
    out: FloatArray,
) -> int:
    """Film and rolling resistance of a contact that is fed by a layer of oil.

    Film: :func:`starved_film` (Chevalier et al. 1998), compressibility left out; rolling: :func:`starved_rolling`.
    """
    out[0] = starved_film(par.layer / h_cen, par.gamma)
    out[1] = starved_rolling(par.layer / h_min)
    return OK


class InletDistance(Parameters):
    """Where the inlet begins."""

    distance: float = parameter(..., "m, inlet meniscus from the centre over semi-axis b", source="to be given", gt=1.0)


class Meniscus(NamedTuple):
    """Where the inlet begins, and how wide Hertz's dry contact gapes there."""

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
    role_api=2,
    reference=f"Hamrock and Dowson 1977, J. Lubr. Technol. 99, 15 (part IV); rolling: {_ROLLING}",
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
    """Starvation by the distance of the inlet meniscus, after Hamrock and Dowson.

    h/h_ff = [(m - 1)/(m* - 1)]^0.29 below m* = 1 + 3.06 [(R_x/b)^2 H_c]^0.58, H_c = h_cen/R_x, 1 above: Hamrock and
    Dowson 1977, J. Lubr. Technol. 99, 15 (part IV). The oil at the inlet fills the gap there, h + b^2/(2 R_x)
    [m sqrt(m^2 - 1) - ln(m + sqrt(m^2 - 1))] (Hertz, line contact), from which :func:`starved_rolling` follows.
    """
    reach = 3.06 * (R_x / (semi_b * semi_b) * h_cen) ** 0.58
    factor = at_most(((par.distance - 1.0) / reach) ** 0.29, 1.0)
    out[0] = factor
    out[1] = starved_rolling((h_cen * factor + 0.5 * semi_b * semi_b / R_x * par.gap) / h_min)
    return OK


class Replenishment(Parameters):
    """Constants of SKF's kinematic replenishment."""

    k_rs: float = parameter(
        3e-8,
        "replenishment constant K_rs: 3e-8 oil bath at low level and oil jet, 6e-8 grease and oil-air",
        source="SKF, Rolling bearings, catalogue 17000 EN (2018), Friction",
        published_range=(3e-8, 6e-8),
        ge=0.0,
    )
    k_z: float = parameter(3.1, "geometry constant K_Z", source="SKF: deep groove ball bearings 3.1", gt=0.0)


class Decay(NamedTuple):
    """How fast the rolling resistance falls with speed."""

    per_speed: float  # -ln(phi_rs) over the mean surface velocity [s/m]


def prepare_replenishment(parameters: Replenishment, context: Context) -> Decay:
    """Return the decay with the mean surface velocity.

    The contact's surfaces move at d_m/4 (1 - gamma^2) of the rings' relative speed, gamma = D_w/d_m.
    """
    gamma = context.ball_diameter / context.pitch_diameter
    rpm_per_speed = 30.0 / math.pi * 4.0 / (context.pitch_diameter * (1.0 - gamma * gamma))
    d, D = 1e3 * context.bore_diameter, 1e3 * context.outside_diameter
    nu = 1e6 * context.oil.viscosity / context.oil.density
    return Decay(parameters.k_rs * nu * (d + D) * math.sqrt(parameters.k_z / (2.0 * (D - d))) * rpm_per_speed)


@law(
    "supply",
    "skf-replenishment",
    Replenishment,
    role_api=2,
    reference="SKF, Rolling bearings, catalogue 17000 EN (2018), chapter Friction",
    validity="series and speeds of the catalogue; the film itself is left as flooded",
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
    """SKF's kinematic replenishment: rolling resistance by phi_rs, the film as flooded.

    phi_rs = exp(-K_rs nu n (d + D) sqrt(K_Z/(2 (D - d)))), mm, mm2/s, 1/min: the inlet does not refill between two
    balls. SKF, Rolling bearings, catalogue 17000 EN (2018), Friction. n from the mean surface velocity of the contact.
    """
    out[0] = 1.0
    out[1] = math.exp(-par.per_speed * at_least(u_mean, 0.0))
    return OK

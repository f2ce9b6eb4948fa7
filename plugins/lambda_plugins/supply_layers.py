"""Define the supply from oil layers on the tracks.

A given layer, and one that contacts press aside while they run.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, Quantity, law, parameter
from lambda_plugins.shapes import at_least
from lambda_plugins.starved_inlet import CHEVALIER, INLET, ROLLING, meniscus, starved_film, starved_rolling

_SIDE_FLOW = (
    "van Zoelen, Venner and Lugt 2009, Proc. IMechE J 223, 541; Venner, van Zoelen and Lugt 2012, Tribol. Int. 47, 175"
)
HALVINGS = 54  # of an interval on a logarithmic scale, down to rounding
FAR = 30.0  # of the layer that replenishment keeps up: from here on a series has all digits of its clock


class OilLayer(Parameters):
    """A layer of oil on the track."""

    gamma: float = parameter(
        3.5,
        "exponent of Chevalier's film: 2 soft, 5 sharp",
        source=f"{CHEVALIER}: 2 to 5 by load and ellipse, middle",
        status="assumed",
        published_range=(2.0, 5.0),
        ge=1.0,
        le=20.0,
    )
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
    role_api=3,
    reference=f"{CHEVALIER}; inlet: {INLET}; rolling: {ROLLING}",
    validity="an even layer of known thickness; inlet and rolling resistance of line contacts",
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
    """Contact that is fed by a layer of oil.

    The law reduces film and rolling resistance.

    Film: :func:`starved_film` (Chevalier et al. 1998), compressibility left out. Rolling: of the inlet that leaves this
    film, :func:`meniscus` and :func:`starved_rolling`.
    """
    film = starved_film(par.layer / h_cen, par.gamma)
    out[0] = film
    out[1] = starved_rolling(meniscus(film) * h_cen / h_min)
    return OK


class SideFlow(OilLayer):
    """Layer of oil, its age and its supply."""

    time: Annotated[float, Quantity("time")] = parameter(
        ..., "how long contacts have run on the layer", source="to be given", ge=0.0
    )
    replenishment: Annotated[float, Quantity("velocity")] = parameter(
        "0 nm/s",
        "thickness that grease or oil-air add to each track in a time",
        source="Venner et al. 2012: none is the severe case",
        status="assumed",
        ge=0.0,
    )


class Track(NamedTuple):
    """Layer of a ring's track and its wear by contacts."""

    gamma: float
    fresh: float  # layer at the start, both surfaces [m]
    time: float  # since then [s]
    replenishment: float  # of each surface [m/s]
    passes: float  # 2 pi Z/(l_t eta_0) [1/(Pa s m)]
    alpha_p: float  # [1/Pa]


def prepare_side_flow(parameters: SideFlow, context: Context) -> Track:
    """Return the track of one ring.

    l_t is the ring's circumference and half of those of the balls, which both rings share.
    """
    length = math.pi * (context.race_diameter + 0.5 * context.ball_count * context.ball_diameter)
    return Track(
        parameters.gamma,
        parameters.layer,
        parameters.time,
        parameters.replenishment,
        2.0 * math.pi * context.ball_count / (length * context.oil.viscosity),
        context.oil.alpha_p,
    )


def side_flow(passes: float, p_max: float, along: float, across: float, alpha_p: float) -> float:
    """Return the side flow F [1/(m2 s)] of a layer.

    It is the rate at which contacts press a layer off the track, dh/dt = -(1/12) F h^3.

    F = (2 Z/l_t) (p_h/a^2) (b/eta_0) pi [(pi alpha p_h/2)^1.5 + 1]^(-2/3), a across and b along rolling; the bracket is
    an approximation of pi [I_0(alpha p_h) - L_0(alpha p_h)], the integral of exp(-alpha p)/sqrt(1 - x^2/b^2) over the
    middle of Hertz's ellipse: van Zoelen, Venner and Lugt 2009.
    """
    thickened = ((0.5 * math.pi * alpha_p * p_max) ** 1.5 + 1.0) ** (-2.0 / 3.0)
    return float(passes * p_max * along / (across * across) * thickened)


def density_ratio(p: float) -> float:
    """Return the density over that at ambient pressure.

    It follows Dowson and Higginson 1966.
    """
    return float((5.9e8 + 1.34 * p) / (5.9e8 + p))


def _clock(y: float) -> float:
    """Return the time of a decay to y.

    The decay follows dy/dtau = 1 - y^3: to y from nothing below 1, from infinity above 1.
    """
    if y > FAR:  # the closed form would leave 1/y^2 of its digits
        cube = y**-3.0
        return float((0.5 + cube * (0.2 + cube * (0.125 + cube / 11.0))) / (y * y))
    root = math.sqrt(3.0)
    logarithms = math.log(y * y + y + 1.0) / 6.0 - math.log(at_least(abs(1.0 - y), 1e-300)) / 3.0
    if y > 1.0:
        return logarithms - math.atan(root / (2.0 * y + 1.0)) / root
    return logarithms + math.atan(root * y / (y + 2.0)) / root


def layer_after(fresh: float, time: float, flow: float, replenishment: float) -> float:
    """Return the layer of both surfaces after a time.

    dh/dt = -(1/12) F h^3 + 2 R.

    Without replenishment (F t/6 + h_0^-2)^(-1/2); after a long time with it 2 (3 R/F)^(1/3). Between them
    h = h_eq y with dy/dtau = 1 - y^3, tau = 2 R t/h_eq, whose integral is turned round by halving.
    """
    if replenishment <= 0.0 or flow <= 0.0:
        return float((flow * time / 6.0 + fresh**-2.0) ** -0.5 + 2.0 * replenishment * time)
    steady = 2.0 * (3.0 * replenishment / flow) ** (1.0 / 3.0)
    start = fresh / steady
    if abs(start - 1.0) < 1e-12:
        return float(steady)
    end = _clock(start) + 2.0 * replenishment * time / steady
    passed, ahead = start, 1.0
    for _ in range(HALVINGS):
        middle = math.sqrt(passed) * math.sqrt(ahead)
        if _clock(middle) > end:
            ahead = middle
        else:
            passed = middle
    return float(steady * math.sqrt(passed) * math.sqrt(ahead))


@law(
    "supply",
    "side-flow",
    SideFlow,
    role_api=3,
    reference=f"{_SIDE_FLOW}; {CHEVALIER}; inlet: {INLET}; rolling: {ROLLING}",
    validity="base oil of a grease or an oil-air layer after churning; every contact of a track taken as this one; no "
    "flow back from the ridges at the sides of the track, no spin; originals not seen, derived anew",
    prepare=prepare_side_flow,
)
def side_flow_layer(
    u_mean: float,
    load: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    h_cen: float,
    h_min: float,
    par: Track,
    out: FloatArray,
) -> int:
    """Layer that every overrolling presses aside.

    The law reduces film and rolling resistance.

    The pressure of a contact drives oil out of its middle to both sides, most where the oil is still thin; what it
    loses does not come back.

    Layer: :func:`layer_after` with :func:`side_flow`. Pressed to the density ratio rho it is a film of
    layer/rho; oil flows aside at the rim, where it is neither thick nor dense, so that a starved film is
    h_c(t) = (rho^2 F t/6 + h_0^-2)^(-1/2) (Venner, van Zoelen and Lugt 2012). Film: :func:`starved_film` (Chevalier
    et al. 1998); rolling: of the inlet that leaves this film.
    """
    if semi_a <= 0.0 or semi_b <= 0.0:
        out[0], out[1] = 1.0, 1.0
        return OK
    p_max = 1.5 * at_least(load, 0.0) / (math.pi * semi_a * semi_b)
    dense = density_ratio(p_max)
    flow = side_flow(par.passes, p_max, semi_b, semi_a, par.alpha_p)
    layer = layer_after(par.fresh, par.time, flow, par.replenishment)
    film = starved_film(layer / (dense * h_cen), par.gamma)
    out[0] = film
    out[1] = starved_rolling(meniscus(film) * h_cen / h_min)
    return OK

"""Define contacts of a roller with its pocket or neighbours.

A pocket has two bars across rolling and two end faces along the roller; without a cage rollers touch each other.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Quantity, law, parameter
from lambda_plugins.cage_contact import CageContact, Guide, Pocket, push_back
from lambda_plugins.shapes import at_least

_LIMITS_AT = 1e-12  # [m] below this distance from the pocket's axis no direction of contact is defined


class RollerPocket(Pocket):
    """Constants of a roller's pocket."""

    end_clearance: Annotated[float, Quantity("small_length")] | None = parameter(
        None,
        "clearance of roller and pocket along the roller; absent: as between the bars",
        source="assumption",
        status="assumed",
        ge=0.0,
    )


class Neighbours(CageContact):
    """Constants of two neighbouring rollers."""

    film_width: float = parameter(
        0.2,
        "half the width of the oil film between the rollers over their diameter; 0: no oil between them",
        source="assumption: as in pockets",
        status="assumed",
        ge=0.0,
        le=0.5,
    )
    thinnest_film: Annotated[float, Quantity("small_length")] = parameter(
        "1 um",
        "film at first touch of the rollers: roughness",
        source="assumption: as in pockets",
        status="assumed",
        gt=0.0,
    )


class RollerPair(NamedTuple):
    """Two neighbouring rollers as the kernel sees them."""

    contact: Guide
    reduced: float  # radius of both [m]; 0: no oil is squeezed
    reach: float  # half of the width of the film [m]
    length: float  # of the contact [m]
    touch: float  # film at first touch [m]


class RollerGuide(NamedTuple):
    """Bars and end faces as the kernel sees them."""

    bars: Guide
    ends: Guide
    reduced: float  # radius R_x of roller and bar [m]; 0: no oil is squeezed
    reach: float  # half of the width of the film [m]
    length: float  # of the bar [m]
    touch: float  # film at first touch [m]


def prepare_roller(parameters: RollerPocket, context: Context) -> RollerGuide:
    """Return the constants of a roller's pocket.

    Play and lever of bars and end faces, and the film of a roller at a round bar of the pocket's width.

    A roller of radius R in a bar of radius R + c has the reduced radius R_x = R (R + c)/c.
    """
    if not context.pocket_clearance >= 0.0:
        raise ValueError("the cage has no pocket clearance: give a cage with pockets")
    radius, play, width = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance, parameters.film_width
    ends = play if parameters.end_clearance is None else 0.5 * parameters.end_clearance
    wet = width > 0.0 and play > 0.0 and context.cage_width > 0.0
    reduced = radius * (radius + play) / play if wet else 0.0
    return RollerGuide(
        Guide(parameters, play, radius),
        Guide(parameters, ends, 0.0),
        reduced,
        width * context.ball_diameter,
        context.cage_width if wet else 0.0,
        parameters.thinnest_film,
    )


def prepare_pair(parameters: Neighbours, context: Context) -> RollerPair:
    """Return the distance of first touch and the film.

    They touch at the rollers' diameter. The film is that of two cylinders, R_x = R/2.
    """
    radius, width = 0.5 * context.ball_diameter, parameters.film_width
    wet = width > 0.0 and context.radius_y > 0.0
    return RollerPair(
        Guide(parameters, context.ball_diameter, radius),
        0.5 * radius if wet else 0.0,
        width * context.ball_diameter,
        context.radius_y if wet else 0.0,
        parameters.thinnest_film,
    )


def squeezed_line(guide: RollerGuide | RollerPair, gap: float, closing: float, eta0: float) -> float:
    """Return the squeeze force of rollers and bars [N].

    They close at a speed; no film pulls.

    Reynolds' equation has p = 6 eta v R_x (1/g^2 - 1/g_w^2) with the gap g = h + x^2/(2 R_x), g_w where the film ends
    at x = w: F = 6 eta v L R_x (k/h^2) [atan u + u/(1 + u^2) - 2 u/(1 + u^2)^2], k = sqrt(2 R_x h), u = w/k. Wide
    against the gap it is 3 sqrt(2) pi eta v L (R_x/h)^1.5, narrow that of parallel plates, eta v L (2 w/h)^3.
    """
    if closing <= 0.0:
        return 0.0
    h = at_least(gap, 0.0) + guide.touch
    k = math.sqrt(2.0 * guide.reduced * h)
    u = guide.reach / k
    share = 1.0 / (1.0 + u * u)
    shape = math.atan(u) + u * share - 2.0 * u * share * share
    return 6.0 * eta0 * closing * guide.length * guide.reduced * k / (h * h) * shape


@law(
    "cage_contact",
    "roller-pocket",
    RollerPocket,
    role_api=3,
    reference="Syla et al. 2026, Lubricants 14, 154, section 2.5; Teutsch 2005",
    validity="rigid bodies with a penalty contact; round bars, flat end faces; all constants are assumptions",
    prepare=prepare_roller,
    contact="line",
)
def roller_pocket(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: RollerGuide, out: FloatArray
) -> int:
    """Roller between the bars and end faces of its pocket.

    Bars are round about the roller, as those of cages that rollers guide: one pushes once the roller's axis is off the
    pocket's by half of the clearance, across rolling or along the radius, at the lever of the roller's radius. That
    holds the cage in the middle. Along the roller an end face pushes. Contact law and friction are those of balls in
    pockets; :func:`squeezed_line` is the film before a bar is touched. Where both push, the force acts at the mean of
    both points, weighted by their normal forces.
    """
    out[:] = 0.0
    away = math.sqrt(r[1] * r[1] + r[2] * r[2])
    n1, n2 = (r[1] / away, r[2] / away) if away > _LIMITS_AT else (0.0, 1.0)
    over = away - par.bars.play
    film = squeezed_line(par, -over, n1 * v_rel[1] + n2 * v_rel[2], eta0) if par.reduced > 0.0 else 0.0
    if over > 0.0 or film > 0.0:
        push_back(0.0, n1, n2, over, r, v_rel, omega_rel, par.bars, film, out)
    end = 1.0 if r[0] >= 0.0 else -1.0
    beyond = abs(r[0]) - par.ends.play
    if beyond > 0.0:
        f0, f1, f2, p0, p1, p2 = out[0], out[1], out[2], out[3], out[4], out[5]
        bar = math.sqrt(f1 * f1 + f2 * f2)
        push_back(end, 0.0, 0.0, beyond, r, v_rel, omega_rel, par.ends, 0.0, out)
        face = abs(out[0])
        share = bar / (bar + face) if bar > 0.0 else 0.0
        out[0] += f0
        out[1] += f1
        out[2] += f2
        out[3] += share * (p0 - out[3])
        out[4] += share * (p1 - out[4])
        out[5] += share * (p2 - out[5])
    return OK


@law(
    "cage_contact",
    "roller-roller",
    Neighbours,
    role_api=3,
    reference="Teutsch 2005; Reynolds' equation of a cylinder; Yang et al. 2001, J. Tribol. 123, 36 (what is left out)",
    validity="parallel cylinders but for small angles; boundary friction; all constants are assumptions",
    prepare=prepare_pair,
    contact="line",
)
def roller_roller(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: RollerPair, out: FloatArray
) -> int:
    """Two neighbouring rollers of a bearing without a cage.

    They touch when their axes are a diameter apart. r is the position of one axis from the other's. Contact law and
    friction are those of pockets. Both surfaces move at the same speed in opposite directions, so that no oil is drawn
    in: the rollers slide with boundary friction, and a film that heat makes there (Yang et al. 2001) is left out.
    Before they touch, :func:`squeezed_line` pushes them apart.
    """
    out[:] = 0.0
    apart = math.sqrt(r[1] * r[1] + r[2] * r[2])
    if apart > _LIMITS_AT:
        n1, n2 = -r[1] / apart, -r[2] / apart
        over = par.contact.play - apart
        film = squeezed_line(par, -over, n1 * v_rel[1] + n2 * v_rel[2], eta0) if par.reduced > 0.0 else 0.0
        if over > 0.0 or film > 0.0:
            push_back(0.0, n1, n2, over, r, v_rel, omega_rel, par.contact, film, out)
    return OK

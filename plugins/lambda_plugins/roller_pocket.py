"""Contact of a roller with its pocket in the cage: two bars across rolling, two end faces along the roller."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Quantity, law, parameter
from lambda_plugins.cage_contact import Guide, Pocket, push_back
from lambda_plugins.shapes import at_least


class RollerPocket(Pocket):
    """Constants of a roller's pocket."""

    end_clearance: Annotated[float, Quantity("small_length")] | None = parameter(
        None,
        "clearance of roller and pocket along the roller; absent: as between the bars",
        source="assumption",
        status="assumed",
        ge=0.0,
    )


class RollerGuide(NamedTuple):
    """Bars and end faces as the kernel sees them."""

    bars: Guide
    ends: Guide
    film: float  # 3 sqrt(2) pi L R^1.5 of the film that a bar squeezes [m^2.5]; 0: there is none
    edge: float  # what the gap grows by from the middle of the film to the end of the bar [m]
    touch: float  # film at first touch [m]


def prepare_roller(parameters: RollerPocket, context: Context) -> RollerGuide:
    """Return play and lever of bars and end faces, and the film of a roller at a flat bar of the pocket's width."""
    if not context.pocket_clearance >= 0.0:
        raise ValueError("the cage has no pocket clearance: give a cage with pockets")
    radius, play, width = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance, parameters.film_width
    ends = play if parameters.end_clearance is None else 0.5 * parameters.end_clearance
    length = context.cage_width if context.cage_width > 0.0 else 0.0
    film = 3.0 * math.sqrt(2.0) * math.pi * length * radius**1.5 if width > 0.0 else 0.0
    edge = max((width * context.ball_diameter) ** 2 / (2.0 * radius), 1e-9)
    return RollerGuide(
        Guide(parameters, play, radius), Guide(parameters, ends, 0.0), film, edge, parameters.thinnest_film
    )


def squeezed_line(guide: RollerGuide, gap: float, closing: float, eta0: float) -> float:
    """Return the force of the film between a roller and a flat bar that close at a speed [N]; no film pulls.

    Reynolds' equation has p = 6 eta v R/gap^2 for gap = h + x^2/(2 R), F = 3 sqrt(2) pi eta v L (R/h)^1.5, less that of
    the gap where the bar ends.
    """
    if closing <= 0.0:
        return 0.0
    h = at_least(gap, 0.0) + guide.touch
    thinning: float = h**-1.5 - (h + guide.edge) ** -1.5
    return guide.film * eta0 * closing * thinning


@law(
    "cage_contact",
    "roller-pocket",
    RollerPocket,
    role_api=2,
    reference="Syla et al. 2026, Lubricants 14, 154, section 2.5; Teutsch 2005",
    validity="rigid bodies with a penalty contact; flat bars and end faces; all constants are assumptions",
    prepare=prepare_roller,
    contact="line",
)
def roller_pocket(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: RollerGuide, out: FloatArray
) -> int:
    """Roller between the bars and end faces of its pocket; free along the radius.

    Along rolling a bar pushes once the roller's axis is off the pocket's by half of the clearance, at the lever of the
    roller's radius; along the roller an end face does. Contact law and friction are those of balls in pockets. Before
    a bar is touched oil is squeezed, F = 3 sqrt(2) pi eta v L (R/h)^1.5. Where both push, the force acts at the mean of
    both points, weighted by their normal forces.
    """
    out[:] = 0.0
    side = 1.0 if r[2] >= 0.0 else -1.0
    over = abs(r[2]) - par.bars.play
    film = squeezed_line(par, -over, side * v_rel[2], eta0) if par.film > 0.0 else 0.0
    if over > 0.0 or film > 0.0:
        push_back(0.0, 0.0, side, over, r, v_rel, omega_rel, par.bars, film, out)
    end = 1.0 if r[0] >= 0.0 else -1.0
    beyond = abs(r[0]) - par.ends.play
    if beyond > 0.0:
        f0, f1, f2, p0, p1, p2 = out[0], out[1], out[2], out[3], out[4], out[5]
        bar = abs(f2)
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

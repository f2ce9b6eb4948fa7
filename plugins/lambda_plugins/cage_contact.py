"""Define contacts of the cage with balls and rings.

They include contacts of two balls without a cage.

One penalty contact for all: a spring whose stiffness sets in over the first fraction of a micrometre, damping that
grows from zero at first touch and never pulls, and cubic friction at the point of contact against the slip there. In
a pocket the oil is squeezed before ball and cage touch.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple, Self

from pydantic import model_validator

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, Quantity, law, parameter
from lambda_plugins.shapes import at_least, at_most, cubic_friction_slope

_ASSUMED = "assumption; 5e6 N/m and the friction law as in the group's models"
_VALIDITY = "rigid bodies with a penalty contact; all constants are assumptions"
_SOURCES = (
    "Syla et al. 2026, Lubricants 14, 154, section 2.5; Teutsch 2005; "
    "Pitois et al. 2000, J. Colloid Interface Sci. 231, 26"
)
_LIMITS_AT = 1e-12  # [m] below this distance from the centre no direction of contact is defined


class CageContact(Parameters):
    """Constants of a contact of the cage."""

    stiffness: Annotated[float, Quantity("stiffness")] = parameter(
        "5e6 N/m", "contact stiffness", source=_ASSUMED, status="assumed", gt=0.0
    )
    damping: Annotated[float, Quantity("damping")] = parameter(
        "50 N s/m",
        "damping in full contact: 10 us times the stiffness, as on the raceways",
        source=_ASSUMED,
        status="assumed",
        ge=0.0,
    )
    full_penetration: Annotated[float, Quantity("small_length")] = parameter(
        "2 um", "penetration from which damping is full", source=_ASSUMED, status="assumed", gt=0.0
    )
    onset: Annotated[float, Quantity("small_length")] = parameter(
        "0.5 um", "penetration over which the stiffness sets in", status="numerical", gt=0.0
    )
    mu_s: float = parameter(0.08, "largest coefficient of friction, at v_s", source=_ASSUMED, status="assumed", ge=0.0)
    mu_d: float = parameter(
        0.05, "coefficient of friction in full sliding, from v_d", source=_ASSUMED, status="assumed", ge=0.0
    )
    v_s: Annotated[float, Quantity("velocity")] = parameter(
        "0.05 m/s", "slip at the largest coefficient", source=_ASSUMED, status="assumed", gt=0.0
    )
    v_d: Annotated[float, Quantity("velocity")] = parameter(
        "0.5 m/s", "slip from which the coefficient is constant", source=_ASSUMED, status="assumed", gt=0.0
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.v_d <= self.v_s:
            raise ValueError(f"v_d ({self.v_d:g} m/s) must be above v_s ({self.v_s:g} m/s)")
        return self


class Pocket(CageContact):
    """Constants of a pocket."""

    film_width: float = parameter(
        0.2,
        "half the width of the oil film between ball and pocket over the ball's diameter; 0: no oil in the pocket",
        source="assumption: the pocket's wall",
        status="assumed",
        ge=0.0,
        le=0.5,
    )
    thinnest_film: Annotated[float, Quantity("small_length")] = parameter(
        "1 um", "film at first touch of ball and pocket: roughness", source=_ASSUMED, status="assumed", gt=0.0
    )


class Guide(NamedTuple):
    """A contact of the cage as its kernels see it."""

    contact: CageContact
    play: float  # way from the centre to first touch [m]
    arm: float  # from the body's centre to the contact point, along the way [m]
    film: float = 0.0  # 12 pi sqrt(R_x R_y)/(1/R_x + 1/R_y) of the film that is squeezed [m2]; 0: there is none
    edge: float = 1.0  # what the gap grows by from the middle of the film to the end of the wall [m]
    touch: float = 1.0  # film at first touch [m]


def prepare_sphere(parameters: Pocket, context: Context) -> Guide:
    """Return the constants of a spherical pocket.

    They include the pocket's clearance, the ball's radius and the film between both.

    A ball of radius R_b in a sphere of radius R_b + c: R_x = R_y = R_b (R_b + c)/c.
    """
    return _pocket(parameters, context, round_along=True)


def prepare_cylinder(parameters: Pocket, context: Context) -> Guide:
    """Return the constants of a cylindrical pocket.

    Its wall is straight along its axis.

    R_x = R_b along the axis, where the film ends with the wall, R_y = R_b (R_b + c)/c across it.
    """
    return _pocket(parameters, context, round_along=False)


def _pocket(parameters: Pocket, context: Context, *, round_along: bool) -> Guide:
    if not context.pocket_clearance >= 0.0:
        raise ValueError("the cage has no pocket clearance: give a cage with pockets")
    radius, play, width = 0.5 * context.ball_diameter, 0.5 * context.pocket_clearance, parameters.film_width
    if width == 0.0 or play == 0.0:
        return Guide(parameters, play, radius)
    across = radius * (radius + play) / play
    along = across if round_along else radius
    film = 12.0 * math.pi * math.sqrt(along * across) / (1.0 / along + 1.0 / across)
    edge = (width * context.ball_diameter) ** 2 / (2.0 * along)
    return Guide(parameters, play, radius, film, edge, parameters.thinnest_film)


def squeezed(guide: Guide, gap: float, closing: float, eta0: float) -> float:
    """Return the squeeze force of ball and pocket [N].

    They are `gap` apart and close at a speed; no film pulls.

    Reynolds' equation between paraboloids at an approach v has p = 6 eta v/(1/R_x + 1/R_y) (1/gap^2 - 1/h_e^2), zero
    on the line gap = h_e = h + b^2/2 R_x that meets the wall's end: F = 12 pi eta v sqrt(R_x R_y)/(1/R_x + 1/R_y)
    (1 - h/h_e)^2/h. Round a sphere it is Taylor's 6 pi eta v R^2/h where wide against the gap, Stefan's
    3 pi eta v b^4/2 h^3 of parallel discs where narrow. Oil that has left is not sucked in again.
    """
    if closing <= 0.0:
        return 0.0
    h = at_least(gap, 0.0) + guide.touch
    share = guide.edge / (h + guide.edge)
    return guide.film * eta0 * closing / h * share * share


def prepare_land(parameters: CageContact, context: Context) -> Guide:
    """Return the land's clearance and radius with the constants.

    The radius is negative on the inner ring.

    A cage displaced along n touches the outer ring's land at +R n, the inner ring's land at -R n.
    """
    if not (context.land_clearance >= 0.0 and context.land_diameter > 0.0):
        raise ValueError("the cage is not guided by a ring: it has no land clearance or land diameter")
    side = -1.0 if context.element == "cage_inner" else 1.0
    return Guide(parameters, 0.5 * context.land_clearance, 0.5 * side * context.land_diameter)


def prepare_balls(parameters: CageContact, context: Context) -> Guide:
    """Return the balls' contact constants.

    The distance of first touch is the balls' diameter.
    """
    return Guide(parameters, context.ball_diameter, 0.5 * context.ball_diameter)


def push_back(
    n0: float,
    n1: float,
    n2: float,
    penetration: float,
    r: FloatArray,
    v_rel: FloatArray,
    omega_rel: FloatArray,
    guide: Guide,
    film: float,
    out: FloatArray,
) -> None:
    """Write the force and point that restore the play.

    The body is `penetration` beyond its play in the unit direction n.

    Normal force along -n: k e^2/(2 e_0) up to the onset e_0 and k (e - e_0/2) above, plus damping
    d s^2 (3 - 2 s) de/dt, s = e/full penetration, never below zero, plus the force of a film: F_N. Friction: mu(v) F_N
    against the slip v_rel + omega_rel x (P - r) at P = r + arm n, cubic in its amount. mu is of a mixed contact: who
    carries, film or asperities, does not change it.
    """
    contact = guide.contact
    onset = contact.onset
    e = at_least(penetration, 0.0)
    spring = 0.5 * e * e / onset if e < onset else e - 0.5 * onset
    s = at_most(e / contact.full_penetration, 1.0)
    closing = v_rel[0] * n0 + v_rel[1] * n1 + v_rel[2] * n2
    normal = at_least(contact.stiffness * spring + contact.damping * s * s * (3.0 - 2.0 * s) * closing, 0.0) + film
    x0 = guide.arm * n0
    x1 = guide.arm * n1
    x2 = guide.arm * n2
    slip0 = v_rel[0] + omega_rel[1] * x2 - omega_rel[2] * x1
    slip1 = v_rel[1] + omega_rel[2] * x0 - omega_rel[0] * x2
    slip2 = v_rel[2] + omega_rel[0] * x1 - omega_rel[1] * x0
    across = slip0 * n0 + slip1 * n1 + slip2 * n2
    slip0 -= across * n0
    slip1 -= across * n1
    slip2 -= across * n2
    speed = math.sqrt(slip0 * slip0 + slip1 * slip1 + slip2 * slip2)
    drag = normal * cubic_friction_slope(speed, contact.mu_s, contact.mu_d, contact.v_s, contact.v_d)
    out[0] = -normal * n0 - drag * slip0
    out[1] = -normal * n1 - drag * slip1
    out[2] = -normal * n2 - drag * slip2
    out[3] = r[0] + x0
    out[4] = r[1] + x1
    out[5] = r[2] + x2


@law(
    "cage_contact",
    "spherical-pocket",
    Pocket,
    role_api=3,
    reference=_SOURCES,
    validity=_VALIDITY,
    prepare=prepare_sphere,
)
def spherical_pocket(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: Guide, out: FloatArray
) -> int:
    """Ball in a spherical pocket.

    They touch when the ball's centre is off the pocket's by the radial clearance.

    Syla et al. 2026, eq. 28 (F = mu_c(v) F_N with Teutsch's cubic coefficient); stiffness and damping are assumptions.
    Before that the oil between both is squeezed: F = 6 pi eta v R^2/h (1 - h/h_e)^2 (Pitois et al. 2000).
    """
    out[:] = 0.0
    distance = math.sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2])
    if (distance > par.play or par.film > 0.0) and distance > _LIMITS_AT:
        n0 = r[0] / distance
        n1 = r[1] / distance
        n2 = r[2] / distance
        film = squeezed(par, par.play - distance, v_rel[0] * n0 + v_rel[1] * n1 + v_rel[2] * n2, eta0)
        if film > 0.0 or distance > par.play:
            push_back(n0, n1, n2, distance - par.play, r, v_rel, omega_rel, par, film, out)
    return OK


@law(
    "cage_contact",
    "cylindrical-pocket",
    Pocket,
    role_api=3,
    reference=_SOURCES,
    validity=_VALIDITY,
    prepare=prepare_cylinder,
)
def cylindrical_pocket(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: Guide, out: FloatArray
) -> int:
    """Ball in a cylindrical pocket with a radial axis.

    The ball is free along the radius, for ring-guided cages.

    Contact law and friction as in the spherical pocket. The film's wall is round across the pocket's axis only:
    F = 12 pi eta v sqrt(R_x R_y)/(1/R_x + 1/R_y) (1 - h/h_e)^2/h with R_x = R_b (own work).
    """
    out[:] = 0.0
    distance = math.sqrt(r[0] * r[0] + r[2] * r[2])
    if (distance > par.play or par.film > 0.0) and distance > _LIMITS_AT:
        n0 = r[0] / distance
        n2 = r[2] / distance
        film = squeezed(par, par.play - distance, v_rel[0] * n0 + v_rel[2] * n2, eta0)
        if film > 0.0 or distance > par.play:
            push_back(n0, 0.0, n2, distance - par.play, r, v_rel, omega_rel, par, film, out)
    return OK


@law(
    "cage_contact",
    "land-guidance",
    CageContact,
    role_api=3,
    reference="Syla et al. 2026, Lubricants 14, 154, section 2.5; Teutsch 2005",
    validity=_VALIDITY,
    prepare=prepare_land,
)
def land_guidance(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: Guide, out: FloatArray
) -> int:
    """Cage on the cylindrical land of a ring.

    The contact is at one axial station; the cage is free along the axis.

    The cage's centre at this station is off the land's by more than the radial clearance; inner or outer ring follows
    from the force element. Contact law and friction as in the pockets; a lubricating film on the land is left out.
    """
    out[:] = 0.0
    distance = math.sqrt(r[1] * r[1] + r[2] * r[2])
    if distance > par.play and distance > _LIMITS_AT:
        push_back(0.0, r[1] / distance, r[2] / distance, distance - par.play, r, v_rel, omega_rel, par, 0.0, out)
    return OK


@law(
    "cage_contact",
    "ball-ball",
    CageContact,
    role_api=3,
    reference="Syla et al. 2026, Lubricants 14, 154, section 2.5; Teutsch 2005",
    validity=_VALIDITY,
    prepare=prepare_balls,
)
def ball_ball(r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: Guide, out: FloatArray) -> int:
    """Two neighbouring balls of a bearing without a cage.

    They touch when their centres are a diameter apart.

    r is the position of one centre from the other's. Contact law and friction as in the pockets.
    """
    out[:] = 0.0
    distance = math.sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2])
    if distance < par.play and distance > _LIMITS_AT:
        n0 = -r[0] / distance
        n1 = -r[1] / distance
        n2 = -r[2] / distance
        push_back(n0, n1, n2, par.play - distance, r, v_rel, omega_rel, par, 0.0, out)
    return OK


@law("cage_contact", "none", role_api=3, reference="-", contact="any")
def none(
    r: FloatArray, v_rel: FloatArray, omega_rel: FloatArray, eta0: float, par: NoParameters, out: FloatArray
) -> int:
    """No contact of the cage."""
    out[:] = 0.0
    return OK

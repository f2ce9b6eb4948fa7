"""Damp the ball-raceway contact along its normal."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, Quantity, exp, law, parameter
from lambda_plugins.film_thickness import Floors, chittenden
from lambda_plugins.film_thickness import prepare as prepare_floors
from lambda_plugins.normal_contact import stiffness
from lambda_plugins.shapes import at_least, at_most


class CubicDamping(Parameters):
    """Parameters of Teutsch's cubic damping."""

    time_constant: Annotated[float, Quantity("time")] = parameter(
        "10 us",
        "full damping over the contact stiffness dQ/d(delta) at the mean load",
        source="assumption; the paper prints no value",
        status="assumed",
        ge=0.0,
    )
    full_penetration: Annotated[float, Quantity("small_length")] = parameter(
        "2 um", "penetration delta_max from which damping is full", source="assumption", status="assumed", gt=0.0
    )
    coefficient: Annotated[float, Quantity("damping")] | None = parameter(
        None, "full damping d_max itself; replaces time_constant", source="measured values", status="assumed"
    )


class Onset(NamedTuple):
    """Full damping, and where it is reached."""

    d_max: float  # [N s/m]
    delta_max: float  # [m]


def prepare_cubic(parameters: CubicDamping, context: Context) -> Onset:
    """Return the damping's onset.

    It is d_max from the contact stiffness at the mean load unless given.
    """
    full = parameters.coefficient
    if full is None:
        load = max(context.mean_load, 1.0)
        full = parameters.time_constant * stiffness(load, context.radius_x, context.radius_y, context.e_eff)
    if not math.isfinite(full) or full < 0.0:
        raise ValueError(f"damping coefficient {full:g} N s/m is not a finite number >= 0")
    return Onset(full, parameters.full_penetration)


@law(
    "damping",
    "cubic",
    CubicDamping,
    role_api=3,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Syla et al. 2026, Lubricants 14, 154, eq. 12-13",
    validity="parametric: both constants are to be identified; defaults are assumptions",
    prepare=prepare_cubic,
)
def cubic(delta: float, delta_dot: float, load: float, par: Onset, out: FloatArray) -> int:
    """Damping that grows from zero at first touch, after Teutsch.

    F_D = d(delta) delta_dot with d = d_max s^2 (3 - 2 s), s = delta/delta_max, d = 0 below s = 0 and d_max above
    s = 1: Syla et al. 2026, eq. 12-13. Continuous at first touch; a contact never pulls, F_N + F_D >= 0.
    """
    s = at_most(at_least(delta / par.delta_max, 0.0), 1.0)
    out[0] = at_least(par.d_max * s * s * (3.0 - 2.0 * s) * delta_dot, -load)
    return OK


class SqueezeFilm(CubicDamping):
    """Parameters of cubic damping with the squeeze film."""

    layer: Annotated[float, Quantity("small_length")] = parameter(
        "10 um",
        "oil on ball and raceway together: the film is squeezed below that gap",
        source="assumption",
        status="assumed",
        gt=0.0,
    )
    thinnest_film: Annotated[float, Quantity("small_length")] = parameter(
        "0.2 um",
        "roughness that keeps ball and raceway apart where no film does",
        source="assumption",
        status="assumed",
        gt=0.0,
    )


class Squeezed(NamedTuple):
    """The cubic damping's onset and the film's numbers."""

    d_max: float  # [N s/m]
    delta_max: float  # [m]
    reach: float  # gap from which the film is squeezed [m]; the solver looks at the contact from there on
    touch: float  # film at first touch [m]
    shape: float  # 12 pi sqrt(R_x R_y)/(1/R_x + 1/R_y) [m2]


def prepare_film(parameters: SqueezeFilm, context: Context) -> Squeezed:
    """Return the damping's onset and the film's dimensions.

    The onset is that of the cubic damping; the film has a shape and a thickness.

    Film of smooth surfaces and roughness keep the bodies apart together, by the root of the sum of their squares:
    either alone where the other is small, and without a bend where they are alike, over speed or temperature.
    """
    onset = prepare_cubic(parameters, context)
    rx, ry, oil, found = context.radius_x, context.radius_y, context.oil, np.zeros(2)
    speed = 0.25 * context.speed * context.pitch_diameter
    floors = prepare_floors(Floors(), context)
    chittenden(speed, 1.0, context.mean_load, rx, ry, context.e_eff, oil.viscosity, oil.alpha_p, floors, found)
    shape = 12.0 * math.pi * math.sqrt(rx * ry) / (1.0 / rx + 1.0 / ry)
    return Squeezed(*onset, parameters.layer, math.hypot(float(found[0]), parameters.thinnest_film), shape)


@law(
    "damping",
    "squeeze-film",
    SqueezeFilm,
    role_api=3,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Pitois et al. 2000, J. Colloid Interface Sci. 231, 26",
    validity="lightly loaded contacts: pressures that thicken the oil leave the cubic damping alone",
    prepare=prepare_film,
)
def squeeze_film(
    delta: float,
    delta_dot: float,
    load: float,
    semi_a: float,
    semi_b: float,
    eta0: float,
    alpha_p: float,
    par: Squeezed,
    out: FloatArray,
) -> int:
    """Cubic damping with the squeeze film before touch.

    Damping after Teutsch; the ball squeezes the film before it touches.

    Between paraboloids with the gap h + x^2/2 R_x + y^2/2 R_y Reynolds' equation for an approach at v has the solution
    p = 6 eta v/(1/R_x + 1/R_y) (1/gap^2 - 1/H^2) within the line gap = H on which the oil ends:
    F = 12 pi eta v sqrt(R_x R_y)/(1/R_x + 1/R_y) (1 - h/H)^2/h: own work; for a sphere on a plane 6 pi eta R^2 v/h,
    with the edge Pitois et al. 2000, J. Colloid Interface Sci. 231, 26. At first touch film of the mean load and
    roughness are left, the root of the sum of their squares. Oil that pressure has made thick flows no more: under
    load exp(-alpha p_max) is left, own work. A film does not pull.
    """
    s = at_most(at_least(delta / par.delta_max, 0.0), 1.0)
    film = par.touch + at_least(-delta, 0.0)
    edge = 1.0 - film / (par.touch + par.reach)
    squeezed = par.shape * eta0 * edge * edge / film
    # of an open contact both the load and its area are zero
    squeezed *= exp(-at_most(1.5 * alpha_p * load / (math.pi * at_least(semi_a * semi_b, 1e-290)), 700.0))
    out[0] = at_least((par.d_max * s * s * (3.0 - 2.0 * s) + squeezed) * delta_dot, -load)
    return OK


class HuntCrossley(Parameters):
    """Constant of hysteretic damping."""

    alpha: float = parameter(
        0.08,
        "loss per velocity of impact, alpha in e = 1 - alpha v [s/m]",
        source="0.08 to 0.32 s/m of steel, bronze and ivory: Hunt and Crossley 1975 (as quoted, original not seen)",
        status="unconfirmed",
        published_range=(0.08, 0.32),
        ge=0.0,
    )


@law(
    "damping",
    "hunt-crossley",
    HuntCrossley,
    role_api=3,
    reference="Hunt and Crossley 1975, J. Appl. Mech. 42, 440",
    validity="dry impacts at low speed, alpha v far below 1; no oil between the bodies",
)
def hunt_crossley(delta: float, delta_dot: float, load: float, par: HuntCrossley, out: FloatArray) -> int:
    """Damping in proportion to the load, after Hunt and Crossley.

    F_D = (3/2) alpha Q delta_dot: no force at first touch, none of tension, and a blow at v rebounds with
    (1 - alpha v) v to first order. Hunt and Crossley 1975, J. Appl. Mech. 42, 440.
    """
    out[0] = at_least(1.5 * par.alpha * load * delta_dot, -load)
    return OK


@law("damping", "none", role_api=3, reference="-", contact="any")
def none(delta: float, delta_dot: float, load: float, par: NoParameters, out: FloatArray) -> int:
    """No damping."""
    out[0] = 0.0
    return OK

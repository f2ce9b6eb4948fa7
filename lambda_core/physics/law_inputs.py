"""What the set-up of a law may look at, and the parameters that it makes of it."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.physics.compiled import layout as L
from lambda_core.physics.hertz import ball_raceway_radii, reduced_modulus
from lambda_core.physics.model import BearingModel, Law
from lambda_core.physics.time_functions import peak
from lambda_core.registry.model import Context, Material, Oil
from lambda_core.registry.par import make_par

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class ContactFrame:
    """Frozen geometry of the two raceway force elements: inner, outer."""

    angles: tuple[float, float]  # contact angles at which R_x is frozen [rad]
    mean_loads: tuple[float, float]  # [N]


def effective_modulus(one: Material, other: Material) -> float:
    """Return E' of two bodies [Pa]."""
    return reduced_modulus(one.youngs_modulus, one.poisson_ratio, other.youngs_modulus, other.poisson_ratio)


def build_context(model: BearingModel, element: str, frame: ContactFrame, oil: Oil) -> Context:
    """Return what the `prepare` of this force element's laws may look at."""
    g = model.geometry
    speed = max_speed(model)
    raceways = {"ball_inner": model.inner_material, "ball_outer": model.outer_material}
    partner = (raceways | {"ball_ball": model.ball_material}).get(element, model.cage_material)
    common = Context(
        element=element,
        ball_count=g.ball_count,
        ball_diameter=g.ball_diameter,
        pitch_diameter=g.pitch_diameter,
        bore_diameter=g.bore_diameter,
        outside_diameter=g.outside_diameter,
        width=g.width,
        series=g.series,
        speed=speed,
        mean_load=max(frame.mean_loads),
        ball=model.ball_material,
        partner=partner,
        oil=oil,
        pocket_clearance=model.cage.pocket_clearance,
        cage_width=model.cage.width,
        oil_level=model.oil_level,
    )
    if element in ("ball_inner", "ball_outer"):
        i = 0 if element == "ball_inner" else 1
        groove = (g.groove_radius_inner, g.groove_radius_outer)[i]
        rx, ry = ball_raceway_radii(g.ball_diameter, g.pitch_diameter, groove, frame.angles[i], inner=i == 0)
        return dataclasses.replace(
            common,
            mean_load=frame.mean_loads[i],
            contact_angle=frame.angles[i],
            groove_radius=groove,
            race_diameter=(g.race_diameter_inner, g.race_diameter_outer)[i],
            radius_x=rx,
            radius_y=ry,
            e_eff=effective_modulus(model.ball_material, partner),
        )
    if element in ("cage_inner", "cage_outer"):
        land = g.shoulder_diameter_inner if element == "cage_inner" else g.shoulder_diameter_outer
        ring = model.inner_material if element == "cage_inner" else model.outer_material
        return dataclasses.replace(common, land_clearance=model.cage.land_clearance, land_diameter=land, partner=ring)
    return common


def max_speed(model: BearingModel) -> float:
    """Return the largest planned spin of either ring [rad/s]; 0 when both are free and start at rest."""
    return max(peak(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))


def guides(model: BearingModel) -> tuple[str, str, str]:
    """Return the force elements that take the solver's places of pocket, inner and outer land."""
    return ("ball_cage" if model.depth.cage else "ball_ball", "cage_inner", "cage_outer")


def prepare(law: Law, context: Context) -> FloatArray:
    """Run a law's set-up; compiled code takes par[0] even of laws without parameters."""
    par = make_par(law.model, law.parameters, context)
    return par if par.size else np.zeros(1)


def prepare_all(model: BearingModel, frame: ContactFrame, oil: Oil) -> list[FloatArray]:
    """Return the parameters of every kernel, in the order of layout.par_of."""
    pars: list[FloatArray] = []
    for element in ("ball_inner", "ball_outer"):
        context = build_context(model, element, frame, oil)
        pars += [prepare(model.laws[element][role], context) for role in L.RacewayLaws._fields]
    for element in guides(model):
        pars.append(prepare(model.laws[element]["cage_contact"], build_context(model, element, frame, oil)))
    pars.append(prepare(model.laws["fluid_drag"]["fluid_drag"], build_context(model, "fluid_drag", frame, oil)))
    return pars

"""Build the context of a law from the resolved model."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import RIBS
from lambda_core.formulas.hertz import ball_raceway_radii, reduced_modulus
from lambda_core.laws.context import Context, Material, Oil
from lambda_core.laws.par import make_par
from lambda_core.model.bearing_model import BearingModel, ChosenLaw
from lambda_core.model.laws.time_functions import peak


@dataclass(frozen=True)
class ContactFrame:
    """Frozen geometry of the two raceway force elements: inner, outer."""

    angles: tuple[float, float]  # contact angles at which R_x is frozen [rad]
    mean_loads: tuple[float, float]  # [N]


def effective_modulus(one: Material, other: Material) -> float:
    """Return E' of two bodies [Pa]."""
    return reduced_modulus(one.youngs_modulus, one.poisson_ratio, other.youngs_modulus, other.poisson_ratio)


def build_context(model: BearingModel, element: str, frame: ContactFrame, oil: Oil) -> Context:
    """Return the context for `prepare`.

    It is that of this force element's laws.
    """
    g = model.geometry
    speed = max_speed(model)
    raceways = {"ball_inner": model.inner_material, "ball_outer": model.outer_material}
    raceways |= {"rib_inner": model.inner_material, "rib_outer": model.outer_material}
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
        lubrication=model.lubrication,
        oil_flow=model.oil_flow,
        starvation=model.starvation,
    )
    if element in ("ball_inner", "ball_outer"):
        i = 0 if element == "ball_inner" else 1
        groove = (g.groove_radius_inner, g.groove_radius_outer)[i]
        if model.rollers is None:
            rx, ry = ball_raceway_radii(g.ball_diameter, g.pitch_diameter, groove, frame.angles[i], inner=i == 0)
        else:  # to laws of line contacts the length stands for the radius across rolling
            rx, ry = model.rollers.radius("inner" if i == 0 else "outer"), model.rollers.effective_length
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
    if element in RIBS and model.rollers is not None:
        i = tuple(RIBS).index(element)
        rib = next(rib for rib in model.rollers.ribs if rib.ring == ("inner", "outer")[i])
        return dataclasses.replace(
            common,
            mean_load=frame.mean_loads[i],
            contact_angle=frame.angles[i],
            race_diameter=2.0 * rib.contact.distance,
            radius_x=rib.contact.radius_x,
            radius_y=rib.contact.radius_y,
            e_eff=effective_modulus(model.ball_material, partner),
        )
    if element == "ball_ball" and model.rollers is not None:
        return dataclasses.replace(common, radius_x=0.25 * g.ball_diameter, radius_y=model.rollers.effective_length)
    if element in ("cage_inner", "cage_outer"):
        land = g.shoulder_diameter_inner if element == "cage_inner" else g.shoulder_diameter_outer
        ring = model.inner_material if element == "cage_inner" else model.outer_material
        return dataclasses.replace(common, land_clearance=model.cage.land_clearance, land_diameter=land, partner=ring)
    return common


def max_speed(model: BearingModel) -> float:
    """Return the largest planned spin [rad/s].

    It is that of either ring; it is 0 when both are free and start at rest.
    """
    return max(peak(body.dofs["spin"].motion) for body in (model.inner_ring, model.outer_ring))


def prepare(law: ChosenLaw, context: Context) -> FloatArray:
    """Run a law's set-up.

    Compiled code takes the address of one word even of laws without parameters.
    """
    par = make_par(law.model, law.parameters, context)
    return par if par.size else np.zeros(1)

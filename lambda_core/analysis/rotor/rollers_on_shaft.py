"""Take a roller bearing out of a machine."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lambda_core.elements.roller.roller_friction import OilState
from lambda_core.laws.context import Oil
from lambda_core.model.laws.roller_dielectric import dielectric_of_model
from lambda_core.model.laws.roller_laws import friction_of_model
from lambda_core.model.roller_case import RollerModel, friction_parameters
from lambda_core.solver.drivers.roller_reaction import RollerReaction


def taken_out(ring: RollerReaction) -> RollerModel:
    """Return a roller bearing of a machine alone.

    It has the load that it carries at the last pose of its rings.

    Its tilts are those of the pose; so is its place in directions without a load that holds it.
    """
    model, bearing, motion, state = ring.model, ring.rollers, ring.motion, ring.state
    oil = _oil_state(ring.oil)
    given = replace(
        friction_parameters(bearing, model.roughness, model.lubrication, model.oil_level), **friction_of_model(model)
    )
    loads = np.array([*state.loads[:3], 0.0, 0.0])  # tilts are held
    along, across = bearing.contact_angle == 0.0 or loads[0] <= 0.0, state.carried[0] == 0.0
    return RollerModel(
        name=model.name, title=model.title, bearing=bearing, loads=loads,
        held=(bool(along), across, across, True, True), displacement=state.ring,
        speeds=(motion.inner, motion.outer), oil=oil, friction=given, lubricant=ring.oil.name,
        base_type=ring.oil.base_type, lubrication=model.lubrication, temperature=ring.oil.temperature,
        slices=state.inner.shape[1], contamination=model.contamination, assumptions=model.assumptions,
        dielectric=dielectric_of_model(model, ring.frame, ring.oil),
    )  # fmt: skip


def _oil_state(oil: Oil) -> OilState:
    return OilState(oil.viscosity, oil.density, oil.alpha_p, oil.beta, oil.thermal_conductivity)

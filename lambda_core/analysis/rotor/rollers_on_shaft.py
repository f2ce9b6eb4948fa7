"""Answer for one roller bearing of a machine."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import get_args

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_friction import OilState, RollerFriction
from lambda_core.formulas.loading import Ring
from lambda_core.laws.context import Oil
from lambda_core.model.laws.roller_laws import friction_of_model
from lambda_core.model.roller_case import RollerModel, friction_parameters
from lambda_core.results.bearing_summary import Contact
from lambda_core.results.rating import Rating
from lambda_core.results.roller_quasistatic import RollerQuasiStatic, SolvedRollers, roller_answer, solve_rollers
from lambda_core.results.verdict import limits_of
from lambda_core.solver.drivers.roller_reaction import RollerReaction


@dataclass(frozen=True)
class RollersOnShaft:
    """A roller bearing at its pose in a machine.

    Attributes
    ----------
    model : RollerModel
        Geometry, oil and surfaces.
    solved : SolvedRollers
        Loads of slices and ribs, speeds, friction.
    answer : RollerQuasiStatic
        The same in the units of the interface.
    rating : Rating
        Lives and safety.
    """

    model: RollerModel
    solved: SolvedRollers
    answer: RollerQuasiStatic
    rating: Rating

    @property
    def bearing(self) -> RollerBearing:
        """Geometry."""
        return self.model.bearing

    @property
    def largest_ring(self) -> Ring:
        """Ring of the largest load.

        The centrifugal force adds to the outer one.
        """
        inner, outer = (float(load.sum(axis=1).max()) for load in (self.solved.state.inner, self.solved.state.outer))
        return "inner" if inner > outer else "outer"

    @property
    def power(self) -> float | None:
        """Of the friction [W]; None at rest."""
        found = self.solved.friction
        return None if found is None else found.total * abs(self.solved.motion.relative)

    @property
    def angles(self) -> list[float]:
        """Smallest and largest contact angle of the raceways, sizes [deg]."""
        return [math.degrees(self.bearing.angles.inner), math.degrees(self.bearing.angles.outer)]

    def contacts(self) -> list[Contact]:
        """Return every contact of a roller with a raceway.

        Each has the film of the slice that carries most.
        """
        state, found, angles = self.solved.state, self.solved.friction, self.bearing.angles
        loads = {"inner": state.inner, "outer": state.outer}
        leans = {"inner": angles.inner, "outer": angles.outer}
        return [
            Contact(
                ball=j + 1,
                ring=ring,
                azimuth_deg=math.degrees(float(azimuth)) % 360.0,
                load_N=float(loads[ring][j].sum()),
                contact_angle_deg=math.degrees(self.bearing.faces * leans[ring]),
                film_um=_film(found, ring, j, loads[ring][j]),
                capacitance_pF=None,
            )
            for j, azimuth in enumerate(state.azimuths)
            for ring in get_args(Ring)
        ]


def _film(found: RollerFriction | None, ring: str, roller: int, loads: FloatArray) -> float | None:
    if found is None or float(loads.max()) <= 0.0:
        return None
    return 1e6 * float(found.film[ring][roller, int(np.argmax(loads))])


def rollers_on_shaft(ring: RollerReaction) -> RollersOnShaft:
    """Return a roller bearing's answer in a machine.

    It holds at the last pose of its rings, like that of a bearing that is alone.
    """
    model, alone = ring.model, taken_out(ring)
    solved = solve_rollers(alone)
    answer = roller_answer(alone, solved)
    rating = answer.rating.model_copy(update={"limits": limits_of(model)})
    return RollersOnShaft(alone, solved, answer, rating)


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
    )  # fmt: skip


def _oil_state(oil: Oil) -> OilState:
    return OilState(oil.viscosity, oil.density, oil.alpha_p, oil.beta, oil.thermal_conductivity)

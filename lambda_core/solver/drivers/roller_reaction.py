"""Compute reaction and stiffness of a held roller bearing.

The rollers are in the convex equilibrium of :mod:`lambda_core.elements.roller.roller_equilibrium`: laminae of ISO 16281
on the raceways, points on the ribs.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE, SPIN
from lambda_core.domain.errors import SolverError
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, balance
from lambda_core.elements.roller.roller_motion import RollerMotion, rolling_motion
from lambda_core.elements.roller.roller_thrust import thrust_problem
from lambda_core.laws.context import Oil
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver.drivers.bearing_reaction import BearingReaction, Reaction, held
from lambda_core.solver.drivers.compiled_laws import Announce, Kernels, check_laws, derive_oils
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.first_state import FIRST_AZIMUTH, first_frame
from lambda_core.solver.drivers.near_equilibrium import solve_near

_HELD = (True,) * 5
_TILTS = 3  # from this place of a pose on
_MIRROR = np.array([-1.0, 1.0, 1.0, -1.0, -1.0])  # of a pose or a wrench, at the middle plane


class RollerReaction(Reaction):
    """Roller bearing by its inner ring's pose.

    The rollers find their places, without friction.

    Parameters
    ----------
    model : BearingModel
        The bearing; its ring's own boundary conditions and loads do not count.
    rollers : RollerBearing
        Of it.
    kernels : Kernels, optional
        Of the same laws, from another bearing.
    near : RollerReaction, optional
        Of this bearing in a condition nearby, whose rollers the searches start from.
    """

    def __init__(
        self,
        model: BearingModel,
        rollers: RollerBearing,
        kernels: Kernels | None = None,
        announce: Announce = None,
        near: RollerReaction | None = None,
    ) -> None:
        self.model, self.rollers = model, rollers
        self._kernels, self._announce = kernels or Kernels(model, announce), announce
        self.frame: ContactFrame = first_frame(model)
        oils = derive_oils(model, self._kernels, self.frame)
        check_laws(model, self._kernels, self.frame, oils)
        self.oil: Oil = oils[0]
        inner, outer = (initial(body.dofs[SPIN].motion) for body in (model.inner_ring, model.outer_ring))
        self.motion: RollerMotion = rolling_motion(rollers, inner, outer)
        self._turned = _turned(rollers)
        self._pose = np.zeros(len(POSE))
        self._state: RollerEquilibrium | None = None if near is None else near._state
        self._near = None if near is None else near.found

    @property
    def holds_along(self) -> bool:
        """True if ribs or cones hold the shaft along x.

        One side is enough.
        """
        return not all(thrust_problem(self.rollers, side) for side in (1.0, -1.0))

    @property
    def state(self) -> RollerEquilibrium:
        """State at the last pose.

        It is in the axes of the rollers, with a along the thrust that they take.
        """
        return self._balanced(self._pose) if self._state is None else self._state

    def _balanced(self, pose: FloatArray) -> RollerEquilibrium:
        try:
            self._state = rollers_between(self.rollers, self.motion, pose, near=self._state)
        except ArithmeticError as error:
            raise SolverError(f"{self.model.name}: {error}") from error
        return self._state

    def reaction(self, pose: Sequence[float]) -> FloatArray:
        """Return force and moment at a pose.

        The bearing exerts them on its inner ring; the array has shape (5,) [N, N m].

        Raises
        ------
        SolverError
            When the rollers find no equilibrium.
        """
        at = np.array(pose, dtype=float)
        state = self._balanced(at)
        self._pose = at
        return -self._turned * state.loads

    def stiffness(self) -> FloatArray:
        """Return -d(reaction)/d(pose) at the last pose.

        The matrix has shape (5, 5).
        """
        found: FloatArray = self.state.stiffness * np.outer(self._turned, self._turned)
        return found

    def refresh(self) -> bool:
        """Return False: cones touch at the same angles everywhere."""
        return False

    def at_pose(self) -> Equilibrium:
        """Return the last pose's equilibrium with friction.

        The laws of the model give the friction of the rollers.

        Friction skews the rollers of a tilted ring, and the way there starts from a straight one: straight into the
        tilted pose it is lost in some places, and some of these are reached by half the tilt.
        """
        there = held(self.model, self._pose.tolist())
        if self._near is not None:
            with suppress(SolverError):
                return solve_near(there, self._near, self._kernels, is_of_laws=False, by_warmer_oil=False)
        if self._pose[_TILTS:].any():
            with suppress(SolverError):  # else the pose itself has one, or says what is wrong
                straight = solve(self._tilted(0.0), self._kernels, self._announce)
                with suppress(SolverError):
                    return solve_near(there, straight, self._kernels, by_warmer_oil=False)
                with suppress(SolverError):
                    half = solve_near(self._tilted(0.5), straight, self._kernels, by_warmer_oil=False)
                    return solve_near(there, half, self._kernels, by_warmer_oil=False)
                return solve_near(there, straight, self._kernels)
        return solve(there, self._kernels, self._announce, strict=False)

    def _tilted(self, share: float) -> BearingModel:
        """Return the bearing at a share of its tilts."""
        pose = self._pose.copy()
        pose[_TILTS:] *= share
        return held(self.model, pose.tolist())


def rollers_between(
    rollers: RollerBearing,
    motion: RollerMotion,
    pose: FloatArray,
    first_angle: float = FIRST_AZIMUTH,
    near: RollerEquilibrium | None = None,
) -> RollerEquilibrium:
    """Return the rollers' equilibrium between held rings.

    It is in the axes of the rollers.

    Parameters
    ----------
    pose : array
        Of the inner ring against the outer one in the axes of the shaft [m, rad], (5,).
    first_angle, near
        As for :func:`balance`, which raises what this raises.
    """
    return balance(
        rollers,
        np.zeros(len(POSE)),
        held=_HELD,
        displacement=_turned(rollers) * pose,
        inertial=motion.inertial(rollers),
        first_angle=first_angle,
        near=near,
    )


def _turned(rollers: RollerBearing) -> FloatArray:
    return np.ones(len(POSE)) if rollers.faces > 0 else _MIRROR


Ring = BearingReaction | RollerReaction

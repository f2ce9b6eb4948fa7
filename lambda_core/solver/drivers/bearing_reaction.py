"""Compute reaction and stiffness of a held bearing."""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.model.bearing_model import BearingModel, DofState, TimeFunction
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.compiled_laws import Announce, Kernels, check_laws, derive_oils
from lambda_core.solver.drivers.equilibrium import (
    Equilibrium,
    contact_channels,
    continue_static,
    mean_frame,
    solve,
)
from lambda_core.solver.drivers.first_state import first_state
from lambda_core.solver.drivers.near_equilibrium import solve_near
from lambda_core.solver.drivers.solver_context import SolverContext, assemble
from lambda_core.solver.drivers.stiffness import freed, stiffness_at

_SAME_ANGLE = 1e-4  # [rad] change of the frozen contact angle that asks for another frame


def held(model: BearingModel, pose: Sequence[float]) -> BearingModel:
    """Return the model with held rings.

    The inner ring is at a pose and the outer ring at rest.
    """
    inner = {
        **model.inner_ring.dofs,
        **{name: DofState("prescribed", TimeFunction.constant(float(v))) for name, v in zip(POSE, pose, strict=True)},
    }
    outer = {**model.outer_ring.dofs, **dict.fromkeys(POSE, DofState("locked"))}
    return dataclasses.replace(
        model,
        inner_ring=dataclasses.replace(model.inner_ring, dofs=inner),
        outer_ring=dataclasses.replace(model.outer_ring, dofs=outer),
        links={},
    )


class Reaction(ABC):
    """Bearing that answers its inner ring's pose.

    Its surroundings are included where it is alone.

    Attributes
    ----------
    alone : BearingModel or None
        The bearing with all that holds and loads it, where nothing else of its machine moves.
    found : Equilibrium or None
        The last one with friction at a pose.
    """

    alone: BearingModel | None = None
    found: Equilibrium | None = None
    _kernels: Kernels
    _announce: Announce

    def equilibrium(self) -> Equilibrium:
        """Return the equilibrium with friction.

        It is that at the last pose or of the bearing alone.
        """
        if self.alone is None:
            self.found = self.at_pose()
            return self.found
        return solve(self.alone, self._kernels, self._announce, strict=False)

    @abstractmethod
    def at_pose(self) -> Equilibrium:
        """Return the equilibrium at the last pose with friction."""


class BearingReaction(Reaction):
    """Ball bearing by its inner ring's pose.

    The balls find their places between the rings, without friction.

    Parameters
    ----------
    model : BearingModel
        The bearing; its ring's own boundary conditions and loads do not count.
    angle, load : float
        A guess of the contact angle [rad] and of the mean contact load [N], where radii and films are frozen first.
    kernels : Kernels, optional
        Of the same laws, from another bearing.
    near : BearingReaction, optional
        Of this bearing in a condition nearby, whose contacts and balls the searches start from.
    """

    def __init__(
        self,
        model: BearingModel,
        angle: float,
        load: float,
        kernels: Kernels | None = None,
        announce: Announce = None,
        near: BearingReaction | None = None,
    ) -> None:
        self.model = model
        self._kernels, self._announce = kernels or Kernels(model, announce), announce
        self._frame = ContactFrame((angle, angle), (load, load)) if near is None else near.frame
        self._near = None if near is None else near.found
        self._context = self._assembled()
        self._freed: SolverContext | None = None
        self._state: FloatArray = first_state(self._context) if near is None else near._state
        self._pose = np.zeros(len(POSE))

    def _assembled(self) -> SolverContext:
        model = held(self.model, [0.0] * len(POSE))
        oils = derive_oils(model, self._kernels, self._frame)
        check_laws(model, self._kernels, self._frame, oils)
        core(self._announce)
        return assemble(model, self._kernels, self._frame, oils)

    def reaction(self, pose: Sequence[float]) -> FloatArray:
        """Return force and moment at a pose.

        The bearing exerts them on its inner ring; the array has shape (5,) [N, N m].

        Raises
        ------
        SolverError
            When the balls find no equilibrium.
        """
        context, state = self._context, self._state.copy()
        context.bundle.terms["value"][: len(POSE)] = pose
        continue_static(core(), context, state, friction=False)
        bundle, system = context.bundle, context.bundle.system[0]
        system["friction_on"], system["guides_on"] = 0, 0
        core().evaluate(0.0, state, bundle, np.zeros(state.size), np.zeros(L.power_count(bundle)), 1)
        system["friction_on"], system["guides_on"] = 1, 1
        self._state, self._pose = state, np.array(pose, dtype=float)
        wrench: FloatArray = bundle.body_wrenches.view(np.float64)[:6]
        return np.delete(wrench, 3)

    def stiffness(self) -> FloatArray:
        """Return -d(reaction)/d(pose) at the last pose.

        The matrix has shape (5, 5).
        """
        if self._freed is None:
            self._freed = freed(self._context)
        return stiffness_at(self._context, self._freed, self._state, self._pose.tolist())

    @property
    def frame(self) -> ContactFrame:
        """Contact angles and loads of frozen radii.

        Films are frozen there, too.
        """
        return self._frame

    def refresh(self) -> bool:
        """Freeze radii and films at the last pose.

        They are those at its contact angles; the result is False where they stood there already.
        """
        contacts, _ = contact_channels(core(), self._context, self._state)
        new = mean_frame(self.model.geometry, contacts, self._frame)
        change = max(abs(a - b) for a, b in zip(new.angles, self._frame.angles, strict=True))
        if change < _SAME_ANGLE:
            return False
        self._frame, self._freed = new, None
        self._context = self._assembled()
        return True

    def at_pose(self) -> Equilibrium:
        """Return the last pose's equilibrium with friction.

        The friction is that of the balls.
        """
        there = held(self.model, self._pose.tolist())
        if self._near is not None:
            return solve_near(there, self._near, self._kernels, is_of_laws=False, by_warmer_oil=False)
        return solve(there, self._kernels, self._announce, strict=False)

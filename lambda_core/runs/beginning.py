"""Begin a motion from the equilibrium of its model.

Here alone it is asked whether what begins to move is a bearing alone or a machine; what follows is the same for both.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.static_point import AlonePoint, StaticPoint
from lambda_core.domain.number_text import counted
from lambda_core.model.bearing_model import BearingModel, DofState, TimeFunction
from lambda_core.results.provenance import Provenance
from lambda_core.runs.law_blame import naming_laws
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import MotionEngine, MotionStart, bearing_start
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

if TYPE_CHECKING:
    from lambda_core.model.machine_model import MachineModel

Announce = Callable[[str], None] | None


class Begun(ABC):
    """Model in equilibrium at t = 0.

    Attributes
    ----------
    point : StaticPoint
        The equilibrium, also where cages are guided.
    motion : MotionStart
        Start of the dynamics.
    """

    point: StaticPoint
    motion: MotionStart

    @property
    def equilibria(self) -> Sequence[Equilibrium]:
        """Equilibrium of every bearing."""
        return self.point.equilibria

    @abstractmethod
    def sentence(self) -> str:
        """Return a sentence about the equilibrium."""

    @abstractmethod
    def provenance(self, engine: MotionEngine) -> Provenance:
        """Return the fixed part of a result from here."""


def begin(model: BearingModel | MachineModel, announce: Announce = None, *, guides_cages: bool = False) -> Begun:
    """Return a model in equilibrium at t = 0.

    Parameters
    ----------
    guides_cages : bool
        Whether cages follow their kinematic paths: centred, at the mean orbital speed of the balls.

    Raises
    ------
    SolverError
        When there is none; the sentence names laws of others that took part.
    """
    with naming_laws(*model.bearing_models.values()):
        if isinstance(model, BearingModel):
            return BegunBearing(model, announce, guides_cages=guides_cages)
        from lambda_core.runs.machine_beginning import BegunMachine

        return BegunMachine(model, announce, guides_cages=guides_cages)


class BegunBearing(Begun):
    """A bearing that is alone at t = 0."""

    point: AlonePoint

    def __init__(self, model: BearingModel, announce: Announce, *, guides_cages: bool) -> None:
        found = start = solve(model, announce=announce, strict=False)
        moving = model
        if guides_cages:
            moving = with_locked_cage(model, found)
            start = solve(moving, announce=announce, strict=False)
        self.point, self.motion = AlonePoint(model, announce, found=found), bearing_start(start, moving)

    def sentence(self) -> str:
        """Return a sentence about the equilibrium."""
        found = self.point.answer
        return (
            f"equilibrium: {counted(found.loaded_elements, self.point.model.elements[:-1])} loaded, "
            f"Q_max {found.max_load_N / 1e3:.2f} kN ({found.max_load_ring} ring), "
            f"p_max {found.max_pressure_GPa:.2f} GPa"
        )

    def provenance(self, engine: MotionEngine) -> Provenance:
        """Return the fixed part of a result from here."""
        keys = engine.context.kernels.keys()
        rating, told = self.point.answer.rating, rolling_warnings(self.point.found)
        return Provenance.alone(self.point.model, keys, rating, told)


def rolling_warnings(found: Equilibrium) -> tuple[str, ...]:
    """Warn where no steady motion is found to begin with."""
    if found.converged:
        return ()
    elements = found.context.model.elements
    return (f"no steady motion of the {elements} was found at t = 0: they begin in pure rolling, without cage slip",)


def with_locked_cage(model: BearingModel, start: Equilibrium) -> BearingModel:
    """Return the model with a kinematic cage.

    It is centred, at the balls' mean orbital speed.
    """
    axial = float(np.mean(L.elements_in(start.context.bundle, start.state)["x"]))
    dofs = dict.fromkeys(model.cage_body.dofs, DofState("locked"))
    dofs["x"] = DofState("prescribed", TimeFunction.constant(axial))
    dofs["spin"] = DofState("prescribed", TimeFunction.constant(start.orbit))
    return replace(model, cage_body=replace(model.cage_body, dofs=dofs))

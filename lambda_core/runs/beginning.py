"""Begin a motion from the equilibrium of its model.

Here alone it is asked whether the model is a bearing alone or a machine; what follows is the same for both.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol

import numpy as np

from lambda_core.analysis.rating.engineering import rating_of
from lambda_core.discovery.api import registry
from lambda_core.model.bearing_model import BearingModel, DofState, TimeFunction
from lambda_core.model.roller_case import rollers_at_rest
from lambda_core.results.provenance import Provenance
from lambda_core.results.quasistatic import QuasiStatic, quasistatic_of
from lambda_core.results.roller_quasistatic import roller_quasistatic
from lambda_core.runs.law_blame import naming_laws
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import MotionEngine, MotionStart, bearing_start
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.model.machine_model import MachineModel

Announce = Callable[[str], None] | None


class Begun(Protocol):
    """Model in equilibrium at t = 0."""

    @property
    def equilibria(self) -> Sequence[Equilibrium]:
        """Return the equilibrium of every bearing."""

    @property
    def motion(self) -> MotionStart:
        """Return the start of the dynamics."""

    def sentence(self) -> str:
        """Return a sentence about the equilibrium."""

    def provenance(self, engine: MotionEngine) -> Provenance:
        """Return the fixed part of a result from here."""

    def answer(self) -> QuasiStatic | MachineEquilibrium:
        """Return the equilibrium in the words of the interface."""

    def modes(self) -> MachineModes | None:
        """Return the modes of a shaft; None without one."""


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
            return _begin_bearing(model, announce, guides_cages=guides_cages)
        from lambda_core.runs.machine_beginning import begin_machine

        return begin_machine(model, announce, guides_cages=guides_cages)


@dataclass(frozen=True)
class BegunBearing:
    """A bearing that is alone at t = 0.

    Attributes
    ----------
    model : BearingModel
    equilibria : tuple of Equilibrium
        Its equilibrium, also where the cage is guided.
    motion : MotionStart
    """

    model: BearingModel
    equilibria: tuple[Equilibrium]
    motion: MotionStart

    def sentence(self) -> str:
        """Return a sentence about the equilibrium."""
        found = quasistatic_of(self.equilibria[0]) if self.model.rollers is None else self.answer()
        return (
            f"equilibrium: {found.loaded_balls} {self.model.elements} loaded, "
            f"Q_max {found.max_load_N / 1e3:.2f} kN ({found.max_load_ring} ring), "
            f"p_max {found.max_pressure_GPa:.2f} GPa"
        )

    def provenance(self, engine: MotionEngine) -> Provenance:
        """Return the fixed part of a result from here."""
        keys = engine.context.kernels.keys()
        return Provenance.alone(self.model, keys, self.answer().rating)

    def answer(self) -> QuasiStatic:
        """Return the equilibrium in the words of the interface."""
        if self.model.rollers is not None:
            return roller_quasistatic(rollers_at_rest(self.model), self.model)
        found = self.equilibria[0]
        return quasistatic_of(found, rating_of(found, registry().methods))

    def modes(self) -> None:
        """Return nothing: a bearing alone has no shaft."""


def _begin_bearing(model: BearingModel, announce: Announce, *, guides_cages: bool) -> BegunBearing:
    found = start = solve(model, announce=announce)
    moving = model
    if guides_cages:
        moving = with_locked_cage(model, found)
        start = solve(moving, announce=announce)
    return BegunBearing(model, (found,), bearing_start(start, moving))


def with_locked_cage(model: BearingModel, start: Equilibrium) -> BearingModel:
    """Return the model with a kinematic cage.

    It is centred, at the balls' mean orbital speed.
    """
    axial = float(np.mean(L.elements_in(start.context.bundle, start.state)["x"]))
    dofs = dict.fromkeys(model.cage_body.dofs, DofState("locked"))
    dofs["x"] = DofState("prescribed", TimeFunction.constant(axial))
    dofs["spin"] = DofState("prescribed", TimeFunction.constant(start.orbit))
    return replace(model, cage_body=replace(model.cage_body, dofs=dofs))

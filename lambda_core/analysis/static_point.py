"""Solve a bearing or a machine at its operating point.

Here alone it is asked whether a model is a bearing alone or a machine. Whoever needs an equilibrium asks the point, and
its bearings, which are alike in both. A bearing that is alone has the empty name.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from lambda_core.analysis.electric.contacts import equilibria
from lambda_core.analysis.electric.current_numbers import PHASES, CurrentNumbers, static_numbers
from lambda_core.analysis.rating.engineering import rating_of
from lambda_core.discovery.api import registry
from lambda_core.domain.elements import ALONE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.roller_case import rollers_at_rest
from lambda_core.results.quasistatic import BearingStatics, QuasiStatic, quasistatic_of
from lambda_core.results.roller_quasistatic import roller_answer, solve_rollers
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.near_equilibrium import solve_or_roll

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.rating import Rating
    from lambda_core.results.roller_quasistatic import SolvedRollers
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.equilibrium import Equilibrium
    from lambda_core.solver.drivers.machine_statics import SharedKernels


class LoadedBearing(NamedTuple):
    """A bearing with its load in a model.

    Attributes
    ----------
    model : BearingModel
        With the ranges of its laws; that of balls has the load.
    rollers : RollerModel or None
        Its rollers under the load.
    """

    model: BearingModel
    rollers: RollerModel | None


class StaticPoint(ABC):
    """Quasi-static point of a bearing or a machine.

    Every result is computed once, when it is first asked for. What needs an equilibrium raises a SolverError where
    there is none.
    """

    model: BearingModel | MachineModel

    @property
    @abstractmethod
    def bearings(self) -> Mapping[str, BearingPoint]:
        """All bearings by name, from left to right."""

    @property
    @abstractmethod
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films, by bearing."""

    @property
    @abstractmethod
    def speed_rpm(self) -> float:
        """Speed of the shaft without its sign [1/min]."""

    @property
    @abstractmethod
    def answer(self) -> QuasiStatic | MachineEquilibrium:
        """The equilibrium with ratings, without preload."""

    @property
    @abstractmethod
    def summary(self) -> QuasiStatic | MachineEquilibrium:
        """The equilibrium with all that the machine interface has."""

    @property
    @abstractmethod
    def modes(self) -> MachineModes | None:
        """Natural frequencies and critical speeds; None without a shaft."""

    @property
    def equilibria(self) -> list[Equilibrium]:
        """Equilibria of all bearings, from left to right."""
        return [one.equilibrium for one in self.bearings.values()]

    @property
    def loaded(self) -> dict[str, LoadedBearing]:
        """Each bearing with its load."""
        return {name: one.loaded for name, one in self.bearings.items()}

    def bearing(self, name: str) -> BearingPoint:
        """Return one bearing by its name."""
        return self.bearings[name]


class BearingPoint(ABC):
    """One bearing of a quasi-static point.

    Attributes
    ----------
    point : StaticPoint
        The point that it belongs to.
    name : str
        "" for a bearing that is alone.
    model : BearingModel
    """

    def __init__(self, point: StaticPoint, name: str, model: BearingModel) -> None:
        self.point, self.name, self.model = point, name, model

    @property
    @abstractmethod
    def equilibrium(self) -> Equilibrium:
        """The equilibrium with friction of the rolling elements."""

    @property
    @abstractmethod
    def loads(self) -> tuple[float, float] | None:
        """Radial and axial load [N].

        None where they stand in its case.
        """

    @property
    @abstractmethod
    def alone(self) -> BearingModel:
        """The bearing alone under its load."""

    @property
    @abstractmethod
    def in_place(self) -> BearingModel:
        """The bearing where its rolling elements pass."""

    @property
    @abstractmethod
    def rollers(self) -> RollerModel | None:
        """Its rollers under the load; None of balls."""

    @property
    @abstractmethod
    def loaded(self) -> LoadedBearing:
        """The bearing with its load."""

    @cached_property
    def solved_rollers(self) -> SolvedRollers:
        """Loads, speeds and friction of its rollers."""
        assert self.rollers is not None
        return solve_rollers(self.rollers)

    @cached_property
    def summary(self) -> QuasiStatic:
        """The equilibrium in the words of the machine interface.

        That of rollers is the mean over their positions in a pitch.
        """
        if self.rollers is not None:
            return roller_answer(self.rollers, self.solved_rollers, self.model)
        return quasistatic_of(self.equilibrium)

    @property
    @abstractmethod
    def rating(self) -> Rating | None:
        """Lives and safety."""

    @property
    def mounted(self) -> BearingStatics:
        """The bearing among those of the answer."""
        return self.point.summary.bearings[self.name or ALONE]

    @property
    def currents(self) -> CurrentNumbers:
        """Bearing currents on quasi-static films."""
        return self.point.circuit[self.name or ALONE]


def static_point(
    model: BearingModel | MachineModel, announce: Announce = None, kernels: SharedKernels | None = None
) -> StaticPoint:
    """Return a model's operating point.

    It holds at t = 0; `kernels` are compiled laws that other models share.
    """
    if isinstance(model, BearingModel):
        return AlonePoint(model, announce, kernels)
    from lambda_core.analysis.rotor.machine_point import MachinePoint

    return MachinePoint(model, announce, kernels)


class AlonePoint(StaticPoint):
    """Quasi-static point of a bearing that is alone.

    `found` is its equilibrium where it is known.
    """

    def __init__(
        self,
        model: BearingModel,
        announce: Announce = None,
        kernels: SharedKernels | None = None,
        found: Equilibrium | None = None,
    ) -> None:
        self.model: BearingModel = model
        self._announce, self._shared, self._known = announce, kernels, found

    @cached_property
    def bearings(self) -> dict[str, AloneBearing]:
        """Its only bearing."""
        return {"": AloneBearing(self, "", self.model)}

    @cached_property
    def _kernels(self) -> Kernels:
        shared, announce = self._shared, self._announce
        return Kernels(self.model, announce) if shared is None else shared.of(self.model, announce)

    @cached_property
    def found(self) -> Equilibrium:
        """Its equilibrium."""
        return self._known or solve_or_roll(self.model, self._kernels, self._announce)

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films."""
        return static_numbers(self.model, [equilibria(self.model, PHASES, kernels=self._kernels)])

    @property
    def speed_rpm(self) -> float:
        """Speed of the rings against each other [1/min]."""
        return self.found.relative_speed * 30.0 / math.pi

    @cached_property
    def answer(self) -> QuasiStatic:
        """The equilibrium with its rating."""
        own = self.bearings[""]
        if own.rollers is not None:
            return roller_answer(own.rollers, own.solved_rollers, self.model)
        return quasistatic_of(self.found, own.rating)

    @property
    def summary(self) -> QuasiStatic:
        """The same: a bearing alone has no preload."""
        return self.answer

    @property
    def modes(self) -> None:
        """Nothing: a bearing alone has no shaft."""


class AloneBearing(BearingPoint):
    """A bearing that is alone.

    Its loads stand in its case.
    """

    point: AlonePoint

    @property
    def equilibrium(self) -> Equilibrium:
        """The equilibrium with friction of the rolling elements."""
        return self.point.found

    @property
    def loads(self) -> None:
        """Nothing: the loads stand in the case."""

    @cached_property
    def rating(self) -> Rating | None:
        """Lives and safety."""
        if self.rollers is not None:
            return self.point.answer.rating
        return rating_of(self.equilibrium, registry().methods)

    @property
    def alone(self) -> BearingModel:
        """The bearing itself."""
        return self.model

    @property
    def in_place(self) -> BearingModel:
        """The bearing itself, which finds its place anew."""
        return self.model

    @cached_property
    def rollers(self) -> RollerModel | None:
        """Its rollers under the load; None of balls."""
        return None if self.model.rollers is None else rollers_at_rest(self.model)

    @property
    def loaded(self) -> LoadedBearing:
        """The bearing with its load."""
        return LoadedBearing(self.model, self.rollers)

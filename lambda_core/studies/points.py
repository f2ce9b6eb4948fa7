"""Solve points of studies and read runs.

A bearing that is alone has the empty name; those of a machine have names.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lambda_core.analysis.electric.current_numbers import PHASES, CurrentNumbers, circuit_numbers, static_numbers
from lambda_core.domain.elements import ALONE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.quasistatic import QuasiStatic, StaticAnswer, quasistatic_of
from lambda_core.results.rating import Rating
from lambda_core.solver.drivers.equilibrium import solve
from lambda_core.solver.drivers.machine_statics import solve_machine

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes, ModeAtSpeed
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.bearing_summary import BearingSummary
    from lambda_core.results.reader import Result
    from lambda_core.results.summary import Summary
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.equilibrium import Equilibrium
    from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels
    from lambda_core.studies.method_columns import Columns


class StaticPoint(ABC):
    """Quasi-static point of a bearing or a machine.

    Every requested result is computed once.
    """

    model: BearingModel | MachineModel

    def __init__(self) -> None:
        self._bearings: dict[str, BearingPoint] = {}

    @property
    @abstractmethod
    def equilibria(self) -> Sequence[Equilibrium]:
        """Equilibria of all bearings, from left to right."""

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
    def answer(self) -> StaticAnswer:
        """The equilibrium with ratings, without preload."""

    @abstractmethod
    def rating(self, name: str) -> Rating | None:
        """Return lives and safety of a bearing."""

    @abstractmethod
    def loads(self, name: str) -> tuple[float, float] | None:
        """Return radial and axial load of a bearing [N].

        None where they stand in its case.
        """

    def bearing(self, name: str) -> BearingPoint:
        """Return one bearing by its name."""
        if name not in self._bearings:
            number = list(self.model.bearing_models).index(name)
            self._bearings[name] = BearingPoint(self, name, self.equilibria[number])
        return self._bearings[name]

    def columns(self, names: Sequence[str]) -> Columns:
        """Return the rows of comparison methods among names.

        In a machine their names and meanings begin with the bearing's name.
        """
        from lambda_core.studies.method_columns import method_columns

        columns: Columns = {}
        for bearing in self.model.bearing_models:
            own, of = (f"{bearing}.", f"{bearing}: ") if bearing else ("", "")
            rows = [name.removeprefix(own) for name in names if "/" in name and name.startswith(own)]
            found = method_columns(self.bearing(bearing).equilibrium, rows, self.loads(bearing))
            columns |= {f"{own}{name}": (value, unit, f"{of}{words}") for name, (value, unit, words) in found.items()}
        return columns


@dataclass
class BearingPoint:
    """One bearing of a quasi-static point.

    Attributes
    ----------
    point : StaticPoint
        The point that it belongs to.
    name : str
        "" for a bearing that is alone.
    equilibrium : Equilibrium
    """

    point: StaticPoint
    name: str
    equilibrium: Equilibrium

    @cached_property
    def summary(self) -> QuasiStatic:
        """The equilibrium in the words of the machine interface."""
        return quasistatic_of(self.equilibrium)

    @property
    def currents(self) -> CurrentNumbers:
        """Bearing currents on quasi-static films."""
        return self.point.circuit[self.name or ALONE]

    @property
    def rating(self) -> Rating | None:
        """Lives and safety."""
        return self.point.rating(self.name)

    @property
    def mounted(self) -> BearingEquilibrium:
        """The bearing at its place in a machine."""
        assert isinstance(self.point, MachinePoint)
        return self.point.summary.bearing(self.name)


class AlonePoint(StaticPoint):
    """Quasi-static point of a bearing that is alone."""

    def __init__(self, model: BearingModel, kernels: SharedKernels, announce: Announce = None) -> None:
        super().__init__()
        self.model: BearingModel = model
        self._kernels = kernels.of(model, announce)
        self._found = solve(model, self._kernels, announce)

    @property
    def equilibria(self) -> list[Equilibrium]:
        """The equilibrium of the bearing."""
        return [self._found]

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films."""
        others = [solve(self.model, self._kernels, phase=k / PHASES) for k in range(1, PHASES)]
        return static_numbers(self.model, [[self._found, *others]])

    @property
    def speed_rpm(self) -> float:
        """Speed of the rings against each other [1/min]."""
        return self._found.relative_speed * 30.0 / math.pi

    @cached_property
    def answer(self) -> QuasiStatic:
        """The equilibrium with its rating."""
        from lambda_core.analysis.rating.engineering import rating_of
        from lambda_core.discovery.api import registry

        return quasistatic_of(self._found, rating_of(self._found, registry().methods))

    def rating(self, name: str) -> Rating | None:
        """Return lives and safety."""
        return self.answer.bearing(name or ALONE).rating

    def loads(self, name: str) -> None:
        """Return nothing: the loads stand in the case."""


class MachinePoint(StaticPoint):
    """Quasi-static point of a machine."""

    def __init__(self, model: MachineModel, kernels: SharedKernels, announce: Announce = None) -> None:
        super().__init__()
        self.model: MachineModel = model
        self._kernels = kernels
        self.state: MachineState = solve_machine(model, announce, kernels)

    @cached_property
    def equilibria(self) -> list[Equilibrium]:
        """Equilibria of all bearings with friction.

        They hold at the bearings' poses, with the friction of their balls.
        """
        return [ring.equilibrium() for ring in self.state.rings]

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films.

        Each bearing has its own current; one circuit joins all.
        """
        from lambda_core.analysis.electric.case_or_run import held_bearings
        from lambda_core.analysis.electric.contacts import equilibria

        held = zip(held_bearings(self.model, self.state), self.model.bearings, strict=True)
        solved = [equilibria(one, PHASES, kernels=self._kernels.of(own.model)) for one, own in held]
        return static_numbers(self.model, solved)

    @property
    def speed_rpm(self) -> float:
        """Speed of the shaft without its sign [1/min]."""
        return abs(self.answer.speed_rpm)

    @cached_property
    def answer(self) -> MachineEquilibrium:
        """The equilibrium without preload, which costs solutions of its own."""
        from lambda_core.analysis.rotor.machine_equilibrium import equilibrium_of

        return equilibrium_of(self.model, self.state)

    @cached_property
    def summary(self) -> MachineEquilibrium:
        """The equilibrium in the words of the machine interface."""
        from lambda_core.analysis.rotor.machine_equilibrium import equilibrium_of
        from lambda_core.solver.drivers.preload import preloads

        return equilibrium_of(self.model, self.state, self.equilibria, preloads(self.model, self._kernels))

    @cached_property
    def modes(self) -> MachineModes:
        """Natural frequencies and critical speeds."""
        from lambda_core.analysis.rotor.machine_modes import modes_of

        return modes_of(self.model, self.state)

    @cached_property
    def modes_at_speed(self) -> list[ModeAtSpeed]:
        """Natural frequencies at the point's speed.

        They are in ascending order.
        """
        from lambda_core.analysis.rotor.machine_modes import modes_at_speed

        found = modes_at_speed(self.model, self.state, self.equilibria)
        return sorted(found, key=lambda mode: mode.frequency_Hz)

    def rating(self, name: str) -> Rating:
        """Return lives and safety of a bearing."""
        return self.summary.bearing(name).rating

    def loads(self, name: str) -> tuple[float, float]:
        """Return radial and axial load of a bearing [N]."""
        x, y, z = self.state.reactions[list(self.model.bearing_models).index(name)][:3]
        return math.hypot(y, z), abs(x)


def solved_point(
    model: BearingModel | MachineModel, kernels: SharedKernels, announce: Announce = None
) -> AlonePoint | MachinePoint:
    """Solve a bearing or a machine for a study.

    SolverError when there is no equilibrium.
    """
    point = AlonePoint if isinstance(model, BearingModel) else MachinePoint
    return point(model, kernels, announce)  # type: ignore[arg-type]


@dataclass
class DynamicPoint:
    """A dynamic point: a result and its summary.

    Attributes
    ----------
    result : Result
    summary : Summary or BearingSummary
        Of the run; of a bearing of a machine its own.
    machine : DynamicPoint or None
        The run of the machine that it belongs to.
    """

    result: Result
    summary: Summary | BearingSummary
    machine: DynamicPoint | None = None

    @property
    def rating(self) -> Rating | None:
        """Lives and safety at the start."""
        found: Rating | None = self.summary.rating
        return found

    @property
    def currents(self) -> CurrentNumbers:
        """Bearing currents on the films of the run."""
        return (self.machine or self).circuit[self.result.bearing]

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on the films of a run.

        Each bearing has its own.
        """
        return circuit_numbers(self.result)

    def bearing(self, name: str) -> DynamicPoint:
        """Return one bearing of a machine by its name.

        A bearing that is alone has the empty name.
        """
        if not name:
            return self
        return DynamicPoint(self.result.bearings[name], self.summary.bearings[name], self)  # type: ignore[union-attr]

"""Solve a machine at its operating point.

Apart, so that one bearing loads no code of machines.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric.current_numbers import PHASES, CurrentNumbers, static_numbers
from lambda_core.analysis.rating.engineering import rating_of
from lambda_core.analysis.rotor.bearing_alone import alone_under_load, taken_out
from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium, equilibrium_of
from lambda_core.analysis.rotor.machine_modes import MachineModes, ModeAtSpeed, modes_at_speed, modes_of
from lambda_core.analysis.static_point import BearingPoint, LoadedBearing, StaticPoint
from lambda_core.discovery.api import registry
from lambda_core.results.roller_quasistatic import roller_statics
from lambda_core.solver.drivers.bearing_reaction import held
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine
from lambda_core.solver.drivers.preload import preloads
from lambda_core.solver.drivers.roller_reaction import RollerReaction

if TYPE_CHECKING:
    from lambda_core.domain.arrays import FloatArray
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.model.roller_case import RollerModel
    from lambda_core.results.rating import Rating
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.equilibrium import Equilibrium


class MachinePoint(StaticPoint):
    """Quasi-static point of a machine.

    `state` and `equilibria` are those of machine and bearings where they are known.
    """

    def __init__(
        self,
        model: MachineModel,
        announce: Announce = None,
        kernels: SharedKernels | None = None,
        state: MachineState | None = None,
        equilibria: Sequence[Equilibrium] = (),
    ) -> None:
        self.model: MachineModel = model
        self._announce, self._kernels = announce, kernels or SharedKernels(announce)
        self._known, self._solved = state, equilibria

    @cached_property
    def bearings(self) -> dict[str, MountedPoint]:
        """All bearings by name, from left to right."""
        return {one.name: MountedPoint(self, i) for i, one in enumerate(self.model.bearings)}

    @cached_property
    def state(self) -> MachineState:
        """The equilibrium of shaft, rings and bodies."""
        return self._known or solve_machine(self.model, self._announce, self._kernels)

    def equilibrium(self, number: int) -> Equilibrium:
        """Return the equilibrium of a bearing with friction.

        It holds at the pose of its rings.
        """
        return self._solved[number] if self._solved else self.state.rings[number].equilibrium()

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films.

        Each bearing has its own current; one circuit joins all.
        """
        from lambda_core.analysis.electric.contacts import equilibria

        each = self.bearings.values()
        solved = [equilibria(one.in_place, PHASES, kernels=self._kernels.of(one.model)) for one in each]
        return static_numbers(self.model, solved)

    @property
    def speed_rpm(self) -> float:
        """Speed of the shaft without its sign [1/min]."""
        return abs(self.answer.speed_rpm)

    @cached_property
    def answer(self) -> MachineEquilibrium:
        """The equilibrium without preload, which costs solutions of its own."""
        return equilibrium_of(self)

    @cached_property
    def summary(self) -> MachineEquilibrium:
        """The equilibrium with preload."""
        return self.answer.preloaded(preloads(self.model, self._kernels))

    @cached_property
    def modes(self) -> MachineModes:
        """Natural frequencies and critical speeds."""
        return modes_of(self.model, self.state)

    @cached_property
    def modes_at_speed(self) -> list[ModeAtSpeed]:
        """Natural frequencies at the point's speed.

        They are in ascending order.
        """
        found = modes_at_speed(self.model, self.state, self.equilibria)
        return sorted(found, key=lambda mode: mode.frequency_Hz)


class MountedPoint(BearingPoint):
    """A bearing of a machine under its load there."""

    point: MachinePoint

    def __init__(self, point: MachinePoint, number: int) -> None:
        mounted = point.model.bearings[number]
        super().__init__(point, mounted.name, mounted.model)
        self.number = number

    @cached_property
    def equilibrium(self) -> Equilibrium:
        """The equilibrium with friction of the rolling elements.

        It holds at the pose of the rings in the machine.
        """
        return self.point.equilibrium(self.number)

    @property
    def reaction(self) -> FloatArray:
        """Force and moment on the shaft.

        The array has shape (5,) [N, N m].
        """
        return np.asarray(self.point.state.reactions[self.number])

    @property
    def pose(self) -> FloatArray:
        """Pose of the inner ring against the outer one.

        The array has shape (5,) [m, rad].
        """
        return self.point.state.pose(self.point.model, self.number)

    @property
    def loads(self) -> tuple[float, float]:
        """Radial and axial load [N]."""
        x, y, z = self.reaction[:3]
        return float(np.hypot(y, z)), abs(float(x))

    @cached_property
    def rating(self) -> Rating:
        """Lives and safety under the load in the machine."""
        if self.rollers is None:
            return rating_of(self.equilibrium, registry().methods, self.loads)
        found: Rating = self.roller_statics["rating"]
        return found

    @cached_property
    def roller_statics(self) -> Mapping[str, Any]:
        """Fields of :class:`BearingStatics` of its rollers.

        They hold at the last pose of its rings, like those of a bearing that is alone.
        """
        assert self.rollers is not None
        return roller_statics(self.rollers, self.solved_rollers, self.model, on_shaft=True)

    @property
    def alone(self) -> BearingModel:
        """The bearing alone under its load."""
        return alone_under_load(self.point.model, self.point.state, self.number)

    @property
    def in_place(self) -> BearingModel:
        """The bearing with rings held as in the machine."""
        return held(self.model, self.pose.tolist())

    @cached_property
    def rollers(self) -> RollerModel | None:
        """Its rollers under the load; None of balls."""
        ring = self.point.state.rings[self.number]
        return taken_out(ring) if isinstance(ring, RollerReaction) else None

    @property
    def loaded(self) -> LoadedBearing:
        """The bearing with its load."""
        return LoadedBearing(self.alone if self.rollers is None else self.model, self.rollers)

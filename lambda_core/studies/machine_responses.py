"""Define responses of a machine and its bearings.

``NAME.RESPONSE`` is that of one bearing.

Every response of a study of one bearing exists for each bearing ("left.min_film_um"), as do the rows of comparison
methods ("left.skf/friction/total"). Bearing currents are those of the machine's circuit with all its bearings.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.electric.current_numbers import UNITS, CurrentNumbers, machine_numbers, meaning
from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.quantity import quantities
from lambda_core.results.summary import Summary
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine
from lambda_core.studies.responses import RATED, RESPONSES, DynamicPoint, Number, Response, StaticPoint, of_fields

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_modes import MachineModes, ModeAtSpeed
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.equilibrium import Equilibrium
    from lambda_core.studies.method_columns import Columns


@dataclass
class MachinePoint:
    """Quasi-static point of a machine.

    Every requested result is computed once.
    """

    model: MachineModel
    state: MachineState
    kernels: SharedKernels
    _points: dict[str, StaticPoint] = field(default_factory=dict)

    @cached_property
    def equilibria(self) -> list[Equilibrium]:
        """Equilibria of all bearings with friction.

        They hold at the bearings' poses, with the friction of their balls.
        """
        return [ring.equilibrium() for ring in self.state.rings]

    @property
    def speed_rpm(self) -> float:
        """Speed of the shaft without its sign [1/min]."""
        return abs(self._plain.speed_rpm)

    @property
    def rated(self) -> Mapping[str, BearingEquilibrium]:
        """Bearings with their ratings, by name."""
        return self._plain.each

    @property
    def warnings(self) -> list[str]:
        """Geometric conflicts of parts on the shaft."""
        return self._plain.warnings

    @cached_property
    def _plain(self) -> MachineEquilibrium:
        """The equilibrium without preload, which costs solutions of its own."""
        from lambda_core.analysis.rotor.machine_equilibrium import equilibrium_of

        return equilibrium_of(self.model, self.state)

    @cached_property
    def summary(self) -> MachineEquilibrium:
        """The equilibrium in the words of the machine interface."""
        from lambda_core.analysis.rotor.machine_equilibrium import equilibrium_of
        from lambda_core.solver.drivers.preload import preloads

        return equilibrium_of(self.model, self.state, self.equilibria, preloads(self.model, self.kernels))

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

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on quasi-static films.

        Each bearing has its own current; one circuit joins all.
        """
        return machine_numbers(
            self.model, self.state, [self.kernels.of(bearing.model) for bearing in self.model.bearings]
        )

    @property
    def each(self) -> list[Equilibrium]:
        """Equilibria of all bearings, from left to right."""
        return self.equilibria

    def columns(self, names: Sequence[str]) -> Columns:
        """Return the rows of comparison methods among names.

        Their names and meanings begin with the bearing's name.
        """
        from lambda_core.studies.method_columns import method_columns

        columns: Columns = {}
        each = zip(self.model.bearings, self.equilibria, self.state.reactions, strict=True)
        for bearing, found, (x, y, z, *_) in each:
            own = f"{bearing.name}."
            rows = [name.removeprefix(own) for name in names if "/" in name and name.startswith(own)]
            for name, (value, unit, words) in method_columns(found, rows, (math.hypot(y, z), abs(x))).items():
                columns[own + name] = (value, unit, f"{bearing.name}: {words}")
        return columns

    def bearing(self, name: str) -> StaticPoint:
        """Return one bearing as a point of its own."""
        from lambda_core.results.quasistatic import quasistatic_of

        if name not in self._points:
            number = [one.name for one in self.model.bearings].index(name)
            found = self.equilibria[number]
            kernels = self.kernels.of(self.model.bearings[number].model)
            self._points[name] = StaticPoint(found, quasistatic_of(found), kernels)
        return self._points[name]


def machine_point(model: MachineModel, kernels: SharedKernels, announce: Announce = None) -> MachinePoint:
    """Solve a machine for a point of a study."""
    return MachinePoint(model, solve_machine(model, announce, kernels), kernels)


@lru_cache(maxsize=8)
def machine_responses(bearings: tuple[str, ...]) -> Mapping[str, Response]:
    """Return the responses of a machine.

    The responses name the bearings.
    """
    found = [*_of_machine(), *(one for name in bearings for one in _of_bearing(name))]
    return {response.name: response for response in found}


def usual_responses(bearings: tuple[str, ...], mode: str) -> tuple[str, ...]:
    """Return the default responses of a machine.

    A study that names none takes them.
    """
    if mode == "quasi-static":
        of_machine = ["system_life_h", "friction_torque_Nmm"]
        each = [
            "radial_load_N", "reference_life_h", "friction_torque_Nmm", "max_pressure_GPa", "min_film_parameter",
        ]  # fmt: skip
    else:
        of_machine = ["friction_torque_Nmm", "energy_residual", "converged"]
        each = ["friction_torque_Nmm", "friction_torque_ci_Nmm", "max_pressure_GPa", "min_film_um"]
    return (*of_machine, *(f"{name}.{one}" for name in bearings for one in each))


def _of_machine() -> list[Response]:
    still, moving = quantities(MachineEquilibrium), quantities(Summary)
    found = []
    for one in of_fields(Summary, moving):
        read = _number(one.name)
        static = _power if one.name == "power_loss_W" else read if one.name in still else None
        found.append(replace(one, static=static, dynamic=read))
    return [
        *found,
        Response("max_deflection_um", "um", "largest deflection of the shaft across its axis", _deflection),
        Response("first_critical_speed_rpm", "rpm", "first critical speed", _critical),
        Response("converged", "", "1 when converged", None, lambda point: float(point.summary.converged)),
    ]


def _number(name: str) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        value = getattr(point.summary, name)
        return None if value is None else float(value)

    return read


def _power(point: Any) -> Number:
    return float(sum(found.losses.sum() for found in point.equilibria))


def _deflection(point: Any) -> Number:
    return float(np.hypot(*np.array(point.summary.deflection_um).T[1:]).max())


def _critical(point: Any) -> Number:
    found = point.modes.critical_speeds
    return found[0].speed_rpm if found else None


# Responses of one bearing that a machine has once.
_OF_MACHINE = {"converged", *quantities(Summary)} - set(quantities(BearingSummary))


def _of_bearing(name: str) -> list[Response]:
    fields = (key for key in quantities(BearingEquilibrium) if key not in RESPONSES)
    own = [
        Response(f"{name}.{one.name}", one.unit, f"{name}: {one.meaning}", _field(name, one.name))
        for one in of_fields(BearingEquilibrium, fields)
    ]
    own += [
        Response(f"{name}.{key}", rated.unit, f"{name}: {rated.meaning}", _rated(name, key), _dynamic(name, read))
        for key in RATED
        if (rated := RESPONSES[key]) and (read := rated.dynamic) is not None
    ]
    currents = [
        Response(f"{name}.{key}", unit, f"{name}: {meaning(key)}", _current(name, key), _current(name, key))
        for key, unit in UNITS.items()
    ]
    stiffness = [
        Response(
            f"{name}.stiffness_N_per_um.{axis}",
            "N/um",
            f"{name}: stiffness {axis}",
            _stiffness(name, index),
        )
        for index, axis in enumerate("xyz")
    ]
    return own + stiffness + currents + [
        Response(
            f"{name}.{one.name}", one.unit, f"{name}: {one.meaning}",
            None if one.static is None else _static(name, one.static),
            None if one.dynamic is None else _dynamic(name, one.dynamic),
        )
        for one in RESPONSES.values()
        if one.name not in {*UNITS, *_OF_MACHINE, *RATED}
    ]  # fmt: skip


def _field(name: str, path: str) -> Callable[[Any], Number]:
    key, _, axis = path.partition(".")
    axes = quantities(BearingEquilibrium)[key].axes

    def read(point: Any) -> Number:
        value: Any = getattr(point.summary.bearing(name), key)
        if axis:
            value = value[axes.index(axis)]
        return None if value is None else float(value)

    return read


def _rated(name: str, key: str) -> Callable[[Any], Number]:
    return lambda point: getattr(point.summary.bearing(name).rating, key)


def _stiffness(name: str, index: int) -> Callable[[Any], Number]:
    return lambda point: 1e-6 * float(point.summary.bearing(name).stiffness[index][index])


def _current(name: str, key: str) -> Callable[[Any], Number]:
    def read(point: Any) -> Number:
        value: Number = getattr(point.circuit[name], key)
        return value

    return read


def _static(name: str, read: Callable[[StaticPoint], Number]) -> Callable[[Any], Number]:
    return lambda point: read(point.bearing(name))


def _dynamic(name: str, read: Callable[[DynamicPoint], Number]) -> Callable[[Any], Number]:
    return lambda point: read(DynamicPoint(point.result.bearings[name], point.summary.bearings[name]))

"""Find the temperatures of a machine.

Shaft equilibrium and losses of all bearings follow them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from lambda_core.analysis.rotor.bearing_alone import taken_out
from lambda_core.analysis.thermal.feedback import (
    INLET_STEP,
    LENGTH_STEP,
    PARTS,
    Loop,
    Steady,
    clearance_at,
    degrees,
    inlet_at,
    stated_clearance,
)
from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
from lambda_core.analysis.thermal.losses import Announce, Point, model_at, point_of, point_of_rollers
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.analysis.thermal.shaft_and_housing import network_of
from lambda_core.analysis.thermal.surroundings import housing_area
from lambda_core.case.case_io import toml_tables
from lambda_core.case.thermal import MachineThermal, Thermal
from lambda_core.case.written import merged
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.model.machine_model import MachineModel, MountedBearing
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.model.settings.machine_heat import BEARING_NODES, stretch
from lambda_core.solver.drivers.machine_statics import MachineState, SharedKernels, solve_machine
from lambda_core.solver.drivers.roller_reaction import Ring, RollerReaction

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel

_ZERO_CELSIUS = 273.15
_NEAR = (2.0, 1e-6)  # inlet temperatures [K] and lengths [m] this near to others have their slopes


class MachineLoop(Loop):
    """Torque and temperature of all bearings of a machine.

    The contacts of each bearing see the temperature of their oil, the clearance in operation, and how far shaft and
    housing have grown apart at its place.

    Parameters
    ----------
    machine : MachineModel
        Resolved, without temperatures of its own for shaft, housing and rings.
    announce : callable, optional
        Called with a sentence before something is compiled.
    """

    def __init__(self, machine: MachineModel, announce: Announce = None) -> None:
        oil = float(np.mean([bearing.model.oil.temperature for bearing in machine.bearings]))
        super().__init__(machine.name, network_of(machine), machine.heat.section, oil)
        self.machine = replace(machine, awaits_temperatures=False)
        self.bearings, self.speed = machine.bearings, machine.speed
        self.shaft = tuple(zip(machine.heat.shaft, machine.body.positions.tolist(), strict=True))
        clearances = stated_clearance(machine.bearing_models.values())
        self.of_network, self.of_case = [*machine.heat.assumptions, *clearances], machine.assumptions
        count = len(machine.bearings)
        self.steps = np.array([INLET_STEP] * count + [LENGTH_STEP] * (2 * count))
        self._cells = np.array([_NEAR[0]] * count + [_NEAR[1]] * (2 * count))
        self._known: tuple[FloatArray, FloatArray] | None = None  # what was seen, and the slopes there
        self._announce, self._kernels, self._count = announce, SharedKernels(announce), 0
        self._last: MachineState | None = None

    def seen(self, temperatures: FloatArray) -> FloatArray:
        """Return the quantities that the contacts see.

        They are inlet temperatures [K], clearances [m], and growth of the shaft beyond the housing's [m].
        """
        at, heat = self.nodes.named(temperatures), self.machine.heat
        inlets, clearances = [], []
        for bearing in self.machine.bearings:
            own = {node: at[name] for node in BEARING_NODES if (name := f"{bearing.name}.{node}") in at}
            own |= {"housing": at["housing"]} if "housing" in at else {}
            inlets.append(inlet_at(heat.bearings[bearing.name], own))
            clearances.append(clearance_at(bearing.model, own))
        return np.array([*inlets, *clearances, *self.grown(at)])

    def grown(self, at: Mapping[str, float]) -> FloatArray:
        """Return the shaft's growth beyond the housing [m].

        There is one value for each bearing.

        Where the network has no shaft or no housing, they have the mean temperature of inner or outer rings. A rigid
        shaft has no length along which it could grow.
        """
        machine, heat = self.machine, self.machine.heat
        if machine.body.is_rigid:
            return np.zeros(1)
        places = np.array([bearing.position for bearing in machine.bearings])
        along = machine.body.positions
        warm = np.array([at.get(name, _mean(machine, at, "inner_ring")) for name in heat.shaft])
        around = np.full(2, at.get("housing", _mean(machine, at, "outer_ring")))
        ends = np.array([along.min(), along.max()])
        found: FloatArray = stretch(places, along, warm, heat.material) - stretch(places, ends, around, heat.housing)
        return found

    def model_at(self, found: Steady, sentence: str = "", *, is_static: bool = True) -> MachineModel:
        """Return the machine at found temperatures; see :class:`Loop`."""
        del is_static  # a machine is resolved without an end in time
        warm = resolve_machine(_with_temperatures(self, found, sentence))
        return replace(warm, found_temperatures=FoundTemperatures(self, found))

    def words(self, found: Steady) -> str:
        """Return the temperatures of rings, oil and housing [degC]."""
        at = self.nodes.named(found.temperatures)
        each = [
            f"{bearing.name} inner ring {at[f'{bearing.name}.inner_ring'] - _ZERO_CELSIUS:.1f}, "
            f"outer ring {at[f'{bearing.name}.outer_ring'] - _ZERO_CELSIUS:.1f}, oil {point.inlet - _ZERO_CELSIUS:.1f}"
            for bearing, point in zip(self.machine.bearings, found.points, strict=True)
        ]
        housing = f"; housing {at['housing'] - _ZERO_CELSIUS:.1f}" if "housing" in at else ""
        return f"{'; '.join(each)}{housing}"

    def headline(self, points: Sequence[Point]) -> str:
        """Return the line of speed and bearings."""
        each = ", ".join(f"{one.name} {one.model.title.split(' (', maxsplit=1)[0]}" for one in self.bearings)
        return f"{self.name}: {self.speed * 30.0 / math.pi:.5g} 1/min, {each}"

    def there(self, seen: FloatArray) -> MachineModel:
        """Return the machine in the contacts' condition.

        Growth shifts the outer rings the other way.
        """
        inlets, clearances, grown = seen.reshape(3, -1).tolist()
        mounted = zip(self.machine.bearings, inlets, clearances, grown, strict=True)
        return replace(self.machine, bearings=tuple(_warm(*one) for one in mounted))

    def points_of(self, model: BearingModel | MachineModel) -> tuple[Point, ...]:
        """Return each bearing's point at a model's own temperatures."""
        state = solve_machine(cast("MachineModel", model), self._announce)
        return tuple(_point(ring, one.name) for ring, one in zip(state.rings, self.machine.bearings, strict=True))

    def solved(self, seen: FloatArray) -> tuple[Point, ...]:
        """Solve shaft and bearings, return each bearing's point.

        Raises
        ------
        SolverError
            When there is no equilibrium, with the temperatures.
        """
        self._last = None
        try:
            self._last, points = self._solved(seen, None)
        except SolverError as error:
            raise SolverError(f"{self._place(seen)}: {error}") from error
        return points

    def solved_near(self, seen: FloatArray, *, is_followed: bool = False) -> tuple[Point, ...]:
        """Solve shaft and bearings from their last equilibrium.

        It takes a third of the time; where the way from there leads nowhere they are solved anew.
        """
        if self._last is not None:
            with suppress(SolverError):
                state, points = self._solved(seen, self._last)
                self._last = state if is_followed else self._last
                return points
        return self.solved(seen)

    def _solved(self, seen: FloatArray, near: MachineState | None) -> tuple[MachineState, tuple[Point, ...]]:
        self._count += 1
        state = solve_machine(self.there(seen), self._announce, self._kernels, near)
        each = zip(state.rings, self.machine.bearings, strict=True)
        return state, tuple(_point(ring, one.name) for ring, one in each)

    def slopes(
        self, seen: FloatArray, points: Sequence[Point], temperatures: FloatArray
    ) -> tuple[FloatArray, FloatArray]:
        """Return the slopes.

        The slopes d(steady temperatures)/d(seen) are those of a near place where one is known.
        """
        known = self._known
        if known is not None and float((np.abs(seen - known[0]) / self._cells).max()) <= 1.0:
            return known[1], self.inward(temperatures)
        outward, inward = super().slopes(seen, points, temperatures)
        self._known = (seen, outward)
        return outward, inward

    def nodes_with(self, change: Callable[[Thermal], Thermal]) -> MachineNetwork:
        """Return the network with a changed section of the case.

        What each bearing has of its own is changed, too.
        """
        heat = self.machine.heat
        own = {name: change(one) for name, one in heat.bearings.items()}
        section = cast("MachineThermal", change(heat.section))  # a copy keeps its class
        return network_of(replace(self.machine, heat=replace(heat, section=section, bearings=own)))

    @property
    def usual_area(self) -> float:
        """Outer surface of a usual housing [m2]."""
        return sum(housing_area(one.model.geometry.outside_diameter) for one in self.machine.bearings)

    def _place(self, seen: FloatArray) -> str:
        inlets, clearances, _ = seen.reshape(3, -1).tolist()
        parts = [
            f"{bearing.name} {inlet - _ZERO_CELSIUS:.1f} degC and {1e6 * clearance:.1f} um"
            for bearing, inlet, clearance in zip(self.machine.bearings, inlets, clearances, strict=True)
        ]
        return f"at inlets and clearances of {', '.join(parts)}"

    @property
    def count(self) -> int:
        """Quasi-static points that were solved."""
        return self._count


def _point(ring: Ring, name: str) -> Point:
    """Return a bearing's point at its rings' last pose.

    SolverError where its balls have no steady motion.
    """
    if isinstance(ring, RollerReaction):
        return point_of_rollers(ring.model, taken_out(ring))
    found = ring.equilibrium()
    if not found.converged:
        raise SolverError(f"the {ring.model.elements} of {name} have no steady motion: change load or speed")
    return point_of(found)


def _mean(machine: MachineModel, at: Mapping[str, float], part: str) -> float:
    return float(np.mean([at[f"{bearing.name}.{part}"] for bearing in machine.bearings]))


def _warm(mounted: MountedBearing, inlet: float, clearance: float, grown: float) -> MountedBearing:
    """Return a bearing at oil temperature and clearance.

    Its outer ring is moved against the shaft's growth.
    """
    model, seating = mounted.model, mounted.seating
    model = model_at(model, inlet, clearance)
    shift = (seating.shift[0] - grown, *seating.shift[1:])
    return replace(mounted, model=model, seating=replace(seating, shift=shift))


def without_temperatures(machine: MachineModel) -> MachineModel:
    """Return the machine without its case's temperatures.

    All of them are to be computed.
    """
    if machine.awaits_temperatures:
        return machine
    tables = toml_tables(machine.case_toml, machine.name)
    for name in ("shaft", "housing"):
        kept = {key: value for key, value in tables.get(name, {}).items() if not key.startswith("temperature")}
        tables |= {name: kept} if name in tables else {}
    bearings = {}
    for name, given in tables["bearings"].items():
        parts = {key: value for key, value in given.get("temperatures", {}).items() if key not in PARTS}
        bearings[name] = {key: value for key, value in given.items() if key != "temperatures"}
        bearings[name] |= {"temperatures": parts} if parts else {}
    tables |= {"bearings": bearings, "operation": {**tables["operation"], "temperatures": "computed"}}
    return resolve_machine(tables)


def _with_temperatures(loop: MachineLoop, found: Steady, sentence: str) -> dict[str, Any]:
    """Return the case's tables with computed temperatures."""
    machine, at = loop.machine, loop.nodes.named(found.temperatures)
    tables = toml_tables(machine.case_toml, machine.name)
    bearings = {}
    for bearing, point in zip(machine.bearings, found.points, strict=True):
        own = {part: at.get(f"{bearing.name}.{part}", at.get(part, math.nan)) for part in PARTS}
        parts = {part: degrees(value) for part, value in own.items() if math.isfinite(value)}
        bearings[bearing.name] = {"temperatures": parts, "lubricant": {"temperature": degrees(point.inlet)}}
    nodes = zip(machine.heat.shaft, machine.body.positions.tolist(), strict=True)
    warm = {x: at.get(name, _mean(machine, at, "inner_ring")) for name, x in nodes}
    along = [[f"{1e3 * x:.9g} mm", degrees(value)] for x, value in warm.items()]
    changed = merged(
        tables,
        {
            "assumptions": [*tables.get("assumptions", []), sentence],
            "bearings": bearings,
            "shaft": {"temperatures": along},
            "housing": {"temperature": degrees(at.get("housing", _mean(machine, at, "outer_ring")))},
        },
    )
    changed["operation"] = {key: value for key, value in changed["operation"].items() if key != "temperatures"}
    return changed

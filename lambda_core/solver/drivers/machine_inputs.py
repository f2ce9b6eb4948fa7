"""Take loads and speed of a machine from another program.

A load acts at a marker, a load or a gear of the case, on the shaft or on a body, and goes to the lumps of the shaft as
the beam hands it on. A signal is named like the option of a case that it adds to: ``gears.wheel.force_z``,
``markers.foot.force_x``, ``shaft.spin``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.machine_model import GROUND, SHAFT, MachineModel, Place
from lambda_core.solver import records as R
from lambda_core.solver.drivers.lumps import LumpedShaft
from lambda_core.solver.drivers.machine_assembly import MemberNumbers, member_numbers
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.time_tables import FORCE, MOMENT, MOTION, PER_BODY

SHAFT_SPIN = "shaft.spin"
_ABOUT_X, _SPIN = 3, 5  # row of a node; motion of a member
# Signals of a member in the order of the six rows of a node.
_LOADS = (FORCE, FORCE + 1, FORCE + 2, MOMENT, MOMENT + 1, MOMENT + 2)
_WORDS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
_NOTHING = 1e-15  # share of a load from which on it is rounding


@dataclass
class MachineInputs:
    """External inputs of a machine.

    It has the terms of loads and motions that follow them.

    Attributes
    ----------
    names : tuple of str
    values : float64[:, 3]
        Of each name: value, rate and acceleration when it was given last.
    since : float64[:]
        When that was [s].
    shares : dict of int to list of (int, float)
        Of each term: numbers of the names that add to it, and with what weights.
    rows : records.TERM[:]
        The terms, a view of what compiled code reads.
    """

    names: tuple[str, ...]
    values: FloatArray
    since: FloatArray
    shares: dict[int, list[tuple[int, float]]]
    rows: Any = field(default_factory=lambda: np.zeros(0, R.TERM))

    @property
    def turns(self) -> bool:
        """True if the shaft's speed is given."""
        return SHAFT_SPIN in self.names

    def give(self, name: str, value: float, rate: float, acceleration: float, time: float) -> None:
        """Write what is given at a time into the terms."""
        number = self.names.index(name)
        self._put(number, (value, rate, acceleration), time)
        for row, shares in self.shares.items():
            if all(other != number for other, _ in shares):
                continue
            total = [0.0, 0.0, 0.0]
            for other, weight in shares:
                for k, part in enumerate(self._at(other, time)):
                    total[k] += weight * part
            term = self.rows[row]
            term["value"], term["rate"], term["acceleration"], term["begin"] = *total, time

    def _put(self, number: int, values: tuple[float, float, float], time: float) -> None:
        self.values[number], self.since[number] = values, time

    def _at(self, number: int, time: float) -> tuple[float, float, float]:
        """Return value, rate and acceleration of a name.

        They hold at a time.
        """
        value, rate, acceleration = self.values[number].tolist()
        if rate == acceleration == 0.0:
            return value, 0.0, 0.0
        passed = time - float(self.since[number])
        return value + passed * (rate + 0.5 * passed * acceleration), rate + passed * acceleration, acceleration

    def state(self) -> dict[str, FloatArray]:
        """Return what a continuation needs."""
        return {"values": self.values.copy(), "since": self.since.copy()}

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        """Go back to what :meth:`state` returned.

        The terms are those of the engine's own state.
        """
        self.values[...], self.since[...] = state["values"], state["since"]


def machine_inputs(machine: MachineModel, shaft: LumpedShaft, context: SolverContext) -> MachineInputs:
    """Add external inputs to a machine.

    They act on its loads and motions.

    A load adds to those of the case and is 0 at first; the speed takes the place of the case's, where that is constant.
    """
    numbers = member_numbers(machine, shaft)
    loads = dict(_all_loads(machine, shaft, numbers))
    names = list(loads)
    if machine.torque is None and all(term.kind == "constant" for term in machine.speed_over_time.terms):
        names.append(SHAFT_SPIN)
    turned = [PER_BODY * int(member) + MOTION + _SPIN for member in numbers.driven]
    of_signal: dict[int, list[tuple[int, float]]] = {}
    for number, name in enumerate(names):
        own = dict.fromkeys(turned, 1.0) if name == SHAFT_SPIN else loads[name]
        for signal, weight in own.items():
            of_signal.setdefault(signal, []).append((number, weight))
    values = np.zeros((len(names), 3))
    if SHAFT_SPIN in names:
        values[names.index(SHAFT_SPIN), 0] = machine.speed
    found = MachineInputs(tuple(names), values, np.zeros(len(names)), dict(enumerate(of_signal.values())))
    terms, rows = context.bundle.terms, np.zeros(len(of_signal), R.TERM)
    rows["signal"], rows["kind"] = list(of_signal), R.GIVEN
    if SHAFT_SPIN in names:
        terms = terms[~np.isin(terms["signal"], turned)]
        rows["value"][np.isin(rows["signal"], turned)] = machine.speed
    context.bundle = context.bundle._replace(terms=np.concatenate([terms, rows]))
    found.rows = context.bundle.terms[terms.size :]
    return found


def load_places(machine: MachineModel) -> dict[str, Place]:
    """Return the places of external loads.

    The keys are the names of the case.
    """
    wheels = {name for name, *_ in machine.wheels}
    found = {
        f"{'gears' if name in wheels else 'loads'}.{name}": Place(SHAFT, (float(at), 0.0, 0.0), np.eye(3))
        for name, at in machine.load_places
    }
    return found | {f"markers.{name}": place for name, place in machine.markers if place.body != GROUND}


def _all_loads(
    machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers
) -> Iterator[tuple[str, dict[int, float]]]:
    """Yield names of loads with their signals.

    The signals that each adds to and the weights there.
    """
    for name, place in load_places(machine).items():
        for axis, word in enumerate(_WORDS):
            if word == "moment_x" and place.body == SHAFT and not machine.twists:
                continue  # the coupling takes it: it moves nothing
            yield f"{name}.{word}", _signals(machine, shaft, numbers, place, axis)


def _signals(
    machine: MachineModel, shaft: LumpedShaft, numbers: MemberNumbers, place: Place, axis: int
) -> dict[int, float]:
    """Return the signals of a load.

    They are along one axis, with the weights there.
    """
    if place.body == SHAFT:
        lumps = numbers.lumps
        at, moves = carried_by_shaft(machine.body, place.point)
        onto = moves[axis] @ shaft.follow[machine.body.rows(at)]
        each = onto[: NODE * lumps.size].reshape(lumps.size, NODE).copy()
        if not machine.twists:
            each[:, _ABOUT_X] = 0.0
        members = lumps.tolist()
    else:
        member, centre = numbers.carrier(machine, place.body)
        each = carried(np.subtract(place.point, centre))[axis].reshape(1, NODE)
        members = [member]
    return {
        PER_BODY * member + _LOADS[row]: float(weight)
        for member, weights in zip(members, each, strict=True)
        for row, weight in enumerate(weights)
        if abs(weight) > _NOTHING
    }

"""Take loads and motions from another program.

A signal is named like the option of a case that it stands for or adds to: ``inner_ring.force_z``, ``outer_ring.tilt_y``
and ``inner_ring.spin`` of a bearing that is alone; ``gears.wheel.force_z``, ``markers.foot.force_x`` and ``shaft.spin``
of a machine. From the moment at which it is given it goes on with the derivatives that were given with it, until it is
given anew. A load of a machine acts at a marker, a load or a gear of the case, on the shaft or on a body, and goes to
the lumps of the shaft as the beam hands it on.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, DOFS
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.machine_model import GROUND, SHAFT, MachineModel, Place
from lambda_core.solver import records as R
from lambda_core.solver.drivers.lumps import LumpedShaft
from lambda_core.solver.drivers.machine_assembly import MemberNumbers, member_numbers
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.time_tables import FORCE, MOMENT, MOTION, PER_BODY

SHAFT_SPIN = "shaft.spin"
_MOTIONS = {f"{body}.{dof}": PER_BODY * b + MOTION + d for b, body in enumerate(BODIES) for d, dof in enumerate(DOFS)}
_LOADS = {
    f"{body}.{kind}_{axis}": PER_BODY * b + first + a
    for b, body in enumerate(BODIES)
    for kind, first in (("force", FORCE), ("moment", MOMENT))
    for a, axis in enumerate("xyz")
}
_ABOUT_X, _SPIN = 3, 5  # row of a node; motion of a member
# Signals of a member in the order of the six rows of a node.
_OF_NODE = (FORCE, FORCE + 1, FORCE + 2, MOMENT, MOMENT + 1, MOMENT + 2)
_WORDS = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
_NOTHING = 1e-15  # share of a load from which on it is rounding


@dataclass
class ExternalInputs:
    """External inputs of a bearing or a machine.

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
    rows: Any

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
        return {"values": self.values.copy(), "since": self.since.copy(), "rows": self.rows.view(np.float64).copy()}

    def restore(self, state: Mapping[str, FloatArray]) -> None:
        """Go back to what :meth:`state` returned."""
        self.values[...], self.since[...] = state["values"], state["since"]
        self.rows.view(np.float64)[:] = state["rows"]


def no_inputs() -> ExternalInputs:
    """Return the inputs of a motion that takes none."""
    return ExternalInputs((), np.zeros((0, 3)), np.zeros(0), {}, np.zeros(0, R.TERM))


def bearing_inputs(context: SolverContext, names: Sequence[str]) -> ExternalInputs:
    """Add external inputs to a bearing that is alone.

    A given load adds to those of the case and is 0 at first; a given motion takes the place of the case's and
    begins at its value at t = 0.
    """
    rows, terms = np.zeros(len(names), R.TERM), context.bundle.terms
    rows["signal"], rows["kind"] = [(_MOTIONS | _LOADS)[name] for name in names], R.GIVEN
    for row, name in zip(rows, names, strict=True):
        if name in _MOTIONS:
            body, dof = name.split(".")
            row["value"] = initial(getattr(context.model, body).dofs[dof].motion)
    values = np.zeros((len(names), 3))
    values[:, 0] = rows["value"]
    replaced = np.isin(terms["signal"], [_MOTIONS[name] for name in names if name in _MOTIONS])
    context.bundle = context.bundle._replace(terms=np.concatenate([terms[~replaced], rows]))
    rows = context.bundle.terms[terms.size - np.count_nonzero(replaced) :]
    shares = {number: [(number, 1.0)] for number in range(len(names))}
    return ExternalInputs(tuple(names), values, np.zeros(len(names)), shares, rows)


def machine_inputs(machine: MachineModel, shaft: LumpedShaft, context: SolverContext) -> ExternalInputs:
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
    terms, rows = context.bundle.terms, np.zeros(len(of_signal), R.TERM)
    rows["signal"], rows["kind"] = list(of_signal), R.GIVEN
    if SHAFT_SPIN in names:
        terms = terms[~np.isin(terms["signal"], turned)]
        rows["value"][np.isin(rows["signal"], turned)] = machine.speed
    context.bundle = context.bundle._replace(terms=np.concatenate([terms, rows]))
    shares, rows = dict(enumerate(of_signal.values())), context.bundle.terms[terms.size :]
    return ExternalInputs(tuple(names), values, np.zeros(len(names)), shares, rows)


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
        PER_BODY * member + _OF_NODE[row]: float(weight)
        for member, weights in zip(members, each, strict=True)
        for row, weight in enumerate(weights)
        if abs(weight) > _NOTHING
    }

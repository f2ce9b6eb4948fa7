"""Assemble springs, dampers and seats of a machine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import POSE
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried, carried_by_shaft
from lambda_core.model.machine_model import GROUND, PLACES, SHAFT, BearingPart, Carrier, MachineModel, MachineSpring

_RING = np.array(PLACES)


@dataclass(frozen=True)
class Rows:
    """Rows of motions in a vector.

    Attributes
    ----------
    node : callable
        First of the six rows of the shaft at a place [m].
    rings : int
        First row of the outer rings, five each.
    bodies : int
        First row of the rigid bodies, six each.
    size : int
        Of the vector.
    """

    node: Callable[[float], int]
    rings: int
    bodies: int
    size: int


def static_rows(model: MachineModel) -> Rows:
    """Return the rows of an equilibrium's unknowns.

    The shaft has its rows, each ring has five, and each body has six.
    """
    rings = model.body.stiffness.shape[0]
    bodies = rings + len(POSE) * len(model.bearings)
    return Rows(lambda x: model.body.rows(x).start, rings, bodies, bodies + NODE * len(model.bodies))


def point_on(
    model: MachineModel, rows: Rows, body: Carrier, point: Sequence[float]
) -> tuple[NDArray[np.int64], FloatArray]:
    """Return the rows that move a point.

    A point of a body, and how it moves and turns with them, shape (6, rows).
    """
    if body == GROUND:
        return np.zeros(0, dtype=np.int64), np.zeros((NODE, 0))
    at = np.asarray(point, dtype=float)
    if body == SHAFT:
        node, moves = carried_by_shaft(model.body, at)
        return rows.node(node) + np.arange(NODE), moves
    if isinstance(body, BearingPart):
        return _point_on_part(model, rows, body, at)
    own = model.bodies[body - 1]
    return rows.bodies + NODE * (body - 1) + np.arange(NODE), carried(at - own.centre)


def _point_on_part(
    model: MachineModel, rows: Rows, part: BearingPart, at: FloatArray
) -> tuple[NDArray[np.int64], FloatArray]:
    """Return the rows that move a ring's point.

    The ring is an outer ring; no such vector has the rotation of a ring or a cage.
    """
    if part.part == "cage":
        return np.zeros(0, dtype=np.int64), np.zeros((NODE, 0))
    number = model.index(part)
    moves = carried(at - np.array([model.bearings[number].position, 0.0, 0.0]))[:, _RING]
    return rows.rings + len(POSE) * number + np.arange(len(POSE)), moves


def ring_in(model: MachineModel, rows: Rows, index: int) -> FloatArray:
    """Return a ring's motion against its carrier.

    The ring is an outer ring; the array has shape (5, size).
    """
    bearing = model.bearings[index]
    found: FloatArray = np.zeros((len(POSE), rows.size))
    found[range(len(POSE)), rows.rings + len(POSE) * index + np.arange(len(POSE))] = 1.0
    own, moves = point_on(model, rows, bearing.carrier, (bearing.position, 0.0, 0.0))
    found[:, own] -= moves[_RING]
    return found


def stretch(model: MachineModel, rows: Rows, spring: MachineSpring) -> FloatArray:
    """Return a spring's relative motion.

    How its body moves and turns against the other one at its place, shape (6, size).
    """
    found: FloatArray = np.zeros((NODE, rows.size))
    for sign, body in ((1.0, spring.place.body), (-1.0, spring.to)):
        own, moves = point_on(model, rows, body, spring.place.point)
        found[:, own] += sign * moves
    return found


def structure(model: MachineModel, rows: Rows) -> tuple[FloatArray, FloatArray]:
    """Return the structure's stiffness and damping.

    They come from springs, elastic seats and what holds bodies; the array has shape (size, size).
    """
    stiffness, damping = np.zeros((rows.size, rows.size)), np.zeros((rows.size, rows.size))
    for spring in model.springs:
        reach = stretch(model, rows, spring)
        stiffness += reach.T @ spring.stiffness @ reach
        damping += reach.T @ spring.damping @ reach
    for i, bearing in enumerate(model.bearings):
        reach, seat = ring_in(model, rows, i), bearing.seating
        stiffness += reach.T @ np.diag(np.where(np.isfinite(seat.stiffness), seat.stiffness, 0.0)) @ reach
        damping += reach.T @ np.diag(seat.damping) @ reach
    for i, rigid in enumerate(model.bodies):
        own = rows.bodies + NODE * i + np.arange(NODE)
        stiffness[own, own] += np.where(np.isfinite(rigid.hold), rigid.hold, 0.0)
        damping[own, own] += rigid.damping
    return stiffness, damping

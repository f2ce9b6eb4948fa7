"""Put laws of connections into a machine's equilibrium."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.model.bodies.locations import carried
from lambda_core.model.laws.law_context import build_context, prepare
from lambda_core.model.laws.time_functions import spin_at_start
from lambda_core.model.machine_model import GROUND, SHAFT, BearingPart, Carrier, MachineLink, MachineModel, is_on_cage
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.roller_reaction import Ring
from lambda_core.solver.drivers.structure import Rows, point_on

ROLE = "force_element"
_SHIFT, _TURN = 1e-8, 1e-7  # [m], [rad] of central differences
_SWING = 1e-6  # [m/s], [rad/s] likewise


@dataclass(frozen=True)
class SolvedLink:
    """A connection at the equilibrium.

    Attributes
    ----------
    name : str
    wrench : float64[:], shape (6,)
        Force and moment on the place of the connection [N, N m].
    is_on_shaft : bool
        Whether one of its ends is.
    stiffness, damping : float64[:, :]
        In the rows of structure.static_rows.
    """

    name: str
    wrench: FloatArray
    is_on_shaft: bool
    stiffness: FloatArray
    damping: FloatArray


class LinkForce:
    """Connection with a law between two bodies.

    It acts on the unknowns of an equilibrium.

    Parameters
    ----------
    rows : Rows
        Of the unknowns.
    ring : BearingReaction or RollerReaction
        Of the bearing among whose laws the connection's own stands.
    """

    def __init__(self, model: MachineModel, rows: Rows, link: MachineLink, ring: Ring, kernels: Kernels) -> None:
        self.link, self._law = link, ring.model.laws[link.element][ROLE]
        self._call = kernels.compiled[link.element, ROLE].dispatcher
        self._parameters = prepare(self._law, build_context(ring.model, link.element, ring.frame, ring.model.oil))
        # how the ends move, and how the place of the force moves as part of either body, shape (6, rows)
        second = _moves(model, rows, link.second.body, link.second.point, link.second.point)
        self._apart = second - _moves(model, rows, link.first.body, link.first.point, link.first.point)
        self._acts = second - _moves(model, rows, link.first.body, link.first.point, link.second.point)
        self._spin = np.array([_spin(model, link.second.body) - _spin(model, link.first.body), 0.0, 0.0])
        self._drawn = np.subtract(link.second.point, link.first.point)

    def force(self, motions: FloatArray) -> FloatArray:
        """Return the force on the unknowns [N, N m].

        It depends on the motions of shaft, rings and bodies.
        """
        return np.asarray(self._acts.T @ self._wrench(self._apart @ motions))

    def slope(self, motions: FloatArray) -> FloatArray:
        """Return -d(force)/d(motions)."""
        at = self._apart @ motions
        found = np.zeros((NODE, NODE))
        for i, step in enumerate([_SHIFT] * 3 + [_TURN] * 3):
            moved = np.eye(NODE)[i] * step
            found[:, i] = (self._wrench(at - moved) - self._wrench(at + moved)) / (2.0 * step)
        return np.asarray(self._acts.T @ found @ self._apart)

    def solved(self, motions: FloatArray) -> SolvedLink:
        """Return the connection at motions."""
        at = self._apart @ motions
        found = np.zeros((NODE, NODE))
        for i in range(NODE):
            swing = np.eye(NODE)[i] * _SWING
            found[:, i] = (self._wrench(at, -swing) - self._wrench(at, swing)) / (2.0 * _SWING)
        return SolvedLink(
            self.link.name, self._wrench(at), SHAFT in (self.link.first.body, self.link.second.body),
            self.slope(motions), np.asarray(self._acts.T @ found @ self._acts),
        )  # fmt: skip

    def _wrench(self, apart: FloatArray, swing: FloatArray | None = None) -> FloatArray:
        """Return force and moment on the second point.

        They follow from its displacement and velocity.
        """
        velocity = np.zeros(NODE) if swing is None else swing
        out = np.full(NODE, np.nan)
        turned = np.array([0.0, apart[4], apart[5]])
        place, rotation = self._drawn + apart[:3], self._spin + velocity[3:]
        status = self._call(0.0, place, turned, velocity[:3].copy(), rotation, self._parameters, out)
        if status != 1 or not np.isfinite(out).all():
            model = self._law.model
            what = "no finite force" if status == 1 else model.errors.get(status, f"status {status}")
            raise SolverError(f"connections.{self.link.name}: {model.label} returned {what} in the equilibrium")
        return out


def _spin(model: MachineModel, body: Carrier) -> float:
    """Return how fast a body turns about the axis [rad/s]."""
    if isinstance(body, BearingPart):
        return spin_at_start(model.bearings[model.index(body)].model.outer_ring)
    return model.speed if body == SHAFT else 0.0


def _moves(
    model: MachineModel, rows: Rows, body: Carrier, carrier: Sequence[float], point: Sequence[float]
) -> FloatArray:
    """Return a point's motion with a body.

    The shaft's node at `carrier` moves the body; the array has shape (6, size).
    """
    found: FloatArray = np.zeros((NODE, rows.size))
    if body == SHAFT:
        node = model.body.nearest(float(carrier[0]))
        found[:, rows.node(node) + np.arange(NODE)] = carried(np.subtract(point, (node, 0.0, 0.0)))
    elif body != GROUND:
        own, moves = point_on(model, rows, body, point)
        found[:, own] = moves
    return found


def link_forces(model: MachineModel, rows: Rows, rings: Sequence[Ring], kernels: Kernels) -> list[LinkForce]:
    """Return a machine's connections with a law.

    The first bearing has the laws, compiled in `kernels`.

    Those of cages act in motion only: an equilibrium has no cage.
    """
    return [
        LinkForce(model, rows, link, rings[0], kernels)
        for link in model.links
        if not any(map(is_on_cage, (link.first, link.second)))
    ]

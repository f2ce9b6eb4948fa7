"""Compute stiffness, damping and critical speeds of housed bearings."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import Disc, with_discs
from lambda_core.formulas.elastic.whirl import Whirl, critical_speeds, whirls
from lambda_core.model.machine_model import GROUND, LOCKED, PLACES, SHAFT, MachineModel
from lambda_core.solver.drivers.damping import damping_matrix
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.link_forces import SolvedLink
from lambda_core.solver.drivers.machine_statics import MachineState
from lambda_core.solver.drivers.structure import Rows, static_rows, structure

_ABOUT_X = 3  # row of a node that turns about the shaft
_COUNT = 16  # modes that are looked at
_LATERAL = 0.5  # of the motion squared, from which on a mode counts as bending, of a rigid shaft as lateral
_SHAKEN = 0.1  # of the motion squared across the axis: from here on unbalance shakes a mode of another kind too
_FELT = 0.01  # of the kinetic energy in the shaft: a mode with less belongs to the other bodies alone


@dataclass(frozen=True)
class Mode:
    """Mode of the turning shaft.

    It has a frequency [rad/s], a direction (+1 forward, -1 backward) and a shape of the shaft.
    """

    frequency: float
    direction: float
    kind: str  # bending (of a rigid shaft lateral), axial, torsion; body: of the other bodies alone
    damping: float = 0.0  # share of critical
    bodies_share: float = 0.0  # share of the kinetic energy in the other bodies
    lateral: float = 0.0  # share of the shaft's motion squared that is across its axis


def housed_stiffness(model: MachineModel, state: MachineState) -> FloatArray:
    """Return the stiffness of bearings with their housing.

    It acts on the shaft; the array has shape (bearings, 5, 5).

    What the others add through an elastic housing is left out: it stands in :func:`supported`.
    """
    return _of_each(_in_series(model, state))


def bearing_damping(model: MachineModel, equilibria: Sequence[Equilibrium]) -> FloatArray:
    """Return the vibration damping of each bearing.

    It holds at the shaft's speed; the array has shape (bearings, 6, 6).

    Zeros at rest, and where the balls of a bearing have no steady motion.

    Parameters
    ----------
    equilibria : sequence of Equilibrium
        Of the bearings, with the friction of their balls.
    """
    turns = model.speed != 0.0
    return np.array([
        damping_matrix(found, model.speed) if turns and found.converged else np.zeros((NODE, NODE))
        for found in equilibria
    ])  # fmt: skip


def housed_damping(model: MachineModel, state: MachineState, dampings: FloatArray) -> FloatArray:
    """Return the damping of bearings with their housing.

    It acts on the shaft; the array has shape (bearings, 6, 6).
    """
    found = dampings.copy()
    found[:, np.ix_(PLACES, PLACES)[0], np.ix_(PLACES, PLACES)[1]] = _of_each(
        _damping_in_series(model, state, dampings)
    )
    return found


def _of_each(matrix: FloatArray) -> FloatArray:
    """Return the blocks of the bearings, shape (bearings, 5, 5)."""
    size = len(PLACES)
    return np.array([matrix[i : i + size, i : i + size] for i in range(0, matrix.shape[0], size)])


def _damping_in_series(model: MachineModel, state: MachineState, dampings: FloatArray) -> FloatArray:
    """Return the shaft's damping at all bearings.

    The shape is (5 bearings, 5 bearings).
    """
    speed = abs(model.speed) or 1.0
    matrix = _joined(model, state, springs=False) + 1j * speed * _resisting(model, state, dampings, springs=False)
    return np.asarray(_seen_by_shaft(model, matrix).imag / speed)


def _in_series(model: MachineModel, state: MachineState) -> FloatArray:
    """Return the shaft's stiffness at all bearings.

    The shape is (5 bearings, 5 bearings).

    Rings and bodies behind the bearings follow without inertia.
    """
    return np.asarray(_seen_by_shaft(model, _joined(model, state, springs=False)))


def _joined(model: MachineModel, state: MachineState, *, springs: bool = True) -> FloatArray:
    """Return the stiffness of all connections.

    They join shaft, outer rings and bodies: bearings, seats, housing, holds and springs.
    """
    rows = static_rows(model)
    found = structure(model if springs else _without_springs_of_the_shaft(model), rows)[0]
    if model.housing is not None:
        own = slice(rows.rings, rows.bodies)
        found[own, own] += model.housing
    for i, k in enumerate(state.stiffness):
        reach = _inner_against_outer(model, rows, i)
        found += reach.T @ k @ reach
    for link in _links(state, springs=springs):
        found += link.stiffness
    if springs and model.hold is not None:
        kept, arm = _held(model, rows), model.bearings[0].model.geometry.width
        found[kept, kept] += np.where(kept % NODE < _ABOUT_X, LOCKED, LOCKED * arm**2)
    return found


def _held(model: MachineModel, rows: Rows) -> NDArray[np.intp]:
    """Return the shaft's rows that the ground holds."""
    if model.hold is None:
        return np.zeros(0, dtype=np.intp)
    return rows.node(model.hold.position) + np.array(PLACES)[list(model.hold.held)]


def _links(state: MachineState, *, springs: bool) -> list[SolvedLink]:
    """Return the connections by laws.

    Those of the shaft are included or left out.
    """
    return [link for link in state.links if springs or not link.is_on_shaft]


def _without_springs_of_the_shaft(model: MachineModel) -> MachineModel:
    return replace(model, springs=tuple(s for s in model.springs if SHAFT not in (s.place.body, s.to)))


def _resisting(model: MachineModel, state: MachineState, dampings: FloatArray, *, springs: bool = True) -> FloatArray:
    """Return the damping likewise."""
    rows = static_rows(model)
    found = structure(model if springs else _without_springs_of_the_shaft(model), rows)[1]
    if model.housing_damping is not None:
        own = slice(rows.rings, rows.bodies)
        found[own, own] += model.housing_damping
    for i, c in enumerate(dampings):
        reach = _inner_against_outer(model, rows, i)
        found += reach.T @ c[np.ix_(PLACES, PLACES)] @ reach
    for link in _links(state, springs=springs):
        found += link.damping
    return found


def _inner_against_outer(model: MachineModel, rows: Rows, index: int) -> FloatArray:
    """Return the relative motion of the rings.

    It is that of the inner against the outer ring, shape (5, rows).
    """
    size = len(PLACES)
    found: FloatArray = np.zeros((size, rows.size))
    found[range(size), rows.node(model.bearings[index].position) + np.array(PLACES)] = 1.0
    found[range(size), rows.rings + size * index + np.arange(size)] = -1.0
    return found


def _moving(model: MachineModel, rows: Rows) -> tuple[list[int], list[int]]:
    """Return the rows of parts that can move.

    They are outer rings and bodies.
    """
    rings: list[int] = []
    for i, bearing in enumerate(model.bearings):
        is_tied = model.housing is not None and bearing.carrier == GROUND
        own = rows.rings + len(PLACES) * i
        rings += [own + d for d, k in enumerate(bearing.seating.stiffness) if math.isfinite(k) or is_tied]
    holds = [k for body in model.bodies for k in body.hold]
    return rings, [rows.bodies + i for i, k in enumerate(holds) if math.isfinite(k)]


def _seen(matrix: Any, kept: Any, others: list[int]) -> Any:
    """Return the condensed stiffness at the rows `kept`.

    The other rows follow: K_kk - K_ko K_oo^-1 K_ok.
    """
    found = np.array(matrix[np.ix_(kept, kept)])
    others = [row for row in others if abs(matrix[row, row]) > 0.0]
    if others:  # a motion that nothing holds moves nothing: the shortest solution leaves it out
        inner = matrix[np.ix_(others, others)]
        found -= matrix[np.ix_(kept, others)] @ np.linalg.lstsq(inner, matrix[np.ix_(others, kept)], rcond=1e-13)[0]
    return found


def supported(model: MachineModel, state: MachineState) -> FloatArray:
    """Return the stiffness of the shaft on bearings.

    It covers the other bodies as far as they can move.

    Shape (rows of the shaft + free motions of bodies) squared; outer rings follow without inertia.
    """
    found = _seen_by_masses(model, _joined(model, state))
    size = model.body.stiffness.shape[0]
    found[:size, :size] += model.body.stiffness
    return np.asarray(0.5 * (found + found.T))


def _seen_by_masses(model: MachineModel, matrix: Any) -> Any:
    """Return the condensed stiffness at the masses.

    The masses are the shaft and the free motions of bodies; outer rings follow them.
    """
    rings, bodies = _moving(model, static_rows(model))
    return _seen(matrix, [*range(model.body.mass.shape[0]), *bodies], rings)


def _seen_by_shaft(model: MachineModel, matrix: Any) -> Any:
    """Return the condensed stiffness at the shaft's bearings.

    Outer rings and bodies follow.
    """
    rings, bodies = _moving(model, static_rows(model))
    kept = np.concatenate([model.body.rows(b.position).start + np.array(PLACES) for b in model.bearings])
    return _seen(matrix, kept, [*rings, *bodies])


def damped(model: MachineModel, state: MachineState, dampings: FloatArray) -> FloatArray:
    """Return the damping of bearings, springs and seats.

    The rows are those of :func:`supported`.
    """
    speed = abs(model.speed) or 1.0
    matrix = _joined(model, state) + 1j * speed * _resisting(model, state, dampings)
    found: FloatArray = _seen_by_masses(model, matrix).imag / speed
    for bearing, own in zip(model.bearings, dampings, strict=True):
        turning = model.body.rows(bearing.position).start + _ABOUT_X
        found[turning, turning] += own[_ABOUT_X, _ABOUT_X]
    return found


def masses(model: MachineModel) -> tuple[FloatArray, FloatArray]:
    """Return mass and gyroscopic matrix in the rows of :func:`supported`."""
    rows = static_rows(model)
    own = [m for body in model.bodies for m in (*[body.mass] * 3, body.polar_inertia, *[body.transverse_inertia] * 2)]
    bodies_share = np.diag([own[row - rows.bodies] for row in _moving(model, rows)[1]])
    shaft = with_discs(model.body, _rings(model)) if model.body.is_rigid else model.body
    return block_diag(shaft.mass, bodies_share), block_diag(shaft.gyroscopic, np.zeros_like(bodies_share))


def _rings(model: MachineModel) -> list[Disc]:
    """Return inner rings as discs.

    They are all the mass that a rigid shaft may have.
    """
    rings = [(bearing.position, bearing.model.inner_ring) for bearing in model.bearings]
    return [Disc(at, ring.mass, ring.transverse_inertia, ring.polar_inertia) for at, ring in rings]


def modes_at(model: MachineModel, stiffness: FloatArray, spin: float, damping: FloatArray | None = None) -> list[Mode]:
    """Return the lowest modes at a speed [rad/s].

    The bearings have `stiffness` and `damping`.
    """
    mass, gyroscopic = masses(model)
    nodes = model.body.positions.size
    held = _held(model, static_rows(model)).tolist()
    found = whirls(stiffness, mass, gyroscopic, spin, damping=damping, held=held, nodes=nodes, count=_COUNT)
    return [_mode(model, one, mass) for one in found]


def criticals(model: MachineModel, stiffness: FloatArray) -> list[Mode]:
    """Return the transverse critical speeds of the shaft.

    The speeds are in ascending order; the shaft bends, or swings together with its housing.
    """
    mass, gyroscopic = masses(model)
    held, nodes = _held(model, static_rows(model)).tolist(), model.body.positions.size
    found = critical_speeds(stiffness, mass, gyroscopic, held=held, nodes=nodes, count=_COUNT)
    return [mode for mode in (_mode(model, one, mass) for one in found) if mode.lateral > _SHAKEN]


def _mode(model: MachineModel, one: Whirl, mass: FloatArray) -> Mode:
    size = model.body.mass.shape[0]
    energy = np.real(np.conj(one.shape) * (mass @ one.shape))
    bodies_share = float(energy[size:].sum() / energy.sum())
    if bodies_share > 1.0 - _FELT:
        return Mode(one.frequency, one.direction, "body", one.damping, bodies_share)
    square = np.abs(one.shape[: NODE * model.body.positions.size].reshape(-1, NODE)) ** 2
    lateral, axial = square[:, 1:3].sum(), square[:, 0].sum()
    turning = square[:, 3].sum() * 1e-4  # at a radius of a centimetre
    share = float(lateral / (lateral + axial + turning))
    across = "lateral" if model.body.is_rigid else "bending"
    kind = across if share > _LATERAL else "axial" if axial > turning else "torsion"
    return Mode(one.frequency, one.direction, kind, one.damping, bodies_share, share)

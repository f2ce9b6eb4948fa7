"""Stiffness and damping of housed bearings, natural frequencies and critical speeds at the operating point."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import block_diag

from lambda_core.domain.arrays import FloatArray
from lambda_core.elastic.beam import NODE
from lambda_core.elastic.whirl import Whirl, critical_speeds, whirls
from lambda_core.shaft.model import PLACES, ShaftModel
from lambda_core.shaft.shaft_equilibrium import ShaftState
from lambda_core.solver.drivers.damping import damping_matrix
from lambda_core.solver.drivers.equilibrium import Equilibrium

_ABOUT_X = 3  # row of a node that turns about the shaft
_COUNT = 16  # modes that are looked at
_LATERAL = 0.5  # of the motion squared, from which on a mode counts as bending


@dataclass(frozen=True)
class Mode:
    """A mode of the turning shaft: frequency [rad/s], direction (+1 forward, -1 backward), what moves."""

    frequency: float
    direction: float
    kind: str  # bending, axial, torsion
    damping: float = 0.0  # share of critical


def housed_stiffness(model: ShaftModel, state: ShaftState) -> FloatArray:
    """Return the stiffness of each bearing with the housing behind it, on the shaft, shape (bearings, 5, 5).

    What the others add through an elastic housing is left out: it stands in :func:`supported`.
    """
    return _of_each(_in_series(model, state.stiffness))


def bearing_damping(model: ShaftModel, equilibria: Sequence[Equilibrium]) -> FloatArray:
    """Return the damping of each bearing for vibrations with the shaft's speed, shape (bearings, 6, 6).

    Zeros at rest, and where the balls of a bearing found no steady motion.

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


def housed_damping(model: ShaftModel, state: ShaftState, dampings: FloatArray) -> FloatArray:
    """Return the damping of each bearing with the housing behind it, on the shaft, shape (bearings, 6, 6)."""
    found = dampings.copy()
    found[:, np.ix_(PLACES, PLACES)[0], np.ix_(PLACES, PLACES)[1]] = _of_each(
        _damping_in_series(model, state, dampings)
    )
    return found


def _of_each(whole: FloatArray) -> FloatArray:
    """Return the blocks of the bearings, shape (bearings, 5, 5)."""
    size = len(PLACES)
    return np.array([whole[i : i + size, i : i + size] for i in range(0, whole.shape[0], size)])


def _damping_in_series(model: ShaftModel, state: ShaftState, dampings: FloatArray) -> FloatArray:
    """Return the damping that the shaft feels at all bearings together, shape (5 bearings, 5 bearings)."""
    speed = abs(model.speed) or 1.0
    inner = dampings[:, PLACES][:, :, PLACES]
    found: FloatArray = _in_series(model, state.stiffness + 1j * speed * inner).imag / speed
    return found


def _in_series(model: ShaftModel, each: Any) -> Any:
    """Return the stiffness that the shaft feels at all bearings together, shape (5 bearings, 5 bearings).

    In series: K - K (K + H)^-1 K over the degrees of freedom in which outer rings move, H of the housing. A dynamic
    stiffness K + i w C likewise.
    """
    k = np.asarray(block_diag(*each))
    springs = np.concatenate([bearing.seating.stiffness for bearing in model.bearings])
    housing = np.diag(np.where(np.isfinite(springs), springs, 0.0))
    if model.housing is not None:
        housing, springs = housing + model.housing, np.zeros_like(springs)
    moves = np.flatnonzero(np.isfinite(springs))
    if not moves.size:
        return k
    inner = (k + housing)[np.ix_(moves, moves)]
    return np.asarray(k - k[:, moves] @ np.linalg.solve(inner, k[moves]))


def supported(model: ShaftModel, state: ShaftState) -> FloatArray:
    """Return the stiffness of the shaft on its bearings, shape (6 n, 6 n)."""
    whole = model.body.stiffness.copy()
    k, rows = _in_series(model, state.stiffness), _rows(model)
    whole[np.ix_(rows, rows)] += 0.5 * (k + k.T)
    for spring in model.springs:
        own = model.body.rows(spring.position).start + np.array(PLACES)
        whole[own, own] += spring.stiffness
    return whole


def damped(model: ShaftModel, state: ShaftState, dampings: FloatArray) -> FloatArray:
    """Return the damping of the shaft by its bearings, shape (6 n, 6 n)."""
    found, rows = np.zeros_like(model.body.stiffness), _rows(model)
    found[np.ix_(rows, rows)] = _damping_in_series(model, state, dampings)
    for bearing, own in zip(model.bearings, dampings, strict=True):
        turning = model.body.rows(bearing.position).start + _ABOUT_X
        found[turning, turning] = own[_ABOUT_X, _ABOUT_X]
    for spring in model.springs:
        places = model.body.rows(spring.position).start + np.array(PLACES)
        found[places, places] += spring.damping
    return found


def _rows(model: ShaftModel) -> Any:
    """Return the rows of the shaft that bearings hold."""
    return np.concatenate([model.body.rows(b.position).start + np.array(PLACES) for b in model.bearings])


def modes_at(model: ShaftModel, stiffness: FloatArray, spin: float, damping: FloatArray | None = None) -> list[Mode]:
    """Return the lowest modes at a speed [rad/s], bearings as stiff as `stiffness` has them, damped as `damping`."""
    body = model.body
    found = whirls(
        stiffness, body.mass, body.gyroscopic, spin, damping=damping, nodes=body.positions.size, count=_COUNT
    )
    return [_mode(one) for one in found]


def criticals(model: ShaftModel, stiffness: FloatArray) -> list[Mode]:
    """Return the critical speeds of bending, rising."""
    body = model.body
    found = critical_speeds(stiffness, body.mass, body.gyroscopic, nodes=body.positions.size, count=_COUNT)
    return [mode for mode in map(_mode, found) if mode.kind == "bending"]


def _mode(one: Whirl) -> Mode:
    square = np.abs(one.shape.reshape(-1, NODE)) ** 2
    lateral, axial = square[:, 1:3].sum(), square[:, 0].sum()
    turning = square[:, 3].sum() * 1e-4  # at a radius of a centimetre
    kind = "bending" if lateral > _LATERAL * (lateral + axial + turning) else "axial" if axial > turning else "torsion"
    return Mode(one.frequency, one.direction, kind, one.damping)

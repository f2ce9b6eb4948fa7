"""Natural frequencies, whirl over speed and critical speeds of a shaft on its bearings at the operating point."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag

from lambda_core.domain.arrays import FloatArray
from lambda_core.elastic.beam import NODE
from lambda_core.elastic.whirl import Whirl, critical_speeds, whirls
from lambda_core.shaft.model import PLACES, ShaftModel
from lambda_core.shaft.shaft_equilibrium import ShaftState

_COUNT = 16  # modes that are looked at
_LATERAL = 0.5  # of the motion squared, from which on a mode counts as bending


@dataclass(frozen=True)
class Mode:
    """A mode of the turning shaft: frequency [rad/s], direction (+1 forward, -1 backward), what moves."""

    frequency: float
    direction: float
    kind: str  # bending, axial, torsion


def housed_stiffness(model: ShaftModel, state: ShaftState) -> FloatArray:
    """Return the stiffness of each bearing with the housing behind it, on the shaft, shape (bearings, 5, 5).

    What the others add through an elastic housing is left out: it stands in :func:`supported`.
    """
    whole, size = _in_series(model, state), len(PLACES)
    return np.array([whole[size * i : size * (i + 1), size * i : size * (i + 1)] for i in range(len(model.bearings))])


def _in_series(model: ShaftModel, state: ShaftState) -> FloatArray:
    """Return the stiffness that the shaft feels at all bearings together, shape (5 bearings, 5 bearings).

    In series: K - K (K + H)^-1 K over the degrees of freedom in which outer rings move, H of the housing.
    """
    k = np.asarray(block_diag(*state.stiffness))
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
    k = _in_series(model, state)
    rows = np.concatenate([model.body.rows(b.position).start + np.array(PLACES) for b in model.bearings])
    whole[np.ix_(rows, rows)] += 0.5 * (k + k.T)
    return whole


def modes_at(model: ShaftModel, stiffness: FloatArray, spin: float) -> list[Mode]:
    """Return the lowest modes at a speed [rad/s], bearings as stiff as `stiffness` has them."""
    body = model.body
    found = whirls(stiffness, body.mass, body.gyroscopic, spin, nodes=body.positions.size, count=_COUNT)
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
    return Mode(one.frequency, one.direction, kind)

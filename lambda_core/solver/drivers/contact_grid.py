"""Divide a contact ellipse into cells."""

from __future__ import annotations

from functools import cache

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.solver.arrays.bundle import CELL_ROWS, GUARD, Grid
from lambda_core.solver.records import BATCH, SWEEPS

_VECTOR = 16  # cells that vectorised loops take at once
_LINE = 8  # numbers in a line of the processor's cache
_FEW = 512  # cells whose rows a processor keeps at hand


def contacts_at_once(cells: int) -> int:
    """Return the contacts per call of laws.

    Each contact has so many cells.
    """
    return max(SWEEPS, min(BATCH, _FEW // cells))


def cell_block(cells: int, contacts: int) -> FloatArray:
    """Return memory for contacts with cells.

    The memory is layout.Bundle.cells.

    Rows begin with a line of the cache: a vector that lies across two lines is read and written twice.
    """
    shape = CELL_ROWS, contacts * cells + GUARD
    room = np.zeros(shape[0] * shape[1] + _LINE)
    first = -(room.ctypes.data // room.itemsize) % _LINE
    return room[first : first + room.size - _LINE].reshape(shape)


def unit_grid(strips: int, rows: int) -> FloatArray:
    """Divide the unit ellipse into strips and rows.

    Weights carry area and load exactly. Each call returns an array of its own.

    Returns
    -------
    float64[:, :], shape (6, strips * rows rounded up to full vectors)
        Rows of layout.Grid. sum(area) = pi and sum(area * pressure) = 2 pi/3, the Hertzian load over
        a b p_max.
    """
    return _unit_grid(strips, rows).copy()


@cache
def _unit_grid(strips: int, rows: int) -> FloatArray:
    edges = np.linspace(-1.0, 1.0, strips + 1)
    mid = 0.5 * (edges[1:] + edges[:-1])
    area, load = np.diff(_disc_area(edges)), np.diff(0.5 * np.pi * (edges - edges**3 / 3.0))
    half = np.sqrt(1.0 - mid * mid)
    row_edges = np.linspace(-1.0, 1.0, rows + 1)
    row_mid = 0.5 * (row_edges[1:] + row_edges[:-1])
    row_load = np.diff(_disc_area(row_edges)) / np.pi
    shape = (strips, rows)
    per_area = np.repeat(area[:, None] / rows, rows, 1)
    grid = np.array(
        [
            np.repeat(mid[:, None], rows, 1).ravel(),
            (half[:, None] * row_mid[None, :]).ravel(),
            (load[:, None] * row_load[None, :] / per_area).ravel(),
            per_area.ravel(),
            np.full(shape, 2.0 / strips).ravel(),
            np.repeat(half[:, None] * 2.0 / rows, rows, 1).ravel(),
        ]
    )
    # Loops over cells run in vectors: filled up with copies of the last cell that have no area.
    filling = np.repeat(grid[:, -1:], -grid.shape[1] % _VECTOR, axis=1)
    filling[Grid._fields.index("area")] = 0.0
    return np.concatenate([grid, filling], axis=1)


def _disc_area(x: FloatArray) -> FloatArray:
    """Return the unit disc's area left of x.

    It is exact up to a constant.
    """
    return x * np.sqrt(np.maximum(1.0 - x * x, 0.0)) + np.arcsin(x)

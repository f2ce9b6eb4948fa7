"""Compute natural frequencies and reduce elastic bodies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import eig, eigh

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.formulas.elastic.body import ElasticBody


@one_blas_thread()
def natural_frequencies(
    stiffness: FloatArray, mass: FloatArray, held: Sequence[int] = (), count: int | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return natural angular frequencies [rad/s] and modes.

    The frequencies ascend; the modes have unit modal mass.

    Parameters
    ----------
    stiffness, mass : float64[:, :], shape (n, n)
    held : sequence of int
        Rows that do not move.
    count : int, optional
        How many, the lowest; default: all.

    Returns
    -------
    float64[:], shape (count,)
    float64[:, :], shape (n, count)
    """
    rows = np.setdiff1d(np.arange(mass.shape[0]), np.asarray(held, dtype=int))
    last = rows.size if count is None else min(count, rows.size)
    square, found = eigh(stiffness[np.ix_(rows, rows)], mass[np.ix_(rows, rows)], subset_by_index=(0, last - 1))
    modes = np.zeros((mass.shape[0], last))
    modes[rows] = found
    return np.sqrt(np.maximum(square, 0.0)), modes


@dataclass(frozen=True)
class Whirl:
    """One mode of a turning shaft.

    Attributes
    ----------
    frequency : float
        Natural angular frequency, damped [rad/s].
    damping : float
        Share of critical damping.
    direction : float
        +1 where the orbit turns with the spin everywhere, -1 against it; in between: how much of it (0 for motion in a
        line, along the axis, or about it).
    shape : complex128[:], shape (n,)
    """

    frequency: float
    damping: float
    direction: float
    shape: np.ndarray


@one_blas_thread()
def whirls(
    stiffness: FloatArray,
    mass: FloatArray,
    gyroscopic: FloatArray,
    spin: float,
    *,
    damping: FloatArray | None = None,
    held: Sequence[int] = (),
    nodes: int,
    count: int = 8,
) -> list[Whirl]:
    """Return the modes of a turning shaft.

    They solve M q'' + (C + spin G) q' + K q = 0.

    Nelson 1980, J. Mech. Des. 102, 793.

    Parameters
    ----------
    stiffness, mass, gyroscopic : float64[:, :], shape (n, n)
    spin : float
        [rad/s]
    damping : float64[:, :], optional
        Of bearings [N s/m, N m s/rad].
    held : sequence of int
        Rows that do not move.
    nodes : int
        How many nodes of six coordinates the first rows are.
    count : int
        How many, the lowest.
    """
    n = mass.shape[0]
    rates = spin * gyroscopic + (0.0 if damping is None else damping)
    # Without damping and slow next to the rest: the lowest modes at rest span those of the turning shaft.
    _, basis = natural_frequencies(stiffness, mass, held, min(n, max(6 * count, 48)))
    k, c = basis.T @ stiffness @ basis, basis.T @ rates @ basis
    size = k.shape[0]
    system = np.block([[np.zeros((size, size)), np.eye(size)], [-k, -c]])
    roots, vectors = eig(system)
    found = []
    for root, vector in zip(roots, vectors.T, strict=True):
        if root.imag <= 1e-6 * math.sqrt(abs(k[-1, -1])):
            continue
        shape = basis @ vector[:size]
        found.append(Whirl(float(root.imag), float(-root.real / abs(root)), _direction(shape, nodes, spin), shape))
    return sorted(found, key=lambda one: one.frequency)[:count]


@one_blas_thread()
def critical_speeds(
    stiffness: FloatArray,
    mass: FloatArray,
    gyroscopic: FloatArray,
    *,
    held: Sequence[int] = (),
    nodes: int,
    count: int = 8,
) -> list[Whirl]:
    """Return the critical speeds of a shaft.

    It whirls as fast as it turns: K q = spin^2 (M - i G) q.

    Stiffness is that of one speed. Forward ones (direction +1) answer to unbalance.

    Parameters
    ----------
    stiffness, mass, gyroscopic : float64[:, :], shape (n, n)
    held : sequence of int
        Rows that do not move.
    nodes : int
        How many nodes of six coordinates the first rows are.
    count : int
        How many, the lowest.
    """
    _, basis = natural_frequencies(stiffness, mass, held, min(mass.shape[0], max(6 * count, 48)))
    k = basis.T @ stiffness @ basis
    squares, vectors = eig(k, np.eye(k.shape[0]) - 1j * (basis.T @ gyroscopic @ basis))
    least = 1e-12 * abs(k[-1, -1])
    found = []
    for square, vector in zip(squares, vectors.T, strict=True):
        if square.real > least and abs(square.imag) < 1e-6 * square.real:
            shape = basis @ vector
            found.append(Whirl(math.sqrt(square.real), 0.0, _direction(shape, nodes, 1.0), shape))
    return sorted(found, key=lambda one: one.frequency)[:count]


def _direction(shape: np.ndarray, nodes: int, spin: float) -> float:
    """Return the whirl direction of a motion.

    It tells how far exp(i w t) circles with the spin: areas of the nodes' orbits over their squares.
    """
    y, z = shape[1 : 6 * nodes : 6], shape[2 : 6 * nodes : 6]
    square = float(np.sum(np.abs(y) ** 2 + np.abs(z) ** 2))
    total = square + float(np.sum(np.abs(shape[0 : 6 * nodes : 6]) ** 2))
    if square <= 1e-9 * total:
        return 0.0
    turn = 2.0 * float(np.sum((y * np.conj(z)).imag)) / square
    return turn if spin >= 0.0 else -turn


def craig_bampton(body: ElasticBody, kept: Sequence[float], modes: int) -> ElasticBody:
    """Return the body reduced by Craig and Bampton.

    It has the nodes at `kept` [m] and the lowest modes of it clamped there (Craig and Bampton 1968).

    AIAA J. 6, 1313. Static deflections under loads at the kept nodes are exact.

    Parameters
    ----------
    body : ElasticBody
        With nodes at these places.
    kept : sequence of float
        Places of the nodes that stay [m].
    modes : int
        Number of clamped modes that come behind them.
    """
    size = body.mass.shape[0]
    outer = np.concatenate([np.arange(size)[body.rows(place)] for place in kept])
    inner = np.setdiff1d(np.arange(size), outer)
    basis = np.zeros((size, outer.size + modes))
    basis[outer, np.arange(outer.size)] = 1.0
    k = body.stiffness
    basis[inner, : outer.size] = -np.linalg.solve(k[np.ix_(inner, inner)], k[np.ix_(inner, outer)])
    if modes:
        basis[:, outer.size :] = natural_frequencies(k, body.mass, outer.tolist(), modes)[1]
    stiffness, mass, gyroscopic = (basis.T @ matrix @ basis for matrix in (k, body.mass, body.gyroscopic))
    return ElasticBody(np.array(kept, dtype=float), stiffness, mass, gyroscopic)

"""Distribute the load over the slices of a roller.

Shapes: `drop` and positions have one value per slice, (n,); approach and tilt may be arrays of rollers, (...); loads
are (..., n). The approach counts at the roller's middle; slice k has approach - x_k tan(tilt) - drop_k. The moment is
-sum(x_k q_k): positive for a positive tilt, which it opposes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.line_contact import EVEN_WIDTH, half_width, iso_approach, iso_load

SLICES = 32  # of a line contact in motion: two of the widest vectors of a processor
_SWEEPS = 100  # sweeps of widths and active slices; 10 to 20 are usual
_SETTLED = 1e-12  # change of the loads over the roller's largest that ends them
_NARROWEST = 1e-3  # least half width over the roller's widest: a slice about to open has a finite compliance


@dataclass(frozen=True)
class SliceLoads:
    """Loads of the slices of one or many rollers."""

    loads: FloatArray  # of each slice [N], (..., n)
    load: FloatArray  # of the roller [N], (...)
    moment: FloatArray  # that opposes a positive tilt [N m], (...)


@dataclass(frozen=True)
class Elastic:
    """Contact data for the deflection matrix.

    These contacts carry the same slice loads.

    Attributes
    ----------
    radii : sequence of float or array
        Reduced radius of each contact in series [m]: one raceway, or inner and outer; of tapered rollers one value per
        slice, (n,).
    e_eff : float
        Reduced modulus E' [Pa].
    images : float
        Weight of the load's mirror images beyond both end faces, one per end. A half space is too stiff at the ends,
        where material is missing; images remove the shear stress of the end faces (Hetenyi 1970, as used by de Mul,
        Kalker and Fredriksson 1986, J. Tribol. 108, 140, and by Teutsch 2005). 1 where both bodies end with the
        contact, 1/2 where the roller ends and the raceway goes on (each body has half of the compliance), 0 for half
        spaces. Images raise the approach: 14.7, 15.8, 16.8 um with 0, 1/2, 1 for a roller of 11 by 12 mm, 2 kN and
        the profile of ISO 16281, whose laminae give 14.1 um.
    """

    radii: Sequence[float | FloatArray]
    e_eff: float
    images: float = 1.0


def slice_positions(length: float, count: int) -> FloatArray:
    """Return the middles of `count` equal slices [m].

    They are along the roller, x_k = L ((k - 1/2)/n - 1/2), shape (n,).
    """
    return length * ((np.arange(count) + 0.5) / count - 0.5)


def lamina_loads(approach: FloatArray | float, tilt: FloatArray | float, drop: FloatArray, length: float) -> SliceLoads:
    """Load independent laminae (ISO 16281:2025).

    Each carries q_k = (c_L/n_s) max(delta - x_k tan(psi) - P_k, 0)^(10/9), with inner and outer contact together.

    Parameters
    ----------
    approach : array or float
        Approach delta of the two raceways at the middle [m], (...).
    tilt : array or float
        Angle psi between the two raceways [rad], (...).
    drop : array
        Sum of the profiles of both contacts [m], (n,): twice the roller's own. The standard asks for n >= 30.
    length : float
        Effective length L_we [m].
    """
    positions = slice_positions(length, len(drop))
    return _summed(iso_load(_closed(approach, tilt, drop, positions), length) / len(drop), positions)


def elastic_loads(
    approach: FloatArray | float, tilt: FloatArray | float, drop: FloatArray, length: float, elastic: Elastic
) -> SliceLoads:
    """Load slices that share one deflection matrix.

    q >= 0 with sum_l C_kl q_l = delta_k where the slice carries and >= delta_k where it is open. C_kl is the deflection
    of slice k by a strip of slice l (:func:`deflection_matrix`), whose half width follows from q_l. An active-set
    iteration finds open slices and widths together, for all rollers at once.

    Parameters
    ----------
    approach, tilt, drop, length
        As for :func:`lamina_loads`; `drop` is the sum over the contacts in series.
    elastic : Elastic
        The contacts.

    Raises
    ------
    ArithmeticError
        If the iteration does not settle.
    """
    positions = slice_positions(length, len(drop))
    closed = _closed(approach, tilt, drop, positions)
    shape = closed.shape
    wanted = closed.reshape(-1, shape[-1])
    loads = iso_load(wanted, length) / len(drop)
    active = wanted > 0.0
    for _ in range(_SWEEPS):
        matrix = deflection_matrix(loads, positions, elastic)
        found = _solve(matrix, wanted, active)
        pressed = np.where(active, found > 0.0, wanted > np.einsum("rkl,rl->rk", matrix, found))
        moved = np.abs(found - loads) > _SETTLED * np.max(found, axis=-1, keepdims=True)
        settled = np.array_equal(pressed, active) and not np.any(moved)
        active, loads = pressed, np.maximum(found, 0.0)
        if settled:
            return _summed(loads.reshape(shape), positions)
    raise ArithmeticError(f"slice loads did not settle in {_SWEEPS} sweeps: use fewer slices")


def deflection_matrix(loads: FloatArray, positions: FloatArray, elastic: Elastic) -> FloatArray:
    """Return the deflection matrix of the slices [m/N].

    Slice k per load on slice l, (rollers, n, n).

    Love 1929, Phil. Trans. R. Soc. A 228, 377 (Johnson 1985, eq. 3.25): an even pressure on a rectangle 2a by 2h
    deflects the half space on its axis at the distance y by
    u = (2/(pi E')) p 2 [G(y + h) - G(y - h)], G(y) = a asinh(y/a) + y asinh(a/y). With a = 0.824 b the strip deflects
    its middle as Hertz's pressure of half width b does.

    Parameters
    ----------
    loads : array
        Loads of the last sweep [N], (rollers, n), from which the half widths follow.
    positions : array
        Middles of the slices [m], (n,).
    elastic : Elastic
        The contacts.
    """
    width = float(positions[1] - positions[0])
    length = width * len(positions)
    sources = [(positions, 1.0), (-length - positions, elastic.images), (length - positions, elastic.images)]
    matrix: FloatArray = np.zeros((len(loads), len(positions), len(positions)))
    for radius in elastic.radii:
        across = EVEN_WIDTH * half_width(loads / width, radius, elastic.e_eff)
        widest = np.max(across, axis=-1, keepdims=True)
        across = np.maximum(across, _NARROWEST * np.where(widest > 0.0, widest, width))[:, None, :]
        for middles, weight in sources:
            distance = (positions[:, None] - middles[None, :])[None, :, :]
            strip = _strip(distance + 0.5 * width, across) - _strip(distance - 0.5 * width, across)
            matrix = matrix + weight * strip / (math.pi * elastic.e_eff * across * 0.5 * width)
    return matrix


def approach_at_load(
    load: float, tilt: float, drop: FloatArray, length: float, elastic: Elastic | None = None
) -> float:
    """Return the approach of a loaded roller [m].

    A tilted roller carries `load` [N] at it.

    Laminae without `elastic`, else slices with the deflection matrix.
    """
    low = float(np.min(drop + slice_positions(length, len(drop)) * math.tan(tilt)))
    high = low + float(iso_approach(load, length))

    def surplus(approach: float) -> float:
        found = slice_loads(approach, tilt, drop, length, elastic)
        return float(found.load) - load

    while surplus(high) < 0.0:
        high += high - low
    from scipy.optimize import brentq  # loaded where rollers are computed

    return float(brentq(surplus, low, high, xtol=1e-15, rtol=1e-13))


def slice_loads(
    approach: FloatArray | float,
    tilt: FloatArray | float,
    drop: FloatArray,
    length: float,
    elastic: Elastic | None = None,
) -> SliceLoads:
    """Load laminae or coupled slices.

    Slices have a deflection matrix where `elastic` is given.
    """
    if elastic is None:
        return lamina_loads(approach, tilt, drop, length)
    return elastic_loads(approach, tilt, drop, length, elastic)


def _closed(
    approach: FloatArray | float, tilt: FloatArray | float, drop: FloatArray, positions: FloatArray
) -> FloatArray:
    """Return the approach of every slice [m], (..., n)."""
    found: FloatArray = np.asarray(approach)[..., None] - np.tan(tilt)[..., None] * positions - drop
    return found


def _summed(loads: FloatArray, positions: FloatArray) -> SliceLoads:
    return SliceLoads(loads, np.asarray(loads.sum(axis=-1)), np.asarray(-(loads @ positions)))


def _solve(matrix: FloatArray, wanted: FloatArray, active: NDArray[np.bool_]) -> FloatArray:
    """Return the loads of the active slices [N].

    An open slice has the equation q = 0.
    """
    both = active[:, :, None] & active[:, None, :]
    scale = matrix.max()
    masked = np.where(both, matrix, 0.0) + np.where(active, 0.0, scale)[:, :, None] * np.eye(matrix.shape[-1])
    solved = np.linalg.solve(masked, np.where(active, wanted, 0.0)[..., None])
    return np.asarray(solved[..., 0], dtype=np.float64)


def _strip(distance: FloatArray, across: FloatArray) -> FloatArray:
    """Return the strip's function G(y).

    It is a asinh(y/a) + y asinh(a/y), odd in y.
    """
    nonzero = np.where(distance == 0.0, 1.0, distance)
    found: FloatArray = across * np.arcsinh(distance / across) + distance * np.arcsinh(across / np.abs(nonzero))
    return found

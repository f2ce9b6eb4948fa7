"""Fit the constants in an image over case options.

The curves pass through values of the case's own set-up.

A constant is a number that the set-up of a model works out in Python: viscosity of the oil, radius of a groove,
parameter of a law. Each is sampled over every option that is to vary, at the points of Chebyshev, where the polynomial
through them comes as near to a smooth function as rounding allows (Trefethen, *Approximation Theory and Approximation
Practice*, 2013, ch. 5 and 8); the frame of the contacts stays that of the case. Several options act together as sums of
their changes or as products of their ratios, whichever a constant follows; both are checked between the points.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.export.fmu.varied import Varied

_ORDERS = (8, 16, 32)  # of polynomials, tried in turn
_EXACT = 1e-8  # deviation that a curve may have, over the largest value of the constant
_TOGETHER = 1e-6  # and several of them together
_BETWEEN = (0.031, 0.27, 0.55, 0.83, 0.972)  # where curves are checked, of the way from the lowest to the highest
_CORNERS = 4  # points at which all options vary at once
_A_COUNT = 1e-300  # a number below this is a count, read as a float


@dataclass(frozen=True)
class Curve:
    """One constant over one option.

    Attributes
    ----------
    option : int
        Which one varies.
    values : float64[:]
        At the points of Chebyshev from the highest to the lowest.
    """

    option: int
    values: FloatArray


@dataclass(frozen=True)
class Constant:
    """A number of the image that follows options.

    Attributes
    ----------
    word : int
        Which one of those that were sampled.
    base : float
        In the case as it is.
    scales : bool
        Whether several options act by their ratios (a product), not by their differences (a sum).
    curves : tuple of Curve
    """

    word: int
    base: float
    scales: bool
    curves: tuple[Curve, ...]


def points(lowest: float, highest: float, order: int) -> FloatArray:
    """Return the points of Chebyshev.

    They go from the highest to the lowest.
    """
    unit = np.cos(np.pi * np.arange(order + 1) / order)
    found: FloatArray = 0.5 * (lowest + highest) + 0.5 * (highest - lowest) * unit
    found[[0, -1]] = highest, lowest
    return found


def between(at: float, where: FloatArray, values: FloatArray) -> FloatArray:
    """Return the polynomial through values at a place.

    Values of shape (points, ...), barycentric formula of the second kind.
    """
    far = at - where
    if (far == 0.0).any():
        on: FloatArray = values[far == 0.0][0]
        return on
    weight = np.where(np.arange(far.size) % 2, -1.0, 1.0)
    weight[[0, -1]] *= 0.5
    weight = weight / far
    found: FloatArray = np.tensordot(weight, values, 1) / weight.sum()
    return found


def constants(
    options: Sequence[Varied], base: FloatArray, sample: Callable[[Mapping[str, float]], FloatArray]
) -> list[Constant]:
    """Return every constant that follows options.

    Parameters
    ----------
    base : float64[:]
        All constants of the case as it is.
    sample : function
        The same for other values of the options.

    Raises
    ------
    UsageError
        When an option changes nothing, more than numbers, or in a way that no curve follows.
    """
    curves = [_curves(option, base, sample) for option in options]
    words = np.flatnonzero(np.any([(each != base).any(axis=0) for each in curves], axis=0))
    several = len(options) > 1
    scaled = _scaled(options, base, curves, sample) if several else np.zeros(base.size, dtype=bool)
    return [
        Constant(
            int(w),
            float(base[w]),
            bool(scaled[w]),
            tuple(Curve(k, each[:, w].copy()) for k, each in enumerate(curves) if (each[:, w] != base[w]).any()),
        )
        for w in words
    ]


def _curves(option: Varied, base: FloatArray, sample: Callable[[Mapping[str, float]], FloatArray]) -> FloatArray:
    """Return the values of all constants.

    They hold at the points of one option.
    """
    known: dict[float, FloatArray] = {}

    def at(value: float) -> FloatArray:
        if value not in known:
            known[value] = _checked(option, base, sample({option.path: value}))
        return known[value]

    span = option.highest - option.lowest
    for order in _ORDERS:
        where = points(option.lowest, option.highest, order)
        values = np.array([at(float(value)) for value in where])
        size = np.abs(values).max(axis=0)
        off = [np.abs(between(x, where, values) - at(x)) for x in (option.lowest + s * span for s in _BETWEEN)]
        if np.all((np.max(off, axis=0) <= _EXACT * size) | _counts(base)):
            break
    else:
        raise UsageError(
            f"{option.path} acts with a jump or a bend between {option.lowest:g} and {option.highest:g} {option.unit}: "
            "narrow its range"
        )
    if (values == base).all():
        raise UsageError(f"`{option.path}` has no effect on this bearing")
    return values


def _checked(option: Varied, base: FloatArray, found: FloatArray) -> FloatArray:
    """Return a checked sample.

    It must have the same counts as the base.
    """
    if found.size == base.size:
        counts = _counts(base) | _counts(found)
        if (found[counts] == base[counts]).all() and np.isfinite(found).all():
            return found
    raise UsageError(f"`{option.path}` selects a model and cannot be varied")


def _counts(values: FloatArray) -> NDArray[np.bool_]:
    found: NDArray[np.bool_] = (values != 0.0) & (np.abs(values) < _A_COUNT)
    return found


def _scaled(
    options: Sequence[Varied],
    base: FloatArray,
    curves: Sequence[FloatArray],
    sample: Callable[[Mapping[str, float]], FloatArray],
) -> NDArray[np.bool_]:
    """Tell which constants options act on by their ratios."""
    with np.errstate(divide="ignore", invalid="ignore"):
        sums, products, size = np.zeros(base.size), np.zeros(base.size), np.abs(base)
        for corner in range(_CORNERS):
            values = {
                option.path: option.lowest + _share(corner, k) * (option.highest - option.lowest)
                for k, option in enumerate(options)
            }
            found, total, product = sample(values), base.copy(), base.copy()
            for option, each in zip(options, curves, strict=True):
                where = points(option.lowest, option.highest, len(each) - 1)
                alone = between(values[option.path], where, each)
                total += alone - base
                product *= np.where(base == 0.0, np.nan, alone / base)
            sums, products = np.maximum(sums, np.abs(total - found)), np.fmax(products, np.abs(product - found))
            size = np.maximum(size, np.abs(found))
        products[base == 0.0] = math.inf
        off = (np.minimum(sums, products) > _TOGETHER * size) & ~_counts(base)
    if off.any():
        names = [o.path for o, each in zip(options, curves, strict=True) if (each[:, off] != base[off]).any()]
        raise UsageError(f"{' and '.join(names)} act together in a way that is not known: vary one of them")
    chosen: NDArray[np.bool_] = products < sums
    return chosen


def _share(corner: int, option: int) -> float:
    """Return places that lie in no row.

    They are fractional parts of multiples of irrational numbers (Weyl).
    """
    return math.modf((corner + 1) * math.sqrt(2.0 + option * 1.7))[0]

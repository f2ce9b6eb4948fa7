"""Find arguments at which a kernel changes its path.

The numbers in the kernel's own code show them.

Draws from the range of a ball bearing rarely meet a branch like ``if 1.2e9 < p[i] < 1.2005e9``. The numbers that
decide it stand in the code, so a kernel is tried at them, near them and between each two.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise
from types import CodeType
from typing import Any

import numpy as np
from numpy.random import Generator

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.role import Role
from lambda_core.laws.probe import RANGES, VECTORS, draw

_MOST = {"f": 64, "a": 512}  # values of one argument; of an array several go into one call
_SCALED = 12  # numbers that are combined in pairs: a kernel may compare p[i]*1e-9
_BESIDE = 1e-6  # relative distance on either side of a number
_CELLS = 8
_STRIPS, _LONGEST = 31, 128  # cells of a contact by default; most that a number in the code is taken for
_REPEATED = 2  # calls for each value, with other draws of the rest


def numbers_of(codes: Iterable[CodeType], par: FloatArray) -> list[float]:
    """Return the numbers in a kernel's code.

    The numbers of its helpers and its parameters count, too.
    """
    found: dict[float, None] = {}
    for code in codes:
        for constant in _flat(code.co_consts):
            found[abs(constant)] = None
    for value in par.tolist():
        found[abs(value)] = None
    return [value for value in found if 0.0 < value < math.inf]


def trials_at_thresholds(
    role: Role, codes: Iterable[CodeType], par: FloatArray, generator: Generator, states: int = 0
) -> Iterator[list[Any]]:
    """Yield arguments at the numbers of the code.

    One of them is at a number of the kernel, the others as they are drawn.
    """
    numbers = numbers_of(codes, par)
    if role.elementwise:
        counts = {int(n) + more for n in numbers if n.is_integer() and 2.0 <= n <= _LONGEST for more in (0, 1)}
        for cells in sorted({_STRIPS, *counts}):
            yield draw(role, par, cells, generator, states)
    for place, argument in enumerate(role.arguments):
        if argument.output or argument.name == "par":
            continue
        bounds = RANGES[argument.name]
        values = _values(numbers, bounds.low, bounds.high, _MOST[argument.kind])
        width = 3 if argument.name in VECTORS else _CELLS
        for part in range(0, len(values), width if argument.kind == "a" else 1):
            for _ in range(_REPEATED):
                drawn = draw(role, par, _CELLS, generator, states)
                if argument.kind == "a":
                    drawn[place] = np.resize(np.array(values[part : part + width]), drawn[place].size)
                else:
                    drawn[place] = np.float64(values[part])
                yield drawn


def _flat(constants: Iterable[Any]) -> Iterator[float]:
    for each in constants:
        if isinstance(each, tuple | frozenset):
            yield from _flat(each)
        elif isinstance(each, int | float) and not isinstance(each, bool) and math.isfinite(each):
            yield float(each)


def _values(numbers: list[float], low: float, high: float, most: int) -> list[float]:
    """Return the numbers within a range.

    Their neighbours on either side and the middle between each two are added.
    """
    few = numbers[:_SCALED]
    scaled = [a * b for a in few for b in few] + [a / b for a in few for b in few]
    known = sorted({v for n in (*numbers, *scaled) for v in (n, -n) if low <= v <= high})
    plain = [v for v in known if abs(v) in numbers]
    for some in (known, plain):  # with the scaled ones where there is room
        values = {v for n in some for v in (n, n * (1.0 - _BESIDE), n * (1.0 + _BESIDE)) if low <= v <= high}
        values |= {0.5 * (one + other) for one, other in pairwise(some)}
        if len(values) <= most:
            return sorted(values)
    return sorted(values)[:: math.ceil(len(values) / most)]

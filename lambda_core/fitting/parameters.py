"""Define parameters of a fit.

A parameter has a start, bounds and what is known before the measurements.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from lambda_core.domain.arrays import FloatArray

_OF_RANGE = math.sqrt(12.0)  # range over standard deviation of a uniform distribution


@dataclass(frozen=True)
class Parameter:
    """One parameter that a fit varies.

    Attributes
    ----------
    name : str
        What it is called in tables.
    start : float
        Value before the fit; a parameter that the data do not determine keeps it.
    low, high : float
        Bounds; infinite where there are none.
    spread : float
        Standard deviation of what is known beforehand. Without it that of a uniform distribution between the bounds,
        or the start value where a bound is missing.
    is_prior : bool
        Whether `start` and `spread` count as one more observation of the parameter.
    """

    name: str
    start: float
    low: float = -math.inf
    high: float = math.inf
    spread: float = field(default=math.nan)
    is_prior: bool = False

    def __post_init__(self) -> None:
        if not self.low <= self.start <= self.high:
            raise ValueError(f"{self.name}: the start {self.start:g} must lie between {self.low:g} and {self.high:g}")
        if math.isnan(self.spread):
            width = self.high - self.low
            known = width / _OF_RANGE if math.isfinite(width) else abs(self.start) or 1.0
            object.__setattr__(self, "spread", known)
        if not self.spread > 0.0:
            raise ValueError(f"{self.name}: the two bounds are equal; widen them or leave the parameter out")


def starts(parameters: Sequence[Parameter]) -> FloatArray:
    """Return the start values."""
    return np.array([parameter.start for parameter in parameters], dtype=np.float64)


def spreads(parameters: Sequence[Parameter]) -> FloatArray:
    """Return the standard deviations before the fit."""
    return np.array([parameter.spread for parameter in parameters], dtype=np.float64)


def bounds(parameters: Sequence[Parameter]) -> tuple[FloatArray, FloatArray]:
    """Return lower and upper bounds."""
    low = np.array([parameter.low for parameter in parameters], dtype=np.float64)
    high = np.array([parameter.high for parameter in parameters], dtype=np.float64)
    return low, high

"""Score bands by what was measured, and round numbers to their band."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray

COVERAGE = 0.9  # of a model band


def interval_score(low: FloatArray, high: FloatArray, measured: FloatArray, coverage: float = COVERAGE) -> FloatArray:
    """Return the interval score of each band: its width, more for each measured value outside; small is good.

    References
    ----------
    Gneiting and Raftery 2007, J. Am. Stat. Assoc. 102, 359, eq. 43.
    """
    penalty = 2.0 / (1.0 - coverage)
    found: FloatArray = (
        high - low + penalty * np.maximum(low - measured, 0.0) + penalty * np.maximum(measured - high, 0.0)
    )
    return found


def digits_of_band(half_width: float) -> int:
    """Return the decimals of a number that its band leaves a meaning: two digits of the half-width."""
    return 1 - math.floor(math.log10(half_width)) if half_width > 0.0 and math.isfinite(half_width) else 3


def rounded(value: float, half_width: float) -> str:
    """Write a number to the digits that its band leaves a meaning."""
    digits = digits_of_band(half_width)
    return f"{round(value, digits):.{max(digits, 0)}f}"

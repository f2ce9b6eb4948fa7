"""Score bands by what was measured."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.results.model_band import COVERAGE


def interval_score(low: FloatArray, high: FloatArray, measured: FloatArray, coverage: float = COVERAGE) -> FloatArray:
    """Return the interval score of each band.

    It is the width, increased for each measured value outside; a small score is good.

    References
    ----------
    Gneiting and Raftery 2007, J. Am. Stat. Assoc. 102, 359, eq. 43.
    """
    penalty = 2.0 / (1.0 - coverage)
    found: FloatArray = (
        high - low + penalty * np.maximum(low - measured, 0.0) + penalty * np.maximum(measured - high, 0.0)
    )
    return found


def relative(difference: FloatArray, measured: FloatArray) -> FloatArray:
    """Return differences over measured values, without those of zeros."""
    known = measured != 0.0
    found: FloatArray = difference[known] / measured[known]
    return found

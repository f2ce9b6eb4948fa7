"""Draw random numbers that depend on a key alone."""

from __future__ import annotations

import numpy as np

from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper

_GOLDEN = np.uint64(0x9E3779B97F4A7C15)
_MIX_1 = np.uint64(0xBF58476D1CE4E5B9)
_MIX_2 = np.uint64(0x94D049BB133111EB)
_30, _27, _31, _11 = np.uint64(30), np.uint64(27), np.uint64(31), np.uint64(11)
_SPACING = 2.0**-53


@helper
def _mix(word):
    """Return the scrambled word.

    The finaliser of SplitMix64 scrambles it (Steele, Lea and Flood 2014, OOPSLA, figure 16).
    """
    word = (word ^ (word >> _30)) * _MIX_1
    word = (word ^ (word >> _27)) * _MIX_2
    return word ^ (word >> _31)


@shared_helper
def uniform(seed, ball, ring, patch, stream):
    """Return a reproducible number in (0, 1).

    It depends on the key alone.
    """
    word = _mix(np.uint64(seed) + _GOLDEN)
    word = _mix((word ^ np.uint64(2 * ball + ring)) + _GOLDEN)
    word = _mix((word ^ np.uint64(patch)) + _GOLDEN)
    word = _mix((word ^ np.uint64(stream)) + _GOLDEN)
    return (np.float64(word >> _11) + 0.5) * _SPACING

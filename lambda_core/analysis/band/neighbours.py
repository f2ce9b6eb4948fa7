"""Interpolate what was computed at points far apart.

How far ranges and laws move a result changes slowly over operating conditions. It is computed at points spread over all
of them, and interpolated at the others.

References
----------
Kennard and Stone 1969, Technometrics 11, 137 (points spread by their largest distance); Powell 1992, Advances in
Numerical Analysis 2, 105 (interpolation by radial functions, here the distance).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lambda_core.domain.arrays import FloatArray

_DECADES = 3.0  # largest over smallest value, from which a quantity counts by its logarithm


def places_of(columns: Sequence[Sequence[float | str]]) -> FloatArray:
    """Return points in coordinates whose distances compare.

    The array has shape (n, d), from a column per parameter.

    Numbers run from 0 to 1 over their range, evenly by their logarithm over wide ranges; two names are 1 apart.
    """
    found: list[FloatArray] = []
    for column in columns:
        if all(isinstance(value, float | int) for value in column):
            values = np.array(column, dtype=np.float64)
            if values.min() > 0.0 and values.max() > _DECADES * values.min():
                values = np.log(values)
            width = float(np.ptp(values))
            found.append((values - values.min()) / width if width > 0.0 else np.zeros(values.size))
        else:
            names = np.array([str(value) for value in column])
            found += [np.sqrt(0.5) * (names == name) for name in dict.fromkeys(names.tolist())]
    return np.column_stack(found)


def spread_out(places: FloatArray, most: int) -> list[int]:
    """Return rows of places that lie far apart.

    There are at most so many rows: the middle one comes first, then each row that lies farthest from all others.

    Equal places count as one.
    """
    chosen = [int(np.argmin(_distances(places, places.mean(axis=0))))]
    nearest = _distances(places, places[chosen[0]])
    while len(chosen) < most and nearest.max() > 0.0:
        chosen.append(int(np.argmax(nearest)))
        nearest = np.minimum(nearest, _distances(places, places[chosen[-1]]))
    return chosen


def interpolated(places: FloatArray, known: Sequence[int], values: FloatArray) -> FloatArray:
    """Return values at all places from known ones.

    The array has shape (n, m), and each value is a sum over distances from the known places.
    """
    from scipy.interpolate import RBFInterpolator

    found: FloatArray = RBFInterpolator(places[list(known)], values, kernel="linear", degree=0)(places)
    return found


def _distances(places: FloatArray, place: FloatArray) -> FloatArray:
    found: FloatArray = np.linalg.norm(places - place, axis=1)
    return found

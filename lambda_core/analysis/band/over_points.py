"""Compute model bands of many operating points.

A few points are computed in full, and the others follow from these (:mod:`.neighbours`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.model_band import bands_of
from lambda_core.analysis.band.neighbours import interpolated, spread_out
from lambda_core.analysis.static_point import static_point
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import LambdaError
from lambda_core.results.model_band import FIELDS, MachineBand

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

MOST = 8  # points computed in full: half a second each
Shares = dict[str, FloatArray]


def bands_over(
    model_at: Callable[[int], BearingModel | MachineModel],
    places: FloatArray,
    most: int = MOST,
    hear: Callable[[int, MachineBand], None] | None = None,
) -> Shares:
    """Return the model band at each point.

    Parameters
    ----------
    model_at : callable
        Returns the model of a point, at its own temperatures.
    places : float64[:, :], shape (n, d)
        The points, see :func:`.neighbours.places_of`.
    most : int
        Points that are computed in full; their bands are exact.
    hear : callable, optional
        Takes the number of each of these points and its bands.

    Returns
    -------
    dict of str to float64[:, :]
        By the name of the result in the machine interface: both ends over the value, shape (n, 2). Empty where no point
        has a band.
    """
    known: list[int] = []
    logarithms: list[dict[str, list[float]]] = []
    for row in spread_out(places, most) if len(places) else ():
        try:
            model = model_at(row)
            bands = bands_of(model, static_point(model).loaded)
        except LambdaError:  # this point has no solution, or only its result is known
            continue
        logarithms.append(_logarithms(bands))
        known.append(row)
        if hear is not None:
            hear(row, bands)
    if not known:
        return {}
    found = {}
    for name in (name for name in logarithms[0] if all(name in one for one in logarithms)):
        ends = interpolated(places, known, np.array([one[name] for one in logarithms]))
        found[name] = np.exp(np.column_stack([np.minimum(ends[:, 0], 0.0), np.maximum(ends[:, 1], 0.0)]))
    return found


def _logarithms(found: MachineBand) -> dict[str, list[float]]:
    """Return the logarithms of both ends.

    They are relative to the value of each result. The results of a bearing have its name before them; the last ones are
    of all bearings together.
    """
    logarithms: dict[str, list[float]] = {}
    for name, band in found.bearings.items():
        prefix = f"{name}." if name else ""
        for one in band.bands:
            logarithms[prefix + FIELDS[one.quantity]] = np.log([one.low / one.value, one.high / one.value]).tolist()
    for total, ends in found.fields().items():
        field = total.removesuffix("_band")
        each = [one.value for band in found.bearings.values() for one in band.bands if FIELDS[one.quantity] == field]
        if ends:
            logarithms[field] = np.log(np.array(ends) / sum(each)).tolist()
    return logarithms

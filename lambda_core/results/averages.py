"""Average running integrals over complete cage revolutions.

Every average is a difference of integrals divided by a difference of angle or time, so it
is exact for the steps that were taken and does not depend on how often samples are kept.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import accumulate

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import DIMENSIONS, LOSSES, Channel

# What is kept of the running integrals, all from t = 0; `time` first.
INTEGRALS: tuple[Channel, ...] = (
    Channel("time", (), "s", "time at the end of a step"),
    Channel("loss", ("mechanism",), "J", "dissipated energy by mechanism"),
    Channel("input", (), "J", "work of drives, loads, gravity and prescribed motions"),
    Channel("input_abs", (), "J", "integral of the absolute value of that power"),
    Channel("support", (), "J", "energy that dampers to the ground have taken; no friction of the bearing"),
    Channel("drive", (), "J", "work of the spin drives"),
    Channel("stored", (), "J", "kinetic and elastic energy, now minus at the start"),
    Channel("relative_angle", (), "rad", "integral of the absolute value of the rings' relative speed"),
    Channel("cage_angle", (), "rad", "angle of the cage relative to the outer ring"),
    Channel("inner_angle", (), "rad", "angle of the inner ring relative to the outer ring"),
    Channel("position", ("axis",), "m s", "integral of the position of the inner ring"),
)


def _keys() -> tuple[str, ...]:
    """Return the engine's names of the flat columns.

    They have the order of INTEGRALS.
    """
    labels = {"loss": [f"loss.{name}" for name in LOSSES], "position": list(DIMENSIONS["axis"])}
    return tuple(key for channel in INTEGRALS for key in labels.get(channel.name, [channel.name]))


COLUMNS = _keys()
_INDEX = {key: column for column, key in enumerate(COLUMNS)}
_LOSS = np.array([_INDEX[f"loss.{name}"] for name in LOSSES])
_ANGLE = _INDEX["cage_angle"]


def widths() -> tuple[int, ...]:
    """Return the number of columns per integral.

    There is one number for each entry of INTEGRALS.
    """
    return tuple(math.prod(len(DIMENSIONS[dim]) for dim in channel.dims) for channel in INTEGRALS)


def spans() -> dict[str, slice]:
    """Return the columns of each entry of INTEGRALS."""
    ends = list(accumulate(widths()))
    return {c.name: slice(end - width, end) for c, end, width in zip(INTEGRALS, ends, widths(), strict=True)}


def row(time: float, integrals: Mapping[str, float]) -> FloatArray:
    """Return one row of running integrals.

    The row at `time` [s] has shape (len(COLUMNS),).
    """
    return np.array([time if key == "time" else integrals[key] for key in COLUMNS], dtype=np.float64)


def boundaries(before: FloatArray, after: FloatArray, completed: int) -> list[FloatArray]:
    """Return the integrals at whole cage revolutions.

    They are between two rows.

    Parameters
    ----------
    before, after : ndarray, shape (len(COLUMNS),)
        Running integrals at the ends of an interval that is short against a revolution.
    completed : int
        Cage revolutions completed up to `before`; a cage that swings back across a
        boundary does not complete it twice.

    Returns
    -------
    list of ndarray
        One row per boundary, linear in the cage angle between the two rows.
    """
    start, end = float(before[_ANGLE]), float(after[_ANGLE])
    found = []
    while abs(end) >= 2.0 * math.pi * (completed + 1):
        completed += 1
        target = math.copysign(2.0 * math.pi * completed, end)
        share = (target - start) / (end - start)
        at = before + min(max(share, 0.0), 1.0) * (after - before)
        at[_ANGLE] = target
        found.append(at)
    return found


@dataclass(frozen=True)
class Interval:
    """Means over an interval, SI.

    It is between two rows of running integrals.
    """

    first: FloatArray
    last: FloatArray

    def change(self, key: str) -> float:
        """Return how much one column grew."""
        return float(self.last[_INDEX[key]] - self.first[_INDEX[key]])

    def ratio(self, numerator: str, denominator: str) -> float:
        """Return the quotient of two growths.

        NaN when the denominator did not grow.
        """
        below = self.change(denominator)
        return self.change(numerator) / below if below != 0.0 else math.nan

    def torque(self) -> float:
        """Return the friction torque [N m].

        It is the dissipated energy over the relative angle of the rings.
        """
        angle = self.change("relative_angle")
        return float((self.last - self.first)[_LOSS].sum()) / angle if angle > 0.0 else math.nan

    def breakdown(self) -> dict[str, float]:
        """Return each mechanism's share of the torque [N m].

        It is the friction torque.
        """
        return {name: self.ratio(f"loss.{name}", "relative_angle") for name in LOSSES}

    def position(self) -> tuple[float, float, float]:
        """Return the mean position of the inner ring [m]."""
        return (self.ratio("x", "time"), self.ratio("y", "time"), self.ratio("z", "time"))

    def energy_residual(self) -> float:
        """Return the relative energy residual.

        It is (input - dissipated - stored) / integral of |input power|, or 0 when nothing flowed.
        """
        dissipated = float((self.last - self.first)[_LOSS].sum()) + self.change("support")
        missing = self.change("input") - dissipated - self.change("stored")
        flow = self.change("input_abs")
        if flow > 0.0:
            return missing / flow
        return 0.0 if missing == 0.0 else math.copysign(math.inf, missing)


@dataclass(frozen=True)
class Estimate:
    """Mean with its 95 % confidence half-width.

    It is NaN from fewer than two values.
    """

    mean: float
    half_width: float
    count: int


def estimate(values: FloatArray) -> Estimate:
    """Return mean and half-width of batch means.

    The half-width holds with 95 % confidence for a stationary series.

    Student's t over the batches; where neighbouring batches correlate positively
    (lag-1 coefficient r), the variance of the mean is multiplied by (1 + r)/(1 - r), as
    for a first-order autoregressive series (Law and Kelton, Simulation Modeling and
    Analysis, batch means). A negative r never narrows the interval. `values` has shape (n,).
    """
    from scipy.special import stdtrit  # views import this module when plugins are listed

    count = values.size
    mean = float(values.mean()) if count else math.nan
    if count < 2:
        return Estimate(mean, math.nan, count)
    deviation = values - mean
    square_sum = float(deviation @ deviation)
    if square_sum == 0.0:
        return Estimate(mean, 0.0, count)
    correlation = min(max(float(deviation[1:] @ deviation[:-1]) / square_sum, 0.0), 0.9)
    variance = square_sum / (count - 1) / count * (1.0 + correlation) / (1.0 - correlation)
    return Estimate(mean, float(stdtrit(count - 1, 0.975)) * math.sqrt(variance), count)


def torque_by_revolution(rows: FloatArray) -> FloatArray:
    """Return the friction torque of each interval [N m].

    An interval lies between two of the rows, shape (n + 1, len(COLUMNS)); the result has shape (n,).
    """
    growth = np.diff(rows, axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        torque: FloatArray = growth[:, _LOSS].sum(axis=1) / growth[:, _INDEX["relative_angle"]]
    return torque


def finite(value: float) -> float | None:
    """Return the number, None when not finite.

    JSON has no NaN and no infinity.
    """
    return float(value) if math.isfinite(value) else None

"""Provide the published values of Syla et al. 2026.

The source is Syla, Brill, Paulus, Graf and Koch 2026, Lubricants 14, 154.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray

PAPER = "Syla et al. 2026, Lubricants 14, 154"
SPEEDS = (500, 1500, 3000)  # [1/min]
LOADS = {"cp10": 16.0e3, "cp6.5": 24.6e3}  # C/P = 10 and 6.5 with C = 160 kN [N]
MEASURED = "measurement"


@dataclass(frozen=True)
class Point:
    """One operating point of Table 4."""

    load: str  # "cp10" or "cp6.5"
    speed: int  # [1/min]
    measured: float  # friction torque [N mm]

    @property
    def case(self) -> str:
        """Name of the built-in case."""
        return f"6319-{self.load}-{self.speed}"

    @property
    def label(self) -> str:
        """Words for people."""
        return f"C/P = {self.load.removeprefix('cp')}, {self.speed} 1/min"


# Table 4, friction torque of the 6319 [N mm], by method: C/P = 10 then 6.5, at 500, 1500, 3000 1/min.
TABLE_4: dict[str, tuple[float, ...]] = {
    MEASURED: (925.0, 1306.0, 1564.0, 1456.0, 1750.0, 1847.0),
    "SKF": (814.0, 1190.0, 1380.0, 1330.0, 1720.0, 2000.0),
    "LaMBDA": (828.0, 1194.0, 1285.0, 1192.0, 1547.0, 1750.0),
    "FVA-Workbench": (685.0, 1158.0, 1312.0, 1141.0, 1599.0, 1844.0),
    "Bearinx": (653.0, 1124.0, 1270.0, 1078.0, 1511.0, 1736.0),
}
METHODS = tuple(name for name in TABLE_4 if name != MEASURED)

POINTS: tuple[Point, ...] = tuple(
    Point(load, speed, TABLE_4[MEASURED][i])
    for i, (load, speed) in enumerate((load, speed) for load in LOADS for speed in SPEEDS)
)

# Section 4.3 and Fig. 7: 6208 of Table 6, oil of Table 5, 2750 1/min, 40 degC.
AXIAL_LOADS = (700, 1300, 2000)  # [N]
AREA_GROWTH = 78.0  # [%] of the Hertzian area from 700 to 2000 N
FILM_RATIO = 20.0  # [%] outer film over inner
OUTER_BELOW_INNER = (10.0, 14.0)  # [%] capacitance
GAP_CHANGE = -9.0  # [%] of the gap from 700 to 2000 N


def mean_absolute_error(values: tuple[float, ...] | list[float], points: tuple[Point, ...] = POINTS) -> float:
    """Return the mean of |value/measured - 1| [%].

    It is the mean over the operating points that have a value.
    """
    errors = [abs(value / point.measured - 1.0) for value, point in zip(values, points, strict=True)]
    known = [error for error in errors if not math.isnan(error)]
    return 100.0 * sum(known) / len(known) if known else math.nan


def known_mean(values: FloatArray) -> float:
    """Return the mean of all values but NaN.

    NaN where nothing is left.
    """
    known = values[np.isfinite(values)]
    return float(known.mean()) if known.size else math.nan


def largest(values: Sequence[float]) -> float:
    """Return the value of the largest magnitude.

    It keeps its sign and ignores NaN; it is NaN where nothing is left.
    """
    return max((value for value in values if not math.isnan(value)), key=abs, default=math.nan)

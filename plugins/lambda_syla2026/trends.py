"""Evaluate the trends of the stability map.

These are slopes over frequency and steps from load to load, with standard errors and bars.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Protocol

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.results.record import Record
from lambda_syla2026.boundary import CRITERIA

QUARTER = 4.0  # resonance over the upper end of the declared range, at least
RESOLVED = 2.0  # standard errors by which a step is more than chance
SLOPE, TOLERANCE = -1.0, 0.25  # what the acceleration alone would give, and the bar around it


class BoundaryPoint(Record):
    """One point of a boundary."""

    variant: str
    load_N: float
    criterion: str
    frequency_Hz: float
    velocity_m_per_s: float | None = Field(description="velocity amplitude of the excitation; null: none found")
    acceleration_m_per_s2: float | None
    own_error: float | None = Field(description="standard error of its logarithm from the runs at its bracket's ends")
    still_error: float | None = Field(
        description="the same from the run without excitation, signed: all frequencies of a variant and load share it"
    )
    low_m_per_s: float | None = Field(description="largest amplitude that was simulated and left the running unaltered")
    high_m_per_s: float | None = Field(description="smallest amplitude that altered it")
    runs: int
    declared: bool = Field(description="inside the declared range, so part of the slope")
    failed: bool = Field(default=False, description="a run that it needs has no result")

    @property
    def error(self) -> float | None:
        """Standard error of the logarithm, both parts together."""
        return (
            None if self.own_error is None or self.still_error is None else math.hypot(self.own_error, self.still_error)
        )


class Line(Record):
    """One boundary over frequency."""

    variant: str
    load_N: float
    criterion: str
    slope: float | None = Field(description="of log velocity over log frequency in the declared range, least squares")
    slope_error: float | None = Field(description="its standard error, from those of the points")
    slope_beyond: float | None = Field(description="the same from its upper end to the highest frequency")
    falls: bool = Field(description="monotonically over all frequencies")


class Step(Record):
    """Effect of a higher load on a boundary.

    Geometric mean over the declared frequencies.
    """

    variant: str
    criterion: str
    from_N: float
    to_N: float
    mean_from_m_per_s2: float
    mean_to_m_per_s2: float
    rise_pct: float
    error_pct: float | None = Field(description="standard error, from those of the points")
    frequencies_up: int = Field(description="at how many frequencies the boundary is higher")
    frequencies: int


class Resonances(Protocol):
    """Axial resonances of one load [Hz]."""

    frequency_Hz: float
    ball_Hz: float
    cage_Hz: float


def lines(points: Sequence[BoundaryPoint]) -> list[Line]:
    """Return every boundary's slope."""
    keys = dict.fromkeys((p.variant, p.load_N, p.criterion) for p in points)
    return [_line(key, [p for p in points if (p.variant, p.load_N, p.criterion) == key]) for key in keys]


def _line(key: tuple[str, float, str], points: Sequence[BoundaryPoint]) -> Line:
    inside = [p for p in points if p.declared]
    beyond = [inside[-1], *(p for p in points if not p.declared)]
    velocities = [p.velocity_m_per_s for p in points]
    falls = all(a is not None and b is not None and b < a for a, b in pairwise(velocities))
    slope, error = _slope(inside)
    return Line(
        variant=key[0],
        load_N=key[1],
        criterion=key[2],
        slope=slope,
        slope_error=error,
        slope_beyond=_slope(beyond)[0] if len(beyond) > 1 else None,
        falls=falls,
    )


def _slope(points: Sequence[BoundaryPoint]) -> tuple[float | None, float | None]:
    """Return the log-log slope and its standard error.

    It is the slope of velocity over frequency; None where a boundary is missing.
    """
    velocity = [p.velocity_m_per_s for p in points]
    if any(v is None for v in velocity):
        return None, None
    x = np.log([p.frequency_Hz for p in points])
    weights = (x - x.mean()) / float(((x - x.mean()) ** 2).sum())
    return float(weights @ np.log(np.array(velocity, dtype=np.float64))), _spread(points, weights)


def _spread(points: Sequence[BoundaryPoint], weights: FloatArray) -> float | None:
    """Return the standard error of a weighted sum.

    The sum consists of logarithms of points that share their run without excitation.
    """
    own, still = [p.own_error for p in points], [p.still_error for p in points]
    if any(e is None for e in (*own, *still)):
        return None
    alone = np.array(own, dtype=np.float64) * weights
    return math.hypot(float(np.sqrt((alone**2).sum())), float(np.array(still, dtype=np.float64) @ weights))


def steps(points: Sequence[BoundaryPoint]) -> list[Step]:
    """Return the effect of every step of the load.

    The steps lie in the declared range; there are none where a boundary is missing.
    """
    found = []
    for variant, criterion in dict.fromkeys((p.variant, p.criterion) for p in points):
        mine = [p for p in points if p.declared and (p.variant, p.criterion) == (variant, criterion)]
        loads = sorted({p.load_N for p in mine})
        rows = [[p for p in mine if p.load_N == load] for load in loads]
        if all(p.acceleration_m_per_s2 is not None for p in mine):
            found += [_step(low, high) for low, high in pairwise(rows)]
    return found


def _step(low: Sequence[BoundaryPoint], high: Sequence[BoundaryPoint]) -> Step:
    first, second = (np.log(np.array([p.acceleration_m_per_s2 for p in row], dtype=np.float64)) for row in (low, high))
    weights = np.full(len(low), 1.0 / len(low))
    spreads = [_spread(row, weights) for row in (low, high)]
    rise = float((second - first).mean())
    error = None if None in spreads else math.hypot(*(s for s in spreads if s is not None))
    return Step(
        variant=low[0].variant,
        criterion=low[0].criterion,
        from_N=low[0].load_N,
        to_N=high[0].load_N,
        mean_from_m_per_s2=math.exp(first.mean()),
        mean_to_m_per_s2=math.exp(second.mean()),
        rise_pct=100.0 * math.expm1(rise),
        error_pct=None if error is None else 100.0 * math.exp(rise) * error,
        frequencies_up=int((second > first).sum()),
        frequencies=len(low),
    )


def bars(points: Sequence[BoundaryPoint], resonances: Sequence[Resonances], frequencies: Sequence[float]) -> list[str]:
    """Compare the boundaries with the trends of the paper."""
    found = lines(points)
    lowest = min(min(r.frequency_Hz, r.cage_Hz, r.ball_Hz) for r in resonances)
    ring = min(r.frequency_Hz for r in resonances)
    below = QUARTER * frequencies[-1] <= lowest
    return [
        _verdict(
            [_name(line) for line in found if not line.falls], "every boundary falls monotonically with frequency"
        ),
        *(_slope_bar(found, criterion) for criterion in CRITERIA),
        *(_load_bar(points, criterion) for criterion in CRITERIA),
        f"{'met' if below else 'missed'}: {frequencies[0]:g} to {frequencies[-1]:g} Hz, the declared range of the "
        f"slopes, end below a quarter of the lowest axial resonance, {lowest:.0f} Hz (cage); rings: {ring:.0f} Hz",
    ]


def _name(line: Line) -> str:
    return f"{line.variant} {line.load_N / 1e3:g} kN {line.criterion}"


def _verdict(wrong: Sequence[str], what: str) -> str:
    return f"missed: {what}: {'; '.join(wrong)}" if wrong else f"met: {what}"


def _slope_bar(found: Sequence[Line], criterion: str) -> str:
    mine = [line for line in found if line.criterion == criterion]
    slopes = [line.slope for line in mine if line.slope is not None]
    errors = [line.slope_error for line in mine if line.slope_error is not None]
    wrong = [
        f"{_name(x)} {with_error(x.slope, x.slope_error)}"
        for x in mine
        if x.slope is None or abs(x.slope - SLOPE) > TOLERANCE
    ]
    span = f"{min(slopes):.2f} to {max(slopes):.2f}" if slopes else "none"
    known = f", standard errors up to {max(errors):.2f}" if errors else ""
    return _verdict(wrong, f"criterion {criterion}: log-log slope within -1 +- 0.25, found {span}{known}")


def with_error(value: float | None, error: float | None, digits: int = 2) -> str:
    """Write a number with its standard error."""
    if value is None:
        return "none"
    return f"{value:.{digits}f}" if error is None else f"{value:.{digits}f} +- {error:.{digits}f}"


def _load_bar(points: Sequence[BoundaryPoint], criterion: str) -> str:
    """Check that the boundary rises with the load.

    The mean boundary, with every step of the load.

    A rise counts when it is more than twice its standard error; frequencies at which the boundary falls are named.
    """
    mine = [step for step in steps(points) if step.criterion == criterion]
    said = "; ".join(_said(mine)) or "a boundary was not found"
    text = f"criterion {criterion}: the boundary moves up with the load, on the mean {said}"
    against = list(_against([p for p in points if p.declared and p.criterion == criterion]))
    if mine and against:
        text += f"; single points fall: {', '.join(against)}"
    rises = bool(mine) and all(step.rise_pct > RESOLVED * (step.error_pct or 0.0) for step in mine)
    return f"{'met' if rises else 'missed'}: {text}"


def _said(mine: Sequence[Step]) -> Iterator[str]:
    for variant in dict.fromkeys(step.variant for step in mine):
        of_variant = [step for step in mine if step.variant == variant]
        first = of_variant[0]
        rises = ", ".join(_rise(step) for step in of_variant)
        yield f"{variant} {first.mean_from_m_per_s2:.1f} m/s2 under {first.from_N / 1e3:g} kN, {rises}"


def _rise(step: Step) -> str:
    """Write a step with its standard error.

    Also tell whether it is more than twice that.
    """
    text = f"{with_error(step.rise_pct, step.error_pct, 1)} % to {step.to_N / 1e3:g} kN"
    resolved = step.error_pct is None or abs(step.rise_pct) > RESOLVED * step.error_pct
    return text if resolved else f"{text} (not resolved)"


def _against(mine: Sequence[BoundaryPoint]) -> Iterator[str]:
    """Name every point below the next lower load's.

    Also give the difference.
    """
    for point in mine:
        lower = [p for p in mine if (p.variant, p.frequency_Hz) == (point.variant, point.frequency_Hz)]
        lower = sorted((p for p in lower if p.load_N < point.load_N), key=lambda p: p.load_N)[-1:]
        values = [p.acceleration_m_per_s2 for p in (*lower, point)]
        if len(values) == 2 and values[0] is not None and values[1] is not None and values[1] < values[0]:
            fall = 100.0 * (values[1] / values[0] - 1.0)
            yield f"{point.variant} {point.frequency_Hz:g} Hz to {point.load_N / 1e3:g} kN ({fall:.0f} %)"

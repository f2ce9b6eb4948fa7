"""Make the figures of the reproduction as data."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.views.chart import Axis, Mark, Panel, Series, ViewData
from lambda_syla2026.fig5 import Fig5
from lambda_syla2026.fig7 import Fig7
from lambda_syla2026.published import METHODS, PAPER, POINTS, SPEEDS, TABLE_4
from lambda_syla2026.sensitivity import Sensitivity
from lambda_syla2026.table4 import Table4
from lambda_syla2026.trends import BoundaryPoint

_TOP = 2600.0  # of both panels of the torque [N mm]
_BESIDE = 55.0  # shift of the points of each further method along the speed [1/min]
_SEEN = 0.3  # change of the torque that a bar shows [%]
_ROWS = {"C/P = 10": slice(0, 3), "C/P = 6.5": slice(3, 6)}
_CRITERIA = {"S": "speed of unloaded balls (S)", "T": "contacts outside the zone (T)"}
_WIDTH = 2.0  # of the bands [standard errors]
_SPEEDS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # numbers at the axis [m/s]


def _array(values: object) -> FloatArray:
    return np.array(values, dtype=np.float64)


def table4_chart(found: Table4) -> ViewData:
    """Draw torque over speed for both loads.

    It shows the measurement, the blind set with its band, the calibrated sets and the other methods.
    """
    speed = _array(SPEEDS)
    panels = []
    for title, rows in _ROWS.items():
        blind = _array([p.simulated_Nmm for p in found.points[rows]])
        low = _array([d.low_Nmm for d in found.details[rows]])
        high = _array([d.high_Nmm for d in found.details[rows]])
        fitted = _array([p.calibrated_Nmm for p in found.points[rows]])
        measured = _array([p.measured for p in POINTS[rows]])
        # The band need not hold the blind value: it is a band of all published values.
        series = [
            Series("measured", speed, measured, "points", "total"),
            Series("blind, 90 % band", speed, blind, "line", "inner", np.minimum(low, blind), np.maximum(high, blind)),
            Series("calibrated on C/P = 10", speed, fitted, "line", "outer"),
            *(
                Series(f"{name} (printed)", speed + _BESIDE * i, _array(TABLE_4[name][rows]), "points", group=i)
                for i, name in enumerate(METHODS, start=1)
            ),
        ]
        axes = Axis("speed", "1/min", low=0.0, high=3300.0), Axis("friction torque", "N mm", low=0.0, high=_TOP)
        panels.append(Panel(title, *axes, tuple(series)))
    errors = ", ".join(f"{name} {value:.1f} %" for name, value in found.mean_absolute_error_pct.items())
    notes = (f"mean absolute error: {errors}", "printed values of other methods are drawn slightly off their speed")
    return ViewData("table4", "Friction torque of the 6319, oil bath", PAPER, tuple(panels), 2, notes)


def sensitivity_chart(found: Table4) -> ViewData:
    """Draw the change of torque over every range.

    Each parameter has a bar for either end of its range, the largest first; a note lists those without effect.
    """

    def effect(s: Sensitivity) -> float:
        return max(abs(s.low_change_pct), abs(s.high_change_pct))

    def high(s: Sensitivity) -> float:
        return 0.0 if s.low == s.high else s.high_change_pct  # the only other law has one bar

    shown = [s for s in found.sensitivities if effect(s) >= _SEEN]
    rest = [s.short for s in found.sensitivities if effect(s) < _SEEN]
    place = np.arange(len(shown), dtype=np.float64)
    series = (
        Series(
            "at the low end, or with the other law", place, _array([s.low_change_pct for s in shown]), "bars", "inner"
        ),
        Series("at the high end", place, _array([high(s) for s in shown]), "bars", "outer"),
    )
    panel = Panel("", Axis("", categories=tuple(s.short for s in shown)), Axis("change", "%"), series)
    notes = ["; ".join(f"{s.short}: {s.span}" for s in shown)]
    if rest:
        notes.append(f"below {_SEEN:g} %: {', '.join(rest)}")
    title = "What every assumed parameter does to the torque"
    return ViewData("sensitivity", title, "6319", (panel,), 1, tuple(notes))


def fig5_chart(found: Fig5) -> ViewData:
    """Draw the excitation velocity at the boundary.

    The axis is the frequency; each variant and criterion has a panel.
    """
    panels = []
    for variant, criterion in dict.fromkeys((p.variant, p.criterion) for p in found.points):
        mine = [p for p in found.points if (p.variant, p.criterion) == (variant, criterion)]
        series = []
        for load in dict.fromkeys(p.load_N for p in mine):
            line = [p for p in mine if p.load_N == load]
            frequency = _array([p.frequency_Hz for p in line])
            mid = _array([np.nan if p.velocity_m_per_s is None else p.velocity_m_per_s for p in line])
            wide = np.exp(_WIDTH * _array([np.nan if p.error is None else p.error for p in line]))
            series.append(Series(f"{load / 1e3:g} kN", frequency, mid, "line", "", mid / wide, mid * wide, "95 %"))
        series.append(_slope_of_one(mine))
        title = f"Variant {variant}: {_CRITERIA[criterion]}"
        axes = (
            Axis("frequency", "Hz", log=True, low=4.5, high=45.0, ticks=(5.0, 10.0, 20.0, 40.0)),
            Axis("excitation velocity", "m/s", log=True, low=0.03, high=2.0, ticks=_SPEEDS),
        )
        marks = (Mark("", found.frequency_range_Hz[1], "x"),)
        panels.append(Panel(title, *axes, tuple(series), marks))
    rings, cage = (min(values) for values in zip(*((r.frequency_Hz, r.cage_Hz) for r in found.resonances), strict=True))
    low_end, high_end = found.frequency_range_Hz
    notes = (
        f"bands: two standard errors; slopes: {low_end:g} to {high_end:g} Hz, left of the dotted line",
        f"lowest axial resonance of the cage on the unloaded balls {cage:.0f} Hz, of the rings {rings:.0f} Hz",
        *found.notes[:1],
    )
    return ViewData(
        "fig5", "Boundary of altered running of the 6220", f"after {PAPER}, Fig. 5", tuple(panels), 2, notes
    )


def _slope_of_one(points: Sequence[BoundaryPoint]) -> Series:
    """Return a line of constant acceleration.

    Through the middle of the declared points, to compare slopes with.
    """
    found = [p.acceleration_m_per_s2 for p in points if p.declared and p.acceleration_m_per_s2 is not None]
    acceleration = float(np.exp(np.mean(np.log(found)))) if found else 1.0
    frequency = _array(sorted({p.frequency_Hz for p in points}))
    velocity = acceleration / (2.0 * np.pi * frequency)
    return Series(f"slope -1: {acceleration:.0f} m/s2", frequency, velocity, "line", "reference")


def fig7_chart(found: Fig7) -> ViewData:
    """Compare simulated and analytical C_Hertz over axial load.

    It shows both rings.
    """
    panels = []
    for ring in ("inner", "outer"):
        mine = [c for c in found.contacts if c.ring == ring]
        load = _array([c.load_N for c in mine])
        series = (
            Series("simulation", load, _array([c.hertz_pF for c in mine]), "line", "total"),
            Series("analytical, isothermal", load, _array([c.analytical_pF for c in mine]), "points", "reference"),
        )
        axes = Axis("axial load", "N", low=500.0, high=2200.0), Axis("C_Hertz", "pF", low=0.0, high=20.0)
        panels.append(Panel(f"{ring} ring contact", *axes, series))
    return ViewData("fig7", "Capacitance of the Hertzian contacts, 6208", f"after {PAPER}, Fig. 7", tuple(panels), 2)

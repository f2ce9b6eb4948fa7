"""Tabulate the scatter of averages and the model band."""

from __future__ import annotations

from typing import Any

from lambda_core.domain.number_text import digits_of_band, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.export.report.key_tables import Table
from lambda_core.results.model_band import FIELDS

_SCATTER = {"friction torque": "friction_torque_ci_Nmm"}


def model_bands(summary: Any, units: UnitSystem = SI) -> tuple[Table, ...]:
    """Return the model band of each number.

    It is empty where the run did not compute one.
    """
    band = summary.model_band
    if band is None:
        return ()
    rows = []
    for one in band.bands:
        ends = getattr(summary, f"{FIELDS[one.quantity]}_band")
        if not ends:
            continue
        low, high = (units.value(end, one.unit) for end in ends)
        digits = max(digits_of_band(0.5 * abs(high - low), low), 0)
        width = getattr(summary, _SCATTER.get(one.quantity, ""), None)
        scatter = "-" if width is None else f"± {units.value(width, one.unit):.2g}"
        shown = f"{number(round(low, digits), digits)} .. {number(round(high, digits), digits)}"
        rows.append((one.title, shown, scatter, units.unit(one.unit), one.why()))
    head = ("", "model band (90 %)", "scatter (95 %)", "unit", "mostly from")
    return (Table("how far the model may be off", head, tuple(rows)),)

"""Make chart, tables and chapter of the catalogue comparison."""

from __future__ import annotations

import numpy as np

from lambda_core.export.report.key_tables import Table
from lambda_core.views.chart import Axis, Panel, Series, ViewData
from lambda_syla2026 import parameters as P
from lambda_syla2026.anchors import STRIBECK, Anchors
from lambda_syla2026.axial_load import BEARING as AXIAL
from lambda_syla2026.page import Chapter
from lambda_syla2026.text import number

_OF = "SKF, Rolling bearings (2018), Friction"


def chapter(found: Anchors, notes: tuple[str, ...]) -> Chapter:
    """Return the texts, figures and tables."""
    return Chapter(
        "anchors",
        "Catalogue: friction of other bearings against SKF's model",
        tuple(found.bars),
        (_stribeck_chart(found),),
        _tables(found),
        notes,
    )


def _tables(found: Anchors) -> tuple[Table, ...]:
    first = found.spreads[0]
    loads, speeds = list(first.by_load_pct), list(first.by_speed_pct)
    spread = tuple(
        (s.parameters, s.grooves, number(s.bias_pct), number(s.rms_pct), number(s.worst_pct),
         *(number(v) for v in s.by_load_pct.values()), *(number(v) for v in s.by_speed_pct.values()))
        for s in found.spreads
    )  # fmt: skip
    head = ("set", "grooves", "bias", "rms", "worst", *(f"C/P {name}" for name in loads),
            *(f"n d_m {float(name) / 1e3:.0f}k" for name in speeds))  # fmt: skip
    bearings = tuple((name, *(number(s.by_bearing_pct[name]) for s in found.spreads)) for name in first.by_bearing_pct)
    random = tuple(
        (p.parameters, p.name, str(p.cases), number(p.median, 2), f"{p.lowest:.2f} to {p.highest:.2f}",
         number(p.rolling_median, 2), number(p.sliding_median, 2))
        for p in found.populations
    )  # fmt: skip
    axial = tuple(
        (f"{step.share:g}", *(number(value, 2) for value in (
            step.rolling, step.skf_rolling, step.sliding, step.skf_sliding, step.total, step.skf, step.schaeffler,
            step.ratio)))
        for step in found.axial
    )  # fmt: skip
    curve = tuple(
        (f"{p.speed_rpm:g}", number(p.torque_Nmm, 0), number(p.boundary_Nmm, 0), number(p.skf_Nmm, 0),
         number(p.ratio, 2))
        for p in found.stribeck
    )  # fmt: skip
    rated = tuple(
        (
            r.series,
            str(r.bearings),
            *(_with_range(spread) for spread in (r.contacts, r.with_drag, r.skf, r.skf_with_drag, r.over_skf)),
        )
        for r in found.rated
    )
    chosen = tuple((path, value or "-", source) for path, value, source in P.anchored_set())
    tables = [
        Table("deviation of the torque from SKF's model [%]", head, spread),
        Table("deviation by bearing [%]", ("", *(f"{s.parameters}, {s.grooves}" for s in found.spreads)), bearings),
        Table(
            "random cases: torque over that of SKF's model",
            ("set", "cases", "number", "median", "range", "rolling", "sliding"),
            random,
        ),
        Table(
            f"axial load added, {AXIAL[0]} under {AXIAL[2]:g} N radial at {AXIAL[3]:g} 1/min: over no axial load",
            ("F_a/F_r", "rolling", "M_rr", "sliding", "M_sl", "total", "SKF", "Schaeffler's M_1", "total over SKF's"),
            axial,
        ),
        Table(
            f"Stribeck curve of the {STRIBECK[0]}, {STRIBECK[2]}, VG 68, 60 degC [N mm]",
            ("1/min", "torque", "boundary", "SKF", "ratio"),
            curve,
        ),
        Table(
            "loss at SKF's printed reference speeds over q_r A_r of ISO 15312: median (90 % of the bearings)",
            ("series", "bearings", "contacts", "with drag", "SKF's model", "SKF's with drag", "with drag over SKF's"),
            rated,
        ),
        Table("anchored parameter set: differences from the blind set", ("option", "value", "source"), chosen),
    ]
    return tuple(table for table in tables if table.rows)


def _with_range(spread: list[float]) -> str:
    return f"{spread[0]:.2f} ({spread[1]:.2f} to {spread[2]:.2f})"


def _stribeck_chart(found: Anchors) -> ViewData:
    """Compare torque over speed, and its boundary part, with SKF's."""
    speed = np.array([p.speed_rpm for p in found.stribeck])
    series = (
        Series("quasi-static", speed, np.array([p.torque_Nmm for p in found.stribeck]), "line", "total"),
        Series("of it on asperities", speed, np.array([p.boundary_Nmm for p in found.stribeck]), "line", "inner"),
        Series("SKF", speed, np.array([p.skf_Nmm for p in found.stribeck]), "points", "reference"),
    )
    panel = Panel("", Axis("speed", "1/min", log=True), Axis("friction torque", "N mm", low=0.0), series)
    title = f"Stribeck curve of a {STRIBECK[0]} under {STRIBECK[2]}"
    return ViewData("stribeck-6316", title, _OF, (panel,), 1, ("VG 68 at 60 degC; without cage and drag",))

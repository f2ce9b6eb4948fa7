"""Hold printed tables for the derivation of geometry.

They are ball sizes, ISO 76 f_0, ISO 281 f_c and published designs.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from functools import cache
from pathlib import Path

_FOLDER = Path(__file__).parent / "tables"


def _rows(name: str) -> list[dict[str, str]]:
    with (_FOLDER / name).open(newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


@dataclass(frozen=True)
class PublishedDesign:
    """Published inner geometry for validation (mm).

    It validates the derivation.
    """

    designation: str
    maker: str
    bore_diameter: float
    outside_diameter: float
    ball_count: int
    ball_diameter: float
    pitch_diameter: float
    source: str
    grade: str
    note: str


@cache
def standard_balls() -> tuple[float, ...]:
    """Return standard ball diameters [mm].

    They are inch and metric sizes (ISO 3290).
    """
    return tuple(float(row["ball_diameter_mm"]) for row in _rows("balls.csv"))


@cache
def iso76_f0(*, both_052: bool = False) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return f_0 of ISO 76 for radial ball bearings.

    The pairs are (D_w cos(alpha)/D_pw, f_0), in N and mm.

    The standard's table holds for conformities 0.52/0.53, where the outer raceway limits below 0.09. `both_052`
    gives the factor for 0.52/0.52, recomputed with Hertz theory (:func:`lambda_core.formulas.ratings.static_factor`):
    the same within 0.05 from 0.10 on, higher below.
    """
    rows = _rows("iso76_f0.csv")
    column = "f0_both_052" if both_052 else "f0"
    return tuple(float(row["gamma"]) for row in rows), tuple(float(row[column]) for row in rows)


@cache
def iso281_fc() -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return f_c of ISO 281 for single rows.

    It is that of radial contact ball bearings: (D_w cos(alpha)/D_pw, f_c), N and mm.
    """
    rows = _rows("iso281_fc.csv")
    return tuple(float(row["gamma"]) for row in rows), tuple(float(row["fc"]) for row in rows)


@cache
def published_designs() -> tuple[PublishedDesign, ...]:
    """Return inner geometries from data sets and literature."""
    return tuple(
        PublishedDesign(
            row["designation"],
            row["maker"],
            float(row["bore_diameter_mm"]),
            float(row["outside_diameter_mm"]),
            int(row["ball_count"]),
            float(row["ball_diameter_mm"]),
            float(row["pitch_diameter_mm"]),
            row["source"],
            row["grade"],
            row["note"],
        )
        for row in _rows("published_designs.csv")
    )

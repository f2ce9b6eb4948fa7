"""Complete catalogue rows by the estimated inner geometry."""

from __future__ import annotations

import math
from typing import Any

from lambda_core.elements.ball.kinds import kinds
from lambda_db.derive import Printed, RankedDesign, candidates, grade_of, relative_rounding

# Conformities that are assumed where nobody prints groove radii: below the largest that the rating standards allow,
# 0.52 and 0.53, between the printed pairs 0.5125/0.525 (6319) and 0.52/0.53 (6208) of Syla et al. 2026.
INNER_CONFORMITY, OUTER_CONFORMITY = 0.515, 0.525
DERIVED, ASSUMED_GROOVES = "derived", "conformity-assumed"  # keys of the built-in sources
# The inner grooves that both standards rate self-aligning bearings with; their outer raceway is a sphere.
ALIGNING_CONFORMITY, ASSUMED_ALIGNING = 0.53, "conformity-self-aligning"
Row = dict[str, Any]


def is_uprated(rating_type: str) -> bool:
    """Tell whether the dynamic rating is of premium class.

    It is then above plain ISO 281.
    """
    return "explorer" in rating_type.casefold()


def rated_rows(row: Row) -> int:
    """Return by how many rows the standards rate a bearing."""
    kind = kinds().get(row["kind"])
    return kind.rows * kind.arcs if kind is not None else 1


def printed_of(row: Row) -> Printed:
    """Collect the printed values of a bearing's row.

    Ratings that were computed from a geometry are not evidence.
    """
    static = row["static_rating_kN"] if row["static_rating_status"] != "derived" else None
    dynamic = row["dynamic_rating_kN"] if row["dynamic_rating_status"] != "derived" else None
    return Printed(
        bore_diameter=row["bore_diameter_mm"],
        outside_diameter=row["outside_diameter_mm"],
        static_rating=None if static is None else static * 1e3,
        dynamic_rating=None if dynamic is None else dynamic * 1e3,
        uprated=is_uprated(row["rating_type"]),
        static_rounding=0.0 if static is None else relative_rounding(static),
        dynamic_rounding=0.0 if dynamic is None else relative_rounding(dynamic),
        shoulder_diameter_inner=row["shoulder_diameter_inner_mm"],
        shoulder_diameter_outer=row["shoulder_diameter_outer_mm"],
        known_pitch=row["pitch_diameter_mm"],
        contact_angle=math.radians(row["contact_angle_deg"] or 0.0),
        rows=rated_rows(row),
        kind=row["kind"] or "",
    )


def candidates_of(row: Row) -> list[RankedDesign]:
    """Rank designs for a row without inner geometry.

    Without a rating there is no evidence.
    """
    if row["geometry_status"] not in (None, "derived"):
        return []
    printed = printed_of(row)
    if printed.static_rating is None and printed.dynamic_rating is None:
        return []
    return candidates(printed)


def candidate_rows(row: Row) -> list[Row]:
    """Return the candidate rows of one bearing."""
    return [
        {
            "designation": row["designation"],
            "maker": row["maker"],
            "rank": rank,
            "ball_count": design.ball_count,
            "ball_diameter_mm": design.ball_diameter,
            "pitch_diameter_mm": design.pitch_diameter,
            "score": round(design.score, 3),
            "filling_angle_deg": round(design.filling_angle, 2),
            "weight": round(design.weight, 6),
        }
        for rank, design in enumerate(candidates_of(row), start=1)
    ]


def with_design(row: Row, design: RankedDesign, grade: str) -> Row:
    """Return the row with an estimated design.

    It has zero-clearance raceways and assumed grooves.

    The sphere of a self-aligning bearing follows from pitch, contact angle and clearance: such a row has no raceways.
    """
    ball, pitch = design.ball_diameter, design.pitch_diameter
    aligning = row["kind"] in kinds() and kinds()[row["kind"]].on_sphere
    completed = row | {
        "ball_count": design.ball_count,
        "ball_diameter_mm": ball,
        "pitch_diameter_mm": pitch,
        "race_diameter_inner_mm": None if aligning else round(pitch - ball, 4),
        "race_diameter_outer_mm": None if aligning else round(pitch + ball, 4),
        "geometry_source": DERIVED,
        "geometry_grade": grade,
        "geometry_status": "derived",
    }
    if aligning:
        return completed | {
            "groove_radius_inner_mm": round(ALIGNING_CONFORMITY * ball, 4),
            "groove_source": ASSUMED_ALIGNING,
            "groove_grade": "C",
            "groove_status": "assumed",
        }
    if row["groove_radius_inner_mm"] is None or row["groove_radius_outer_mm"] is None:
        completed |= {
            "groove_radius_inner_mm": round(INNER_CONFORMITY * ball, 4),
            "groove_radius_outer_mm": round(OUTER_CONFORMITY * ball, 4),
            "groove_source": ASSUMED_GROOVES,
            "groove_grade": "C",
            "groove_status": "assumed",
        }
    return completed


def completed(row: Row) -> Row:
    """Return the row with its inner geometry.

    The geometry is estimated if there is none and an estimate of grade B or C exists.
    """
    if row["ball_count"] is not None:
        return row
    ranked = candidates_of(row)
    if not ranked:
        return row
    grade = grade_of(printed_of(row), ranked, ranked[0])
    return row if grade == "D" else with_design(row, ranked[0], grade)

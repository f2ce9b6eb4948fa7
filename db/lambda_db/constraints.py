"""Define CHECK constraints with the message for a refused row."""

from __future__ import annotations

from typing import get_args

from sqlalchemy import CheckConstraint

from lambda_core.domain.value_status import RowStatus
from lambda_core.elements.ball import BALL

GRADES = ("A", "A-", "B", "B-", "C", "D")
STATUSES: tuple[str, ...] = get_args(RowStatus)
# Groups of columns of a bearing that have a grade, and those that have a status.
_RATED = ("dynamic_rating", "static_rating")
_GRADED = ("dimensions", *_RATED, "catalogue", "geometry", "groove", "shoulder", "angle", "row_distance")
_WITH_STATUS = (*_RATED, "geometry", "groove", "row_distance")
_FIRST = ("angular contact", "four-point", "double row", "self-aligning")  # the order of databases that exist
# Of bearings; a row that names none is a deep groove ball bearing.
KINDS = (*_FIRST, *(name for name in BALL.kinds() if name not in (*_FIRST, "deep groove")))
# Kinds of which the distance of the rows does not follow.
_APART = tuple(name for name in KINDS if BALL.kinds()[name].rows == 2 and not BALL.kinds()[name].on_sphere)


def check(name: str, condition: str, sentence: str) -> CheckConstraint:
    return CheckConstraint(condition, name=name, info={"sentence": sentence})


def one_of(column: str, choices: tuple[str, ...]) -> CheckConstraint:
    listed = ", ".join(f"'{choice}'" for choice in choices)
    return check(f"{column}_known", f"{column} IN ({listed})", f"{column} must be one of {', '.join(choices)}")


def grade() -> CheckConstraint:
    """Require a known grade of a row."""
    return one_of("grade", GRADES)


def status() -> CheckConstraint:
    """Require a known status of a row."""
    return one_of("status", STATUSES)


def named(*columns: str) -> list[CheckConstraint]:
    return [check(f"{c}_not_empty", f"length(trim({c})) > 0", f"{c} must not be empty") for c in columns]


def positive(*columns: str) -> list[CheckConstraint]:
    return [check(f"{c}_positive", f"{c} > 0", f"{c} must be positive") for c in columns]


def together(group: str, columns: tuple[str, ...]) -> CheckConstraint:
    """Require values with source and grade, or none.

    It holds for one group of columns.
    """
    some = " OR ".join(f"{c} IS NOT NULL" for c in columns)
    return check(
        f"{group}_with_source",
        f"NOT ({some}) OR ({group}_source IS NOT NULL AND {group}_grade IS NOT NULL)",
        f"{', '.join(columns)}: a value needs {group}_source and {group}_grade",
    )


def _is_none_of(names: tuple[str, ...]) -> str:
    """Write that the kind is none of these."""
    if len(names) == 1:
        return f"(coalesce(kind, '') <> '{names[0]}')"
    listed = ", ".join(f"'{name}'" for name in names)
    return f"(coalesce(kind, '') NOT IN ({listed}))"


def kinds() -> list[CheckConstraint]:
    """Require a known kind and its contact angle.

    An angle with its source, where the kind of bearing has one.
    """
    return [
        one_of("kind", KINDS),
        together("angle", ("contact_angle_deg",)),
        check(
            "angle_of_kind",
            "(kind IS NULL) = (contact_angle_deg IS NULL) AND coalesce(contact_angle_deg, 45) BETWEEN 1 AND 45",
            "contact_angle_deg, 1 to 45, belongs to every kind but deep groove, and each needs it",
        ),
        together("row_distance", ("row_distance_mm",)),
        check(
            "row_distance_of_kind",
            f"(row_distance_mm IS NULL) = {_is_none_of(_APART)} AND coalesce(row_distance_mm, 1) > 0",
            f'row_distance_mm, above 0, belongs to the kind "{", ".join(_APART)}", which needs it',
        ),
    ]


def graded() -> list[CheckConstraint]:
    """Require known grades and statuses of a bearing's values."""
    grades = [one_of(f"{group}_grade", GRADES) for group in _GRADED]
    return grades + [one_of(f"{group}_status", STATUSES) for group in _WITH_STATUS]


# Constraint's name -> pattern of the property or parameter names that it rules.
_POSITIVE_NAMES = {
    "viscosity": "%viscosity%",
    "density": "density_1_",
    "alpha_p": "alpha_p%",
    "thermal_conductivity": "thermal_conductivity",
    "specific_heat": "specific_heat",
    "tau_eyring": "tau_eyring",
    "limit_ratio": "limit_ratio",
    "vogel_k": "vogel_k",
}


def positive_names() -> list[CheckConstraint]:
    return [
        check(f"{label}_positive", f"name NOT LIKE '{pattern}' OR value > 0", f"a {label} must be positive")
        for label, pattern in _POSITIVE_NAMES.items()
    ]

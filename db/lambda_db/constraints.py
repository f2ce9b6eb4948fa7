"""CHECK constraints that carry, beside their name, the sentence people read when a row is refused."""

from __future__ import annotations

from sqlalchemy import CheckConstraint

GRADES = ("A", "A-", "B", "B-", "C", "D")
STATUSES = ("published", "derived", "assumed")
KINDS = ("angular contact", "four-point")  # of bearings; a row that names none is a deep groove ball bearing


def check(name: str, condition: str, sentence: str) -> CheckConstraint:
    return CheckConstraint(condition, name=name, info={"sentence": sentence})


def one_of(column: str, choices: tuple[str, ...]) -> CheckConstraint:
    listed = ", ".join(f"'{choice}'" for choice in choices)
    return check(f"{column}_known", f"{column} IN ({listed})", f"{column} must be one of {', '.join(choices)}")


def named(*columns: str) -> list[CheckConstraint]:
    return [check(f"{c}_not_empty", f"length(trim({c})) > 0", f"{c} must not be empty") for c in columns]


def positive(*columns: str) -> list[CheckConstraint]:
    return [check(f"{c}_positive", f"{c} > 0", f"{c} must be positive") for c in columns]


def together(group: str, columns: tuple[str, ...]) -> CheckConstraint:
    """Require that a group's values stand with source and grade, or that all are empty."""
    some = " OR ".join(f"{c} IS NOT NULL" for c in columns)
    return check(
        f"{group}_with_source",
        f"NOT ({some}) OR ({group}_source IS NOT NULL AND {group}_grade IS NOT NULL)",
        f"{', '.join(columns)}: a value needs {group}_source and {group}_grade",
    )


def kinds() -> list[CheckConstraint]:
    """Require a known kind of bearing, and a contact angle with its source where the kind has one."""
    return [
        one_of("kind", KINDS),
        together("angle", ("contact_angle_deg",)),
        check(
            "angle_of_kind",
            "(kind IS NULL) = (contact_angle_deg IS NULL) AND coalesce(contact_angle_deg, 45) BETWEEN 1 AND 45",
            'contact_angle_deg, 1 to 45, belongs to the kinds "angular contact" and "four-point", which need it',
        ),
    ]


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

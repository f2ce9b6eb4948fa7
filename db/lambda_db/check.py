"""Check the visible catalogue for errors and oddities.

It looks for open references, laws without data, and ratings that do not match the geometry.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from pydantic import ValidationError

from lambda_core.catalogue.protocol import LubricantRow
from lambda_core.discovery.api import Registry
from lambda_core.domain.errors import LambdaError
from lambda_core.formulas.ratings import dynamic_rating, static_rating
from lambda_core.model.laws.oil_data import oil_data
from lambda_db.catalogue import SqlCatalogue
from lambda_db.derive import UPRATED, filling_angle
from lambda_db.engine import at_one_moment
from lambda_db.estimate import is_uprated, printed_of, rated_rows
from lambda_db.paths import user_database
from lambda_db.records import Row
from lambda_db.references import known_names, reference_problems
from lambda_db.transfer import rows_of

# A printed rating further than this from the one of the printed geometry is worth a look.
RATING_TOLERANCE = 0.05


@dataclass(frozen=True)
class Finding:
    """One finding of the check.

    An error makes a row unusable, a warning asks for a look.
    """

    severity: Literal["error", "warning"]
    where: str
    message: str


def check_catalogue(catalogue: SqlCatalogue, models: Registry) -> list[Finding]:
    """Check every visible row beyond the tables' constraints."""
    findings = list(_user_file(catalogue))
    with at_one_moment(catalogue.connection):  # rows that refer to others are read by several statements
        findings += [finding for row in rows_of(catalogue, "bearing") for finding in _bearing(row)]
        findings += _references(catalogue)
        findings += _clearances(rows_of(catalogue, "clearance"))
        findings += _lubricants(catalogue, models)
    findings += _shadows(catalogue, models)
    return findings


def _shadows(catalogue: SqlCatalogue, models: Registry) -> Iterator[Finding]:
    """Name the rows that plugins put before earlier ones."""
    packages = {str(folder): distribution for distribution, folder in models.data_folders}
    for each in catalogue.shadows():
        where = f"{each.table} {' '.join(each.key)}"
        behind = packages.get(each.over, each.over) or "the built-in catalogue"
        what = f'makes it "{each.title}", it was "{each.before}"' if each.table == "source" else "puts its own row"
        yield Finding("warning", where, f"{packages.get(each.folder, each.folder)} {what} in front of {behind}")


def _user_file(catalogue: SqlCatalogue) -> Iterator[Finding]:
    path = user_database()
    if path.exists() and not catalogue.has_user_rows:
        yield Finding("error", str(path), "your own catalogue cannot be read and is left out")


def _bearing(row: Row) -> Iterator[Finding]:
    if row["ball_count"] is None:
        return
    where = f"bearing {row['designation']} {row['maker']}"
    count, ball, pitch = row["ball_count"], row["ball_diameter_mm"], row["pitch_diameter_mm"]
    filled, most = float(filling_angle(count, ball, pitch)), printed_of(row).filling[2]
    if filled > most:
        message = f"{count} balls of {ball:g} mm span {filled:.0f} deg: more than the {most:g} that can be filled in"
        yield Finding("warning", where, message)
    if row["geometry_grade"] not in ("A", "A-", "B"):
        return
    uprating = UPRATED if is_uprated(row["rating_type"]) else 1.0
    size, angle = (count, ball * 1e-3, pitch * 1e-3), math.radians(row["contact_angle_deg"] or 0.0)
    rows, on_sphere = rated_rows(row), printed_of(row).on_sphere
    computed = {
        "dynamic_rating": dynamic_rating(*size, contact_angle=angle, rows=rows, on_sphere=on_sphere) * uprating,
        "static_rating": static_rating(
            *size, contact_angle=angle, outer_conformity=0.52, rows=rows, on_sphere=on_sphere
        ),
    }
    for name, expected in computed.items():
        printed = row[f"{name}_kN"]
        if printed is not None and abs(expected / (printed * 1e3) - 1.0) > RATING_TOLERANCE:
            message = f"{name} {printed:g} kN is not the {expected * 1e-3:.4g} kN of the row's own geometry"
            yield Finding("warning", where, message)


def _references(catalogue: SqlCatalogue) -> Iterator[Finding]:
    known = known_names(catalogue.connection)
    for table in ("lubricant_property", "lubricant_parameter", "cage"):
        for row in rows_of(catalogue, table):
            for problem in reference_problems(table, row, known):
                yield Finding("error", f"{table} {row['name']}", problem)
    for row in rows_of(catalogue, "alias"):
        if not known.has(row["kind"], row["name"]):
            yield Finding(
                "error", f"alias {row['alias']}", f'stands for the {row["kind"]} "{row["name"]}", which is not there'
            )


def _clearances(rows: list[Row]) -> Iterator[Finding]:
    by_class: dict[str, list[Row]] = {}
    for row in rows:
        by_class.setdefault(row["clearance_class"], []).append(row)
    for name, limits in by_class.items():
        ordered = sorted(limits, key=lambda row: float(row["bore_over_mm"]))
        for lower, upper in itertools.pairwise(ordered):
            if lower["bore_to_mm"] > upper["bore_over_mm"]:
                message = f"the ranges to {lower['bore_to_mm']:g} mm and from {upper['bore_over_mm']:g} mm overlap"
                yield Finding("error", f"clearance {name}", message)


def _lubricants(catalogue: SqlCatalogue, models: Registry) -> Iterator[Finding]:
    for lubricant in catalogue.lubricants(limit=100_000):
        where = f"lubricant {lubricant.name}"
        has_rows = lubricant.rheology in lubricant.parameters.get("rheology", {})
        if not has_rows and list(_law(lubricant, "rheology", lubricant.rheology, models)):
            yield Finding("error", where, f"its rheology is {lubricant.rheology}, but it has no parameters for it")
        for role, laws in lubricant.parameters.items():
            for name in laws:
                yield from _law(lubricant, role, name, models)


def _law(lubricant: LubricantRow, role: str, name: str, models: Registry) -> Iterator[Finding]:
    where = f"lubricant {lubricant.name}"
    try:
        law = models.model(role, name)
        known = oil_data(law, lubricant, lubricant.parameters.get(role, {}).get(name, {}))
        law.parameters.model_validate({key: parameter.text() for key, parameter in known.items()})
    except ValidationError as error:
        for problem in error.errors():
            place = ".".join(map(str, problem["loc"]))
            yield Finding("error", where, f"{role} {name}: {place}: {problem['msg']}")
    except LambdaError as error:
        yield Finding("warning", where, f"has parameters for {role} {name}: {error}")

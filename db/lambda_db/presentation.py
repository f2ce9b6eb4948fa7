"""Show catalogue rows in engineers' units.

Each value has its source and grade.
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable, Sequence
from typing import Any, Literal, TypeVar

from pydantic import BaseModel

from lambda_core.catalogue.designation import designated, read_designation
from lambda_core.catalogue.other_kinds import other_kind
from lambda_core.catalogue.protocol import BearingRow, CageRow, Catalogue, LubricantRow, MaterialRow, RollerRow, Value
from lambda_core.catalogue.roller_designation import roller_designation
from lambda_core.domain.errors import CatalogueError, Problem, UsageError, nearest, unknown_name
from lambda_core.domain.units import from_si, parse
from lambda_core.elements.roller.roller_bearing import family_of
from lambda_core.elements.roller.roller_clearance import roller_clearance
from lambda_db.catalogue import SqlCatalogue
from lambda_db.search import COMPARISON
from lambda_db.units import PROPERTIES

AnyBearing = BearingRow | RollerRow

# Keys of a search -> the numbers of a row's summary
_KEYS = {
    "d": "bore_mm", "bore": "bore_mm", "D": "outside_mm", "outside": "outside_mm", "B": "width_mm", "width": "width_mm",
    "C": "C_kN", "C0": "C0_kN", "Z": "roller_count", "Dw": "roller_diameter_mm", "alpha": "contact_angle_deg",
}  # fmt: skip
_CLASSES = ("C2", "CN", "C3", "C4", "C5")

# Field of a row -> (quantity, unit) in which it is shown; the rest are plain numbers.
_SHOWN: dict[str, tuple[str, str]] = {
    **dict.fromkeys(
        (
            "bore_diameter",
            "outside_diameter",
            "width",
            "chamfer",
            "ball_diameter",
            "roller_diameter",
            "roller_length",
            "effective_length",
            "rib_height",
            "profile_length",
            "pitch_diameter",
            "race_diameter_inner",
            "race_diameter_outer",
            "groove_radius_inner",
            "groove_radius_outer",
            "shoulder_diameter_inner",
            "shoulder_diameter_outer",
            "row_distance",
        ),
        ("length", "mm"),
    ),
    **dict.fromkeys(("dynamic_rating", "static_rating", "fatigue_limit"), ("force", "kN")),
    **dict.fromkeys(("reference_speed", "limiting_speed"), ("rotational_speed", "rpm")),
    "mass": ("mass", "kg"),
    "contact_angle": ("angle", "deg"),
    "youngs_modulus": ("modulus", "GPa"),
    "density": ("density", "kg/m3"),
    "maximum_temperature": ("temperature", "degC"),
}
_UNIT_OF = {
    "density": "kg/m3",
    "thermal_expansion": "1e-6/K",
    "kinematic_viscosity": "mm2/s",
    "viscosity": "mPa s",
    "thermal_conductivity": "W/(m K)",
    "specific_heat": "J/(kg K)",
    "pressure_viscosity": "1/GPa",
    "temperature": "degC",
}


def _shown(name: str, value: float) -> tuple[float, str]:
    quantity = PROPERTIES.get(name, "")
    shown = _SHOWN.get(name) or ((quantity, _UNIT_OF[quantity]) if quantity else None)
    if shown is None:
        return value, ""
    # 12 digits: what was printed comes back without the last bit of the conversion
    return float(f"{from_si(value, *shown):.12g}"), shown[1]


def _entry(name: str, value: Value) -> dict[str, Any]:
    number, unit = _shown(name, value.value)
    return {
        "name": name,
        "value": int(number) if name in ("ball_count", "roller_count") else number,
        "unit": unit,
        "status": value.status,
        "grade": value.grade,
        "source": value.source,
    }


def values_of(row: BaseModel) -> list[dict[str, Any]]:
    """Return every value of a row with its source.

    Each value also has a unit, a status and a grade.
    """
    if isinstance(row, LubricantRow):
        return [_entry(name, value) for name, value in row.properties.items()]
    fields = ((name, getattr(row, name)) for name in type(row).model_fields)
    return [_entry(name, value) for name, value in fields if isinstance(value, Value)]


def texts_of(row: BaseModel) -> dict[str, str]:
    """Return name, guidance and note of a row."""
    return {name: getattr(row, name) for name in type(row).model_fields if isinstance(getattr(row, name), str)}


def parameters_of(row: LubricantRow) -> list[dict[str, Any]]:
    """Return every parameter of every law.

    Each is in the unit it was published in.
    """
    return [
        {"role": role, "model": model, "name": name, **parameter.model_dump()}
        for role, models in row.parameters.items()
        for model, parameters in models.items()
        for name, parameter in parameters.items()
    ]


def candidate_lines(row: AnyBearing) -> list[dict[str, Any]]:
    """Return candidate designs in mm and degrees; rollers have none."""
    if isinstance(row, RollerRow):
        return []
    return [
        {
            "ball_count": design.ball_count,
            "ball_diameter_mm": _shown("ball_diameter", design.ball_diameter)[0],
            "pitch_diameter_mm": _shown("pitch_diameter", design.pitch_diameter)[0],
            "score": design.score,
            "weight": design.weight,
            "filling_angle_deg": round(math.degrees(design.filling_angle), 2),
        }
        for design in row.candidates
    ]


def clearance_lines(catalogue: SqlCatalogue, row: AnyBearing) -> list[dict[str, Any]]:
    """Return the clearance classes of the bearing's bore.

    They are in um; only bearings of radial contact have any.
    """
    lines: list[dict[str, Any]] = []
    if row.contact_angle is not None:
        return lines
    for name in _CLASSES:
        try:
            ends, grade, source = _limits(catalogue, row, name)
        except (CatalogueError, ValueError):
            continue  # not every class goes to every bore
        low, high = (float(f"{1e6 * limit:.9g}") for limit in ends)
        lines.append({"class": name, "minimum_um": low, "maximum_um": high, "grade": grade, "source": source})
    return lines


def _limits(catalogue: SqlCatalogue, row: AnyBearing, name: str) -> tuple[tuple[float, float], str, str]:
    """Return a clearance class: limits [m], grade, source."""
    if isinstance(row, RollerRow):
        return roller_clearance(row.bore_diameter.value, name), "C", "ISO 5753-1:2009, as remembered"
    limits = catalogue.clearance(row.bore_diameter.value, name)
    return (limits.minimum, limits.maximum), limits.grade, limits.source


def rollers_found(catalogue: Catalogue, text: str) -> list[RollerRow]:
    """Return the roller bearings that match the words.

    Every word is a maker, a family, a kind or a series, a comparison such as "d=40", or a dimension; the others
    together begin the designation.
    """
    compared = [match.groups() for word in text.split() if (match := COMPARISON.match(word))]
    words = [word.upper() for word in text.split() if not COMPARISON.match(word)]
    return [row for row in catalogue.rollers() if _named(row, words) and all(_holds(row, *one) for one in compared)]


def _named(row: RollerRow, words: Sequence[str]) -> bool:
    """Tell whether the words name a roller bearing."""
    name = row.designation.upper().replace(" ", "")
    sizes = {f"{1e3 * size.value:.6g}" for size in (row.bore_diameter, row.outside_diameter, row.width)}
    known: set[str] = {row.maker.upper(), "ROLLER", "ROLLERS"}
    for more in (set(), {row.kind.upper(), family_of(row.kind).upper(), row.series.upper()}, sizes):
        known |= more
        if name.startswith("".join(word for word in words if word not in known)):
            return True
    return False


def _holds(row: RollerRow, key: str, sign: str, text: str) -> bool:
    """Tell whether a comparison holds."""
    summary = bearing_summary(row)
    if key in ("series", "maker", "grade"):
        return str(summary["geometry_grade" if key == "grade" else key]).casefold() == text.casefold()
    value, number = summary[_KEYS[key]], float(re.sub("[a-z]+$", "", text, flags=re.IGNORECASE))
    compare = {"=": operator.eq, "<": operator.lt, ">": operator.gt, "<=": operator.le, ">=": operator.ge}
    return value is not None and bool(compare[sign](value, number))


def bearing_summary(row: AnyBearing) -> dict[str, Any]:
    """Return one line of a list of bearings."""

    def number(name: str) -> float | None:
        value = getattr(row, name)
        return None if value is None else _shown(name, value.value)[0]

    design: Value | None
    if isinstance(row, RollerRow):
        design = row.roller_count
        own: dict[str, Any] = {
            "roller_count": int(row.roller_count.value),
            "roller_diameter_mm": number("roller_diameter"),
            "roller_length_mm": number("roller_length"),
        }
    else:
        design = row.ball_count
        own = {
            "ball_count": None if design is None else int(design.value),
            "ball_diameter_mm": number("ball_diameter"),
        }
    return {
        "designation": row.designation,
        "maker": row.maker,
        "series": row.series,
        "kind": row.kind,
        "contact_angle_deg": number("contact_angle"),
        "bore_mm": number("bore_diameter"),
        "outside_mm": number("outside_diameter"),
        "width_mm": number("width"),
        "C_kN": number("dynamic_rating"),
        "C0_kN": number("static_rating"),
        **own,
        "geometry_status": None if design is None else design.status,
        "geometry_grade": None if design is None else design.grade,
        "layer": row.layer,
    }


def kind_of(row: LubricantRow) -> str:
    """Return the kind of a lubricant for a list.

    It is its base stock, or grease.
    """
    return "grease" if "nlgi" in row.properties else row.base_type


def lubricant_summary(row: LubricantRow) -> dict[str, Any]:
    """Return one line of a list of lubricants."""

    def number(name: str) -> float | None:
        value = row.properties.get(name)
        return None if value is None else _shown(name, value.value)[0]

    return {
        "name": row.name,
        "base_type": row.base_type,
        "rheology": row.rheology,
        "nu40_mm2s": number("kinematic_viscosity_40"),
        "nu100_mm2s": number("kinematic_viscosity_100"),
        "alpha40_per_GPa": number("alpha_p_40"),
        "layer": row.layer,
        "note": row.note,
    }


def suffix_lines(catalogue: SqlCatalogue, name: str) -> list[dict[str, str]]:
    """Explain the suffixes of a bearing's designation.

    Each line says what a case takes from the suffix.
    """
    read = read_designation(name, catalogue.names("bearing"), catalogue.suffixes())
    return [
        {"suffix": written, "meaning": suffix.meaning, "decides": "" if suffix.kind == "note" else suffix.kind}
        for written, suffix in (read.suffixes if read else ())
    ]


def find(catalogue: SqlCatalogue, name: str, maker: str | None) -> AnyBearing | LubricantRow | MaterialRow | CageRow:
    """Find the row of a name.

    It is that of a bearing, otherwise of a lubricant, material or cage.

    Raises
    ------
    CatalogueError
        With the nearest names of all kinds, or with the makers to choose from.
    """
    bearings = catalogue.names("bearing")
    rollers = roller_designation(catalogue, name, maker)
    if rollers is not None:
        return rollers.row
    if maker is not None or read_designation(name, bearings, catalogue.suffixes()) is not None:
        return designated(catalogue, name, maker)[0]
    others: tuple[Callable[[str], LubricantRow | MaterialRow | CageRow], ...]
    others = (catalogue.lubricant, catalogue.material, catalogue.cage)
    for look_up in others:
        try:
            return look_up(name)
        except CatalogueError:
            continue
    before, _, last = " ".join(name.split()).rpartition(" ")
    makers = {row.maker.casefold() for row in catalogue.bearings("", 1_000_000)}
    if before.casefold() in makers:  # the maker is right: of its own bearings
        return catalogue.bearing(last, before)
    known = [
        *bearings,
        *(row.designation for row in catalogue.rollers()),
        *catalogue.names("lubricant"),
        *catalogue.names("material"),
        *catalogue.names("cage"),
    ]
    said = other_kind(name) or unknown_name("bearing, lubricant, material or cage", name, known)
    raise CatalogueError("catalogue", [Problem("name", said)])


Row = TypeVar("Row")


def found_some(catalogue: SqlCatalogue, kind: Literal["bearing", "lubricant"], text: str, rows: list[Row]) -> list[Row]:
    """Return the rows of a search.

    Raises
    ------
    CatalogueError
        Where there are none: with what the catalogue holds, and what reads like the search.
    """
    if rows:
        return rows
    if kind == "bearing" and (said := other_kind(text)):
        raise CatalogueError("search", [Problem("", said)])
    names = catalogue.names(kind)
    close = nearest(text.split()[-1], names) if text.split() else []
    hint = f"; nearest: {', '.join(close)}" if close else ""
    if kind == "bearing":
        makers = ", ".join(sorted({row.maker for row in catalogue.bearings("", 1_000_000)}))
        kinds = "deep groove, angular contact, four-point contact, double row and self-aligning"
        holds = f"{kinds} ball bearings of {makers}, cylindrical, needle and tapered roller bearings of one row, no "
        holds += "spherical, toroidal or thrust bearings; "
        holds += "oils and greases: --lubricants"
    else:
        greases = sum("nlgi" in row.properties for row in catalogue.lubricants("", 1_000_000))
        holds = f"{len(names) - greases} oils and {greases} greases"
    raise CatalogueError("search", [Problem("", f'nothing matches "{text}"{hint}; the catalogue holds {holds}')])


def parsed(texts: Sequence[str], quantity: str, option: str) -> list[float]:
    """Read unit strings of the command line as SI floats."""
    values = []
    for text in texts:
        try:
            values.append(parse(text, quantity))
        except ValueError as error:
            raise UsageError(f"{option}: {error}") from error
    return values

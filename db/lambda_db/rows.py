"""Convert table rows to the core's catalogue rows.

They hold SI values, each with its source, grade and status.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, Literal, cast

from lambda_core.catalogue.protocol import (
    BearingRow,
    CageRow,
    ClearanceRow,
    Design,
    LubricantRow,
    MaterialRow,
    Parameter,
    RollerRow,
    Value,
)
from lambda_core.catalogue.suffixes import Kind as SuffixKind
from lambda_core.catalogue.suffixes import Suffix
from lambda_core.domain.value_status import RowStatus
from lambda_db.units import PROPERTIES, bare_name, column_si, to_si

if TYPE_CHECKING:
    from lambda_db.models import (
        Bearing,
        Cage,
        Candidate,
        Clearance,
        Lubricant,
        LubricantParameter,
        LubricantProperty,
        Material,
    )
    from lambda_db.models import (
        Suffix as SuffixRow,
    )
    from lambda_db.roller_design import RollerDesign

Sources = Mapping[str, str]
Layer = Literal["core", "plugin", "user"]

# Group that carries source, grade and status -> its columns.
BEARING_GROUPS: dict[str, tuple[str, ...]] = {
    "dimensions": ("bore_diameter_mm", "outside_diameter_mm", "width_mm", "chamfer_mm"),
    "dynamic_rating": ("dynamic_rating_kN",),
    "static_rating": ("static_rating_kN", "fatigue_limit_kN"),
    "catalogue": ("reference_speed_rpm", "limiting_speed_rpm", "mass_kg"),
    "geometry": (
        "ball_count",
        "ball_diameter_mm",
        "pitch_diameter_mm",
        "race_diameter_inner_mm",
        "race_diameter_outer_mm",
    ),
    "groove": ("groove_radius_inner_mm", "groove_radius_outer_mm"),
    "shoulder": ("shoulder_diameter_inner_mm", "shoulder_diameter_outer_mm"),
    "angle": ("contact_angle_deg",),
    "row_distance": ("row_distance_mm",),
}


@cache
def _fields() -> tuple[tuple[str, str, tuple[str, str, str]], ...]:
    """Return (column, field, source, grade, status) of all values.

    Each column and field of a bearing with its source, grade and status; a search converts thousands.
    """
    return tuple(
        (column, bare_name(column), (f"{group}_source", f"{group}_grade", f"{group}_status"))
        for group, columns in BEARING_GROUPS.items()
        for column in columns
    )


def _value(cells: Mapping[str, Any], column: str, group: tuple[str, str, str], sources: Sources) -> Value | None:
    number = cells[column]
    if number is None:
        return None
    source, grade, status = group
    return Value(
        value=column_si(column, number),
        source=sources.get(cells[source], cells[source]),
        grade=cells[grade],
        status=cells.get(status) or "published",
    )


def bearing_row(row: Bearing, candidates: Iterable[Candidate], sources: Sources) -> BearingRow:
    """Convert one bearing with its ranked candidate designs."""
    cells = vars(row)
    values = {field: _value(cells, column, group, sources) for column, field, group in _fields()}
    designs = tuple(
        Design(
            ball_count=c.ball_count,
            ball_diameter=column_si("ball_diameter_mm", c.ball_diameter_mm),
            pitch_diameter=column_si("pitch_diameter_mm", c.pitch_diameter_mm),
            score=c.score,
            filling_angle=math.radians(c.filling_angle_deg),
            weight=c.weight,
        )
        for c in candidates
    )
    return BearingRow(
        designation=row.designation,
        maker=row.maker,
        series=row.series,
        rating_type=row.rating_type,
        kind=row.kind or "deep groove",
        candidates=designs,
        layer=cast(Layer, row.layer),
        **cast(dict[str, Any], values),
    )


# Columns of a roller bearing that share the source and grade of the catalogue, and those of the inner geometry.
_ROLLER_CATALOGUE = (
    *("bore_diameter_mm", "outside_diameter_mm", "width_mm"),
    *("dynamic_rating_kN", "static_rating_kN", "fatigue_limit_kN", "limiting_speed_rpm"),
)
_ROLLER_GEOMETRY = (
    *("roller_count", "roller_diameter_mm", "roller_length_mm", "effective_length_mm", "pitch_diameter_mm"),
    *("contact_angle_deg", "rib_height_mm", "profile_scale", "profile_length_mm"),
)


def roller_row(row: RollerDesign, sources: Sources) -> RollerRow:
    """Convert one roller bearing."""
    cells = vars(row)
    groups = (("catalogue", _ROLLER_CATALOGUE), ("geometry", _ROLLER_GEOMETRY))
    values = {
        bare_name(column): _value(cells, column, (f"{group}_source", f"{group}_grade", f"{group}_status"), sources)
        for group, columns in groups
        for column in columns
    }
    return RollerRow(
        designation=row.designation,
        maker=row.maker,
        series=row.series,
        kind=row.kind,
        layer=cast(Layer, row.layer),
        **cast(dict[str, Any], values),
    )


def clearance_row(row: Clearance, sources: Sources) -> ClearanceRow:
    """Convert the limits of one clearance class."""
    return ClearanceRow(
        clearance_class=row.clearance_class,
        minimum=column_si("minimum_um", row.minimum_um),
        maximum=column_si("maximum_um", row.maximum_um),
        source=sources.get(row.source, row.source),
        grade=row.grade,
    )


def material_row(row: Material, sources: Sources) -> MaterialRow:
    """Convert one material.

    Its source and grade hold for every value.
    """

    def value(column: str) -> Value:
        return Value(
            value=column_si(column, getattr(row, column)), source=sources.get(row.source, row.source), grade=row.grade
        )

    return MaterialRow(
        name=row.name,
        youngs_modulus=value("youngs_modulus_GPa"),
        poisson_ratio=value("poisson_ratio"),
        density=value("density_kg_m3"),
        thermal_conductivity=value("thermal_conductivity_W_mK"),
        specific_heat=value("specific_heat_J_kgK"),
        thermal_expansion=value("thermal_expansion_1e6_K"),
        permittivity=None if row.permittivity is None else value("permittivity"),
        note=row.note,
    )


def suffix(row: SuffixRow) -> Suffix:
    """Return a suffix of designations."""
    return Suffix(row.written, row.makers, cast("SuffixKind", row.kind), row.meaning, row.value, row.pattern)


def cage_row(row: Cage, sources: Sources) -> CageRow:
    """Convert one cage type."""

    def value(number: float) -> Value:
        return Value(
            value=number,
            source=sources.get(row.source, row.source),
            grade=row.grade,
            status=cast(RowStatus, row.status),
        )

    return CageRow(
        name=row.name,
        suffix=row.suffix,
        guidance=row.guidance,
        material=row.material,
        pocket_clearance_ratio=value(row.pocket_clearance_ratio),
        land_clearance_ratio=None if row.land_clearance_ratio is None else value(row.land_clearance_ratio),
        fill=value(row.fill),
        radial_ratio=value(row.radial_ratio),
        axial_ratio=value(row.axial_ratio),
        friction=None if row.friction is None else value(row.friction),
        maximum_temperature=_value(
            vars(row),
            "maximum_temperature_degC",
            ("temperature_source", "temperature_grade", "temperature_status"),
            sources,
        ),
        note=row.note,
    )


def lubricant_row(
    row: Lubricant,
    properties: Iterable[LubricantProperty],
    parameters: Iterable[LubricantParameter],
    sources: Sources,
) -> LubricantRow:
    """Convert one lubricant with properties and parameters.

    Properties are in SI, and the parameters of every law as published.
    """
    nested: dict[str, dict[str, dict[str, Parameter]]] = {}
    for p in parameters:
        nested.setdefault(p.role, {}).setdefault(p.model, {})[p.name] = Parameter(
            value=p.value,
            unit=p.unit,
            source=sources.get(p.source, p.source),
            grade=p.grade,
            status=cast(RowStatus | None, p.status),
        )
    return LubricantRow(
        name=row.name,
        base_type=row.base_type,
        rheology=row.rheology,
        properties={
            p.name: Value(
                value=to_si(p.value, p.unit, PROPERTIES.get(p.name)),
                source=sources.get(p.source, p.source),
                grade=p.grade,
                status=cast(RowStatus, p.status),
            )
            for p in properties
        },
        parameters=nested,
        note=row.note,
        layer=cast(Layer, row.layer),
    )

"""Test that impossible rows are refused, each with its reason."""

from __future__ import annotations

import pytest
from lambda_db.catalogue import SqlCatalogue
from lambda_db.models import Base
from lambda_db.seed_tables import SEED_TABLES
from lambda_db.transfer import add_row

from lambda_core.domain.errors import CatalogueError

BEARING: dict[str, object] = {
    "designation": "X1",
    "maker": "test",
    "bore_diameter": "40 mm",
    "outside_diameter": "80 mm",
    "width": "18 mm",
    "source": "test",
    "grade": "B",
}
DESIGN = {"ball_count": 9, "ball_diameter": "11.906 mm", "pitch_diameter": "60 mm", "geometry_status": "published"}
OIL = {"lubricant": "FVA3", "source": "test", "grade": "B"}
PROPERTY: dict[str, object] = OIL | {"name": "kinematic_viscosity_40", "value": 95, "unit": "mm2/s"}
PARAMETER: dict[str, object] = OIL | {"role": "rheology", "model": "mine", "name": "x", "value": 1.0}

BAD_BEARINGS = [
    ({"outside_diameter": "30 mm"}, "outside_diameter_mm must be larger than bore_diameter_mm"),
    ({"bore_diameter": "-40 mm"}, "bore_diameter_mm must be positive"),
    ({"width": "0 mm"}, "width_mm must be positive"),
    ({"chamfer": "9.5 mm"}, "two chamfers must fit"),
    ({"dynamic_rating": "-29 kN"}, "dynamic_rating_kN must be positive"),
    ({"mass": "0 kg"}, "mass_kg must be positive"),
    (DESIGN | {"ball_count": 16}, "too many balls"),
    (DESIGN | {"ball_count": 2}, "at least 3"),
    (DESIGN | {"ball_count": 9.5}, "is not a whole number"),
    (DESIGN | {"ball_count": 5, "ball_diameter": "21 mm"}, "must lie between bore and outside"),
    (DESIGN | {"pitch_diameter": None}, "go together"),
    (DESIGN | {"race_diameter_inner": "48 mm", "race_diameter_outer": "75 mm"}, "two ball diameters within 5 %"),
    (DESIGN | {"race_diameter_inner": "39 mm", "race_diameter_outer": "63 mm"}, "bore < inner race"),
    (DESIGN | {"groove_radius_inner": "5.9 mm", "groove_radius_outer": "6.3 mm"}, "larger than the ball's radius"),
    ({"shoulder_diameter_inner": "70 mm", "shoulder_diameter_outer": "50 mm"}, "inner shoulder < outer shoulder"),
    ({"grade": "Z"}, "dimensions_grade must be one of A, A-, B, B-, C, D"),
    (DESIGN | {"geometry_status": "guessed"}, "geometry_status must be one of published, measured, derived, assumed"),
    ({"designation": " "}, "designation: a value is required"),
    ({"maker": None}, "maker: a value is required"),
    ({"bore_diameter": "40 kg"}, "kg is not a unit of length"),
    ({"bore_diameter": "40,5 mm"}, 'write a decimal point: "40.5 mm"'),
    ({"bore_diameter": 40}, 'has no unit: write bore_diameter_mm = 40 or bore_diameter = "40 mm"'),
    ({"bore_diameter": "nan mm"}, "is not a number with a unit"),
    ({"width": "inf"}, "is not a finite number"),
    ({"boredom": "40 mm"}, '"boredom" is not a column of bearing; nearest: bore'),
    ({"bore_diameter_mm": 40}, "bore_diameter_mm is given twice"),
]


@pytest.mark.parametrize(("change", "reason"), BAD_BEARINGS, ids=[reason[:30] for _, reason in BAD_BEARINGS])
def test_bad_bearings(catalogue: SqlCatalogue, change: dict[str, object], reason: str) -> None:
    cells = {name: value for name, value in (BEARING | change).items() if value is not None}
    with pytest.raises(CatalogueError) as error:
        add_row(catalogue, "bearing", cells)
    assert reason in str(error.value)
    with pytest.raises(CatalogueError, match="is not a known bearing"):
        catalogue.bearing("X1")


def test_a_value_without_its_unit_is_not_missing_too(catalogue: SqlCatalogue) -> None:
    with pytest.raises(CatalogueError) as error:
        add_row(catalogue, "bearing", {**BEARING, "bore_diameter": 40, "width": "18"})
    assert [one.message.partition(":")[0] for one in error.value.problems] == ["bore_diameter", "width"]


def test_a_value_needs_its_source(catalogue: SqlCatalogue) -> None:
    cells = {k: v for k, v in BEARING.items() if k not in ("source", "grade")}
    cells |= {"dimensions_source": "test", "dimensions_grade": "B", "dynamic_rating": "29 kN"}
    with pytest.raises(CatalogueError, match="a value needs dynamic_rating_source and dynamic_rating_grade"):
        add_row(catalogue, "bearing", cells)


OTHERS: list[tuple[str, dict[str, object], str]] = [
    ("lubricant_property", PROPERTY | {"value": -95}, "a viscosity must be positive"),
    ("lubricant_property", PROPERTY | {"unit": "mPa s"}, '"mPa s" is not a unit of kinematic_viscosity'),
    ("lubricant_property", PROPERTY | {"unit": ""}, "has no unit; allowed: mm2/s"),
    ("lubricant_property", PROPERTY | {"name": "permittivity", "value": 0.5, "unit": ""}, "at least 1"),
    (
        "lubricant_property",
        PROPERTY | {"name": "density_15", "value": 0, "unit": "kg/m3"},
        "a density must be positive",
    ),
    ("lubricant_property", PROPERTY | {"lubricant": "FVA33"}, '"FVA33" is not a known lubricant; nearest: FVA3'),
    ("lubricant_property", PROPERTY | {"value": ""}, "value: a value is required"),
    (
        "lubricant_parameter",
        PARAMETER | {"name": "alpha_p", "value": -2, "unit": "1/GPa"},
        "a alpha_p must be positive",
    ),
    ("lubricant_parameter", PARAMETER | {"unit": "furlong"}, '"furlong" is not a unit; known:'),
    ("lubricant_parameter", PARAMETER | {"grade": ""}, "grade: a value is required"),
    ("material", {"name": "m", "poisson_ratio": 0.6}, "youngs_modulus_GPa: a value is required"),
    (
        "material",
        {
            "name": "m",
            "youngs_modulus": "210 GPa",
            "poisson_ratio": 0.6,
            "density_kg_m3": 7800,
            "thermal_conductivity_W_mK": 40,
            "specific_heat_J_kgK": 460,
            "thermal_expansion_1e6_K": 12,
            "source": "test",
            "grade": "C",
        },
        "poisson_ratio must lie between 0 and 0.5",
    ),
    (
        "clearance",
        {
            "clearance_class": "CX",
            "bore_over_mm": 30,
            "bore_to_mm": 40,
            "minimum_um": 20,
            "maximum_um": 6,
            "source": "test",
            "grade": "C",
        },
        "0 <= minimum_um < maximum_um",
    ),
    ("alias", {"kind": "gear", "alias": "a", "name": "b"}, "kind must be one of lubricant, material, cage"),
]


@pytest.mark.parametrize(("table", "cells", "reason"), OTHERS, ids=[reason[:30] for *_, reason in OTHERS])
def test_bad_rows_of_other_tables(catalogue: SqlCatalogue, table: str, cells: dict[str, object], reason: str) -> None:
    with pytest.raises(CatalogueError) as error:
        add_row(catalogue, table, cells)
    assert reason in str(error.value)


def test_tables_are_strict_and_constraints_named(catalogue: SqlCatalogue) -> None:
    for name in SEED_TABLES:
        sql = catalogue.connection.exec_driver_sql(
            "SELECT sql FROM main.sqlite_master WHERE name = ?", (name,)
        ).scalar_one()
        assert sql.rstrip().endswith("STRICT")
    checks = [c for table in Base.metadata.tables.values() for c in table.constraints if "sentence" in c.info]
    assert len(checks) > 60
    assert all(c.name for c in checks)


def test_the_core_database_takes_no_writes(catalogue: SqlCatalogue) -> None:
    from sqlalchemy.exc import OperationalError

    with pytest.raises(OperationalError, match="readonly"):
        catalogue.connection.exec_driver_sql("DELETE FROM main.bearing")
    assert catalogue.bearing("6208", "SKF")

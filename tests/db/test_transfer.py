"""Test import and export.

A round trip is exact, one bad row rolls back or is left out, as asked.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lambda_db.catalogue import SqlCatalogue, open_catalogue
from lambda_db.seed_tables import SEED_TABLES
from lambda_db.transfer import add_row, export_rows, import_path, rows_of

from lambda_core.domain.errors import CatalogueError, UsageError

if TYPE_CHECKING:
    from conftest import Meanwhile

TABLES = list(SEED_TABLES)
SMALL = [table for table in TABLES if table != "bearing"]
HEADER = "designation,maker,bore_diameter_mm,outside_diameter_mm,width_mm,dimensions_source,dimensions_grade\n"
GOOD = "X1,test,40,80,18,test,B\nX2,test,0.1,80.30000000000001,18,test,A-\n"
BAD = "X3,test,40,30,18,test,B\n,test,40,80,18,test,B\nX4,test,40 kN,80,18,test,B\nX5,test,40,80\n"


# All bearings as TOML take ten seconds; the test below takes some of them.
@pytest.mark.parametrize(
    ("target", "tables"),
    [
        pytest.param("all", TABLES, marks=pytest.mark.full),
        ("most.toml", SMALL),
        pytest.param("all.toml", TABLES, marks=pytest.mark.slow),
    ],
    ids=["all", "most.toml", "all.toml"],
)
def test_everything_makes_the_round_trip(
    catalogue: SqlCatalogue, tmp_path: Path, target: str, tables: list[str]
) -> None:
    before = {table: rows_of(catalogue, table) for table in tables}
    counts = export_rows(catalogue, tmp_path / target, tables)
    assert counts == {table: len(rows) for table, rows in before.items()}
    report = import_path(catalogue, tmp_path / target)
    assert report.added == counts
    assert {table: rows_of(catalogue, table, mine=True) for table in tables} == before
    assert {table: rows_of(catalogue, table) for table in tables} == before
    export_rows(catalogue, tmp_path / f"again-{target}", tables, mine=True)
    for path in (tmp_path / target).iterdir() if target == "all" else [tmp_path / target]:
        again = tmp_path / f"again-{target}" / path.name if target == "all" else tmp_path / f"again-{target}"
        assert again.read_bytes() == path.read_bytes()


def test_bearings_make_the_round_trip_as_toml(catalogue: SqlCatalogue, tmp_path: Path) -> None:
    some = rows_of(catalogue, "bearing")[::25]
    for row in some:
        add_row(catalogue, "bearing", {name: value for name, value in row.items() if value is not None})
    assert export_rows(catalogue, tmp_path / "some.toml", ["bearing"], mine=True) == {"bearing": len(some)}
    assert import_path(catalogue, tmp_path / "some.toml", replace=True).replaced == {"bearing": len(some)}
    assert rows_of(catalogue, "bearing", mine=True) == some
    export_rows(catalogue, tmp_path / "again.toml", ["bearing"], mine=True)
    assert (tmp_path / "again.toml").read_bytes() == (tmp_path / "some.toml").read_bytes()


def test_an_export_holds_what_one_moment_held(catalogue: SqlCatalogue, meanwhile: Meanwhile, tmp_path: Path) -> None:
    """Add an oil while the catalogue is exported.

    It comes after the oils and before their constants were read, so both are left out.
    """
    add_row(catalogue, "lubricant", {"name": "mine", "base_type": "PAO", "rheology": "roelands"})
    other = open_catalogue()
    with meanwhile(" FROM user.lubricant_parameter ORDER", lambda: add_oil(other)):
        counts = export_rows(catalogue, tmp_path / "mine.toml", TABLES, mine=True)
    assert (counts["lubricant"], counts["lubricant_parameter"]) == (1, 0)
    assert rows_of(catalogue, "lubricant_parameter", mine=True)
    other.close()


def add_oil(catalogue: SqlCatalogue) -> None:
    """Add an oil and a constant of it."""
    add_row(catalogue, "lubricant", {"name": "late", "base_type": "PAO", "rheology": "roelands"})
    constant = {"lubricant": "late", "role": "traction", "model": "my-law", "name": "k", "value": 3.5, "unit": ""}
    add_row(catalogue, "lubricant_parameter", constant | {"source": "own test", "grade": "B"})


@settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    name=st.text(st.characters(exclude_categories=["Cs", "Cc"]), min_size=1, max_size=20).filter(str.strip),
    note=st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\x00\r"), max_size=40),
    value=st.floats(1e-300, 1e300),
    suffix=st.sampled_from([".csv", ".toml"]),
)
def test_any_text_and_number_makes_the_round_trip(
    catalogue: SqlCatalogue, tmp_path: Path, name: str, note: str, value: float, suffix: str
) -> None:
    material = {
        "name": name,
        "youngs_modulus_GPa": value,
        "poisson_ratio": 0.3,
        "density_kg_m3": value,
        "thermal_conductivity_W_mK": value,
        "specific_heat_J_kgK": value,
        "thermal_expansion_1e6_K": -value,
        "source": "test, with a comma",
        "grade": "C",
        "note": note,
    }
    add_row(catalogue, "material", material, replace=True)
    path = tmp_path / f"material{suffix}"
    export_rows(catalogue, path, ["material"], mine=True)
    before = rows_of(catalogue, "material", mine=True)
    import_path(catalogue, path, replace=True)
    assert rows_of(catalogue, "material", mine=True) == before
    assert any(row["density_kg_m3"] == value and row["note"] == note.strip() for row in before)


def test_one_bad_row_rolls_everything_back(catalogue: SqlCatalogue, tmp_path: Path) -> None:
    path = tmp_path / "bearing.csv"
    path.write_text(HEADER + GOOD + BAD.rsplit("X5", 1)[0], encoding="utf-8")
    with pytest.raises(CatalogueError) as error:
        import_path(catalogue, path)
    message = str(error.value)
    assert "bearing.csv line 4" in message
    assert "outside_over_bore" in message
    assert "designation: a value is required" in message
    assert "kN is not a unit of length" in message
    assert "nothing was written; --keep-good takes the 2 good rows" in message
    assert rows_of(catalogue, "bearing", mine=True) == []


def test_good_rows_are_kept_when_asked(catalogue: SqlCatalogue, tmp_path: Path) -> None:
    path = tmp_path / "bearing.csv"
    path.write_text(HEADER + GOOD + BAD.rsplit("X5", 1)[0], encoding="utf-8")
    report = import_path(catalogue, path, keep_good=True)
    assert report.added == {"bearing": 2}
    assert [problem.where for problem in report.refused] == [f"bearing.csv line {n}" for n in (5, 6, 4)]
    assert catalogue.bearing("X2").outside_diameter.value == 80.30000000000001 * 1e-3
    assert catalogue.bearing("X2").bore_diameter.grade == "A-"


def test_rows_that_name_each_other_come_in_one_file(catalogue: SqlCatalogue, tmp_path: Path) -> None:
    path = tmp_path / "oil.toml"
    path.write_text(
        """
[[lubricant_parameter]]
lubricant = "my-oil"
role = "traction"
model = "ree-eyring"
name = "tau_eyring"
value = 7.5
unit = "MPa"
source = "own test rig"
grade = "B"

[[lubricant]]
name = "my-oil"
base_type = "ester"
rheology = "roelands"
""",
        encoding="utf-8",
    )
    import_path(catalogue, path)
    oil = catalogue.lubricant("MY-OIL")
    assert oil.layer == "user"
    assert oil.parameters["traction"]["ree-eyring"]["tau_eyring"].text() == "7.5 MPa"


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("bearing.csv", "", "header .* is missing"),
        ("bearing.csv", HEADER + "X5,test,40,80\n", "line 2 .*needs 7 cells like the header"),
        ("bearing.csv", "designation,designation\nA,B\n", "names a column twice"),
        ("bearings.csv", HEADER + GOOD, '"bearings" is not a known catalogue table; nearest: bearing'),
        ("rows.toml", "[[bearings]]\nmaker = 'x'\n", "nearest: bearing"),
        ("rows.toml", "[bearing]\nmaker = 'x'\n", "must be an array of tables"),
        ("rows.toml", "bearing = = 3", "cannot be read as TOML"),
        ("rows.xls", "", "must be a .csv file, a .toml file"),
        ("bearing.csv", "designation\n\udcff\n", "cannot be read as CSV"),
    ],
)
def test_files_that_cannot_be_read(
    catalogue: SqlCatalogue, tmp_path: Path, name: str, content: str, message: str
) -> None:
    path = tmp_path / name
    path.write_bytes(content.encode("utf-8", errors="surrogateescape"))
    with pytest.raises(CatalogueError, match=f"(?s){message}"):
        import_path(catalogue, path)


def test_paths_that_cannot_be_used(catalogue: SqlCatalogue, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="does not exist"):
        import_path(catalogue, tmp_path / "nowhere.csv")
    with pytest.raises(UsageError, match="a CSV file holds one table"):
        export_rows(catalogue, tmp_path / "all.csv", TABLES)
    with pytest.raises(UsageError, match="is not a known catalogue table"):
        export_rows(catalogue, tmp_path / "x.csv", ["bering"])
    with pytest.raises(UsageError, match="export to a"):
        export_rows(catalogue, tmp_path / "x.xls", ["bearing"])
    with pytest.raises(UsageError, match="cannot be written"):
        export_rows(catalogue, tmp_path / "nowhere" / "x.csv", ["bearing"])


def test_unit_strings_convert(catalogue: SqlCatalogue) -> None:
    cells = {
        "designation": "U",
        "maker": "t",
        "bore_diameter": "4 cm",
        "outside_diameter_mm": "80 mm",
        "width": "18000 um",
    }
    add_row(catalogue, "bearing", cells | {"source": "t", "grade": "B"})
    (row,) = rows_of(catalogue, "bearing", mine=True)
    assert math.isclose(row["bore_diameter_mm"], 40.0, rel_tol=1e-15)
    assert row["outside_diameter_mm"] == 80.0
    assert math.isclose(row["width_mm"], 18.0, rel_tol=1e-15)


def test_columns_convert_as_unit_strings_do() -> None:
    from lambda_db.units import column_si, column_unit

    from lambda_core.domain.units import parse

    for column in (
        "bore_diameter_mm",
        "minimum_um",
        "dynamic_rating_kN",
        "limiting_speed_rpm",
        "maximum_temperature_degC",
    ):
        unit = column_unit(column)
        assert unit is not None
        for number in (48.083, 0.1, 120.0, 1e-7):
            assert column_si(column, number) == parse(f"{number!r} {unit[1]}", unit[0])

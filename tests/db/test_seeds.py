"""Test the built-in rows.

The paper's tables exactly, makers apart, a source and a grade for every value.
"""

from __future__ import annotations

import csv

import pytest
from lambda_db.built import BUILT_IN
from lambda_db.catalogue import SqlCatalogue
from lambda_db.constraints import GRADES
from lambda_db.derive import candidates, grade_of
from lambda_db.estimate import printed_of
from lambda_db.records import parse_row
from lambda_db.transfer import rows_of

from lambda_core.catalogue.protocol import BearingRow, Value

MM = 1e-3


def mm(row: BearingRow, name: str) -> float:
    value = getattr(row, name)
    assert value is not None
    return float(f"{value.value / MM:.12g}")


# Syla et al. 2026, Table 6 (6208) and Table 3 (6319), as printed: exact
@pytest.mark.parametrize(
    ("designation", "printed"),
    [
        (
            "6208",
            {
                "outside_diameter": 80,
                "bore_diameter": 40,
                "pitch_diameter": 60,
                "race_diameter_inner": 48.083,
                "race_diameter_outer": 71.917,
                "ball_diameter": 11.91,
                "groove_radius_inner": 6.19,
                "groove_radius_outer": 6.31,
            },
        ),
        (
            "6319",
            {
                "outside_diameter": 200,
                "bore_diameter": 95,
                "pitch_diameter": 147.5,
                "race_diameter_inner": 117.4,
                "race_diameter_outer": 177.5,
                "ball_diameter": 30,
                "groove_radius_inner": 15.375,
                "groove_radius_outer": 15.75,
            },
        ),
    ],
)
def test_the_papers_bearings_are_its_tables(
    catalogue: SqlCatalogue, designation: str, printed: dict[str, float]
) -> None:
    row = catalogue.bearing(designation, "Syla2026")
    assert {name: mm(row, name) for name in printed} == printed
    assert row.ball_count is not None
    assert row.ball_count.value == 9
    for name in printed:
        assert getattr(row, name).status == "published"
        assert getattr(row, name).grade == "A"
    assert row.candidates == ()


def test_only_what_the_paper_prints_counts_as_published(catalogue: SqlCatalogue) -> None:
    row = catalogue.bearing("6319", "Syla2026")
    assert row.dynamic_rating is not None
    assert row.static_rating is not None
    assert (row.dynamic_rating.value, row.dynamic_rating.status) == (160e3, "published")
    assert row.static_rating.status == "derived"
    assert "not ISO 281" in row.rating_type
    computed = catalogue.bearing("6208", "Syla2026").dynamic_rating
    assert computed is not None
    assert computed.status == "derived"


def test_makers_of_6208_differ(catalogue: SqlCatalogue) -> None:
    skf, nsk = catalogue.bearing("6208", "SKF"), catalogue.bearing("6208", "NSK")
    assert skf.dynamic_rating is not None
    assert nsk.dynamic_rating is not None
    assert (skf.dynamic_rating.value, nsk.dynamic_rating.value) == (32.5e3, 29.1e3)
    assert (mm(skf, "ball_diameter"), mm(nsk, "ball_diameter")) == (12.303, 11.906)


def test_clearance_of_40_mm(catalogue: SqlCatalogue) -> None:
    limits = catalogue.clearance(0.040, "CN")
    assert (limits.minimum, limits.maximum) == pytest.approx((6e-6, 20e-6), rel=1e-12)
    above = catalogue.clearance(0.0400001, "CN")
    assert (above.minimum, above.maximum) == pytest.approx((6e-6, 23e-6), rel=1e-12)


def test_6220_for_the_stability_map(catalogue: SqlCatalogue) -> None:
    row = catalogue.bearing("6220", "SKF")
    assert row.ball_count is not None
    assert (row.ball_count.value, mm(row, "ball_diameter"), mm(row, "pitch_diameter")) == (10, 25.4, 140)
    assert row.ball_count.status == "derived"
    assert row.ball_count.grade == "B"


def test_every_value_has_a_source_and_a_grade(catalogue: SqlCatalogue) -> None:
    rows = catalogue.bearings(limit=10_000)
    assert len(rows) == 751
    values: list[Value] = []
    for row in [
        *rows,
        *(catalogue.material(name) for name in catalogue.names("material")),
        *(catalogue.cage(name) for name in catalogue.names("cage")),
    ]:
        values += [value for _, value in row if isinstance(value, Value)]
    for oil in catalogue.lubricants(limit=1000):
        values += oil.properties.values()
        for models in oil.parameters.values():
            for parameters in models.values():
                for parameter in parameters.values():
                    assert " " in parameter.source
                    assert parameter.grade in GRADES
    assert len(values) > 4000
    for value in values:
        assert " " in value.source, "a key of the source table was left unresolved"
        assert value.grade in GRADES
        assert value.grade != "D"


def test_every_source_is_used_and_every_key_known() -> None:
    with (BUILT_IN / "source.csv").open(encoding="utf-8") as stream:
        keys = {row["key"] for row in csv.DictReader(stream)}
    used: set[str] = {"conformity-assumed"}
    for path in BUILT_IN.glob("*.csv"):
        with path.open(encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                used |= {cell for name, cell in row.items() if name.endswith("source") and cell}
    assert used == keys


def test_derived_rows_are_what_the_derivation_supports(catalogue: SqlCatalogue) -> None:
    """Find each stored estimate among its ranked candidates.

    Its grade is at most that of the derivation.
    """
    derived = 0
    for cells in rows_of(catalogue, "bearing"):
        row, problems = parse_row("bearing", cells)
        assert problems == []
        if row["geometry_status"] == "published":
            continue
        printed = printed_of(row)
        ranked = candidates(printed)
        if row["ball_count"] is None:
            assert not ranked or grade_of(printed, ranked, ranked[0]) == "D", row["designation"]
            continue
        derived += 1
        (design,) = (
            c for c in ranked if (c.ball_count, c.ball_diameter) == (row["ball_count"], row["ball_diameter_mm"])
        )
        supported = grade_of(printed, ranked, design)
        assert row["geometry_grade"] in {"B": ("B", "C"), "C": ("C",)}[supported], row["designation"]
    assert derived == 719


def test_estimates_carry_their_candidates(catalogue: SqlCatalogue) -> None:
    for row in catalogue.bearings(limit=10_000):
        if row.ball_count is not None and row.ball_count.status == "derived":
            assert row.candidates
            assert sum(design.weight for design in row.candidates) == pytest.approx(1.0, abs=1e-5)
            scores = [design.score for design in row.candidates]
            assert scores == sorted(scores)
        elif row.ball_count is not None:
            assert row.candidates == ()

"""Test that docs/catalogue.md agrees with the code."""

from __future__ import annotations

from pathlib import Path

from lambda_db.catalogue import SqlCatalogue
from lambda_db.constraints import GRADES
from lambda_db.transfer import rows_of
from lambda_db.validation import table, trials

TEXT = (Path(__file__).parents[2] / "docs" / "catalogue.md").read_text(encoding="utf-8")


def test_the_table_of_trials_is_the_computed_one(catalogue: SqlCatalogue) -> None:
    assert table(catalogue) in TEXT


def test_the_counts_are_the_computed_ones(catalogue: SqlCatalogue) -> None:
    rows = rows_of(catalogue, "bearing")
    without = sum(row["ball_count"] is None for row in rows)
    assert f"({without} of {len(rows)}, " in TEXT
    assert f"{sum(row['geometry_status'] == 'derived' for row in rows)} rows carry an estimate" in TEXT
    found = trials(catalogue)
    others = [trial for trial in found if not trial.same_maker]
    assert f"{sum(trial.found for trial in others)} of {len(others)} do" in TEXT
    assert sum(trial.found for trial in found if trial.same_maker) == 3


def test_every_grade_in_use_is_explained(catalogue: SqlCatalogue) -> None:
    used = {value for row in rows_of(catalogue, "bearing") for name, value in row.items() if name.endswith("_grade")}
    assert used - {None} <= set(GRADES)
    for grade in GRADES:
        assert f"{grade}" in TEXT

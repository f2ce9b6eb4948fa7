"""Test the comparison of solver tables between versions."""

from __future__ import annotations

from benchmarks.case_tables import cases
from benchmarks.case_tables_worker import tables_of
from lambda_core import api


def test_every_eighth_case_is_still_valid() -> None:
    """Resolve case files of an earlier version.

    A refused case would prove nothing.
    """
    found = cases()
    assert len(found) == len({case["name"] for case in found}) == 200
    for case in found[::8]:
        api.check(case)


def test_the_cases_hold_every_kind_of_bearing() -> None:
    """Find bearings of the catalogue and of own geometry."""
    kinds = {api.check(case).geometry.kind.name for case in cases()[:60]}
    assert kinds == {"deep groove", "angular contact", "four-point", "double row", "self-aligning"}


def test_another_number_is_another_table() -> None:
    """Repeat one case, then change its load.

    The same case has the same hashes; a larger load changes only the terms.
    """
    case = {
        "name": "one",
        "bearing": {"designation": "SKF 6208"},
        "lubricant": {"name": "FVA3", "temperature": "70 degC"},
        "operation": {"speed": "3000 rpm"},
        "loads": {"radial": "2 kN"},
    }
    before, again = tables_of(case), tables_of(case)
    assert before == again
    after = tables_of(case | {"loads": {"radial": "3 kN"}})
    changed = {name for name in before if before[name] != after[name]}
    assert "terms" in changed
    assert "raceways" not in changed

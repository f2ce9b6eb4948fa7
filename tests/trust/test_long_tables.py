"""Test long tables and sums of time functions.

Quick, or refused with a limit that is stated.
"""

from __future__ import annotations

import time
import tomllib
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.case.case_writer import standalone_toml, tables_toml
from lambda_core.domain.errors import CaseError, Problem, UsageError
from lambda_core.model.checking import check_bearing

CASE = "6208-axial-1300"

MOST = 60.0  # of the processor, on the slowest machine; time with the square was minutes on a quick one [s]


def case_with(signal: dict[str, Any], folder: Path) -> Path:
    """Write a case with this force on its inner ring."""
    tables = tomllib.loads(api.init_case("long", CASE, folder / "case.toml").read_text(encoding="utf-8"))
    tables["loads"]["inner_ring"] = {"force_x": signal}
    path = folder / "long.toml"
    path.write_text(tables_toml(tables), encoding="utf-8")
    return path


def points(count: int) -> list[list[str]]:
    return [[f"{0.1 * number:.6g} ms", f"{100 + number % 7} N"] for number in range(count)]


@pytest.mark.full
def test_c3_a_long_table_is_checked_in_seconds(tmp_path: Path) -> None:
    """Check 20 000 points in seconds.

    They are in the case itself; time with the square of the number was minutes.
    """
    path = case_with({"kind": "table", "points": points(20_000)}, tmp_path)
    start = time.process_time()
    model = check_bearing(api.case(path))
    assert time.process_time() - start < MOST
    assert tomllib.loads(model.case_toml)["loads"]["inner_ring"]["force_x"]["points"][-1] == ["1.9999 s", "100 N"]


@pytest.mark.full
@pytest.mark.parametrize(
    ("signal", "words"),
    [
        ({"kind": "sum", "terms": ["1 N"] * 20_000}, "20000 terms, at most 1000"),
        ({"kind": "table", "points": points(100_001)}, "100001 points, at most 100000"),
    ],
)
def test_c3_what_is_too_long_is_refused_with_its_limit(signal: dict[str, Any], words: str, tmp_path: Path) -> None:
    path = case_with(signal, tmp_path)
    start = time.process_time()
    with pytest.raises(CaseError, match=words) as caught:
        api.check(path)
    assert time.process_time() - start < MOST
    assert [problem.where for problem in caught.value.problems] == ["loads.inner_ring.force_x"]


def test_lists_are_written_as_toml_reads_them(tmp_path: Path) -> None:
    texts = ['a "quoted" \\ text', "tab\tand line\n", "\x7f \u20ac", ""]
    terms: list[Any] = ["1 N", {"kind": "table", "points": points(3)}]
    case = api.case(case_with({"kind": "sum", "terms": terms}, tmp_path)).with_(assumptions=texts)
    found = tomllib.loads(standalone_toml(case))
    assert found["assumptions"] == texts
    assert found["loads"]["inner_ring"]["force_x"]["terms"] == [
        "1 N", {"kind": "table", "points": [["0 s", "100 N"], ["0.1 ms", "101 N"], ["0.2 ms", "102 N"]]}
    ]  # fmt: skip


def test_a_name_with_a_nul_is_refused_in_a_sentence(tmp_path: Path) -> None:
    table = {"kind": "table", "file": "loads\0.csv"}
    with pytest.raises(CaseError, match="no name of a file holds a NUL character"):
        api.check(case_with(table, tmp_path))
    with pytest.raises(UsageError, match="NUL"):
        api.run(CASE, ["solver.duration=1 ms"], out="r\0.h5")


def test_of_many_problems_the_first_are_printed_and_the_rest_counted() -> None:
    found = CaseError("case many", [Problem(f"place {number}", "is wrong") for number in range(20_000)])
    lines = str(found).splitlines()
    assert (lines[0], lines[-1]) == ("case many: 20000 errors", "  and 19980 more")
    assert len(lines) == 22
    assert len(found.problems) == 20_000

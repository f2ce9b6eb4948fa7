"""Test tables, targets, the page and the command.

What a benchmark hands over arrives unharmed.
"""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import pytest

from benchmarks import performance, scaling, timing
from benchmarks.__main__ import main
from benchmarks.performance import BEGIN, END, Report
from benchmarks.tables import Section, Table, Target, as_markdown, as_text, number


def report() -> Report:
    table = Table("Times", ("part", "us"), (("right-hand side", 31.25), ("solve", None)), ("A note.",))
    targets = (Target("wall", "s/s", 0.7, 1.0, 0.5), Target("faster", "times", math.nan, 1.3, 3.0, at_least=True))
    section = Section("parts", (table,), targets, load=2.0)
    machine = dict.fromkeys(("date", "processor", "system", "versions"), "x")
    return Report(machine, "wall", True, 1.0, [section])


@pytest.mark.parametrize(
    ("target", "verdict"),
    [
        (Target("t", "s", 0.4, 1.0, 0.5), "goal"),
        (Target("t", "s", 0.7, 1.0, 0.5), "must"),
        (Target("t", "s", 1.1, 1.0, 0.5), "missed"),
        (Target("t", "s", math.inf, 1.0, 0.5), "missed"),
        (Target("t", "times", 2.0, 1.3, 3.0, at_least=True), "must"),
        (Target("t", "times", 3.5, 1.3, 3.0, at_least=True), "goal"),
        (Target("t", "times", math.nan, 1.3, 3.0, at_least=True), "missed"),
    ],
)
def test_a_target_says_which_limit_was_met(target: Target, verdict: str) -> None:
    assert target.verdict == verdict


def test_three_significant_digits() -> None:
    assert [number(v) for v in (31.254, 0.01234, 1234.5, 2.5e-7, 0.0, 7, None, "yes")] == [
        "31.3",
        "0.0123",
        "1234",
        "2.5e-07",
        "0",
        "7",
        "-",
        "yes",
    ]


def test_tables_keep_every_cell() -> None:
    table = report().sections[0].tables[0]
    for text in (as_text(table), as_markdown(table)):
        for cell in ("right-hand side", "31.2", "solve", "A note."):
            assert cell in text


def test_json_has_null_for_what_is_no_number() -> None:
    data = json.loads(json.dumps(report().data(), allow_nan=False))
    assert [t["reached"] for t in data["targets"]] == [0.7, None]
    assert [t["verdict"] for t in data["targets"]] == ["must", "missed"]


def test_writing_keeps_what_people_wrote(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"before\n{BEGIN}\nold numbers\n{END}\nafter\n", encoding="utf-8")
    performance.write(report(), page)
    performance.write(report(), page)
    text = page.read_text(encoding="utf-8")
    assert text.startswith("before\n")
    assert text.endswith("\nafter\n")
    assert "old numbers" not in text
    assert text.count("### Times") == 1


def test_writing_needs_the_marks(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("no marks", encoding="utf-8")
    with pytest.raises(ValueError, match="measured: begin"):
        performance.write(report(), page)
    assert page.read_text(encoding="utf-8") == "no marks"


def test_the_page_has_its_marks() -> None:
    text = performance.PAGE.read_text(encoding="utf-8")
    assert text.count(BEGIN) == text.count(END) == 1


def test_pieces_take_their_shortest_repeat() -> None:
    assert timing.sum_of_minima([[1.0, 5.0, 2.0], [3.0, 1.0, 2.5]]) == pytest.approx(4.0)


def test_exponents_are_recovered() -> None:
    sizes = [7.0, 9.0, 25.0]
    assert scaling.exponent(sizes, [3.0 * s**1.07 for s in sizes]) == pytest.approx(1.07)


def test_busy_machines_are_told() -> None:
    section = dataclasses.replace(report().sections[0], load=12.5)
    told = dataclasses.replace(report(), sections=[section]).circumstances()
    assert "1.0 to 12.5" in told
    assert "quick" in told


def test_a_wrong_name_is_answered_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sped"]) == 2
    assert "speed" in capsys.readouterr().err

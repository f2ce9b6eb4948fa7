"""Test the readability of the Start and How-to pages."""

from __future__ import annotations

from pathlib import Path

import pytest
import readability

LIMIT = 57.3  # the best median of three other projects, docs/readability.md


@pytest.mark.parametrize(
    ("word", "count"),
    [
        ("bearing", 2),
        ("files", 1),
        ("tables", 2),
        ("places", 2),
        ("measured", 2),
        ("loaded", 2),
        ("radial", 3),
        ("friction", 2),
        ("fatigue", 2),
        ("area", 3),
        ("temperature", 4),
    ],
)
def test_syllables_are_counted(word: str, count: int) -> None:
    assert readability.syllables(word) == count


def test_reading_ease_of_a_known_text() -> None:
    found = readability.ease("The cat sat on the mat. The ball rolls over the ring, e.g. here.")
    assert (found.words, found.sentences) == (14, 2)
    assert found.flesch == pytest.approx(206.835 - 1.015 * 7 - 84.6 * found.syllables / 14)


def test_code_tables_and_headings_do_not_count(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(
        "# A long heading\n\nRun `lambda-bearing check` now.\n\n| a | b |\n|---|---|\n\n```\ncode here\n```\n"
    )
    assert readability.prose(page).split() == ["Run", "name", "now."]


@pytest.mark.parametrize("page", readability.start_and_how_to(), ids=lambda page: page.name)
def test_a_page_is_easy_to_read(page: Path) -> None:
    found = readability.ease(readability.prose(page))
    assert found.words < readability.LEAST or found.flesch >= LIMIT


def test_the_record_has_the_median_of_today(capsys: pytest.CaptureFixture[str]) -> None:
    assert readability.main([]) == 0
    printed = capsys.readouterr().out.splitlines()[-1]
    text = (readability.DOCS / "readability.md").read_text(encoding="utf-8")
    row = next(line for line in text.splitlines() if line.startswith("| lambda-bearing"))
    assert float(row.split("|")[3]) == pytest.approx(float(printed.split(":")[1].split(";")[0]), abs=2.0)

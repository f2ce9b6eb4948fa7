"""Test the first screens of pages with a long record."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
MARK = "\n## Appendix: the record\n"
_NUMBER = re.compile(r"(?<![\w.])\d+\.\d+(?![\w.]|\.\d)")


def _parts(name: str) -> tuple[str, str]:
    lead, mark, record = (DOCS / name).read_text(encoding="utf-8").partition(MARK)
    assert mark, f"{name} has no appendix"
    return lead, record


@pytest.mark.parametrize("name", ["performance.md", "validation.md"])
class TestFirstScreen:
    def test_it_is_one_screen(self, name: str) -> None:
        assert len(_parts(name)[0].splitlines()) <= 40

    def test_it_says_what_holds_what_misses_and_how_to_repeat(self, name: str) -> None:
        lead, _ = _parts(name)
        for word in ("**What holds.**", "**What misses.**", "**Repeat it"):
            assert word in lead

    def test_its_numbers_stand_in_the_record(self, name: str) -> None:
        """Find each number of the first screen in the record.

        Programs renew the tables of the record, and the first screen must follow.
        """
        lead, record = _parts(name)
        stated = set(_NUMBER.findall(record))
        stale = sorted({number for number in _NUMBER.findall(lead) if number not in stated})
        assert not stale, f"docs/{name}: the record no longer says {', '.join(stale)}: renew the first screen"

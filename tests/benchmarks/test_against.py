"""Test two versions in turn.

The same one twice has the same counts; the program reports what it cannot compare.
"""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from benchmarks import against
from benchmarks.__main__ import main
from benchmarks.timing import Effort


@pytest.mark.full
def test_a_version_is_as_good_as_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    """Compare counts and losses, which depend on no clock.

    A case that neither version knows is listed in the notes.
    """
    points = {"axial": ("6208-axial-1300", {}, 1e-4, 1e-4), "unheard of": ("nothing", {}, 1e-4, 1e-4)}
    monkeypatch.setattr(against, "POINTS", points)
    section = against.measure(Path(sys.prefix), Effort(quick=True))
    (table,) = section.tables
    known, unknown = (dict(zip(table.columns, row, strict=True)) for row in table.rows)
    assert known["times fewer"] == 1.0
    assert known["loss, difference %"] == 0.0
    assert float(known["s per simulated s"] or 0.0) > 0.0
    assert unknown["times fewer"] is None
    assert any("nothing" in note for note in table.notes)
    assert section.failed


def test_the_named_laws_go_with_every_point() -> None:
    changed = against.own_laws({"operation": {"speed": "10 rpm"}}, newer=True)
    assert changed["operation"] == {"speed": "10 rpm"}
    assert changed["models"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [(["--against", "/nowhere"], "no Python"), (["--against", "/nowhere", "speed"], "leave NAME")],
)
def test_what_cannot_be_compared_is_refused(
    arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 2
    assert words in capsys.readouterr().err

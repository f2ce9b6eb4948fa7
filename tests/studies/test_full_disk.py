"""Test studies whose disk is full."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.studies.store import FILE, Manifest
from lambda_core.studies.study_check import duration

STUDY = """
name = "two"
case = "6208-axial-1300"
responses = ["max_pressure_GPa"]

[[parameters]]
path = "loads.axial"
values = ["1 kN", "1.1 kN"]
"""
connect = sqlite3.connect


@pytest.fixture
def room(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], None]:
    """Give every database so many pages beyond what it has."""

    def give(pages: int) -> None:
        def small(*arguments: Any, **options: Any) -> sqlite3.Connection:
            database = connect(*arguments, **options)
            most = database.execute("PRAGMA page_count").fetchone()[0] + pages
            database.execute(f"PRAGMA max_page_count={most}")
            return database

        monkeypatch.setattr(sqlite3, "connect", small)

    return give


def test_a_study_without_room_leaves_no_part_of_a_study(
    room: Callable[[int], None],
    write: Callable[..., Path],
    inline: Executor,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    room(2)
    with pytest.raises(UsageError, match=r"cannot write the study into .*two: database or disk is full"):
        api.study_run(write(STUDY), tmp_path / "two", executor=inline)
    assert not (tmp_path / "two" / FILE).exists()
    monkeypatch.setattr(sqlite3, "connect", connect)
    assert api.study_run(tmp_path / "study.toml", tmp_path / "two", executor=inline).done == 2


def test_a_study_that_another_process_begins_is_left_alone(
    write: Callable[..., Path], inline: Executor, tmp_path: Path
) -> None:
    """Refuse a manifest that another process has just made.

    It is empty until that process writes it.
    """
    (tmp_path / "two").mkdir()
    (tmp_path / "two" / FILE).touch()
    with pytest.raises(UsageError, match="already holds a study"):
        api.study_run(write(STUDY), tmp_path / "two", executor=inline)
    assert [path.name for path in (tmp_path / "two").iterdir()] == [FILE]


def test_a_study_whose_disk_fills_up_says_how_to_go_on(
    room: Callable[[int], None], write: Callable[..., Path], inline: Executor, tmp_path: Path
) -> None:
    folder = tmp_path / "two"
    api.study_run(write(STUDY), folder, executor=inline)
    room(0)
    advice = rf"{FILE}: database or disk is full; make room, then go on with: lambda-bearing study resume .*two"
    with closing(Manifest(folder, write=True)) as manifest, pytest.raises(UsageError, match=advice):
        manifest.write_meta("title", "x" * 200_000)
    assert api.study_status(folder).title == "two"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.0123, "12 ms"), (0.0994, "99 ms"), (0.0996, "0.1 s"), (1.2, "1.2 s"), (90.0, "1.5 minutes")],
)
def test_times_are_written_without_exponents(seconds: float, words: str) -> None:
    assert duration(seconds) == words

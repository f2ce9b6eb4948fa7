"""Test the limits of code metrics and their page."""

from __future__ import annotations

import subprocess

import code_metrics as metrics
import pytest

SUBJECT = 60  # characters of the first line of a commit
LONG_BEFORE = "ee8de011"  # the last commit with a longer subject


@pytest.fixture(scope="module")
def figures() -> list[int]:
    """Return what docs/code-metrics.md counts, of today's files."""
    if not (metrics.ROOT / ".git").exists():
        pytest.skip("counts the files that git tracks")
    return metrics.counted(metrics.Tree(metrics.ROOT))


def test_what_is_counted_keeps_its_limits(figures: list[int]) -> None:
    pairs = zip(metrics.FIGURES, figures, strict=True)
    assert not [f"{figure.what}: {n}" for figure, n in pairs if figure.limit is not None and n > figure.limit]


def test_the_page_says_what_is_counted(figures: list[int]) -> None:
    """Compare the page with the code to 10 %.

    The page need not be renewed for every new line.
    """
    rows = (
        metrics.PAGE.read_text(encoding="utf-8").partition(metrics.BEGIN)[2].partition(metrics.END)[0].splitlines()[2:]
    )
    said = [int(row.split("|")[3]) for row in rows if row.startswith("|")]
    assert said == [pytest.approx(n, rel=0.1, abs=3) for n in figures], "python docs/tools/code_metrics.py --write"


def test_subjects_of_commits_are_short() -> None:
    """Limit subjects to 60 characters.

    The test is skipped where there is no history.
    """
    command = ["git", "log", "--no-merges", "--abbrev=8", "--format=%h %s", f"{LONG_BEFORE}..HEAD"]
    done = subprocess.run(command, cwd=metrics.ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        pytest.skip("no git history")
    commits = dict(line.split(" ", 1) for line in done.stdout.splitlines())
    assert not [short for short, subject in commits.items() if len(subject) > SUBJECT]

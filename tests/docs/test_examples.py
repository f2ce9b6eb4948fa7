"""Test every command and Python example of every page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import page_examples as examples
import pytest

from lambda_core import api

if TYPE_CHECKING:
    from warm import Warm

DOCS = examples.DOCS
PAGES = examples.pages()
NAMES = [path.relative_to(DOCS).as_posix() for path in PAGES]
# These are two thirds of the time of all pages.
LONG = {"catalogue.md", "electric.md", "errors.md", "kinds.md", "python.md", "results.md", "shaft.md", "studies.md"}
LONG |= {"thermal.md", "views.md", "paper-results.md", "electric-reference.md"}
LONG |= {"reference/api.md", "reference/cli.md", "views-reference.md", "shaft-reference.md", "fit.md"}
# What a page tells but a test cannot do: each block says why.
NOT_RUN = {"install.md": 1, "contributing.md": 2, "shaft.md": 1, "shaft-reference.md": 1}
NOT_RUN |= {"fmu.md": 3, "fmu-reference.md": 1, "fmu-record.md": 1}


@pytest.fixture(scope="module")
def programs(warm: Warm) -> Path:
    """Compile everything beforehand.

    No page shows the sentence that announces it.
    """
    api.warmup()
    return warm.ready().path


@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.full] * (name in LONG), id=name) for name in NAMES]
)
def test_the_page_is_right(name: str, programs: Path, tmp_path: Path) -> None:
    differences = examples.follow(DOCS / name, tmp_path, False, programs)
    assert not differences, "\n\n".join(map(str, differences))


@pytest.mark.slow
@pytest.mark.timeout(1800)
@pytest.mark.parametrize(
    "name", [n for n, p in zip(NAMES, PAGES, strict=True) if any(s.slow for s in examples.steps(p))]
)
def test_every_slow_step_is_right(name: str, programs: Path, tmp_path: Path) -> None:
    differences = examples.follow(DOCS / name, tmp_path, True, programs)
    assert not differences, "\n\n".join(map(str, differences))


def test_pages_have_examples() -> None:
    assert {"install.md", "run.md", "frames.md", "python.md", "errors.md", "catalogue.md"} <= set(NAMES)
    assert set(NAMES) >= LONG
    kinds = [step.kind for path in PAGES for step in examples.steps(path)]
    assert kinds.count("command") >= 25
    assert kinds.count("python") >= 12


def test_only_set_up_is_left_out() -> None:
    left = {path.relative_to(DOCS).as_posix(): len(examples.not_run(path)) for path in DOCS.rglob("*.md")}
    assert {name: count for name, count in left.items() if count} == NOT_RUN


def test_no_command_hides_in_a_block_that_is_not_run() -> None:
    """Find program calls in blocks without a language.

    Nobody would try such an example.
    """
    for path in DOCS.rglob("*.md"):
        fenced, language = False, ""
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("```"):
                fenced, language = not fenced, line[3:]
            elif fenced and language != "console":
                assert not line.startswith(("lambda-bearing ", "$ lambda-bearing")), f"{path.name}: {line}"


def test_the_papers_results_take_less_than_20_lines() -> None:
    text = (DOCS / "paper-results.md").read_text(encoding="utf-8")
    blocks = text.split("```python\n")[1:]
    assert len(blocks) == 3
    for block in blocks:
        assert len(block.split("```")[0].strip().splitlines()) < 20


class TestComparison:
    """The comparison itself: it must not let wrong pages pass."""

    @pytest.mark.parametrize(
        ("page", "said", "agrees"),
        [
            (["torque 100.0 N mm"], ["torque 100.9 N mm"], True),
            (["torque 100.0 N mm"], ["torque 102.0 N mm"], False),
            (["9 balls"], ["8 balls"], False),
            (["x 0.01"], ["x 0.02"], True),  # one unit of the last decimal
            (["x 0.01"], ["x 0.03"], False),
            (["x 1.0e-04"], ["x 9.0e-05"], True),
            (["x 1.0e-04"], ["x 1.0e-05"], False),
            (["1 012.1 ± ... N mm"], ["1 013.0 ± 3.3 N mm"], True),
            (["1 012.1 ± ... N mm"], ["101.2 ± 3.3 N mm"], False),
            (["a", "...", "c"], ["a", "b1", "b2", "c"], True),
            (["a", "...", "c"], ["a", "b1", "b2"], False),
            (["...", "c"], ["c", "d"], False),
            (["a"], ["a", "b"], False),
            (["a", "..."], ["a", "b"], True),
            (["a   b"], ["a b"], True),
            (["-1.0"], ["1.0"], False),
            (["eq. 1-11"], ["eq. 1-11"], True),
            (["eq. 1-11"], ["eq. 1-12"], False),
            (["True"], ["False"], False),
            (["6208-axial-700"], ["6208-axial-701"], False),
            (["6208-axial-700"], ["6208-axial-1300"], False),
        ],
    )
    def test_lines(self, page: list[str], said: list[str], agrees: bool) -> None:
        assert (examples.compare(page, said) is not None) == agrees

    def test_new_numbers_go_where_the_old_ones_stood(self) -> None:
        assert examples.compare(["a   1.0 of ...", "...", "b 2"], ["a 3.5 of x", "y", "b 7"], exact=True) == [
            "a   3.5 of ...",
            "...",
            "b 7",
        ]

    def test_a_failing_command_is_a_difference(self, tmp_path: Path) -> None:
        page = tmp_path / "page.md"
        page.write_text("```console\n$ false\n```\n\n```console\n$ false\n$ echo $?\n1\n```\n")
        found = examples.follow(page, tmp_path, slow=False)
        assert [difference.reason for difference in found] == ["ended with exit code 1"]

    def test_python_blocks_share_names_and_fail_loudly(self, tmp_path: Path) -> None:
        page = tmp_path / "page.md"
        page.write_text(
            "```python\nx = 1\n```\n\n```python\nprint(x + 1)\n```\n\n```text\n2\n```\n\n```python\n1 / 0\n```\n"
        )
        found = examples.follow(page, tmp_path, slow=False)
        assert len(found) == 1
        assert "ZeroDivisionError" in found[0].said

    def test_files_and_slow_parts(self, tmp_path: Path) -> None:
        page = tmp_path / "page.md"
        page.write_text(
            "`a/b.txt`:\n\n```\nhello\n```\n\n```console\n$ cat a/b.txt\nhello\n```\n\n"
            "<!-- slow -->\n```console\n$ false\n```\n"
        )
        assert examples.follow(page, tmp_path, slow=False) == []
        assert len(examples.follow(page, tmp_path, slow=True)) == 1

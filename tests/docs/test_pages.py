"""Test the order of pages and of their parts."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
NAVIGATION = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").partition("\nnav:\n")[2]
MOST_WORDS = 24_000  # outside Reference and Record: about half of the words before the pages were rewritten


def _pages(part: str) -> list[str]:
    section = re.search(rf"^  - {part}:\n((?: {{6}}.*\n)+)", NAVIGATION, re.M)
    assert section, f"mkdocs.yml has no part {part}"
    return re.findall(r"\S+\.md", section[1])


def _text(page: str) -> str:
    return (DOCS / page).read_text(encoding="utf-8")


@pytest.mark.parametrize("page", re.findall(r"\S+\.md", NAVIGATION))
def test_a_page_begins_with_its_purpose_and_audience(page: str) -> None:
    opening = re.split(r"^## ", _text(page), maxsplit=1, flags=re.M)[0]
    sentences = " ".join(opening.split())
    assert re.search(r"\b(?:This|this) (?:page|section|site)\b", sentences)
    assert re.search(
        r"\bfor (?:[a-z-]+ )*?(?:readers|users|authors|engineers|developers|contributors|everyone|anyone)\b", sentences
    )


@pytest.mark.parametrize(
    ("page", "task"),
    [
        ("run.md", "resume"),
        ("shaft.md", "preload"),
        ("studies.md", "Friction over speed"),
        ("fit.md", "Compare with measurements"),
        ("fmu.md", "shaft"),
        ("catalogue.md", "choose a bearing"),
        ("trust.md", "trust"),
    ],
)
def test_a_title_names_the_task_that_readers_look_for(page: str, task: str) -> None:
    assert task in _text(page).splitlines()[0]


def test_the_first_page_leads_to_the_page_about_trust() -> None:
    assert "](trust.md)" in _text("first-bearing.md").partition("\n## Next\n")[2]


def test_the_gallery_is_the_second_page() -> None:
    assert re.findall(r"\S+\.md", NAVIGATION)[:2] == ["index.md", "gallery.md"]


@pytest.mark.parametrize("page", _pages("How-to"))
def test_a_how_to_page_opens_with_its_picture(page: str) -> None:
    opening = re.split(r"^(?:## |```)", _text(page), maxsplit=1, flags=re.M)[0]
    assert re.search(r"^!\[[^\]]+\]\(images/", opening, re.M)


@pytest.mark.parametrize("page", [page for page in _pages("How-to") if page != "contributing.md"])
def test_limitations_are_the_last_part_of_a_how_to_page(page: str) -> None:
    assert re.findall(r"^## (.+)$", _text(page), re.M)[-1] == "Limitations"


def test_pages_outside_reference_and_record_stay_short() -> None:
    others = {*_pages("Reference"), *_pages("Record")}
    pages = [page for page in re.findall(r"\S+\.md", NAVIGATION) if page not in others]
    assert len(pages) > 30
    assert sum(len(_text(page).split()) for page in pages) <= MOST_WORDS

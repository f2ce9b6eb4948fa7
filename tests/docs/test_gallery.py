"""Test the gallery.

One picture, the command that made it; small enough to be kept with the code.
"""

from __future__ import annotations

import re
from pathlib import Path

import gallery
import page_examples
import pytest

from lambda_core import api

DOCS = Path(__file__).parents[2] / "docs"
FILES = sorted(gallery.TARGET.iterdir())


def test_every_picture_is_there_and_nothing_else() -> None:
    assert sorted(gallery.target(picture) for picture in gallery.PICTURES) == FILES


def test_all_pictures_together_are_small() -> None:
    assert sum(file.stat().st_size for file in FILES) <= gallery.ALL_TOGETHER


@pytest.mark.parametrize("picture", gallery.PICTURES, ids=lambda picture: picture.name)
def test_its_command_draws_what_there_is(picture: gallery.Picture) -> None:
    _, command, *words = picture.command.split()
    assert command in {"view", "animate", "report"}
    if command == "view" and not words[-1].endswith(".h5"):
        assert words[-1] in {view.name for view in api.views()}
        assert picture.file == f"{Path(words[0]).stem}-{words[-1]}.png"


def test_the_tutorial_reaches_a_report_in_five_commands() -> None:
    page = DOCS / "first-bearing.md"
    every = [step.text for step in page_examples.steps(page) if step.kind == "command"]
    typed = [command for command in every if "thin.h5" not in command]  # another oil is a detour
    assert len(typed) <= 5
    assert typed[0].startswith("lambda-bearing init")
    assert typed[-1].startswith("lambda-bearing report")
    for step in ("init", "check", "run", "view", "report"):
        assert sum(f"lambda-bearing {step} " in command for command in typed) == 1


@pytest.mark.parametrize("name", ["index.md", "gallery.md", "first-bearing.md"])
def test_what_the_page_points_at_exists(name: str) -> None:
    """Find the targets of links in HTML too.

    The site's own check of links does not read HTML.
    """
    text = (DOCS / name).read_text(encoding="utf-8")
    for place in re.findall(r'(?:src|href)="([^"]+)"', text) + re.findall(r"!\[[^]]*\]\(([^)]+)\)", text):
        target, _, anchor = place.partition("#")
        page = DOCS / re.sub(r"\.html$", ".md", target)
        assert page.is_file(), f"{name}: {place}"
        if anchor:
            heads = re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.M)
            assert anchor in {re.sub(r"[^a-z0-9]+", "-", head.lower()).strip("-") for head in heads}, f"{name}: {place}"

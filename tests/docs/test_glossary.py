"""One word for one thing: what the glossary retires is used nowhere where people read."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
GLOSSARY = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
PACKAGES = ("lambda_core", "plugins", "db", "gui", "cli")
# Words that are wrong wherever they stand. What the glossary forbids for one thing only is left to the reader.
RETIRED = (
    "nobody's work",
    "let go",
    "takes no files",
    "make no film",
    "still and shaken",
    "grasp",
    "osculation",
    "footprint",
    "windage",
    "workshop",
)
_NAMES = {"grasp": "make_context", "proceed": "integrate", "settle": "solve_static or finalise_step"}


def _rows() -> list[list[str]]:
    return [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in GLOSSARY.splitlines()
        if line.startswith("|") and not line.startswith(("|---", "| term"))
    ]


def _texts() -> Iterator[tuple[str, str]]:
    for package in PACKAGES:
        for path in sorted((ROOT / package).rglob("*.py")):
            yield str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")
    for path in sorted((ROOT / "docs").rglob("*.md")):
        if path.name != "glossary.md":
            yield str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")


def test_the_glossary_explains_enough_and_nothing_twice() -> None:
    terms = [row[0] for row in _rows()]
    assert len(terms) >= 80
    assert len(terms) == len(set(terms))
    assert all(len(row) == 5 and row[0] for row in _rows())


@pytest.mark.parametrize("word", RETIRED)
def test_a_retired_word_is_used_nowhere(word: str) -> None:
    found = [name for name, text in _texts() if re.search(rf"\b{re.escape(word)}\b", text, re.IGNORECASE)]
    assert not found, f'"{word}" is retired (docs/glossary.md)'


@pytest.mark.parametrize("name", sorted(_NAMES))
def test_a_retired_name_is_given_to_nothing(name: str) -> None:
    """Functions, arguments and variables of the packages."""
    found = []
    for place, text in _texts():
        if not place.endswith(".py"):
            continue
        for node in ast.walk(ast.parse(text)):
            given = getattr(node, "name", None) or getattr(node, "arg", None)
            if given == name or (isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id == name):
                found.append(f"{place}:{node.lineno}")  # type: ignore[attr-defined]
    assert not found, f"call it {_NAMES[name]}: {found}"

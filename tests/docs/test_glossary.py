"""Test that retired words are used nowhere."""

from __future__ import annotations

import ast
import re
from functools import cache
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
_NAMES = {"grasp": "compile_into", "proceed": "integrate", "settle": "solve_static or finalise_step"}


def _rows() -> list[list[str]]:
    return [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in GLOSSARY.partition("\n## Words to avoid\n")[0].splitlines()
        if line.startswith("|") and not line.startswith(("|---", "| term"))
    ]


@cache
def _texts() -> list[tuple[str, str]]:
    code = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
    pages = [path for path in sorted((ROOT / "docs").rglob("*.md")) if path.name != "glossary.md"]
    return [(str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")) for path in (*code, *pages)]


@cache
def _given() -> dict[str, list[str]]:
    """Return where each name is defined.

    A function, a class, an argument or a variable of the packages.
    """
    found: dict[str, list[str]] = {}
    for place, text in _texts():
        for node in ast.walk(ast.parse(text)) if place.endswith(".py") else ():
            names = {getattr(node, "name", None), getattr(node, "arg", None)}
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                names.add(node.id)
            for name in names - {None}:
                found.setdefault(name, []).append(f"{place}:{getattr(node, 'lineno', '')}")
    return found


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
    """Search functions, arguments and variables of the packages."""
    assert "compile_into" in _given()
    assert name not in _given(), f"call it {_NAMES[name]}: {_given()[name]}"

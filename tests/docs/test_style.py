"""Test the plain English of pages, docstrings, messages and names."""

from __future__ import annotations

import ast
import re
import subprocess
import tokenize
from functools import cache
from io import StringIO
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
OWN = Path(__file__).relative_to(ROOT).as_posix()
GLOSSARY = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
# What follows "whole" where it is a noun; "the whole ring", an adjective, is plain English.
_VERBS_AND_PREPOSITIONS = "and|are|as|at|by|can|costs?|for|from|has|in|is|may|must|of|on|or|that|to|which|with"
_NOUN = rf"(?=\s*(?:$|[^\s\w])|\s+(?:{_VERBS_AND_PREPOSITIONS})\b)"
_BE = "(?:is|was|are|were|be|been)"
AVOIDED = {
    "beside": r"\bbeside\b",
    "a whole": rf"\ba\s+whole{_NOUN}",
    "the whole": rf"\bthe\s+whole{_NOUN}",
    "led": r"\bled\b",
    "is said, are said": rf"\b{_BE}\s+said\b",
    "is told, are told": rf"\b{_BE}\s+told\b",
    "let go": r"\blet(?:s|ting)?\s+go\b",
    "rubbish": r"\brubbish\b",
    "stands for itself": r"\bstands?\s+for\s+(?:itself|themselves)\b",
}
_AVOIDED = re.compile("|".join(AVOIDED.values()), re.IGNORECASE)
_NAMES = {"beside", "led", "rubbish", "whole", "wholes"}  # words of a name in snake case or camel case
_WORD = re.compile(r"[A-Z]?[a-z]+")
EXEMPT = ("LED",)  # quotations and standard terms that contain such a word
RULES = ("contributing.md", "glossary.md")  # these pages quote the words
QUESTIONS = ("What", "Where", "How", "Which", "Whether", "When", "Who", "Why")  # no docstring opens with one
NOUNS = ("A", "An", "The", "It", "They", "There")  # open no docstring of a function, which begins with a verb
# Words to avoid in strings and names of the code. A number can only fall: lower it with every text that you improve.
CEILINGS = {"tests": 1}
SUMMARY = 10  # words of the first line of a docstring


def _pages() -> list[Path]:
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [page for page in pages if page.name not in RULES and page.parent.name != "reference"]


@cache
def _sources() -> dict[str, str]:
    """Return the Python files that git tracks, by name."""
    if not (ROOT / ".git").exists():
        pytest.skip("looks at the files that git tracks")
    listed = subprocess.run(["git", "ls-files", "*.py"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return {name: (ROOT / name).read_text(encoding="utf-8") for name in listed.split() if (ROOT / name).exists()}


def _in_text(text: str) -> list[str]:
    for phrase in EXEMPT:
        text = text.replace(phrase, "")
    return [" ".join(found.group().split()) for found in _AVOIDED.finditer(text)]


@cache
def _nodes(name: str) -> tuple[ast.AST, ...]:
    """Return the nodes of a module."""
    return tuple(ast.walk(ast.parse(_sources()[name])))


@cache
def _docstrings() -> dict[str, tuple[ast.AST, str]]:
    """Return the docstrings of modules, classes and functions, by place."""
    found: dict[str, tuple[ast.AST, str]] = {}
    for name in _sources():
        for node in _nodes(name):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
                own = getattr(node, "name", "")
                if doc := ast.get_docstring(node):
                    found[f"{name}:{getattr(node, 'lineno', 1)} {own}"] = (node, doc)
    return found


def _is_named(node: ast.AST) -> bool:
    """Tell whether a docstring names a law or property."""
    marks = [ast.unparse(mark) for mark in getattr(node, "decorator_list", [])]
    return any(mark.startswith(("law(", "cached_property", "property")) for mark in marks)


def _comments(text: str) -> list[str]:
    """Return the comments of a module that may count.

    Tokens take most of the time, so that only modules with a word to avoid after a "#" are read by token.
    """
    if not any(_in_text(line.partition("#")[2]) for line in text.splitlines() if "#" in line):
        return []
    tokens = tokenize.generate_tokens(StringIO(text).readline)
    return [token.string for token in tokens if token.type == tokenize.COMMENT]


def _in_code(name: str, text: str) -> int:
    """Count the words to avoid in code.

    In the strings and comments of a module, its name and the names it defines.
    """
    words = _WORD.findall(Path(name).stem)
    count = sum(len(_in_text(comment)) for comment in _comments(text))
    for node in _nodes(name):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            count += len(_in_text(node.value))
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            words += _WORD.findall(node.name)
        elif isinstance(node, ast.arg):
            words += _WORD.findall(node.arg)
        elif isinstance(node, ast.Name | ast.Attribute) and isinstance(node.ctx, ast.Store):
            words += _WORD.findall(node.id if isinstance(node, ast.Name) else node.attr)
    return count + sum(word.lower() in _NAMES for word in words)


@pytest.mark.parametrize("page", _pages(), ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_has_no_word_to_avoid(page: Path) -> None:
    assert _in_text(page.read_text(encoding="utf-8")) == [], "see docs/glossary.md#words-to-avoid"


def test_the_glossary_lists_the_words_to_avoid() -> None:
    rows = GLOSSARY.partition("\n## Words to avoid\n")[2].splitlines()
    listed = [row.split("|")[1].strip() for row in rows if row.startswith("| ")]
    assert listed == ["avoid", *AVOIDED]


@pytest.mark.parametrize("text", ["led by a host", "As a whole, it", "the\nwhole of it", "It is said that", "beside"])
def test_a_word_to_avoid_is_found(text: str) -> None:
    assert len(_in_text(text)) == 1


@pytest.mark.parametrize("text", ["the whole ring", "an LED lamp", "a whole number", "said the user"])
def test_plain_words_are_left_alone(text: str) -> None:
    assert _in_text(text) == []


def test_docstrings_open_with_no_question_word() -> None:
    assert [place for place, (_, doc) in _docstrings().items() if doc.split(maxsplit=1)[0] in QUESTIONS] == []


def test_docstrings_of_functions_and_modules_open_with_a_verb() -> None:
    """Reject articles and pronouns as first words.

    Rule D401 of ruff finds other moods.
    """
    functions = {
        place: doc.split(maxsplit=1)[0]
        for place, (node, doc) in _docstrings().items()
        if isinstance(node, ast.Module | ast.FunctionDef | ast.AsyncFunctionDef) and not _is_named(node)
    }
    assert len(functions) > 6000
    assert {place: word for place, word in functions.items() if word in NOUNS} == {}


def test_docstrings_are_summarised_in_ten_words() -> None:
    summaries = {place: doc.partition("\n\n")[0].split() for place, (_, doc) in _docstrings().items()}
    assert len(summaries) > 8000
    assert {place: " ".join(words) for place, words in summaries.items() if len(words) > SUMMARY} == {}


def test_words_to_avoid_in_the_code_only_get_fewer() -> None:
    counts: dict[str, int] = {}
    for name, text in _sources().items():
        if name != OWN and (found := _in_code(name, text)):
            package = name.partition("/")[0]
            counts[package] = counts.get(package, 0) + found
    assert {name: count for name, count in counts.items() if count > CEILINGS.get(name, 0)} == {}

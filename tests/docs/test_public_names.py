"""Every public name has a numpydoc docstring: parameters, what is returned, what is raised, fields with meaning."""

from __future__ import annotations

import importlib
import inspect
import re
from typing import Any

import docstrings
import pytest

PUBLIC = {
    f"{module}.{name}": item
    for module in docstrings.MODULES
    for name, item in docstrings.public(importlib.import_module(module))
}
# What the functions of the API return; their rooms are documented with them.
RETURNED = {f"returned.{item.__name__}": item for item in docstrings.returned()}
CLASSES = {name: item for name, item in (PUBLIC | RETURNED).items() if isinstance(item, type)}
FUNCTIONS: dict[str, Any] = {name: item for name, item in PUBLIC.items() if not isinstance(item, type)} | {
    f"{name}.{key}": item
    for name, cls in CLASSES.items()
    for key, item in docstrings.methods(cls)
    if not isinstance(vars(cls).get(key), property)
}
# Rooms whose records are still without words for some of their fields.
GAPS = (
    "lambda_core.results",
    "lambda_core.runs",
    "lambda_core.studies",
    "lambda_core.export.report",
    "lambda_syla2026",
)
COMPLETE = ("lambda_core.results.citation", "lambda_core.runs.warmup")
NOTHING = (None, "None", inspect.Signature.empty)


def test_there_is_something_to_check() -> None:
    assert len(PUBLIC) > 50
    assert len(FUNCTIONS) > 60


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_are_documented(name: str) -> None:
    function = FUNCTIONS[name]
    doc = docstrings.parsed(function)
    assert doc.text, "has no docstring"
    wanted = docstrings.parameters(function)
    # A method of one line whose arguments speak for themselves may name them in that line.
    missing = [p for p in wanted if p not in doc.names("Parameters") and not _in_line(name, p, doc)]
    assert not missing, f"does not describe {', '.join(missing)}"
    returns = inspect.signature(function).return_annotation
    if returns not in NOTHING:
        said = {"Returns", "Yields"} & doc.sections.keys() or re.search(r"\b(return|yield|tell)s?\b", doc.text, re.I)
        assert said, "does not say what it returns"
    raised = docstrings.raised(function)
    described = doc.sections.get("Raises", "") + doc.text
    assert "returned." in name or not [error for error in raised if error not in described], "raises without saying so"


def _in_line(name: str, parameter: str, doc: docstrings.Docstring) -> bool:
    is_method = name.count(".") > 2 or name.startswith("returned.")
    return is_method and (f"`{parameter}`" in doc.text or len(doc.text.split("\n\n")[0].splitlines()) == 1)


@pytest.mark.parametrize("name", [n for n in PUBLIC if n.startswith(("lambda_core.api", "lambda_core.testing"))])
def test_functions_that_people_call_have_all_sections(name: str) -> None:
    """The API and the test kit, called from scripts: sections for everything, not a line in the text."""
    if isinstance(PUBLIC[name], type):
        return
    doc = docstrings.parsed(PUBLIC[name])
    returns = inspect.signature(PUBLIC[name]).return_annotation
    if returns not in NOTHING:
        assert {"Returns", "Yields"} & doc.sections.keys(), "has no section Returns"
    if docstrings.parameters(PUBLIC[name]):
        assert "Parameters" in doc.sections


def _complete() -> list[str]:
    return [n for n, cls in CLASSES.items() if not cls.__module__.startswith(GAPS) or cls.__module__ in COMPLETE]


@pytest.mark.parametrize("name", _complete())
def test_classes_are_documented_with_all_their_fields(name: str) -> None:
    cls = CLASSES[name]
    assert docstrings.parsed(cls).text, "has no docstring"
    fields = docstrings.fields(cls)
    missing = [field for field, meaning in fields.items() if not meaning and not _named_for(field)]
    assert not missing, f"fields without a meaning: {', '.join(missing)}"


def _named_for(field: str) -> bool:
    """Names that say it all: what people read, and quantities with their unit."""
    plain = {
        "name",
        "title",
        "reference",
        "distribution",
        "version",
        "interface",
        "case",
        "file",
        "headline",
        "assumptions",
    }
    return field in plain or field.endswith(("_Nmm", "_N", "_um", "_pF", "_nF", "_GPa", "_deg", "_s", "_h", "_api"))

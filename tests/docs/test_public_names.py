"""Test that every public name has a numpydoc docstring."""

from __future__ import annotations

import importlib
import inspect
import re
from collections.abc import Iterator
from typing import Any

import docstrings

PUBLIC = {
    f"{module}.{name}": item
    for module in docstrings.MODULES
    for name, item in docstrings.public(importlib.import_module(module))
}
# What the functions of the API return; their modules are documented with them.
RETURNED = {f"returned.{item.__name__}": item for item in docstrings.returned()}
CLASSES = {name: item for name, item in (PUBLIC | RETURNED).items() if isinstance(item, type)}
FUNCTIONS: dict[str, Any] = {name: item for name, item in PUBLIC.items() if not isinstance(item, type)} | {
    f"{name}.{key}": item
    for name, cls in CLASSES.items()
    for key, item in docstrings.methods(cls)
    if not isinstance(vars(cls).get(key), property)
}
# Packages whose records are still without words for some of their fields.
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


def test_functions_are_documented() -> None:
    faults = {name: list(_faults(name, function)) for name, function in FUNCTIONS.items()}
    assert {name: found for name, found in faults.items() if found} == {}


def _faults(name: str, function: Any) -> Iterator[str]:
    doc = docstrings.parsed(function)
    if not doc.text:
        yield "has no docstring"
    wanted = docstrings.parameters(function)
    # A method of one line whose arguments speak for themselves may name them in that line.
    missing = [p for p in wanted if p not in doc.names("Parameters") and not _in_line(name, p, doc)]
    if missing:
        yield f"does not describe {', '.join(missing)}"
    returns = inspect.signature(function).return_annotation
    if returns not in NOTHING:
        said = {"Returns", "Yields"} & doc.sections.keys() or re.search(r"\b(return|yield|tell)s?\b", doc.text, re.I)
        if not said:
            yield "does not say what it returns"
    described = doc.sections.get("Raises", "") + doc.text
    silent = [error for error in docstrings.raised(function) if error not in described]
    if silent and "returned." not in name:
        yield f"raises {', '.join(silent)} without saying so"


def _in_line(name: str, parameter: str, doc: docstrings.Docstring) -> bool:
    is_method = name.count(".") > 2 or name.startswith("returned.")
    return is_method and (f"`{parameter}`" in doc.text or len(doc.text.split("\n\n")[0].splitlines()) == 1)


def test_functions_that_people_call_have_all_sections() -> None:
    """Find all sections in docstrings of API and test kit.

    Scripts call these functions.
    """
    called = {n: item for n, item in PUBLIC.items() if n.startswith(("lambda_core.api", "lambda_core.testing"))}
    without = []
    for name, item in called.items():
        if isinstance(item, type):
            continue
        sections = docstrings.parsed(item).sections
        if inspect.signature(item).return_annotation not in NOTHING and not {"Returns", "Yields"} & sections.keys():
            without.append(f"{name}: Returns")
        if docstrings.parameters(item) and "Parameters" not in sections:
            without.append(f"{name}: Parameters")
    assert len(called) > 30
    assert without == []


def test_what_people_call_is_summarised_in_ten_words() -> None:
    """Count the words of summaries in API and test kit."""
    called = {n: item for n, item in PUBLIC.items() if n.startswith(("lambda_core.api", "lambda_core.testing"))}
    summaries = {name: docstrings.parsed(item).text.split("\n\n")[0].split() for name, item in called.items()}
    assert {name: " ".join(words) for name, words in summaries.items() if len(words) > 10} == {}


def _complete() -> list[str]:
    return [n for n, cls in CLASSES.items() if not cls.__module__.startswith(GAPS) or cls.__module__ in COMPLETE]


def test_classes_are_documented_with_all_their_fields() -> None:
    complete = {name: CLASSES[name] for name in _complete()}
    assert len(complete) > 30
    assert [name for name, cls in complete.items() if not docstrings.parsed(cls).text] == [], "no docstring"
    missing = {
        name: [field for field, meaning in docstrings.fields(cls).items() if not meaning and not _named_for(field)]
        for name, cls in complete.items()
    }
    assert {name: fields for name, fields in missing.items() if fields} == {}, "fields without a meaning"


def _named_for(field: str) -> bool:
    """Tell whether a name needs no meaning.

    Common words, and quantities with their unit.
    """
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

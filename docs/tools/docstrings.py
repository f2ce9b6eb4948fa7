"""Read public names and their numpydoc docstrings.

For the API reference and the test that docstrings are complete.
"""

from __future__ import annotations

import ast
import dataclasses
import importlib
import inspect
import io
import re
import textwrap
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from pydantic import BaseModel

from lambda_core.results.bearing_summary import BearingSummary

MODULES = ("lambda_core.api", "lambda_core.plugins", "lambda_core.testing")
SECTIONS = ("Parameters", "Attributes", "Returns", "Yields", "Raises", "Examples", "Notes")


@dataclass
class Docstring:
    """A docstring in its parts."""

    text: str = ""  # before the first section
    sections: dict[str, str] = field(default_factory=dict)

    def names(self, *sections: str) -> set[str]:
        """Return the names that sections describe.

        "x, y : float" has two.
        """
        found: set[str] = set()
        for line in "\n".join(self.sections.get(name, "") for name in sections).splitlines():
            if line and not line[0].isspace():
                found |= {name.strip().lstrip("*") for name in line.split(" : ")[0].split(",")}
        return found


def parsed(item: object) -> Docstring:
    """Split the docstring of an object into its numpydoc sections."""
    lines = (inspect.getdoc(item) if _own_doc(item) else None) or ""
    parts = re.split(rf"^({'|'.join(SECTIONS)})\n-{{3,}}\n", lines, flags=re.M)
    return Docstring(
        parts[0].strip(), {name: text.strip("\n") for name, text in zip(parts[1::2], parts[2::2], strict=True)}
    )


def _own_doc(item: object) -> bool:
    """Tell whether the docstring is the object's own.

    Not inherited, not made by dataclass or pydantic.
    """
    doc = item.__dict__.get("__doc__") if isinstance(item, type) else getattr(item, "__doc__", None)
    if not doc:
        return False
    name = getattr(item, "__name__", "")
    return not (isinstance(item, type) and dataclasses.is_dataclass(item) and doc.startswith(f"{name}("))


def public(module: Any) -> Iterator[tuple[str, Any]]:
    """Yield a module's public functions and classes.

    By its ``__all__``.
    """
    for name in module.__all__:
        item = getattr(module, name)
        if inspect.isfunction(item) or isinstance(item, type):
            yield name, item


def constants(module: Any) -> Iterator[tuple[str, Any]]:
    """Yield a module's other public names.

    They are neither functions nor classes.
    """
    known = {name for name, _ in public(module)}
    for name in module.__all__:
        if name not in known:
            yield name, getattr(module, name)


def returned() -> list[type]:
    """Return the classes in the API's signatures.

    In alphabetical order.
    """
    found: dict[str, type] = {}
    for node in (node for source in _sources(MODULES[0]) for node in ast.walk(ast.parse(source))):
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            for line in node.body:
                if isinstance(line, ast.ImportFrom) and (line.module or "").startswith("lambda_core."):
                    module = importlib.import_module(str(line.module))
                    named = {alias.name: getattr(module, alias.name) for alias in line.names}
                    found |= {name: item for name, item in named.items() if isinstance(item, type)}
    found["BearingSummary"] = BearingSummary  # no signature names it: a summary holds one for each bearing
    elsewhere = {name for key in MODULES for name in importlib.import_module(key).__all__}
    return [found[name] for name in sorted(found) if name not in elsewhere]


def _sources(name: str) -> Iterator[str]:
    """Yield the sources of a module's functions.

    The text of each module that has its public functions.
    """
    module = importlib.import_module(name)
    homes = {inspect.unwrap(item).__module__ for _, item in public(module) if inspect.isfunction(item)}
    for home in sorted(homes):
        yield inspect.getsource(importlib.import_module(home))


def methods(cls: type) -> Iterator[tuple[str, Any]]:
    """Yield a class's own public methods.

    And its properties.
    """
    for name, item in vars(cls).items():
        if name.startswith("_"):
            continue
        if isinstance(item, staticmethod | classmethod):
            item = item.__func__
        if isinstance(item, property):
            item = item.fget
        if inspect.isfunction(item) and item.__qualname__.startswith(cls.__name__):
            yield name, item


def parameters(function: Any) -> list[str]:
    """Return a function's parameter names.

    Without self and cls.
    """
    names = list(inspect.signature(function).parameters)
    return [name for name in names if name not in ("self", "cls")]


def fields(cls: type) -> dict[str, str]:
    """Return the declared fields with comments.

    Of a dataclass or pydantic model; the comment is after or above a field.
    """
    names = [f.name for f in dataclasses.fields(cls)] if dataclasses.is_dataclass(cls) else []
    if issubclass(cls, BaseModel):
        names = list(cls.model_fields)
    if not names:
        return {}
    comments = _comments(cls)
    said = {name: comments.get(name, "") for name in names}
    if issubclass(cls, BaseModel):
        for name in names:
            said[name] = cls.model_fields[name].description or said[name]
    described = parsed(cls)
    return {name: said[name] or _section_text(described, name) for name in names if not name.startswith("_")}


def _section_text(doc: Docstring, name: str) -> str:
    """Return a name's text in Attributes.

    On one line.
    """
    lines = doc.sections.get("Attributes", "").splitlines()
    for index, line in enumerate(lines):
        head, _, kind = line.partition(" : ")
        if not line[:1].isspace() and name in [part.strip() for part in head.split(",")]:
            text = []
            for below in lines[index + 1 :]:
                if below and not below[0].isspace():
                    break
                text.append(below.strip())
            return f"{kind}. {' '.join(text)}".strip(". ") if text else kind
    return ""


def _comments(cls: type) -> dict[str, str]:
    """Return the comment of each field.

    An annotated field has it on its line, or on the lines above it.
    """
    try:
        source = textwrap.dedent(inspect.getsource(cls))
    except (OSError, TypeError):
        return {}
    found: dict[int, str] = {}
    alone: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            found[token.start[0]] = token.string.lstrip("# ").strip()
            if token.line.strip().startswith("#"):
                alone.add(token.start[0])
    said: dict[str, str] = {}
    body = ast.parse(source).body[0]
    assert isinstance(body, ast.ClassDef)
    for node in body.body:
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            above, line = [], node.lineno - 1
            while line in alone:
                above.insert(0, found[line])
                line -= 1
            said[node.target.id] = " ".join([*above, found.get(node.end_lineno or 0, "")]).strip()
    return said


def raised(function: Any) -> set[str]:
    """Return the exceptions that a function raises.

    Their names, in its own body.
    """
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(function)))
    except (OSError, TypeError):
        return set()
    found: set[str] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call) and isinstance(node.exc.func, ast.Name):
            found.add(node.exc.func.id)
    return found

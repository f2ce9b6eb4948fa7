"""Write the Python reference from the docstrings of public names."""

from __future__ import annotations

import importlib
import inspect
import re
from typing import Any

import docstrings
import tables as md

_INTRODUCTION = """# Python reference

This page lists every public name with its docstring, for authors of scripts and plugins. Scripts import
[lambda_core.api](#lambda_coreapi), plugins import [lambda_core.plugins](#lambda_coreplugins), and tests of plugins
import [lambda_core.testing](#lambda_coretesting). The last part lists
[what the functions return](#what-the-functions-return). Everything else is internal and may change.
[Python](../python.md) has more examples.

```python
from lambda_core import api

print(f"{api.quasistatic('6208-axial-1300').friction_torque_Nmm:.0f} N mm")
```

```text
252 N mm
```
"""


def api_page() -> str:
    """Return the whole page."""
    lines = [_INTRODUCTION]
    for name in docstrings.MODULES:
        module = importlib.import_module(name)
        about = _prose((module.__doc__ or "").split("\n\nfrom ")[0])
        lines += [f"## {name}", "", *about]
        constants = [
            f"`{key}` = {value!r}" for key, value in docstrings.constants(module) if isinstance(value, int | str)
        ]
        lines += [", ".join(constants), ""] if constants else []
        for key, item in docstrings.public(module):
            lines += _class(key, item) if isinstance(item, type) else _function(key, item)
    lines += ["## What the functions return", ""]
    for item in docstrings.returned():
        lines += _class(item.__name__, item)
    return md.page(lines)


def _function(name: str, function: Any, level: str = "###") -> list[str]:
    return [f"{level} {name}", "", *_signature(name, function), *_sections(docstrings.parsed(function))]


def _class(name: str, cls: type) -> list[str]:
    doc = docstrings.parsed(cls)
    fields = docstrings.fields(cls)
    lines = [f"### {name}", "", *_prose(doc.text)]
    if fields:
        lines += md.table(("field", "meaning"), [[md.code(key), md.cell(text)] for key, text in fields.items()])
    lines += [line for key in doc.sections if not (fields and key == "Attributes") for line in _section(doc, key)]
    for key, item in docstrings.methods(cls):
        if isinstance(vars(cls).get(key), property):
            lines += [f"#### {name}.{key}", "", *_prose(docstrings.parsed(item).text)]
        else:
            lines += _function(f"{name}.{key}", item, "####")
    return lines


def _signature(name: str, function: Any) -> list[str]:
    signature = inspect.signature(function)
    own = [p for p in signature.parameters.values() if p.name not in ("self", "cls")]
    parts = [_parameter(p) for p in own]
    first = next((i for i, p in enumerate(own) if p.kind is p.KEYWORD_ONLY), None)
    if first is not None and not any(p.kind is p.VAR_POSITIONAL for p in own):
        parts.insert(first, "*")
    back = "" if signature.return_annotation is signature.empty else f" -> {signature.return_annotation}"
    text = f"{name}({', '.join(parts)}){back}"
    if len(text) > 100:
        text = f"{name}(\n" + "".join(f"    {part},\n" for part in parts) + f"){back}"
    # A signature is no example: it is not run.
    return ["~~~python", text, "~~~", ""]


def _parameter(parameter: inspect.Parameter) -> str:
    stars = {parameter.VAR_POSITIONAL: "*", parameter.VAR_KEYWORD: "**"}.get(parameter.kind, "")
    kind = "" if parameter.annotation is parameter.empty else f": {parameter.annotation}"
    default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}"
    return f"{stars}{parameter.name}{kind}{default}"


def _sections(doc: docstrings.Docstring) -> list[str]:
    return _prose(doc.text) + [line for name in doc.sections for line in _section(doc, name)]


def _section(doc: docstrings.Docstring, name: str) -> list[str]:
    text = doc.sections[name]
    if name in ("Examples", "Notes"):
        return [f"*{name}*", "", "~~~", text, "~~~", ""] if ">>>" in text else [f"*{name}*", "", *_prose(text)]
    lines: list[str] = []
    fresh = False  # whether the last line is a name whose meaning follows
    for line in text.splitlines():
        if line and not line[0].isspace():
            head, colon, kind = line.partition(" : ")
            lines.append(f"- `{head}`{' : ' + _inline(kind) if colon else ''}")
            fresh = True
        elif line.strip() and lines:
            lines[-1] += f"{': ' if fresh else ' '}{_inline(line.strip())}"
            fresh = False
    return [f"*{name}*", "", *lines, ""]


def _prose(text: str) -> list[str]:
    return [line for part in text.strip().split("\n\n") if part for line in (_inline(" ".join(part.split())), "")]


def _inline(text: str) -> str:
    """Turn the marks of docstrings into those of Markdown."""
    text = re.sub(r":(?:class|func|meth|mod|data):`~?([^`]+)`", r"`\1`", text).replace("``", "`")
    return re.sub(r"<(?!!)", "&lt;", text)

"""Generate the reference of laws, comparison methods and views."""

from __future__ import annotations

import inspect
from typing import Any

import tables as md

from lambda_core.discovery.manager import registry
from lambda_core.discovery.registry import Registry
from lambda_core.discovery.survey import ModelCard, model_card
from lambda_core.domain.installed import OWN
from lambda_core.domain.role import Role
from lambda_core.domain.roles import ROLES
from lambda_core.laws.law import Law

_INTRODUCTION = """# Model reference

This page lists every built-in law with its parameters, every comparison method and every view, for readers who choose
or judge them. The [theory](../theory/index.md) explains them in context. `lambda-bearing plugins show ROLE/NAME` prints
one law, also of [your own packages](../plugins.md):

```console
$ lambda-bearing plugins show rheology/roelands
rheology/roelands ...
summary      Viscosity after Roelands and Walther.
...
```

A law is chosen with `models.ROLE = "NAME"`, or for one force element with `forces.ELEMENT.models.ROLE`; its parameters
are set with `parameters.ROLE.NAME`. A parameter marked *lubricant* comes from the oil's row in the catalogue. Status:
*unconfirmed* is in common use but was not checked in its original; *assumed* is a value without a published source;
*numerical* is a regularisation.
"""


def models_page() -> str:
    """Return the page."""
    models = registry()
    lines = [_INTRODUCTION]
    for role in ROLES.values():
        lines += [f"## {role.name}", "", _role(role), ""]
        for name in models.names(role.name):
            if _own(models, role.name, name):
                lines += _law(model_card(models, f"{role.name}/{name}"), models.model(role.name, name))
    return md.page([*lines, *_methods(models), *_views(models)])


def _own(models: Registry, kind: str, name: str) -> bool:
    return models.origin(kind, name).split(" ")[0] == OWN


def _role(role: Role) -> str:
    carried = ", ".join(md.code(element) for element in role.elements)
    arguments = ", ".join(argument.name for argument in role.arguments)
    return f"{role.summary[0].upper()}{role.summary[1:]}. Force elements: {carried}.\n\n`{role.name}({arguments})`"


def _law(card: ModelCard, law: Law) -> list[str]:
    lines = [f"### {card.role}/{card.name}", ""]
    if card.default:
        lines += ["The default of its role.", ""]
    lines += [_prose(inspect.getdoc(law.kernel) or card.summary), ""]
    facts = {"Reference": card.reference, "Validity": card.validity}
    facts |= {f"Status {status}": sentence for status, sentence in card.errors.items()}
    lines += [f"- {title}: {md.cell(text)}" for title, text in facts.items() if text and text != "-"] + [""]
    rows = [
        [
            md.code(p.name),
            md.code(p.quantity) if p.quantity else p.kind,
            "required" if p.required else md.code(p.default),
            md.cell(", ".join(p.limits)),
            md.cell(f"{p.description}{_published(p.published_range)}"),
            md.cell(" ".join(filter(None, (p.source, f"[{p.status}]" if p.status else "")))),
        ]
        for p in card.parameters
    ]
    return lines + (md.table(("parameter", "value", "default", "limits", "meaning", "source"), rows) if rows else [])


def _published(ends: list[str]) -> str:
    return f"; published {ends[0]} to {ends[1]}" if len(ends) == 2 else ""


def _prose(doc: str) -> str:
    """Return a docstring as paragraphs.

    Stars and bars of formulas stay what they are.
    """
    plain = doc.replace("``", "`").replace("*", "\\*").replace("|", "\\|").replace("_", "\\_").replace("<", "&lt;")
    return "\n\n".join(" ".join(part.split()) for part in plain.split("\n\n"))


def _methods(models: Registry) -> list[str]:
    rows = [
        [md.code(m.name), md.cell(m.title), md.cell(m.reference), md.cell(m.validity)]
        for m in models.methods.values()
        if _own(models, "method", m.name)
    ]
    head = ("method", "what it gives", "reference", "validity")
    return ["## Comparison methods", "", "Methods that are compared with the simulation.", "", *md.table(head, rows)]


def _views(models: Registry) -> list[str]:
    rows = [
        [md.code(v.name), md.cell(v.title), _subject(v), md.cell(_options(v)), md.cell(v.reference)]
        for v in models.views.values()
        if _own(models, "view", v.name)
    ]
    head = ("view", "what it shows", "of", "options", "reference")
    return ["## Views", "", "What `lambda-bearing view` draws.", "", *md.table(head, rows)] if rows else []


def _subject(view: Any) -> str:
    return {"result": "one run", "results": "several runs", "study": "a study", "machine": "a machine at rest"}[
        view.subject
    ]


def _options(view: Any) -> str:
    return "; ".join(f"{name}: {info.description or ''}" for name, info in view.options.model_fields.items())

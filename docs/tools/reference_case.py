"""Write the case reference from the declarations of options."""

from __future__ import annotations

from collections.abc import Iterator

import docstrings
import tables as md
from pydantic import BaseModel

from lambda_core.case import elastic, holding, modelling, motion, parts, signals
from lambda_core.case.cards import FieldCard, field_card
from lambda_core.case.case import Case
from lambda_core.domain.elements import ELEMENTS
from lambda_core.domain.roles import DEFAULT_MODELS, MOTION_ROLES
from lambda_core.domain.units import CUSTOMARY, UNITS

_DOFS = (holding.Translation, holding.Tilt, holding.Spin, holding.InnerSpin)
# Tables that stand in several places are described once, under one name for all of these places.
_SHARED: dict[type[BaseModel], str] = {
    parts.InlineMaterial: "materials.PART",
    motion.Load: "loads.BODY",
    motion.Marker: "markers.NAME",
    motion.BetweenBodies: "elements.NAME",
    modelling.ForceElement: "forces.ELEMENT",
    elastic.BendingRing: "elastic.RING",
    holding.Translation: "bodies.BODY.x",
    holding.Tilt: "bodies.BODY.tilt_y",
    holding.Spin: "bodies.BODY.spin",
    holding.InnerSpin: "bodies.inner_ring.spin",
}
_WHERE: dict[type[BaseModel], str] = {
    parts.InlineMaterial: "PART is `inner`, `outer`, `balls` or `cage`: a table in place of a catalogue name.",
    motion.Load: "BODY is `inner_ring`, `outer_ring` or `cage`.",
    motion.Marker: "NAME is yours.",
    motion.BetweenBodies: "NAME is yours. What the law writes acts on the second body, its opposite on the first.",
    modelling.ForceElement: f"ELEMENT is {', '.join(f'`{name}`' for name in ELEMENTS)}. What stands here comes before "
    "`models` and `parameters` of the whole bearing.",
    elastic.BendingRing: "RING is `inner_ring` or `outer_ring`. [What it does](../elastic-rings.md).",
    holding.Translation: "Also for `y` and `z`, of every body.",
    holding.Tilt: "Also for `tilt_z`, of every body.",
    holding.Spin: "Of the outer ring and the cage.",
}
_INTRODUCTION = """# Case reference

This page lists every option of a case file, for authors of cases. A case is a TOML file; `lambda-bearing schema`
prints the same as a JSON schema for editors, and `--set PATH=VALUE` changes one option for one call. The shortest case:

`smallest.toml`:

```toml
name = "smallest"
bearing.designation = "SKF 6208"
lubricant.name = "FVA3"
lubricant.temperature = "70 degC"
operation.speed = "1500 rpm"
loads.radial = "2 kN"
```

```console
$ lambda-bearing check smallest.toml
smallest: no errors, ...
...
```

A dimensional value is a text with its unit, `"16 kN"`; [the units](#units) of each quantity are a closed list. A value
without unit, with a decimal comma or in a unit of another quantity is an error; its message names what to write. Where
a *time function* is allowed, a value is a constant, and [a table](#time-functions) gives a course over time. A degree
of freedom has a short form: `x = "free"`, `x = "200 N/um"`.
"""


def case_page() -> str:
    """Return the whole page."""
    lines = [_INTRODUCTION]
    seen: set[type[BaseModel]] = set()
    lines += ["## The case itself", "", *_options(Case, "", tables=False)]
    for name in Case.model_fields:
        for path, table in _tables(Case, name, ""):
            if table not in seen:
                seen.add(table)
                lines += _section(path, table)
    return md.page([*lines, *_models(), *_watching(), *_time_functions(), *_units()])


def _tables(parent: type[BaseModel], name: str, prefix: str) -> Iterator[tuple[str, type[BaseModel]]]:
    """Yield the tables below one option.

    Itself first, with the path under which each is described.
    """
    for table in _members(parent, name):
        if issubclass(table, signals.TimeTable) or table is modelling.Models:
            continue
        path = _SHARED.get(table, f"{prefix}{name}")
        yield path, table
        for child in table.model_fields:
            yield from _tables(table, child, f"{path}.")


def _members(parent: type[BaseModel], name: str) -> list[type[BaseModel]]:
    from lambda_core.domain.option_tree import members

    return list(members(parent.model_fields[name].annotation))


def _section(path: str, table: type[BaseModel]) -> list[str]:
    level = "##" if "." not in path else "###"
    said = [" ".join(docstrings.parsed(table).text.split()), _WHERE.get(table, "")]
    return [f"{level} `[{path}]`", "", " ".join(filter(None, said)), "", *_options(table, f"{path}.")]


def _options(table: type[BaseModel], prefix: str, tables: bool = True) -> list[str]:
    rows = []
    for name in table.model_fields:
        card = field_card(table, name)
        if card.kind == "table" and not tables:
            continue
        default = "required" if card.required else md.code(card.default)
        meaning = card.description + (f" ({card.reference})" if card.reference else "")
        rows.append([md.code(f"{prefix}{name}"), _value(table, name, card), default, md.cell(meaning)])
    return md.table(("option", "value", "default", "meaning"), rows) if rows else []


def _value(table: type[BaseModel], name: str, card: FieldCard) -> str:
    """Say what may be written."""
    limits = f" {', '.join(md.cell(limit) for limit in card.limits)}" if card.limits else ""
    members = _members(table, name)
    if card.kind == "quantity":
        return f"[{card.quantity.replace('_', ' ')}](#units){limits}"
    if card.kind == "signal":
        return f"{_quantity_of(members)}, or a [time function](#time-functions)"
    if card.kind == "choice":
        return " or ".join(md.code(choice) for choice in card.choices)
    if members and members[0] in _DOFS:
        return f"degree of freedom, see [{_SHARED[members[0]]}](#{_anchor(_SHARED[members[0]])})"
    if card.kind == "table":
        return "name or table" if members == [parts.InlineMaterial] else "table"
    words = {
        "text": "text",
        "number": "number",
        "integer": "whole number",
        "flag": "`true` or `false`",
        "pairs": "list of pairs",
    }
    return f"{words.get(card.kind, 'list of texts')}{limits}"


def _anchor(path: str) -> str:
    return path.lower().replace(".", "")


def _quantity_of(members: list[type[BaseModel]]) -> str:
    """Return the link to a quantity.

    Of a time function's values.
    """
    value = next(m for m in members if m.__name__.startswith("Constant"))
    return f"[{field_card(value, 'value').quantity.replace('_', ' ')}](#units)"


def _models() -> list[str]:
    """List the roles once for `models` and `forces.ELEMENT.models`."""
    rows = [
        [
            md.code(f"models.{role.name}"),
            md.code(DEFAULT_MODELS[role.name]),
            md.cell(modelling.Models.model_fields[role.name].description or ""),
            ", ".join(md.code(element) for element in role.elements),
        ]
        for role in MOTION_ROLES.values()
    ]
    return [
        "## `[models]`",
        "",
        "Which law fills each role; the [model reference](models.md) has them all. `forces.ELEMENT.models.ROLE` sets "
        "one force element apart. `parameters.ROLE.NAME` sets a parameter of the chosen law, "
        "`forces.ELEMENT.parameters.ROLE.NAME` that of one force element.",
        "",
        *md.table(("option", "default", "meaning", "force elements"), rows),
    ]


def _watching() -> list[str]:
    """Describe the tables of observers and events.

    Their parameters are the plugins' own.
    """
    rows = [
        ["`observers.NAME.PARAMETER`", "by the observer", Case.model_fields["observers"].description or ""],
        ["`events.NAME.action`", '`"stop"`', 'what a run does at the event: `"stop"` or `"record"`'],
        ["`events.NAME.PARAMETER`", "by the event", Case.model_fields["events"].description or ""],
    ]
    return [
        "## `[observers]` and `[events]`",
        "",
        "NAME is an observer or event that [a plugin](../plugin-reference.md#channels-and-events-of-your-own) brings; "
        "an empty table, `[observers.NAME]`, leaves all parameters at their defaults.",
        "",
        *md.table(("option", "default", "meaning"), rows),
    ]


def _time_functions() -> list[str]:
    """Describe the kinds of time function."""
    lines = [
        "## Time functions",
        "",
        "Loads, moments, speeds and prescribed motions may change over time. A value is a constant; a table names its "
        '`kind`, for example `axial = { kind = "ramp", start = "0 N", end = "5 kN", end_time = "0.2 s" }`. VALUE below '
        "has the quantity of the option.",
        "",
    ]
    for kind in (signals.Constant, signals.Ramp, signals.Harmonic, signals.Table, signals.ByLaw, signals.Sum):
        name = kind.model_fields["kind"].annotation.__args__[0]
        rows = []
        for field, info in kind.model_fields.items():
            if field == "kind":
                continue
            card = field_card(kind, field)
            value = f"[{card.quantity}](#units)" if card.quantity else "VALUE"
            value = {
                "points": "list of pairs [time, VALUE]",
                "file": "text",
                "terms": "list",
                "law": "text",
                "parameters": "table",
                "interpolation": " or ".join(md.code(choice) for choice in card.choices),
            }.get(field, value)
            default = "required" if card.required else md.code(card.default)
            rows.append([md.code(field), value, default, md.cell(info.description or "")])
        doc = (kind.__doc__ or "").strip().replace("\n    ", " ").replace("``", "`")
        lines += [f'### `kind = "{name}"`', "", doc, "", *md.table(("option", "value", "default", "meaning"), rows)]
    return lines


def _units() -> list[str]:
    rows = [
        [quantity.replace("_", " "), *(", ".join(map(md.code, some)) for some in (units, CUSTOMARY.get(quantity, ())))]
        for quantity, units in UNITS.items()
    ]
    return [
        "## Units",
        "",
        "The first of each list is the one that the program writes. Customary units are read wherever a value is "
        "written: in files, in `--set`, in the builder; `--units us` shows numbers in them.",
        "",
        *md.table(("quantity", "units", "customary units"), rows),
    ]

"""Summarise the values of each node of the tree."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.domain.elements import DOFS
from lambda_core.domain.roles import DEFAULT_MODELS
from lambda_core.domain.value_status import ESTIMATED
from lambda_gui.nodes import Keys, Node, table_model

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_gui.case_context import CaseContext


# Options that tell most of a table, in order: of named tables, and of sections
_TELL = {
    "bearings": ("designation", "at", "takes"),
    "gears": ("at", "power", "torque"),
    "discs": ("at", "mass"),
    "bodies": ("x", "mass", "length", "diameter"),
    "markers": ("body", "x", "y", "z"),
    "loads": ("at", "force_z", "force_y", "force_x", "moment_x", "moment_y", "moment_z"),
    "connections": ("at", "to", "z", "y", "x"),
    "elements": ("law",),
    "events": ("action",),
    "bearing": ("designation", "maker"),
    "operation": ("speed",),
    "lubricant": ("name", "temperature"),
    "housing": ("temperature", "reduced"),
    "life": ("contamination",),
    "requirements": ("life", "static_safety"),
}


def summary(node: Node, draft: Draft, around: CaseContext) -> str:
    """Return a short text about a node.

    "" where there is nothing to report.

    Parts after a tab are left out where the room is short.
    """
    key = node.key
    if node.kind == "role":
        written = draft.get(*node.law_places[0])
        shared = draft.get("models", node.role) if node.table else None
        return str(written or around.resolved(node.law_places[0]) or shared or DEFAULT_MODELS[node.role])
    if node.kind == "named":
        return str(len(node.children)) if node.children else _absent(node, draft)
    if node.kind == "item":
        return _item(node, draft)
    if key == "case":
        return _text(draft.get("name"))
    if key == "loads":
        return _loads(draft.get("loads"))
    if key.startswith("boundary."):
        return _freedoms(node, draft)
    if key == "surface":
        return _known(draft, around, "surface", "roughness")
    if key == "bodies.cage":
        return _known(draft, around, "bodies", "cage", "type") or "steel-ribbon"
    if key == "bodies.balls":
        return _elements(around)
    if key.startswith("bodies."):
        return _mass(draft, around, ("bodies", key.split(".")[1], "mass"))
    if key == "depth":
        return _depth(draft.get("depth") or {})
    if key == "solver":
        return _text(draft.get("solver", "duration")) or "until converged"
    if key == "bearing.rollers":
        written = draft.get("bearing", "rollers")
        return f"{len(written)} set" if isinstance(written, Mapping) and written else ""
    if key in ("bearing.geometry", "bearing.fits", "bearing.temperatures", "lubricant.properties"):
        written = draft.get(*key.split("."))
        return f"{len(written)} set" if isinstance(written, Mapping) and written else "catalogue"[: 9 * ("geo" in key)]
    return _parts(*(draft.get(key, name) for name in _TELL.get(key, ())))


def _absent(node: Node, draft: Draft) -> str:
    """Return a text about missing parts.

    They are named parts; without pieces the shaft of a single bearing is rigid.
    """
    bearings = draft.get("bearings")
    is_single = isinstance(bearings, Mapping) and len(bearings) == 1
    is_rigid = node.table[:1] == ("shaft",) and is_single and draft.get("shaft", "reduced") is None
    return "rigid" if is_rigid else "none"


def _item(node: Node, draft: Draft) -> str:
    """Return a short text about a table.

    It is a named table, or a piece of the shaft.
    """
    written = draft.get(*node.table)
    table: Mapping[str, Any] = written if isinstance(written, Mapping) else {}
    section = node.table[0]
    if section == "shaft":
        return f"⌀ {_text(table.get('diameter')) or '?'}\tx {_text(table.get('length')) or '?'}"
    words = _parts(*(table.get(name) for name in _TELL.get(section, ())))
    return words.replace("_", " ") if section in ("markers", "elements") else words


def _text(value: Any) -> str:
    """Return a value as in the file.

    A time function gives its kind; any other table gives "".
    """
    if isinstance(value, Mapping):
        return str(value.get("kind", ""))
    return "" if value is None or isinstance(value, list) else str(value)


def _parts(*values: Any) -> str:
    return "\t".join(filter(None, map(_text, values)))


def _loads(loads: Any) -> str:
    if not isinstance(loads, Mapping):
        return "none"
    names = ("radial", "axial", "moment_y", "moment_z")
    found = [f"{_text(loads[name])} {name.split('_')[0]}" for name in names if name in loads]
    return "\t".join(found) or "none"


def _freedoms(node: Node, draft: Draft) -> str:
    body = node.key.split(".")[1]
    table = table_model(draft.root, ("bodies", body))
    modes: dict[str, int] = {}
    for name in DOFS:
        mode = _text(draft.get("bodies", body, name, "mode"))
        if not mode:
            is_prescribed = draft.get("bodies", body, name, "motion") is not None
            written = draft.get("bodies", body, name) is not None
            mode = "prescribed" if is_prescribed else "free" if written else str(table.model_fields[name].default)
        modes[mode] = modes.get(mode, 0) + 1
    return "all " + next(iter(modes)) if len(modes) == 1 else "\t".join(f"{n} {mode}" for mode, n in modes.items())


def _known(draft: Draft, around: CaseContext, *keys: str) -> str:
    return _text(draft.get(*keys)) or around.resolved(keys)


def _mass(draft: Draft, around: CaseContext, keys: Keys) -> str:
    value = around.value(keys)
    if value is None:
        return _text(draft.get(*keys))
    number, _, unit = value.text.partition(" ")
    return f"≈ {float(number):.3g} {unit}"


def _elements(around: CaseContext) -> str:
    """Return number and size of balls or rollers."""
    balls, rollers = ("geometry", "ball_count", "ball_diameter"), ("rollers", "roller_count", "roller_diameter")
    for table, *names in (balls, rollers):
        count, size = (around.value(("bearing", table, name)) for name in names)
        if count is not None and size is not None:
            break
    else:
        return ""
    return f"{'≈ ' if count.status in ESTIMATED else ''}{count.text} x {size.text}"


def _depth(depth: Any) -> str:
    if not isinstance(depth, Mapping):
        return ""
    cage = "" if depth.get("cage", True) else "\tno cage"
    return f"{depth.get('rows', 1)} x {depth.get('strips', 31)} cells{cage}"

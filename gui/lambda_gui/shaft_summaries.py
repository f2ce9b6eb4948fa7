"""Summarise each node of a shaft's tree in a few words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_gui.around import CaseAround
    from lambda_gui.nodes import Node

# Options that tell most of a table, in order
_TELL = {
    "gears": ("at", "power", "torque"),
    "discs": ("at", "mass"),
    "bodies": ("x", "mass", "length", "diameter"),
    "markers": ("body", "x", "y", "z"),
    "loads": ("at", "force_z", "force_y", "force_x", "moment_x", "moment_y", "moment_z"),
    "connections": ("at", "to", "z", "y", "x"),
    "operation": ("speed",),
    "lubricant": ("name", "temperature"),
    "housing": ("temperature", "reduced"),
    "life": ("contamination",),
    "requirements": ("life", "static_safety"),
    "solver": ("duration", "accuracy"),
}


def of_shaft(node: Node, draft: Draft, around: CaseAround) -> str:
    """Return a few words about a node; parts after a tab are left out where the room is short."""
    section = node.table[0] if node.table else node.key
    if node.key == "case":
        return _text(draft.get("name"))
    if node.kind == "named":
        return str(len(node.children) or "none")
    if node.kind == "item":
        written = draft.get(*node.table)
        table: Mapping[str, Any] = written if isinstance(written, Mapping) else {}
        if section == "shaft":
            return f"⌀ {_text(table.get('diameter')) or '?'}\tx {_text(table.get('length')) or '?'}"
        if section == "bearings":
            return _parts(*(table.get(name) for name in ("designation", "at", "takes")))
        return _parts(*(table.get(name) for name in _TELL.get(section, ())))
    if node.key == "surface":
        return _text(draft.get("surface", "roughness")) or around.resolved(("surface", "roughness"))
    if node.key in _TELL:
        return _parts(*(draft.get(node.key, name) for name in _TELL[node.key]))
    return ""


def _text(value: Any) -> str:
    if isinstance(value, Mapping):
        return str(value.get("kind", ""))
    return "" if value is None or isinstance(value, list) else str(value)


def _parts(*values: Any) -> str:
    return "\t".join(filter(None, map(_text, values)))

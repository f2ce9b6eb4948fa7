"""Summarise the values of each node of the tree."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from lambda_core.domain.elements import DOFS
from lambda_core.domain.roles import DEFAULT_MODELS
from lambda_gui.nodes import Keys, Node, table_model
from lambda_gui.shaft_summaries import of_shaft

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_gui.around import CaseAround


def summary(node: Node, draft: Draft, around: CaseAround) -> str:
    """Return a few words about a node, "" where there is nothing to say.

    Parts after a tab are left out where the room is short.
    """
    key = node.key
    if draft.is_shaft and node.kind != "role":
        return of_shaft(node, draft, around)
    if node.kind == "role":
        written = draft.get(*node.law_places[0])
        shared = draft.get("models", node.role) if node.table else None
        return str(written or around.resolved(node.law_places[0]) or shared or DEFAULT_MODELS[node.role])
    if key == "case":
        return _text(draft.get("name"))
    if key == "bearing":
        return _parts(draft.get("bearing", "designation"), draft.get("bearing", "maker"))
    if key == "motion":
        return ""
    if key == "loads":
        return _loads(draft.get("loads"))
    if key == "operation":
        return _signal(draft.get("operation", "speed"))
    if key.startswith("boundary."):
        return _freedoms(node, draft)
    if key == "lubricant":
        return _parts(draft.get("lubricant", "name"), draft.get("lubricant", "temperature"))
    if key == "surface":
        return _known(draft, around, "surface", "roughness")
    if key == "bodies.cage":
        return _known(draft, around, "bodies", "cage", "type") or "steel-ribbon"
    if key == "bodies.balls":
        return _balls(around)
    if key.startswith("bodies."):
        return _mass(draft, around, ("bodies", key.split(".")[1], "mass"))
    if key == "depth":
        return _depth(draft.get("depth") or {})
    if key == "solver":
        return _text(draft.get("solver", "duration")) or "until converged"
    if node.kind == "named":
        return str(len(node.children) or "none")
    if node.kind == "item":
        written = draft.get(*node.table)
        told = {"markers": "body", "elements": "law", "events": "action"}.get(key.partition(".")[0], "")
        return _text(written.get(told)).replace("_", " ") if isinstance(written, Mapping) else ""
    if key in ("bearing.geometry", "bearing.fits", "bearing.temperatures", "lubricant.properties"):
        written = draft.get(*key.split("."))
        return f"{len(written)} set" if isinstance(written, Mapping) and written else "catalogue"[: 9 * ("geo" in key)]
    return ""


def _text(value: Any) -> str:
    return "" if value is None or isinstance(value, Mapping | list) else str(value)


def _parts(*values: Any) -> str:
    return "\t".join(filter(None, map(_text, values)))


def _signal(value: Any) -> str:
    return str(value.get("kind", "")) if isinstance(value, Mapping) else _text(value)


def _loads(loads: Any) -> str:
    if not isinstance(loads, Mapping):
        return "none"
    names = ("radial", "axial", "moment_y", "moment_z")
    found = [f"{_signal(loads[name])} {name.split('_')[0]}" for name in names if name in loads]
    return "\t".join(found) or "none"


def _freedoms(node: Node, draft: Draft) -> str:
    body = node.key.split(".")[1]
    table = table_model(draft.root, ("bodies", body))
    modes: dict[str, int] = {}
    for name in DOFS:
        mode = _text(draft.get("bodies", body, name, "mode"))
        if not mode:
            is_led = draft.get("bodies", body, name, "motion") is not None
            written = draft.get("bodies", body, name) is not None
            mode = "prescribed" if is_led else "free" if written else str(table.model_fields[name].default)
        modes[mode] = modes.get(mode, 0) + 1
    return "all " + next(iter(modes)) if len(modes) == 1 else "\t".join(f"{n} {mode}" for mode, n in modes.items())


def _known(draft: Draft, around: CaseAround, *keys: str) -> str:
    return _text(draft.get(*keys)) or around.resolved(keys)


def _mass(draft: Draft, around: CaseAround, keys: Keys) -> str:
    value = around.value(keys)
    if value is None:
        return _text(draft.get(*keys))
    number, _, unit = value.text.partition(" ")
    return f"≈ {float(number):.3g} {unit}"


def _balls(around: CaseAround) -> str:
    count, size = (around.value(("bearing", "geometry", name)) for name in ("ball_count", "ball_diameter"))
    if count is None or size is None:
        return ""
    return f"{'≈ ' if count.status in ('derived', 'assumed') else ''}{count.text} x {size.text}"


def _depth(depth: Any) -> str:
    if not isinstance(depth, Mapping):
        return ""
    cage = "" if depth.get("cage", True) else "\tno cage"
    return f"{depth.get('rows', 1)} x {depth.get('strips', 31)} cells{cage}"

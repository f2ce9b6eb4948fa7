"""Add and remove tables of a case."""

from __future__ import annotations

from copy import deepcopy
from itertools import chain, count
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_gui.nodes import Keys, Node


def is_list(node: Node) -> bool:
    """Tell whether a section's tables have numbers.

    Numbers replace names; it may be the section of a table.
    """
    last = node.table[-2:] if node.kind == "item" else node.table[-1:]
    return last[0] == "sections"


def free_name(node: Node, draft: Draft) -> str:
    """Return an unused name for a table.

    No table of the section has it yet.
    """
    assert node.section is not None
    section = _section(node)
    usual = node.section.usual or (node.section.one,)
    taken = draft.get(*section) or {}
    numbered = (f"{usual[-1]}-{number}" for number in count(2))
    return next(name for name in chain(usual, numbered) if name not in taken)


def add(node: Node, draft: Draft, name: str = "") -> Keys:
    """Write a new table and return its place.

    It goes into a section, or after the table of a node; a known name shows its table.

    Parameters
    ----------
    name : str
        Of the table; without one the next of the usual names.
    """
    assert node.section is not None
    section = _section(node)
    if is_list(node):
        tables: list[Any] = deepcopy(draft.get(*section) or [])
        at = int(node.table[-1]) + 1 if node.kind == "item" else len(tables)
        tables.insert(at, dict(node.section.begins))
        _put(draft, section, tables)
        return (*section, str(at))
    place = (*section, name or free_name(node, draft))
    if draft.get(*place) is None:
        draft.seal()
        draft.set(*place, value=dict(node.section.begins))
        draft.seal()
    return place


def remove(node: Node, draft: Draft) -> Keys:
    """Remove a node's table, return the next place."""
    section = _section(node)
    if not is_list(node):
        draft.seal()
        draft.set(*node.table, value=None)
        return section
    tables, at = deepcopy(draft.get(*section)), int(node.table[-1])
    del tables[at]
    _put(draft, section, tables or None)
    return (*section, str(min(at, len(tables) - 1))) if tables else section


# Options that name bodies, bearings and markers: section and option
_ENDS = (("bearings", "outer"), ("connections", "to"))
_REFER: dict[str, tuple[tuple[str, str], ...]] = {
    "bodies": (*_ENDS, ("markers", "body")),
    "bearings": tuple((table, "at") for table in ("discs", "gears", "loads", "connections")),
    "markers": (*_ENDS, *((table, "at") for table in ("bearings", "discs", "gears", "loads", "connections"))),
}


def rename(node: Node, draft: Draft, name: str) -> Keys:
    """Rename the table of a node.

    It changes its place and where others name it; a taken name changes nothing.
    """
    section = _section(node)
    tables: dict[str, Any] = draft.get(*section)
    if name in tables:
        return node.table
    old = node.table[-1]
    _put(draft, section, {name if key == old else key: deepcopy(table) for key, table in tables.items()})
    is_meant = not (section == ("bearings",) and old in (draft.get("markers") or {}))
    for places in _REFER.get(section[0], ()) if is_meant else ():
        for other, table in (draft.get(places[0]) or {}).items():
            if isinstance(table, dict) and table.get(places[1]) == old:
                draft.set(places[0], other, places[1], value=name)
    draft.seal()
    return (*section, name)


def _section(node: Node) -> Keys:
    return node.table[:-1] if node.kind == "item" else node.table


def _put(draft: Draft, section: Keys, tables: Any) -> None:
    """Write a whole section as one change of its own."""
    draft.seal()
    draft.set(*section, value=tables)
    draft.seal()

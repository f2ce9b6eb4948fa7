"""Define nodes of the model tree and their options."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Literal

from pydantic import BaseModel

from lambda_core.api import PROFILE_OPTIONS
from lambda_core.domain.option_tree import is_time_function, members, model_at
from lambda_core.domain.roles import ROLES

Keys = tuple[str, ...]
PROFILE_PARAMETERS = "profile_parameters"  # of a plugin's profile
# Options of rollers that stand under the profile that takes them
PROFILE = (*dict.fromkeys(name for names in PROFILE_OPTIONS.values() for name in names), PROFILE_PARAMETERS)
Kind = Literal["form", "roles", "role", "named", "item"]
Names = Mapping[str, tuple[str, ...]]  # section of named tables, or of a list -> names in the case


@dataclass(frozen=True)
class Named:
    """Section of tables with names.

    The case gives the names, or plugins have their own.
    """

    title: str
    about: str  # the section, in the tree's help
    one: str  # one of it, after "new" and "remove this"
    begins: Mapping[str, Any]  # what is written of a new one
    installed: Literal["", "observer", "event"] = ""  # kind of which the names are those of what is installed
    usual: tuple[str, ...] = ()  # names that are proposed, in order; of a list none: its tables have numbers


@dataclass(frozen=True)
class Group:
    """Options of one table of the case under a heading."""

    title: str
    table: Keys
    names: tuple[str, ...]

    @property
    def fields(self) -> list[Keys]:
        """Places of the options."""
        return [(*self.table, name) for name in self.names]


@dataclass(eq=False)
class Node:
    """One node of the tree.

    Attributes
    ----------
    key : str
        Unique, stable.
    groups : list of Group
        The options on its form, in order.
    role, element : str
        Of a node for one role: which, and of which force element ("" for all of them).
    heading : str
        Over the form; the title where nothing else is given.
    short : str
        Title where the tree is narrow; the title where nothing else is given.
    in_file : list of tuple
        Places that the node answers for but has no row for: they are written in the case's file.
    section : Named or None
        Of a section of named tables, and of each table in it: what they are.
    table : tuple
        Where that section, or that table, is written; of a role, the bearing whose law it is where there are several.
    """

    key: str
    title: str
    help: str = ""
    groups: list[Group] = field(default_factory=list)
    children: list[Node] = field(default_factory=list)
    kind: Kind = "form"
    role: str = ""
    element: str = ""
    heading: str = ""
    short: str = ""
    in_file: list[Keys] = field(default_factory=list)
    section: Named | None = None
    table: Keys = ()

    def __post_init__(self) -> None:
        self.heading = self.heading or self.title
        self.short = self.short or self.title

    def walk(self) -> Iterator[Node]:
        """Yield this node and all below it."""
        yield self
        for child in self.children:
            yield from child.walk()

    @cached_property
    def places(self) -> list[Keys]:
        """Places in the case that this node answers for."""
        found = [place for group in self.groups for place in group.fields] + self.in_file
        if self.kind == "role":
            found += list(self.law_places)
        if self.kind in ("named", "item"):
            found.append(self.table)
        return found

    @property
    def law_places(self) -> tuple[Keys, Keys]:
        """Places of a role's model and parameters."""
        base: Keys
        if self.role == "force_element":
            return ("elements", self.element, "law"), ("elements", self.element, "parameters")
        if ROLES[self.role].section:
            base = (ROLES[self.role].section, self.role)
            return (*base, "law"), (*base, "parameters")
        base = (*self.table, "forces", self.element) if self.element else ()
        return (*base, "models", self.role), (*base, "parameters", self.role)


def table_model(root: type[BaseModel], table: Keys) -> type[BaseModel]:
    """Return the class of a table.

    It is one of the case whose class is `root`.
    """
    found = model_at(root, [int(key) if key.isdecimal() else key for key in table])
    assert found is not None, table
    return found


def told(root: type[BaseModel], path: str) -> str:
    """Return the declared description of an option.

    The path is dotted; the text is "" where there is none.
    """
    *table, name = path.split(".")
    model = model_at(root, [int(key) if key.isdecimal() else key for key in table])
    info = model.model_fields.get(name) if model is not None else None
    return (info.description or "") if info is not None else ""


def is_freedom(table: type[BaseModel] | None) -> bool:
    """Tell whether a table is a degree of freedom.

    It is one option, with its support or motion.
    """
    return table is not None and {"mode", "damping"} <= set(table.model_fields)


def plain_fields(root: type[BaseModel], table: Keys) -> list[str]:
    """Return the plain options of a table.

    They are no tables themselves (time functions are options).
    """
    model = table_model(root, table)
    return [name for name, info in model.model_fields.items() if all(map(is_time_function, members(info.annotation)))]


def about(root: type[BaseModel], table: Keys, *, own: bool = True) -> str:
    """Return a table's description.

    It is the first sentence of its class, or the description of its field.
    """
    if not own:
        return str(table_model(root, table[:-1]).model_fields[table[-1]].description)
    text = (table_model(root, table).__doc__ or "").strip().split("\n")[0]
    return text[:1].lower() + text[1:].rstrip(".") if text else ""

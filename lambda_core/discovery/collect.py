"""Collect the items that plugins register, and check each one."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field, is_dataclass, replace
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel

from lambda_core.domain.errors import unknown_name
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.plugin_errors import PluginError, PluginFault
from lambda_core.domain.roles import ROLE_API, ROLES
from lambda_core.elements.roller.profiles import Name as ProfileName
from lambda_core.laws.law import Law, LazyLaw, law_of
from lambda_core.laws.old_form import new_form
from lambda_core.laws.par import par_layout
from lambda_core.laws.parameter import default_fault
from lambda_core.laws.state import state_fault
from lambda_core.views.method import METHOD_API, Method
from lambda_core.views.observer import event_fault, observer_fault
from lambda_core.views.roller_profile import profile_fault
from lambda_core.views.section import section_fault
from lambda_core.views.view import view_fault

_NAME = re.compile(r"[a-z0-9]+(?:-[a-z0-9]+)*")
_TARGET = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_]\w*")
_RESERVED = ("none", "auto")  # no law, and the law that the oil has data for
_KINDS = {
    "lambda_methods": "method",
    "lambda_views": "view",
    "lambda_observers": "observer",
    "lambda_events": "event",
    "lambda_sections": "section",
    "lambda_profiles": "profile",
}


@dataclass(frozen=True)
class Entry:
    """One call of ``register`` in a hook."""

    hook: str
    distribution: str
    item: Any


@dataclass
class Collection:
    """Everything registered, by kind.

    `take` is all or nothing for one plugin.

    A law is known by its package and its name, "carreau-traction:carreau": no package can take a name from another.
    Of methods and views of one name the first keeps it, the others are called by the qualified one.
    """

    models: dict[tuple[str, str], Law | LazyLaw] = field(default_factory=dict)  # (role, qualified name)
    same: dict[tuple[str, str], str] = field(default_factory=dict)  # a law's second qualified name -> its first
    named: dict[tuple[str, str], Any] = field(default_factory=dict)  # (one of _KINDS, name) -> item
    folders: list[tuple[str, Path]] = field(default_factory=list)  # (distribution, folder)
    origins: dict[tuple[str, str], str] = field(default_factory=dict)  # (kind or role, name) -> distribution
    notes: list[PluginFault] = field(default_factory=list)  # what people should know of plugins in use

    def take(self, entries: Sequence[Entry]) -> str:
        """Add one plugin's entries.

        Return a sentence that explains why none was added, if any.
        """
        claimed: set[tuple[str, str]] = set()
        for entry in entries:
            message = _fault(entry)
            if message:
                return message
            if entry.hook == "lambda_data":
                continue
            key = _key(entry)
            plain = (key[0], _short(key[1]))
            if plain[1] in _RESERVED and not is_own(entry.distribution):
                return f'the {key[0]} name "{plain[1]}" has a meaning of its own in every case: choose another'
            if key in claimed or entry.distribution in (self.origins.get(key), self.origins.get(plain)):
                return f'the {key[0]} "{_short(key[1])}" is already taken by {entry.distribution}'
            claimed.add(key)
        for entry in entries:
            self._add(entry)
        return ""

    def _add(self, entry: Entry) -> None:
        if entry.hook == "lambda_data":
            self.folders.append((entry.distribution, Path(entry.item)))
            return
        key = _key(entry)
        law = law_of(entry.item)
        if law and (first := self._same_kernel(law)):
            self.same[key] = first
            return
        if law:
            self.models[key] = replace(law, distribution=entry.distribution)
        elif isinstance(entry.item, LazyLaw):
            self.models[key] = entry.item
        else:
            key = self._named(entry)
        self.origins[key] = entry.distribution

    def _named(self, entry: Entry) -> tuple[str, str]:
        """Add a method or a view under its name.

        It takes the qualified name where its name is taken.
        """
        kind, full = _key(entry)
        name, item = entry.item.name, with_distribution(entry.item, entry.distribution)
        if owner := self.origins.get((kind, name)):
            self.notes.append(
                PluginFault(
                    entry.distribution, name, f'its {kind} "{name}" is called {full}: {owner} has one of that name',
                    is_broken=False,
                )
            )  # fmt: skip
            name, item = full, replace(item, name=full)
        self.named[kind, name] = item
        return kind, name

    def _same_kernel(self, law: Law) -> str:
        """Return the qualified name of a known kernel.

        A program passed a law that a package has.
        """
        target = f"{getattr(law.kernel, '__module__', '')}:{getattr(law.kernel, '__qualname__', '')}"
        for (role, full), known in self.models.items():
            if (role, _short(full)) == (law.role, law.name) and (
                known.target == target if isinstance(known, LazyLaw) else known.kernel is law.kernel
            ):
                return full
        return ""


def _short(name: str) -> str:
    """Return a name without the package before it."""
    return name.rpartition(":")[2]


def is_own(distribution: str) -> bool:
    """Tell whether "name version" is this program's own distribution."""
    return project_of(distribution) == OWN


def with_distribution(item: Any, distribution: str) -> Any:
    """Return a copy with its distribution.

    The copy is one of a dataclass that has the field; other objects are unchanged.
    """
    if is_dataclass(item) and not isinstance(item, type) and hasattr(item, "distribution"):
        return replace(item, distribution=distribution)
    return item


def _key(entry: Entry) -> tuple[str, str]:
    """Return role or kind, and the qualified name."""
    law = law_of(entry.item) or entry.item
    kind = law.role if entry.hook == "lambda_laws" else _KINDS[entry.hook]
    return kind, f"{project_of(entry.distribution)}:{law.name}"


def _fault(entry: Entry) -> str:
    """Say what is wrong with one registration, or nothing."""
    item = entry.item
    if entry.hook == "lambda_data":
        return _folder_fault(item)
    if entry.hook == "lambda_laws":
        if law := law_of(item):
            return law_fault(law)
        if isinstance(item, LazyLaw):
            return _lazy_fault(item)
        return f"lambda_laws registers a {type(item).__name__}: write @law(role, name, ...) above the kernel"
    if entry.hook == "lambda_methods":
        return _method_fault(item)
    if entry.hook == "lambda_observers":
        return observer_fault(item) or _name_fault("observer", item.name)
    if entry.hook == "lambda_events":
        return event_fault(item) or _name_fault("event", item.name)
    if entry.hook == "lambda_sections":
        return section_fault(item) or _name_fault("section", item.name)
    if entry.hook == "lambda_profiles":
        return profile_fault(item) or _profile_name_fault(item.name)
    return view_fault(item) or _name_fault("view", item.name)


def _name_fault(kind: str, name: str) -> str:
    if _NAME.fullmatch(name):
        return ""
    return f'the {kind} name "{name}" is not in lower case with hyphens ("my-law")'


def _profile_name_fault(name: str) -> str:
    if name in get_args(ProfileName):
        return f'the profile "{name}" is one of the program: choose another name'
    return _name_fault("profile", name)


def _lazy_fault(item: LazyLaw) -> str:
    if item.role not in ROLES:
        return unknown_name("role", item.role, ROLES)
    if not _TARGET.fullmatch(item.target):
        return f'the target "{item.target}" of {item.role}/{item.name} is not of the form "package.module:attribute"'
    return _name_fault(item.role, item.name)


def law_fault(item: Law) -> str:
    """Say what keeps a law from being registered, or nothing."""
    label = f"{item.role}/{item.name}"
    if item.role_api != ROLE_API:
        return f"{label} is written for version {item.role_api} of the role interface; this program has {ROLE_API}" + (
            f": {new_form(item)}" if item.role_api < ROLE_API else ""
        )
    if item.role not in ROLES:
        return unknown_name("role", item.role, ROLES)
    if not callable(item.kernel):
        return f"the kernel of {label} is a {type(item.kernel).__name__}, not a function"
    if not (isinstance(item.parameters, type) and issubclass(item.parameters, BaseModel)):
        return f"the parameters of {label} are not a pydantic BaseModel class"
    if not item.reference.strip():
        return f'{label} has no reference: name its source ("own work" is one)'
    try:
        par_layout(item)
    except PluginError as error:
        return str(error)
    states = state_fault(item)
    if states:
        return f"{label} {states}"
    fault = default_fault(item.parameters)
    return f"{label}: {fault}" if fault else _name_fault(item.role, item.name)


def _method_fault(item: Any) -> str:
    if not isinstance(item, Method):
        return f"lambda_methods registers a {type(item).__name__}: wrap the function in Method(name, title, ...)"
    if item.method_api is None:
        return f"the method {item.name} does not say for which version it is written: write method_api={METHOD_API}"
    if item.method_api != METHOD_API:
        return f"the method {item.name} is written for version {item.method_api} of the interface; this is {METHOD_API}"
    if not callable(item.evaluate):
        return f"the method {item.name} evaluates with a {type(item.evaluate).__name__}, not a function"
    if not item.reference.strip():
        return f'the method {item.name} has no reference: name its source ("own work" is one)'
    return _name_fault("method", item.name)


def _folder_fault(item: Any) -> str:
    if not isinstance(item, str | Path):
        return f"lambda_data registers a {type(item).__name__}: hand over a folder (a str or Path)"
    if not Path(item).is_dir():
        return f"the data folder {item} does not exist"
    return ""

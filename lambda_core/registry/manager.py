"""Discovery of plugins: entry points in, a frozen registry of everything they bring out.

Each entry point of the group ``lambda_bearing.plugins`` is loaded on its own. One that
fails, misspells a hook, claims a taken name or is written for another version of the
role interface is switched off as a whole and kept as a named fault; the rest works.
"""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Hashable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any

import pluggy

from lambda_core.errors import UsageError, nearest, unknown_name
from lambda_core.registry import hookspecs
from lambda_core.registry.collect import OWN, Collection, Entry
from lambda_core.registry.faults import PluginFault, describe
from lambda_core.registry.registry import Registry

GROUP = "lambda_bearing.plugins"
COMMAND_GROUP = "lambda_bearing.commands"
OFF_VARIABLE = "LAMBDA_BEARING_NO_PLUGIN"
_REGISTERING_HOOKS = ("lambda_models", "lambda_methods", "lambda_views", "lambda_data")

log = logging.getLogger("lambda_core")


@dataclass(frozen=True)
class Source:
    """One plugin to load: where it comes from and how to get it."""

    project: str  # name of the distribution
    version: str
    name: str  # of the entry point
    load: Callable[[], object] = field(repr=False, compare=False)

    @property
    def distribution(self) -> str:
        """Name and version, as messages show them."""
        return f"{self.project} {self.version}".rstrip()


def _source(point: EntryPoint) -> Source:
    distribution = point.dist
    if distribution is None:
        return Source(point.module, "", point.name, point.load)
    return Source(distribution.name, distribution.version, point.name, point.load)


def installed(group: str = GROUP) -> list[Source]:
    """Return the installed plugins of `group`, our own first, none imported."""
    sources = {(s.project, s.name): s for s in map(_source, entry_points(group=group))}
    return sorted(sources.values(), key=lambda s: (s.project != OWN, s.project, s.name))


def switched_off() -> tuple[str, ...]:
    """Return the names in ``LAMBDA_BEARING_NO_PLUGIN`` (comma separated)."""
    return tuple(name for name in map(str.strip, os.environ.get(OFF_VARIABLE, "").split(",")) if name)


def switch_off(names: Iterable[str]) -> None:
    """Switch plugins off for this process and those it starts (``--no-plugin NAME``).

    Parameters
    ----------
    names : iterable of str
        Distributions or entry points.

    Raises
    ------
    UsageError
        When a name is not installed.
    """
    known = {name for source in installed() for name in (source.project, source.name)}
    for name in names:
        if name not in known:
            raise UsageError(unknown_name("plugin", name, known))
    os.environ[OFF_VARIABLE] = ",".join(dict.fromkeys((*switched_off(), *names)))
    registry.cache_clear()


@lru_cache(maxsize=1)
def registry() -> Registry:
    """Return the registry of this process, discovered at the first call; broken plugins are logged."""
    found = discover(installed(), off=switched_off())
    for fault in found.faults:
        if fault.is_broken:
            log.warning("plugin not in use: %s", fault)
    return found


def commands() -> list[Source]:
    """Return the commands that plugins add to the program, sorted by name, none imported.

    ``source.name`` is the command's name and ``source.load()`` its typer application. Of
    two with one name the first distribution's counts; switched-off plugins have none.
    """
    off = set(switched_off())
    found: dict[str, Source] = {}
    for source in installed(COMMAND_GROUP):
        if not off & {source.project, source.name}:
            found.setdefault(source.name, source)
    return sorted(found.values(), key=lambda s: s.name)


def discover(sources: Sequence[Source], off: Iterable[str] = ()) -> Registry:
    """Load every plugin of `sources` in its own try and freeze what they register.

    Parameters
    ----------
    sources : sequence of Source
        In order of precedence: of two that claim one name, the first keeps it.
    off : iterable of str
        Distributions or entry points to leave out.
    """
    off = tuple(dict.fromkeys(off))
    known = {name for source in sources for name in (source.project, source.name)}
    faults = [
        PluginFault(name, OFF_VARIABLE, "is switched off but not installed" + _did_you_mean(name, known))
        for name in off
        if name not in known
    ]
    manager = pluggy.PluginManager(hookspecs.PROJECT)
    manager.add_hookspecs(hookspecs)
    collection = Collection()
    in_use: list[str] = []
    for source in sources:
        if source.project in off or source.name in off:
            faults.append(PluginFault(source.distribution, source.name, "is switched off", is_broken=False))
            continue
        message = _add(manager, source, collection)
        if message:
            faults.append(PluginFault(source.distribution, source.name, message))
        else:
            in_use.append(source.distribution)
    return Registry(collection, tuple(dict.fromkeys(in_use)), tuple(faults), manager)


def _did_you_mean(name: str, known: Iterable[str]) -> str:
    close = nearest(name, known)
    return f"; nearest: {', '.join(close)}" if close else ""


def _add(manager: pluggy.PluginManager, source: Source, collection: Collection) -> str:
    """Load one plugin and take what it registers; return why not, or nothing."""
    try:
        plugin = source.load()
    except (Exception, SystemExit) as error:
        return f"cannot be imported: {describe(error)}"
    if not isinstance(plugin, Hashable):
        return f"is a {type(plugin).__name__}: the entry point has to name a module with hooks"
    name = f"{source.project}:{source.name}"
    try:
        manager.register(plugin, name=name)
    except (ValueError, pluggy.PluginValidationError) as error:
        _forget(manager, name)
        return f"does not fit the hooks: {' '.join(str(error).split())}"
    message = _misspelled(manager, plugin) or _collect(manager, plugin, source, collection)
    if message:
        _forget(manager, name)
    return message


def _forget(manager: pluggy.PluginManager, name: str) -> None:
    if manager.has_plugin(name):
        manager.unregister(name=name)


def _misspelled(manager: pluggy.PluginManager, plugin: object) -> str:
    """Say which hook of `plugin` does not exist (pluggy alone would ignore it)."""
    known = [name for name in vars(hookspecs) if name.startswith("lambda_")]
    mine = manager.get_hookcallers(plugin) or []
    for hook in mine:
        if not hook.has_spec():
            return unknown_name("hook", hook.name, known)
    if not mine:
        unmarked = [name for name in dir(plugin) if name in known]
        if unmarked:
            return f"{unmarked[0]} is not marked: write @hookimpl above it"
        return f"implements no hook; there are: {', '.join(known)}"
    return ""


def _collect(manager: pluggy.PluginManager, plugin: object, source: Source, collection: Collection) -> str:
    """Call the registering hooks of one plugin; all of it is taken, or nothing."""
    others = [other for other in manager.get_plugins() if other is not plugin]
    entries: list[Entry] = []
    for hook_name in _REGISTERING_HOOKS:

        def register(item: Any, hook_name: str = hook_name) -> None:
            entries.append(Entry(hook_name, source.distribution, item))

        try:
            manager.subset_hook_caller(hook_name, others)(register=register)
        except (Exception, SystemExit) as error:
            return f"{hook_name} raised {describe(error)}"
    return collection.take(entries)

"""Discover plugins and register what they provide.

Each entry point of the group ``lambda_bearing.plugins`` is loaded on its own. One that
fails, misspells a hook, claims a taken name or is written for another version of the
role interface is switched off completely and kept as a named fault; the rest works.
"""

from __future__ import annotations

import contextlib
import logging
import os
import sys
import time
from collections.abc import Callable, Hashable, Iterable, Sequence
from functools import lru_cache, partial
from pathlib import Path
from types import ModuleType
from typing import Any

import pluggy

from lambda_core.discovery import hookspecs
from lambda_core.discovery.collect import Collection, Entry
from lambda_core.discovery.local_files import add_file, file_sources, take_guests
from lambda_core.discovery.registry import Registry
from lambda_core.domain.errors import UsageError, nearest, unknown_name
from lambda_core.domain.inline_laws import InlineLaw, inline_laws, when_changed
from lambda_core.domain.installed import CASES, COMMANDS, OFF_VARIABLE, OWN, PLUGINS, Source, installed, switched_off
from lambda_core.domain.plugin_errors import PluginError, PluginFault, describe
from lambda_core.laws.law import Law, law_of

_REGISTERING_HOOKS = (
    "lambda_laws",
    "lambda_methods",
    "lambda_views",
    "lambda_observers",
    "lambda_events",
    "lambda_sections",
    "lambda_profiles",
    "lambda_data",
)

_SLOW_IMPORT = 1.0  # [s]
SLOW = "slow"  # stands for the entry point in the note of a slow import

_told_by_caller: set[str] = set()  # files that were asked for: their fault is an error, no warning

log = logging.getLogger("lambda_core")


def switch_off(names: Iterable[str]) -> None:
    """Switch plugins off (``--no-plugin NAME``).

    They are off for this process and those that it starts.

    Parameters
    ----------
    names : iterable of str
        Distributions or entry points.

    Raises
    ------
    UsageError
        When a name is not installed.
    """
    groups = (PLUGINS, COMMANDS, CASES)
    sources = [*(source for group in groups for source in installed(group)), *file_sources()]
    known = {name for source in sources for name in (source.project, source.name)}
    for name in names:
        if name not in known:
            raise UsageError(unknown_name("plugin", name, known))
    os.environ[OFF_VARIABLE] = ",".join(dict.fromkeys((*switched_off(), *names)))
    registry.cache_clear()


def use_plugin(path: str | Path) -> None:
    """Use a plugin of one file, as ``--plugin FILE.py``.

    It holds for this process and those that it starts.

    Parameters
    ----------
    path : path-like
        A Python file with laws, or with hooks, as the module of a package would have them. It is read now, executed
        once, and needs no package; it cannot import other files of its folder.

    Raises
    ------
    UsageError
        When there is no such file.
    PluginError
        When it cannot be used, with its name and the line.
    """
    file = Path(path)
    if not file.is_file():
        raise UsageError(f'"{path}" is not a file: give the path of a plugin, FILE.py')
    source = add_file(file)
    _told_by_caller.add(source.name)
    registry.cache_clear()
    for fault in registry().faults:
        if fault.entry_point == source.name and fault.is_broken:
            raise PluginError(str(fault))


def as_guests_of(data: bytes) -> None:
    """Take the plugin files and laws of another process (:func:`lambda_core.discovery.local_files.guests`)."""
    if take_guests(data):
        registry.cache_clear()


@lru_cache(maxsize=1)
def registry() -> Registry:
    """Return the registry of this process.

    The first call discovers it; broken plugins are logged.
    """
    handed = [Source(law.project, law.digest, law.label, partial(_hooks_of, law)) for law in inline_laws()]
    found = discover([*installed(PLUGINS), *file_sources(), *handed], off=switched_off())
    for fault in found.faults:
        if fault.is_broken and fault.entry_point not in _told_by_caller:
            log.warning("plugin not in use: %s", fault)
    for note in found.notes:
        if note.entry_point == SLOW:
            log.warning("plugin %s: %s", note.distribution, note.message)
    return found


when_changed(registry.cache_clear)


def built_in(label: str) -> Law:
    """Return a law of the program itself.

    A plugin may build on it.

    Parameters
    ----------
    label : str
        "role/name", for example "rolling_resistance/biboulet-houpert".

    Returns
    -------
    Law
        ``kernel`` is the plain function, which other kernels may call with a ``par`` that has the names which it reads;
        ``parameters`` and ``prepare`` are what it declares.

    Raises
    ------
    PluginError
        When there is no such law.
    """
    role, _, name = label.partition("/")
    return _own_laws_alone().model(role, name)


@lru_cache(maxsize=1)
def _own_laws_alone() -> Registry:
    """Return a registry of the program's own laws.

    A plugin asks for it while the complete registry is being made.
    """
    return discover([source for source in installed(PLUGINS) if source.project == OWN])


def _hooks_of(handed: InlineLaw) -> ModuleType:
    """Return a module with one law object."""

    def register_law(register: Callable[[Any], None]) -> None:
        register(handed.item)

    module = ModuleType(f"{handed.role}/{handed.label}")
    vars(module)["lambda_laws"] = hookspecs.hookimpl(register_law)
    return module


def discover(sources: Sequence[Source], off: Iterable[str] = ()) -> Registry:
    """Load plugins and freeze what they register.

    Every plugin of `sources` has its own try.

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
    """Load one plugin and take what it registers.

    Return the reason for a failure, if any.
    """
    begun = time.perf_counter()
    try:
        with contextlib.redirect_stdout(sys.stderr):  # stdout is for data
            plugin = source.load()
    except PluginError as error:
        return str(error)
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
    spent = time.perf_counter() - begun
    message = _misspelled(manager, plugin) or _collect(manager, plugin, source, collection)
    if message:
        _forget(manager, name)
    elif spent > _SLOW_IMPORT and source.project != OWN:
        slow = f"its import took {spent:.1f} s, and does so at every start"
        collection.notes.append(PluginFault(source.distribution, SLOW, slow, is_broken=False))
    return message


def _forget(manager: pluggy.PluginManager, name: str) -> None:
    if manager.has_plugin(name):
        manager.unregister(name=name)


def _misspelled(manager: pluggy.PluginManager, plugin: object) -> str:
    """Report a hook of `plugin` that does not exist.

    Pluggy alone would ignore it.
    """
    known = [name for name in vars(hookspecs) if name.startswith("lambda_")]
    mine = manager.get_hookcallers(plugin) or []
    for hook in mine:
        if not hook.has_spec():
            return unknown_name("hook", hook.name, known)
    if not mine and not _own_laws(plugin):
        unmarked = [name for name in dir(plugin) if name in known]
        if unmarked:
            return f"{unmarked[0]} is not marked: write @hookimpl above it"
        return f"has no law and implements no hook; there are: {', '.join(known)}"
    return ""


def _own_laws(plugin: object) -> list[Any]:
    """Return the laws of an entry point's module.

    They are its functions with ``@law(...)`` above them.
    """
    own = [each for each in vars(plugin).values() if law_of(each)] if isinstance(plugin, ModuleType) else []
    return [each for each in own if getattr(each, "__module__", "") == getattr(plugin, "__name__", None)]


def _collect(manager: pluggy.PluginManager, plugin: object, source: Source, collection: Collection) -> str:
    """Call the registering hooks of one plugin.

    It takes all of them, or none.
    """
    others = [other for other in manager.get_plugins() if other is not plugin]
    entries: list[Entry] = []
    for hook_name in _REGISTERING_HOOKS:

        def register(item: Any, hook_name: str = hook_name) -> None:
            entries.append(Entry(hook_name, source.distribution, item))

        try:
            manager.subset_hook_caller(hook_name, others)(register=register)
        except (Exception, SystemExit) as error:
            return f"{hook_name} raised {describe(error)}"
    registered = {id(entry.item) for entry in entries}
    own = [each for each in _own_laws(plugin) if id(each) not in registered]
    try:
        return collection.take([*(Entry("lambda_laws", source.distribution, each) for each in own), *entries])
    except (Exception, SystemExit) as error:  # a check of parameters, or a property, of the plugin's own
        return f"cannot be taken: {describe(error)}"

"""Register every model, method, view and data folder."""

from __future__ import annotations

import contextlib
import importlib
import logging
import sys
from collections.abc import Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal

import pluggy

from lambda_core.discovery.collect import Collection, is_own, law_fault
from lambda_core.domain.errors import CaseError, nearest, unknown_name
from lambda_core.domain.inline_laws import NOTEBOOK
from lambda_core.domain.installed import project_of
from lambda_core.domain.plugin_errors import PluginError, PluginFault, blamed, describe, went_on_without
from lambda_core.domain.roles import ROLES
from lambda_core.laws.law import Law, LazyLaw, law_of
from lambda_core.views.method import Method
from lambda_core.views.observer import Event, Observer
from lambda_core.views.roller_profile import RollerProfile
from lambda_core.views.section import Section
from lambda_core.views.view import Figure, View

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.views.chart import ViewData
    from lambda_core.views.scene import Scene

OtherKind = Literal["method", "view", "observer", "event", "section", "profile"]
log = logging.getLogger("lambda_core")


class Registry:
    """Registry of installed plugins.

    It does not change after discovery.

    Attributes
    ----------
    distributions : tuple of str
        Name and version of the plugins in use.
    faults : tuple of PluginFault
        Installed plugins that are not in use, and why.
    notes : tuple of PluginFault
        What people should know of plugins that are in use: names that others have, a slow import.
    methods : mapping of str to Method
        Comparison methods by name.
    views : mapping of str to View
        Views by name.
    observers : mapping of str to Observer
        Observers by name.
    events : mapping of str to Event
        Events by name.
    sections : mapping of str to Section
        Sections of reports by name.
    profiles : mapping of str to RollerProfile
        Profiles of rollers by name.
    data_folders : tuple of (str, pathlib.Path)
        Distribution and folder of catalogue rows.
    """

    def __init__(
        self,
        collection: Collection,
        distributions: tuple[str, ...],
        faults: tuple[PluginFault, ...],
        hooks: pluggy.PluginManager,
    ) -> None:
        self._models = dict(collection.models)  # by role and qualified name
        self._same = dict(collection.same)
        self._short: dict[tuple[str, str], list[str]] = {}  # role and name -> the qualified names that end in it
        for role, full in self._models:
            self._short.setdefault((role, full.rpartition(":")[2]), []).append(full)
        self._origins = dict(collection.origins)
        self._loaded: dict[tuple[str, str], Law] = {}
        self._hooks = hooks
        self.distributions = distributions
        self.faults = faults
        self.notes = tuple(collection.notes)
        self.set_aside: dict[str, list[str]] = {}  # hook -> what failed in it while another plugin answered
        self.methods: Mapping[str, Method] = _of_kind(collection, "method")
        self.views: Mapping[str, View] = _of_kind(collection, "view")
        self.observers: Mapping[str, Observer] = _of_kind(collection, "observer")
        self.events: Mapping[str, Event] = _of_kind(collection, "event")
        self.sections: Mapping[str, Section] = _of_kind(collection, "section")
        self.profiles: Mapping[str, RollerProfile] = _of_kind(collection, "profile")
        self.data_folders: tuple[tuple[str, Path], ...] = tuple(collection.folders)

    def by_kind(self) -> dict[OtherKind, Mapping[str, Any]]:
        """Return everything but the models, by name under its kind."""
        return {
            "method": self.methods, "view": self.views, "observer": self.observers, "event": self.events,
            "section": self.sections, "profile": self.profiles,
        }  # fmt: skip

    def names(self, role: str) -> tuple[str, ...]:
        """Return the names of the models for `role`.

        Built-in ones come first; the function imports nothing.

        A name that several packages have stands here with the package before it.
        """
        if role not in ROLES:
            raise PluginError(unknown_name("role", role, ROLES))
        shorts = [(full, full.rpartition(":")[2]) for known, full in self._models if known == role]
        return tuple(short if len(self._short[role, short]) == 1 else full for full, short in shorts)

    def origin(self, kind: str, name: str) -> str:
        """Return the distribution of a plugin's entry.

        An example is "my-traction 0.1". The entry is a model (by its role), a method or a view.
        """
        return self._origins[kind, self._full(kind, name) if kind in ROLES else name]

    def model(self, role: str, name: str) -> Law:
        """Return one model, importing its module if needed.

        Parameters
        ----------
        role, name : str
            A name alone, or with its package: "carreau-traction:carreau".

        Raises
        ------
        PluginError
            When `role` has no such model (with the nearest names and what exists), when several packages have one of
            that name, or when its module cannot be imported.
        """
        full = self._full(role, name)
        key = (role, full)
        if key not in self._loaded:
            found = self._models[key]
            self._loaded[key] = _load(found, self._origins[key]) if isinstance(found, LazyLaw) else found
        return self._loaded[key]

    def _full(self, role: str, name: str) -> str:
        """Return the qualified name of a model."""
        if role not in ROLES:
            raise PluginError(unknown_name("role", role, ROLES))
        full = self._same.get((role, name), name)
        if (role, full) in self._models:
            return full
        found = self._short.get((role, name), [])
        if not found:
            raise PluginError(self._unknown(role, name))
        if len(found) > 1:
            raise PluginError(f'several {role} models are called "{name}", choose one: {", ".join(found)}')
        return found[0]

    def models(self, role: str) -> dict[str, Law]:
        """Return every model for `role` by name.

        One that cannot be imported is an error.
        """
        return {name: self.model(role, name) for name in self.names(role)}

    def method(self, name: str) -> Method:
        """Return one comparison method.

        PluginError with the nearest names when unknown.
        """
        found: Method = self._named("method", name, self.methods)
        return found

    def view(self, name: str) -> View:
        """Return one view; PluginError with the nearest names when unknown."""
        found: View = self._named("view", name, self.views)
        return found

    def observer(self, name: str) -> Observer:
        """Return one observer; PluginError with the nearest names when unknown."""
        found: Observer = self._named("observer", name, self.observers)
        return found

    def event(self, name: str) -> Event:
        """Return one event; PluginError with the nearest names when unknown."""
        found: Event = self._named("event", name, self.events)
        return found

    def figure(self, view: View | None, data: ViewData) -> Figure:
        """Draw the data of a view.

        Its own drawing comes first, otherwise the program's; the program draws data of no view (None).

        Raises
        ------
        PluginError
            When neither exists.
        """
        if view is not None and view.figure is not None:
            what = f'the drawing of the view "{view.name}" ({view.distribution})'
            with blamed(what):
                drawn = view.figure(data)
            if not hasattr(drawn, "savefig"):
                raise PluginError(f'{what} returns a {type(drawn).__name__}, which has no "savefig"')
            return drawn
        found: Figure | None = self._first("lambda_figure", "savefig", data=data)
        if found is None:
            raise PluginError(f"no plugin draws figures{self._not_loaded()}")
        return found

    def frames(self, scene: Scene) -> Iterator[NDArray[np.uint8]]:
        """Draw the frames of an animation.

        Raises
        ------
        PluginError
            When no plugin does.
        """
        found: Iterator[NDArray[np.uint8]] | None = self._first("lambda_frames", "__iter__", scene=scene)
        if found is None:
            raise PluginError(f"no plugin draws animations{self._not_loaded()}")
        return _watched(found, "lambda_frames")

    def catalogue(self) -> Catalogue:
        """Open the catalogue.

        It has the built-in rows and the folders that plugins bring.

        The caller closes it. A folder with bad rows is left out, with every one of them named.

        Raises
        ------
        PluginError
            When no installed plugin provides one.
        """
        folders = list(self.data_folders)
        while True:
            try:
                given = [folder for _, folder in folders]
                found: Catalogue | None = self._first("lambda_catalogue", "bearing", seed_folders=given)
            except CaseError as error:
                bad = next((pair for pair in folders if str(pair[1]) == error.source), None)
                if bad is None:
                    raise
                folders.remove(bad)
                reasons = "; ".join(f"{problem.where}: {problem.message}" for problem in error.problems)
                self._set_aside("lambda_data", f"the rows of {bad[0]} are left out: {reasons}")
                continue
            if found is None:
                raise PluginError(f"no plugin provides a catalogue{self._not_loaded()}")
            return found

    def _first(self, hook: str, has: str, **given: Any) -> Any:
        """Return what the first plugin answers that has an answer.

        The registry reports one that fails with its name, and asks the next; where none is left it is an error.

        Parameters
        ----------
        hook : str
            Its name.
        has : str
            Attribute by which an answer is known to be of the right kind.
        **given : object
            Arguments by name; a plugin may leave some out.
        """
        failed: list[PluginError] = []
        for one in reversed(getattr(self._hooks.hook, hook).get_hookimpls()):
            what = f"{hook} of {one.plugin_name.partition(':')[0]}"
            try:
                with blamed(what):
                    found = one.function(*(given[name] for name in one.argnames))
                if found is not None and not hasattr(found, has):
                    raise PluginError(f'{what} returns a {type(found).__name__}, which has no "{has}"')
            except PluginError as error:
                failed.append(error)
                continue
            if found is not None:
                for failure in failed:
                    self._set_aside(hook, str(failure))
                return found
        if failed:
            raise failed[0]
        return None

    def _set_aside(self, hook: str, failure: str) -> None:
        """Report once that a plugin's hook failed.

        Another hook answered instead.
        """
        if failure not in self.set_aside.setdefault(hook, []):
            self.set_aside[hook].append(failure)
            log.warning("continued without a plugin: %s", failure)
        went_on_without(failure)

    def _named(self, kind: str, name: str, known: Mapping[str, Any]) -> Any:
        if name not in known:
            raise PluginError(unknown_name(kind, name, known) + self._not_loaded())
        return known[name]

    def _unknown(self, role: str, name: str) -> str:
        """Report that `role` has no model `name`.

        The report lists the nearest names, all names, and what is missing.
        """
        names = self.names(role)
        package, _, short = name.rpartition(":")
        if package and (role, short) in self._short:
            names = tuple(self._short[role, short])
        shown = [n if is_own(self.origin(role, n)) else f"{n} ({self.origin(role, n)})" for n in names]
        close = nearest(name, names)
        hint = f"nearest: {', '.join(close)}; " if close else ""
        article = "an" if role[0] in "aeiou" else "a"
        text = f'"{name}" is not {article} {role} model; {hint}available: {", ".join(shown) or "none"}'
        return text + (self._absent(package) or self._not_loaded())

    def _absent(self, package: str) -> str:
        """Explain why a package is not in use.

        The text is "" without a package.
        """
        for fault in self.faults:
            if package and project_of(fault.distribution) == package:
                return f"; not in use: {fault.distribution}: {fault.message}"
        if not package or package in map(project_of, self.distributions):
            return ""
        if package == NOTEBOOK:
            return f"; a law of a {NOTEBOOK} is known to the program that hands it over, and to no other"
        where = f"--plugin {package} takes it into use" if package.endswith(".py") else "it is not installed"
        return f"; {package} brings it: {where}"

    def _not_loaded(self) -> str:
        if not self.faults:
            return ""
        return f"; not in use: {', '.join(dict.fromkeys(fault.distribution for fault in self.faults))}"


def _watched(frames: Iterator[NDArray[np.uint8]], what: str) -> Iterator[NDArray[np.uint8]]:
    """Yield frames; report what their drawing raises with its name."""
    steps = iter(frames)
    while True:
        with blamed(what):
            frame = next(steps, None)
        if frame is None:
            return
        yield frame


def _of_kind(collection: Collection, kind: str) -> Mapping[str, Any]:
    return MappingProxyType({name: item for (known, name), item in collection.named.items() if known == kind})


def _load(lazy: LazyLaw, distribution: str) -> Law:
    """Import the model that a lazy registration stands for."""
    label = f"{lazy.role}/{lazy.name} ({distribution})"
    module, _, attribute = lazy.target.partition(":")
    try:
        with contextlib.redirect_stdout(sys.stderr):  # stdout is for data
            target = getattr(importlib.import_module(module), attribute)
    except PluginError as error:
        raise PluginError(f"{label}: {error}") from None
    except (Exception, SystemExit) as error:
        raise PluginError(f"{label} cannot be imported: {describe(error)}") from error
    found = law_of(target)
    if found is None:
        raise PluginError(f"{label}: {lazy.target} is a {type(target).__name__}, not a law: write @law(...) above it")
    if (found.role, found.name) != (lazy.role, lazy.name):
        raise PluginError(f"{label}: {lazy.target} is {found.role}/{found.name}")
    with blamed(label):
        message = law_fault(found)
    if message:
        raise PluginError(f"{label}: {message}")
    return replace(found, distribution=distribution)

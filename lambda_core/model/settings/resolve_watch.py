"""Resolve the observers and events of a case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol, TypeVar

from lambda_core.case.case import Case
from lambda_core.domain.errors import nearest
from lambda_core.model.bearing_model import ChosenEvent, ChosenObserver
from lambda_core.model.laws.given_parameters import given_parameters, record_parameters
from lambda_core.model.ledger import Ledger
from lambda_core.views.observer import ACTION, Event, Observer

_ACTIONS = ("stop", "record")
Kind = TypeVar("Kind", Observer, Event)


class WatchSource(Protocol):
    """Registry functions that the resolution needs."""

    def observer(self, name: str) -> Observer:
        """Return one observer; LambdaError when there is none."""

    def event(self, name: str) -> Event:
        """Return one event; LambdaError when there is none."""


def resolve_observers(case: Case, registry: WatchSource, ledger: Ledger) -> dict[str, ChosenObserver]:
    """Return the observers of a case by name.

    Complete unless the ledger holds problems.
    """
    found: dict[str, ChosenObserver] = {}
    owners: dict[str, str] = {}
    for name, texts in case.observers.items():
        where = f"observers.{name}"
        item = ledger.ask(where, lambda name=name: registry.observer(name))  # type: ignore[misc]
        parameters = _parameters(item, where, texts, ledger) if item else None
        if item is None or parameters is None:
            continue
        for channel in item.written():
            if channel.name in owners:
                message = f"writes the channel {channel.name}, which {owners[channel.name]} writes already"
                ledger.problem(where, message)
            owners.setdefault(channel.name, name)
            if "marker" in channel.dims and not case.markers:
                ledger.problem(
                    where, f"its channel {channel.name} is per marker, and the case has no markers: add [markers]"
                )
        found[name] = ChosenObserver(item, parameters)
        _record(where, item, parameters, texts, ledger)
    return found


def resolve_events(case: Case, registry: WatchSource, ledger: Ledger) -> dict[str, ChosenEvent]:
    """Return the events of a case by name.

    Complete unless the ledger holds problems.
    """
    found: dict[str, ChosenEvent] = {}
    for name, given in case.events.items():
        where, texts = f"events.{name}", {key: text for key, text in given.items() if key != ACTION}
        action = given.get(ACTION, "stop")
        if action not in _ACTIONS:
            close = nearest(str(action), _ACTIONS)
            hint = f"; nearest: {close[0]}" if close else ""
            ledger.problem(f"{where}.{ACTION}", f'"{action}" is not allowed: write "stop" or "record"{hint}')
            continue
        item = ledger.ask(where, lambda name=name: registry.event(name))  # type: ignore[misc]
        parameters = _parameters(item, where, texts, ledger) if item else None
        if item is None or parameters is None:
            continue
        found[name] = ChosenEvent(item, parameters, action)
        _record(where, item, parameters, texts, ledger)
    return found


def _parameters(item: Observer | Event, where: str, texts: Mapping[str, Any], ledger: Ledger) -> Any:
    """Return validated parameters.

    The result is None after a problem, which the ledger takes.
    """
    what = "observer" if isinstance(item, Observer) else "event"
    return given_parameters(f"the {what} {item.name}", item.parameters, texts, where, ledger)


def _record(where: str, item: Observer | Event, parameters: Any, texts: Mapping[str, Any], ledger: Ledger) -> None:
    ledger.record(where, item.name, "", item.distribution, "given")
    record_parameters(parameters, texts, where, ledger)

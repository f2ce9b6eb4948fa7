"""Store the observers and events of a run."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING

from lambda_core.domain.channels import Channel
from lambda_core.results.record import Record
from lambda_core.views.observer import Reduction

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel, ChosenEvent, ChosenObserver

EVENTS_GROUP = "events"
OBSERVER_COLUMNS = ("name", "title", "distribution", "reference", "parameters", "numbers", "key")
EVENT_COLUMNS = ("name", "title", "distribution", "reference", "parameters", "action", "key")

EVENTS: tuple[Channel, ...] = (
    Channel("time", (), "s", "of the first sample at which it is so"),
    Channel("event", (), "", "row of inputs/events, from 0"),
)


class ObserverNumber(Record):
    """One number that an observer has over the averaged revolutions."""

    observer: str
    name: str
    value: float | None
    unit: str
    meaning: str


class EventSeen(Record):
    """One event of a run."""

    event: str
    title: str
    action: str
    count: int  # how often it began
    first_s: float | None
    last_s: float | None


class NumberWritten(Record):
    """Construction of an observer's number in the result."""

    name: str
    channel: str
    reduction: Reduction
    meaning: str


def observer_rows(model: BearingModel, keys: Mapping[str, str]) -> list[dict[str, str]]:
    """Return one row per observer of a run.

    `keys` are hashes of their code by "observer/NAME".
    """
    return [
        _about(name, chosen, keys.get(f"observer/{name}", ""))
        | {"numbers": json.dumps([vars(number) for number in chosen.item.numbers])}
        for name, chosen in model.observers.items()
    ]


def event_rows(model: BearingModel, keys: Mapping[str, str]) -> list[dict[str, str]]:
    """Return one row per event of a run.

    `keys` are hashes of their code by "event/NAME".
    """
    return [
        _about(name, chosen, keys.get(f"event/{name}", "")) | {"action": chosen.action}
        for name, chosen in model.events.items()
    ]


def _about(name: str, chosen: ChosenObserver | ChosenEvent, key: str) -> dict[str, str]:
    """Return where an observer or event comes from."""
    item = chosen.item
    origin = {"title": item.title, "distribution": item.distribution, "reference": item.reference}
    return {"name": name, **origin, "parameters": chosen.parameters.model_dump_json(), "key": key}

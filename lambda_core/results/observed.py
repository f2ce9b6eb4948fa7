"""Summarise the numbers of observers and events."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.results.averages import finite
from lambda_core.results.event_rows import EventSeen, NumberWritten, ObserverNumber

if TYPE_CHECKING:
    from lambda_core.domain.arrays import FloatArray
    from lambda_core.results.reader import Result


def observed_numbers(result: Result, start: float) -> list[ObserverNumber]:
    """Return the numbers of every observer.

    They use the samples from time `start` [s].
    """
    units = {channel.name: channel.unit for channel in result.channels}
    found = []
    for row in result.observers:
        for written in json.loads(row["numbers"]):
            number = NumberWritten.model_validate(written)
            value = finite(_reduced(result, number, start))
            unit = units[number.channel]
            found.append(
                ObserverNumber(observer=row["name"], name=number.name, value=value, unit=unit, meaning=number.meaning)
            )
    return found


def _reduced(result: Result, number: NumberWritten, start: float) -> float:
    """Return one number of a channel.

    NaN where it has no finite value.
    """
    if number.reduction == "last":
        return _largest(result.sample(-1, (number.channel,))[number.channel])
    count, total, low, high = 0, 0.0, np.inf, -np.inf
    for block in result.blocks((number.channel,), start):
        values = block[number.channel]
        values = values[np.isfinite(values)]
        if values.size:
            count, total = count + values.size, total + float(values.sum())
            low, high = min(low, float(values.min())), max(high, float(values.max()))
    if not count:
        return float("nan")
    return {"mean": total / count, "smallest": low, "largest": high}[number.reduction]


def _largest(values: FloatArray) -> float:
    """Return the largest entry of the end state."""
    return float(np.max(values, initial=-np.inf, where=np.isfinite(values)))


def occurred_events(result: Result) -> list[EventSeen]:
    """Return how often each event began.

    Also return when it began first and last.
    """
    rows = result.watched_events
    if not rows:
        return []
    begun = result.events()
    return [_seen(row, begun["time"][begun["event"] == number]) for number, row in enumerate(rows)]


def _seen(row: Mapping[str, str], times: FloatArray) -> EventSeen:
    first, last = (float(times[0]), float(times[-1])) if times.size else (None, None)
    about = {name: row[name] for name in ("title", "action")}
    return EventSeen(event=row["name"], count=times.size, first_s=first, last_s=last, **about)

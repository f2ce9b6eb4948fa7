"""Define responses of observers, events and contact states.

An observer's number is ``OBSERVER/NUMBER``; an event has ``EVENT/count``, ``EVENT/first_s`` and ``EVENT/last_s``; a
state of the contacts ``STATE/last``, the largest of all contacts at the end, and ``STATE/largest``, during the whole
run. Of a machine each has the name of the bearing in front ("left.sliding-wear/worst").
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from lambda_core.domain.arrays import FloatArray
from lambda_core.model.laws.state_channels import state_channels
from lambda_core.studies.points import DynamicPoint
from lambda_core.studies.responses import Number, Response

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

_OF_EVENTS = (
    ("count", "", "number of times it began"), ("first_s", "s", "first time"), ("last_s", "s", "last time")
)  # fmt: skip
Read = Callable[[DynamicPoint], Number]


def observed_responses(model: BearingModel | MachineModel) -> dict[str, Response]:
    """Return the responses of observers, events and states, by name."""
    each = model.bearing_models.items()
    found = [one.in_bearing(bearing) for bearing, own in each for one in _of_bearing(own)]
    return {one.name: one for one in found}


def _of_bearing(model: BearingModel) -> list[Response]:
    found: list[Response] = []
    for state in state_channels(model):
        about = f"{state.name.replace('_', ' ')}, {state.meaning}: largest of all contacts"
        found += [
            Response(f"{state.name}/last", state.unit, f"{about} at the end", dynamic=_last(state.name)),
            Response(f"{state.name}/largest", state.unit, f"{about} during the run", dynamic=_largest(state.name)),
        ]
    for name, event in model.events.items():
        for key, unit, meaning in _OF_EVENTS:
            found.append(Response(f"{name}/{key}", unit, f"{event.item.title}: {meaning}", dynamic=_event(name, key)))
    for name, observer in model.observers.items():
        units = {channel.name: channel.unit for channel in observer.item.written()}
        for number in observer.item.numbers:
            read = _observed(name, number.name)
            found.append(Response(f"{name}/{number.name}", units[number.channel], number.meaning, dynamic=read))
    return found


def _observed(observer: str, number: str) -> Read:
    def read(point: DynamicPoint) -> Number:
        each = point.summary.observed
        return next((one.value for one in each if (one.observer, one.name) == (observer, number)), None)

    return read


def _event(event: str, key: str) -> Read:
    def read(point: DynamicPoint) -> Number:
        value = next((getattr(one, key) for one in point.summary.events if one.event == event), None)
        return None if value is None else float(value)

    return read


def _last(state: str) -> Read:
    return lambda point: _greatest(point.result.sample(-1, (state,))[state])


def _largest(state: str) -> Read:
    return lambda point: max(_greatest(block[state]) for block in point.result.blocks((state,)))


def _greatest(values: FloatArray) -> float:
    import numpy as np

    return float(np.max(values, initial=-np.inf, where=np.isfinite(values)))

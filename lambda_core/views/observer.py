"""Define observers and events of plugins.

The hooks are ``lambda_observers`` and ``lambda_events``.

An observer turns the samples of a run into channels of its own, written next to those of the program; an event says at
which samples something happens, and may end the run. Both look at samples alone and change nothing of the motion.
"""

from __future__ import annotations

import hashlib
import inspect
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import CHANNELS, DIMENSIONS, Channel
from lambda_core.laws.parameter import NoParameters, default_fault

OBSERVER_API = 1
EVENT_API = 1
ACTION = "action"  # what a case may say of an event in addition to its parameters
Action = Literal["stop", "record"]

Samples = Mapping[str, FloatArray]  # channel -> array, first axis time, SI; read only
Reduction = Literal["mean", "smallest", "largest", "last"]

_NAME = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")
_OWN_DIMENSIONS = ("ball", "marker")  # as long as the case has balls and markers


@dataclass(frozen=True)
class Integral:
    """Channel that integrates another channel over time.

    Both belong to one observer; it is 0 at the start (trapezium rule).

    Attributes
    ----------
    name, of : str
        Names of this channel, and of the one that is integrated.
    unit, meaning : str
        As of a channel.
    """

    name: str
    of: str
    unit: str
    meaning: str


@dataclass(frozen=True)
class Number:
    """One number of the summary.

    Attributes
    ----------
    name : str
        In words.
    channel : str
        One of the observer's channels.
    reduction : str
        ``mean``, ``smallest`` or ``largest`` over the averaged revolutions and all entries; ``last``: the largest entry
        at the end.
    meaning : str
        One line for people.
    """

    name: str
    channel: str
    reduction: Reduction
    meaning: str


@dataclass(frozen=True)
class Observer:
    """Channels of a plugin in the result of a run.

    Attributes
    ----------
    name : str
        Short and unique: "flash-temperature". A case switches it on with the table ``[observers.flash-temperature]``.
    title : str
        One line for people.
    channels : tuple of Channel
        Name, dimensions (:data:`lambda_core.domain.channels.DIMENSIONS`, "ball", "marker"), unit, meaning.
    observe : callable
        ``observe(samples, parameters, model)`` returns channel -> array of shape (samples, *dimensions). It sees the
        channels of the program, its parameters and the resolved model as plain SI data, and is called again and again
        with stretches of samples: each sample has to be worked out from itself alone.
    reference : str
        Publication and equation numbers, "own work" where there is none.
    parameters : type of Parameters
        Fields with units, limits and sources.
    integrals, numbers : tuples
        Time integrals of channels; numbers of the summary.
    observer_api : int
        Version of this interface that it is written for, as a number: 1.
    """

    name: str
    title: str
    channels: tuple[Channel, ...]
    observe: Callable[[Samples, Any, Mapping[str, Any]], Samples] = field(repr=False)
    reference: str
    parameters: type[BaseModel] = NoParameters
    integrals: tuple[Integral, ...] = ()
    numbers: tuple[Number, ...] = ()
    observer_api: int = 0
    distribution: str = ""  # filled by the registry

    @property
    def key(self) -> str:
        """Return a hash of the code."""
        return source_key(self.observe)

    def written(self) -> tuple[Channel, ...]:
        """Return every channel that the result gets, integrals included."""
        dims = {channel.name: channel.dims for channel in self.channels}
        sums = (Channel(each.name, dims[each.of], each.unit, each.meaning) for each in self.integrals)
        return (*self.channels, *sums)


@dataclass(frozen=True)
class Event:
    """Something that happens in a run, found by a plugin.

    Attributes
    ----------
    name : str
        Short and unique: "cage-instability". A case asks for it with the table ``[events.cage-instability]``; its
        ``action`` says whether it ends the run ("stop", the default) or is written down ("record").
    title : str
        One line for people: what has happened.
    happens : callable
        ``happens(samples, parameters, model)`` returns for each sample whether it is so, shape (samples,), bool; the
        event is the first of several. Each sample has to be judged from itself alone.
    reference, parameters
        As for an observer.
    event_api : int
        Version of this interface that it is written for, as a number: 1.
    """

    name: str
    title: str
    happens: Callable[[Samples, Any, Mapping[str, Any]], Any] = field(repr=False)
    reference: str
    parameters: type[BaseModel] = NoParameters
    event_api: int = 0
    distribution: str = ""  # filled by the registry

    @property
    def key(self) -> str:
        """Return a hash of the code."""
        return source_key(self.happens)


def source_key(function: Callable[..., Any]) -> str:
    """Return the hash of a function's source file.

    It is that of its name where there is no file.
    """
    path = inspect.getsourcefile(inspect.unwrap(function)) if inspect.isfunction(function) else None
    text = Path(path).read_bytes() if path and Path(path).is_file() else repr(function).encode()
    return hashlib.sha256(text).hexdigest()


def observer_fault(item: object) -> str:
    """Say what keeps an observer from being registered, or nothing."""
    if not isinstance(item, Observer):
        return f"lambda_observers registers a {type(item).__name__}: wrap the function in Observer(name, title, ...)"
    label = f"the observer {item.name}"
    return (
        _version_fault(label, "observer_api", item.observer_api, OBSERVER_API)
        or _common_fault(label, item.observe, item.reference, item.parameters)
        or _channels_fault(label, item)
    )


def event_fault(item: object) -> str:
    """Say what keeps an event from being registered, or nothing."""
    if not isinstance(item, Event):
        return f"lambda_events registers a {type(item).__name__}: wrap the function in Event(name, title, ...)"
    label = f"the event {item.name}"
    fault = _version_fault(label, "event_api", item.event_api, EVENT_API)
    fault = fault or _common_fault(label, item.happens, item.reference, item.parameters)
    if not fault and ACTION in item.parameters.model_fields:
        return f'{label} has a parameter "{ACTION}": the word is taken, it says whether the run ends'
    return fault


def _version_fault(label: str, keyword: str, written_for: int, here: int) -> str:
    if written_for == here:
        return ""
    if not written_for:
        return f"{label} does not say for which version of the interface it is written: add {keyword}={here}"
    return f"{label} is written for version {written_for} of the interface; this is {here}"


def _common_fault(label: str, function: object, reference: str, parameters: object) -> str:
    if not callable(function):
        return f"{label} calls a {type(function).__name__}, not a function"
    if not reference.strip():
        return f'{label} has no reference: name its source ("own work" is one)'
    if not (isinstance(parameters, type) and issubclass(parameters, BaseModel)):
        return f"the parameters of {label} are not a pydantic BaseModel class"
    fault = default_fault(parameters)
    return f"{label}: {fault}" if fault else ""


def _channels_fault(label: str, item: Observer) -> str:
    """Check names, dimensions and what integrals and numbers refer to."""
    rates = {channel.name for channel in item.channels}
    if not rates:
        return f"{label} has no channel"
    for integral in item.integrals:
        if integral.of not in rates:
            return f'{label}: the integral {integral.name} is of "{integral.of}", which is not one of its channels'
    written = item.written()
    names = [channel.name for channel in written]
    taken = {channel.name for channel in CHANNELS} | {*DIMENSIONS, *_OWN_DIMENSIONS, "status"}
    for channel in written:
        if not _NAME.fullmatch(channel.name):
            return f'{label}: the channel name "{channel.name}" is not in lower case with underscores ("wear_depth")'
        if channel.name in taken or names.count(channel.name) > 1:
            return f"{label}: the channel name {channel.name} is taken"
        unknown = [dim for dim in channel.dims if dim not in (*DIMENSIONS, *_OWN_DIMENSIONS)]
        if unknown:
            known = ", ".join((*DIMENSIONS, *_OWN_DIMENSIONS))
            return f'{label}: the channel {channel.name} has the dimension "{unknown[0]}"; there are: {known}'
    for number in item.numbers:
        if number.channel not in names:
            return f'{label}: the number {number.name} is of "{number.channel}", which is not one of its channels'
    return ""

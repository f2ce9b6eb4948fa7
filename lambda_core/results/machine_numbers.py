"""Summarise shaft and bodies of a machine."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.life import BALL_SLOPE, ROLLER_SLOPE, system_life
from lambda_core.results.averages import finite
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.results.bearing_summary import BearingSummary
    from lambda_core.results.reader import Result


class Swing(Record):
    """The motion of one place of a machine."""

    position_mm: float | None = Field(description="along the shaft, of a lump of it", default=None)
    mean_um: list[float] = Field(description="mean displacement x, y, z")
    swing_um: list[float] = Field(description="half of what lies between the smallest and largest value: x, y, z")


class ElementForce(Record):
    """Force element's results over time.

    They may also be those of a connection by a law.
    """

    force_N: list[float] = Field(description="mean force x, y, z on the second of its bodies")
    force_swing_N: list[float] = Field(description="half of what lies between the smallest and largest value: x, y, z")
    power_W: float = Field(description="mean power that it puts into its bodies; negative: takes out")


def total(values: Iterable[float | None]) -> float | None:
    """Return the sum; None where one of them is missing."""
    known = list(values)
    return None if None in known else sum(value for value in known if value is not None)


def said_once(reasons: Mapping[str, list[str]]) -> list[str]:
    """Return sentences, common ones once.

    A sentence on one bearing has its name; one that holds for all has none.
    """
    plain = [text for own in reasons.values() for text in own]
    named = [(name, text) for name, own in reasons.items() for text in own]
    said = (text if plain.count(text) == len(reasons) else f"{name}: {text}" for name, text in named)
    return list(dict.fromkeys(said))


def machine_warnings(result: Result, bearings: Mapping[str, BearingSummary]) -> list[str]:
    """Return the machine's warnings.

    Those of the machine as drawn come before those of its bearings.
    """
    own = {name: one.warnings for name, one in bearings.items()}
    return [*result.of_machine().case_warnings, *said_once(own)]


def machine_numbers(result: Result, bearings: Mapping[str, BearingSummary], start: float) -> dict[str, Any]:
    """Return the numbers of shaft and bodies.

    They are averaged from time `start` [s].
    """
    machine, numbers = result.of_machine(), result.machine_numbers
    friction = total(one.friction_torque_Nmm for one in bearings.values())
    speed = float(result.machine["speed"])
    lives = {name: one.rating.reference_life_h for name, one in bearings.items() if one.rating is not None}
    known = {name: life for name, life in lives.items() if life is not None}
    of_rollers = {name: result.of_bearing(name).model.get("rollers") is not None for name in known}
    slopes = [ROLLER_SLOPE if of_rollers[name] else BALL_SLOPE for name in known]
    written = {channel.name for channel in machine.channels}
    moved = {name: _swings(machine, name, start) for name in _PLACES if name in written}
    drive = numbers["drive_torque"] + math.copysign(1.0, speed) * 1e-3 * (math.nan if friction is None else friction)
    return {
        "speed_rpm": 30.0 / math.pi * speed,
        "drive_torque_Nm": finite(drive),
        "system_life_h": finite(system_life([*known.values()], slopes)) if known else None,
        "orbit": [
            one.model_copy(update={"position_mm": 1e3 * float(place)})
            for place, one in moved.get("shaft_position", {}).items()
        ],
        "bodies": moved.get("body_position", {}),
        "markers": moved.get("marker_position", {}),
    }


_PLACES = ("shaft_position", "body_position", "marker_position")


def _swings(machine: Result, name: str, start: float) -> dict[Any, Swing]:
    """Return mean and swing of every place.

    The channel is one of displacements.
    """
    labels = machine.labels(next(c for c in machine.channels if c.name == name).dims[0])
    found = {}
    for label, (mean, swing) in zip(labels, _means(machine, name, start), strict=True):
        found[label] = Swing(mean_um=(1e6 * mean).tolist(), swing_um=(1e6 * swing).tolist())
    return found


def _means(machine: Result, name: str, start: float) -> list[tuple[FloatArray, FloatArray]]:
    """Return mean and half range of values.

    The half range is that between smallest and largest value along the first dimension.
    """
    sums, low, high = np.zeros(()), np.array(np.inf), np.array(-np.inf)
    count = 0
    for block in machine.blocks((name,), start):
        values = block[name]
        sums, count = sums + values.sum(axis=0), count + len(values)
        low, high = np.minimum(low, values.min(axis=0)), np.maximum(high, values.max(axis=0))
    return list(zip(sums / max(count, 1), 0.5 * (high - low), strict=True))


def element_numbers(result: Result, start: float) -> dict[str, ElementForce]:
    """Return forces and powers of force elements.

    The keys are names; the averages start at time `start` [s].
    """
    every = {channel.name for channel in result.channels}
    dim = next((dim for dim in ("element", "connection") if f"{dim}_force" in every), "")
    if not dim:
        return {}
    labels = result.labels(dim)
    pairs = zip(labels, _means(result, f"{dim}_force", start), _means(result, f"{dim}_power", start), strict=True)
    return {
        str(name): ElementForce(force_N=force.tolist(), force_swing_N=swing.tolist(), power_W=float(power))
        for name, (force, swing), (power, _) in pairs
    }


def reactions(result: Result, start: float) -> dict[str, list[float]]:
    """Return a bearing's force and moment.

    They act on the shaft of a machine, averaged from time `start` [s].
    """
    machine, i = result.of_machine(), result.bearing_names.index(result.bearing)
    force, swing = _means(machine, "reaction_force", start)[i]
    moment, _ = _means(machine, "reaction_moment", start)[i]
    return {"force_N": force.tolist(), "force_swing_N": swing.tolist(), "moment_Nm": moment[1:].tolist()}

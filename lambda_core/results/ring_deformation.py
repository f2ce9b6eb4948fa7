"""Evaluate the ovality of elastic rings and cage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic import Field

from lambda_core.domain.elements import BODIES
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.results.reader import Result

_CHANNEL = "_ovality"  # behind the name of a body: system.state_channels


class RingDeformation(Record):
    """One part that bends."""

    part: str = Field(description="inner ring, outer ring or cage")
    mean_ovality_um: float = Field(description="largest less smallest diameter, mean of the averaging window")
    largest_ovality_um: float = Field(description="the largest there")


def ring_deformations(result: Result, start: float) -> list[RingDeformation]:
    """Return the ovality of every elastic part.

    It is averaged from time `start` [s] on; the result is empty where all parts are rigid.
    """
    written = {channel.name for channel in result.channels}
    names = [f"{body}{_CHANNEL}" for body in BODIES if f"{body}{_CHANNEL}" in written]
    sums, most, count = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0), 0
    for block in result.blocks(names, start) if names else ():
        count += len(block[names[0]])
        for name in names:
            sums[name] += float(block[name].sum())
            most[name] = max(most[name], float(block[name].max(initial=0.0)))
    return [
        RingDeformation(
            part=name.removesuffix(_CHANNEL).replace("_", " "),
            mean_ovality_um=1e6 * sums[name] / max(count, 1),
            largest_ovality_um=1e6 * most[name],
        )
        for name in names
    ]

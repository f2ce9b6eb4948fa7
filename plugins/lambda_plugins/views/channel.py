"""Draw any channel of a run over time.

The channels are those of the program, of observers and of states of contacts.
"""

from __future__ import annotations

import numpy as np
from pydantic import Field

from lambda_core.domain.channels import DIMENSIONS, Channel
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.plugins import Axis, FloatArray, NotApplicable, Options, Panel, RunData, Series, View, ViewData
from lambda_plugins.views.common import source, trace

_MOST_LINES = 12  # more entries are drawn as a mean with the range that they cover


class ChannelOptions(Options):
    """Channel and balls to show."""

    channel: str = Field("load", description="name of the channel, as in the result file")
    ball: int = Field(0, ge=0, description="number of the ball; 0: all of them")


def channel(run: RunData, options: ChannelOptions) -> ViewData:
    """Show one channel over time.

    Each entry as a line, or of many their mean and range.
    """
    known = {one.name: one for one in run.channels if one.name != "time"}
    if options.channel not in known:
        raise UsageError(f"view channel: {unknown_name('channel of this run', options.channel, known)}")
    chosen = known[options.channel]
    time, values = 1e3 * run["time"], run[options.channel].reshape(len(run["time"]), -1)
    labels = _labels(chosen, run[options.channel].shape[1:])
    if options.ball:
        if "ball" not in chosen.dims:
            raise NotApplicable(f"the channel {chosen.name} has no values of single balls: leave `ball` out")
        keep = [i for i, label in enumerate(labels) if f"ball {options.ball}" in label.split(", ")]
        if not keep:
            balls = run[options.channel].shape[1 + chosen.dims.index("ball")]
            raise UsageError(f"view channel: there is no ball {options.ball}; the bearing has {balls}")
        values, labels = values[:, keep], [labels[i] for i in keep]
    lines = [trace(label, time, values[:, i]) for i, label in enumerate(labels)]
    if len(lines) > _MOST_LINES:
        lines = [_range(time, values)]
    axis = Axis(chosen.name.replace("_", " "), "" if chosen.unit == "-" else chosen.unit)
    panel = Panel("", Axis("time", "ms"), axis, tuple(lines))
    return ViewData("channel", chosen.name.replace("_", " "), source(run), (panel,), notes=(chosen.meaning,))


def _labels(channel_: Channel, shape: tuple[int, ...]) -> list[str]:
    """Return a label for each entry: "ball 3, inner"."""
    each = []
    for dim, count in zip(channel_.dims, shape, strict=True):
        names = [str(label) for label in DIMENSIONS.get(dim, ())]
        each.append(names if len(names) == count else [f"{dim} {i + 1}" for i in range(count)])
    found = [""]
    for names in each:
        found = [f"{before}, {name}".lstrip(", ") for before in found for name in names]
    return [label or channel_.name.replace("_", " ") for label in found]


def _range(time: FloatArray, values: FloatArray) -> Series:
    """Return mean and range of many entries."""
    drawn = [trace("", time, of(values, axis=1)) for of in (np.nanmean, np.nanmin, np.nanmax)]
    mean, low, high = drawn
    words = f"mean of {values.shape[1]}"
    return Series(words, mean.x, mean.y, low=low.y, high=high.y, band="smallest to largest")


VIEWS = (
    View(
        "channel", "any channel of a run over time", "result", channel, ChannelOptions, offered=lambda run: False,
        view_api=1,
    ),
)  # fmt: skip

"""Draw the frame of a panel: axes, marks, legend."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, ScalarFormatter
from matplotlib.transforms import ScaledTranslation

from lambda_plugins.views.style import SOFT

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.plugins import Axis, Mark, Panel

LABEL = 32  # characters of a line of a label
TITLE = 42  # the same of a title
_RESTLESS = 3.0  # way up and down over the range of values, from which a line fills its panel
_HEADROOM = 1.06  # above the data, on axes that begin at a given value
_LEGEND_BELOW = 0.58  # [inch] below the axes: under the numbers and the label
_DECADES = 100.0  # end over beginning of a logarithmic axis with plain numbers
_OUTSIDE = 4  # a longer legend goes next to the axes
_POINTS = 72.0  # of an inch
_LABEL_HEIGHT, _LABEL_LETTER = 13.0, 5.6  # height of a label of a mark, length of a letter [pt]
_LOWEST_LABEL = 120.0  # below the top of the axes, where the next label begins at the top again [pt]


class Numbers(ScalarFormatter):
    """Print the numbers of an axis as plain text.

    A power of ten is a formula at the axis.

    The library sets every number as a formula where the power is one; reading those took a quarter of a figure's time.
    """

    def __call__(self, x: float, pos: int | None = None) -> str:
        """Return the text of one number."""
        text: str = super().__call__(x, pos)
        return text.removeprefix("$\\mathdefault{").removesuffix("}$")


def is_restless(values: Any) -> bool:
    """Tell whether a line fills its panel by oscillation."""
    known = values[np.isfinite(values)]
    return bool(known.size > 2 and np.abs(np.diff(known)).sum() > _RESTLESS * np.ptp(known))


def draw_axes(axes: Any, panel: Panel) -> None:
    """Label, scale and limit the axes of a panel."""
    if panel.shape == "polar":
        axes.set_theta_zero_location("E")
        axes.set_thetagrids(range(0, 360, 30))
        axes.set_ylim(bottom=0.0)
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))
        axes.set_rlabel_position(67.5)
        axes.tick_params(axis="y", labelsize=9.5)
        axes.set_xlabel(f"{panel.y.text} over {panel.x.text}")
    else:
        _scale(axes, panel.x, "x")
        _scale(axes, panel.y, "y")
        if panel.shape == "plane":
            _square(axes)
    for axis in (axes.xaxis, axes.yaxis):
        if type(axis.get_major_formatter()) is ScalarFormatter:
            axis.set_major_formatter(Numbers())


def _square(axes: Any) -> None:
    """Give both axes the same scale in a square box."""
    middle = [0.5 * sum(limits) for limits in (axes.get_xlim(), axes.get_ylim())]
    half = 0.5 * max(limits[1] - limits[0] for limits in (axes.get_xlim(), axes.get_ylim()))
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    axes.set_aspect("equal", adjustable="box")
    axes.xaxis.set_major_locator(MaxNLocator(5))
    axes.yaxis.set_major_locator(MaxNLocator(5))


def _scale(axes: Any, axis: Axis, which: str) -> None:
    if axis.log:
        getattr(axes, f"set_{which}scale")("log")
    getattr(axes, f"set_{which}label")(textwrap.fill(axis.text, LABEL))
    _limit(axes, axis, which)
    if axis.log:
        _few_decades(getattr(axes, f"{which}axis"), *getattr(axes, f"get_{which}lim")())
    if axis.categories:
        longest = max(len(name) for name in axis.categories)
        turned = which == "x" and longest * len(axis.categories) > 42
        getattr(axes, f"set_{which}ticks")(
            range(len(axis.categories)),
            axis.categories,
            **({"rotation": 35, "ha": "right", "rotation_mode": "anchor"} if turned else {}),
        )
        axes.grid(False, axis=which)
    elif axis.ticks:
        getattr(axes, f"set_{which}ticks")(axis.ticks, [f"{tick:g}" for tick in axis.ticks])
        getattr(axes, f"{which}axis").set_minor_formatter(NullFormatter())


def _few_decades(axis: Any, low: float, high: float) -> None:
    """Write 500, 1000, 2000 on a short logarithmic axis.

    Powers of ten at every mark would overlap.
    """
    if high < _DECADES * low:
        axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())


def _limit(axes: Any, axis: Axis, which: str) -> None:
    """Set the ends that the axis requires.

    The data set the others.
    """
    set_limits = getattr(axes, f"set_{which}lim")
    low, high = getattr(axes, f"get_{which}lim")()
    if axis.low is not None and axis.high is None and not axis.log:
        set_limits(axis.low, max(axis.low + _HEADROOM * (high - axis.low), axis.low + axis.least))
    elif axis.low is not None or axis.high is not None:
        set_limits(low if axis.low is None else axis.low, high if axis.high is None else axis.high)
    elif high - low < axis.least and not axis.log:
        middle = 0.5 * (low + high)
        set_limits(middle - 0.5 * axis.least, middle + 0.5 * axis.least)


def draw_line(axes: Any, mark: Mark) -> None:
    """Draw the line of a mark."""
    draw = axes.axvline if mark.axis == "x" else axes.axhline
    draw(mark.value, color=SOFT, linewidth=1.1, linestyle=(0, (2, 2)), zorder=2.5)


def draw_labels(axes: Any, marks: Sequence[Mark]) -> None:
    """Write what marks are, where they can be seen.

    A label at the end of a line begins below the one before, where the two lines are closer than a letter is high.
    """
    before, down = -math.inf, 0.0
    for mark in sorted(marks, key=lambda one: one.value):
        low, high = axes.get_xlim() if mark.axis == "x" else axes.get_ylim()
        if not mark.label or not low <= mark.value <= high:
            continue
        if mark.axis == "x":
            at = float(axes.transData.transform((mark.value, 1.0))[0]) * _POINTS / axes.figure.dpi
            down = down if at - before < _LABEL_HEIGHT and down < _LOWEST_LABEL else 0.0
            _write_label(axes, mark, down)
            before, down = at, down + _LABEL_LETTER * len(mark.label) + _LABEL_HEIGHT / 2.0
        else:
            _write_label(axes, mark, 0.0)


def _write_label(axes: Any, mark: Mark, down: float) -> None:
    """Write a label upon paper, so far below the top."""
    paper = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    style = {"fontsize": 9.5, "color": SOFT, "zorder": 6, "textcoords": "offset points", "bbox": paper}
    if mark.axis == "x":
        place, coordinates = (mark.value, 0.985), ("data", "axes fraction")
        axes.annotate(mark.label, place, (2, -down), coordinates, rotation=90, va="top", ha="left", **style)
    else:
        place, coordinates = (1.0, mark.value), ("axes fraction", "data")
        axes.annotate(mark.label, place, (4, 0), coordinates, va="center", ha="left", **style)


def _is_full(panel: Panel) -> bool:
    """Tell whether curves or bands may lie anywhere."""
    lines = [series for series in panel.series if series.kind == "line"]
    with_bands = any(series.low is not None for series in lines) and len(panel.series) > 1
    return panel.shape == "plain" and (with_bands or any(is_restless(series.y) for series in lines))


def has_outer_legend(panel: Panel) -> bool:
    """Tell whether the legend stands next to the axes."""
    named = [series for series in panel.series if not series.unlisted]
    entries = dict.fromkeys(word for series in named for word in (series.name, series.band) if word)
    return panel.shape == "plain" and len(entries) > _OUTSIDE


def draw_legend(axes: Any, panel: Panel) -> None:
    """Put a legend where it hides nothing.

    It is inside, next to or below the axes.
    """
    handles, labels = axes.get_legend_handles_labels()
    if not labels or (len(labels) == 1 and panel.field is None and not panel.marks and len(panel.series) == 1):
        return
    if len(labels) > _OUTSIDE and panel.shape == "plain":
        order = slice(None, None, -1) if panel.stacked else slice(None)
        axes.legend(handles[order], labels[order], loc="center left", bbox_to_anchor=(1.01, 0.5))
    elif panel.shape == "polar":
        axes.legend(handles, labels, loc="upper left", bbox_to_anchor=(-0.3, 1.08))
    elif panel.field is not None or panel.shape == "plane" or _is_full(panel):
        # What is drawn may be anywhere: the legend stands below.
        columns = 1 if max(map(len, labels)) > TITLE // 2 else 3 if panel.shape == "plain" else 2
        down = axes.transAxes + ScaledTranslation(0.0, -_LEGEND_BELOW, axes.figure.dpi_scale_trans)
        place = {"bbox_to_anchor": (-0.05, 0.0), "bbox_transform": down, "borderaxespad": 0.0}
        axes.legend(handles, labels, loc="upper left", ncols=columns, **place)
    else:
        legend = axes.legend(handles, labels, loc="best")
        legend.set_zorder(7)

"""One panel of a figure: series, marks, fields and arrows on matplotlib axes."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import LogNorm, TwoSlopeNorm
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter
from matplotlib.transforms import ScaledTranslation

from lambda_plugins.views.style import COLOUR_MAP, INK, SIGNED_MAP, SOFT, Look, look_of

if TYPE_CHECKING:
    from lambda_core.plugins import Arrows, Axis, Field, Mark, Panel, Series

_BAND = 0.18  # opacity of a band
_ARROW_SHARE = 0.11  # length of the longest arrow over the width of the panel
_LABELLED_BARS = 14
_HEADROOM = 1.06  # above the data, on axes that begin at a given value
_BELOW = 0.14  # margin that leaves room for numbers below bars
_OPEN = 9.0  # size of open markers [pt]
_DASHED = 130  # points up to which lines are dashed
_RESTLESS = 3.0  # way up and down over the range of values, from which a line fills its panel
_SMOOTH = 6  # places along each side from which a mesh is drawn smoothly
_LABEL = 32  # characters of a line of a label
_LEGEND_BELOW = 0.58  # [inch] below the axes: under the numbers and the label
_TITLE = 42  # the same of a title
_OUTSIDE = 4  # a longer legend stands beside the axes


def draw_panel(axes: Any, panel: Panel, *, legend: bool = True) -> None:
    """Draw one panel on its axes."""
    if panel.field is not None:
        _field(axes, panel.field)
        axes.use_sticky_edges = not any(series.kind == "points" for series in panel.series)
    looks = _looks(panel.series)
    if panel.stacked:
        _stacks(axes, panel.series, looks)
    else:
        bars = [s for s in panel.series if s.kind == "bars"]
        for series, look in zip(panel.series, looks, strict=True):
            if series.kind == "bars":
                _bars(axes, series, look, bars.index(series), len(bars))
            else:
                _curve(axes, series, look, polar=panel.shape == "polar", framed=panel.field is not None)
    if panel.arrows is not None:
        _arrows(axes, panel.arrows)
    for mark in panel.marks:
        _line(axes, mark)
    _axes(axes, panel)
    for mark in panel.marks:
        _label(axes, mark)
    if panel.title:
        axes.set_title("\n".join(textwrap.fill(line, _TITLE) for line in panel.title.splitlines()))
    if legend:
        _legend(axes, panel)


def _name(series: Series) -> str | None:
    return None if series.unlisted else series.name or None


def _looks(series: tuple[Series, ...]) -> list[Look]:
    """Return the look of every series: that of its role, of its group, or the next of the cycle."""
    found, position = [], 0
    for item in series:
        if item.group is not None:
            found.append(look_of("", item.group))
            continue
        found.append(look_of(item.role, position))
        position += 0 if item.role else 1
    return found


def _curve(axes: Any, series: Series, look: Look, *, polar: bool = False, framed: bool = False) -> None:
    x, y, low, high = series.x, series.y, series.low, series.high
    if polar:
        x = np.radians(x)
        if series.kind == "line":  # close the circle
            x, y = np.append(x, x[0]), np.append(y, y[0])
            low, high = (None if a is None else np.append(a, a[0]) for a in (low, high))
    name = _name(series)
    if series.kind == "points":
        # An open marker goes round the filled one of another series at the same place.
        style: dict[str, Any] = {"markerfacecolor": "none", "markersize": _OPEN, "zorder": 4.5}
        if look.filled:
            style = {"markeredgecolor": "white"} if framed else {}
        axes.plot(x, y, look.marker, color=look.colour, label=name, **{"markeredgewidth": 1.6, "zorder": 4} | style)
    else:
        dash, width = (look.dash, look.width) if _is_calm(y) else ("-", min(look.width, 1.4))
        axes.plot(x, y, color=look.colour, linestyle=dash, linewidth=width, label=name, zorder=3)
    if low is None or high is None:
        return
    if series.kind == "points":
        axes.errorbar(x, y, [y - low, high - y], fmt="none", ecolor=look.colour, elinewidth=1.2, capsize=3, zorder=3)
    else:
        axes.fill_between(x, low, high, color=look.colour, alpha=_BAND, linewidth=0.0, zorder=2)


def _is_calm(values: Any) -> bool:
    """Tell whether a line can be dashed: dashes of a long record that goes up and down would be noise of their own."""
    return values.size <= _DASHED or not _is_restless(values)


def _is_restless(values: Any) -> bool:
    """Tell whether a line goes up and down so often that it fills its panel."""
    known = values[np.isfinite(values)]
    return bool(known.size > 2 and np.abs(np.diff(known)).sum() > _RESTLESS * np.ptp(known))


def _bars(axes: Any, series: Series, look: Look, index: int, count: int) -> None:
    width = 0.8 / count
    places = series.x + (index - 0.5 * (count - 1)) * width
    axes.bar(places, series.y, width, label=_name(series), **_fill(look))
    if count * series.x.size <= _LABELLED_BARS:
        _values(axes, places, series.y, series.y)
        if np.nanmin(series.y, initial=0.0) < 0.0:
            axes.margins(y=_BELOW)


def _fill(look: Look) -> dict[str, Any]:
    return {"color": look.colour, "edgecolor": "white", "hatch": look.hatch, "linewidth": 0.8, "zorder": 3}


def _values(axes: Any, places: Any, tops: Any, values: Any) -> None:
    """Write numbers at the ends of bars, all to the digits that the largest one has."""
    largest = np.nanmax(np.abs(values)) if np.isfinite(values).any() else 0.0
    digits = max(0, 2 - int(np.floor(np.log10(largest)))) if largest > 0.0 else 0
    for place, top, value in zip(places, tops, values, strict=True):
        if np.isfinite(value):
            text = f"{value:.{digits}f}"
            above = value >= 0.0 or float(text) == 0.0
            axes.annotate(
                text.lstrip("-") if above else text,
                (place, max(top, 0.0) if above else top),
                (0, 3 if above else -3),
                textcoords="offset points",
                ha="center",
                va="bottom" if above else "top",
                fontsize=9.5,
                color=INK,
            )


def _stacks(axes: Any, series: tuple[Series, ...], looks: list[Look]) -> None:
    """Draw bars or areas on top of each other; anything else lies above them."""
    base: Any = None
    for item, look in zip(series, looks, strict=True):
        if item.kind not in ("bars", "area"):
            _curve(axes, item, look)
            continue
        base = np.zeros_like(item.y) if base is None else base
        height = np.nan_to_num(item.y)
        if item.kind == "bars":
            axes.bar(item.x, height, 0.72, bottom=base, label=_name(item), **_fill(look))
        else:
            style = _fill(look) | {"zorder": 2}
            colour = style.pop("color")
            axes.fill_between(item.x, base, base + height, facecolor=colour, label=_name(item), **style)
        base = base + height
    bars = [item for item in series if item.kind == "bars"]
    if bars and bars[0].x.size <= _LABELLED_BARS:
        _values(axes, bars[0].x, base, base)


def _field(axes: Any, field: Field) -> None:
    values = np.ma.masked_invalid(field.values)
    norm: Any = None
    if field.log:
        norm = LogNorm()
    elif field.signed:
        top = float(np.abs(values).max()) or 1.0
        norm = TwoSlopeNorm(0.0, -top, top)
    # A coarse or incomplete mesh is shown as it is, a cell per value.
    few = min(values.shape) < _SMOOTH
    coarse = few or bool(np.ma.getmaskarray(values).any())
    mesh = axes.pcolormesh(
        field.x,
        field.y,
        values,
        shading="nearest" if coarse else "gouraud",
        cmap=SIGNED_MAP if field.signed else COLOUR_MAP,
        norm=norm,
        rasterized=True,
        zorder=1,
    )
    bar = axes.figure.colorbar(mesh, ax=axes, label=textwrap.fill(field.text, _LABEL), pad=0.02, fraction=0.06)
    if field.log:
        bar.ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
        bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        bar.ax.yaxis.set_minor_formatter(NullFormatter())
    levels = [] if few else [level for level in field.levels if values.min() < level < values.max()]
    if levels:
        lines = axes.contour(field.x, field.y, values, levels, colors="white", linewidths=1.0, zorder=2)
        axes.clabel(lines, fontsize=9, fmt="%g")
    if field.lines is not None and np.nanmin(field.lines) < 0.0 < np.nanmax(field.lines):
        axes.contour(field.x, field.y, field.lines, [0.0], colors="white", linewidths=2.6, zorder=3)
        axes.contour(field.x, field.y, field.lines, [0.0], colors=INK, linewidths=1.3, linestyles="--", zorder=3)
        axes.plot([], [], color=INK, linewidth=1.3, linestyle="--", label=field.line_name)


def _arrows(axes: Any, arrows: Arrows) -> None:
    size = float(np.hypot(arrows.u, arrows.v).max())
    if size == 0.0:
        return
    drawn = axes.quiver(
        arrows.x,
        arrows.y,
        arrows.u,
        arrows.v,
        color="white",
        edgecolor=INK,
        linewidth=0.5,
        units="width",
        width=0.009,
        scale=size / _ARROW_SHARE,
        zorder=4,
    )
    axes.quiverkey(drawn, 0.78, 1.05, size, f"{size:.2g} {arrows.unit}", labelpos="E", fontproperties={"size": 10})


def _axes(axes: Any, panel: Panel) -> None:
    if panel.shape == "polar":
        axes.set_theta_zero_location("E")
        axes.set_thetagrids(range(0, 360, 30))
        axes.set_ylim(bottom=0.0)
        axes.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 2.5, 5, 10]))
        axes.set_rlabel_position(67.5)
        axes.tick_params(axis="y", labelsize=9.5)
        axes.set_xlabel(f"{panel.y.text} over {panel.x.text}")
        return
    _scale(axes, panel.x, "x")
    _scale(axes, panel.y, "y")
    if panel.shape == "plane":
        _square(axes)


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
    getattr(axes, f"set_{which}label")(textwrap.fill(axis.text, _LABEL))
    _limit(axes, axis, which)
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


def _limit(axes: Any, axis: Axis, which: str) -> None:
    """Set the ends that the axis asks for; the rest follows the data."""
    set_limits = getattr(axes, f"set_{which}lim")
    low, high = getattr(axes, f"get_{which}lim")()
    if axis.low is not None and axis.high is None and not axis.log:
        set_limits(axis.low, max(axis.low + _HEADROOM * (high - axis.low), axis.low + axis.least))
    elif axis.low is not None or axis.high is not None:
        set_limits(low if axis.low is None else axis.low, high if axis.high is None else axis.high)
    elif high - low < axis.least and not axis.log:
        middle = 0.5 * (low + high)
        set_limits(middle - 0.5 * axis.least, middle + 0.5 * axis.least)


def _line(axes: Any, mark: Mark) -> None:
    draw = axes.axvline if mark.axis == "x" else axes.axhline
    draw(mark.value, color=SOFT, linewidth=1.1, linestyle=(0, (2, 2)), zorder=2.5)


def _label(axes: Any, mark: Mark) -> None:
    """Write what a mark is, where it can be seen."""
    low, high = axes.get_xlim() if mark.axis == "x" else axes.get_ylim()
    if not mark.label or not low <= mark.value <= high:
        return
    paper = {"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    style = {"fontsize": 9.5, "color": SOFT, "zorder": 6, "textcoords": "offset points", "bbox": paper}
    if mark.axis == "x":
        place, coordinates = (mark.value, 0.985), ("data", "axes fraction")
        axes.annotate(mark.label, place, (2, 0), coordinates, rotation=90, va="top", ha="left", **style)
    else:
        place, coordinates = (1.0, mark.value), ("axes fraction", "data")
        axes.annotate(mark.label, place, (4, 0), coordinates, va="center", ha="left", **style)


def _is_full(panel: Panel) -> bool:
    return panel.shape == "plain" and any(series.kind == "line" and _is_restless(series.y) for series in panel.series)


def _legend(axes: Any, panel: Panel) -> None:
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
        columns = 1 if max(map(len, labels)) > _TITLE // 2 else 3 if panel.shape == "plain" else 2
        down = axes.transAxes + ScaledTranslation(0.0, -_LEGEND_BELOW, axes.figure.dpi_scale_trans)
        place = {"bbox_to_anchor": (-0.05, 0.0), "bbox_transform": down, "borderaxespad": 0.0}
        axes.legend(handles, labels, loc="upper left", ncols=columns, **place)
    else:
        legend = axes.legend(handles, labels, loc="best")
        legend.set_zorder(7)

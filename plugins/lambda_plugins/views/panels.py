"""Draw one panel of a figure on matplotlib axes."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import LogNorm, TwoSlopeNorm
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from lambda_plugins.views.frame import LABEL, TITLE, draw_axes, draw_labels, draw_legend, draw_line, is_restless
from lambda_plugins.views.style import COLOUR_MAP, INK, SIGNED_MAP, Look, look_of

if TYPE_CHECKING:
    from lambda_core.domain.arrays import FloatArray
    from lambda_core.plugins import Arrows, Field, Panel, Series

_BAND = 0.18  # opacity of a band
_ARROW_SHARE = 0.11  # length of the longest arrow over the width of the panel
_LABELLED_BARS = 14
_BELOW = 0.14  # margin that leaves room for numbers below bars
_OPEN = 9.0  # size of open markers [pt]
_DASHED = 130  # points up to which lines are dashed
_SMOOTH = 6  # places along each side from which a mesh is drawn smoothly


def draw_panel(axes: Any, panel: Panel, *, legend: bool = True) -> None:
    """Draw one panel on its axes."""
    if panel.field is not None:
        _field(axes, panel.field, panel.x.log, panel.y.log)
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
        draw_line(axes, mark)
    draw_axes(axes, panel)
    draw_labels(axes, panel.marks)
    if panel.title:
        axes.set_title("\n".join(textwrap.fill(line, TITLE) for line in panel.title.splitlines()))
    if legend:
        draw_legend(axes, panel)


def _name(series: Series) -> str | None:
    return None if series.unlisted else series.name or None


def _looks(series: tuple[Series, ...]) -> list[Look]:
    """Return the look of every series.

    It is that of its role, of its group, or the next of the cycle.

    Inner and outer ring look like the first two of the cycle: where they are drawn, the cycle starts behind them.
    """
    found, position = [], 2 if {"inner", "outer"} & {item.role for item in series} else 0
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
    is_named = bool(series.band) and series.band not in axes.get_legend_handles_labels()[1]
    words = series.band if is_named and not series.unlisted else None
    if series.kind == "points":
        style = {"ecolor": look.colour, "elinewidth": 1.2, "capsize": 3, "zorder": 3, "label": words}
        axes.errorbar(x, y, [y - low, high - y], fmt="none", **style)
    else:
        axes.fill_between(x, low, high, color=look.colour, alpha=_BAND, linewidth=0.0, zorder=2, label=words)


def _is_calm(values: Any) -> bool:
    """Tell whether a line can be dashed.

    Dashes of a long record that goes up and down would look like noise.
    """
    return values.size <= _DASHED or not is_restless(values)


def _bars(axes: Any, series: Series, look: Look, index: int, count: int) -> None:
    apart = float(np.diff(series.x).min()) if series.x.size > 1 else 1.0  # classes of a number, or 1 for names
    width = 0.8 / count * apart
    places = series.x + (index - 0.5 * (count - 1)) * width
    axes.bar(places, series.y, width, label=_name(series), **_fill(look))
    if count * series.x.size <= _LABELLED_BARS:
        _values(axes, places, series.y, series.y)
        if np.nanmin(series.y, initial=0.0) < 0.0:
            axes.margins(y=_BELOW)


def _fill(look: Look) -> dict[str, Any]:
    return {"color": look.colour, "edgecolor": "white", "hatch": look.hatch, "linewidth": 0.8, "zorder": 3}


def _values(axes: Any, places: Any, tops: Any, values: Any) -> None:
    """Write numbers at the ends of bars.

    All have the digits of the largest one.
    """
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
    """Draw bars or areas on top of each other.

    Anything else lies above them.
    """
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


def _corners(places: FloatArray, log: bool) -> FloatArray:
    """Return the corners of a mesh's cells.

    They lie half-way to the next place, on a linear or log axis.
    """
    grid = np.log(places) if log else np.asarray(places, dtype=np.float64)
    for axis in (0, 1):
        if grid.shape[axis] == 1:
            grid = np.repeat(grid, 2, axis)
            continue
        half = 0.5 * np.diff(grid, axis=axis)
        first = np.take(grid, [0], axis) - np.take(half, [0], axis)
        last = np.take(grid, [-1], axis) + np.take(half, [-1], axis)
        grid = np.concatenate([first, np.delete(grid, -1, axis) + half, last], axis)
    return np.exp(grid) if log else grid


def _field(axes: Any, field: Field, log_x: bool, log_y: bool) -> None:
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
    x, y = (_corners(field.x, log_x), _corners(field.y, log_y)) if coarse else (field.x, field.y)
    mesh = axes.pcolormesh(
        x,
        y,
        values,
        shading="flat" if coarse else "gouraud",
        cmap=SIGNED_MAP if field.signed else COLOUR_MAP,
        norm=norm,
        rasterized=True,
        zorder=1,
    )
    bar = axes.figure.colorbar(mesh, ax=axes, label=textwrap.fill(field.text, LABEL), pad=0.02, fraction=0.06)
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
    length = f"{float(f'{size:.2g}'):g} {arrows.unit}"
    axes.quiverkey(drawn, 0.78, 1.05, size, length, labelpos="E", fontproperties={"size": 10})

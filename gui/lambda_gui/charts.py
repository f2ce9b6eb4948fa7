"""Plot the panels of a view in the terminal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from rich.text import Text
from textual.color import Color
from textual.containers import Horizontal
from textual.widget import Widget
from textual.widgets import Static

from lambda_core.views.chart import Axis, Panel, Series, ViewData
from lambda_gui.maps import FieldPlot
from lambda_gui.plots import Colour, Plot, labels_of, padded, round_numbers, series_colour

if TYPE_CHECKING:
    from lambda_core.domain.arrays import FloatArray


_ROLES = {
    "inner": "primary",
    "outer": "accent",
    "cage": "success",
    "ball": "warning",
    "total": "foreground",
    "reference": "secondary",
}


def widget_for(panel: Panel) -> Widget:
    """Return the widget that draws a panel."""
    if panel.field is not None:
        return FieldPlot(panel)
    if panel.series and all(series.kind == "bars" for series in panel.series):
        return BarPlot(panel)
    return PanelPlot(panel)


class PanelPlot(Plot):
    """Lines, points, bars and marks."""

    def __init__(self, panel: Panel) -> None:
        super().__init__()
        self._panel = panel

    def on_mount(self) -> None:
        """Draw once the size is known."""
        super().on_mount()
        self.app.theme_changed_signal.subscribe(self, lambda _: self._fill())

    def on_resize(self) -> None:
        """Draw for the new size."""
        self._fill()

    def _fill(self) -> None:
        if self.size.width < 10 or self.size.height < 5:
            return
        panel = self._panel
        title = "  ".join(filter(None, (panel.title, panel.y.text)))
        self.clear(title)
        if panel.shape == "polar":
            self._polar(panel)
        else:
            self._curves(panel)
            self.name_x(panel.x.text)
        self.refresh()

    def _polar(self, panel: Panel) -> None:
        """Draw angles counter-clockwise from the right.

        They have one scale, over circles of round radius.
        """
        outer = max((float(np.nanmax(series.y, initial=0.0)) for series in panel.series), default=0.0) or 1.0
        circle = np.linspace(0.0, 2.0 * np.pi, 73)
        for radius in round_numbers(0.0, outer, 2)[1:] or [outer]:
            x, y = radius * np.cos(circle), radius * np.sin(circle)
            self._line(x, y, self.dimmed(self.colour("secondary")), None)
            self.plt.text(f"{radius:g}", 0.0, radius, color=self.colour("secondary"), background=self.colour("surface"))
        for number, series in enumerate(panel.series):
            angle = np.radians(series.x)
            x, y = series.y * np.cos(angle), series.y * np.sin(angle)
            colour, label = self._of(series, number), None if series.unlisted else series.name
            if series.kind == "points":
                keep = np.isfinite(x)
                self.plt.scatter(x[keep].tolist(), y[keep].tolist(), color=colour, marker="dot", label=label)
            else:
                closed = np.append(x, x[:1]), np.append(y, y[:1])
                self._line(*closed, colour, label)
        self._to_scale((-outer, outer), (-outer, outer))
        self.plt.xticks([], [])
        self.plt.yticks([], [])
        self.plt.frame(False)

    def _to_scale(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Widen one axis to a common scale.

        A cell is taken as twice as high as wide.
        """
        wide, high = max(4, self.size.width - 8), 2 * max(4, self.size.height - 4)
        middle_x, middle_y = 0.5 * sum(x), 0.5 * sum(y)
        unit = 1.05 * max((x[1] - x[0]) / wide, (y[1] - y[0]) / high)
        self.plt.xlim(middle_x - 0.5 * unit * wide, middle_x + 0.5 * unit * wide)
        self.plt.ylim(middle_y - 0.5 * unit * high, middle_y + 0.5 * unit * high)

    def _curves(self, panel: Panel) -> None:
        base = np.zeros(0)
        xs: list[FloatArray] = []
        ys: list[FloatArray] = []
        for number, series in enumerate(panel.series):
            x, y = _scaled(series.x, panel.x), series.y
            if panel.stacked and series.kind == "area":
                base = y if base.size == 0 else base + y
                y = base
            y = _scaled(y, panel.y)
            colour = self._of(series, number)
            label = None if series.unlisted or (len(panel.series) == 1 and panel.marks) else series.name
            if series.low is not None and series.high is not None:
                for edge in (_scaled(series.low, panel.y), _scaled(series.high, panel.y)):
                    self._line(x, edge, self.dimmed(colour), None)
                    ys.append(edge)
            if series.kind == "points":
                keep = np.isfinite(x) & np.isfinite(y)
                self.plt.scatter(x[keep].tolist(), y[keep].tolist(), color=colour, marker="dot", label=label)
            else:
                self._line(x, y, colour, label)
            xs.append(x)
            ys.append(y)
        self._axes(panel, xs, ys)

    def _line(self, x: FloatArray, y: FloatArray, colour: Colour, label: str | None) -> None:
        """Draw a line, broken where there is nothing."""
        keep = np.isfinite(x) & np.isfinite(y)
        pieces = np.split(np.arange(x.size), np.flatnonzero(np.diff(keep.astype(int))) + 1) if x.size else []
        for piece in pieces:
            if piece.size and keep[piece[0]]:
                self.plt.plot(x[piece].tolist(), y[piece].tolist(), color=colour, marker="braille", label=label)
                label = None

    def _axes(self, panel: Panel, xs: Sequence[FloatArray], ys: Sequence[FloatArray]) -> None:
        marked_x = [mark.value for mark in panel.marks if mark.axis == "x"]
        marked_y = [mark.value for mark in panel.marks if mark.axis == "y"]
        width, height = max(2, self.size.width // 11), max(2, self.size.height // 3)
        x_low, x_high = self._range(panel.x, xs, marked_x, exact=True)
        y_low, y_high = self._range(panel.y, ys, marked_y, exact=False)
        self._ticks(panel.x, x_low, x_high, "x", width)
        self._ticks(panel.y, y_low, y_high, "y", height)
        if panel.shape == "plane":
            self._to_scale((x_low, x_high), (y_low, y_high))
        free = x_low  # where the next label over the plot finds room
        for mark in sorted(panel.marks, key=lambda mark: mark.value):
            value = float(_scaled(np.array([mark.value]), panel.x if mark.axis == "x" else panel.y)[0])
            low, high = (x_low, x_high) if mark.axis == "x" else (y_low, y_high)
            if not low <= value <= high:
                continue
            draw = self.plt.vline if mark.axis == "x" else self.plt.hline
            draw(value, self.colour("secondary"))
            letter = (x_high - x_low) / max(1, self.size.width - 12)
            if mark.axis == "x" and mark.label:
                if value - letter * len(mark.label) < free:
                    continue
                free = value + 2.0 * letter
            if mark.label:
                at = (value, y_high) if mark.axis == "x" else (x_high, value)
                colour, back = self.colour("secondary"), self.colour("surface")
                self.plt.text(mark.label, *at, color=colour, background=back, alignment="right")

    def _range(
        self, axis: Axis, values: Sequence[FloatArray], marks: Sequence[float], *, exact: bool
    ) -> tuple[float, float]:
        flat = np.concatenate([*values, _scaled(np.array(marks, float), axis)]) if values else np.zeros(0)
        flat = flat[np.isfinite(flat)]
        ends = (float(flat.min()), float(flat.max())) if flat.size else (0.0, 1.0)
        low, high = ends if exact and ends[0] < ends[1] else padded(*ends, axis.least)
        given = _scaled(np.array([math.nan if e is None else e for e in (axis.low, axis.high)], float), axis)
        low = float(given[0]) if np.isfinite(given[0]) else low
        high = float(given[1]) if np.isfinite(given[1]) else high
        return (low, high) if low < high else padded(low, high)

    def _ticks(self, axis: Axis, low: float, high: float, name: str, wanted: int) -> None:
        if axis.log:
            places = [float(p) for p in range(math.ceil(low), math.floor(high) + 1)][
                :: max(1, int(high - low) // wanted)
            ]
            labels = [f"1e{place:.0f}" for place in places]
        else:
            places = list(axis.ticks) or round_numbers(low, high, wanted)
            labels = labels_of(places)
        (self.plt.xlim if name == "x" else self.plt.ylim)(low, high)
        (self.plt.xticks if name == "x" else self.plt.yticks)(places, labels)

    def _of(self, series: Series, number: int) -> Colour:
        name = _ROLES.get(series.role)
        if name is None:
            return self.cycle(series.group if series.group is not None else number)
        return self.colour(name)

    def dimmed(self, colour: Colour) -> Colour:
        """Return a colour halfway to the background."""
        back = Color.parse(self.app.theme_variables["surface"]).rgb
        return tuple((c + b) // 2 for c, b in zip(colour, back, strict=True))  # type: ignore[return-value]


def _scaled(values: FloatArray, axis: Axis) -> FloatArray:
    """Return the drawn values.

    They are logarithms on a logarithmic axis.
    """
    values = np.asarray(values, dtype=np.float64)
    if not axis.log:
        return values
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(values > 0.0, np.log10(np.where(values > 0.0, values, 1.0)), np.nan)


class BarPlot(Widget):
    """Horizontal bars with their names and numbers."""

    DEFAULT_CSS = """
    BarPlot { background: $surface; width: 1fr; height: 1fr; padding: 0 1; }
    """

    def __init__(self, panel: Panel) -> None:
        super().__init__()
        self._panel = panel

    def render(self) -> Text:
        """Draw one line per bar or stack.

        The legend is above them.
        """
        panel, colours = self._panel, self.app.theme_variables
        names = list(panel.x.categories) or [f"{x:g}" for x in panel.series[0].x]
        rows = np.array([np.nan_to_num(series.y) for series in panel.series])
        paint = [
            colours[_ROLES[s.role]] if s.role in _ROLES else series_colour(colours, number)
            for number, s in enumerate(panel.series)
        ]
        text = Text(f"{panel.title}   {panel.y.text}\n", no_wrap=True, overflow="ellipsis")
        used = 0
        for series, colour in zip(panel.series, paint, strict=True):
            if used and used + len(series.name) + 2 > self.size.width - 2:
                text.append("\n")
                used = 0
            text.append("■ ", style=colour).append(f"{series.name}  ", style="dim")
            used += len(series.name) + 4
        text.append("\n\n")
        width = max((len(name) for name in names), default=0)
        largest = float((rows.sum(axis=0) if panel.stacked else rows).max(initial=0.0)) or 1.0
        room = max(4, self.size.width - 2 - width - 12)
        digits = max(0, 2 - math.floor(math.log10(largest)))
        for place, name in enumerate(names):
            values = rows[:, place]
            if panel.stacked:
                text.append(f"{name:<{width}} ", style="dim")
                for value, colour in zip(values, paint, strict=True):
                    text.append("█" * round(value / largest * room), style=colour)
                text.append(f" {values.sum():.{digits}f}\n")
                continue
            for number, (value, colour) in enumerate(zip(values, paint, strict=True)):
                text.append(f"{name if number == 0 else '':<{width}} ", style="dim")
                text.append("█" * round(max(value, 0.0) / largest * room), style=colour).append(
                    f" {value:.{digits}f}\n"
                )
        return text


def rows_of(data: ViewData, width: int, height: int) -> list[Widget]:
    """Return a view's panels in rows.

    Its notes are added, and the place has so many columns and lines.
    """
    side, high = shape_of(data.panels, data.columns, width, height)
    rows: list[Widget] = []
    for first in range(0, len(data.panels), side):
        panels = data.panels[first : first + side]
        row = Horizontal(*map(widget_for, panels), classes="row")
        bars = [lines_of(panel, width // side) for panel in panels]
        row.styles.height = max(bars) + 1 if all(bars) else max(high, *bars)
        rows.append(row)
    return [*rows, Static(Text("\n".join(data.notes), style="dim"))]


def lines_of(panel: Panel, width: int) -> int:
    """Return the lines of a panel's bars.

    Title and legend count; 0 for other drawings.
    """
    if panel.field is not None or not panel.series or any(series.kind != "bars" for series in panel.series):
        return 0
    places = len(panel.x.categories) or len(panel.series[0].x)
    legend = math.ceil(sum(len(series.name) + 4 for series in panel.series) / max(1, width - 24))
    return 3 + legend + places * (1 if panel.stacked else len(panel.series))


def shape_of(panels: Sequence[Panel], columns: int, width: int, height: int) -> tuple[int, int]:
    """Return columns and height of the panels.

    The height is in characters.
    """
    side = max(1, min(columns, width // 48))
    rows = math.ceil(len(panels) / side)
    return side, max(14, (height - 3) // max(rows, 1))

"""Draw fields of values as maps in the terminal.

Each character has two cells of the map.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from rich.text import Text
from textual.color import Color
from textual.widget import Widget

from lambda_core.views.chart import Field, Panel

if TYPE_CHECKING:
    from lambda_core.domain.arrays import FloatArray


class FieldPlot(Widget):
    """Map of a field of values.

    Each character has two cells of it.
    """

    DEFAULT_CSS = """
    FieldPlot { background: $surface; width: 1fr; height: 1fr; text-wrap: nowrap; text-overflow: ellipsis; }
    """

    def __init__(self, panel: Panel) -> None:
        super().__init__()
        self._panel = panel

    def render(self) -> Text:
        """Draw the map, its scale and its edges."""
        panel = self._panel
        assert panel.field is not None
        width, height = self.size.width - 2, self.size.height - 4
        if width < 12 or height < 3:
            return Text()
        grid = resampled(panel.field, width, 2 * height)
        ramp = _Ramp(panel.field, grid, self.app.theme_variables)
        title = panel.field.text if panel.field.text.startswith(panel.title) else f"{panel.title}: {panel.field.text}"
        text = Text(title.center(self.size.width).rstrip() + "\n", no_wrap=True, overflow="ellipsis")
        for line in range(height):
            text.append(" ")
            for column in range(width):
                top, bottom = grid[2 * line, column], grid[2 * line + 1, column]
                _append_pair(text, ramp(top), ramp(bottom))
            text.append("\n")
        x, y = panel.field.x, panel.field.y
        ends = f"{panel.x.text} {_ends(x)}   {panel.y.text} {_ends(y)}"
        text.append(f" {ends if len(ends) <= width else ends.replace(' rolling', '')}\n ", style="dim")
        return text.append_text(ramp.scale(width))


def _ends(mesh: FloatArray) -> str:
    low, high = float(np.nanmin(mesh)), float(np.nanmax(mesh))
    return f"±{high:.3g}" if math.isclose(low, -high, rel_tol=1e-6) else f"{low:.3g} to {high:.3g}"


def _append_pair(text: Text, top: str, bottom: str) -> None:
    if top and bottom:
        text.append("▀", style=f"{top} on {bottom}")
    elif top or bottom:
        text.append("▀" if top else "▄", style=top or bottom)
    else:
        text.append(" ")


def resampled(field: Field, columns: int, rows: int) -> FloatArray:
    """Return the values on a regular grid.

    The first row is at the top; NaN where there is nothing.
    """
    x = np.linspace(np.nanmin(field.x), np.nanmax(field.x), columns)
    y = np.linspace(np.nanmax(field.y), np.nanmin(field.y), rows)
    along_x, along_y = _axis(field.x), _axis(field.y)
    if along_x is None or along_y is None or along_x[1] == along_y[1]:
        return _nearest(field, x, y)
    values = field.values if along_x[1] == 1 else field.values.T
    columns_at = np.abs(along_x[0][None, :] - x[:, None]).argmin(axis=1)
    rows_at = np.abs(along_y[0][None, :] - y[:, None]).argmin(axis=1)
    return np.asarray(values[np.ix_(rows_at, columns_at)], dtype=np.float64)


def _axis(mesh: FloatArray) -> tuple[FloatArray, int] | None:
    """Return a coordinate and its dimension.

    The dimension is None when it runs along both.
    """
    for dimension in (0, 1):
        line = mesh[:, 0] if dimension == 0 else mesh[0, :]
        lines = line[:, None] if dimension == 0 else line[None, :]
        if np.isfinite(line).all() and np.allclose(mesh, lines, equal_nan=True):
            return line, dimension
    return None


def _nearest(field: Field, x: FloatArray, y: FloatArray) -> FloatArray:
    """Return a bent mesh's nearest value.

    It is that of the nearest node.
    """
    spread_x, spread_y = x[-1] - x[0] or 1.0, y[0] - y[-1] or 1.0
    nodes = np.column_stack([(field.x / spread_x).ravel(), (field.y / spread_y).ravel()])
    values = field.values.ravel()
    grid = np.empty((y.size, x.size))
    for i, level in enumerate(y):
        away = (nodes[None, :, 0] - x[:, None] / spread_x) ** 2 + (nodes[None, :, 1] - level / spread_y) ** 2
        grid[i] = values[np.nanargmin(away, axis=1)]
    return grid


class _Ramp:
    """Colours of values.

    They go from the background over the theme's colours to white, and about zero for signed values.
    """

    def __init__(self, field: Field, grid: FloatArray, colours: dict[str, str]) -> None:
        self._field = field
        known = grid[np.isfinite(grid)]
        if field.log:
            known = np.log10(known[known > 0.0])
        self._low, self._high = (float(known.min()), float(known.max())) if known.size else (0.0, 1.0)
        if field.signed:
            self._high = max(abs(self._low), abs(self._high))
            self._low = -self._high
        middle = colours["surface"] if field.signed else colours["primary"]
        names = (colours["primary"] if field.signed else colours["panel"], middle, colours["accent"])
        self._stops = [Color.parse(name) for name in names]

    def __call__(self, value: float) -> str:
        if self._field.log:
            value = math.log10(value) if value > 0.0 else math.nan
        if not math.isfinite(value):
            return ""
        span = self._high - self._low
        share = 2.0 * (value - self._low) / span if span > 0.0 else 1.0
        first = min(1, max(0, int(share)))
        share = min(1.0, max(0.0, share - first))
        return self._stops[first].blend(self._stops[first + 1], round(share, 2)).hex

    def scale(self, width: int) -> Text:
        """Return the bar of the colours.

        It stands between its smallest and largest value.
        """
        ends = [10.0**end if self._field.log else end for end in (self._low, self._high)]
        low, high = (f"{end:.3g}" for end in ends)
        room = max(4, min(30, width - len(low) - len(high) - 2))
        text = Text(f"{low} ", style="dim")
        for cell in range(room):
            share = self._low + (self._high - self._low) * cell / (room - 1)
            text.append("█", style=self(10.0**share if self._field.log else share))
        return text.append(f" {high}", style="dim")

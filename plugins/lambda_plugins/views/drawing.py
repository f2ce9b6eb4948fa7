"""Draw figures of views with matplotlib.

The hook ``lambda_figure`` of the built-in plugin returns them.
"""

from __future__ import annotations

from io import BytesIO
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from lambda_plugins.views.frame import has_outer_legend
from lambda_plugins.views.panels import draw_panel
from lambda_plugins.views.style import INK, RC, SOFT
from lambda_plugins.views.verbatim import verbatim

if TYPE_CHECKING:
    from lambda_core.plugins import Panel, ViewData

_WIDTHS = {"plain": 5.0, "plane": 4.8, "polar": 4.6}  # of a panel [inch]
_HEIGHTS = {"plain": 3.7, "plane": 4.4, "polar": 4.4}
_ALONE = 8.4  # width of the only panel of a figure [inch]
_HEAD, _LINE = 0.78, 0.21  # room for title and source, for a line of notes [inch]
_SOURCE, _NOTE = 10.5, 9.5  # sizes of letters
_CHARACTER = 0.074  # width of a character of the notes [inch]


class HouseFigure(Figure):
    """Matplotlib figure in the style of the program."""

    def _repr_png_(self) -> bytes:
        """Return the figure as a notebook shows it."""
        buffer = BytesIO()
        self.savefig(buffer, format="png")
        return buffer.getvalue()

    def draw(self, renderer: Any) -> None:
        """Draw the figure.

        When matplotlib draws it to nowhere before it writes one, find the layout alone.
        """
        layout = self.get_layout_engine()
        if isinstance(layout, ConstrainedLayoutEngine) and self.canvas.is_saving():
            layout.execute(self)
        else:
            super().draw(renderer)

    def savefig(self, fname: Any, **options: Any) -> None:
        """Write the figure without a date.

        Equal data then give equal SVG files.
        """
        if options.get("format") == "svg":
            options.setdefault("metadata", {"Date": None})
        with matplotlib.rc_context(RC | {"svg.hashsalt": self.get_label() or "view"}):
            super().savefig(fname, **options)


def draw(data: ViewData) -> Figure:
    """Draw a view: title, source, panels, notes."""
    data = verbatim(data)
    with matplotlib.rc_context(RC):
        columns = min(data.columns, len(data.panels))
        legends = _legends(data.panels)
        grid = _grid(data.panels, columns, legends)
        columns = max(map(len, grid))
        widths = [max(_width(line[c], columns) for line in grid if c < len(line)) for c in range(columns)]
        heights = [max(_HEIGHTS[panel.shape] for panel in line) for line in grid]
        width = sum(widths)
        notes, sources = _wrapped(data.notes, width), _wrapped((data.source,), width * _NOTE / _SOURCE)
        foot = _LINE * len(notes) + 0.12
        head = _HEAD + _LINE * max(0, len(sources) - 1)
        height = sum(heights) + head + foot
        figure = HouseFigure(figsize=(width, height), dpi=100, label=f"{data.view} {data.source}")
        FigureCanvasAgg(figure)
        figure.set_layout_engine(
            "constrained", rect=(0.01, foot / height, 0.98, 1.0 - (head + foot) / height), w_pad=0.12, h_pad=0.1
        )
        spec = figure.add_gridspec(len(grid), columns, width_ratios=widths, height_ratios=heights)
        places = [(r, c) for r, line in enumerate(grid) for c in range(len(line))]
        for number, (panel, (r, c)) in enumerate(zip(data.panels, places, strict=True)):
            place = spec[r, :] if len(grid[r]) == 1 else spec[r, c]  # a panel alone in its line takes all of it
            axes: Any = figure.add_subplot(place, projection="polar" if panel.shape == "polar" else None)
            draw_panel(axes, panel, legend=number in legends)
        figure.text(0.15 / width, 1.0 - 0.14 / height, data.title, va="top", fontsize=15, weight="bold", color=INK)
        for i, line in enumerate(sources):
            figure.text(0.15 / width, 1.0 - (0.46 + _LINE * i) / height, line, va="top", fontsize=_SOURCE, color=SOFT)
        for i, note in enumerate(notes):
            figure.text(0.15 / width, (foot - 0.08 - _LINE * i) / height, note, va="top", fontsize=_NOTE, color=SOFT)
    return figure


def _grid(panels: tuple[Panel, ...], columns: int, legends: set[int]) -> list[list[Panel]]:
    """Return the panels line by line.

    A panel with a legend outside it is alone in its line: the legend would leave its neighbours no room.
    """
    grid: list[list[Panel]] = [[]]
    for number, panel in enumerate(panels):
        is_alone = columns > 1 and number in legends and has_outer_legend(panel)
        if grid[-1] and (is_alone or len(grid[-1]) == columns):
            grid.append([])
        grid[-1].append(panel)
        if is_alone:
            grid.append([])
    return [line for line in grid if line]


def _width(panel: Panel, columns: int) -> float:
    if columns == 1 and panel.shape == "plain":
        return _ALONE
    return _WIDTHS[panel.shape]


def _legends(panels: tuple[Panel, ...]) -> set[int]:
    """Return the panels that get a legend.

    One of several with the same entries gets it; a round one comes last.
    """
    first: dict[tuple[str, ...], int] = {}
    for number in sorted(range(len(panels)), key=lambda n: panels[n].shape == "polar"):
        panel = panels[number]
        lines = panel.field.line_name if panel.field is not None else ""
        first.setdefault((lines, *(s.name for s in panel.series if not s.unlisted)), number)
    return set(first.values())


def _wrapped(notes: tuple[str, ...], width: float) -> list[str]:
    """Break notes into lines that fit the figure."""
    import textwrap

    most = int(np.floor(width / _CHARACTER))
    return [line for note in notes for line in textwrap.wrap(note, most)]

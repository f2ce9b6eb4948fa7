"""Find text that a screen cuts off."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from driving import screen_text
from lambda_gui.charts import BarPlot, PanelPlot
from lambda_gui.maps import FieldPlot
from lambda_gui.traces import Trace
from rich.cells import cell_len
from rich.table import Table
from textual.containers import ScrollableContainer
from textual.errors import NoWidget
from textual.geometry import Region
from textual.scroll_view import ScrollView
from textual.widget import Widget
from textual.widgets import Button, DataTable, Input, OptionList, Static

if TYPE_CHECKING:
    from lambda_gui.app import BuilderApp

Cut = str


def cut_on(app: BuilderApp, within: Widget | None = None) -> list[Cut]:
    """Return cut texts on the screen.

    A sentence for each piece of text on it, or within a widget, that is not complete.
    """
    found = [f"ellipsis: {line.strip()}" for line in screen_text(app).splitlines() if "…" in line]
    for widget in (within or app.screen).query("*").results(Widget):
        if not widget.is_attached or not all(above.display for above in widget.ancestors_with_self):
            continue
        try:
            place = app.screen.find_widget(widget)
        except NoWidget:
            continue
        found += [f"{_name(widget)}: {what}" for what in _cut(app, widget, place.region, place.clip)]
    return found


def _name(widget: Widget) -> str:
    named = f"#{widget.id}" if widget.id else "".join(f".{name}" for name in sorted(widget.classes))
    return f"{type(widget).__name__}{named}"


def _cut(app: BuilderApp, widget: Widget, region: Region, clip: Region) -> Iterator[str]:
    if isinstance(widget, ScrollView | ScrollableContainer) and not isinstance(widget, Input):
        hidden = widget.virtual_size.width - widget.scrollable_content_region.width
        if hidden > 0:
            yield f"{hidden} columns to scroll sideways"
    if not region:
        return
    if region.x < clip.x or region.right > clip.right:
        yield f"columns {region.x} to {region.right} of which {clip.x} to {clip.right} are seen"
    if (region.y < clip.y or region.bottom > clip.bottom) and not _scrolls(widget):
        yield f"lines {region.y} to {region.bottom} of which {clip.y} to {clip.bottom} are seen"
    width, height = widget.content_size
    if isinstance(widget, Input):
        text = widget.value or widget.placeholder
        if cell_len(text) + bool(widget.value and widget.has_focus) > width:
            yield f"{text!r} in {width} columns"
    elif isinstance(widget, Button):
        if widget.label.cell_length > width:
            yield f"{widget.label.plain!r} in {width} columns"
    elif isinstance(widget, Static):
        yield from _cut_static(widget, width, height)
    elif isinstance(widget, DataTable):
        yield from _cut_cells(widget)
    elif isinstance(widget, OptionList):
        yield from _cut_options(app, widget, region.intersection(clip))
    elif isinstance(widget, BarPlot | FieldPlot):
        lines = len(str(widget.render()).splitlines())
        if lines > height:
            yield f"{lines} lines in {height}"
    elif isinstance(widget, PanelPlot | Trace):
        yield from _cut_plot(app, widget, region)


def _scrolls(widget: Widget) -> bool:
    return any(
        isinstance(above, Widget) and above.max_scroll_y > 0 and above.allow_vertical_scroll
        for above in widget.ancestors
    )


def _cut_static(widget: Static, width: int, height: int) -> Iterator[str]:
    visual, rules = widget.visual, widget.styles
    plain = str(visual)
    longest = max((cell_len(line.rstrip()) for line in plain.splitlines()), default=0)
    if rules.text_wrap == "nowrap" and longest > width:
        yield f"{plain!r} in {width} columns"
    lines = visual.get_height(rules, width)
    if lines > height and not (widget.max_scroll_y > 0):
        yield f"{plain!r}: {lines} lines in {height}"


def _cut_cells(table: DataTable[object]) -> Iterator[str]:
    for column in table.ordered_columns:
        for cell in (column.label, *table.get_column(column.key)):
            if cell_len(str(cell)) > column.get_render_width(table) - 2 * table.cell_padding:
                yield f"{str(cell)!r} in {column.get_render_width(table) - 2 * table.cell_padding} columns"


def _cut_options(app: BuilderApp, options: OptionList, region: Region) -> Iterator[str]:
    """Return the cut options.

    Entries that begin on the screen, and whose successor does, must be complete.
    """
    lines = screen_text(app).splitlines()[region.y : region.bottom]
    right = region.right - (options.scrollbar_size_vertical if options.show_vertical_scrollbar else 0)
    shown = "".join("".join(line[region.x : right].split()) for line in lines)
    texts = ["".join(str(option.prompt).split()) for option in options.options if not isinstance(option.prompt, Table)]
    for text, following in pairwise(texts):
        if text[:20] in shown and following[:20] in shown and text not in shown:
            yield f"{text!r} in {shown!r}"


def _cut_plot(app: BuilderApp, plot: PanelPlot | Trace, region: Region) -> Iterator[str]:
    """Return the texts missing in a plot.

    Titles, names of axes and series: plotext leaves out what has no room.
    """
    lines = screen_text(app).splitlines()
    shown = "\n".join(line[region.x : region.right] for line in lines[region.y : region.bottom])
    if region.bottom > len(lines):
        return  # scrolled away
    for text in plot.words:
        if text and text not in shown:
            yield f"{text!r} is not in the plot"

"""Everything that the equilibrium of a shaft says: numbers of every bearing, and curves along the shaft."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, VerticalScroll
from textual.screen import Screen
from textual.widgets import Footer, Static

from lambda_core.views.other_units import in_units
from lambda_gui.charts import notes_text, shape_of, widget_for

if TYPE_CHECKING:
    from lambda_core.api import MachineEstimate, MachineModel
    from lambda_core.domain.unit_systems import UnitSystem


class ShaftAnswerScreen(Screen[None]):
    """Numbers over curves.

    Parameters
    ----------
    model, answer
        The machine, and its equilibrium and modes.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("pagedown,space", "scroll(1)", "Further", priority=True),
        Binding("pageup", "scroll(-1)", show=False, priority=True),
        Binding("escape,f3", "app.pop_screen", "Back"),
    ]
    DEFAULT_CSS = """
    ShaftAnswerScreen { background: $background; }
    ShaftAnswerScreen VerticalScroll { height: 1fr; padding: 0 1; scrollbar-size-vertical: 1; }
    ShaftAnswerScreen Static { width: 1fr; height: auto; }
    ShaftAnswerScreen .row { width: 1fr; }
    """

    def __init__(self, model: MachineModel, answer: MachineEstimate) -> None:
        super().__init__()
        self._model, self._answer = model, answer

    def compose(self) -> ComposeResult:
        """Lay out the numbers, and a plot for each panel."""
        from lambda_core import api

        units: UnitSystem = self.app.units  # type: ignore[attr-defined]
        width, height = self.app.size
        found, modes = self._answer.equilibrium, self._answer.modes
        with VerticalScroll():
            yield Static(Text(found.text(width - 4, units)))
            yield Static(Text("\n" + modes.text(width - 4, units)))
            for view in api.machine_pictures(self._model, found, modes):
                data = in_units(view, units)
                panels = [panel for panel in data.panels if panel.arrows is None]  # the shaft itself stands elsewhere
                side, high = shape_of(panels, 2, width, height)
                for first in range(0, len(panels), side):
                    row = Horizontal(*map(widget_for, panels[first : first + side]), classes="row")
                    row.styles.height = high
                    yield row
                yield Static(notes_text(data.notes[-1:]))
        yield Footer()

    def on_mount(self) -> None:
        """Take the keyboard."""
        self.query_one(VerticalScroll).focus()

    def action_scroll(self, by: int) -> None:
        """Scroll by a screen."""
        content = self.query_one(VerticalScroll)
        content.scroll_relative(y=by * max(1, content.size.height - 1), animate=False)

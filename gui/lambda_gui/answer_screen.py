"""Answer questions about the case without a run.

The answers are equilibrium, temperatures, currents and friction.
"""

from __future__ import annotations

from copy import deepcopy
from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual import work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import Screen
from textual.widget import Widget
from textual.widgets import Static, Tab, Tabs

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.wrapping import wrapped
from lambda_core.views.other_units import in_units
from lambda_gui.charts import rows_of
from lambda_gui.footer import KeyLine
from lambda_gui.helper import Helper
from lambda_gui.lifecycle import is_here

if TYPE_CHECKING:
    from lambda_core.api import Draft
    from lambda_core.domain.unit_systems import UnitSystem
    from lambda_core.views.chart import ViewData

# Question, and the words on its tab; the helper process has a function for each question
QUESTIONS = {
    "equilibrium": "equilibrium",
    "temperatures": "temperatures",
    "currents": "bearing currents",
    "friction": "friction over speed",
    "assumptions": "assumptions",
}


class AnswerScreen(Screen[None]):
    """Questions on tabs above their answer.

    The answer belongs to the chosen tab.

    Parameters
    ----------
    draft : Draft
        The case, without mistakes; later changes of it do not count.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("pagedown,space", "scroll(1)", "Scroll", priority=True),
        Binding("pageup", "scroll(-1)", show=False, priority=True),
        Binding("down", "line(1)", show=False),
        Binding("up", "line(-1)", show=False),
        Binding("escape,f10,ctrl+g", "app.pop_screen", "Back", key_display="Esc"),
    ]
    DEFAULT_CSS = """
    AnswerScreen { background: $background; }
    AnswerScreen Tab { padding: 0 1; }
    AnswerScreen #title { height: 1; padding: 0 1; width: 1fr; color: $text-muted; }
    AnswerScreen #content { height: 1fr; padding: 0 1; scrollbar-size-vertical: 1; }
    AnswerScreen #content Static { width: 1fr; height: auto; }
    AnswerScreen .row { width: 1fr; }
    """

    def __init__(self, draft: Draft) -> None:
        super().__init__()
        self._name = str(draft.get("name") or "")
        self._case = {"tables": deepcopy(draft.tables), "folder": str(draft.folder) if draft.folder else None}
        self._found: dict[str, tuple[str, list[ViewData]]] = {}
        self._helper = Helper(self._say, lambda: is_here(self))

    def compose(self) -> ComposeResult:
        """Lay out the questions over the answer."""
        yield Tabs(*(Tab(words, id=name) for name, words in QUESTIONS.items()))
        yield Static(id="title")
        yield VerticalScroll(id="content", can_focus=False)
        yield KeyLine()

    def on_mount(self) -> None:
        """Take the keyboard.

        A change of the theme draws the answer anew.
        """
        self.query_one(Tabs).focus()
        self.app.theme_changed_signal.subscribe(self, lambda _: self._show())

    async def on_unmount(self) -> None:
        """End the helper."""
        await self._helper.close()

    def on_resize(self) -> None:
        """Draw for the new size."""
        self._show()

    def on_tabs_tab_activated(self, event: Tabs.TabActivated) -> None:
        """Answer the question on the tab."""
        self._show()

    @property
    def question(self) -> str:
        """The question on the tab that is shown."""
        return self.query_one(Tabs).active or next(iter(QUESTIONS))

    @property
    def is_answered(self) -> bool:
        """True once the question is answered."""
        return self.question in self._found

    def _say(self, words: str) -> None:
        if is_here(self):
            self.query_one("#title", Static).update(Text(f"{self._name}: {words}", no_wrap=True, overflow="ellipsis"))

    @work(exclusive=True, group="answer")
    async def _show(self) -> None:
        question, units = self.question, self._units
        if question not in self._found:
            self._say("solving ...")
            await self._put()
            try:
                found = await self._helper.ask("answer", question=question, units=units.name, **self._case)
            except LambdaError as error:
                self._say("no answer")
                await self._put(Static(Text(str(error), style=self.app.theme_variables["error"])))
                return
            self._found[question] = found
        text, views = self._found[question]
        self._say("the present case, without a run")
        room = self.query_one("#content", VerticalScroll).size
        shown: list[Widget] = [Static(Text("\n".join(wrapped(text.splitlines(), max(40, room.width - 2)))))]
        for view in views:
            shown += rows_of(_drawn(in_units(view, units)), room.width - 2, room.height)
        await self._put(*shown)

    @property
    def _units(self) -> UnitSystem:
        found: UnitSystem = self.app.units  # type: ignore[attr-defined]
        return found

    async def _put(self, *widgets: Widget) -> None:
        content = self.query_one("#content", VerticalScroll)
        async with self.batch():
            await content.remove_children()
            if is_here(self):
                await content.mount(*widgets)
                content.scroll_home(animate=False)

    def action_scroll(self, by: int) -> None:
        """Scroll by a screen."""
        content = self.query_one("#content", VerticalScroll)
        content.scroll_relative(y=by * max(1, content.size.height - 1), animate=False)

    def action_line(self, by: int) -> None:
        """Scroll by a line."""
        self.query_one("#content", VerticalScroll).scroll_relative(y=by, animate=False)


def _drawn(view: ViewData) -> ViewData:
    """Return a view without the shaft's panels.

    The builder draws the shaft itself.
    """
    panels = tuple(panel for panel in view.panels if panel.arrows is None)
    return replace(view, panels=panels, notes=view.notes[-1:])

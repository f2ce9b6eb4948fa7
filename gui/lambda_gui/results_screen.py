"""Show results and studies, compare and export them."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual import work
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical, VerticalScroll
from textual.widget import Widget
from textual.widgets import DataTable, OptionList, Static
from textual.widgets.option_list import Option

from lambda_core.domain.errors import LambdaError
from lambda_core.views.other_units import in_units
from lambda_gui.charts import rows_of
from lambda_gui.dialogs import AskText
from lambda_gui.export import DIFFERENCES, SUMMARY, ExportScreen
from lambda_gui.footer import KeyLine
from lambda_gui.lifecycle import is_here
from lambda_gui.pictures import NONE_HERE
from lambda_gui.result_files import is_study, named, results_in, stamp_of
from lambda_gui.summary_view import summary_view
from lambda_gui.table_views import differences_view, study_view

if TYPE_CHECKING:
    from lambda_core.api import Summary
    from lambda_core.views.chart import ViewData

_LIVE = 2.0  # how often a result that grows is read again [s]


class ResultsScreen(ExportScreen):
    """Result files and studies of a folder.

    Parameters
    ----------
    folder : pathlib.Path
        Whose results are listed.
    shown : pathlib.Path, optional
        The result to begin with.
    """

    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (112, "-wide")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("space", "mark", "Mark"),
        Binding("e", "figure", "Figure"),
        Binding("t", "report", "Report"),
        Binding("c", "case", "Case"),
        Binding("b", "bearing", "Bearing", show=False),
        Binding("o", "other", "Open", show=False),
        Binding("p", "pictures", "Pictures or text", show=False),
        Binding("tab", "switch", "Results or views", show=False, priority=True),
        Binding("pagedown", "scroll(1)", show=False, priority=True),
        Binding("pageup", "scroll(-1)", show=False, priority=True),
        Binding("escape,f6", "app.pop_screen", "Back"),
    ]
    DEFAULT_CSS = """
    ResultsScreen { background: $background; }
    ResultsScreen #left { width: 27; border-right: vkey $border-blurred; }
    ResultsScreen #files { height: 7; background: $background; scrollbar-size: 0 1; padding: 0 1; }
    ResultsScreen #views { height: 1fr; background: $background; border: none; padding: 0 1;
        border-top: hkey $border-blurred; scrollbar-size-vertical: 1; }
    ResultsScreen #views:focus { border: none; border-top: hkey $border; }
    ResultsScreen #title { height: auto; padding: 0 1; width: 1fr; }
    ResultsScreen #content { height: 1fr; padding: 0 1; scrollbar-size-vertical: 1; }
    ResultsScreen #content Static { width: auto; height: auto; }
    ResultsScreen .row { width: 1fr; }
    ResultsScreen.-wide #left { width: 36; }
    ResultsScreen.-wide #files { height: 14; }
    """

    def __init__(self, folder: Path, shown: Path | None = None) -> None:
        super().__init__(folder)
        self._first = shown
        self._files: list[Path] = []
        self._more: list[Path] = [shown] if shown is not None else []
        self._marked: set[Path] = set()
        self._stamp: object = None
        self._of_path: Path | None = None  # the result whose bearing is chosen
        self._subject = ""  # what the listed views are of
        self._data: ViewData | None = None  # of the text charts that are shown
        self._drawn: TemporaryDirectory[str] | None = None  # where pictures are drawn; none: text charts are shown

    def compose(self) -> ComposeResult:
        """Lay out files, views and the picture.

        The picture is at the right.
        """
        with Horizontal():
            with Vertical(id="left"):
                yield DataTable(cursor_type="row", show_header=False, cell_padding=0, id="files")
                yield OptionList(id="views", markup=False)
            with Vertical():
                yield Static(id="title")
                yield VerticalScroll(id="content", can_focus=False)
        yield KeyLine()

    def on_mount(self) -> None:
        """List what there is."""
        if self.app.picture is not None:  # type: ignore[attr-defined]
            self.action_pictures()
        table = self.query_one("#files", DataTable)
        table.add_column("", width=2)
        table.add_column("result")
        self._list(self._first)
        self.query_one("#views", OptionList).focus()
        self.app.theme_changed_signal.subscribe(self, lambda _: self._show())
        self.set_interval(_LIVE, self._refresh_live)
        self._fill_views()

    async def on_unmount(self) -> None:
        """End the helper."""
        await self._helper.close()
        if self._drawn is not None:
            self._drawn.cleanup()

    def on_resize(self) -> None:
        """Lay the panels out for the new size."""
        if self._data is not None:
            self._show_data(self._data)

    def say(self, words: str = "") -> None:
        """Write a message over the content.

        What is shown, and what is being done.
        """
        if not is_here(self):
            return
        names = "  ".join(path.name for path in self.chosen())
        names += f"  {self._bearing}" if names and self._bearing else ""
        text = Text(names or "no result files here", style="bold")
        self.query_one("#title", Static).update(text.append(f"\n{words}", style="dim not bold"))

    # -- files --

    def _list(self, keep: Path | None) -> None:
        table = self.query_one("#files", DataTable)
        found = {path.resolve(): None for path in (*self._more, *results_in(self._folder))}
        self._files = [path for path in found if path.exists()]
        table.clear()
        for path in self._files:
            table.add_row(Text("●" if path in self._marked else "", style="bold"), named(path))
        if keep is not None and keep.resolve() in self._files:
            table.move_cursor(row=self._files.index(keep.resolve()))

    def current(self) -> Path | None:
        """Return the result under the cursor."""
        at = self.query_one("#files", DataTable).cursor_row
        return self._files[at] if 0 <= at < len(self._files) else None

    def chosen(self) -> list[Path]:
        """Return the marked results, else the one under the cursor."""
        marked = [path for path in self._files if path in self._marked]
        current = self.current()
        return marked or ([current] if current is not None else [])

    def on_data_table_row_highlighted(self, event: DataTable.RowHighlighted) -> None:
        """Show the result under the cursor.

        A study has other views.
        """
        if self.current() != self._of_path:
            self._of_path, self._bearing = self.current(), None
        if self._subject not in ("", self._of()):
            self._fill_views()
        else:
            self._show()

    def _of(self) -> str:
        """Return what is chosen: a result, several, or a study."""
        chosen = self.chosen()
        if len(chosen) > 1:
            return "results"
        return "study" if chosen and is_study(chosen[0]) else "result"

    def action_mark(self) -> None:
        """Mark a result; two or more are compared."""
        path = self.current()
        if path is None:
            return
        if is_study(path):
            self.notify("a study cannot be compared with results; its views compare its points", timeout=4)
            return
        self._marked ^= {path}
        was_many = len(self._marked - {path}) > 1 or len(self._marked) > 1
        self._list(path)
        if was_many or len(self._marked) < 2:
            self._fill_views()

    def action_other(self) -> None:
        """Open a result from elsewhere."""

        def opened(text: str | None) -> None:
            if text is None:
                return
            path = Path(text).expanduser()
            if path.is_dir() and not is_study(path):
                self._folder = path
            elif path.exists():
                self._more.append(path)
            else:
                self.notify(f"{path} does not exist", severity="error")
                return
            self._list(path)
            self._show()

        self.app.push_screen(AskText("Result file or folder", str(self._folder)), opened)

    def action_switch(self) -> None:
        """Go from the results to the views and back."""
        files, views = self.query_one("#files", DataTable), self.query_one("#views", OptionList)
        (files if views.has_focus else views).focus()

    def action_scroll(self, by: int) -> None:
        """Scroll what is shown."""
        content = self.query_one("#content", VerticalScroll)
        content.scroll_relative(y=by * max(1, content.size.height - 1), animate=False)

    # -- views --

    @work(exclusive=True, group="views")
    async def _fill_views(self) -> None:
        """List the views of the results.

        They are those of one result, of several, or of a study.
        """
        subject = self._subject = self._of()
        try:
            cards = await self._helper.ask("views", subject=subject)
        except LambdaError as error:
            self.notify(str(error), severity="error")
            return
        options = self.query_one("#views", OptionList)
        options.clear_options()
        first = [SUMMARY, DIFFERENCES] if subject == "results" else [SUMMARY]
        options.add_options([Option(name, id=name) for name in first])
        options.add_options([Option(card.name.replace("-", " "), id=card.name) for card in cards])
        names = [*first, *(card.name for card in cards)]
        if self._view not in names or (subject == "results" and self._view == SUMMARY):
            self._view = {"results": DIFFERENCES, "study": cards[0].name if cards else SUMMARY}.get(subject, SUMMARY)
        options.highlighted = names.index(self._view)
        self._show()

    def on_option_list_option_highlighted(self, event: OptionList.OptionHighlighted) -> None:
        """Show the view under the cursor."""
        name = event.option_id or SUMMARY
        if name != self._view:
            self._view = name
            self._show()

    def _refresh_live(self) -> None:
        """Read a grown result again.

        Take in files that came or went.
        """
        known = {path.resolve() for path in (*self._more, *results_in(self._folder)) if path.exists()}
        if known != set(self._files):
            self._marked &= known
            self._list(self.current())
            self._show()
        elif stamp_of(self.chosen()) != self._stamp:
            self._show()

    @work(exclusive=True, group="show")
    async def _show(self) -> None:
        paths = self.chosen()
        self.say("reading ..." if paths else "Esc, then F5 runs the case; o opens a result from elsewhere")
        if not paths:
            await self.query_one("#content", VerticalScroll).remove_children()
            return
        self._stamp = stamp_of(paths)
        try:
            if self._view in (SUMMARY, DIFFERENCES):
                self._data = None
                await self._show_words(paths)
                return
            if self._drawn is not None:
                self._data = None
                await self._show_picture(paths, self._drawn.name)
                return
            sources = [str(path) for path in paths]
            data = await self._helper.ask("view", sources=sources, name=self._view, bearing=self._bearing)
            self._data = in_units(data, self._units)
        except LambdaError as error:
            self._data = None
            await self._put(Static(Text(str(error), style="bold")))
            self.say()
            return
        self._show_data(self._data)

    def action_pictures(self) -> None:
        """Change between pictures and text charts."""
        if self.app.picture is None:  # type: ignore[attr-defined]
            self.notify(NONE_HERE, severity="warning", timeout=8, markup=False)
        elif self._drawn is None:
            self._drawn = TemporaryDirectory(prefix="lambda-bearing-")
            self._show()
        else:
            self._drawn.cleanup()
            self._drawn = None
            self._show()

    async def _show_picture(self, paths: list[Path], folder: str) -> None:
        """Show the view as a picture.

        It is drawn as for files, as large as there is room.
        """
        (drawn,) = await self._helper.ask(
            "draw", sources=[str(path) for path in paths], name=self._view, folder=folder, units=self._units.name,
            formats=["png"], bearing=self._bearing,
        )  # fmt: skip
        shown: Widget = self.app.picture(drawn)  # type: ignore[attr-defined]
        room = self.query_one("#content", VerticalScroll).size
        shown.styles.width, shown.styles.height = "auto", max(1, room.height - 1)
        shown.styles.max_width = max(1, room.width - 3)
        await self._put(shown)
        self.say(f"{self._view.replace('-', ' ')}   p: as text")

    async def _show_words(self, paths: list[Path]) -> None:
        """Show what is no picture: summaries, a study, what differs."""
        width = self.query_one("#content", VerticalScroll).size.width - 3
        if self._view == DIFFERENCES:
            differences = await self._helper.ask("differences", sources=[str(path) for path in paths])
            await self._put(*map(Static, differences_view(differences, width, self._units)))
            self.say()
        elif is_study(paths[0]):
            status, points = await self._helper.ask("study_summary", path=str(paths[0]))
            await self._put(*map(Static, study_view(status, points, width, self._units)))
            self.say(f"{status.points} points, {status.mode}")
        else:
            found = [await self._helper.ask("summary", path=str(path), bearing=self._bearing) for path in paths]
            await self._put(*(Static(self._summary(one, width)) for one in found))
            several = any(len(one.bearings) > 1 for one in found) or self._bearing
            self.say("   ".join(summary.state for summary in found) + ("   b: next bearing" if several else ""))

    def _summary(self, found: Summary, width: int) -> Text:
        """Lay out a summary.

        That of a machine has a section for each bearing.
        """
        if len(found.bearings) > 1:
            return Text(found.text(width, self._units))
        return summary_view(found, self.app.theme_variables, self._units)

    @work(exclusive=True, group="bearing")
    async def action_bearing(self) -> None:
        """Go to the next bearing.

        It goes from a machine to its first bearing, to the next one, and back to the machine.
        """
        path = self.current()
        if path is None or is_study(path):
            return
        try:
            names = await self._helper.ask("bearings", path=str(path))
        except LambdaError as error:
            self.notify(str(error), severity="error")
            return
        if len(names) < 2:
            self.notify("this result has one bearing", timeout=4)
            return
        choices = [None, *names]
        at = choices.index(self._bearing) if self._bearing in choices else 0
        self._of_path, self._bearing = path, choices[(at + 1) % len(choices)]
        self._show()

    def _show_data(self, data: ViewData) -> None:
        self.say(f"{data.title}   {data.source}")
        room = self.query_one("#content", VerticalScroll).size
        self.run_worker(self._put(*rows_of(data, room.width, room.height)), exclusive=True, group="put")

    async def _put(self, *widgets: Widget) -> None:
        content = self.query_one("#content", VerticalScroll)
        async with self.batch():
            await content.remove_children()
            if not is_here(self):
                return
            await content.mount(*widgets)
        for widget in widgets:
            if isinstance(widget, Static):
                widget.styles.width = "1fr"

"""Show the queue of runs and live traces."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.screen import Screen
from textual.widgets import DataTable, Static

from lambda_core.domain.number_text import plus_minus
from lambda_gui.derived import duration
from lambda_gui.footer import KeyLine
from lambda_gui.lifecycle import is_here
from lambda_gui.traces import CageTrace, LoadTrace, TorqueTrace, Trace

if TYPE_CHECKING:
    from lambda_core.api import QueuedRun, RunQueue

_COLUMNS = (("", 1), ("case", 24), ("progress", 12), ("time left", 9), ("torque N mm", 16))
_MARK = {"waiting": "○", "running": "▶", "done": "✔", "stopped": "■", "failed": "✘"}


class RunScreen(Screen[None]):
    """All runs of this builder."""

    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (112, "-wide")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("c", "cancel", "Cancel"),
        Binding("g", "go_on", "Go on"),
        Binding("enter,f6", "result", "Result", priority=True),
        Binding("x", "clear", "Clear ended"),
        Binding("escape,f7", "app.pop_screen", "Back"),
    ]
    DEFAULT_CSS = """
    RunScreen { background: $background; }
    RunScreen DataTable { height: 5; background: $background; scrollbar-size-vertical: 1; }
    RunScreen #state { height: auto; min-height: 3; padding: 0 1; }
    RunScreen #plots { height: 1fr; }
    RunScreen #right { width: 1fr; }
    RunScreen.-wide DataTable { height: 10; }
    """

    def __init__(self, queue: RunQueue, shown: QueuedRun | None = None) -> None:
        super().__init__()
        self._queue = queue
        self._first = shown
        self._drawn: object = None

    def compose(self) -> ComposeResult:
        """Lay out queue, state and traces."""
        yield DataTable(cursor_type="row")
        yield Static(id="state")
        with Horizontal(id="plots"):
            yield TorqueTrace()
            with Vertical(id="right"):
                yield CageTrace()
                yield LoadTrace()
        yield KeyLine()

    def on_mount(self) -> None:
        """Show the queue and follow it."""
        table = self.query_one(DataTable)
        for title, width in _COLUMNS:
            table.add_column(title, width=width, key=title)
        table.focus()
        self.follow()
        if self._first in self._queue.runs:
            table.move_cursor(row=self._queue.runs.index(self._first))
        self.call_after_refresh(self._draw)

    def on_resize(self) -> None:
        """Adapt names and drawing to the size."""
        table = self.query_one(DataTable)
        if table.columns:
            others = sum(width for title, width in _COLUMNS if title != "case")
            table.ordered_columns[1].width = min(60, max(12, self.size.width - others - 2 * len(_COLUMNS) - 2))
        self.call_after_refresh(self._draw)

    @property
    def run_shown(self) -> QueuedRun | None:
        """The run under the cursor."""
        at, runs = self.query_one(DataTable).cursor_row, self._queue.runs
        return runs[at] if 0 <= at < len(runs) else None

    def follow(self) -> None:
        """Show what is new."""
        if not is_here(self) or not (table := self.query_one(DataTable)).columns:
            return  # the screen is still being laid out, or goes
        if table.row_count != len(self._queue.runs):
            at = table.cursor_row
            table.clear()
            for run in self._queue.runs:
                table.add_row(*_cells(run))
            table.move_cursor(row=min(at, table.row_count - 1))
        else:
            for number, run in enumerate(self._queue.runs):
                for column, cell in enumerate(_cells(run)):
                    table.update_cell_at((number, column), cell)  # type: ignore[arg-type]
        self._draw()

    def on_data_table_row_highlighted(self, event: DataTable.RowHighlighted) -> None:
        """Show the run under the cursor."""
        self._draw()

    def _draw(self) -> None:
        if not is_here(self):
            return
        run = self.run_shown
        state = self.query_one("#state", Static)
        self.query_one("#plots").display = run is not None and bool(run.history)
        if run is None:
            state.update(Text("no runs yet: Esc, then F5 runs the case; several wait for each other here", style="dim"))
            return
        state.update(_state(run, self.size.width - 2))
        seen = (id(run), len(run.history))
        if seen != self._drawn and run.history:
            self._drawn = seen
            for trace in self.query(Trace):
                trace.follow(run.history)

    def action_cancel(self) -> None:
        """Stop the run under the cursor.

        It keeps what it has.
        """
        if self.run_shown is not None:
            self.run_shown.cancel()
            self.follow()

    def action_go_on(self) -> None:
        """Continue a run that was stopped."""
        run = self.run_shown
        if run is None or run.state not in ("stopped", "failed", "done") or run.is_complete:
            self.notify("nothing to continue: only an unconverged run or an incomplete study can go on", timeout=3)
        elif not run.result.exists():
            self.notify(f"{run.result} does not exist: run the case again", severity="error")
        else:
            self._queue.go_on(run)
            self.follow()

    def action_result(self) -> None:
        """Look at the result, finished or not."""
        if self.run_shown is not None:
            self.app.show_result(self.run_shown.result)  # type: ignore[attr-defined]

    def action_clear(self) -> None:
        """Take ended runs off the list; their results stay."""
        for run in list(self._queue.runs):
            if run.state not in ("waiting", "running"):
                self._queue.runs.remove(run)
                run.forget()
        self.follow()


def _cells(run: QueuedRun) -> list[Text]:
    last, percent, left = run.last, run.percent, run.left_s
    if run.state == "waiting":
        bar = "waiting"
    elif run.state in ("running", "stopped"):
        bar = _bar(percent, 7) + f"{percent:4.0f}%"
    else:
        bar = run.state
    torque = ""
    if last is not None and last.friction_torque_Nmm is not None:
        torque = plus_minus(last.friction_torque_Nmm, last.friction_torque_ci_Nmm)
    if run.points is not None:
        torque = f"{run.points.done}/{run.points.points} points"
    time_left = duration(left) if run.is_active and left is not None else ""
    cells = (_MARK[run.state], run.name, bar, time_left, torque)
    return [Text(cell, no_wrap=True, overflow="ellipsis") for cell in cells]


def _bar(percent: float, width: int) -> str:
    full = round(percent / 100.0 * width * 2)
    return ("█" * (full // 2) + "▌" * (full % 2)).ljust(width, "·")


def _state(run: QueuedRun, width: int) -> Text:
    """Say where the run stands, in three lines."""
    text, last = Text(), run.last
    if run.state == "waiting":
        text.append(f"{_MARK[run.state]} {run.name}  waits for the runs above it", style="bold")
    elif run.points is not None and run.state in ("running", "stopped"):
        text.append(_bar(run.percent, max(10, width - 46)), style="bold")
        failed = f", {run.points.failed} failed" if run.points.failed else ""
        text.append(f" {run.percent:3.0f} %  {run.points.done} of {run.points.points} points{failed}")
        text.append(f"  {duration(run.left_s)} left" if run.left_s is not None and run.is_active else "")
    elif last is not None and run.state in ("running", "stopped"):
        text.append(_bar(last.percent, max(10, width - 46)), style="bold")
        text.append(
            f" {last.percent:3.0f} %  cage turn {last.cage_revolutions:.1f} of {last.cage_revolutions_wanted:.3g}"
        )
        text.append(f"  {duration(last.left_s)} left" if last.left_s is not None and run.is_active else "")
    else:
        text.append(f"{_MARK[run.state]} {run.name}  {run.state}", style="bold")
    text.append(f"\n{run.message}\n{run.result.name}", style="dim")
    if last is not None and last.energy_residual is not None:
        text.append(f"   energy residual {last.energy_residual:.1e} of input", style="dim")
    if last is not None and last.bearing_voltage_V is not None:
        low, high = last.bearing_voltage_V
        rate = last.films_broken_per_s or 0.0
        text.append(f"\nbearing {low:.1f} .. {high:.1f} V   {rate:.4g} films break per second")
    return text

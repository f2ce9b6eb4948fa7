"""Runs: the queue, and live traces of the one under the cursor."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.screen import Screen
from textual.widgets import DataTable, Footer, Static

from lambda_gui.derived import duration, grouped
from lambda_gui.plots import Plot, padded

if TYPE_CHECKING:
    from lambda_core.simulate.progress import Progress
    from lambda_gui.runs import Queue, Run

_MARK = {"waiting": "…", "running": "▶", "done": "✔", "stopped": "■", "failed": "✘"}


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
    RunScreen #state { height: 3; padding: 0 1; }
    RunScreen #plots { height: 1fr; }
    RunScreen #right { width: 1fr; }
    RunScreen.-wide DataTable { height: 10; }
    """

    def __init__(self, queue: Queue, shown: Run | None = None) -> None:
        super().__init__()
        self._queue = queue
        self._first = shown
        self._drawn: object = None

    def compose(self) -> ComposeResult:
        """Lay out queue, state and traces."""
        yield DataTable(cursor_type="row")
        yield Static(id="state")
        with Horizontal(id="plots"):
            yield Plot(id="torque")
            with Vertical(id="right"):
                yield Plot(id="cage")
                yield Plot(id="loads")
        yield Footer()

    def on_mount(self) -> None:
        """Show the queue and follow it."""
        table = self.query_one(DataTable)
        for title, width in (("", 1), ("case", 26), ("progress", 12), ("left", 7), ("M N mm", 18)):
            table.add_column(title, width=width)
        table.focus()
        self.follow()
        if self._first in self._queue.runs:
            table.move_cursor(row=self._queue.runs.index(self._first))
        self.call_after_refresh(self._draw)

    def on_resize(self) -> None:
        """Draw for the new size."""
        self._drawn = None
        self.call_after_refresh(self._draw)

    @property
    def run_shown(self) -> Run | None:
        """The run under the cursor."""
        at, runs = self.query_one(DataTable).cursor_row, self._queue.runs
        return runs[at] if 0 <= at < len(runs) else None

    def follow(self) -> None:
        """Show what is new."""
        if not self.query(DataTable) or not (table := self.query_one(DataTable)).columns:
            return  # the screen is still being laid out
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
        run = self.run_shown
        state = self.query_one("#state", Static)
        if run is None:
            state.update(Text("no runs yet: F5 in the builder runs the case", style="dim"))
            return
        state.update(_state(run, self.size.width - 2))
        seen = (id(run), len(run.history), run.state, self.size, self.app.theme)
        if seen != self._drawn and run.history:
            self._drawn = seen
            _torque(self.query_one("#torque", Plot), run.history)
            _cage(self.query_one("#cage", Plot), run.history)
            _loads(self.query_one("#loads", Plot), run.history[-1])

    def action_cancel(self) -> None:
        """Stop the run under the cursor; it keeps what it has."""
        if self.run_shown is not None:
            self.run_shown.cancel()
            self.follow()

    def action_go_on(self) -> None:
        """Continue a run that was stopped."""
        run = self.run_shown
        if run is None or run.state not in ("stopped", "failed", "done") or run.message == "converged":
            self.notify("only a run that ended before it converged can go on", timeout=3)
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


def _cells(run: Run) -> list[Text]:
    last = run.last
    percent, left = (last.percent, last.left_s) if last else (0.0, None)
    if run.state == "waiting":
        bar = "waiting"
    elif run.state in ("running", "stopped"):
        bar = _bar(percent, 7) + f"{percent:4.0f}%"
    else:
        bar = run.state
    torque = ""
    if last is not None and last.friction_torque_Nmm is not None:
        torque = grouped(last.friction_torque_Nmm)
        if last.friction_torque_ci_Nmm:
            torque += f" ± {last.friction_torque_ci_Nmm:.2g}"
    time_left = duration(left) if run.is_active and left is not None else ""
    cells = (_MARK[run.state], run.name, bar, time_left, torque)
    return [Text(cell, no_wrap=True, overflow="ellipsis") for cell in cells]


def _bar(percent: float, width: int) -> str:
    full = round(percent / 100.0 * width * 2)
    return ("█" * (full // 2) + "▌" * (full % 2)).ljust(width, "·")


def _state(run: Run, width: int) -> Text:
    """Say where the run stands, in two lines."""
    text, last = Text(no_wrap=True, overflow="ellipsis"), run.last
    if last is not None and run.state in ("running", "stopped"):
        text.append(_bar(last.percent, max(10, width - 46)), style="bold")
        text.append(
            f" {last.percent:3.0f} %  cage turn {last.cage_revolutions:.1f} of {last.cage_revolutions_wanted:.3g}"
        )
        text.append(f"  {duration(last.left_s)} left" if last.left_s is not None and run.is_active else "")
    else:
        text.append(f"{_MARK[run.state]} {run.name}  {run.state}", style="bold")
    text.append(f"\n{run.message}", style="dim")
    if last is not None and last.energy_residual is not None:
        text.append(f"   energy residual {last.energy_residual:.1e}", style="dim")
    return text.append(f"   {run.result.name}", style="dim")


def _torque(plot: Plot, history: list[Progress]) -> None:
    """Draw the friction torque, its mean and the band of its confidence."""
    plot.clear("friction torque, N mm")
    now = [(p.cage_revolutions, p.friction_torque_now_Nmm) for p in history if p.friction_torque_now_Nmm is not None]
    mean = [(p.cage_revolutions, p.friction_torque_Nmm) for p in history if p.friction_torque_Nmm is not None]
    if not now or not mean:
        return
    banded = [p for p in history if p.friction_torque_ci_Nmm is not None and p.friction_torque_Nmm is not None]
    edges = [
        [(p.cage_revolutions, p.friction_torque_Nmm + sign * p.friction_torque_ci_Nmm) for p in banded]  # type: ignore[operator]
        for sign in (-1.0, 1.0)
    ]
    for points, colour, label in (
        (now, "secondary", "now"),
        *((edge, "accent", "") for edge in edges),
        (mean, "primary", "mean"),
    ):
        if points:
            plot.plt.plot(*zip(*points, strict=True), color=plot.colour(colour), marker="braille", label=label or None)
    values = [y for points in (now, mean, *edges) for _, y in points]
    low, high = padded(min(values), max(values), 0.02 * abs(mean[-1][1]))
    plot.ticks(low, high, "y", max(2, plot.size.height // 4))
    plot.ticks(0.0, max(history[-1].cage_revolutions_wanted, now[-1][0]), "x", max(2, plot.size.width // 12))
    plot.plt.xlabel("cage revolutions")
    plot.refresh()


def _cage(plot: Plot, history: list[Progress]) -> None:
    """Draw cage speed over inner ring speed."""
    points = [(p.cage_revolutions, p.cage_speed_ratio) for p in history if p.cage_speed_ratio is not None]
    plot.clear("cage speed over inner ring speed")
    if not points:
        return
    plot.plt.plot(*zip(*points, strict=True), color=plot.colour("success"), marker="braille")
    ratios = [y for _, y in points]
    plot.ticks(*padded(min(ratios), max(ratios), 0.004), "y", max(2, plot.size.height // 4))
    plot.ticks(0.0, max(history[-1].cage_revolutions_wanted, points[-1][0]), "x", max(2, plot.size.width // 12))
    plot.refresh()


def _loads(plot: Plot, last: Progress) -> None:
    """Draw the load of each ball on the inner ring now."""
    plot.clear("ball loads on the inner ring now, N")
    loads = list(last.inner_loads_N)
    if not loads:
        return
    balls = [float(ball) for ball in range(1, len(loads) + 1)]
    plot.plt.bar(balls, loads, color=plot.colour("accent"), marker="sd", width=0.6)
    plot.plt.xticks(balls, [f"{ball:.0f}" for ball in balls])
    plot.ticks(0.0, 1.05 * max(*loads, 1.0), "y", max(2, plot.size.height // 4))
    plot.refresh()

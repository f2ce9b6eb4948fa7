"""Open a row into further rows."""

from __future__ import annotations

from collections.abc import Iterator

from textual.app import ComposeResult
from textual.containers import Vertical
from textual.widget import Widget

from lambda_gui.rows import Edited, Row


class Branch(Row):
    """A row whose choice decides which rows follow under it."""

    _shape: object = None

    DEFAULT_CSS = """
    Branch > .twigs { height: auto; width: 1fr; }
    Branch > .line > Choice { width: 1fr; }
    """

    def compose(self) -> ComposeResult:
        """Lay out the head and the rows under it."""
        yield from super().compose()
        with Vertical(classes="twigs"):
            yield from self.twigs()

    def twigs(self) -> Iterator[Widget]:
        """Yield the rows that follow for what is written now."""
        raise NotImplementedError

    def shape(self) -> object:
        """Return what decides the next rows.

        They are made anew when it changes.
        """
        raise NotImplementedError

    def on_mount(self) -> None:
        """Show what is written."""
        self._shape = self.shape()
        super().on_mount()

    def show(self) -> None:
        """Show the written values.

        Other rows are made anew.
        """
        self.mark()
        if self.shape() != self._shape:
            self.grow()
            return
        for row in self.query(".twigs > Row").results(Row):
            row.reload()

    def grow(self) -> None:
        """Make the rows under the head anew."""
        self._shape = self.shape()
        below = self.query_one(".twigs", Vertical)
        for row in below.query(Row):
            row.stands = False  # it goes: whoever finds it meanwhile shall leave it alone
        with self.app.batch_update():
            below.remove_children()
            below.mount(*self.twigs())
        for row in self.query(".twigs > Row").results(Row):
            row.fit(self._width)

    def fit(self, width: int, *, short: bool = False) -> None:
        """Give the labels under the head the same room too."""
        super().fit(width, short=short)
        for row in self.query(".twigs > Row").results(Row):
            row.fit(width, short=short)

    def on_edited(self, event: Edited) -> None:
        """Mark the head too when a row under it changes."""
        if event.keys != self.place.keys:
            self.mark()

"""Show the help of one option or node."""

from __future__ import annotations

from rich.text import Text
from textual.widgets import Static


class OptionHelp(Static):
    """Help that fits its room.

    F1 shows the rest, and the last line refers to it.
    """

    DEFAULT_CSS = """
    OptionHelp { width: 1fr; padding: 0 1; color: $text-muted; }
    """

    _about = Text()

    def show(self, about: Text) -> None:
        """Show the help of an option or a node."""
        self._about = about
        self._draw()

    def on_resize(self) -> None:
        """Fit the help to the new size."""
        self._draw()

    def _draw(self) -> None:
        width, height = self.size
        if width < 2 or height < 2:
            return
        lines = self._about.wrap(self.app.console, width)
        if len(lines) > height:
            rest = Text("F1 shows the rest", style="dim italic")
            lines = [*lines[: height - 1], rest]  # type: ignore[assignment]
        self.update(Text("\n").join(lines))

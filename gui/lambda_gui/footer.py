"""Show the keys of a screen in its last line."""

from __future__ import annotations

from textual.app import ComposeResult
from textual.widgets import Footer


class KeyLine(Footer):
    """Last line of a screen.

    It is built anew with every change of the keys. Textual makes each key compact at first, takes that back, and looks
    for its styles both times: half of the work. Here each begins as the line wants it.
    """

    def compose(self) -> ComposeResult:
        """Build the keys."""
        for widget in super().compose():
            compact = getattr(type(widget), "compact", None)
            if compact is not None and not widget.has_class("-command-palette"):  # that one is always compact
                widget.set_reactive(compact, self.compact)
            yield widget

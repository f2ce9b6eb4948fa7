"""Whether a screen is there: threads, timers and helpers also come back while it is taken down."""

from __future__ import annotations

from typing import Any

from textual.screen import Screen


def is_here(screen: Screen[Any]) -> bool:
    """Tell whether there is anything to show on."""
    return screen.app.is_running and screen.is_attached and screen in screen.app.screen_stack and bool(screen.children)

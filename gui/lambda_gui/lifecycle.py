"""Guard callbacks that arrive after a screen was closed.

Threads, timers and helper processes may call back while a screen is taken down.
"""

from __future__ import annotations

from typing import Any

from textual.screen import Screen


def is_here(screen: Screen[Any]) -> bool:
    """Tell whether there is anything to show on."""
    return screen.app.is_running and screen.is_attached and screen in screen.app.screen_stack and bool(screen.children)

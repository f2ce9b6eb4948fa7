"""Define colours, dark and light."""

from __future__ import annotations

from textual.theme import Theme

DARK = Theme(
    name="lambda-dark",
    primary="#6cb2eb",
    secondary="#8fa6bf",
    accent="#f0a95b",
    warning="#e8c05a",
    error="#f07a6a",
    success="#8ccf8f",
    foreground="#d8dee6",
    background="#10141a",
    surface="#161c24",
    panel="#202936",
    dark=True,
    variables={
        "block-cursor-background": "#2b4a6b",
        "block-cursor-foreground": "#ffffff",
        "block-cursor-text-style": "none",
        "block-cursor-blurred-background": "#212c3a",
        "block-cursor-blurred-text-style": "none",
        "footer-key-foreground": "#f0a95b",
        "input-cursor-background": "#f0a95b",
        "input-selection-background": "#2b4a6b",
        "border": "#6cb2eb",
        "border-blurred": "#2a3544",
        "scrollbar": "#2f3b4b",
        "scrollbar-hover": "#44566d",
        "scrollbar-active": "#6cb2eb",
        "scrollbar-background": "#141a21",
        "scrollbar-corner-color": "#141a21",
    },
)

LIGHT = Theme(
    name="lambda-light",
    primary="#1f6aa5",
    secondary="#5a6b7d",
    accent="#9c4a08",
    warning="#7a5507",
    error="#b3261e",
    success="#23683f",
    foreground="#1d2530",
    background="#f4f5f2",
    surface="#ffffff",
    panel="#e4e8ec",
    dark=False,
    variables={
        "block-cursor-background": "#cfe3f5",
        "block-cursor-foreground": "#10202f",
        "block-cursor-text-style": "none",
        "block-cursor-blurred-background": "#e2e9ef",
        "block-cursor-blurred-text-style": "none",
        "footer-key-foreground": "#9c4a08",
        "input-cursor-background": "#9c4a08",
        "input-selection-background": "#cfe3f5",
        "border": "#1f6aa5",
        "border-blurred": "#c3ccd5",
        "scrollbar": "#c3ccd5",
        "scrollbar-hover": "#9fb0c0",
        "scrollbar-active": "#1f6aa5",
        "scrollbar-background": "#eceeea",
        "scrollbar-corner-color": "#eceeea",
    },
)

"""Print pictures into terminals with kitty's graphics or sixel."""

from __future__ import annotations

import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from lambda_core.domain.errors import UsageError


def picture_kind() -> Any:
    """Return what prints a picture file in this terminal.

    Raises
    ------
    UsageError
        When the package is missing, or the terminal cannot show pictures, with what to do instead.
    """
    if find_spec("textual_image") is None:
        raise UsageError('pictures in the terminal need another package: pip install "lambda-bearing[pictures]"')
    from textual_image import renderable

    can = (renderable.SixelImage, renderable.TGPImage)
    if not sys.stdout.isatty() or renderable.Image not in can:
        raise UsageError(
            "this terminal shows no pictures (it has neither kitty's graphics nor sixel): leave --show out for files; "
            "lambda-bearing gui draws them as text"
        )
    return renderable.Image


def check_overlay(measured: Path | None, draw: Path | None) -> None:
    """Refuse measured points where no picture is drawn; UsageError."""
    if measured is not None and draw is None:
        raise UsageError("--measured needs a picture: add --draw DIR")


def print_picture(path: Path, kind: Any) -> None:
    """Print a picture, as wide as the terminal."""
    from rich.console import Console

    Console().print(kind(path, width="100%", height="auto"))

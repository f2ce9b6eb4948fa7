"""Show pictures in terminals with kitty's graphics or sixel.

Other terminals get text charts.
"""

from __future__ import annotations

import sys
from importlib.util import find_spec
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from textual.widget import Widget

NONE_HERE = (
    "this terminal shows no pictures: it takes kitty's graphics or sixel, and the package of lambda-bearing[pictures]"
)


def picture_widget() -> type[Widget] | None:
    """Return the widget of a picture file.

    None where this terminal shows text charts only.

    The terminal is asked what it can do, which has to be done before the builder reads from it. A pipe is never asked,
    nor is a browser's page.
    """
    if find_spec("textual_image") is None or sys.__stdout__ is None or not sys.__stdout__.isatty():
        return None
    from textual_image import renderable

    if renderable.Image not in (renderable.SixelImage, renderable.TGPImage):
        return None
    from textual_image.widget import Image

    return Image

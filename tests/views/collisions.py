"""Find texts of a figure that overlap."""

from __future__ import annotations

from itertools import combinations
from typing import Any

from lambda_core.discovery.manager import registry
from lambda_core.views.chart import ViewData


def boxes(figure: Any) -> dict[str, Any]:
    """Return the boxes of texts and panels.

    Titles, labels and legends of every panel, and the lines around the panels.
    """
    found = {f"text {text.get_text()!r}": text.get_window_extent() for text in figure.texts}
    for number, axes in enumerate(figure.axes):
        parts = {"title": axes._left_title, "x": axes.xaxis.label, "y": axes.yaxis.label, "legend": axes.get_legend()}
        for name, part in parts.items():
            if part is not None and (name == "legend" or part.get_text()):
                found[f"{name} of panel {number}"] = part.get_window_extent()
    return found


def collisions(figure: Any) -> list[str]:
    """Draw a figure, return overlapping texts.

    Pairs that overlap by more than a pixel.
    """
    figure.canvas.draw()
    clashes = []
    for (one, a), (other, b) in combinations(boxes(figure).items(), 2):
        wide = min(a.x1, b.x1) - max(a.x0, b.x0)
        high = min(a.y1, b.y1) - max(a.y0, b.y0)
        if wide > 1.0 and high > 1.0:
            clashes.append(f"{one} and {other}")
    return clashes


def no_collision(data: ViewData) -> None:
    assert not collisions(registry().figure(registry().view(data.view), data))

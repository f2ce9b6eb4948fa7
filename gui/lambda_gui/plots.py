"""Plot in the terminal, in the colours of the theme."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from textual.color import Color
from textual_plotext import PlotextPlot

if TYPE_CHECKING:
    pass


Colour = tuple[int, int, int]
_MOST_TICKS = 8  # tried to find two round numbers within narrow limits
CYCLE = ("primary", "accent", "success", "error", "warning", "secondary")


class Plot(PlotextPlot):
    """Plot that `fill` draws.

    It draws again whenever size or theme change.
    """

    DEFAULT_CSS = """
    Plot { background: $background; }
    """

    words: list[str] = []  # noqa: RUF012 - title, axis and names of series; each drawing has its own

    def clear(self, title: str = "") -> None:
        """Begin anew."""
        self.plt.clear_figure()
        self.plt.title(title)
        self.words = [title]

    def name_x(self, name: str) -> None:
        """Write the name of the horizontal axis."""
        self.plt.xlabel(name)
        self.words.append(name)

    def colour(self, name: str) -> Colour:
        """Return a colour of the theme."""
        return Color.parse(self.app.theme_variables[name]).rgb

    def cycle(self, number: int) -> Colour:
        """Return the colour of the n-th series."""
        return Color.parse(series_colour(self.app.theme_variables, number)).rgb

    def ticks(self, low: float, high: float, axis: str, wanted: int) -> None:
        """Put round numbers along an axis."""
        places = round_numbers(low, high, wanted)
        labels = labels_of(places)
        if axis == "x":
            self.plt.xlim(low, high)
            self.plt.xticks(places, labels)
        else:
            self.plt.ylim(low, high)
            self.plt.yticks(places, labels)


def series_colour(colours: Mapping[str, str], number: int) -> str:
    """Return the colour of a series.

    It is the n-th as #rrggbb; colours after the first six are paler.
    """
    colour = Color.parse(colours[CYCLE[number % len(CYCLE)]])
    back = Color.parse(colours["background"])
    return colour.blend(back, min(0.7, 0.45 * (number // len(CYCLE)))).hex[:7]


def round_numbers(low: float, high: float, wanted: int) -> list[float]:
    """Return about `wanted` round numbers between two."""
    if not (math.isfinite(low) and math.isfinite(high)) or high <= low:
        return [low] if math.isfinite(low) else []
    rough = (high - low) / max(wanted, 1)
    power = 10.0 ** math.floor(math.log10(rough))
    step = next((power * factor for factor in (1.0, 2.0, 2.5, 5.0, 10.0) if power * factor >= rough), 10.0 * power)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    if last <= first and wanted < _MOST_TICKS:  # one number tells no scale
        return round_numbers(low, high, wanted + 1)
    return [step * number for number in range(first, last + 1)]


def labels_of(places: Sequence[float]) -> list[str]:
    """Write ticks with few digits.

    They tell them apart, and all have as many decimals.
    """
    for digits in range(2, 8):
        labels = [f"{place:.{digits}g}" for place in places]
        if len(set(labels)) == len(labels) and all(
            math.isclose(float(label), place, rel_tol=1e-6, abs_tol=1e-12)
            for label, place in zip(labels, places, strict=True)
        ):
            break
    else:
        labels = [f"{place:g}" for place in places]
    plain = [_plain(label) for label in labels]
    decimals = max((len(label.partition(".")[2]) for label in plain), default=0)
    return plain if any("e" in label for label in plain) else [f"{float(label):.{decimals}f}" for label in plain]


def _plain(label: str) -> str:
    """Write 1.5e+03 as 1500."""
    value = float(label)
    return f"{value:.10g}" if "e" in label and 1e-3 <= abs(value) < 1e6 else label


def padded(low: float, high: float, least: float = 0.0) -> tuple[float, float]:
    """Return a range wider than the data's.

    It is a little wider, at least `least` wide.
    """
    if not (math.isfinite(low) and math.isfinite(high)):
        return 0.0, 1.0
    width = max(high - low, least, 1e-9 * max(abs(low), abs(high)), 1e-30)
    middle = 0.5 * (low + high)
    return middle - 0.55 * width, middle + 0.55 * width

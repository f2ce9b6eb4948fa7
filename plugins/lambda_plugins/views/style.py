"""Define the style of all views.

It has colours that differ in greyscale too, dashes, markers and type.

Every role of a series (inner ring, outer ring, cage ...) looks the same in every view. The colours are stepped in
lightness and paired with dashes, markers and hatches, so that a black and white print tells them apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

INK = "#1a1a1a"
SOFT = "#5c5c5c"
GRID = "#d9d9d9"

RC: Any = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 12.0,
    "text.usetex": False,  # whatever matplotlibrc says: texts of strangers are not handed to another program
    "axes.titlesize": 12.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 8.0,
    "axes.labelsize": 12.0,
    "axes.edgecolor": SOFT,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-3, 5),
    "axes.formatter.use_mathtext": True,
    "axes.xmargin": 0.02,
    "axes.ymargin": 0.08,
    "grid.color": GRID,
    "grid.linewidth": 0.7,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 11.0,
    "ytick.labelsize": 11.0,
    "legend.fontsize": 10.5,
    "legend.frameon": True,
    "legend.framealpha": 0.9,
    "legend.edgecolor": "none",
    "legend.borderpad": 0.3,
    "legend.handlelength": 2.6,
    "lines.linewidth": 1.9,
    "lines.markersize": 6.5,
    "hatch.linewidth": 0.7,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "svg.fonttype": "path",
    "path.simplify": True,
    "path.simplify_threshold": 0.4,
}


@dataclass(frozen=True)
class Look:
    """One series: colour, dash pattern, marker, hatch of its bars."""

    colour: str
    dash: Any = "-"
    marker: str = "o"
    filled: bool = True
    hatch: str = ""
    width: float = 1.9


ROLES: dict[str, Look] = {
    "inner": Look("#17408b", "-", "o", True, ""),
    "outer": Look("#e5842c", (0, (5, 1.6)), "s", False, "//"),
    "cage": Look("#2f8f5b", (0, (6, 1.5, 1.5, 1.5)), "^", True, ".."),
    "ball": Look("#6b3fa0", "-", "D", True, "xx"),
    "total": Look("#1a1a1a", "-", "o", True, "", 2.3),
    "reference": Look("#9a9a9a", "-", "o", True, "", 1.1),
    "measured": Look("#b5533c", "-", "X", True, "", 1.1),
}

# For series without a role, in turn: dark and light alternate.
CYCLE: tuple[Look, ...] = (
    Look("#17408b", "-", "o", True, ""),
    Look("#f0a04b", (0, (5, 1.6)), "s", True, "//"),
    Look("#8c2d5f", (0, (6, 1.5, 1.5, 1.5)), "^", True, "\\\\"),
    Look("#74b9a5", (0, (1.4, 1.4)), "D", True, ".."),
    Look("#3c3c3c", (0, (9, 2)), "v", True, "xx"),
    Look("#c9c34a", (0, (3, 1, 1, 1, 1, 1)), "P", True, "++"),
    Look("#b5533c", (0, (7, 1)), "<", True, "oo"),
    Look("#8ea9e8", (0, (2, 2)), "X", True, "--"),
    Look("#dcdcdc", "-", ">", True, "||"),
)

COLOUR_MAP = "viridis"  # lightness rises evenly: readable in greyscale
SIGNED_MAP = "RdBu_r"


def look_of(role: str, position: int) -> Look:
    """Return the look of a series.

    It is that of its role, or the next of the cycle.
    """
    return ROLES.get(role) or CYCLE[position % len(CYCLE)]

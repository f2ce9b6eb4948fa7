"""Diameters of shoulders: the case's, the catalogue's, or by the mean height of the kind."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.model.geometry.resolve_geometry import Picker

# Shoulder diameters differ by 1.21 ball diameters: mean of catalogue shoulders, the same figure from
# which missing inner geometry is derived.
SHOULDER_SPREAD = 1.21
# Height of the high shoulder over the raceway in ball diameters: means of SKF's 72 BE and 73 BE in the catalogue
# (0.29 to 0.33 and 0.28 to 0.34); a test computes them anew.
HIGH_SHOULDERS = {"inner": 0.316, "outer": 0.309}
# The same of SKF's QJ: inner rings of those without a recess in their shoulders, outer rings of all; likewise tested.
FOUR_POINT_SHOULDERS = {"inner": 0.247, "outer": 0.240}
# The same of SKF's self-aligning bearings: inner rings, whose printed shoulder is the one on the loaded side.
ALIGNING_SHOULDERS = {"inner": 0.13}
_WHOSE = {
    id(FOUR_POINT_SHOULDERS): ("shoulders", "the mean of SKF's QJ"),
    id(HIGH_SHOULDERS): ("high shoulder", "the mean of SKF's 72 and 73 BE; the low one is not in the model"),
    id(ALIGNING_SHOULDERS): ("shoulder", "the mean of SKF's self-aligning ball bearings"),
}


def shoulder(picker: Picker, ring: str, ball: float, pitch: float, heights: Mapping[str, float] | None) -> float:
    """Return the diameter of a ring's shoulder; of angular contact that of the high one, which carries the load.

    Where it is not known it follows from the mean height of its kind; None: deep groove.
    """
    name = f"shoulder_diameter_{ring}"
    diameter = picker.take(name)
    sign = -1.0 if ring == "inner" else 1.0
    if diameter is None and heights is not None:
        height = heights[ring]
        diameter = pitch + sign * (1.0 - 2.0 * height) * ball
        what, whose = _WHOSE[id(heights)]
        text = f"{what} {height:g} D_w over the raceway"
        picker.ledger.record(f"bearing.{name}", diameter, "length", text, "assumed")
        picker.ledger.assume(f"{ring} ring: {text}, {whose}")
    elif diameter is None:
        diameter = pitch + sign * 0.5 * SHOULDER_SPREAD * ball
        picker.ledger.record(f"bearing.{name}", diameter, "length", "pitch -+ 0.605 D_w", "assumed")
        picker.ledger.assume("shoulder diameters: pitch diameter -+ 0.605 D_w, the mean of catalogue shoulders")
    return diameter

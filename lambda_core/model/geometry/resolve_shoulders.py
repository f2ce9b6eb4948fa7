"""Resolve the shoulder diameters of the raceways."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.elements.ball.ball_kind import Shoulders
    from lambda_core.model.geometry.resolve_geometry import Picker

# Shoulder diameters differ by 1.21 ball diameters: mean of catalogue shoulders, the same figure from
# which missing inner geometry is derived.
SHOULDER_SPREAD = 1.21


def shoulder(picker: Picker, ring: str, ball: float, pitch: float, known: Shoulders | None) -> float:
    """Return the diameter of a ring's shoulder.

    An angular contact bearing has a high shoulder that carries the load; its diameter counts.

    Where it is not known it follows from the mean height of its kind; None: deep groove.
    """
    name = f"shoulder_diameter_{ring}"
    diameter = picker.take(name)
    sign = -1.0 if ring == "inner" else 1.0
    if diameter is None and known is not None:
        height = known.heights[ring]
        diameter = pitch + sign * (1.0 - 2.0 * height) * ball
        text = f"{known.what} {height:g} D_w over the raceway"
        picker.ledger.record(f"bearing.{name}", diameter, "length", text, "assumed")
        picker.ledger.assume(f"{ring} ring: {text}, {known.whose}")
    elif diameter is None:
        diameter = pitch + sign * 0.5 * SHOULDER_SPREAD * ball
        picker.ledger.record(f"bearing.{name}", diameter, "length", "pitch -+ 0.605 D_w", "assumed")
        picker.ledger.assume("shoulder diameters: pitch diameter -+ 0.605 D_w, the mean of catalogue shoulders")
    return diameter

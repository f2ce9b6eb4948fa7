"""Draw a bearing from two sides with its load.

Lengths are in mm: x along the shaft, y across it, z up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.plugins import Arrows, Axis, Panel, Series

_AROUND = np.linspace(0.0, 2.0 * np.pi, 49)
_STEPS = (5.0, 2.0, 1.0)  # of a power of ten, by which displacements are enlarged


@dataclass(frozen=True)
class Sizes:
    """Sizes of a bearing [mm].

    Diameters of bore, outside, pitch circle, raceways and rolling elements; width, length of the elements (0: balls),
    and places of the rows along the shaft.
    """

    bore: float
    outside: float
    pitch: float
    races: tuple[float, float]
    element: float
    width: float
    length: float
    rows: tuple[float, ...]

    @classmethod
    def of(cls, model: Any) -> Sizes:
        """Return the sizes of a resolved bearing."""
        rows: tuple[float, ...] = (0.0,)
        rollers = getattr(model, "rollers", None) or getattr(model, "bearing", None)
        if rollers is not None:
            bore, outside, width = rollers.bore, rollers.outside, rollers.width
            pitch, element, length = rollers.pitch_diameter, rollers.diameter, rollers.length
            races = pitch - element, pitch + element
        else:
            g = model.geometry
            bore, outside, width = g.bore_diameter, g.outside_diameter, g.width
            pitch, element, length = g.pitch_diameter, g.ball_diameter, 0.0
            races = g.race_diameter_inner, g.race_diameter_outer
            if g.rows == 2:
                rows = (-0.5 * g.row_distance, 0.5 * g.row_distance)
        return cls(
            1e3 * bore, 1e3 * outside, 1e3 * pitch, (1e3 * races[0], 1e3 * races[1]), 1e3 * element, 1e3 * width,
            1e3 * length, tuple(1e3 * row for row in rows),
        )  # fmt: skip


def enlarged(displacement: Sequence[float], reach: float) -> tuple[list[float], float]:
    """Return a displacement that can be seen, and its factor.

    Parameters
    ----------
    displacement : sequence of float
        x, y, z [um].
    reach : float
        Its largest length in the picture [mm].
    """
    size = 1e-3 * math.hypot(*displacement)
    if size == 0.0:
        return [0.0, 0.0, 0.0], 1.0
    power = 10.0 ** math.floor(math.log10(reach / size))
    factor = max(1.0, next(step * power for step in _STEPS if step * power * size <= reach))
    return [1e-3 * factor * value for value in displacement], factor


def carried(contacts: Sequence[Any]) -> np.ndarray:
    """Return the load of the inner ring on every contact.

    Shape (contacts, 3): along x, y and z [N]. It points from the inner ring to the rolling element.
    """
    load, angle, azimuth = (
        np.array([getattr(one, name) for one in contacts]) for name in ("load_N", "contact_angle_deg", "azimuth_deg")
    )
    angle, azimuth = np.radians(angle), np.radians(azimuth)
    across = load * np.cos(angle)
    found: np.ndarray = np.column_stack([load * np.sin(angle), across * np.cos(azimuth), across * np.sin(azimuth)])
    return found


def from_the_side(title: str, sizes: Sizes, found: Any, moved: Sequence[float]) -> Panel:
    """Draw a bearing's section with its load."""
    outer, inner, elements = [], [], []
    half = 0.5 * sizes.width
    for side in (1.0, -1.0):
        outer.append(box(-half, half, *sorted((side * 0.5 * sizes.outside, side * 0.5 * sizes.races[1]))))
        low, high = sorted((side * 0.5 * sizes.races[0], side * 0.5 * sizes.bore))
        inner.append(box(-half + moved[0], half + moved[0], low + moved[2], high + moved[2]))
        elements += [_element(sizes, row, side * 0.5 * sizes.pitch) for row in sizes.rows]
    x, _, z = carried([one for one in found.contacts if one.ring == "inner"]).sum(axis=0)
    arrows = Arrows("load on the inner ring", "N", np.array([moved[0]]), np.array([moved[2]]), np.array([x]),
                    np.array([z]))  # fmt: skip
    series = (
        outline("outer ring", outer, "outer"),
        outline("inner ring", inner, "inner"),
        outline("rollers" if sizes.length else "balls", elements, "ball"),
    )
    return Panel(title, Axis("x", "mm"), Axis("z", "mm"), series, arrows=arrows, shape="plane")


def against_the_shaft(title: str, sizes: Sizes, found: Any, moved: Sequence[float]) -> Panel:
    """Draw rings and rolling elements with their loads."""
    contacts = [one for one in found.contacts if one.ring == "inner"]
    azimuths = np.radians([one.azimuth_deg for one in contacts])
    y, z = 0.5 * sizes.pitch * np.cos(azimuths), 0.5 * sizes.pitch * np.sin(azimuths)
    loads = carried(contacts)
    arrows = Arrows("load of the inner ring", "N", y, z, loads[:, 1], loads[:, 2])
    series = (
        outline("outer ring", [_circle(0.0, 0.0, d) for d in (sizes.outside, sizes.races[1])], "outer"),
        outline("inner ring", [_circle(moved[1], moved[2], d) for d in (sizes.races[0], sizes.bore)], "inner"),
        outline("rollers" if sizes.length else "balls",
                [_circle(*at, sizes.element) for at in zip(y.tolist(), z.tolist(), strict=True)], "ball"),
    )  # fmt: skip
    return Panel(title, Axis("y", "mm"), Axis("z", "mm"), series, arrows=arrows, shape="plane")


def _element(sizes: Sizes, x: float, z: float) -> list[tuple[float, float]]:
    if not sizes.length:
        return _circle(x, z, sizes.element)
    half, radius = 0.5 * sizes.length, 0.5 * sizes.element
    return box(x - half, x + half, z - radius, z + radius)


def _circle(x: float, y: float, diameter: float) -> list[tuple[float, float]]:
    places = np.column_stack([x + 0.5 * diameter * np.cos(_AROUND), y + 0.5 * diameter * np.sin(_AROUND)])
    return [(float(a), float(b)) for a, b in places]


def box(left: float, right: float, low: float, high: float) -> list[tuple[float, float]]:
    """Return the corners of a rectangle, the first one twice."""
    return [(left, low), (left, high), (right, high), (right, low), (left, low)]


def outline(name: str, boxes: list[list[tuple[float, float]]], role: str) -> Series:
    """Return outlines as one line, broken between them."""
    points = np.array([point for box in boxes for point in [*box, (np.nan, np.nan)]])
    return Series(name, points[:, 0], points[:, 1], "line", role)

"""Define charts as plain data with units.

A chart is drawn as a figure, in a terminal, or written as JSON.

A chart is a few panels; a panel has two axes and what stands in them: lines, points, bars, marks and at most
one field of values. Nothing here knows how it will be drawn.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any, Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray

Kind = Literal["line", "points", "bars", "area"]
Shape = Literal["plain", "polar", "plane"]


@dataclass(frozen=True)
class Axis:
    """One axis: what it shows, in which unit.

    Attributes
    ----------
    label, unit : str
        What is shown; its unit, "" for plain numbers.
    log : bool
        Logarithmic.
    low, high : float, optional
        Ends of the axis; by the data where None.
    least : float
        Smallest range that is shown: rounding errors of a constant are not blown up.
    categories : tuple of str
        Names of the places 0, 1, 2 ... of a discrete axis.
    ticks : tuple of float
        Where numbers stand; chosen by the drawing where empty.
    """

    label: str
    unit: str = ""
    log: bool = False
    low: float | None = None
    high: float | None = None
    least: float = 0.0
    categories: tuple[str, ...] = ()
    ticks: tuple[float, ...] = ()

    @property
    def text(self) -> str:
        """Label with its unit in brackets."""
        return f"{self.label} [{self.unit}]" if self.unit else self.label


@dataclass(frozen=True)
class Series:
    """Values over a common axis; NaN where there is nothing.

    Attributes
    ----------
    name : str
        What it is; its entry in the legend unless `unlisted`.
    x, y : float64[:], shape (n,)
    kind : str
        ``line``, ``points``, ``bars`` (side by side, or stacked when the panel says so), ``area`` (stacked).
    role : str
        What it stands for: ``inner``, ``outer``, ``cage``, ``ball``, ``total``, ``reference``, ``measured``; equal
        roles look alike in every view. "" for anything else.
    low, high : float64[:], shape (n,), optional
        Band around `y`: a spread or a confidence interval, as `band` says.
    band : str
        What the band is.
    """

    name: str
    x: FloatArray
    y: FloatArray
    kind: Kind = "line"
    role: str = ""
    low: FloatArray | None = None
    high: FloatArray | None = None
    band: str = ""
    group: int | None = None  # equal numbers look alike in every panel; None gives each series its own look
    unlisted: bool = False  # no entry in the legend

    def __post_init__(self) -> None:
        shapes = {np.shape(a) for a in (self.x, self.y, self.low, self.high) if a is not None}
        if len(shapes) != 1 or len(next(iter(shapes))) != 1:
            raise ValueError(f"series {self.name!r}: x, y, low and high are not of one length: {sorted(shapes)}")


@dataclass(frozen=True)
class Mark:
    """Labelled straight line across a panel.

    It stands at one value of one axis.

    Attributes
    ----------
    label : str
        Text next to it.
    value : float
        Where it is, in the axis' unit.
    axis : str
        ``x`` or ``y``.
    """

    label: str
    value: float
    axis: Literal["x", "y"] = "y"


@dataclass(frozen=True)
class Field:
    """Values on a structured mesh.

    Attributes
    ----------
    name, unit : str
        What the values are, and their unit.
    x, y, values : float64[:, :], equal shapes
        Places of the values in the units of the axes; NaN where there is nothing.
    lines : float64[:, :], optional
        A second quantity on the mesh whose zero is drawn as a line.
    line_name : str
        Label of that line.
    levels : tuple of float
        Values at which contour lines are drawn.
    signed : bool
        Zero is the middle of the colours.
    log : bool
        Colours by the logarithm.
    """

    name: str
    unit: str
    x: FloatArray
    y: FloatArray
    values: FloatArray
    lines: FloatArray | None = None
    line_name: str = ""
    levels: tuple[float, ...] = ()
    signed: bool = False
    log: bool = False

    def __post_init__(self) -> None:
        shapes = {np.shape(a) for a in (self.x, self.y, self.values, self.lines) if a is not None}
        if len(shapes) != 1 or len(next(iter(shapes))) != 2:
            raise ValueError(f"field {self.name!r}: x, y and values are not on one mesh: {sorted(shapes)}")

    @property
    def text(self) -> str:
        """Name with its unit in brackets."""
        return f"{self.name} [{self.unit}]" if self.unit else self.name


@dataclass(frozen=True)
class Arrows:
    """Vectors at places of a panel.

    Attributes
    ----------
    name, unit : str
        What the vectors are, and their unit.
    x, y : float64[:], shape (n,)
        Places, in the units of the axes.
    u, v : float64[:], shape (n,)
        Components along x and y, in `unit`.
    """

    name: str
    unit: str
    x: FloatArray
    y: FloatArray
    u: FloatArray
    v: FloatArray


@dataclass(frozen=True)
class Panel:
    """Two axes and what stands in them.

    Attributes
    ----------
    x, y : Axis
        The two axes.
    series, marks : tuple of Series, tuple of Mark
        Lines, points, bars and areas; labelled lines across.
    field, arrows : Field or None, Arrows or None
        At most one field of values; vectors on it.
    shape : str
        ``plain``; ``polar``: x is an angle in degrees, counted from the right, counter-clockwise, y the radius;
        ``plane``: both axes are lengths and drawn to one scale.
    stacked : bool
        Bars and areas are put on top of each other.
    """

    title: str
    x: Axis
    y: Axis
    series: tuple[Series, ...] = ()
    marks: tuple[Mark, ...] = ()
    field: Field | None = None
    arrows: Arrows | None = None
    shape: Shape = "plain"
    stacked: bool = False


@dataclass(frozen=True)
class ViewData:
    """Data of one view.

    Attributes
    ----------
    view : str
        Name of the view.
    title, source : str
        What is shown; of which run or study.
    panels : tuple of Panel
    columns : int
        Panels side by side.
    notes : tuple of str
        What one has to know to read it: how averaged, over which window, what was left out.
    """

    view: str
    title: str
    source: str
    panels: tuple[Panel, ...]
    columns: int = 1
    notes: tuple[str, ...] = field(default=())

    def as_dict(self) -> dict[str, Any]:
        """Return plain data for JSON.

        Numbers that do not exist are null.
        """
        found = plain(self)
        assert isinstance(found, dict)
        return {"version": 1, **found}


def plain(value: Any) -> Any:
    """Return dataclasses and arrays as JSON values.

    NaN and infinity become None, and empty entries are left out.
    """
    if is_dataclass(value) and not isinstance(value, type):
        found = {f.name: getattr(value, f.name) for f in fields(value)}
        return {name: plain(item) for name, item in found.items() if not _empty(item)}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value


def _empty(value: Any) -> bool:
    return value is None or value is False or (isinstance(value, str | tuple) and not value)

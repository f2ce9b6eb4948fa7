"""Define the table of a study."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.domain.number_text import NONE, rounded
from lambda_core.domain.unit_systems import SI, UnitSystem

Cell = float | str | None
BAND = "_band"  # ends the name of a column of bands
PointState = Literal["pending", "done", "partial", "failed"]


@dataclass(frozen=True)
class Column:
    """One parameter or response.

    Attributes
    ----------
    name : str
        Path of the parameter in the case, or name of the response.
    unit : str
        "" for plain numbers and names.
    meaning : str
        One line for people.
    values : tuple
        One per row: a number, a name (of a law, say), or None where there is none.
    band : tuple of tuple
        Both ends of the 90 % model band of each row, None where there is none; empty without bands.
    """

    name: str
    unit: str
    meaning: str
    values: tuple[Cell, ...]
    band: tuple[tuple[float, float] | None, ...] = ()

    @property
    def numeric(self) -> bool:
        """True if every existing value is a number."""
        return not any(isinstance(value, str) for value in self.values)

    @property
    def is_part(self) -> bool:
        """True for a part of another response.

        It is a part of the friction torque, or a component of a displacement.
        """
        return re.search(r"(?<!_per)_(Nmm|um|mrad)\.\w+$", self.name) is not None

    @property
    def label(self) -> str:
        """Label of the column.

        It is the meaning, or the last words of the path.
        """
        return self.meaning or self.name.rpartition(".")[2].replace("_", " ")

    def numbers(self) -> FloatArray:
        """Return the values, shape (rows,); NaN where there is none."""
        return np.array([np.nan if v is None or isinstance(v, str) else float(v) for v in self.values])

    def ends(self) -> FloatArray:
        """Return the ends of the band.

        They have the shape (rows, 2); they are NaN where there is none.
        """
        return np.array([(np.nan, np.nan) if ends is None else ends for ends in self.band])

    def text(self, row: int, units: UnitSystem = SI) -> str:
        """Return a row's number, rounded to its band.

        Empty without a band.
        """
        ends, value = self.band[row] if self.band else None, self.values[row]
        if ends is None or not isinstance(value, float):
            return ""
        low, high = (units.value(end, self.unit) for end in ends)
        return rounded(units.value(value, self.unit), 0.5 * abs(high - low))

    def band_text(self, row: int, units: UnitSystem = SI) -> str:
        """Return the ends of a row's band.

        Rounded to the meaningful digits; a dash where there is none.
        """
        ends = self.band[row]
        if ends is None:
            return NONE
        low, high = (units.value(end, self.unit) for end in ends)
        return " .. ".join(rounded(end, 0.5 * abs(high - low)) for end in (low, high))


@dataclass(frozen=True)
class StudyTable:
    """Results of a study so far.

    Attributes
    ----------
    name, title : str
    mode : str
        ``quasi-static`` or ``dynamic``.
    design : str
        How the points were chosen: ``crossed``, ``zipped``, ``latin-hypercube``, ``sobol``, ``saltelli``,
        ``optimise``.
    parameters, responses : tuple of Column
    states, reasons : tuple of str
        Of each row; the reason says why a point failed or is partial.
    files : tuple of str
        Result file of each row, relative to the study's folder; "" where there is none.
    """

    name: str
    title: str
    mode: Literal["quasi-static", "dynamic"]
    design: str
    parameters: tuple[Column, ...]
    responses: tuple[Column, ...]
    states: tuple[PointState, ...]
    reasons: tuple[str, ...]
    files: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.states)

    def response(self, name: str) -> Column:
        """Return one response.

        UsageError with the nearest names when the study has no such.
        """
        return _find("response of this study", name, self.responses)

    def parameter(self, name: str) -> Column:
        """Return one parameter.

        UsageError with the nearest names when the study has no such.
        """
        return _find("parameter of this study", name, self.parameters)

    def rows(self) -> list[dict[str, Any]]:
        """Return one plain dict per point.

        The dicts fit tables of any kind.
        """
        return [
            {
                "point": index + 1,
                **{column.name: column.values[index] for column in (*self.parameters, *self.responses)},
                **{f"{column.name}{BAND}": list(column.band[index] or ()) for column in self.responses if column.band},
                "state": self.states[index],
                "reason": self.reasons[index],
                "file": self.files[index],
            }
            for index in range(len(self))
        ]

    def units(self) -> dict[str, str]:
        """Return the unit of every column."""
        return {column.name: column.unit for column in (*self.parameters, *self.responses)}

    def to_pandas(self) -> Any:
        """Return the table as a pandas.DataFrame; units stand in ``frame.attrs["units"]``."""
        import pandas

        frame = pandas.DataFrame(self.rows()).set_index("point")
        for column in self.responses:
            if column.band:
                low, high = column.ends().T
                name = f"{column.name}{BAND}"
                frame = frame.drop(columns=name).assign(**{f"{name}_low": low, f"{name}_high": high})
        frame.attrs["units"] = self.units()
        return frame

    def to_xarray(self) -> Any:
        """Return the table as an xarray.Dataset with units and meanings.

        A crossed study has a dimension for each parameter, any other one the dimension ``point``, counted from 1.
        """
        import xarray

        if self.design == "crossed":
            dims = {c.name: list(dict.fromkeys(c.values)) for c in self.parameters}
            shape = tuple(len(values) for values in dims.values())
            coords = {c.name: (c.name, dims[c.name], _attributes(c)) for c in self.parameters}
        else:
            shape = (len(self),)
            coords = {c.name: ("point", list(c.values), _attributes(c)) for c in self.parameters}
            dims = {"point": list(range(1, len(self) + 1))}
            coords["point"] = ("point", dims["point"], {})
        found = {c.name: (tuple(dims), c.numbers().reshape(shape), _attributes(c)) for c in self.responses}
        states = (tuple(dims), np.array(self.states).reshape(shape), {"long_name": "state of the point"})
        return xarray.Dataset({**found, "state": states}, coords, {"title": self.title, "mode": self.mode})


def _attributes(column: Column) -> dict[str, str]:
    return {"units": column.unit or "1", "long_name": column.label}


def _find(kind: str, name: str, columns: Sequence[Column]) -> Column:
    for column in columns:
        if column.name == name:
            return column
    raise UsageError(unknown_name(kind, name, [column.name for column in columns]))

"""Declare the numbers of the machine interface.

It holds unit, names, digits and group of each in one place.

A field is declared once, with :func:`quantity`. The text of a result, the columns of a machine's text, the responses of
studies, the tables of reports and the builder read the declaration.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

from pydantic import Field
from pydantic_core import PydanticUndefined

from lambda_core.domain.number_text import NONE, hours, hours_alone, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.band_text import banded
from lambda_core.results.record import Record

_MARK = "quantity"  # key of the declaration in a field
SMALL = -1  # in place of decimals: two digits and an exponent
FLOATING = -2  # in place of decimals: as many as leave `digits` significant digits, three at most
_NOTHING = 5e-5  # a number below, in its unit, is written as 0 in a cell


@dataclass(frozen=True)
class Quantity:
    """Name and format of a number.

    Attributes
    ----------
    name : str
        Of the field.
    meaning : str
        What it is, with what it depends on.
    label : str
        What it is, in a few words: responses of studies, reports.
    column : str
        The same for narrow tables; "" where it is in none.
    unit : str
        Of the program; "h" is written as a life.
    decimals : int
        In sentences, in `unit`; SMALL or FLOATING.
    digits : int
        Significant digits in tables.
    group : str
        What it tells about: "friction", "life", "cage", "film", "contact", "trust", ...
    axes : tuple of str
        Of a list with a number for each axis; a list without axes holds a smallest and a largest value.
    is_list : bool
    """

    name: str
    meaning: str
    label: str
    column: str
    unit: str
    decimals: int
    digits: int
    group: str
    axes: tuple[str, ...]
    is_list: bool

    def number(self, value: float | Sequence[float | None] | None, units: UnitSystem = SI) -> str:
        """Write a value without its unit; a dash for none."""
        if value is None:
            return NONE
        if isinstance(value, Sequence):
            each = [self.number(one, units) for one in value]
            return ("  " if self.axes else "..").join(each) or NONE
        if self.unit == "h":
            return hours(value).removesuffix(" h")
        if self.decimals == SMALL:
            return f"{value:.1e}"
        return (
            units.number(value, self.unit, self._decimals(value)) if self.unit else number(value, self._decimals(value))
        )

    def text(self, value: float | Sequence[float | None] | None, units: UnitSystem = SI) -> str:
        """Write a value with its unit."""
        return f"{self.number(value, units)} {units.unit(self.unit)}".rstrip()

    def cell(self, value: float | Sequence[float | None] | None, units: UnitSystem = SI) -> str:
        """Write a value for a table cell.

        It has no unit.
        """
        if value is None:
            return NONE
        if isinstance(value, Sequence):
            each = [self.cell(one, units) for one in value]
            return ("  " if self.axes else "..").join(each if self.axes else dict.fromkeys(each)) or NONE
        if self.unit == "h":
            return hours_alone(value)
        there = units.value(value, self.unit) if self.unit else value
        small = self.decimals != SMALL and abs(there) < _NOTHING
        return f"{0.0 if small else there:.{self.digits}g}"

    def head(self, units: UnitSystem = SI) -> str:
        """Return a row's head in a narrow table.

        It has the unit.
        """
        return f"{self.column} {units.unit(self.unit)}".rstrip()

    def _decimals(self, value: float) -> int:
        if self.decimals != FLOATING:
            return self.decimals
        return 1 if not value else min(3, max(0, self.digits - 1 - math.floor(math.log10(abs(value)))))


def quantity(
    meaning: str,
    unit: str = "",
    *,
    label: str = "",
    column: str = "",
    decimals: int = 1,
    digits: int = 3,
    group: str = "",
    axes: str = "",
    default: Any = PydanticUndefined,
) -> Any:
    """Declare a field that is a number.

    It may also hold a list of numbers; see :class:`Quantity`.

    The label is the meaning where none is given.
    """
    facts: dict[str, Any] = {
        "label": label or meaning, "column": column, "unit": unit, "decimals": decimals, "digits": digits,
        "group": group, "axes": list(axes),
    }  # fmt: skip
    return Field(default, description=meaning, json_schema_extra={_MARK: facts})


def same_as(record: type[Record], name: str, meaning: str = "", default: Any = PydanticUndefined) -> Any:
    """Declare a number of another record.

    `meaning` where it differs.
    """
    info = record.model_fields[name]
    return Field(default, description=meaning or info.description, json_schema_extra=info.json_schema_extra)


_KNOWN: dict[type[Record], dict[str, Quantity]] = {}


def quantities(record: type[Record]) -> dict[str, Quantity]:
    """Return the declared numbers of a record.

    The keys are names in their order.
    """
    if record in _KNOWN:
        return _KNOWN[record]
    found = _KNOWN[record] = {}
    for name, info in record.model_fields.items():
        extra = info.json_schema_extra
        facts: Any = extra.get(_MARK) if isinstance(extra, dict) else None
        if facts is not None:
            more = {**facts, "axes": tuple(facts["axes"]), "is_list": str(info.annotation).startswith("list")}
            found[name] = Quantity(name, info.description or "", **more)
    return found


def quantity_of(record: Record, name: str) -> Quantity:
    """Return the declaration of a record's field.

    A record without it takes that of its only bearing.
    """
    own = quantities(type(record))
    return own[name] if name in own else quantity_of(next(iter(record.bearings.values())), name)  # type: ignore[attr-defined]


def shown_numbers(record: Record, groups: Sequence[str]) -> list[tuple[Quantity, Any]]:
    """Return the numbers for narrow tables.

    They come from a record and its only bearing, group by group.
    """
    each = _columns(record)
    return [(one, getattr(owner, one.name)) for group in groups for one, owner in each if one.group == group]


def remaining(record: Record, placed: Collection[str]) -> list[tuple[Quantity, Any]]:
    """Return the numbers that are not placed.

    They have a column, belong to a record or its only bearing, and their names are not in `placed`.
    """
    return [(one, getattr(owner, one.name)) for one, owner in _columns(record) if one.name not in placed]


def _columns(record: Record) -> list[tuple[Quantity, Record]]:
    """Return the numbers with a column.

    Also return their owner, which is the record or its only bearing. A number of some bearings only, null by default,
    is left out where it is null.
    """
    found = {name: (one, record) for name, one in quantities(type(record)).items()}
    if len(bearings := list(getattr(record, "bearings", {}).values())) == 1:
        found |= {name: (one, bearings[0]) for name, one in quantities(type(bearings[0])).items()}
    return [(one, owner) for one, owner in found.values() if one.column and not _is_absent(one, owner)]


def _is_absent(one: Quantity, owner: Record) -> bool:
    """Tell whether a record does not have a number."""
    return getattr(owner, one.name) is None and type(owner).model_fields[one.name].default is None


def shown(record: Record, name: str, units: UnitSystem = SI) -> str:
    """Write a number with unit and model band.

    It is one of a record; the band is there if one was computed.
    """
    return banded_text(quantity_of(record, name), getattr(record, name), getattr(record, f"{name}_band", []), units)


def banded_text(one: Quantity, value: Any, band: Sequence[float], units: UnitSystem = SI) -> str:
    """Write a number with unit and model band."""
    return banded(value, band, one.unit, one.text(value, units), units)

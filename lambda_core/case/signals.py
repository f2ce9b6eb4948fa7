"""Declare time functions of loads, moments, speeds and motions.

A plain unit string is a constant; a table says more, for example
``{kind = "harmonic", amplitude = "10 um", frequency = "200 Hz"}``. All kinds of one signal
carry the signal's own quantity, so that a force cannot ramp up to a speed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Generic, Literal, TypeVar

from pydantic import Discriminator, PrivateAttr, Tag, ValidationInfo, model_validator

from lambda_core.case.option import Section, option
from lambda_core.case.pairs import given_pairs
from lambda_core.domain.units import Angle, Frequency, Quantity, Time

V = TypeVar("V")
_MOST_TERMS = 1000  # of a sum: each is evaluated at every step
SIGNAL_KINDS = ("constant", "ramp", "harmonic", "table", "law", "sum")


def is_signal(table: Mapping[str, Any]) -> bool:
    """Tell whether a written table is a time function."""
    return table.get("kind") in SIGNAL_KINDS


class TimeTable(Section):
    """Base of the kinds of time function."""

    @classmethod
    def model_parametrized_name(cls, params: tuple[Any, ...]) -> str:
        """Name the class after its quantity, for schemas and messages."""
        names = [item.name for param in params for item in getattr(param, "__metadata__", ()) if type(item) is Quantity]
        return f"{cls.__name__}_{'_'.join(names)}" if names else super().model_parametrized_name(params)


class Constant(TimeTable, Generic[V]):
    """The same value at all times."""

    kind: Literal["constant"]
    value: V = option(description="the value")


class Ramp(TimeTable, Generic[V]):
    """Linear from one value to another, constant before and after."""

    kind: Literal["ramp"]
    start: V = option(description="value before the ramp")
    end: V = option(description="value after the ramp")
    start_time: Time = option("0 s", "when the ramp begins", ge=0.0)
    end_time: Time = option(description="when the ramp ends", gt=0.0)

    @model_validator(mode="after")
    def _forward(self) -> Ramp[V]:
        if self.end_time <= self.start_time:
            raise ValueError("end_time must be later than start_time")
        return self


class Harmonic(TimeTable, Generic[V]):
    """amplitude * sin(2 pi frequency t + phase)."""

    kind: Literal["harmonic"]
    amplitude: V = option(description="amplitude")
    frequency: Frequency = option(description="frequency", gt=0.0)
    phase: Angle = option("0 deg", "phase at t = 0")


class Table(TimeTable, Generic[V]):
    """Values at points in time.

    A smooth curve joins them; they are constant outside.

    ``points`` stand in the case; ``file`` names a CSV file in its folder whose header is
    ``time [s],value [kN]`` (the units in brackets are those of the columns).

    Between two neighbours the curve stays between their values (``monotone``), with a continuous first derivative. A
    ``spline`` has a continuous second one, as a prescribed motion that swings needs it, and goes beyond points that
    bend sharply: `check` says how far. Both begin and end with slope 0; two points are joined by a straight line.
    """

    kind: Literal["table"]
    points: list[tuple[Time, V]] | None = option(None, 'pairs of time and value, [["0 s", "0 N"], ["1 s", "5 kN"]]')
    file: str | None = option(None, "CSV file with two columns, relative to the case file", min_length=1)
    interpolation: Literal["monotone", "spline"] = option(
        "monotone", "curve through the points: one that never leaves their range, or a cubic spline with flat ends"
    )
    _rows: tuple[tuple[float, float], ...] = PrivateAttr(default=())

    @model_validator(mode="after")
    def _read(self, info: ValidationInfo) -> Table[V]:
        folder = Path((info.context or {}).get("folder") or ".")
        self._rows = given_pairs(self.points, self.file, self.quantity, folder).points  # type: ignore[arg-type]
        if len(self._rows) < 2:
            raise ValueError("a table needs at least two points")
        return self

    @property
    def quantity(self) -> str:
        """Quantity of the values."""
        (value_type,) = type(self).__pydantic_generic_metadata__["args"]
        return next(item.name for item in value_type.__metadata__ if isinstance(item, Quantity))

    @property
    def rows(self) -> tuple[tuple[float, float], ...]:
        """Points as (time [s], value [SI])."""
        return self._rows

    def inlined(self) -> dict[str, Any]:
        """Return the table with its points written out.

        The case then needs no other file.
        """
        from lambda_core.domain.units import show

        points = [[show(time, "time"), show(value, self.quantity)] for time, value in self.rows]
        chosen = {"interpolation": self.interpolation} if "interpolation" in self.model_fields_set else {}
        return {"kind": "table", "points": points, **chosen}


class ByLaw(TimeTable, Generic[V]):
    """Time function by a law.

    The function is amplitude * f(t), where f is a law of the role time_function: `chirp`, or that of a plugin.
    """

    kind: Literal["law"]
    law: str = option(description="law of the role time_function", min_length=1)
    amplitude: V = option(description="amplitude")
    parameters: dict[str, Any] = option({}, "parameters of the law")
    _course: Any = PrivateAttr(default=None)

    @property
    def course(self) -> Any:
        """Course that the resolution of the case found.

        lambda_core.model.laws.time_laws sets it; it is None before.
        """
        return self._course

    def set_course(self, course: Any) -> None:
        """Keep what the resolution has found out.

        It is for a copy of the case.
        """
        self._course = course


def _kind(value: Any) -> str | None:
    kind = value.get("kind") if isinstance(value, dict) else getattr(value, "kind", "value")
    return f"kind:{kind}" if kind in (*SIGNAL_KINDS, "value") else None


class Sum(TimeTable, Generic[V]):
    """Sum of other time functions."""

    kind: Literal["sum"]
    terms: list[
        Annotated[
            Annotated[V, Tag("kind:value")]
            | Annotated[Constant[V], Tag("kind:constant")]
            | Annotated[Ramp[V], Tag("kind:ramp")]
            | Annotated[Harmonic[V], Tag("kind:harmonic")]
            | Annotated[Table[V], Tag("kind:table")]
            | Annotated[ByLaw[V], Tag("kind:law")],
            Discriminator(_kind),
        ]
    ] = option(description=f"values and tables that are added, {_MOST_TERMS} at most", min_length=1)

    @model_validator(mode="before")
    @classmethod
    def _count(cls, data: Any) -> Any:
        terms = data.get("terms") if isinstance(data, dict) else None
        if isinstance(terms, list) and len(terms) > _MOST_TERMS:
            raise ValueError(
                f"{len(terms)} terms, at most {_MOST_TERMS}: each is evaluated at every step; write a table of points"
            )
        return data


def summands(signals: Iterable[tuple[str, float | TimeTable | None]]) -> Iterator[tuple[str, float | TimeTable | None]]:
    """Yield paths and values, terms of sums one by one."""
    for path, signal in signals:
        if isinstance(signal, Sum):
            yield from ((f"{path}.terms.{number}", term) for number, term in enumerate(signal.terms))
        else:
            yield path, signal


if TYPE_CHECKING:
    # What a checker may rely on; at run time each alias also validates its own quantity.
    ForceSignal = float | TimeTable
    MomentSignal = float | TimeTable
    LengthSignal = float | TimeTable
    AngleSignal = float | TimeTable
    SpeedSignal = float | TimeTable
else:

    def _signal(quantity: str) -> Any:
        value = Annotated[float, Quantity(quantity)]
        return Annotated[
            Annotated[value, Tag("kind:value")]
            | Annotated[Constant[value], Tag("kind:constant")]
            | Annotated[Ramp[value], Tag("kind:ramp")]
            | Annotated[Harmonic[value], Tag("kind:harmonic")]
            | Annotated[Table[value], Tag("kind:table")]
            | Annotated[ByLaw[value], Tag("kind:law")]
            | Annotated[Sum[value], Tag("kind:sum")],
            Discriminator(_kind),
        ]

    ForceSignal = _signal("force")
    MomentSignal = _signal("moment")
    LengthSignal = _signal("length")
    AngleSignal = _signal("angle")
    SpeedSignal = _signal("rotational_speed")

"""Fit a machine, or one of its bearings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.analysis.band.graded import Graded, given_range, varied
from lambda_core.analysis.band.quantities import (
    CONDITIONS,
    MEASURED,
    STIFFNESSES,
    TEMPERATURES,
    Condition,
    Measured,
    stiffness_reading,
)
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.units import from_si, parse
from lambda_core.domain.written_values import Scale, scale_of
from lambda_core.fitting.subjects import Subject, vocabulary
from lambda_core.results.model_band import QUANTITIES

if TYPE_CHECKING:
    from lambda_core.analysis.static_point import StaticPoint

_SHARED = ("speed", "oil temperature", "oil level")  # conditions that are those of all bearings
_MODES = 8
_FRICTION = {name: MEASURED[name] for name in ("friction torque", "power loss")}
_OF_MACHINE = {
    **_FRICTION,
    "largest deflection": Measured("max_deflection_um", "small_length", "um"),
    "first critical speed": Measured("first_critical_speed_rpm", "rotational_speed", "1/min"),
    **{f"natural frequency {n}": Measured(f"modes.{n}", "frequency", "Hz") for n in range(1, _MODES + 1)},
    **{f"bending frequency {n}": Measured(f"bending.{n}", "frequency", "Hz") for n in range(1, _MODES + 1)},
}
_OF_BEARING = {
    **_FRICTION,
    "radial load": Measured("radial_load_N", "force", "N"),
    "axial load": Measured("axial_load_N", "force", "N", is_signed=True),
    **{name: MEASURED[name] for name in ("minimum film", "capacitance")},
    **{
        f"displacement {axis}": Measured(f"displacement_um.{axis}", "small_length", "um", is_signed=True)
        for axis in "xyz"
    },
    **STIFFNESSES,
}
_PLACES = {
    "oil temperature": ("lubricant", "temperature"),
    "inner ring temperature": ("temperatures", "inner_ring"),
    "outer ring temperature": ("temperatures", "outer_ring"),
}


class MachineSubject(Subject):
    """A machine, or one of its bearings.

    Parameters
    ----------
    source, overrides
        The case of the machine.
    bearing : str, optional
        Columns without the name of a bearing, and parameters, are those of this one.
    """

    def __init__(self, source: Any, overrides: Iterable[str], bearing: str | None) -> None:
        from lambda_core.analysis.rotor.bearing_alone import bearing_number
        from lambda_core.case.case_io import toml_tables
        from lambda_core.case.machine import MachineCase
        from lambda_core.model.resolve_machine import resolve_machine

        self._machine = resolve_machine(source, overrides)
        self._tables = toml_tables(self._machine.case_toml, self._machine.name)
        if bearing is not None:
            bearing_number(self._machine, bearing)
        self.case_toml, self.bearing = self._machine.case_toml, bearing
        names = [one.name for one in self._machine.bearings]
        self.name = self._machine.name if bearing is None else f"{self._machine.name}-{bearing}"
        self.title = self._machine.name if bearing is None else f"{bearing} of {self._machine.name}"
        self._readers = _readers(names, bearing)
        conditions = _conditions(names, bearing)
        is_computed = self._machine.awaits_temperatures
        computed = [name for name in conditions if name.endswith(TEMPERATURES)] if is_computed else []
        measured = {name: one for name, (_, one) in self._readers.items()}
        self._readers |= {
            name: (_owner(name, names, bearing), Measured("", "temperature", "degC")) for name in computed
        }
        self.words = vocabulary(conditions, measured, MachineCase, computed)

    def varied(self, specification: str) -> Graded:
        """Return the parameter that a text names.

        A parameter of the bearings is that of all of them, with ``bearings.NAME.`` before it or for one bearing that of
        this one. Any other number of the machine needs a range.
        """
        name, equals, ends = specification.partition("=")
        path, own = name.strip(), self.bearing
        for one in self._machine.bearings:
            if path.startswith(f"bearings.{one.name}."):
                path, own = path.removeprefix(f"bearings.{one.name}."), one.name
        known = self._machine.bearing_models
        refused: UsageError | None = None
        for owner in known if own is None else (own,):
            local = f"bearing.{path}" if own is not None and path in _values(self._tables, ("bearings", own)) else path
            try:
                found = varied(known[owner], f"{local}{equals}{ends}")
            except UsageError as error:
                refused = refused or error
                continue
            if own is None and found.law:
                self._refuse_other_laws(found)
            return replace(found, path=self._place(found.path, own), models=())
        return self._option(name.strip(), equals, ends, refused)

    def _refuse_other_laws(self, found: Graded) -> None:
        """Refuse one parameter of bearings with different laws."""
        role = found.path.split(".")[1]
        laws = {
            name: next((roles[role].model.name for roles in model.laws.values() if role in roles), found.law)
            for name, model in self._machine.bearing_models.items()
        }
        if len(set(laws.values())) > 1:
            listed = ", ".join(f"{law} of {name}" for name, law in laws.items())
            own = " or ".join(f"bearings.{name}.{found.path}" for name, law in laws.items() if law == found.law)
            raise UsageError(f"--vary {found.short}: bearings have different laws of {role} ({listed}): write {own}")

    def _place(self, path: str, bearing: str | None) -> str:
        """Return the machine's place of a bearing's option.

        `path` is its place in the case of the bearing.
        """
        first, _, rest = path.partition(".")
        if first in ("loads", "operation"):
            raise UsageError(f'--vary: a machine has no {path}: name an option such as "loads.NAME.force_z"')
        if bearing is not None:
            return f"bearings.{bearing}.{rest if first == 'bearing' else path}"
        if first == "bearing":
            names = " or ".join(f"bearings.{one.name}.{rest}" for one in self._machine.bearings)
            raise UsageError(f"--vary: {rest} is that of one bearing: write {names}")
        return path

    def _option(self, path: str, equals: str, ends: str, refused: UsageError | None) -> Graded:
        """Return an option of the machine as number.

        It is in the machine's case.
        """
        value: Any = self._tables
        for part in path.split("."):
            value = value.get(part) if isinstance(value, Mapping) else None
        try:
            read = None if value is None else scale_of([value])
        except ValueError:
            read = None
        if read is None:
            more = f"; or name a number in the case of {self._machine.name}"
            raise UsageError(f"{refused}{more}") if refused is not None else UsageError(f"--vary: no {path}{more}")
        scale, (number,) = read
        entry = Graded(path, number, math.nan, math.nan, Scale(scale.unit), "", "")
        if not equals:
            raise UsageError(f"--vary: {path} has no published range: give one, for example {entry.example()}")
        return given_range(entry, ends)

    def values(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return predicted quantities in one row.

        The balls are as in the machine's equilibrium.
        """
        del one
        moved = [change for graded, number in parameters for change in graded.changes(number)]
        point = self.point((*changes, *moved))
        return np.array([[self._read(point, name) for name in names]])

    def _read(self, point: StaticPoint, name: str) -> float:
        owner, measured = self._readers[name]
        number = _temperature(point, owner, name) if not measured.response else _number(point, owner, measured.response)
        if number is None or not math.isfinite(number):
            raise SolverError(f"the equilibrium has no {name}")
        return number

    def size(self, changes: Sequence[str], name: str, sizes: Mapping[tuple[str, str], float]) -> float:
        """Return the deviation of a column by those of bearings."""
        (owner, measured), kind = self._readers[name], self.kind(name)
        if owner or not kind:
            return super().size(changes, name, sizes)
        point = self.point(changes)
        each = {one: _number(point, one, measured.response) or 0.0 for one in point.model.bearing_models}
        return sum(each[one] * sizes.get((one, kind), 0.0) for one in each) / sum(each.values())

    def owner(self, name: str) -> str:
        """Return the bearing that a quantity is that of."""
        return self._readers[name][0]

    def kind(self, name: str) -> str:
        """Return the quantity of a bearing that a column means."""
        return next((kind for kind in QUANTITIES if name.endswith(kind)), "")


def _readers(names: Sequence[str], bearing: str | None) -> dict[str, tuple[str, Measured]]:
    """Return owner and meaning of each measured quantity.

    The owner of one of the machine is empty.
    """
    found: dict[str, tuple[str, Measured]] = {}
    for name in names:
        found |= {f"{name.casefold()} {quantity}": (name, one) for quantity, one in _OF_BEARING.items()}
    own = _OF_MACHINE if bearing is None else _OF_BEARING
    return {quantity: (bearing or "", one) for quantity, one in own.items()} | found


def _conditions(names: Sequence[str], bearing: str | None) -> dict[str, Condition]:
    """Return the conditions of the columns.

    A condition of one bearing begins with its name; the others hold for all bearings.
    """
    found = {name: CONDITIONS[name] for name in _SHARED}
    for name in names:
        for quantity, place in _PLACES.items():
            one = replace(CONDITIONS[quantity], path=".".join(("bearings", name, *place)))
            found[f"{name.casefold()} {quantity}"] = one
            if name == bearing:
                found[quantity] = one
    return found


def _owner(column: str, names: Sequence[str], bearing: str | None) -> str:
    """Return the bearing that a temperature is that of."""
    named = [name for name in names if column.startswith(f"{name.casefold()} ")]
    return named[0] if named else bearing or names[0]


def _values(tables: Mapping[str, Any], path: Sequence[str]) -> Mapping[str, Any]:
    for part in path:
        tables = tables.get(part, {})
    return tables


def _temperature(point: StaticPoint, bearing: str, column: str) -> float:
    """Return a computed temperature [degC].

    The case of the point has it.
    """
    from lambda_core.case.case_io import toml_tables

    place = next(place for quantity, place in _PLACES.items() if column.endswith(quantity))
    found = _values(toml_tables(point.model.case_toml, point.model.name), ("bearings", bearing, place[0]))[place[1]]
    return from_si(parse(found, "temperature"), "temperature", "degC")


def _number(point: Any, bearing: str, response: str) -> float | None:
    """Return a number of a machine.

    It may also be a number of one of the machine's bearings.
    """
    from lambda_core.studies.responses import responses_of

    if response in STIFFNESSES:
        return stiffness_reading(response, point.summary.bearing(bearing).stiffness)
    kind, _, which = response.partition(".")
    if kind in _OTHER:
        return _OTHER[kind](point, bearing, which)
    own = f"{bearing}.{response}" if bearing else response
    read = responses_of(point.model)[own].static
    assert read is not None
    return read(point)


def _mode(point: Any, bearing: str, which: str, kinds: Sequence[str] = ()) -> float | None:
    del bearing
    rising = [mode.frequency_Hz for mode in point.modes_at_speed if not kinds or mode.kind in kinds]
    return rising[int(which) - 1] if int(which) <= len(rising) else None


_OTHER: Mapping[str, Callable[[Any, str, str], float | None]] = {
    "modes": _mode,
    "bending": lambda point, bearing, which: _mode(point, bearing, which, ("bending", "lateral")),  # of a rigid shaft
}

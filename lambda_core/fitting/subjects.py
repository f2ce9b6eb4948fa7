"""Define subjects of a fit.

A subject is one bearing, a machine, or one bearing of a machine.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache, partial
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.graded import Graded, varied
from lambda_core.analysis.band.model_band import bands_of, deviations, effects_of
from lambda_core.analysis.band.quantities import (
    CONDITIONS,
    MEASURED,
    TEMPERATURES,
    Condition,
    Measured,
    Vocabulary,
    error_quantity,
    no_measured,
)
from lambda_core.analysis.thermal.temperatures import ready, ready_rollers
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.domain.units import units_of
from lambda_core.domain.written_values import quantities
from lambda_core.fitting.operating_points import ROLLER_QUANTITIES, OperatingPoints, roller_values
from lambda_core.studies.job import point_model, solved_point

if TYPE_CHECKING:
    from pydantic import BaseModel

    from lambda_core.analysis.static_point import StaticPoint
    from lambda_core.case.case import Case
    from lambda_core.case.case_io import Source


class Subject(ABC):
    """A bearing or a machine that is fitted.

    Attributes
    ----------
    name, title : str
    words : Vocabulary
    case_toml : str
        Case, of which another process makes the same subject.
    bearing : str or None
        The one of a machine.
    """

    name: str
    title: str
    words: Vocabulary
    case_toml: str
    bearing: str | None = None

    @abstractmethod
    def varied(self, specification: str) -> Graded:
        """Return the named parameter.

        The name is ``PATH`` or ``PATH=LOW..HIGH``; an unknown path raises a UsageError.
        """

    @abstractmethod
    def values(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return predicted quantities of the changed case.

        The shape is (positions of the balls, names).
        """

    def solved(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return the same; SolverError where a quantity is missing."""
        found = self.values(changes, parameters, names, one=one)
        missing = [name for name, column in zip(names, found.T, strict=True) if not np.isfinite(column).all()]
        if missing:
            why = "asperities connect the rings" if missing[0].endswith("capacitance") else "it is not finite"
            raise SolverError(f"there is no {missing[0]}: {why}")
        return found

    def point(self, changes: Sequence[str]) -> StaticPoint:
        """Return the operating point of the changed case."""
        return _solved(self.case_toml, tuple(changes))

    def owner(self, name: str) -> str:
        """Return the bearing that a quantity is that of.

        It is empty for one of the machine, and of a bearing that is alone.
        """
        del name
        return ""

    def kind(self, name: str) -> str:
        """Return the quantity of a bearing that a column means.

        It is empty where ranges and laws of bearings do not move it.
        """
        return name

    def deviations(self, changes: Sequence[str], names: Sequence[str], fitted: Iterable[str]) -> dict[str, float]:
        """Return each quantity's relative standard deviation.

        It follows from the ranges of all that is not fitted. Torques and losses of all bearings of a machine err
        together, as those of their laws do; how stiff and how loaded a machine is counts as known.
        """
        point, own = self.point(changes), tuple(fitted)
        kinds, found = {name: self.kind(name) for name in names}, point.model.found_temperatures
        sizes: dict[tuple[str, str], float] = {}
        for bearing, one in point.loaded.items():
            wanted = dict.fromkeys(kinds[name] for name in names if kinds[name] and self.owner(name) in ("", bearing))
            if wanted:
                local = [path.removeprefix(f"bearings.{bearing}.") for path in own]
                effects = effects_of(one, list(wanted), found, [*local, *(f"bearing.{path}" for path in local)])
                # what the temperatures of a machine do is known of all its bearings together only
                moved = deviations(effects, list(wanted), None if bearing else found)
                sizes |= {(bearing, kind): size for kind, size in moved.items()}
        return {name: self.size(changes, name, sizes) for name in names}

    def size(self, changes: Sequence[str], name: str, sizes: Mapping[tuple[str, str], float]) -> float:
        """Return the deviation of a column by those of bearings.

        `sizes` has them by bearing and quantity.
        """
        del changes
        return sizes.get((self.owner(name), self.kind(name)), 0.0)

    def bands(self, changes: Sequence[str], names: Sequence[str]) -> dict[str, list[float]]:
        """Return both ends of each quantity's model band.

        Quantities without a band are left out. Those of torques and losses of all bearings of a machine are added: they
        err together.
        """
        kinds = {name: self.kind(name) for name in names}
        wanted = list(dict.fromkeys(kind for kind in kinds.values() if kind))
        if not wanted:
            return {}
        point, found = self.point(changes), {}
        each = bands_of(point.model, point.loaded, wanted).bearings
        for name, kind in kinds.items():
            owner = self.owner(name)
            owners = (owner,) if owner in each else each
            bands = [band for one in owners for band in each[one].bands if band.quantity == kind]
            if bands:
                found[name] = [sum(band.low for band in bands), sum(band.high for band in bands)]
        return found


@lru_cache(maxsize=4)
def _solved(case_toml: str, changes: tuple[str, ...]) -> StaticPoint:
    """Return the operating point of a changed case.

    The last points are kept, as several quantities are read from one.
    """
    return solved_point(ready(point_model(case_toml, changes, is_static=True), is_static=True))


def subject_of(source: Source, overrides: Iterable[str] = (), bearing: str | None = None) -> Subject:
    """Return the subject of a fit.

    It is made of a case; UsageError where there is no such bearing.
    """
    from lambda_core.case.case_io import apply_overrides, bearing_case, is_machine, refuse_bearing

    if is_machine(source):
        from lambda_core.fitting.machine_subject import MachineSubject

        return MachineSubject(source, overrides, bearing)
    refuse_bearing(bearing)
    case = apply_overrides(bearing_case(source), overrides)
    subject = BearingSubject(case)
    return subject if subject.model.rollers is None else RollerSubject(case)


class BearingSubject(Subject):
    """One bearing."""

    def __init__(self, case: Case) -> None:
        from lambda_core.case.case import Case
        from lambda_core.case.case_writer import standalone_toml
        from lambda_core.model.checking import resolve

        self.model = resolve(case, is_static=True)
        self.case_toml = standalone_toml(case)
        self._points = OperatingPoints(self.case_toml)
        self.name, self.title = self.model.name, self.model.title
        is_computed = case.operation.temperatures == "computed"
        self.words = _of_one(MEASURED, Case, TEMPERATURES if is_computed else ())

    def varied(self, specification: str) -> Graded:
        """Return the parameter that a text names."""
        return varied(self.model, specification)

    def values(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return predicted quantities at several positions of the balls."""
        return self._points.values(changes, parameters, names, one=one)


class RollerSubject(BearingSubject):
    """One roller bearing, as its quasi-static answer has it."""

    def __init__(self, case: Case) -> None:
        from lambda_core.model.roller_case import roller_model

        super().__init__(case)
        self._case, rollers = case, roller_model(case)
        assert rollers is not None
        self.model = replace(self.model, values=(*self.model.values, *rollers.values))
        kept = {name: MEASURED[name] for name in ROLLER_QUANTITIES}
        computed = TEMPERATURES if case.operation.temperatures == "computed" else ()
        self.words = _of_one(kept, type(case), computed)

    def values(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return predicted quantities in one row.

        There is one position of the rollers.
        """
        from lambda_core.case.case_io import apply_overrides

        del one
        moved = [change for graded, number in parameters for change in graded.changes(number)]
        # the case may be wrong with these changes: then this says what is wrong
        found = ready_rollers(apply_overrides(self._case, (*changes, *moved)))
        assert found is not None
        return roller_values(*found, names)[np.newaxis]


def _of_one(measured: Mapping[str, Measured], root: type[BaseModel], computed: Sequence[str]) -> Vocabulary:
    return replace(vocabulary(CONDITIONS, measured, root, computed), why_not=no_measured)


def vocabulary(
    conditions: Mapping[str, Condition],
    measured: Mapping[str, Measured],
    root: type[BaseModel],
    computed: Sequence[str],
) -> Vocabulary:
    """Return the names of columns for a case.

    Parameters
    ----------
    root : type
        The case's class, whose options may be columns, too.
    computed : sequence of str
        Conditions that are results of this case: measured quantities.
    """
    found = {name: Measured("", conditions[name].quantity, "degC") for name in computed}
    kept = {name: condition for name, condition in conditions.items() if name not in computed}
    example = '"speed [1/min],friction torque [N mm]"'
    return Vocabulary(kept, {**measured, **found}, example, option=partial(option_condition, root))


def option_condition(root: type[BaseModel], path: str, unit: str) -> Condition | None:
    """Return the condition of an option's column.

    The path of an option names it; None where there is no such option.
    """
    from lambda_core.case.option import quantity_of
    from lambda_core.domain.option_tree import field_at, model_at

    *parents, name = path.split(".")
    parent = model_at(root, parents)
    if parent is None or field_at(root, path) is None:
        return None
    declared = quantity_of(parent, name)
    fitting = sorted(one for one in quantities(f"1 {unit}") if unit in units_of(one)) if unit else []
    quantity = declared or (fitting[0] if fitting else "")
    return Condition(path, quantity, error_quantity(quantity)) if quantity else None

"""Set up the fit problem of a case."""

from __future__ import annotations

import itertools
import math
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.analysis.band.graded import Graded
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import LambdaError, SolverError, UsageError
from lambda_core.fitting.data import Data
from lambda_core.fitting.measurements import Measurements
from lambda_core.fitting.operating_points import at_line, condition_change
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.rows import Asked, Rows, Solved
from lambda_core.fitting.subjects import Subject

_STEP = 0.05  # of a parameter's spread before the fit, for slopes: above the scatter of the equilibrium's iteration
_MOST_CONDITIONS = 3  # that candidates of the next point combine
_LESS, _MORE = 0.5, 1.5  # of the smallest and largest value measured, where a candidate may lie
_WARMER = 10.0  # beyond the temperatures measured [K]


class RowsWithoutSolution(SolverError):
    """Operating points without a solution.

    Parameters
    ----------
    measurements : Measurements
        What was measured.
    reasons : mapping of int to SolverError
        Row of each, and why.
    """

    def __init__(self, measurements: Measurements, reasons: Mapping[int, SolverError]) -> None:
        self.reasons = {measurements.lines[row]: " ".join(str(error).split()) for row, error in reasons.items()}
        self.rows = set(reasons)
        line, why = next(iter(self.reasons.items()))
        super().__init__(f"{measurements.name} line {line}: {why}")


@dataclass(frozen=True)
class Entry:
    """One measured value.

    Row of the measurements and name of the quantity.
    """

    row: int
    quantity: str


class CaseProblem:
    """Predicted values over the parameters of a fit.

    They belong to measured operating points.

    Parameters
    ----------
    subject : Subject
        What the conditions and parameters change.
    measurements : Measurements
        What was measured.
    varied : sequence of Graded
        Parameters of the fit.
    rows : Rows, optional
        Solves the operating points; by default in this process.
    """

    def __init__(
        self, subject: Subject, measurements: Measurements, varied: Sequence[Graded], rows: Rows | None = None
    ) -> None:
        self._subject, self.measurements, self.varied = subject, measurements, tuple(varied)
        self._rows = rows or Rows(subject)
        _refuse_twice(self.varied, measurements)
        _refuse_zeros(measurements, subject)
        self.parameters = [_parameter(graded) for graded in self.varied]
        self.entries = [
            Entry(row, name)
            for row in range(len(measurements))
            for name, values in measurements.measured.items()
            if math.isfinite(values[row])
        ]
        self._asked = [
            tuple(name for name, values in measurements.measured.items() if math.isfinite(values[row]))
            for row in range(len(measurements))
        ]
        self._conditions = [
            {name: float(values[row]) for name, values in measurements.conditions.items()}
            for row in range(len(measurements))
        ]
        self._known: dict[tuple[str | float, ...], Solved] = {}

    @property
    def rows(self) -> int:
        """Operating points that were measured."""
        return len(self.measurements)

    @property
    def solved(self) -> int:
        """Operating points solved so far."""
        return len(self._known)

    @property
    def quantities(self) -> dict[str, str]:
        """Physical quantity of each operating condition."""
        return {name: condition.quantity for name, condition in self.measurements.set_by.items()}

    @property
    def data(self) -> Data:
        """Measured values with their errors, stacked row by row."""
        m = self.measurements
        values = np.array([m.measured[e.quantity][e.row] for e in self.entries])
        known = [e.quantity in m.errors or e.quantity in m.shares for e in self.entries]
        if any(known) and not all(known):
            missing = sorted({e.quantity for e, is_known in zip(self.entries, known, strict=True) if not is_known})
            raise UsageError(f'{m.name}: give errors for all quantities or none; "{missing[0]} error [%]" is missing')
        if not all(known) and (warm := [name for name in m.measured if name.endswith("temperature")]):
            raise UsageError(f'{m.name}: a temperature needs its error: add a column "{warm[0]} error [K]"')
        if not all(known) and m.in_common:
            raise UsageError(
                f'{m.name}: "{m.in_common} common error" counts against errors of measured values: add a column '
                f'"{next(iter(m.measured))} error [%]"'
            )
        errors, is_known = np.ones_like(values), all(known)
        for index, entry in enumerate(self.entries):
            if entry.quantity in m.errors:
                errors[index] = m.errors[entry.quantity][entry.row]
            elif entry.quantity in m.shares:
                errors[index] = m.shares[entry.quantity][entry.row] * abs(values[index])
        columns = {name: column[[e.row for e in self.entries]] for name, column in m.conditions.items()}
        alone, common = (self._of_entries(errors) for errors in (m.condition_errors, m.common_errors))
        points = tuple(e.row for e in self.entries)
        of_values = (self._of_instruments(errors) for errors in (m.common_of_values, m.common_shares))
        return Data(values, errors, columns, alone, is_known, not is_known, points, common, *of_values)

    def _of_instruments(self, errors: Mapping[str, FloatArray]) -> FloatArray:
        """Return common errors of measured quantities, shape (n, q)."""
        found = np.zeros((len(self.entries), len(self._instruments)))
        for index, entry in enumerate(self.entries):
            if entry.quantity in errors:
                found[index, self._instruments.index(entry.quantity)] = errors[entry.quantity][entry.row]
        return found

    @property
    def _instruments(self) -> list[str]:
        """Measured quantities whose values have an error in common."""
        m = self.measurements
        return [name for name in m.measured if name in m.common_of_values or name in m.common_shares]

    def _of_entries(self, errors: Mapping[str, FloatArray]) -> FloatArray:
        """Return errors of conditions for each value, shape (n, k)."""
        rows, nothing = [e.row for e in self.entries], np.zeros(self.rows)
        found = [errors.get(name, nothing)[rows] for name in self.measurements.uncertain]
        return np.column_stack(found) if found else np.zeros((0, 0))

    def predict(self, values: FloatArray) -> FloatArray:
        """Return the predicted values, shape (n,)."""
        return self._stacked(values, self._conditions)

    def jacobian(self, values: FloatArray) -> FloatArray:
        """Return their derivatives by the parameters, shape (n, p).

        The differences lead towards the inside of the bounds, at one position of the balls.
        """
        base, columns = self._stacked(values, self._conditions, one=True), []
        for index, parameter in enumerate(self.parameters):
            step = _STEP * parameter.spread
            step = -step if values[index] + step > parameter.high else step
            moved = values.copy()
            moved[index] += step
            columns.append((self._stacked(moved, self._conditions, one=True) - base) / step)
        return np.column_stack(columns)

    def input_slopes(self, values: FloatArray) -> FloatArray:
        """Return the derivatives by uncertain conditions.

        The array has shape (n, k).
        """
        base, columns = self._stacked(values, self._conditions, one=True), []
        for name, errors in self.measurements.uncertain.items():
            moved = [
                {**conditions, name: conditions[name] + float(errors[row])}
                for row, conditions in enumerate(self._conditions)
            ]
            steps = np.array([errors[e.row] for e in self.entries])
            columns.append((self._stacked(values, moved, one=True) - base) / steps)
        return np.column_stack(columns)

    def parts(self, values: FloatArray) -> tuple[FloatArray, dict[str, FloatArray]]:
        """Return errors of new measured values.

        Returns
        -------
        tuple of (float64[:], dict of str to float64[:])
            Standard deviations by errors of conditions at each point alone; what each error in common moves every
            value, by the name of its condition or quantity.
        """
        data, alone = self.data, np.zeros(len(self.entries))
        common = dict(zip(self._instruments, data.offsets(self.predict(values)).T, strict=True))
        if data.input_errors.size:
            moved, of_all = data.moved(self.input_slopes(values))
            alone = np.sqrt(np.sum(moved**2, axis=1))
            common |= dict(zip(self.measurements.uncertain, of_all.T, strict=True))
        return alone, common

    def conditions_of_entries(self) -> list[dict[str, float]]:
        """Return the operating conditions of each measured value, SI."""
        return [self._conditions[entry.row] for entry in self.entries]

    def law_deviations(self, row: int, values: FloatArray) -> dict[str, float]:
        """Return the deviation by what is not fitted.

        Laws and ranges may move each quantity so far at the point of a value.

        Relative standard deviations; a quantity that they do not move is left out.
        """
        changes = self._changes(self._conditions[self.entries[row].row])
        pairs = zip(self.varied, values.tolist(), strict=True)
        moved = [change for graded, number in pairs for change in graded.changes(number)]
        fitted = [graded.path for graded in self.varied]
        return self._subject.deviations(
            (*changes, *moved), tuple(dict.fromkeys(e.quantity for e in self.entries)), fitted
        )

    def elsewhere(self, measurements: Measurements) -> CaseProblem:
        """Return the same problem for other measurements."""
        return CaseProblem(self._subject, measurements, self.varied, self._rows)

    def without(self, rows: Container[int]) -> CaseProblem:
        """Return the problem without some points.

        What is solved stays known.
        """
        found = self.elsewhere(self.measurements.without(rows))
        found._known = self._known
        return found

    def doubts(self, values: FloatArray) -> dict[int, tuple[str, ...]]:
        """Return sentences of the solver about points, by line."""
        found, numbers = {}, values.tolist()
        for row, names in enumerate(self._asked):
            solved = self._known.get(("all", *self._changes(self._conditions[row]), *numbers, *names))
            if solved is not None and solved.doubts:
                found[self.measurements.lines[row]] = solved.doubts
        return found

    def candidates(self) -> list[dict[str, float]]:
        """Return operating points for the next measurement.

        They are corners of and beyond what was measured.
        """
        levels = {}
        for name, column in list(self.measurements.conditions.items())[:_MOST_CONDITIONS]:
            low, high = float(column.min()), float(column.max())
            if self.measurements.set_by[name].quantity == "temperature":
                levels[name] = (low - _WARMER, high + _WARMER)
            elif low > 0.0:
                levels[name] = (_LESS * low, _MORE * high)
        middle = {name: float(np.median(column)) for name, column in self.measurements.conditions.items()}
        return [{**middle, **dict(zip(levels, corner, strict=True))} for corner in itertools.product(*levels.values())]

    def candidate_slopes(self, values: FloatArray, points: Sequence[dict[str, float]]) -> FloatArray:
        """Return the quantity and derivatives at candidates.

        The array of the first quantity has shape (m, 1 + p), with NaN without a solution.
        """
        quantity, found = self.entries[0].quantity, np.full((len(points), 1 + len(self.parameters)), math.nan)
        for row, conditions in enumerate(points):
            try:
                base = self._value(values, conditions, quantity)
                found[row, 0] = base
                for index, parameter in enumerate(self.parameters):
                    step = _STEP * parameter.spread
                    moved = values.copy()
                    moved[index] += -step if values[index] + step > parameter.high else step
                    new = self._value(moved, conditions, quantity)
                    found[row, 1 + index] = (new - base) / (moved[index] - values[index])
            except LambdaError:
                found[row] = math.nan
        return found

    def _stacked(self, values: FloatArray, conditions: Sequence[dict[str, float]], *, one: bool = False) -> FloatArray:
        asked = [Asked(self._changes(at), names) for at, names in zip(conditions, self._asked, strict=True)]
        answers: list[dict[str, float]] = []
        lost: dict[int, SolverError] = {}
        for row, found in enumerate(self._solved(values, asked, one=one)):
            if isinstance(found, SolverError):
                lost[row] = found
            elif isinstance(found, LambdaError):
                raise at_line(found, self.measurements.name, self.measurements.lines[row]) from None
            answers.append(
                {} if isinstance(found, LambdaError) else dict(zip(self._asked[row], found.tolist(), strict=True))
            )
        if lost:
            raise RowsWithoutSolution(self.measurements, lost)
        return np.array([answers[entry.row][entry.quantity] for entry in self.entries])

    def _changes(self, conditions: dict[str, float]) -> tuple[str, ...]:
        """Return the changes at one operating point.

        They change the case.
        """
        return tuple(condition_change(self.measurements.set_by[name], value) for name, value in conditions.items())

    def _value(self, values: FloatArray, conditions: dict[str, float], quantity: str) -> float:
        """Return a quantity at one operating point and one position."""
        (found,) = self._solved(values, [Asked(self._changes(conditions), (quantity,))], one=True)
        if isinstance(found, LambdaError):
            raise found
        return float(found[0])

    def _solved(self, values: FloatArray, asked: Sequence[Asked], *, one: bool) -> Iterator[FloatArray | LambdaError]:
        """Yield the quantities at operating points.

        Equal points are computed once.
        """
        numbers = values.tolist()
        kinds = ("all", "one") if one else ("all",)

        def known(row: Asked) -> Solved | None:
            keys = ((kind, *row.changes, *numbers, *row.names) for kind in kinds)
            return next((self._known[key] for key in keys if key in self._known), None)

        missing = [row for row in dict.fromkeys(asked) if known(row) is None]
        parameters = list(zip(self.varied, numbers, strict=True))
        wrong: dict[Asked, LambdaError] = {}
        # the answers end with the first mistake of the case
        for row, found in zip(missing, self._rows.solve(parameters, missing, one=one), strict=False):
            if isinstance(found, LambdaError):
                wrong[row] = found
            else:
                self._known[kinds[-1], *row.changes, *numbers, *row.names] = found
        for row in asked:
            if row in wrong:
                yield wrong[row]
                if not isinstance(wrong[row], SolverError):
                    return
                continue
            answer = known(row)
            assert answer is not None  # rows before the first mistake are solved
            yield answer.values[: 1 if one else None].mean(axis=0)


def _refuse_twice(varied: Sequence[Graded], measurements: Measurements) -> None:
    """Refuse a parameter that is set twice.

    It is named twice, or a column sets it.
    """
    columns = {condition.path: name for name, condition in measurements.set_by.items()}
    for index, graded in enumerate(varied):
        if graded.path in columns:
            raise UsageError(
                f'--vary {graded.path}: the column "{columns[graded.path]}" of {measurements.name} sets it; '
                "leave one of the two out"
            )
        if any(graded.path == other.path for other in varied[:index]):
            raise UsageError(f"--vary {graded.path} is given twice: leave one out")


def _refuse_zeros(measurements: Measurements, subject: Subject) -> None:
    """Refuse measured sizes of zero, whose relative errors mean nothing."""
    for name, values in measurements.measured.items():
        known = subject.words.measured[name]
        if known.is_signed or known.quantity == "temperature":
            continue
        for row in np.flatnonzero(values == 0.0)[:1]:
            raise UsageError(
                f"{measurements.name} line {measurements.lines[row]}: {name} is 0: a fit needs values above 0; "
                "remove the line"
            )


def _parameter(graded: Graded) -> Parameter:
    value = graded.value if math.isfinite(graded.value) else 0.5 * (graded.low + graded.high)
    return Parameter(graded.short, min(max(value, graded.low), graded.high), graded.low, graded.high)

"""Predict measured quantities of one bearing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.changed import is_of_laws, with_value_of_laws
from lambda_core.analysis.band.graded import Graded
from lambda_core.analysis.band.quantities import STIFFNESS, TEMPERATURES, Condition, stiffness_reading
from lambda_core.analysis.band.readings import READ, computed_temperature, read_values
from lambda_core.analysis.thermal.temperatures import ready_model
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, LambdaError, SolverError, UsageError
from lambda_core.domain.units import UNITS, from_si
from lambda_core.domain.written_values import DIGITS
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.near_equilibrium import Beginning, beginning, solve_near
from lambda_core.studies.job import kernels_of, resolve_point

if TYPE_CHECKING:
    from lambda_core.model.roller_case import RollerModel

_KEPT = 1024  # points; each takes 100 kB


def condition_change(condition: Condition, value: float) -> str:
    """Return the change that sets an operating condition.

    It changes the case; the condition is in SI.
    """
    unit = next(iter(UNITS[condition.quantity]))
    return f"{condition.path}={from_si(value, condition.quantity, unit):.{DIGITS}g} {unit}"


def point_values(case_toml: str, changes: Sequence[str], names: Sequence[str], *, one: bool = False) -> FloatArray:
    """Return measured quantities as predicted.

    A case predicts them at several positions of the balls.

    Parameters
    ----------
    names : sequence of str
        Keys of `quantities.MEASURED`; the numbers have the units of that table.
    one : bool
        Solve the first position only: enough for slopes.

    Returns
    -------
    float64[:, :], shape (positions, len(names))
        Their mean is the prediction; one row where the position of the balls does not matter.

    Raises
    ------
    CaseError, SolverError
        When the case is not valid with these changes, or has no equilibrium.
    """
    return _Point(ready_model(resolve_point(case_toml, tuple(changes), is_static=True), is_static=True)).values(
        names, one=one
    )


class OperatingPoints:
    """Predictions with changing parameters of laws.

    They are those of a case; the rest of each operating point is resolved once.

    Each prediction is searched from the equilibrium of the case's own laws at its point, never from that of the
    prediction before: equal parameters have equal predictions.

    Parameters
    ----------
    case_toml : str
        The case.
    """

    def __init__(self, case_toml: str) -> None:
        self._toml = case_toml
        self._points: dict[tuple[str, ...], _Point] = {}

    def values(
        self, changes: Sequence[str], parameters: Sequence[tuple[Graded, float]], names: Sequence[str], *, one: bool
    ) -> FloatArray:
        """Return measured quantities under changes.

        The changes are of the case and of other parameters; see :func:`point_values`.
        """
        options = [
            change for graded, number in parameters if not is_of_laws(graded) for change in graded.changes(number)
        ]
        point = self._point((*changes, *options))
        if point is None:  # temperatures follow the losses
            every = [change for graded, number in parameters for change in graded.changes(number)]
            return point_values(self._toml, (*changes, *every), names, one=one)
        model = point.model
        for graded, number in parameters:
            if is_of_laws(graded):
                model = with_value_of_laws(model, graded, number)
        return point.values(names, model, one=one)

    def _point(self, changes: tuple[str, ...]) -> _Point | None:
        """Return the point with the case's own laws.

        None where their parameters decide its temperatures.
        """
        if changes not in self._points:
            model = resolve_point(self._toml, changes, is_static=True)
            if model.thermal is not None:
                return None
            point = _Point(model)
            if len(self._points) >= _KEPT:  # all rows come by in turn: those that are kept stay
                return point
            self._points[changes] = point
        return self._points[changes]


class _Point:
    """Operating point with its model and equilibria.

    They are the equilibria found so far.
    """

    def __init__(self, model: BearingModel) -> None:
        self.model = model
        self._solved: dict[float, Beginning] = {}

    def values(self, names: Sequence[str], moved: BearingModel | None = None, *, one: bool) -> FloatArray:
        """Return measured quantities as predicted.

        The model, or one that differs only in parameters of laws, predicts them.
        """
        model = self.model if moved is None else moved
        kernels = kernels_of(model)

        def solved(phase: float) -> Equilibrium:
            if phase not in self._solved:
                found = solve(self.model, kernels, phase=phase)
                self._solved[phase] = beginning(found)
                if model is self.model:
                    return found
            return solve_near(model, self._solved[phase], kernels)

        return read_values(solved, [READ[name] for name in names], one=one)


ROLLER_QUANTITIES = (
    "friction torque", "power loss", "capacitance", "cage speed", *(f"displacement {axis}" for axis in "xyz"),
    *STIFFNESS,
)  # fmt: skip


def roller_values(model: RollerModel, warm: BearingModel | None, names: Sequence[str]) -> FloatArray:
    """Return measured quantities of a roller bearing.

    The bearing's model predicts them, and `warm` has its computed temperatures; a quantity that it lacks raises a
    UsageError.
    """
    from lambda_core.results.roller_quasistatic import roller_answer, solve_rollers

    solved = solve_rollers(model)
    found = roller_answer(model, solved)
    torque, speed = found.friction_torque_Nmm, abs(model.speeds[0] - model.speeds[1])
    values: dict[str, float] = {}
    if torque is not None:
        values |= {"friction torque": torque, "power loss": 1e-3 * torque * speed}
    if found.bearing_capacitance_nF is not None:
        values["capacitance"] = found.bearing_capacitance_nF
    values |= {f"displacement {axis}": found.inner_ring_displacement_um[i] for i, axis in enumerate("xyz")}
    matrix = np.mean([state.stiffness for state in solved.states], axis=0)
    values |= {name: stiffness_reading(name, matrix.tolist()) for name in STIFFNESS}
    if warm is not None:
        values |= {name: computed_temperature(warm, name) for name in names if name in TEMPERATURES}
    if found.orbit_speed_ratio is not None:
        values["cage speed"] = abs(30.0 / math.pi * found.orbit_speed_ratio * model.speeds[0])
    missing = [name for name in names if name not in values]
    if missing:
        raise UsageError(f"{model.name}: a roller bearing at this point has no {missing[0]}: {', '.join(values)}")
    return np.array([values[name] for name in names])


def at_line(error: LambdaError, file: str, line: int) -> LambdaError:
    """Return an error with its file's line.

    It is an error of one operating point.
    """
    message = f"{file} line {line}: {error}"
    if isinstance(error, CaseError):
        return CaseError(f"{file} line {line}: {error.source}", error.problems)
    return SolverError(message) if isinstance(error, SolverError) else UsageError(message)

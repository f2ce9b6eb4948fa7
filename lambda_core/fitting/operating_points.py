"""Quasi-static predictions of measured quantities at operating points of one bearing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.band.quantities import Condition
from lambda_core.analysis.band.readings import READ, read_values
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError, LambdaError, SolverError, UsageError
from lambda_core.domain.units import UNITS, from_si
from lambda_core.domain.written_values import DIGITS
from lambda_core.model.bearing_model import BearingModel
from lambda_core.studies.job import kernels_of, resolve_point, with_temperatures

if TYPE_CHECKING:
    from lambda_core.model.roller_case import RollerModel


def condition_change(condition: Condition, value: float) -> str:
    """Return the change of the case that sets an operating condition, from SI."""
    unit = next(iter(UNITS[condition.quantity]))
    return f"{condition.path}={from_si(value, condition.quantity, unit):.{DIGITS}g} {unit}"


def point_values(case_toml: str, changes: Sequence[str], names: Sequence[str], *, one: bool = False) -> FloatArray:
    """Return measured quantities as a case predicts them at several positions of the balls.

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
    model = with_temperatures(resolve_point(case_toml, tuple(changes)))
    return model_values(model, names, one=one)


def model_values(model: BearingModel, names: Sequence[str], *, one: bool = False) -> FloatArray:
    """Return measured quantities as a resolved model predicts them; see :func:`point_values`."""
    return read_values(model, kernels_of(model), [READ[name] for name in names], one=one)


def roller_values(model: RollerModel, names: Sequence[str]) -> FloatArray:
    """Return measured quantities as a roller bearing predicts them; UsageError for one that it does not have."""
    from lambda_core.results.roller_quasistatic import roller_quasistatic

    found = roller_quasistatic(model)
    torque, speed = found.friction_torque_Nmm, abs(model.speeds[0] - model.speeds[1])
    values: dict[str, float] = {}
    if torque is not None:
        values |= {"friction torque": torque, "power loss": 1e-3 * torque * speed}
    values |= {f"displacement {axis}": found.inner_ring_displacement_um[i] for i, axis in enumerate("xyz")}
    missing = [name for name in names if name not in values]
    if missing:
        raise UsageError(f"{model.name}: a roller bearing at this point has no {missing[0]}: {', '.join(values)}")
    return np.array([values[name] for name in names])


def at_line(error: LambdaError, file: str, line: int) -> LambdaError:
    """Return an error of one operating point with the line of the file it belongs to."""
    message = f"{file} line {line}: {error}"
    if isinstance(error, CaseError):
        return CaseError(f"{file} line {line}: {error.source}", error.problems)
    return SolverError(message) if isinstance(error, SolverError) else UsageError(message)

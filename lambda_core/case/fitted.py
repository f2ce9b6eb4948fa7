"""Declare where the fitted values of a case come from."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from pydantic import ValidationError, model_validator

from lambda_core.case.option import Section, option

_ROUNDING = 1e-5  # of a correlation in a file, which has six digits


class FittedValue(Section):
    """One value of a fit.

    A value that the data do not determine has the spread of its range.
    """

    path: str = option(description="option of the case")
    value: float = option(description="fitted value in `unit`")
    standard_error: float = option(description="standard deviation in `unit`", ge=0.0)
    unit: str = option("", "unit of both; empty for plain numbers")
    range: list[float] = option([], "ends of the range of a value that the data do not determine", max_length=2)


class MeasuredRow(Section):
    """One measured value of a fit, stored on request."""

    line: int = option(description="of the file of measurements", ge=1)
    conditions: str = option("", "operating conditions of the point")
    quantity: str = option(description="what was measured")
    value: float = option(description="measured value in `unit`")
    error: float = option(description="its standard deviation in the fit, in `unit`", ge=0.0)
    unit: str = option("", "unit of both")


class FitOrigin(Section):
    """Origin of the fitted values of a case.

    The command fit writes it.
    """

    file: str = option(description="name of the file of measurements")
    sha256: str = option(description="hash of its content")
    date: str = option(description="when the fit was made")
    count: int = option(description="number of measured values", ge=1)
    parameters: list[FittedValue] = option([], "the fitted values")
    correlation: list[list[float]] = option([], "correlation of the fitted values, in their order")
    measured: list[MeasuredRow] = option([], "measured values; only where the fit was asked to store them")
    complete: bool = option(True, "false: the fit was interrupted, and bands take the ranges, not its errors")

    @model_validator(mode="after")
    def _has_all_correlations(self) -> FitOrigin:
        count = len(self.parameters)
        if [len(row) for row in self.correlation] != [count] * count:
            raise ValueError(f"correlation needs {count} rows of {count} numbers: one for each of the fitted values")
        matrix = np.array(self.correlation).reshape(count, count)
        is_symmetric = np.allclose(matrix, matrix.T, atol=_ROUNDING) and np.allclose(np.diag(matrix), 1.0)
        if not is_symmetric or np.linalg.eigvalsh(matrix).min(initial=0.0) < -count * _ROUNDING:
            raise ValueError(
                "correlation is no correlation matrix: it needs 1 on its diagonal, equal numbers on both sides of it, "
                "and no negative eigenvalue"
            )
        return self


def finished_fit(fit: FitOrigin | None) -> FitOrigin | None:
    """Return a fit whose errors hold; None after an interruption."""
    return fit if fit is not None and fit.complete else None


def fit_of_part(fit: object, place: Callable[[str], str]) -> dict[str, Any]:
    """Return the table `fit` of a machine's part.

    It has the values of this part; it is empty where the part has none or `fit` is wrong.

    Errors and correlations of these values are the same whatever the others are: a marginal distribution.

    Parameters
    ----------
    fit : object
        Plain table of the machine.
    place : callable
        Where in the case of the part stands what stands at a path of the machine; empty where it is not there.
    """
    try:
        known = FitOrigin.model_validate(fit)
    except ValidationError:
        return {}
    kept = [i for i, row in enumerate(known.parameters) if place(row.path)]
    if not kept:
        return {}
    rows = [{**known.parameters[i].model_dump(), "path": place(known.parameters[i].path)} for i in kept]
    matrix = [[known.correlation[i][j] for j in kept] for i in kept]
    return {"fit": {**known.model_dump(), "parameters": rows, "correlation": matrix}}

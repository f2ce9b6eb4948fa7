"""Declare the section that says where fitted values of a case come from."""

from __future__ import annotations

from lambda_core.case.option import Section, option


class FittedValue(Section):
    """One value of a fit; one that the data do not determine has the spread of its range."""

    path: str = option(description="option of the case")
    value: float = option(description="fitted value in `unit`")
    standard_error: float = option(description="standard deviation in `unit`", ge=0.0)
    unit: str = option("", "unit of both; empty for plain numbers")
    range: list[float] = option([], "ends of the range of a value that the data do not determine", max_length=2)


class FitOrigin(Section):
    """Where fitted values of a case come from; written by the command fit."""

    file: str = option(description="name of the file of measurements")
    sha256: str = option(description="hash of its content")
    date: str = option(description="when the fit was made")
    count: int = option(description="number of measured values", ge=1)
    parameters: list[FittedValue] = option([], "the fitted values")
    correlation: list[list[float]] = option([], "correlation of the fitted values, in their order")

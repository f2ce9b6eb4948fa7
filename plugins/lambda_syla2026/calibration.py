"""Fit tau_e on one row of Table 4.

It predicts the other row, by runs and for every law of two terms.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import product

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.results.record import Record
from lambda_syla2026 import parameters as P
from lambda_syla2026.job_runner import Job, JobResult, JobRunner
from lambda_syla2026.published import LOADS, POINTS, Point, mean_absolute_error
from lambda_syla2026.readings import TAU_GRID, torque_at

TAU = "parameters.traction.tau_eyring"
OVER_TAU = "friction over tau_e"  # a reading
BAND = (5.0, 95.0)  # percentiles
# The two terms whose laws differ most, the blind law of each first.
ROLES = ("elastic_hysteresis", "rolling_resistance")


class Calibration(Record):
    """Fit of tau_e on one row of the table.

    It predicts the other row.
    """

    elastic_hysteresis: str
    rolling_resistance: str
    fitted_on: str
    unfitted_pct: float = Field(description="error of all six points with these laws and the blind tau_e, quasi-static")
    tau_e_MPa: float = Field(description="within the published 4 to 8 MPa")
    at_limit: bool
    free_tau_e_MPa: float = Field(
        description="where the fit would end without the published limits, between 4 and 12 MPa; used for nothing"
    )
    torque_Nmm: list[float]
    simulated: bool = Field(description="by runs; otherwise quasi-static plus the blind runs' difference")
    six_points_pct: float
    fitted_row_pct: float
    predicted_row_pct: float


def torques(answers: Sequence[JobResult]) -> list[float]:
    """Return the torque of every answer [N mm]."""
    return [answer["torque"] for answer in answers]


def over_tau(answers: Sequence[JobResult]) -> FloatArray:
    """Return torques by tau_e and point [N mm]."""
    return np.array([[answer[torque_at(tau)] for answer in answers] for tau in TAU_GRID])


def laws_of(role: str) -> list[str]:
    """Return the laws of a role without user constants.

    Only registered laws count; the blind one comes first.

    Without rolling resistance there is nothing to compare, so "none" counts for hysteresis only.
    """
    from lambda_core.discovery.api import registry

    blind = P.entry(f"models.{role}").value
    names = [
        name
        for name, law in registry().models(role).items()
        if law.contact != "line" and not any(field.is_required() for field in law.parameters.model_fields.values())
    ]
    left_out = {blind} | ({"none"} if role == "rolling_resistance" else set())
    return [blind, *(name for name in names if name not in left_out)]


def by_law(runner: JobRunner, offset: FloatArray) -> list[Calibration]:
    """Fit for every pair of laws on either row.

    Quasi-static plus what the blind runs add to it.

    Parameters
    ----------
    offset : float64[:], shape (6,)
        Torque of the blind runs less the quasi-static one [N mm].
    """
    pairs = list(product(*(laws_of(role) for role in ROLES)))
    jobs = [Job(point.case, P.changes(_chosen(pair)), OVER_TAU) for pair in pairs for point in POINTS]
    answers = runner.all(jobs)
    grids = [over_tau(answers[i : i + len(POINTS)]) + offset for i in range(0, len(answers), len(POINTS))]
    return [_on_curve(pair, grid, load) for pair, grid in zip(pairs, grids, strict=True) for load in LOADS]


def _chosen(pair: tuple[str, ...]) -> dict[str, str | None]:
    """Return the replacements for a pair of laws.

    None where both are the blind ones.
    """
    found: dict[str, str | None] = {}
    for role, name in zip(ROLES, pair, strict=True):
        if name != P.entry(f"models.{role}").value:
            found |= P.with_law(role, name)
    return found


def band(table: FloatArray) -> tuple[list[float], list[float]]:
    """Return 5 % and 95 % of each point's samples.

    Only samples that have a result count.

    Parameters
    ----------
    table : float64[:, :], shape (samples, 6)
        Torques [N mm]; NaN where there is none.
    """
    columns = [column[np.isfinite(column)] for column in table.T]
    ends = [np.percentile(column, BAND).tolist() if column.size else [math.nan, math.nan] for column in columns]
    return [low for low, _ in ends], [high for _, high in ends]


def spline(grid: FloatArray) -> Callable[[float], FloatArray]:
    """Return the torque of each point over tau_e [MPa].

    NaN where a value of the grid is missing.
    """
    from scipy.interpolate import CubicSpline

    known = np.isfinite(grid).all(axis=0)
    curve = CubicSpline(TAU_GRID, np.where(known, grid, 0.0))
    return lambda tau: np.where(known, curve(tau), math.nan)


def _on_curve(pair: tuple[str, ...], grid: FloatArray, load: str) -> Calibration:
    fit, curve = fitted(grid, load), spline(grid)
    unfitted = mean_absolute_error(curve(float(P.entry(TAU).value.split()[0])).tolist())
    return calibration(pair, load, unfitted, fit, curve(fit[0]).tolist())


def by_runs(fit: Calibration, load: str, row: list[float]) -> Calibration:
    """Return a calibration with torques of runs.

    The runs use its tau_e.
    """
    pair = (fit.elastic_hysteresis, fit.rolling_resistance)
    tau = (fit.tau_e_MPa, fit.at_limit, fit.free_tau_e_MPa)
    return calibration(pair, load, fit.unfitted_pct, tau, row, simulated=True)


def fitted(grid: FloatArray, load: str) -> tuple[float, bool, float]:
    """Return tau_e [MPa] fitted on the points of one load.

    Also return whether it is at a limit, and the free optimum.

    Least squares of the relative errors, on a spline through the grid.

    Parameters
    ----------
    grid : float64[:, :], shape (len(TAU_GRID), 6)
        Torque at each tau_e of the grid and each point [N mm].
    """
    from scipy.optimize import minimize_scalar

    mine = [i for i, point in enumerate(POINTS) if point.load == load and np.isfinite(grid[:, i]).all()]
    if not mine:
        return math.nan, False, math.nan
    curve = spline(grid[:, mine])
    measured = np.array([POINTS[i].measured for i in mine])

    def misfit(tau: float) -> float:
        return float(np.sum((curve(tau) / measured - 1.0) ** 2))

    def best(low: float, high: float) -> float:
        return float(minimize_scalar(misfit, bounds=(low, high), method="bounded", options={"xatol": 1e-4}).x)

    low, high = (float(end.split()[0]) for end in P.entry(TAU).range)
    tau = round(best(low, high), 2)
    return tau, tau in (low, high), best(TAU_GRID[0], TAU_GRID[-1])


def calibration(
    pair: tuple[str, ...],
    load: str,
    unfitted: float,
    fit: tuple[float, bool, float],
    row: list[float],
    *,
    simulated: bool = False,
) -> Calibration:
    """Combine a fit, its six torques and their errors."""

    def error(keep: list[Point]) -> float:
        chosen = [(value, point) for value, point in zip(row, POINTS, strict=True) if point in keep]
        return mean_absolute_error([value for value, _ in chosen], tuple(point for _, point in chosen))

    own = [point for point in POINTS if point.load == load]
    return Calibration(
        **dict(zip(ROLES, pair, strict=True)),
        unfitted_pct=unfitted,
        fitted_on=f"C/P = {load.removeprefix('cp')}",
        tau_e_MPa=fit[0],
        at_limit=fit[1],
        free_tau_e_MPa=fit[2],
        torque_Nmm=row,
        simulated=simulated,
        six_points_pct=mean_absolute_error(row),
        fitted_row_pct=error(own),
        predicted_row_pct=error([point for point in POINTS if point not in own]),
    )

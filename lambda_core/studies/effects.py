"""Estimate the effect of each study parameter on a response."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from lambda_core.views.method import NotApplicable
from lambda_core.views.table import Column, StudyTable

_CONFIDENCE = 0.95
_POINTS_PER_PARAMETER = 3  # least points of a regression, per parameter


@dataclass(frozen=True)
class Sensitivity:
    """Sensitivities of one response.

    Attributes
    ----------
    kind : str
        ``sobol``: first-order and total indices of a Saltelli design; ``regression``: standardised regression
        coefficients and Spearman's rank correlations.
    names : pair of str
        What `first` and `second` are.
    fit : float, optional
        Share of the variance that the linear regression explains (R^2).
    """

    response: str
    kind: Literal["sobol", "regression"]
    parameters: tuple[str, ...]
    labels: tuple[str, ...]
    names: tuple[str, str]
    first: tuple[float, ...]
    second: tuple[float, ...]
    first_range: tuple[tuple[float, float], ...] | None = None
    second_range: tuple[tuple[float, float], ...] | None = None
    fit: float | None = None
    notes: tuple[str, ...] = ()


def sensitivities(table: StudyTable, response: str) -> Sensitivity:
    """Return how much each parameter decides a response.

    Sobol' indices need a study of design "saltelli" whose points all have a result (estimators of Saltelli et al. 2010,
    Comput. Phys. Commun. 181, 259, in scipy.stats.sobol_indices); any other study gets a linear regression in
    standardised variables and rank correlations (Saltelli et al., Global Sensitivity Analysis (2008), ch. 1).

    Raises
    ------
    NotApplicable
        When fewer than two numeric parameters vary, or there are too few points.
    """
    column = table.response(response)
    varied = [c for c in table.parameters if c.numeric and len(set(c.values)) > 1]
    if not varied:
        raise NotApplicable("no numeric parameter varies in this study")
    if len(varied) == 1:
        raise NotApplicable(
            f"{varied[0].label} alone varies: there is nothing to weigh it against (study-curves shows the response)"
        )
    if table.design == "saltelli" and np.isfinite(column.numbers()).all():
        return _sobol(table, column, varied)
    return _regression(table, column, varied)


def _sobol(table: StudyTable, column: Column, varied: list[Column]) -> Sensitivity:
    from scipy.stats import sobol_indices

    dimensions = len(table.parameters)
    n = len(table) // (dimensions + 2)
    values = column.numbers()
    if np.ptp(values) == 0.0:
        raise NotApplicable(f"{column.name} does not vary in this study")
    # A, B, then A with column i from B for each i.
    parts: Any = {
        "f_A": values[None, :n],
        "f_B": values[None, n : 2 * n],
        "f_AB": values[2 * n :].reshape(dimensions, 1, n),
    }
    found = sobol_indices(func=parts, n=n)
    spread = found.bootstrap(confidence_level=_CONFIDENCE)
    first, total = np.ravel(found.first_order), np.ravel(found.total_order)

    def ends(interval: object) -> tuple[tuple[float, float], ...]:
        low, high = (np.ravel(getattr(interval, name)) for name in ("low", "high"))
        return tuple((float(a), float(b)) for a, b in zip(low, high, strict=True))

    return Sensitivity(
        column.name,
        "sobol",
        tuple(c.name for c in varied),
        tuple(c.label for c in varied),
        ("first order", "total"),
        tuple(first.tolist()),
        tuple(total.tolist()),
        ends(spread.first_order.confidence_interval),
        ends(spread.total_order.confidence_interval),
    )


def _regression(table: StudyTable, column: Column, varied: list[Column]) -> Sensitivity:
    from scipy.stats import spearmanr

    values = column.numbers()
    inputs = np.stack([c.numbers() for c in varied], axis=1)
    known = np.isfinite(values)
    values, inputs = values[known], inputs[known]
    if values.size < max(_POINTS_PER_PARAMETER * len(varied), 3):
        raise NotApplicable(f"{values.size} points with a result are too few for {len(varied)} sensitivities")
    spread = values.std()
    if spread <= 1e-12 * abs(values.mean()):
        raise NotApplicable(f"{column.name} does not vary in this study")
    if (inputs.std(axis=0) == 0.0).any():
        raise NotApplicable("too few points have a result: a parameter does not vary among them")
    scaled = (inputs - inputs.mean(axis=0)) / inputs.std(axis=0)
    target = (values - values.mean()) / spread
    solution, _, rank, _ = np.linalg.lstsq(scaled, target, rcond=None)
    if rank < len(varied):
        raise NotApplicable("parameters vary in step, so their effects cannot be separated; vary them independently")
    rest = target - scaled @ solution
    ranks = [float(spearmanr(inputs[:, i], values).statistic) for i in range(len(varied))]
    missing = int((~known).sum())
    return Sensitivity(
        column.name,
        "regression",
        tuple(c.name for c in varied),
        tuple(c.label for c in varied),
        ("standardised regression", "rank correlation"),
        tuple(float(value) for value in solution),
        tuple(ranks),
        fit=1.0 - float(rest @ rest) / float(target @ target),
        notes=(f"{missing} points without a result are left out",) if missing else (),
    )

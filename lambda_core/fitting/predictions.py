"""Compute bands of predicted values."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.log_sentences import SOLVER, gathered
from lambda_core.fitting.discrepancy import Place, Prediction, coordinates, predict, sizes_known_before
from lambda_core.fitting.least_squares import Fit
from lambda_core.fitting.problem import CaseProblem
from lambda_core.fitting.shared_errors import LEAST_OWN
from lambda_core.fitting.uncertainty import huber_weights


def discrepancy_sizes(problem: CaseProblem, values: FloatArray, predicted: FloatArray) -> dict[str, float]:
    """Return the possible relative errors of laws.

    The keys are quantities; a size is the model band of all that is not fitted.

    0 where nothing that has a range changes the quantity.

    Parameters
    ----------
    values : float64[:], shape (p,)
        Fitted parameters.
    predicted : float64[:], shape (n,)
        Values of the problem's points by them.
    """
    kinds = [entry.quantity for entry in problem.entries]

    def effects_at(row: int) -> dict[str, float]:
        return dict.fromkeys(kinds, 0.0) | problem.law_deviations(row, values)

    try:
        with gathered(SOLVER):  # sentences about its points are known from their rows
            return sizes_known_before(effects_at, predicted, kinds)
    except LambdaError:  # no solution there with fitted values
        return dict.fromkeys(kinds, 0.0)


def predicted(
    problem: CaseProblem, found: Fit, sizes: dict[str, float], asked: CaseProblem | None = None
) -> tuple[FloatArray, Prediction]:
    """Predict points, by default those that were fitted.

    Errors in common count for both: with the same instruments, what the fitted points say of them holds for new ones.

    Returns
    -------
    tuple of (float64[:], Prediction)
        Values by the fitted parameters alone; with all errors, those of a new measurement included.
    """
    everywhere = coordinates([*problem.conditions_of_entries(), *(asked or problem).conditions_of_entries()])
    count, errors = len(problem.entries), found.errors * found.scale
    # An outlier counts as little here as in the fit.
    inflation = 1.0 / np.sqrt(huber_weights(found.standardised, found.limit))
    common = there_common = problem.parts(found.values)[1]
    at = _place(problem, found.predicted, found.jacobian, everywhere[:count], sizes)
    if asked is None:
        new, there = errors, _place(problem, found.predicted, found.jacobian, everywhere[count:], sizes)
    else:
        values, slopes = asked.predict(found.values), asked.jacobian(found.values)
        if any(entry.quantity not in sizes for entry in asked.entries):
            sizes = discrepancy_sizes(asked, found.values, values) | sizes
        there = _place(asked, values, slopes, everywhere[count:], sizes)
        own = own_errors(asked, found, values)
        alone, there_common = asked.parts(found.values)
        new = np.sqrt(own**2 + alone**2 + sum(part**2 for part in there_common.values()))
    known = [name for name in common if name in there_common]
    alike = math.sqrt(1.0 - LEAST_OWN) * inflation  # as in the correlations of the fit
    shared_with = sum((np.outer(alike * common[name], there_common[name]) for name in known), np.zeros(()))
    measured = found.data.values
    prediction = predict(
        found.parameters, found.values, measured, errors * inflation, at, there, new, found.shared, shared_with
    )
    return there.predicted, prediction


def own_errors(asked: CaseProblem, found: Fit, values: FloatArray) -> FloatArray:
    """Return errors of new measured values of their own.

    Where their size is not known it is that of the fit; 0 where only the fit's points have errors.
    """
    if asked.data.is_error_known:
        return asked.data.errors
    return np.zeros_like(values) if found.data.is_error_known else asked.data.absolute(values) * found.scale


def _place(
    problem: CaseProblem, values: FloatArray, slopes: FloatArray, where: FloatArray, sizes: dict[str, float]
) -> Place:
    kinds = tuple(entry.quantity for entry in problem.entries)
    own = np.array([sizes.get(kind, 0.0) for kind in kinds])
    return Place(values, slopes, where, kinds, own)

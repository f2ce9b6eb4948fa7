"""Compute bands of predicted values."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.log_sentences import SOLVER, gathered
from lambda_core.fitting.discrepancy import Place, Prediction, coordinates, predict, sizes_known_before
from lambda_core.fitting.least_squares import Fit
from lambda_core.fitting.problem import CaseProblem
from lambda_core.fitting.uncertainty import huber_weights


def discrepancy_sizes(problem: CaseProblem, found: Fit) -> dict[str, float]:
    """Return the possible relative errors of laws.

    The keys are quantities; a size is the model band of all that is not fitted.

    0 where nothing that has a range changes the quantity.
    """
    kinds = [entry.quantity for entry in problem.entries]

    def effects_at(row: int) -> dict[str, float]:
        return dict.fromkeys(kinds, 0.0) | problem.law_deviations(row, found.values)

    try:
        with gathered(SOLVER):  # sentences about its points are known from their rows
            return sizes_known_before(effects_at, found.predicted, kinds)
    except LambdaError:  # no solution there with fitted values
        return dict.fromkeys(kinds, 0.0)


def predicted(
    problem: CaseProblem, found: Fit, sizes: dict[str, float], asked: CaseProblem | None = None
) -> tuple[FloatArray, Prediction]:
    """Predict points, by default those that were fitted.

    Returns
    -------
    tuple of (float64[:], Prediction)
        Values by the fitted parameters alone; with all errors, those of a new measurement included.
    """
    everywhere = coordinates([*problem.conditions_of_entries(), *(asked or problem).conditions_of_entries()])
    count, errors = len(problem.entries), found.errors * found.scale
    # An outlier counts as little here as in the fit.
    counted = errors / np.sqrt(huber_weights(found.standardised, found.limit))
    at = _place(problem, found.predicted, found.jacobian, everywhere[:count], sizes)
    if asked is None:
        new, there = errors, _place(problem, found.predicted, found.jacobian, everywhere[count:], sizes)
    else:
        values, slopes = asked.predict(found.values), asked.jacobian(found.values)
        there = _place(asked, values, slopes, everywhere[count:], sizes)
        own = asked.data.absolute(values) * (1.0 if asked.data.is_error_known else found.scale)
        new = np.sqrt(own**2 + asked.input_deviations(found.values) ** 2)
    measured = found.data.values
    prediction = predict(found.parameters, found.values, measured, counted, at, there, new, found.shared)
    return there.predicted, prediction


def _place(
    problem: CaseProblem, values: FloatArray, slopes: FloatArray, where: FloatArray, sizes: dict[str, float]
) -> Place:
    kinds = tuple(entry.quantity for entry in problem.entries)
    own = np.array([sizes.get(kind, 0.0) for kind in kinds])
    return Place(values, slopes, where, kinds, own)

"""Check what a fit says of parameters and residuals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.fitting.data import Data
from lambda_core.fitting.least_squares import fit as fit_values
from lambda_core.fitting.parameters import Parameter
from lambda_core.fitting.residual_tests import misfit
from lambda_core.fitting.sentence import sentence


def test_residuals_far_beyond_their_errors_are_told() -> None:
    """Tell a misfit of most points, not one outlier."""
    one = np.array([0.3, -0.5, 0.8, 12.0, -0.2, 0.6])
    assert misfit(one, 1) == 0.0
    assert misfit(np.array([0.5, -1.2, 0.9, 1.4]), 1) == 0.0
    assert misfit(np.array([-21.0, 7.9, 11.0, 9.0]), 1) == pytest.approx(10.0 / 0.6745 * math.sqrt(4 / 3), rel=1e-9)


@pytest.mark.parametrize(
    ("slopes", "said"),
    [
        ((1e-3, 1e-3), "determine none of the parameters mu and tau"),
        ((100.0, 100.0), "determine mu and tau"),
        ((100.0, 25.0), "determine mu; they narrow the range of tau"),
        ((100.0, 12.0), "determine mu; they do not narrow the range of tau: its 95 % interval covers it"),
        ((12.0, 12.0), "do not narrow the ranges of mu and tau: their 95 % intervals cover them"),
        ((100.0, 0.1), "determine mu; they do not determine tau, which has too small an effect and keeps its "
            "start value"),
    ],
)  # fmt: skip
def test_the_interval_of_a_parameter_decides_what_the_data_determine(slopes: tuple[float, float], said: str) -> None:
    """Compare 95 % intervals with ranges.

    The sentence named parameters whose intervals covered their ranges.
    """
    jacobian = np.kron(np.eye(2), np.ones((3, 1))) * np.array(slopes)
    ranges = [Parameter("mu", 0.1, 0.0, 0.2), Parameter("tau", 0.1, 0.0, 0.2)]
    found = fit_values(lambda values: jacobian @ values, ranges, Data(jacobian @ np.full(2, 0.1), np.ones(6)))
    assert sentence(found) == f"The 6 measured values {said}."


def test_one_parameter_that_data_do_not_determine_has_a_sentence_of_its_own() -> None:
    """Say what the data do not determine.

    It was "none of the parameters" of one.
    """
    data = Data(np.array([10.0, 10.1, 9.9]), np.ones(3))
    found = fit_values(lambda values: 10.0 + 1e-3 * np.repeat(values, 3), [Parameter("mu", 0.1, 0.0, 0.2)], data)
    assert sentence(found) == "The 3 measured values do not determine mu, which keeps its start value."


def test_intervals_hold_for_the_value_of_a_held_parameter() -> None:
    """Name the parameter whose interval depends on the held one.

    The sentence said that the data determine it.
    """
    x, random = np.linspace(1.0, 2.0, 6), np.random.default_rng(1)
    ranges = [Parameter("mu", 0.1, 0.0, 0.2), Parameter("tau", 0.1, 0.0, 0.2)]
    data = Data(20.0 * x + 0.1 * random.standard_normal(6), np.ones(6))
    found = fit_values(lambda values: 100.0 * (values[0] + 1.02 * values[1]) * x, ranges, data)
    (held,) = found.held
    name, other = found.parameters[held].name, found.parameters[1 - held].name
    assert sentence(found).endswith(
        f"{name}, which cannot be separated from {other} and keeps its start value: "
        f"intervals of {other} hold for this value only."
    )

"""Test how a mean and its swing are written."""

from __future__ import annotations

import pytest

from lambda_core.domain.number_text import swinging


@pytest.mark.parametrize(
    ("mean", "swing", "expected"),
    [
        (0.2414, 149.3, "0 ± 149"),  # no exponent, and no digit that the swing covers
        (220.71, 25.4, "221 ± 25"),
        (-251.43, 7.71, "-251.4 ± 7.7"),
        (2977.4, 1.2e-3, "2977 ± 0.0012"),
        (-118.294, 0.0, "-118.3 ± 0"),
        (1e-7, 3e-9, "0 ± 0"),
    ],
)
def test_a_mean_has_the_decimals_of_its_swing(mean: float, swing: float, expected: str) -> None:
    assert swinging(mean, swing) == expected

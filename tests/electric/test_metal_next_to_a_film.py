"""Test the discharge through a ball with one shorted contact."""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core.analysis.electric.events import Events, discharges_of
from lambda_core.results.circuit_rows import DISCHARGES


def events(numbers: list[int], joined: list[bool]) -> Events:
    count = len(numbers)
    values = {channel.name: np.ones(count) for channel in DISCHARGES}
    complete = {name: np.ones(count, dtype=np.int64) for name in ("ball", "ring")}
    values |= complete | {"discharge": np.array(numbers), "joined": np.array(joined), "time": np.arange(count) * 1e-6}
    return Events(**values)


@pytest.mark.parametrize(
    ("numbers", "joined", "through"),
    [
        ([1, 1, 2], [False, False, False], [True, False]),
        ([1, 2, 3], [True, False, True], [True, False, True]),
        ([1, 1, 2, 2], [False, True, False, False], [True, True]),
    ],
)
def test_what_goes_through(numbers: list[int], joined: list[bool], through: list[bool]) -> None:
    assert discharges_of(events(numbers, joined)).through.tolist() == through


def test_rows_say_what_the_other_contact_is() -> None:
    assert [row["other_contact"] for row in events([1, 2], [True, False]).rows()] == ["metal", "film"]


def test_cells_of_a_coarse_map_meet_half_way_on_a_logarithmic_axis() -> None:
    from lambda_plugins.views.panels import _corners

    x, _ = np.meshgrid([1000.0, 10_000.0], [1.0, 2.0, 3.0])
    corners = _corners(x, log=True)
    assert corners.shape == (4, 3)
    np.testing.assert_allclose(corners[0], [1000.0 / 10**0.5, 1000.0 * 10**0.5, 10_000.0 * 10**0.5])
    np.testing.assert_allclose(_corners(x, log=False)[0], [-3500.0, 5500.0, 14_500.0])
    assert _corners(np.array([[1.0, 2.0]]), log=False).shape == (2, 3)

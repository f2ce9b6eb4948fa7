"""Test the convergence of several bearings on a shaft.

A lightly loaded bearing has a weaker criterion.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.model.bearing_model import Solver
from lambda_core.results.averages import COLUMNS, Estimate, Interval
from lambda_core.results.convergence import (
    Window,
    revolutions_wanted,
    shortfalls,
    shortfalls_together,
    torque_together,
)

SOLVER = Solver(
    tolerance=1e-3, duration=0.0, max_duration=2.0, discard_revolutions=1.0, average_revolutions=4.0, max_step=1e-3,
    max_wall=math.inf,
)  # fmt: skip


def known(torque: float, half_width: float, revolutions: int = 6) -> Window:
    """Return a bearing's window.

    With a mean torque and half-width [N m].
    """
    first, last = np.zeros(len(COLUMNS)), np.zeros(len(COLUMNS))
    last[COLUMNS.index("relative_angle")] = 10.0
    last[COLUMNS.index("loss.drag")] = 10.0 * torque
    return Window(Interval(first, last), Estimate(torque, half_width, revolutions), revolutions, 1)


def short(windows: list[Window]) -> list[bool]:
    """Return of each bearing whether anything is short."""
    return [bool(shortfalls(SOLVER, w, 0.0, torque_together(windows))) for w in windows]


def test_a_bearing_with_a_thousandth_of_the_torque_need_not_be_known_to_a_hundredth_of_it() -> None:
    """Accept half-widths of a thousandth of all torque.

    Larger ones are not accepted.
    """
    heavy = known(1.0, 5e-3)
    assert short([heavy, known(1e-3, 9e-4)]) == [False, False]
    assert short([heavy, known(1e-3, 1.1e-3)]) == [False, True]
    assert short([heavy, known(0.05, 1.04e-3)]) == [False, False]  # 2.1 % of its own, 0.99e-3 of 1.05 N m


def test_alone_a_bearing_has_to_be_known_to_a_hundredth_of_its_own_torque() -> None:
    assert shortfalls(SOLVER, known(1e-3, 0.99e-5), 0.0) == []
    (said,) = shortfalls(SOLVER, known(1e-3, 1.1e-5), 0.0)
    assert "known to 1.1 %" in said
    assert "; about " in said  # how many revolutions it takes
    assert said.endswith("at most 1 % is allowed")
    (said,) = shortfalls(SOLVER, known(1e-3, 1.1e-3), 0.0, together=1.0)
    assert said.endswith("at most 1 % is allowed, or 0.1 % of the torque of all bearings")


def test_all_together_are_known_to_a_hundredth() -> None:
    """Limit the sum of all errors to a hundredth.

    Each bearing may have its accepted error, but all together must not.
    """
    small = [known(1e-3, 9.9e-4) for _ in range(3)]
    assert shortfalls_together([known(1.0, 9.5e-3)]) == []
    (said,) = shortfalls_together([known(1.0, 9.5e-3), *small])
    assert said.startswith("the friction torque of all bearings is known to 1.2 %")
    assert shortfalls_together([known(1.0, 5e-3), *small]) == []


def test_without_an_estimate_the_bearing_says_what_is_short() -> None:
    """Name the reason when no estimate exists.

    Before the first complete revolutions there is no half-width, and nothing to add up.
    """
    unknown = known(1.0, math.nan, revolutions=2)
    assert shortfalls_together([unknown, known(1.0, 1e-3)]) == []
    assert short([unknown, known(1.0, 1e-3)]) == [True, False]


def test_the_run_is_planned_for_what_is_wanted() -> None:
    """Keep the planned run short.

    A bearing of little torque does not make it a thousand times longer.
    """
    little = known(1e-3, 5e-4)
    assert revolutions_wanted(SOLVER, little) > 1000
    assert revolutions_wanted(SOLVER, little, together=1.0) == 1 + 4

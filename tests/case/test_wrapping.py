"""Test lines fitted to a terminal.

Parts stay whole, sentences go on below where they began.
"""

from __future__ import annotations

import pytest

from lambda_core.domain.wrapping import HEAD, wrapped

LINES = [
    "friction torque  207.1 ± 0.9 N mm   (95 %, 4 cage revolutions)   converged",
    "  inner   sliding 10.6  spin  4.8  rolling 75.1  hysteresis  3.6  boundary   0.0  damping   0.0",
    "WARNING          the inner ring tilts by 4.1 mrad: deep-groove ball bearings take up to 2.9 mrad (10 arcmin)",
    "short",
]


def test_nothing_changes_without_a_width() -> None:
    assert wrapped(LINES, None) == LINES
    assert wrapped(LINES, 200) == LINES


@pytest.mark.parametrize("width", [60, 80, 100])
def test_no_line_is_longer_and_no_word_is_lost(width: int) -> None:
    found = wrapped(LINES, width)
    assert max(map(len, found)) <= width
    assert " ".join(found).split() == " ".join(LINES).split()


def test_parts_stay_unbroken_and_go_on_below_the_first() -> None:
    found = wrapped(LINES, 80)
    assert found[0] == LINES[0]
    assert "  damping   0.0" in found[2]
    assert found[2].startswith(" " * 9)
    warning = [line for line in found if "mrad" in line]
    assert warning[1].startswith(" " * HEAD)
    assert warning[1][HEAD] != " "

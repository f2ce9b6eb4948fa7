"""Test that power settles with grid and tolerance.

The whole table is docs/convergence.md.
"""

from __future__ import annotations

import pytest

from benchmarks.convergence import CASES, DEFAULT_GRID, DEFAULT_TOLERANCE, PAGE, grid_power, tolerance_power
from lambda_core import api


@pytest.mark.parametrize("case", ["6319-cp10-3000", "6208-axial-1300"])
def test_grid(case: str) -> None:
    """Compare the default grid with five thousand cells.

    It is within 1 %; refining both ways comes closer.
    """
    exact = grid_power(case, 61, 31)
    default, fine = (abs(grid_power(case, *grid) / exact - 1.0) for grid in ((31, 1), (41, 21)))
    assert default < 0.01
    assert fine < 0.003
    assert fine < default


def test_tolerance() -> None:
    """Compare power and steps at a tenth tolerance.

    The default costs 0.1 % of the power at most, a tenth of it a tenth of that; steps grow with it.
    """
    loose, default, tight, exact = (
        tolerance_power("6319-cp10-3000", tolerance, settled=0.01, span=0.02) for tolerance in (1e-2, 1e-3, 1e-5, 1e-6)
    )
    assert abs(default.power / exact.power - 1.0) < 1e-3
    assert abs(tight.power / exact.power - 1.0) < 1e-4
    assert abs(loose.power / exact.power - 1.0) < 1e-2
    assert default.steps < tight.steps < exact.steps
    assert abs(exact.residual) < 0.1 * abs(loose.residual)


def test_the_page_marks_the_defaults_of_the_program() -> None:
    model, text = api.check(CASES[0]), PAGE.read_text()
    assert (model.depth.strips, model.depth.rows) == DEFAULT_GRID
    assert model.solver.tolerance == DEFAULT_TOLERANCE
    assert f"**{model.depth.rows} x {model.depth.strips}** (default)" in text
    assert f"**{model.solver.tolerance:g}** (default)" in text

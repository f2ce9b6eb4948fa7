"""Test the numerical foundations of contact cells.

These are roots without dividing, and rows that begin with a line of the cache.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from lambda_core.solver.drivers.contact_grid import cell_block, contacts_at_once, unit_grid
from lambda_core.solver.vec import inverse_root


def test_inverse_root() -> None:
    for x in np.geomspace(1e-290, 1e290, 5801):
        assert inverse_root.py_func(float(x)) == pytest.approx(1.0 / math.sqrt(x), rel=4.0 * np.finfo(float).eps)
    assert math.isnan(inverse_root.py_func(math.nan))


@pytest.mark.parametrize(("strips", "rows"), [(31, 1), (21, 11), (3, 1)])
def test_every_row_of_cells_begins_with_a_line_of_the_cache(strips: int, rows: int) -> None:
    cells = unit_grid(strips, rows).shape[1]
    assert {row.ctypes.data % 64 for row in cell_block(cells, contacts_at_once(cells))} == {0}

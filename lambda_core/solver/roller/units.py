"""Compile the entry points of rollers at first use."""

from __future__ import annotations

from typing import Any

from lambda_core.solver import row_code
from lambda_core.solver.roller import columns, roller_factors, rows

UNITS: dict[str, tuple[Any, Any]] = {
    "roller_evaluate": (rows.evaluate, row_code.evaluate_sig),
    "roller_jacobian": (columns.jacobian, row_code.jacobian_sig),
    "roller_energy": (rows.energy, row_code.energy_sig),
    "roller_observe": (rows.observe, row_code.observe_sig),
    "roller_shares": (rows.shares, row_code.shares_sig),
    "roller_factor": (roller_factors.factor, row_code.factor_sig),
    "roller_solve": (roller_factors.solve, row_code.solve_sig),
}

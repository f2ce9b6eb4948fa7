"""Check plugins in their authors' tests.

from lambda_core.testing import check_model

def test_contract():
    check_model("traction/hyperbolic-limit")
"""

from __future__ import annotations

from lambda_core.laws.check import ModelReport
from lambda_core.testing.laws import (
    assert_increasing,
    assert_limit,
    assert_symmetric,
    check_model,
    evaluate,
    states_over_time,
)
from lambda_core.testing.trials import method_inputs, run_data

__all__ = [
    "ModelReport",
    "assert_increasing",
    "assert_limit",
    "assert_symmetric",
    "check_model",
    "evaluate",
    "method_inputs",
    "run_data",
    "states_over_time",
]

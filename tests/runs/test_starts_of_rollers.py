"""Test that answers about rollers agree at the start."""

from __future__ import annotations

from pathlib import Path

import pytest

from lambda_core import api

CASE = {
    "name": "rollers",
    "bearing": {"designation": "SKF 32208"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "3 kN", "axial": "2 kN"},
    "operation": {"speed": "3000 rpm"},
    "solver": {"duration": "0.1 ms"},
}


def test_a_case_a_model_an_estimate_and_a_run_give_the_same_numbers(tmp_path: Path) -> None:
    """Compare answers about a tapered bearing.

    The model, behind reports, and the estimate had those of friction between rings; lives of a run left thrust out and
    had their rollers at other places.
    """
    model = api.check(CASE)
    answer = api.quasistatic(CASE)
    assert api.quasistatic(model).to_dict() == answer.to_dict()
    assert api.estimate(CASE).equilibrium.to_dict() == answer.to_dict()
    summary = api.run(CASE, out=tmp_path / "rollers.h5").summary()
    assert summary.rating == answer.rating
    assert summary.equilibrium.loaded_elements == answer.loaded_elements
    assert summary.equilibrium.max_load_N == pytest.approx(answer.max_load_N, rel=1e-3)
    assert summary.equilibrium.max_pressure_GPa == pytest.approx(answer.max_pressure_GPa, rel=1e-3)

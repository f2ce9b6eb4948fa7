"""Test that values at the ends of floats are refused."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.plugin_errors import describe

CASE: dict[str, Any] = {
    "name": "n",
    "bearing": {"designation": "SKF 6208"},
    "lubricant": {"name": "FVA3", "temperature": "60 degC"},
    "operation": {"speed": "3000 rpm"},
    "loads": {"radial": "1 kN"},
    "bodies": {"cage": {"type": "steel-ribbon"}},
}
MATERIAL = {
    "youngs_modulus": "210 GPa", "poisson_ratio": 0.3, "density": "5e-324 kg/m3", "specific_heat": "460 J/(kg K)",
    "thermal_conductivity": "46 W/(m K)",
}  # fmt: skip


def test_a_density_of_almost_nothing_is_refused() -> None:
    with pytest.raises(LambdaError, match=r"materials\.balls\.density.*must be at least 1"):
        api.check({**CASE, "materials": {"balls": MATERIAL}})


@pytest.mark.parametrize(("table", "key"), [("bearing", "designation"), ("bearing", "maker"), ("lubricant", "name")])
def test_names_of_any_length_are_answered_at_once(table: str, key: str) -> None:
    started = time.perf_counter()
    with pytest.raises(LambdaError, match="has 100000 characters, at most 200 are allowed"):
        api.check({**CASE, table: {**CASE[table], key: "6" * 100_000}})
    assert time.perf_counter() - started < 5.0


def test_integers_of_any_length_are_answered(tmp_path: Path) -> None:
    """Answer integers of more than 4300 digits.

    Python does not read them and raised an error of its own.
    """
    with pytest.raises(LambdaError, match="has 5000 characters, at most 200 are allowed"):
        api.check(CASE, [f"bearing.designation={'6' * 5000}"])
    (tmp_path / "long.toml").write_text(f"name = {'6' * 5000}", encoding="utf-8")
    for ask in (api.check, api.draft, api.duty, api.study_check):
        with pytest.raises(LambdaError, match=r"digits"):
            ask(tmp_path / "long.toml")


def test_what_a_plugin_raises_does_nothing_on_a_terminal() -> None:
    found = describe(ValueError("wrong \x1b]0;owned\x07 title"))
    assert "\x1b" not in found
    assert "\\x1b]0;owned\\x07" in found

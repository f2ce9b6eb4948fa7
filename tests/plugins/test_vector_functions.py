"""Test the functions that a compiler vectorises."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from lambda_core import plugins
from lambda_core.laws import vector_math


@pytest.mark.parametrize("name", ["exp", "log", "log1p", "power", "asinh"])
def test_the_door_of_plugins_has_the_vectorising_functions(name: str) -> None:
    assert name in plugins.__all__
    assert getattr(plugins, name) is getattr(vector_math, name)


def test_they_are_those_of_the_c_library() -> None:
    assert plugins.exp(1.5) == pytest.approx(math.exp(1.5), rel=1e-15)
    assert plugins.power(2.0, 0.3) == pytest.approx(2.0**0.3, rel=1e-15)


def test_the_first_law_of_the_page_takes_them() -> None:
    page = (Path(__file__).parents[2] / "docs/plugins.md").read_text(encoding="utf-8")
    first = page.split("```python\n", 1)[1].split("```", 1)[0]
    assert "exp, law, parameter" in first
    assert "from math" not in first

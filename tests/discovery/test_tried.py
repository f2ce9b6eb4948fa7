"""Test that laws are tried out once."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from lambda_core.domain.plugin_errors import PluginError
from lambda_core.laws import tried
from lambda_core.laws.check import check_choice
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.law import Law
from lambda_core.laws.tried import Choice, try_out


class Ratio(BaseModel):
    """One number."""

    ratio: float = 0.07


def rising(slip: Any, p: Any, u_mean: float, par: Any, mu: Any) -> int:
    for i in range(mu.size):
        mu[i] = par.ratio * slip[i] / (slip[i] + 0.01)
    return 1


LAW = Law("boundary_friction", "rising", rising, Ratio, reference="own work", role_api=3, distribution="trials 0.3")


@pytest.fixture
def tries(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Record the laws that are tested.

    Their names, as it happens, in a cache of their own.
    """
    monkeypatch.setenv("LAMBDA_BEARING_CACHE", str(tmp_path))
    found: list[str] = []

    def noted(model: Law, *arguments: Any) -> None:
        found.append(model.name)
        check_choice(model, *arguments)

    monkeypatch.setattr(tried, "check_choice", noted)
    return found


def choice(ratio: float, law: Law = LAW) -> Choice:
    return Choice(law, np.array([ratio]), compile_kernel(law))


def test_what_was_in_order_is_not_tried_again(tries: list[str]) -> None:
    try_out([choice(0.07), choice(0.08)])
    try_out([choice(0.07), choice(0.08)])
    assert tries == ["rising", "rising"]


def test_other_parameters_names_and_declared_errors_are_tried(tries: list[str]) -> None:
    for one in (
        choice(0.07),
        choice(0.08),
        choice(0.07, dataclasses.replace(LAW, errors={2: "too fast"})),
        choice(0.07, dataclasses.replace(LAW, distribution="trials 0.4")),
    ):
        try_out([one])
    assert len(tries) == 4


def test_a_fault_is_told_each_time(tries: list[str]) -> None:
    for _ in range(2):
        with pytest.raises(PluginError, match="allowed: 0 to inf"):
            try_out([choice(0.07), choice(-0.07)])
    assert len(tries) == 4


def test_another_way_of_trying_tries_again(tries: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    try_out([choice(0.07)])
    monkeypatch.setattr(tried, "_trials_key", lambda: "the code that tries laws out was edited")
    try_out([choice(0.07)])
    assert len(tries) == 2


def test_a_cache_that_cannot_be_written_only_costs_time(tries: list[str], tmp_path: Path) -> None:
    one = choice(0.07)
    place = tmp_path / "a file"
    place.touch()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LAMBDA_BEARING_CACHE", str(place))
        try_out([one])
        try_out([one])
    assert len(tries) == 2

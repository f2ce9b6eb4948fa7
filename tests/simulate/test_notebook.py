"""Results in a notebook: they complete, show themselves, and go wherever a path goes."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from fake_engine import FakeEngine, MakeProvenance

from lambda_core import api
from lambda_core.domain.errors import UsageError
from lambda_core.results.reader import Result
from lambda_core.run.loop import run


@pytest.fixture
def result(provenance: MakeProvenance, tmp_path: Path) -> Result:
    return run(FakeEngine(), provenance(duration=0.05), tmp_path / "r.h5")


def test_a_result_completes_and_shows_itself(result: Result) -> None:
    assert {"friction_torque_Nmm", "power_loss_W", "contacts", "to_xarray", "summary"} <= set(dir(result))
    assert repr(result).startswith(f"<Result {result.path}: ")
    assert result.summary().state in repr(result)
    shown = result._repr_html_()
    assert shown.startswith("<pre>")
    assert "friction torque" in shown


def test_a_result_is_taken_where_a_path_is(result: Result) -> None:
    assert api.view(result, "energy-balance").as_dict() == api.view(result.path, "energy-balance").as_dict()
    assert api.view([result], "energy-balance").as_dict() == api.view([result.path], "energy-balance").as_dict()


def test_without_xarray_it_says_which_extra(result: Result, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(UsageError, match=r'extra "data": pip install "lambda-bearing\[data\]"'):
        result.to_xarray()

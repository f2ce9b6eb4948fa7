"""Test that texts in place of lists are refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.domain.errors import UsageError

CASE, CHANGE = "6319-cp10-1500", "loads.radial=5 kN"


@pytest.mark.parametrize(
    "call",
    [
        lambda folder: api.case(CASE, CHANGE),
        lambda folder: api.check(CASE, CHANGE),
        lambda folder: api.quasistatic(CASE, CHANGE),
        lambda folder: api.compare(CASE, CHANGE),
        lambda folder: api.compare(CASE, methods="skf"),
        lambda folder: api.estimate(CASE, CHANGE),
        lambda folder: api.run(CASE, CHANGE, out=folder / "run.h5"),
        lambda folder: api.thermal(CASE, CHANGE),
        lambda folder: api.stribeck(CASE, CHANGE),
        lambda folder: api.electric(CASE, CHANGE),
        lambda folder: api.electric_map(CASE, CHANGE, out=folder / "map.csv"),
        lambda folder: api.iterate(CASE, CHANGE),
        lambda folder: api.export_fmu(CASE, CHANGE, out=folder / "a.fmu"),
        lambda folder: api.fit(CASE, folder / "rows.csv", ["loss_factor"], CHANGE),
        lambda folder: api.init_case("new", path=folder / "new.toml", bearing="SKF 6208", changes=CHANGE),
        lambda folder: api.study(CASE, {"loads.radial": "5 kN"}),
        lambda folder: api.study(CASE, {"loads.radial": ["5 kN"]}, asks="power_loss_W"),
        lambda folder: api.export_fmu(CASE, out=folder / "a.fmu", vary="lubricant.temperature=20..90 degC"),
        lambda folder: api.compare_measured("fag-22220"),
        lambda folder: api.fit(CASE, folder / "rows.csv", "loss_factor"),
    ],
)
def test_one_text_is_refused_where_a_list_is_needed(call: Callable[[Path], object], tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r'".*" is a text, not a list: write'):
        call(tmp_path)
    assert not list(tmp_path.iterdir())


def test_what_is_no_list_is_refused() -> None:
    with pytest.raises(UsageError, match="overrides: must be a list, not int"):
        api.check(CASE, 5)  # type: ignore[arg-type]

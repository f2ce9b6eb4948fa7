"""Test the shafts that a new case starts from."""

from __future__ import annotations

from pathlib import Path

import pytest

from lambda_core import api
from lambda_core.model.machine_templates import SHAFTS


@pytest.mark.parametrize("template", SHAFTS)
def test_a_template_is_a_machine_that_lives_long_enough(template: str, tmp_path: Path) -> None:
    """Solve each template: loads balance, all limits hold.

    Loads and the weight of shaft and inner rings are what the bearings carry along z.
    """
    path = api.init_case("mine", template=template, path=tmp_path / "mine.toml")
    machine, found = api.check(path), api.quasistatic(path)
    assert machine.name == "mine"
    assert not machine.warnings
    assert all(bearing.verdict.met for bearing in found.bearings.values())
    rings = sum(one.model.inner_ring.mass for one in machine.bearings) * machine.gravity[2]
    loads = machine.loads.reshape(-1, 6)[:, 2].sum() + machine.weight.reshape(-1, 6)[:, 2].sum() + rings
    carried = sum(bearing.force_N[2] for bearing in found.bearings.values())
    assert carried == pytest.approx(-loads, rel=1e-5)

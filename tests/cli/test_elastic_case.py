"""Test an elastic ring and cage from init to results."""

from __future__ import annotations

from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.model.checks.operating_limits import operating_warnings
from lambda_core.results.reader import Result
from lambda_core.results.run_text import summary_text


def test_from_init_to_a_picture(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["init", "drive", "--template", "thin-housing"]) == 0
    assert main(["run", "drive.toml", "--duration", "4 ms", "--out", "drive.h5", "--quiet"]) == 5
    found = Result("drive.h5").summary()
    assert [bent.part for bent in found.bent] == ["outer ring", "cage"]
    ring, _ = found.bent
    values = 1e6 * Result("drive.h5")["outer_ring_ovality"]
    assert ring.largest_ovality_um == pytest.approx(values.max(), rel=1e-12)
    assert ring.mean_ovality_um == pytest.approx(values.mean(), rel=1e-12)
    assert "ovality          outer ring" in summary_text(found)
    view = api.view(["drive.h5"], "ring-shape")
    assert [panel.title.split(":")[0] for panel in view.panels] == [
        "outer ring", "cage", "waves of the outer ring", "waves of the cage",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("housing", "load", "told"), [("0 N/m", "20 kN", 1), ("0 N/m", "10 kN", 0), ("1 N/um", "20 kN", 0)]
)
def test_a_ring_that_nothing_backs_under_a_heavy_load(housing: str, load: str, told: int) -> None:
    """Warn about a 6319 with C = 159 kN.

    Above 0.1 C a load is heavy (SKF).
    """
    model = api.check("6319-cp10-1500", [f"elastic.outer_ring.housing_stiffness={housing}", f"loads.radial={load}"])
    assert sum("nothing backs the outer ring" in warning for warning in operating_warnings(model)) == told

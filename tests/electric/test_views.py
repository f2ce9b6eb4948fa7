"""Test views of a run in an electric machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from lambda_core import api
from lambda_core.plugins import NotApplicable

if TYPE_CHECKING:
    from pathlib import Path

    from lambda_core.results.reader import Result


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Result:
    changes = ["loads.axial=0 N", "loads.radial=2 kN", "solver.duration=0.03 s", "electric.seed=3"]
    return api.run("6208-axial-1300", changes, out=tmp_path_factory.mktemp("electric") / "run.h5")


def test_views_show_what_the_outcome_says(run: Result, tmp_path: Path) -> None:
    outcome = api.electric(run.path).outcome
    voltage = api.view(run.path, "bearing-voltage", {"seed": "3"})
    points = voltage.panels[1].series[1]
    assert np.abs(points.y).max() <= max(map(abs, outcome.bearing_voltage_V)) * 1.001
    assert points.y.size >= outcome.discharges
    rose, volts, energies = api.view(run.path, "discharges", {"seed": "3"}).panels
    assert rose.series[1].y[:-1].sum() == pytest.approx(100.0)
    assert volts.series[0].y.sum() == energies.series[0].y.sum() == outcome.discharges
    magnitude = api.view(run.path, "impedance").panels[0].series[0]
    at = float(np.exp(np.interp(np.log(1e4), np.log(magnitude.x), np.log(magnitude.y))))
    assert at == pytest.approx(outcome.impedance_kOhm["10000 Hz"], rel=0.02)
    for path in api.draw(voltage, tmp_path, "x", ("svg",)):
        assert path.stat().st_size > 1000


@pytest.mark.parametrize("name", ["bearing-voltage", "discharges", "impedance"])
def test_without_a_circuit_there_is_nothing_to_show(combined_run: Result, name: str) -> None:
    with pytest.raises(NotApplicable, match="no section electric"):
        api.view(combined_run.path, name)

"""The study files of examples/studies: each is valid, and those that take little time do what they promise."""

from __future__ import annotations

import tomllib
from concurrent.futures import Executor
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api

STUDIES = Path(__file__).parents[2] / "examples" / "studies"
FILES = sorted(STUDIES.glob("*.toml"))


def test_every_file_is_listed() -> None:
    listed = (STUDIES / "README.md").read_text(encoding="utf-8")
    assert len(FILES) >= 4
    assert all(f"`{path.name}`" in listed for path in FILES)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_file_is_a_study(path: Path) -> None:
    estimate = api.study_check(path, workers=2)
    assert estimate.name == path.stem == tomllib.loads(path.read_text(encoding="utf-8"))["name"]
    assert not estimate.warnings
    said = {"friction-map": 500, "what-decides": 384, "cage-stability": 16}
    assert estimate.points == said.get(path.stem, estimate.points)


def test_the_warmest_and_tightest_bearing_lies_on_both_limits(inline: Executor, tmp_path: Path) -> None:
    status = api.study_run(STUDIES / "warm-and-tight.toml", tmp_path / "best", executor=inline)
    best = status.best
    assert best is not None
    assert 3.0 <= best["min_film_parameter"] < 3.0 * 1.003
    assert 1.95 * 0.9995 < best["max_pressure_GPa"] <= 1.95
    # Both limits bind: warmer oil, or a looser bearing, would have less friction and break one of them.
    case = ["lubricant.temperature={t} degC", "bearing.clearance={c} um"]
    here = {"t": best["lubricant.temperature"], "c": best["bearing.clearance"]}

    def solved(**change: float) -> Any:
        return api.quasistatic("6319-cp10-1500", [text.format(**(here | change)) for text in case])

    base = solved()
    assert base.friction_torque_Nmm == pytest.approx(best["friction_torque_Nmm"], rel=1e-9)
    warmer, looser = solved(t=here["t"] + 1.0), solved(c=here["c"] + 1.0)
    assert warmer.friction_torque_Nmm < base.friction_torque_Nmm
    assert warmer.film_parameter[0] < 3.0
    assert looser.friction_torque_Nmm < base.friction_torque_Nmm
    assert looser.max_pressure_GPa > 1.95


@pytest.mark.slow
def test_what_decides_adds_up(tmp_path: Path) -> None:
    """Temperature and load decide the torque, roughness and temperature Lambda, and load the pressure."""
    api.study_run(STUDIES / "what-decides.toml", tmp_path / "sobol", workers=2)
    data = api.view(tmp_path / "sobol", "sensitivity")
    total = {panel.title: panel.series[1].y for panel in data.panels}
    temperature, load, clearance, roughness = total["friction torque"]
    assert temperature > load > 10.0 * clearance
    assert roughness < 0.01
    assert total["smallest Lambda under load"].argmax() == 3
    assert total["largest contact pressure"].argmax() == 1

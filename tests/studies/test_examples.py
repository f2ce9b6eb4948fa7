"""Test the study files that come with the program.

Each is valid, and those that take little time do what they promise.
"""

from __future__ import annotations

import tomllib
from concurrent.futures import Executor
from importlib import resources
from pathlib import Path
from typing import Any

import pytest

from lambda_core import api

ROOT = Path(__file__).parents[2]
STUDIES = Path(str(resources.files("lambda_core.studies"))) / "examples"
FILES = sorted(STUDIES.glob("*.toml"))


def test_every_study_that_comes_with_the_program_is_offered() -> None:
    assert len(FILES) >= 4
    assert list(api.study_examples()) == [path.stem for path in FILES]
    assert all(title for title in api.study_examples().values())
    page = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
    offered = (ROOT / "docs" / "reference" / "cli.md").read_text(encoding="utf-8")
    assert all(f"`{path.stem}`" in page and path.stem in offered for path in FILES)


@pytest.mark.parametrize("name", ["friction-map", "cage-stability"])
def test_a_study_is_started_from_an_example(name: str, tmp_path: Path) -> None:
    case = api.init_case("fan", path=tmp_path / "fan.toml")
    path = api.init_study("mine", name, tmp_path / "mine.toml", case=case.name)
    tables = tomllib.loads(path.read_text(encoding="utf-8"))
    assert (tables["name"], tables["case"]) == ("mine", "fan.toml")
    assert "lambda-bearing study run mine.toml" in path.read_text(encoding="utf-8")
    assert tables["parameters"] == tomllib.loads((STUDIES / f"{name}.toml").read_text(encoding="utf-8"))["parameters"]


def test_a_name_of_an_example_starts_from_it(tmp_path: Path) -> None:
    path = api.init_study("what-decides", path=tmp_path / "what-decides.toml")
    assert path.read_text(encoding="utf-8") == (STUDIES / "what-decides.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("template", ["geared-shaft", "motor-shaft", "tapered-shaft"])
def test_a_machine_starts_from_a_study_of_machines(template: str, tmp_path: Path) -> None:
    """Write a study that the machine has the options for.

    The usual one varies the load of one bearing, which no machine has.
    """
    api.init_case("box", template=template, path=tmp_path / "box.toml")
    path = api.init_study("mine", path=tmp_path / "mine.toml", case="box.toml")
    assert api.study_check(path, workers=2).points == 60
    with pytest.raises(api.UsageError, match=r"box\.toml is a machine: start from machine-map"):
        api.init_study("two", "what-decides", tmp_path / "two.toml", case="box.toml")
    with pytest.raises(api.UsageError, match="machine-map is a study of machines, and 6208-axial-1300 is one bearing"):
        api.init_study("two", "machine-map", tmp_path / "two.toml", case="6208-axial-1300")
    with pytest.raises(api.UsageError, match="neither a file nor a built-in case"):
        api.init_study("two", path=tmp_path / "two.toml", case="bax.toml")


def test_what_cannot_start_a_study_is_told(tmp_path: Path) -> None:
    target = tmp_path / "mine.toml"
    with pytest.raises(
        api.UsageError, match='"friction-mop" is not a known study to start from; nearest: friction-map'
    ):
        api.init_study("mine", "friction-mop", target)
    with pytest.raises(api.CaseError, match="name"):
        api.init_study("a b", path=target)
    assert not target.exists()
    target.write_text("mine", encoding="utf-8")
    with pytest.raises(api.UsageError, match="exists: choose another name"):
        api.init_study("mine", path=target)
    assert target.read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_file_is_a_study(path: Path, tmp_path: Path) -> None:
    if path.stem == "machine-map":
        api.init_case("geared-shaft", template="geared-shaft", path=tmp_path / "geared-shaft.toml")
    study = api.init_study(path.stem, path=tmp_path / path.name)
    estimate = api.study_check(study, workers=2)
    assert estimate.name == path.stem == tomllib.loads(path.read_text(encoding="utf-8"))["name"]
    assert not estimate.warnings
    said = {"friction-map": 500, "what-decides": 384, "cage-stability": 16, "risk-map": 200, "machine-map": 60}
    assert estimate.points == said.get(path.stem, estimate.points)


@pytest.mark.full
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
    """Compare total indices of the example.

    Temperature and load decide the torque, roughness and temperature Lambda, and load the pressure.
    """
    api.study_run(STUDIES / "what-decides.toml", tmp_path / "sobol", workers=2)
    data = api.view(tmp_path / "sobol", "sensitivity")
    total = {panel.title: panel.series[1].y for panel in data.panels}
    temperature, load, clearance, roughness = total["friction torque"]
    assert temperature > load > 10.0 * clearance
    assert roughness < 0.01
    assert total["smallest Lambda under load"].argmax() == 3
    assert total["largest contact pressure"].argmax() == 1

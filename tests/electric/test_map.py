"""Test the map over speed and temperature.

A study with workers, that goes on after a kill to the same bits.
"""

from __future__ import annotations

import csv
import json
import signal
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.analysis.electric.current_numbers import UNITS
from lambda_core.studies.current_map import map_of

if TYPE_CHECKING:
    from conftest import Warm

CASE = "6208-axial-1300"
CHANGES = ["loads.radial=2 kN", "loads.axial=0 N", "electric.duration=4 ms", "electric.seed=7"]
SPAN: dict[str, str] = {"speed": "500 rpm, 4000 rpm", "temperature": "30 degC, 100 degC", "points": "5x2"}
POINTS = 10
PROGRAM = "from lambda_cli.__main__ import program; program()"


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a map that this process computed."""
    folder = tmp_path_factory.mktemp("map") / "alone"
    api.electric_map(CASE, CHANGES, **SPAN, folder=folder, executor="here")
    return folder


def numbers(folder: Path) -> list[dict[str, Any]]:
    return [{name: row[name] for name in (*UNITS, "state")} for row in api.study_table(folder).rows()]


def test_map(capsys: pytest.CaptureFixture[str], tmp_path: Path, alone: Path) -> None:
    """Compare file, answer and study of a map.

    A hot and slow bearing conducts; a point with discharges has a breakdown voltage.
    """
    assert main(["electric-map", str(alone), "--quiet", "--json", "--out", str(tmp_path / "m.csv")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["speeds_rpm"] == pytest.approx([500.0 * 8.0 ** (k / 4) for k in range(5)])
    assert found["temperatures_degC"] == pytest.approx([30.0, 100.0])
    assert (found["seed"], found["simulated_s"]) == (7, 0.004)
    assert found["points"][1]["metal_share"] > 0.1
    films = [point["film_um"] for point in found["points"]]
    assert films[0] > films[1]
    assert films[-2] > films[2] > films[0]
    for point in found["points"]:
        assert (point["breakdown_voltage_V"] is None) == (point["discharges_per_s"] == 0.0)
    rows = list(csv.reader((tmp_path / "m.csv").open()))
    assert rows[0][:2] == ["speed_rpm", "temperature_degC"]
    assert len(rows) == POINTS + 1
    assert [float(row[rows[0].index("film_um")]) for row in rows[1:]] == films == [n["film_um"] for n in numbers(alone)]
    assert main(["electric-map", str(alone), "--quiet", "--draw", str(tmp_path)]) == 0
    text = capsys.readouterr().out
    assert "30 degC" in text
    assert "metal" in text
    assert len(list(tmp_path.glob("*electric-map*"))) == 2
    assert main(["study", "show", str(alone), "--csv"]) == 0
    assert "discharges_per_s [1/s]" in capsys.readouterr().out


def test_picture_says_why_a_point_is_empty(alone: Path) -> None:
    """Name holding films, metal and missing equilibria.

    Each has a mark of its own, and every empty point of a panel has one.
    """
    found = map_of(alone)
    kinds = {"films hold": {"discharges_per_s": 0.0, "metal_share": 0.0}, "metal": {"discharges_per_s": 0.0,
             "metal_share": 0.3}, "no equilibrium": dict.fromkeys(UNITS), "": {"discharges_per_s": 9.0}}  # fmt: skip
    chosen = [*kinds, *([""] * (POINTS - len(kinds)))]
    points = [p.model_copy(update=kinds[kind]) for p, kind in zip(found.points, chosen, strict=True)]
    assert [p.quiet_because for p in points] == chosen
    changed = found.model_copy(update={"points": points})
    density = [p for p in changed.picture().panels if p.title.startswith("current density")]
    assert all(p.field is not None and p.field.levels == (0.1, 0.3, 0.8) for p in density)
    assert any("suspicious" in note for note in changed.picture().notes)
    panel = changed.picture().panels[0]
    assert [s.name for s in panel.series] == ["films hold", "metal", "no equilibrium"]
    assert len({s.group for s in panel.series}) == 3
    assert sum(s.x.size for s in panel.series) == 3
    assert panel.series[1].x[0] == points[1].speed_rpm
    assert [p.name for p in changed.picture().panels[1].series] == ["no equilibrium"]
    cells = changed.text().splitlines()[5].split() + changed.text().splitlines()[6].split()
    assert cells[1:3] == ["0", "metal"]
    assert cells[4] == "-"


def test_points_without_an_answer_are_named(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, alone: Path
) -> None:
    """Name four points and count the others; exit code 5."""
    found = map_of(alone)
    assert "empty" not in found.text()
    lost = {**dict.fromkeys(UNITS), "message": "6208: 1 error\n  operation.speed        no steady motion"}
    points = [p.model_copy(update=lost) if k < 6 else p for k, p in enumerate(found.points)]
    changed = found.model_copy(update={"points": points})
    monkeypatch.setattr(api, "electric_map", lambda *args, **options: changed)
    assert main(["electric-map", CASE, "--quiet"]) == 5
    out, err = capsys.readouterr()
    assert out.count("no steady motion") == 4
    assert "empty            500 1/min at 30 degC: operation.speed no steady motion" in out
    assert "and 2 more: --out and --json name all" in out
    assert "6 of 10 points of the map have no answer" in err


def test_map_in_customary_units(capsys: pytest.CaptureFixture[str], alone: Path) -> None:
    assert main(["electric-map", str(alone), "--quiet", "--units", "us"]) == 0
    text = capsys.readouterr().out
    assert "86 degF" in text
    assert "degC" not in text


def test_point_is_what_the_circuit_of_its_case_gives(alone: Path) -> None:
    """Compare the events of a point with its circuit.

    Three positions of the balls, with the map's seed.
    """
    from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
    from lambda_core.analysis.electric.contacts import contacts_of_equilibria, equilibria
    from lambda_core.analysis.electric.current_numbers import PHASES, numbers_of
    from lambda_core.analysis.electric.simulation import simulate

    model = api.check(CASE, [*CHANGES, "operation.speed=500 rpm", "lubricant.temperature=30 degC"])
    simulation = simulate(contacts_of_equilibria(equilibria(model, PHASES), 0.004), circuit_bearings(model)[0])
    assert simulation.events.time.size > 100
    assert numbers_of(simulation).model_dump() == {name: numbers(alone)[0][name] for name in UNITS}


@pytest.mark.full
def test_any_number_of_workers_gives_the_same_bits(alone: Path, tmp_path: Path) -> None:
    found = api.electric_map(CASE, CHANGES, **SPAN, folder=tmp_path / "two", workers=2)
    assert numbers(tmp_path / "two") == numbers(alone)
    assert found.points == map_of(alone).points
    one = {**SPAN, "points": "1x1"}
    same, other = (api.electric_map(CASE, [*CHANGES[:3], f"electric.seed={n}"], **one, executor="here") for n in (7, 8))
    assert same.points[0] == found.points[0]
    assert other.points[0].film_um == found.points[0].film_um
    assert other.points[0] != found.points[0]


@pytest.mark.full
def test_killed_map_goes_on_to_the_same_bits(alone: Path, tmp_path: Path, warm: Warm) -> None:
    """Kill a map with its workers, then continue it.

    Another command continues with another number of workers.
    """
    folder = tmp_path / "killed"
    options = [part for change in CHANGES for part in ("--set", change)]
    options += [part for name, value in SPAN.items() for part in (f"--{name}", value)]
    # Killed while the first points are kept, half of them: there may be all in one transaction.
    killed = (
        "import os, signal; from lambda_core.studies.store import Manifest as M; keep = M.keep; os.setsid(); "
        "M.keep = lambda self, found: (keep(self, found[: (len(found) + 1) // 2]), os.killpg(0, signal.SIGKILL))"
    )
    map_ = warm.start(
        f"{killed}; {PROGRAM}", "electric-map", CASE, *options, "--folder", str(folder), "--quiet", "--executor", "here"
    )
    assert map_.wait() == -signal.SIGKILL
    before = api.study_status(folder).done
    found = api.electric_map(folder, executor="here")
    assert 0 < before < api.study_status(folder).done == POINTS
    assert numbers(folder) == numbers(alone)
    assert found.points == map_of(alone).points


def test_map_refuses_what_is_none(tmp_path: Path, alone: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["electric-map", str(alone), "--set", "electric.seed=3", "--quiet"]) == 2
    assert "is a map already" in capsys.readouterr().err
    assert main(["electric-map", CASE, "--folder", str(alone), "--points", "1x1", "--quiet"]) == 2
    assert "already holds a study" in capsys.readouterr().err
    parameters = [{"path": "operation.speed", "values": ["500 rpm"]}]
    study = {"name": "s", "case": CASE, "responses": ["max_load_N"], "parameters": parameters}
    api.study_run(study, tmp_path / "s", executor="here")
    assert main(["electric-map", str(tmp_path / "s"), "--quiet"]) == 2
    assert "is not a map of bearing currents" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--points", "20"], "write speeds times temperatures"),
        (["--points", "0x3"], "write speeds times temperatures"),
        (["--points", "999x999"], "at most 10000"),
        (["--speed", "500 rpm"], "write the first and the last one"),
        (["--speed", "500, 900"], "has no unit"),
        (["--speed", "900 rpm, 500 rpm"], "the first is larger than the last"),
        (["--speed", "900 rpm, 900 rpm"], "need two different ends"),
        (["--temperature", "20 degC, 30 bar"], "is not a unit of temperature"),
        (["--out", "map.xlsx"], "the map is written as .csv"),
    ],
)
def test_mistakes_in_a_map_are_named(arguments: list[str], words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["electric-map", CASE, "--quiet", *arguments]) == 2
    assert words in " ".join(capsys.readouterr().err.split())


def test_a_map_asks_for_the_bearing_before_it_computes(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tmp_path / "box.toml"
    api.init_case("box", template="geared-shaft", path=case)
    assert main(["electric-map", str(case), "--points", "2x2", "--folder", str(tmp_path / "map")]) == 2
    assert "choose one with --bearing (left, right)" in capsys.readouterr().err
    assert not (tmp_path / "map").exists()


@pytest.mark.full
def test_runs_of_workers_have_the_events_of_a_single_run(tmp_path: Path) -> None:
    """Compare discharges of workers with single runs.

    The dynamic study has two workers; the tables are equal bit by bit.
    """
    common = {"solver.duration": "0.02 s", "electric.seed": 3, "loads.radial": "2 kN", "loads.axial": "0 N"}
    study = {
        "name": "s", "case": CASE, "mode": "dynamic", "responses": ["discharges_per_s", "bearing_voltage_V"],
        "set": common, "parameters": [{"path": "operation.speed", "values": ["2750 rpm", "2000 rpm"]}],
    }  # fmt: skip
    api.study_run(study, tmp_path / "s", workers=2)
    row = api.study_table(tmp_path / "s").rows()[0]
    changes = [f"{path}={value}" for path, value in common.items()]
    run, worked = api.run(CASE, changes, out=tmp_path / "run.h5"), api.result(tmp_path / "s" / row["file"])
    assert run.discharges()["time"].size > 50
    for name, values in run.discharges().items():
        assert values.tobytes() == worked.discharges()[name].tobytes(), name
    outcome = api.electric(run.path).outcome
    assert row["discharges_per_s"] == outcome.discharges_per_s > 0.0
    assert row["bearing_voltage_V"] == max(map(abs, outcome.bearing_voltage_V))

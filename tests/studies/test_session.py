"""Test whole studies.

Tables against single runs, refusals before anything runs, failed points, searches.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import closing
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from studies import MAP, RUNS

from lambda_core import api
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.studies import folders
from lambda_core.studies.effects import sensitivities
from lambda_core.studies.pool import Given, Inline
from lambda_core.studies.store import BANDS, Manifest
from lambda_core.views.method import NotApplicable
from lambda_core.views.table import Column, StudyTable

Write = Callable[..., Path]
LOADS = 'path = "loads.radial"\nvalues = ["16 kN", "24600 N"]'
MODELS = 'path = "models.traction"\nvalues = ["ree-eyring", "ree-eyrng"]'


def test_a_study_of_a_few_seconds_takes_no_other_process(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = []

    def pool(where: str, workers: int) -> Given:
        asked.append((where, workers))
        return Given(Inline(), 1)

    monkeypatch.setattr(folders, "pool", pool)
    short = write(MAP.replace("points = 3", "points = 2"))
    assert api.study_check(short).workers == 1
    assert api.study_check(short, workers=2).workers == 2
    api.study_run(short, tmp_path / "short")
    api.study_run(short, tmp_path / "given", workers=2)
    monkeypatch.setattr(folders, "_ALONE", 0.0)
    api.study_run(short, tmp_path / "long")
    assert [where for where, _ in asked] == ["here", "processes", "processes"]


@pytest.mark.full
def test_a_study_killed_before_its_bands_were_written_gets_them_on_resume(
    write: Write, inline: Executor, tmp_path: Path
) -> None:
    """Restore bands of a killed study.

    A kill while the bands were computed, before the first point or after the last one, lost them silently.
    """
    folder = tmp_path / "map"
    api.study_run(write(MAP), folder, executor=inline, band=True)

    def bands() -> list[str]:
        with closing(Manifest(folder)) as manifest:
            return [manifest.meta(name) for name in ("model_band", BANDS)]

    before = bands()
    assert all(before)
    with closing(Manifest(folder, write=True)) as manifest:
        for name in ("model_band", BANDS):
            manifest.write_meta(name, "")
    api.study_resume(folder, executor=inline)
    assert bands() == before


def test_each_point_is_what_a_single_solution_gives(write: Write, inline: Executor, tmp_path: Path) -> None:
    folder = tmp_path / "map"
    status = api.study_run(write(MAP), folder, executor=inline)
    assert (status.points, status.done, status.failed, status.pending) == (6, 6, 0, 0)
    table = api.study_table(folder)
    speed, load = table.parameter("operation.speed"), table.parameter("loads.radial")
    assert (speed.unit, load.unit) == ("rpm", "kN")
    for row in range(len(table)):
        single = api.quasistatic(
            "6319-cp10-1500",
            [f"operation.speed={speed.values[row]} rpm", f"loads.radial={load.values[row]} kN"],
        )
        found = table.rows()[row]
        assert found["friction_torque_Nmm"] == pytest.approx(single.friction_torque_Nmm, rel=1e-9)
        assert found["max_pressure_GPa"] == pytest.approx(single.max_pressure_GPa, rel=1e-9)
        assert found["min_film_parameter"] == pytest.approx(single.film_parameter[0], rel=1e-9)
        parts = [value for name, value in found.items() if name.startswith("friction_breakdown_Nmm.")]
        assert sum(parts) == pytest.approx(found["friction_torque_Nmm"], rel=1e-9)
    torque = table.response("friction_torque_Nmm")
    assert torque.unit == "N mm"
    assert np.all(np.diff(torque.numbers().reshape(3, 2), axis=1) > 0.0)  # more load, more torque
    pytest.importorskip("xarray")
    data = table.to_xarray()
    assert data["friction_torque_Nmm"].dims == ("operation.speed", "loads.radial")
    assert data["friction_torque_Nmm"].attrs == {"units": "N mm", "long_name": "friction torque"}
    assert data["loads.radial"].attrs["units"] == "kN"
    one = data["friction_torque_Nmm"].sel({"operation.speed": 3000.0, "loads.radial": 16.0})
    assert float(one) == api.quasistatic("6319-cp10-3000").friction_torque_Nmm
    frame = table.to_pandas()
    assert frame.attrs["units"]["loads.radial"] == "kN"
    assert frame.loc[1, "friction_torque_Nmm"] == torque.values[0]


def test_dynamic_points_are_results_of_their_own(write: Write, inline: Executor, tmp_path: Path) -> None:
    folder = tmp_path / "runs"
    text = RUNS.format(duration="0.005 s", speeds=2, loads=2)
    text = text.replace('"bearing_capacitance_nF"', '"power_loss_W", "skf/friction/total", "min_film_um"')
    status = api.study_run(write(text), folder, executor=inline)
    assert status.points == 4
    assert status.partial == 4  # far too short to converge, and the table says so
    table = api.study_table(folder)
    assert all("cage revolutions were averaged" in reason for reason in table.reasons)
    assert table.units()["skf/friction/total"] == "N mm"
    for row in table.rows():
        run = api.result(folder / row["file"])
        summary = run.summary()
        assert row["friction_torque_Nmm"] == summary.friction_torque_Nmm
        assert row["min_film_um"] == summary.min_film_um
        speed = row["operation.speed"] * math.pi / 30.0
        assert row["power_loss_W"] == pytest.approx(1e-3 * row["friction_torque_Nmm"] * speed, rel=1e-6)
        spin = run["body_spin"][:, 2]
        assert row["cage_speed_deviation"] == pytest.approx(spin.std() / abs(spin.mean()), rel=1e-9)
    # The same points are the same runs: nothing is computed again.
    before = {path.name: path.stat().st_mtime_ns for path in (folder / "runs").iterdir()}
    from lambda_core.studies.job import Task, work
    from lambda_core.studies.store import Manifest

    manifest = Manifest(folder)
    names = tuple(h.name for h in manifest.headings() if h.kind == "response")
    again = work(Task(2, manifest.case_toml, table_changes(manifest)[2], "dynamic", names, str(folder)))
    assert again.values["friction_torque_Nmm"] == table.rows()[2]["friction_torque_Nmm"]
    assert {path.name: path.stat().st_mtime_ns for path in (folder / "runs").iterdir()} == before


def table_changes(manifest: Any) -> list[tuple[str, ...]]:
    rows = manifest._database.execute("SELECT changes FROM points ORDER BY number").fetchall()
    return [tuple(json.loads(row[0])) for row in rows]


def test_failed_points_are_kept_with_their_reason(write: Write, inline: Executor, tmp_path: Path) -> None:
    # A clearance that lets the balls leave their grooves: no such bearing exists, the other points do.
    text = MAP.replace(LOADS, 'path = "bearing.clearance"\nrange = ["20 um", "9 mm"]\npoints = 3')
    text = text.replace("points = 3\nlabel", "points = 2\nlabel")
    folder = tmp_path / "hot"
    said: list[str] = []
    status = api.study_run(write(text), folder, executor=inline, announce=said.append)
    table = api.study_table(folder)
    assert status.failed == table.states.count("failed") > 0
    assert status.done == len(table) - status.failed > 0
    assert any("leave the grooves" in reason for reason in status.reasons)
    for state, reason, torque in zip(
        table.states, table.reasons, table.response("friction_torque_Nmm").values, strict=True
    ):
        assert (state == "failed") == bool(reason) == (torque is None)
    assert len(status.reasons) == status.failed
    again = api.study_resume(folder, executor=inline)
    assert again.failed == status.failed
    assert api.study_resume(folder, executor=inline, retry=True).failed == status.failed


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"operation.speed"', '"operation.sped"', ["operation.sped", "speed"]),
        ('"loads.radial"', '"operation.torque.x"', ["operation.torque"]),
        ('["500 rpm", "3000 rpm"]', '["500 N", "3000 N"]', ["N is not a unit of rotational_speed", "rpm"]),
        ('["16 kN", "24600 N"]', '["16 kN", "24.6 mm"]', ['"16 kN" and "24.6 mm" have no unit in common']),
        (LOADS, MODELS, ["models.traction = ree-eyrng", "nearest: ree-eyring"]),
        ('"6319-cp10-1500"', '"6319-cp10-1510"', ["neither a file nor a built-in case", "6319-cp10-1500"]),
        ('"max_pressure_GPa"', '"max_presure_GPa"', ["max_presure_GPa", "nearest: max_pressure_GPa"]),
        ('"max_pressure_GPa"', '"cage_speed_ratio"', ["exists in dynamic studies only"]),
        ('"max_pressure_GPa"', '"skf/friction/totale"', ["totale", "nearest: friction/total"]),
        (LOADS, 'path = "depth.strips"\nrange = [11, 31]\npoints = 4', ["17.66666667 is not a whole number"]),
        (LOADS, 'path = "depth.strips"\nvalues = [11, 12.5, 31]', ["12.5 is not a whole number"]),
        ("points = 3", "points = 1000000000", ["2,000,000,000 points would take about", "workers", "at most 100,000"]),
    ],
)
def test_studies_without_sense_are_refused_before_they_start(
    write: Write, tmp_path: Path, old: str, new: str, words: list[str]
) -> None:
    assert old in MAP
    with pytest.raises((CaseError, UsageError)) as caught:
        api.study_run(write(MAP.replace(old, new)), tmp_path / "never")
    for word in words:
        assert word in str(caught.value)
    assert not (tmp_path / "never").exists()


def test_points_that_cannot_work_are_warned_of(write: Write) -> None:
    text = MAP.replace(
        LOADS,
        'path = "bearing.clearance"\nrange = ["20 um", "9 mm"]\npoints = 2',
    )
    estimate = api.study_check(write(text), workers=2)
    assert estimate.points == 6
    assert estimate.warnings
    assert "bearing.clearance = 9000 um: bearing.clearance" in estimate.warnings[0]
    assert 0.0 < estimate.seconds_per_point < 200.0
    assert estimate.wall_s > 6 * estimate.seconds_per_point / 2


def test_the_cost_of_runs_is_said_beforehand(write: Write) -> None:
    short = api.study_check(write(RUNS.format(duration="0.01 s", speeds=2, loads=2)), workers=1)
    long = api.study_check(write(RUNS.format(duration="1 s", speeds=2, loads=2)), workers=1)
    # A point has a fixed cost too, measured on a machine that may be busy.
    assert long.seconds_per_point > 2.0 * short.seconds_per_point
    assert long.disk_bytes == pytest.approx(100.0 * short.disk_bytes, rel=1e-6)


def test_the_estimate_of_disk_counts_the_samples_that_a_run_takes(write: Write, tmp_path: Path) -> None:
    """Estimate disk space from samples.

    A hundredth of a cage turn sets their distance, not the longest step of the integrator.
    """
    text = RUNS.format(duration="20 ms", speeds=2, loads=2)
    text = (
        text[: text.index("[[parameters]]")]
        + """
[[parameters]]
path = "operation.speed"
values = ["2000 rpm"]
"""
    )
    estimate = api.study_check(write(text), workers=1)
    result = tmp_path / "one.h5"
    api.run("6208-axial-1300", ["solver.duration=20 ms", "operation.speed=2000 rpm"], out=result)
    with h5py.File(result) as file:
        rows = file["time"].shape[0]
        arrays = [file[name] for name in file if isinstance(file[name], h5py.Dataset)]
        written = sum(array.nbytes for array in arrays if array.shape[:1] == (rows,))
    assert estimate.disk_bytes == pytest.approx(written, rel=0.1)


def test_a_folder_holds_one_study(write: Write, inline: Executor, tmp_path: Path) -> None:
    path = write(MAP.replace("points = 3", "points = 2"))
    folder = tmp_path / "map"
    api.study_run(path, folder, executor=inline)
    with pytest.raises(UsageError, match="already holds a study"):
        api.study_run(path, folder, executor=inline)
    with pytest.raises(UsageError, match="holds no study"):
        api.study_status(tmp_path)
    with pytest.raises(UsageError, match="does not exist"):
        api.study_table(tmp_path / "nowhere")
    status = api.study_resume(folder, executor=inline)  # nothing to do
    assert status.done == 4
    copy = api.study_check(folder / "study.toml")  # what stands there is a study file
    assert copy.points == 4


def test_a_study_of_other_laws_does_not_go_on(write: Write, inline: Executor, tmp_path: Path) -> None:
    from lambda_core.studies.store import Manifest

    folder = tmp_path / "map"
    api.study_run(write(MAP.replace("points = 3", "points = 2")), folder, executor=inline)
    manifest = Manifest(folder, write=True)
    manifest.write_meta("fingerprint", "of other laws")
    manifest.close()
    with pytest.raises(UsageError, match="a law or the program has changed"):
        api.study_resume(folder, executor=inline)


def test_a_study_does_not_go_on_under_other_code(
    write: Write, inline: Executor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "map"
    api.study_run(write(MAP.replace("points = 3", "points = 2")), folder, executor=inline)
    monkeypatch.setattr("lambda_core.laws.pack.code", lambda: "pack linux x86-64-v3 numba 0.0")
    with pytest.raises(UsageError, match=r"native; this is pack linux .* set LAMBDA_BEARING_CODE=native"):
        api.study_resume(folder, executor=inline)


GOAL = """
name = "cool"
case = "6319-cp10-1500"
responses = ["friction_torque_Nmm", "min_film_parameter"]

[[parameters]]
path = "lubricant.temperature"
range = ["40 degC", "110 degC"]
label = "oil temperature"

[design]
kind = "optimise"

[optimise]
minimise = "friction_torque_Nmm"
evaluations = 25
constraints = [{ response = "min_film_parameter", at_least = 4.0 }]
"""


def test_a_search_ends_on_its_constraint(write: Write, inline: Executor, tmp_path: Path) -> None:
    """Find the best oil at its constraint.

    Hotter oil means less rolling torque and thinner films: the best oil is as hot as Lambda allows.
    """
    folder = tmp_path / "cool"
    status = api.study_run(write(GOAL), folder, executor=inline)
    assert status.best is not None
    assert status.best["min_film_parameter"] == pytest.approx(4.0, rel=2e-3)
    table = api.study_table(folder)
    assert status.best["min_film_parameter"] >= 4.0
    assert table.to_xarray()["min_film_parameter"].sel(point=1).attrs["units"] == "1"
    keeps = table.response("min_film_parameter").numbers() >= 4.0
    assert status.best["friction_torque_Nmm"] == pytest.approx(
        table.response("friction_torque_Nmm").numbers()[keeps].min(), rel=1e-12
    )
    best = status.best["lubricant.temperature"]
    grid = np.linspace(best - 3.0, best + 3.0, 3)
    lambdas = [api.quasistatic("6319-cp10-1500", [f"lubricant.temperature={t} degC"]).film_parameter[0] for t in grid]
    assert lambdas[0] > 4.0 > lambdas[2]
    # Going on finds every point in the manifest: the same end without a single new evaluation.
    again = api.study_resume(folder, executor=inline)
    assert (again.points, again.best) == (status.points, status.best)


def test_a_goal_has_to_be_among_the_responses(write: Write) -> None:
    with pytest.raises(CaseError, match='"min_film_um" is not among the responses'):
        api.study_check(write(GOAL.replace('response = "min_film_parameter"', 'response = "min_film_um"')))


# -- sensitivities: functions with known answers --


def made_up(design: str, inputs: np.ndarray, outputs: np.ndarray) -> StudyTable:
    parameters = tuple(Column(f"x{i}", "", "", tuple(column)) for i, column in enumerate(inputs.T.tolist()))
    response = Column("y", "", "", tuple(outputs.tolist()))
    n = len(outputs)
    return StudyTable("t", "t", "quasi-static", design, parameters, (response,), ("done",) * n, ("",) * n, ("",) * n)


def test_sobol_indices_of_the_ishigami_function() -> None:
    """Compare Sobol indices with Ishigami and Homma.

    1990, a = 7, b = 0.1: S = 0.3139, 0.4424, 0; S_T = 0.5576, 0.4424, 0.2437.
    """
    from lambda_core.studies.design import saltelli

    shares = saltelli(2048, 3, 1)
    x = math.pi * (2.0 * shares - 1.0)
    y = np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])
    found = sensitivities(made_up("saltelli", x, y), "y")
    assert found.kind == "sobol"
    np.testing.assert_allclose(found.first, [0.3139, 0.4424, 0.0], atol=0.02)
    np.testing.assert_allclose(found.second, [0.5576, 0.4424, 0.2437], atol=0.02)
    assert found.second_range is not None
    for (low, high), exact in zip(found.second_range, [0.5576, 0.4424, 0.2437], strict=True):
        assert low - 0.02 < exact < high + 0.02


def test_regression_finds_linear_shares() -> None:
    random = np.random.default_rng(3)
    x = random.uniform(size=(400, 3))
    y = 3.0 * x[:, 0] - 4.0 * x[:, 1]
    found = sensitivities(made_up("latin-hypercube", x, y), "y")
    exact = np.array([3.0, -4.0, 0.0]) * x.std(axis=0) / y.std()
    np.testing.assert_allclose(found.first, exact, atol=1e-9)
    assert found.fit == pytest.approx(1.0)
    assert found.second[0] > 0.4
    assert found.second[1] < -0.6


@pytest.mark.parametrize(
    ("inputs", "outputs", "words"),
    [
        (np.ones((9, 2)), np.arange(9.0), "no numeric parameter varies"),
        (np.arange(9.0)[:, None], np.arange(9.0), "alone varies: there is nothing to weigh it against"),
        (np.arange(4.0)[:, None] * np.ones((1, 2)), np.arange(4.0), "too few"),
        (np.arange(9.0)[:, None] * np.ones((1, 2)), np.arange(9.0), "cannot be separated"),
        (np.arange(18.0).reshape(9, 2) ** 2, np.ones(9), "does not vary"),
    ],
)
def test_sensitivities_that_cannot_be_told_say_why(inputs: np.ndarray, outputs: np.ndarray, words: str) -> None:
    with pytest.raises(NotApplicable, match=words):
        sensitivities(made_up("crossed", inputs, outputs), "y")

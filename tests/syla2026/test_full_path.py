"""Test every experiment from its jobs to the page.

Cases are resolved, nothing is solved or run.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from lambda_cli.main import main
from lambda_syla2026 import anchored_table, anchors, calibration, job_runner, rated_speeds, table4
from lambda_syla2026 import parameters as P
from lambda_syla2026.fig7 import RINGS
from lambda_syla2026.job_runner import Job, JobResult
from lambda_syla2026.readings import MECHANISMS, TAU_GRID, Numbers, torque_at
from lambda_syla2026.session import reproduce

from lambda_core.discovery.manager import registry
from lambda_core.domain.errors import SolverError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import max_speed
from lambda_core.studies.job import resolve_point
from lambda_core.studies.pool import HERE, pool

FRICTION = (
    "total", "skf", "skf rolling", "skf sliding", "skf drag", "schaeffler load", "contacts", "heat", "max_load_N", "ci",
)  # fmt: skip
CONTACT = ("load_N", "contact_angle_deg", "area_mm2", "film_um", "hertz_pF", "k_c", "contact_pF")
ANALYTICAL = (
    "analytical bearing",
    *(f"analytical {ring} {part}" for ring in RINGS for part in ("Hertzian area", "contact")),
)
RESONANCE = ("stiffness_N_per_um", "mass_kg", "resonance_Hz", "ball_Hz", "cage_Hz")


@cache
def resolved(case: str, changes: Sequence[str]) -> BearingModel:
    """Return a model.

    Experiments of several tests ask for hundreds of the same.
    """
    return resolve_point(case, changes)


def invented(model: BearingModel) -> Numbers:
    """Return invented numbers of any reading.

    Torques smooth in speed and temperature, altered running above some excitation.
    """
    total = 900.0 * (max_speed(model) / 52.0) ** 0.3 * math.exp(-0.015 * (model.oil.temperature - 335.0))
    shares = {name: total / len(MECHANISMS) for name in MECHANISMS}
    names = (
        *FRICTION,
        *ANALYTICAL,
        *RESONANCE,
        "bearing_pF",
        *(f"{ring} {name}" for ring in RINGS for name in CONTACT),
        *map(torque_at, TAU_GRID),
    )
    motion = model.outer_ring.dofs["x"].motion.terms
    shaken = sum(t.values[0] * (2.0 * math.pi * t.values[1]) ** 2 for t in motion if t.kind == "harmonic")
    altered = {"S": 0.1 + shaken / 500.0, "T": shaken / 400.0, "S_error": 1e-4, "T_error": 1e-4}
    return {**dict.fromkeys(names, total), **shares, **altered, "torque": total, "sliding coefficient": 0.06}


@pytest.fixture
def lost(monkeypatch: pytest.MonkeyPatch) -> set[str]:
    """Solve and run nothing.

    The set has what has no solution: names of cases, titles of bearings.
    """
    without: set[str] = set()

    def static(model: BearingModel) -> Numbers:
        if {model.name, model.title} & without:
            raise SolverError(f"{model.title}: invented")
        return invented(model)

    def run(job: Job, hash_: str, folder: str) -> JobResult:
        model = resolved(job_runner.case_text(job.case), job.changes)
        failed = bool({model.name, *job.changes} & without)
        (Path(folder) / "run").touch()
        numbers = {} if failed else invented(model)
        return JobResult("failed" if failed else "done", "invented" if failed else "", hash_, numbers, "run")

    monkeypatch.setattr(job_runner, "Processes", lambda workers: pool(HERE, workers))
    monkeypatch.setattr(job_runner, "STATIC", dict.fromkeys(job_runner.STATIC, static))
    monkeypatch.setattr(job_runner, "_run", run)
    monkeypatch.setattr(job_runner, "resolve_point", resolved)
    # Fewer of what there are many of.
    monkeypatch.setattr(calibration, "laws_of", lambda role: [P.entry(f"models.{role}").value])
    monkeypatch.setattr(anchored_table, "_GRID", np.array([55.0, 60.0, 65.0, 70.0]))
    monkeypatch.setattr(table4, "SAMPLES", 2)
    monkeypatch.setattr(table4, "ANCHORED_SAMPLES", 2)
    monkeypatch.setattr(anchors, "BEARINGS", anchors.BEARINGS[:2])
    monkeypatch.setattr(anchors, "POPULATIONS", dict.fromkeys(anchors.POPULATIONS, 3))
    monkeypatch.setattr(rated_speeds, "SERIES", ("64",))
    return without


@pytest.mark.full
@pytest.mark.usefixtures("lost")
def test_table_4_in_full_reaches_its_page(tmp_path: Path) -> None:
    """Skip a value without a range.

    It is no sensitivity: the film width of the cage's pockets once ended all of it.
    """
    found = reproduce(registry(), "table4", tmp_path, workers=1)
    assert found.table4 is not None
    of_cage = {s.name for s in found.table4.sensitivities if s.basis.startswith("runs")}
    assert of_cage == {entry.label for entry in P.blind_set() if entry.cage and entry.ends}
    assert all(law.simulated for law in found.table4.laws)
    assert found.failed == {"table4": []}
    assert (tmp_path / "reproduction.html").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("what", "without", "options"),
    [
        pytest.param("table4", "6319-cp10-500", [], marks=pytest.mark.full),
        pytest.param("anchors", "6205 (SKF, geometry edited)", [], marks=pytest.mark.full),
        ("fig7", "6208-axial-700", []),
        ("fig5", "loads.radial=5 kN", ["--quick"]),
    ],
)
def test_a_point_without_a_result_ends_no_experiment(
    what: str, without: str, options: list[str], lost: set[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Mark a point without a result.

    In tables and page; null in JSON, named in the message, and the exit code is that of a part.
    """
    lost.add(without)
    words = ["reproduce", what, "--out", str(tmp_path), "--workers", "1", "--quiet", *options]
    assert main(words) == 5
    said = capsys.readouterr()
    assert "points have no result" in said.err
    assert "invented" in said.err
    tables, _, notes = said.out.partition("note:")
    assert "failed" in tables
    assert "points have no result, marked failed" in notes
    assert re.search(r"\bnan\b", tables) is None
    assert (tmp_path / "reproduction.html").exists()
    if what != "fig7":  # the same writer for all
        return
    assert main([*words, "--json"]) == 5
    data = json.loads(capsys.readouterr().out, parse_constant=lambda name: pytest.fail(name))
    assert data["failed"][what]

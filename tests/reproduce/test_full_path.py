"""Every experiment in full from its jobs to the page: cases are resolved, nothing is solved or run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from lambda_syla2026 import anchored_table, calibration, job_runner, table4
from lambda_syla2026 import parameters as P
from lambda_syla2026.job_runner import Job, JobResult
from lambda_syla2026.readings import MECHANISMS, Numbers
from lambda_syla2026.session import reproduce

from lambda_core.batch.job import resolve_point
from lambda_core.batch.pool import HERE, pool
from lambda_core.discovery.manager import registry
from lambda_core.system.bearing import BearingModel
from lambda_core.system.law_context import max_speed


def invented(model: BearingModel) -> Numbers:
    """Numbers of any reading of the 6319, smooth in speed and temperature."""
    total = 900.0 * (max_speed(model) / 52.0) ** 0.3 * math.exp(-0.015 * (model.oil.temperature - 335.0))
    shares = {name: total / len(MECHANISMS) for name in MECHANISMS}
    return {**shares, "torque": total, "total": total, "max_load_N": 5e3, "ci": 1.0, "sliding coefficient": 0.06}


@pytest.fixture
def nothing_is_solved(monkeypatch: pytest.MonkeyPatch) -> None:
    def run(job: Job, hash_: str, folder: str) -> JobResult:
        model = resolve_point(job_runner.case_text(job.case), job.changes)
        return JobResult("done", "", hash_, invented(model))

    monkeypatch.setattr(job_runner, "Processes", lambda workers: pool(HERE, workers))
    monkeypatch.setattr(job_runner, "STATIC", dict.fromkeys(job_runner.STATIC, invented))
    monkeypatch.setattr(job_runner, "_run", run)
    # Fewer of what there are many of.
    monkeypatch.setattr(calibration, "laws_of", lambda role: [P.entry(f"models.{role}").value])
    monkeypatch.setattr(anchored_table, "_GRID", np.array([55.0, 60.0, 65.0, 70.0]))
    monkeypatch.setattr(table4, "SAMPLES", 2)
    monkeypatch.setattr(table4, "ANCHORED_SAMPLES", 2)


@pytest.mark.usefixtures("nothing_is_solved")
def test_table_4_in_full_reaches_its_page(tmp_path: Path) -> None:
    """A value that has no range is no sensitivity: the film width of the cage's pockets once ended all of it."""
    found = reproduce(registry(), "table4", tmp_path, workers=1)
    assert found.table4 is not None
    of_cage = {s.name for s in found.table4.sensitivities if s.basis.startswith("runs")}
    assert of_cage == {entry.label for entry in P.blind_set() if entry.cage and entry.ends}
    assert all(law.simulated for law in found.table4.laws)
    assert (tmp_path / "reproduction.html").stat().st_size > 10_000

"""Test that an interrupted reproduction continues with equal findings."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from lambda_syla2026 import job_runner
from lambda_syla2026.job_runner import Job, JobResult, JobRunner

from lambda_core.studies.pool import HERE, pool
from lambda_core.studies.scheduler import StudyProgress

LOADS = (2.0, 3.0, 4.0, 5.0)
JOBS = [Job("6220-excited", (f"loads.radial={load:g} kN",), "axial resonance") for load in LOADS]


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Do the jobs in this process.

    Their place does not matter, and a worker takes seconds to start.
    """
    monkeypatch.setattr(job_runner, "Processes", lambda workers: pool(HERE, workers))


def kept(folder: Path) -> dict[Path, int]:
    return {path: path.stat().st_mtime_ns for path in folder.rglob("points/*.json")}


@pytest.mark.usefixtures("here")
def test_an_interrupted_plan_is_resumed(tmp_path: Path) -> None:
    def interrupt(progress: StudyProgress) -> None:
        if progress.done >= 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt), JobRunner(tmp_path, 1, interrupt) as runner:
        runner.all(JOBS)
    before = kept(tmp_path)
    assert 2 <= len(before) < len(JOBS)

    said: list[StudyProgress] = []
    with JobRunner(tmp_path, 1, said.append) as runner:
        found = runner.all(JOBS)
    after = kept(tmp_path)
    assert {path: after[path] for path in before} == before
    assert len(after) == len(JOBS)
    assert said[-1].done == said[-1].points == len(JOBS)
    # A stiffer bearing under more load, and the same numbers as in one go.
    stiffness = [answer["stiffness_N_per_um"] for answer in found]
    assert stiffness == sorted(stiffness)
    with JobRunner(tmp_path / "other", 1) as runner:
        assert [answer.numbers for answer in runner.all(JOBS)] == [answer.numbers for answer in found]


@pytest.mark.usefixtures("here")
def test_equal_jobs_are_done_once(tmp_path: Path) -> None:
    with JobRunner(tmp_path, 1) as runner:
        first, again = runner.all([JOBS[0], JOBS[0]])
    assert first == again
    assert len(kept(tmp_path)) == 1


@pytest.mark.usefixtures("here")
def test_what_was_found_before_keeps_the_time_that_it_took(tmp_path: Path) -> None:
    with JobRunner(tmp_path, 1) as runner:
        first = runner.all(JOBS[:1])[0]
        assert runner.answers == {JOBS[0]: first}
    with JobRunner(tmp_path, 1) as runner:
        again = runner.all(JOBS[:1])[0]
    assert first.fresh
    assert not again.fresh
    assert first.processor_s == again.processor_s > 0.0


@pytest.mark.full
def test_a_case_that_is_wrong_fails_alone(tmp_path: Path) -> None:
    """Fail one case on a worker.

    Nothing of it is kept but the reason; its number is NaN, and the others go on.
    """
    with JobRunner(tmp_path, 1) as runner:
        good, bad = runner.all([JOBS[0], Job("6220-excited", ("loads.radial=5 furlong",), "axial resonance")])
        assert len(runner.failures) == 1
    assert good.state == "done"
    assert bad.state == "failed"
    assert isinstance(bad, JobResult)
    assert math.isnan(bad["resonance_Hz"])
    assert "loads.radial" in bad.reason
    assert len(runner.lost) == 1
    assert len(kept(tmp_path)) == 1

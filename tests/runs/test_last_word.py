"""Test runs that are killed after their last checkpoint."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from fake_engine import FakeEngine, MakeProvenance

from lambda_core.results.reader import Result
from lambda_core.runs import loop
from lambda_core.runs.session import Session
from lambda_core.solver.drivers.engine import Advance

TURN = FakeEngine().turn


@pytest.mark.full
@pytest.mark.parametrize("solver", [{}, {"duration": 1.77 * TURN}], ids=["converged", "duration"])
def test_killed_before_its_last_word(
    solver: dict[str, float], provenance: MakeProvenance, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    complete = loop.run(FakeEngine(), provenance(**solver), tmp_path / "whole.h5")
    path = tmp_path / "killed.h5"

    def killed(session: Any, state: str, message: str, **_: Any) -> None:
        session._save()
        session._writer._file.close()
        (tmp_path / ".killed.h5.999999999").touch()  # the copy that such a process may have begun

    with monkeypatch.context() as patch:
        patch.setattr(Session, "_finish", killed)
        patch.setattr("lambda_core.results.run_status.Status.alive", lambda status: False)
        loop.run(FakeEngine(), provenance(**solver), path)
        assert Result(path).status().state == "running"
    monkeypatch.setattr("lambda_core.results.run_status.Status.alive", lambda status: False)
    resumed = loop.resume(FakeEngine(), provenance(**solver), path)
    assert resumed.status().state == "finished"
    assert resumed.integrals().tobytes() == complete.integrals().tobytes()
    assert resumed.revolutions().tobytes() == complete.revolutions().tobytes()
    for channel in complete.channels:
        assert resumed[channel.name].tobytes() == complete[channel.name].tobytes()
    assert {file.name for file in tmp_path.iterdir()} == {"whole.h5", "killed.h5"}


def test_a_limit_that_is_met_before_the_first_step_is_no_failure(provenance: MakeProvenance, tmp_path: Path) -> None:
    class Slow(FakeEngine):
        """Engine with a slow first step.

        It takes longer than the limit of wall time, and is not through when it is asked to pause.
        """

        def advance(self, until: float, pause: Callable[[], bool] | None = None) -> Advance:
            while pause is not None and not pause():
                pass
            return Advance(True, "")

    result = loop.run(Slow(), provenance(max_wall=0.05), tmp_path / "r.h5")
    assert result.status().state == "stopped"
    assert "the limit of wall time was reached at t = 0 s" in result.status().message

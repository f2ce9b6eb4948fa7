"""Test study responses of observers, events and states."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.domain.installed import ON_VARIABLE

PLUGIN = """
from lambda_core.plugins import (
    OK, Channel, Event, Integral, NoParameters, Number, Observer, Parameters, State, hookimpl, law, parameter
)

class Factor(Parameters):
    factor: float = parameter(1.0, "a factor", gt=0.0)

DOSE = State("slip_dose", "m", "distance slid by each contact", scale=1e-6)

@law("contact_state", "dose", role_api=3, reference="own work", states=(DOSE,))
def dose(t, load, semi_a, semi_b, p_max, u_mean, u_slide, spin, h, Lambda, psi, power, T_film, T_in, par, out):
    out[0] = abs(u_slide)
    return OK

def late(samples, parameters, model):
    return samples["time"] > 1e-3

def losses(samples, parameters, model):
    return {"loss_sum": parameters.factor * samples["loss"].sum(axis=1)}

@hookimpl
def lambda_events(register):
    register(Event("late", "it is late", late, "own work", NoParameters, event_api=1))

@hookimpl
def lambda_observers(register):
    register(Observer("losses", "losses", (Channel("loss_sum", (), "W", "sum of the losses"),), losses, "own work",
                      Factor, integrals=(Integral("work_lost", "loss_sum", "J", "work lost"),),
                      numbers=(Number("lost work", "work_lost", "last", "work lost at the end"),), observer_api=1))
"""
NAMES = ["losses/lost work", "late/first_s", "late/count", "slip_dose/last", "slip_dose/largest"]


@pytest.fixture
def plugin(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Have the plugin for one test."""
    monkeypatch.setenv(ON_VARIABLE, "")
    monkeypatch.setattr(local_files, "_texts", {})
    manager.registry.cache_clear()
    file = tmp_path / "doses.py"
    file.write_text(PLUGIN)
    api.use_plugin(file)
    yield
    monkeypatch.undo()
    manager.registry.cache_clear()


def study(names: list[str], **more: Any) -> dict[str, Any]:
    return {
        "name": "doses", "case": "6208-axial-1300", "mode": "dynamic", "responses": names,
        "set": {"solver.duration": "2 ms", "models.contact_state": "dose", "events.late.action": "record",
                "observers.losses.factor": 2.0},
        "parameters": [{"path": "operation.speed", "values": ["2000 rpm", "3000 rpm"]}], **more,
    }  # fmt: skip


@pytest.mark.usefixtures("plugin")
def test_a_study_asks_numbers_of_observers_events_and_states(tmp_path: Path) -> None:
    status = api.study_run(study([*NAMES, "skf/friction/total"]), tmp_path / "doses", executor="here")
    assert status.failed == 0, status.reasons
    table = api.study_table(tmp_path / "doses")
    first, second = table.rows()
    result = api.result(tmp_path / "doses" / first["file"])
    assert first["losses/lost work"] == result["work_lost"][-1] > 0.0
    assert first["late/first_s"] == result["time"][result["time"] > 1e-3][0]
    assert first["late/count"] == 1.0
    assert first["slip_dose/last"] == np.max(result["slip_dose"][-1])
    assert second["slip_dose/largest"] > first["slip_dose/largest"] >= first["slip_dose/last"] > 0.0
    assert first["skf/friction/total"] > 0.0


@pytest.mark.usefixtures("plugin")
def test_unknown_numbers_of_plugins_are_named_before_the_study() -> None:
    with pytest.raises(api.CaseError, match='"losses/lost wrok" is not a known response; nearest: losses/lost work'):
        api.study_check(study(["losses/lost wrok"]))
    with pytest.raises(api.CaseError, match='"late/first_s" exists in dynamic studies only'):
        api.study_check(study(["late/first_s"], mode="quasi-static"))

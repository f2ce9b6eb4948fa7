"""Test observers, events and sample intervals of machines."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.case.written import merged
from lambda_core.domain.channels import Channel
from lambda_core.laws.parameter import NoParameters
from lambda_core.model.bearing_model import ChosenEvent, ChosenObserver
from lambda_core.model.machine_model import MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.runs.launch import launch
from lambda_core.views.observer import Event, Observer

LOSS = Channel("loss_sum", (), "W", "sum of the losses")


def losses(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> dict[str, Any]:
    return {"loss_sum": samples["loss"].sum(axis=1)}


def late(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> Any:
    return samples["time"] > 0.31e-3


def machine(**changes: Any) -> MachineModel:
    """Return the case that init writes, changed and resolved."""
    found = api.check(merged(tomllib.loads(shaft_text("geared-shaft", "box")), changes))
    assert isinstance(found, api.MachineModel)
    return found


def test_every_bearing_is_observed_and_an_event_ends_the_run_at_its_sample(tmp_path: Path) -> None:
    observer = Observer("losses", "losses", (LOSS,), losses, "own work", NoParameters, observer_api=1)
    event = Event("late", "it is late", late, "own work", NoParameters, event_api=1)
    watched = {
        "observers": {"losses": ChosenObserver(observer, NoParameters())},
        "events": {"late": ChosenEvent(event, NoParameters(), "stop")},
    }
    model = machine(output={"interval": "0.05 ms"}, solver={"duration": "2 ms"})
    bearings = tuple(replace(one, model=replace(one.model, **watched)) for one in model.bearings)
    result = launch(replace(model, bearings=bearings), tmp_path / "run.h5", overwrite=False)
    for bearing in result.bearings.values():
        time = bearing["time"]
        assert time[-1] == pytest.approx(0.35e-3)  # the first sample behind 0.31 ms, not the end of the record
        assert np.diff(time) == pytest.approx(5e-5, rel=1e-9)
        assert bearing["loss_sum"] == pytest.approx(bearing["loss"].sum(axis=1))


def test_an_unknown_observer_is_a_mistake_of_the_machine() -> None:
    with pytest.raises(api.CaseError) as caught:
        machine(observers={"nothing": {}})
    assert [problem.where for problem in caught.value.problems] == ["observers.nothing"]

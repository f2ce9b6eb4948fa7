"""Test that checks try observers, events, sections, views and methods."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.discovery import local_files, manager
from lambda_core.discovery.survey import chosen_others
from lambda_core.domain.installed import ON_VARIABLE

PLUGIN = """
import numpy as np
from lambda_core.plugins import (
    Axis, Channel, Event, Method, MethodRow, MethodTable, NoParameters, Observer, Options, Panel, Section, Series,
    View, ViewData, hookimpl,
)

LOSS = Channel("loss_sum", (), "W", "sum of the losses")

def typo(samples, parameters, model):
    return {"loss_sum": samples["los"].sum(axis=1)}

def sound(samples, parameters, model):
    return {"loss_sum": samples["loss"].sum(axis=1)}

def empty(samples, parameters, model):
    return {"loss_sum": np.full(len(samples["time"]), np.nan)}

def numbers(samples, parameters, model):
    return samples["time"]

def data(run, options):
    return run["lod"]

def content(run):
    return [run.summary().no_such_number]

def evaluate(inputs):
    return MethodTable((MethodRow("friction", "total", "1.0", "N mm"),))

@hookimpl
def lambda_observers(register):
    for name, function in (("typo", typo), ("sound", sound), ("empty", empty)):
        register(Observer(name, name, (LOSS,), function, "own work", observer_api=1))

@hookimpl
def lambda_events(register):
    register(Event("no-bool", "never", numbers, "own work", event_api=1))

@hookimpl
def lambda_views(register):
    register(View("no-view", "nothing", "result", data, view_api=1))

@hookimpl
def lambda_sections(register):
    register(Section("no-section", "nothing", content, "own work", section_api=1))

@hookimpl
def lambda_methods(register):
    register(Method("no-method", "nothing", "own work", evaluate, method_api=1))
"""


@pytest.fixture
def file(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Path]:
    monkeypatch.setenv(ON_VARIABLE, "")
    monkeypatch.setattr(local_files, "_texts", {})
    manager.registry.cache_clear()
    path = tmp_path / "faulty.py"
    path.write_text(PLUGIN)
    yield path
    monkeypatch.undo()
    manager.registry.cache_clear()


def test_plugins_check_tries_all_that_is_no_law(file: Path) -> None:
    api.use_plugin(file)
    cards = {card.name: card for card in api.check_plugins([file.name])}
    told = {name: " ".join(card.faults) for name, card in cards.items()}
    assert "KeyError: 'los' (faulty.py, line 11)" in told["typo"]
    assert "returns float64" in told["no-bool"]
    assert "lod" in told["no-view"]
    assert "no_such_number" in told["no-section"]
    assert "which is not a number" in told["no-method"]
    assert (cards["sound"].ok, cards["empty"].ok) == (True, True)
    assert "returns no finite number as loss_sum" in cards["empty"].warnings[0]
    assert not cards["sound"].warnings


def test_plugins_check_chooses_a_kind(file: Path) -> None:
    api.use_plugin(file)
    assert chosen_others(manager.registry(), ["event"]) == [("event", "no-bool")]
    assert chosen_others(manager.registry(), ["traction"]) == []
    with pytest.raises(api.UsageError, match="nearest: observer"):
        list(api.check_plugins(["obsever"]))


def test_check_tries_the_observers_of_its_case(file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = tmp_path / "watched.toml"
    api.save(api.case("6208-axial-1300"), case)
    case.write_text(case.read_text() + "\n[observers.typo]\n\n[events.no-bool]\n")
    assert main(["check", str(case), "--plugin", str(file)]) == 3
    told = capsys.readouterr().err
    assert "observers.typo" in told
    assert "KeyError: 'los'" in told
    assert "events.no-bool" in told

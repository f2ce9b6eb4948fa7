"""Test observers and events of plugins.

What they write, when they end a run, and what their own mistakes do.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.discovery.collect import Collection, Entry
from lambda_core.domain.channels import Channel
from lambda_core.domain.errors import CaseError
from lambda_core.laws.parameter import NoParameters, Parameters, parameter
from lambda_core.model.bearing_model import BearingModel, ChosenEvent, ChosenObserver
from lambda_core.model.ledger import Ledger
from lambda_core.model.resolve import case_hash
from lambda_core.model.settings.resolve_watch import resolve_events, resolve_observers
from lambda_core.results.reader import Result
from lambda_core.runs.launch import launch, relaunch
from lambda_core.views.observer import Event, Integral, Number, Observer

LOSS = Channel("loss_sum", (), "W", "sum of the losses")
EACH = Channel("contact_power", ("ball", "ring"), "W", "loss of each contact")


class Factor(Parameters):
    factor: float = parameter(1.0, "a factor", gt=0.0)


def losses(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> dict[str, Any]:
    return {"loss_sum": parameters.factor * samples["loss"].sum(axis=1), "contact_power": samples["contact_loss"]}


def observer(observe: Callable[..., Any] = losses, **changes: Any) -> Observer:
    made = Observer(
        "losses",
        "losses",
        (LOSS, EACH),
        observe,
        "own work",
        Factor,
        integrals=(
            Integral("work_lost", of="loss_sum", unit="J", meaning="work lost"),
            Integral("contact_work", of="contact_power", unit="J", meaning="work lost in each contact"),
        ),
        numbers=(Number("mean loss", "loss_sum", "mean", "mean loss"), Number("work", "work_lost", "last", "lost")),
        observer_api=1,
        distribution="guest 1.0",
    )
    return replace(made, **changes)


def event(happens: Callable[..., Any], **changes: Any) -> Event:
    made = Event("late", "it is late", happens, "own work", NoParameters, event_api=1, distribution="guest 1.0")
    return replace(made, **changes)


def after(seconds: float) -> Callable[..., Any]:
    return lambda samples, parameters, model: samples["time"] > seconds


def model(duration: str = "6 ms", **watched: Any) -> BearingModel:
    changes = [f"solver.duration={duration}", "output.interval=0.1 ms"]
    return replace(api.check("6208-axial-1300", changes), **watched)


def with_observer(found: Observer, **more: Any) -> dict[str, Any]:
    return {"observers": {"losses": ChosenObserver(found, Factor(factor=2.0))}, **more}


@pytest.fixture(scope="module")
def complete(tmp_path_factory: pytest.TempPathFactory) -> Result:
    return launch(model(**with_observer(observer())), tmp_path_factory.mktemp("observed") / "whole.h5")


def test_channels_integrals_and_numbers(complete: Result) -> None:
    time, rate = complete["time"], 2.0 * complete["loss"].sum(axis=1)
    np.testing.assert_array_equal(complete["loss_sum"], rate)
    work = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(time) * (rate[1:] + rate[:-1]))])
    np.testing.assert_allclose(complete["work_lost"], work, rtol=1e-12)
    assert complete["contact_work"].shape == complete["contact_loss"].shape
    found = {number.name: number for number in complete.summary().observed}
    assert found["work"].value == complete["work_lost"][-1]
    assert found["work"].unit == "J"
    assert found["mean loss"].value == pytest.approx(rate.mean())
    assert "observed" in complete.summary().text()
    assert complete.observers[0]["parameters"] == '{"factor":2.0}'


def test_going_on_writes_what_an_uninterrupted_run_writes(complete: Result, tmp_path: Path) -> None:
    watched = with_observer(observer())
    path = tmp_path / "parts.h5"
    launch(model("3 ms", **watched), path)
    again = relaunch(path, model(**watched))
    for name in ("time", "loss_sum", "work_lost", "contact_work"):
        np.testing.assert_array_equal(again[name], complete[name], err_msg=name)


def test_the_motion_does_not_know_of_it(complete: Result, tmp_path: Path) -> None:
    bare = launch(model(), tmp_path / "bare.h5")
    np.testing.assert_array_equal(bare["ball_velocity"], complete["ball_velocity"])
    assert "loss_sum" not in [channel.name for channel in bare.channels]


def test_an_event_ends_the_run_and_says_so(tmp_path: Path) -> None:
    chosen = {"late": ChosenEvent(event(after(2.05e-3)), NoParameters(), "stop")}
    result = launch(model(events=chosen), tmp_path / "ended.h5")
    assert result.status().state == "finished"
    summary = result.summary()
    assert summary.reasons[0].startswith("ended by the event late at t = 0.002")
    assert 2.05e-3 < result["time"][-1] < 4e-3
    (seen,) = summary.events
    assert (seen.count, seen.action) == (1, "stop")
    assert seen.first_s == pytest.approx(2.1e-3, abs=1e-4)


def test_an_event_that_holds_from_the_start_says_so(tmp_path: Path) -> None:
    chosen = {"early": ChosenEvent(event(after(-1.0)), NoParameters(), "stop")}
    result = launch(model(events=chosen), tmp_path / "ended.h5")
    assert result["time"][-1] < 1e-3
    reasons = "; ".join(result.summary().reasons)
    assert re.search(r"early at t = 0 s: .*; it holds from the start: .*events\.early\.action", reasons)


def test_an_event_reads_what_observers_wrote(tmp_path: Path) -> None:
    def worn(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> Any:
        return samples["work_lost"] > 1e-3

    watched = with_observer(observer()) | {"events": {"worn": ChosenEvent(event(worn), NoParameters(), "record")}}
    result = launch(model(**watched), tmp_path / "worn.h5")
    (begun,) = result.events()["time"]
    assert result["work_lost"][result["time"] < begun].max() <= 1e-3 < result["work_lost"][-1]


def test_an_event_that_is_recorded_begins_again_and_again(tmp_path: Path) -> None:
    def often(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> Any:
        return np.sin(2.0 * np.pi * samples["time"] / 1e-3 + 1.0) > 0.0

    result = launch(model(events={"late": ChosenEvent(event(often), NoParameters(), "record")}), tmp_path / "often.h5")
    begun = result.events()
    assert 6 <= len(begun["time"]) <= 7
    assert set(begun["event"]) == {0.0}
    assert np.all(np.diff(begun["time"]) > 0.8e-3)


def losing(name: str, answer: Callable[[Mapping[str, Any], dict[str, Any]], Any]) -> Observer:
    """Return an observer with an answer of its own."""
    total, each = replace(LOSS, name=f"{name}_sum"), replace(EACH, name=f"{name}_power")

    def observe(samples: Mapping[str, Any], parameters: Any, model: Mapping[str, Any]) -> Any:
        return answer(samples, {total.name: samples["loss"].sum(axis=1), each.name: samples["contact_loss"]})

    numbers = (Number(f"mean {name}", total.name, "mean", "mean loss"),)
    return replace(observer(observe), name=name, channels=(total, each), integrals=(), numbers=numbers)


def failing(*_: Any) -> Any:
    print("hello")
    raise KeyError("rows")


FAILING: dict[str, tuple[Callable[..., Any], str]] = {
    "failing": (failing, r'the observer "failing" \(guest 1\.0\) fails: KeyError'),
    "writing": (lambda samples, right: samples["loss"].fill(0.0), "read-only"),
    "flat": (lambda samples, right: right | {"flat_sum": np.zeros(1)}, "returns flat_sum of shape"),
    "complex": (
        lambda samples, right: right | {"complex_sum": 1j * samples["time"]},
        "returns complex_sum as complex numbers, not real ones",
    ),
    "other": (lambda *_: 42, "returns other channels than it declares: other_sum, other_power"),
}


def test_observers_that_fail_stay_alone(complete: Result, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Isolate failing observers from run and observers."""
    chosen = {name: ChosenObserver(losing(name, answer), Factor()) for name, (answer, _) in FAILING.items()}
    result = launch(model(observers=chosen | with_observer(observer())["observers"]), tmp_path / "failed.h5")
    assert capfd.readouterr().out == ""
    for channel in ("load", "loss_sum", "contact_power"):
        np.testing.assert_array_equal(result[channel], complete[channel])
    summary = result.summary()
    assert len(summary.plugin_faults) == len(FAILING)
    for name, (_, words) in FAILING.items():
        assert np.isnan(result[f"{name}_sum"]).all()
        assert any(re.search(words, fault) for fault in summary.plugin_faults), name
    without = {number.name for number in summary.observed if number.value is None}
    assert without == {f"mean {name}" for name in FAILING}


def test_an_event_that_fails_stays_alone(tmp_path: Path) -> None:
    chosen = {"late": ChosenEvent(event(lambda *_: [1, 2]), NoParameters(), "stop")}
    result = launch(model(events=chosen), tmp_path / "failed.h5")
    assert result["time"][-1] == pytest.approx(6e-3, rel=0.02)
    assert "returns int64 of shape (2,), not bool" in result.summary().plugin_faults[0]


class Guests:
    """A registry with one observer, its twin, and one event."""

    def observer(self, name: str) -> Observer:
        return replace(observer(), name=name)

    def event(self, name: str) -> Event:
        return event(after(0.0), parameters=Factor)


def problems(**sections: Any) -> list[str]:
    case, ledger = api.case("6208-axial-1300").with_(**sections), Ledger()
    resolve_observers(case, Guests(), ledger)
    resolve_events(case, Guests(), ledger)
    return [f"{problem.where}: {problem.message}" for problem in ledger.problems]


def test_mistakes_in_a_case_have_their_place() -> None:
    assert not problems(observers={"losses": {"factor": 2.0}}, events={"late": {"action": "record", "factor": 3.0}})
    found = problems(
        observers={"losses": {"faktor": 2.0}, "twin": {}, "second": {}},
        events={"late": {"action": "halt"}, "later": {"factor": -1.0}},
    )
    assert found == [
        'observers.losses.faktor: "faktor" is not a known parameter of the observer losses; nearest: factor',
        "observers.second: writes the channel loss_sum, which twin writes already",
        "observers.second: writes the channel contact_power, which twin writes already",
        "observers.second: writes the channel work_lost, which twin writes already",
        "observers.second: writes the channel contact_work, which twin writes already",
        'events.late.action: "halt" is not allowed: write "stop" or "record"',
        "events.later.factor: the event late: -1.0: must be greater than 0",
    ]


def test_an_unknown_observer_is_a_problem_of_the_case() -> None:
    with pytest.raises(CaseError, match=r'observers\.waer +"waer" is not a known observer'):
        api.check("6208-axial-1300", ["observers.waer={}"])


def test_what_observers_do_belongs_to_what_a_run_is() -> None:
    plain, watched = model(), model(**with_observer(observer()))
    assert case_hash(plain) != case_hash(watched)
    assert case_hash(watched) == case_hash(model(**with_observer(observer())))


@pytest.mark.parametrize(
    ("item", "words"),
    [
        (observer(observer_api=0), "does not say for which version of the interface it is written: add observer_api=1"),
        (observer(observer_api=2), "is written for version 2 of the interface; this is 1"),
        (observer(reference=" "), "has no reference"),
        (observer(channels=()), "has no channel"),
        (observer(channels=(replace(LOSS, name="load"), EACH), integrals=()), "the channel name load is taken"),
        (observer(channels=(replace(LOSS, name="Loss"), EACH), integrals=()), "not in lower case with underscores"),
        (observer(channels=(LOSS, replace(EACH, dims=("bal",)))), 'has the dimension "bal"; there are: ring'),
        (observer(integrals=(Integral("w", of="x", unit="J", meaning=""),)), 'is of "x", which is not one of its'),
        (observer(numbers=(Number("n", "x", "mean", ""),)), 'is of "x", which is not one of its channels'),
        (observer(name="My Losses"), "is not in lower case with hyphens"),
        ("text", "registers a str"),
    ],
)
def test_an_observer_that_cannot_be_is_named(item: Any, words: str) -> None:
    assert words in Collection().take([Entry("lambda_observers", "guest 1.0", item)])


def test_an_event_that_cannot_be_is_named() -> None:
    class Taken(Parameters):
        action: float = parameter(1.0, "taken")

    for item, words in (
        (event(after(0.0), event_api=0), "add event_api=1"),
        (event(after(0.0), parameters=Taken), 'has a parameter "action": the word is taken'),
        (3, "registers a int"),
    ):
        assert words in Collection().take([Entry("lambda_events", "guest 1.0", item)])

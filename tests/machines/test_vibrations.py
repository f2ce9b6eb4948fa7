"""Test vibrations of a shaft in its bearings.

Followed where that is the answer, against runs a hundred times tighter.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.results.reader import Result
from lambda_core.solver.drivers.machine_motion import machine_engine
from lambda_core.solver.integrator.tableau import STAGES

WHEEL = 0.085  # [m]
VIBRATION = {"accuracy": "vibration"}
TIGHT = {"accuracy": "vibration", "resolve": "10 kHz", "tolerance": 1e-5}
DEFECT = {
    "ball_outer": {
        "models": {"surface": "defect"},
        "parameters": {"surface": {"width": "0.8 mm", "depth": "20 um", "azimuth": "188 deg"}},
    }
}


def box(solver: dict[str, Any] | None = None, **changes: Any) -> dict[str, Any]:
    """Return the template with solver settings.

    And changes.
    """
    return (
        tomllib.loads(shaft_text("geared-shaft", "box")) | ({"solver": solver} if solver is not None else {}) | changes
    )


def kicked(force: float, solver: dict[str, Any]) -> dict[str, Any]:
    """Return a shaft after a kick.

    In one bearing and a bushing, struck at its wheel for a millisecond.
    """
    found = box(solver, connections={"right": {"at": "148 mm", "y": "100 N/um", "z": "100 N/um"}})
    del found["bearings"]["right"]
    points = [["0 s", "0 N"], ["2 ms", "0 N"], ["2.5 ms", f"{force} N"], ["3 ms", "0 N"], ["3.5 ms", "0 N"]]
    found["loads"] = {"kick": {"at": "85 mm", "force_z": {"kind": "table", "points": points}}}
    return found


def ringing(solver: dict[str, Any]) -> Callable[[FloatArray], FloatArray]:
    """Return the wheel's ringing [m].

    Over time: half the difference of a kick upwards and one downwards.
    """
    found = []
    for force in (30.0, -30.0):
        engine = machine_engine(resolve_machine(kicked(force, solver)))
        engine._memory.control["sample_interval"] = 5e-5  # alike for averages
        assert engine.advance(0.0105).ok
        samples = engine.samples()
        wheel = int(np.argmin(np.abs(engine.start.shaft.positions - WHEEL)))
        found.append(CubicSpline(samples.machine["time"], samples.machine["shaft_position"][:, wheel, 2]))
    up, down = found
    return lambda at: 0.5 * np.asarray(up(at) - down(at))


@pytest.mark.full
def test_a_kick_rings_as_in_a_run_a_hundred_times_tighter() -> None:
    """Compare a kick with a run at tight tolerance.

    1.1 kHz with 1 % of damping and 0.1 um: to 1 % after eight swings, which the averages hardly show.
    """
    at = np.linspace(6e-3, 10e-3, 1000)
    true, followed, averages = (ringing(solver)(at) for solver in (TIGHT, VIBRATION, {}))
    size = float(np.std(true))
    assert 2e-8 < size < 1e-6
    assert float(np.std(followed - true)) < 0.01 * size  # 0.4 % measured
    assert float(np.std(averages - true)) > 0.5 * size
    assert float(np.std(averages)) < 0.5 * size


def test_another_course_of_a_load_is_another_run() -> None:
    """Count points of a table in the fingerprint.

    A run continues only with the fingerprint that it began with.
    """
    found = {machine_engine(resolve_machine(kicked(force, VIBRATION))).fingerprint() for force in (30.0, 31.0)}
    assert len(found) == 2


def test_modes_in_motion_are_those_of_the_rotor() -> None:
    """Compare eigenvalues of a run with the rotor.

    All balls, rings and lumps, against the beam on the bearings' matrices.

    To 8 %: the beam has no rings and balls (0.4 kg against 4 kg), and balls that stand still.
    """
    tables = box(VIBRATION)
    engine = machine_engine(resolve_machine(tables))
    assert engine.advance(2e-4).ok
    complete = np.array([frequency for frequency, damping in engine.modes()])
    assert np.all(np.diff(complete) > 0.0)
    rotor = [mode.frequency_Hz for mode in api.modes(tables).modes[:5]]
    near = [int(np.argmin(np.abs(complete / frequency - 1.0))) for frequency in rotor]
    assert len(set(near)) == 5
    assert complete[near] == pytest.approx(rotor, rel=0.08)


@pytest.mark.parametrize("is_shaken", [True, False])
def test_vibrations_choose_themselves(is_shaken: bool) -> None:
    """Choose vibrations for a defect or fast load.

    The defect is in one bearing; the load swings faster than the shaft turns.
    """
    found = box()
    assert resolve_machine(found).solver.resolve == 0.0
    if is_shaken:
        shaking = {"kind": "harmonic", "amplitude": "10 N", "frequency": "1.5 kHz"}
        found["loads"] = {"shaker": {"at": "85 mm", "force_z": shaking}}
        why, resolve = "the shaft is excited at 1.5 kHz", 3000.0
    else:
        found["bearings"]["right"]["forces"] = DEFECT
        why, resolve = "right: ball_outer has the surface law defect", 2000.0
    model = resolve_machine(found)
    assert [bearing.model.solver.resolve for bearing in model.bearings] == [resolve, resolve]
    assert any(why in sentence for sentence in model.assumptions)
    assert [b.model.laws["ball_outer"]["surface"].model.name for b in model.bearings] == [
        "none", "none" if is_shaken else "defect"
    ]  # fmt: skip
    engine = machine_engine(model)
    assert engine._memory.stages.shape[0] > STAGES
    assert engine.sample_interval <= 1.0 / (5.0 * resolve)
    assert float(engine._memory.control["longest_step"][0]) <= 1.0 / (6.0 * resolve)
    averages = resolve_machine({**found, "solver": {"accuracy": "averages"}})
    assert averages.solver.resolve == 0.0


def test_what_shakes_with_every_turn_is_not_faster() -> None:
    """Compare 11 Hz with 660 1/min.

    The last bit of their quotient does not count.
    """
    shaking = {"kind": "harmonic", "amplitude": "10 N", "frequency": "11 Hz"}
    load = {"shaker": {"at": "85 mm", "force_z": shaking}}
    assert resolve_machine(box(operation={"speed": "660 rpm"}, loads=load)).solver.resolve == 0.0
    assert resolve_machine(box(operation={"speed": "659 rpm"}, loads=load)).solver.resolve == 2000.0


def test_a_run_up_is_sampled_for_the_speed_that_it_reaches() -> None:
    up = {"kind": "ramp", "start": "0 rpm", "end": "3000 rpm", "start_time": "0 s", "end_time": "20 ms"}
    model = resolve_machine(box(operation={"speed": up}, gears={}, loads={"l": {"at": "85 mm", "force_z": "-400 N"}}))
    assert machine_engine(model).sample_interval < 1e-3


def test_steps_that_are_cut_are_said_once() -> None:
    shaking = {"kind": "harmonic", "amplitude": "10 N", "frequency": "1.5 kHz"}
    load = {"shaker": {"at": "85 mm", "force_z": shaking}}
    model = resolve_machine(box({"max_step": "1 ms"}, loads=load))
    assert [text for text in model.assumptions if "steps are at most" in text] == [
        "in motion steps are at most 55.6 us: solver.max_step is too long to resolve the vibrations"
    ]


@pytest.mark.parametrize(
    ("solver", "place", "words"),
    [
        ({"accuracy": "averages", "resolve": "1 kHz"}, "solver.resolve", 'needs solver.accuracy = "vibration"'),
        ({"resolve": "100 Hz"}, "solver.resolve", "the case is excited at 1.5 kHz"),
        ({"duration": "1 s", "max_duration": "0.5 s"}, "solver.duration", "is longer than solver.max_duration"),
        ({"duration": "1e9 s"}, "solver.duration", "at most"),
        ({"resolve": "1 MHz", "duration": "100 s"}, "solver.resolve", "samples of 100 s"),
        ({"accuracy": "vibrations"}, "solver.accuracy", "vibration"),
    ],
)
def test_settings_that_cannot_be_are_said_once(solver: dict[str, Any], place: str, words: str) -> None:
    found = box(solver)
    shaking = {"kind": "harmonic", "amplitude": "10 N", "frequency": "1.5 kHz"}
    found["loads"] = {"shaker": {"at": "85 mm", "force_z": shaking}}
    with pytest.raises(api.CaseError) as caught:
        resolve_machine(found)
    assert [problem.where for problem in caught.value.problems] == [place]
    assert words in caught.value.problems[0].message
    found["bearings"]["left"]["at"] = "2 m"
    with pytest.raises(api.CaseError) as caught:
        resolve_machine(found)
    assert {problem.where for problem in caught.value.problems} == {place, "bearings.left.at"}


def test_a_mistake_in_a_force_element_of_one_bearing_has_its_place() -> None:
    found = box()
    found["bearings"]["right"]["forces"] = {"ball_outer": {"models": {"surface": "defekt"}}}
    with pytest.raises(api.CaseError) as caught:
        resolve_machine(found)
    (problem,) = caught.value.problems
    assert problem.where == "bearings.right.forces.ball_outer.models.surface"
    assert "defect" in problem.message


@pytest.mark.full
def test_a_run_with_a_defect_balances_and_goes_on_bit_for_bit(tmp_path: Path) -> None:
    """Compare a stopped run with an undisturbed one.

    Every ball that crosses the defect strikes.
    """
    found = box()
    found["bearings"]["right"]["forces"] = DEFECT
    complete = api.run(found, ["solver.duration=6 ms"], out=tmp_path / "whole.h5").summary()
    assert complete.energy_residual is not None
    assert abs(complete.energy_residual) < 1e-3
    assert complete.vibrations is not None
    assert complete.vibrations.resolve_Hz == 2000.0
    assert complete.vibrations.modes
    assert "vibrations" in complete.text()
    api.run(found, ["solver.duration=3 ms"], out=tmp_path / "parts.h5")
    api.resume(tmp_path / "parts.h5", ["solver.duration=6 ms"])
    for name in ("left", "right"):
        one, other = (Result(tmp_path / f"{file}.h5", name) for file in ("whole", "parts"))
        assert one.integrals()[-1].tobytes() == other.integrals()[-1].tobytes()
        times = one["time"]
        assert np.array_equal(times, other["time"])
        assert float(np.diff(times).max()) <= 1.01 / (5.12 * 2000.0)


def test_a_time_that_no_machine_simulates_is_refused(tmp_path: Path) -> None:
    with pytest.raises(api.CaseError, match=r"at most 1000000 s"):
        api.run(box(), ["solver.duration=1e9 s"], out=tmp_path / "run")
    slow = {"operation": {"speed": "0.001 rpm"}, "gears": {}}
    assert resolve_machine(box(**slow)).solver.max_duration > 1e6  # of an equilibrium nobody asks
    with pytest.raises(api.UsageError, match=r"30 turns of a cage; give solver\.duration"):
        api.run(box(**slow), out=tmp_path / "run")
    with pytest.raises(api.UsageError, match="nothing turns, so the run needs a duration"):
        api.run(box(operation={"speed": "0 rpm"}, gears={}), out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.mark.full
def test_the_end_of_the_case_holds_where_none_is_given(tmp_path: Path) -> None:
    found = api.run(box({"duration": "2 ms"}), out=tmp_path / "run.h5")
    assert found.simulated_s == pytest.approx(2e-3, abs=5e-4)
    found = api.run(box({"duration": "100 s", "max_wall": "0.01 s"}), out=tmp_path / "stopped.h5").summary()
    assert found.state == "stopped"
    assert found.simulated_s < 10.0


def lines(solver: dict[str, Any]) -> tuple[FloatArray, FloatArray]:
    """Return the spectrum of the shaft's velocity.

    Frequencies [Hz], at the damaged bearing, (n, 2) [m/s].
    """
    rate, count, found = 81920.0, 4096, box(solver)
    found["bearings"]["right"]["forces"] = DEFECT
    engine = machine_engine(resolve_machine(found))
    engine._memory.control["sample_interval"] = 1.0 / rate
    assert engine.advance(0.062).ok
    samples = engine.samples()
    after = samples.machine["time"] > 0.01
    lump = int(np.argmin(np.abs(engine.start.shaft.positions - 0.148)))
    moved = samples.machine["shaft_position"][after][:count, lump, 1:]
    window, frequency = np.hanning(count)[:, None], np.fft.rfftfreq(count, 1.0 / rate)
    size = 2.0 * np.abs(np.fft.rfft((moved - moved.mean(axis=0)) * window, axis=0)) / window.sum()
    return frequency, size * (2.0 * np.pi * frequency)[:, None]


@pytest.mark.slow
def test_lines_of_a_defect_against_far_shorter_steps() -> None:
    """Compare lines with far shorter steps.

    The six largest between 0.1 and 2 kHz in either direction: 0.8 % measured; a spectrum has to hold 3 %.
    """
    frequency, true = lines({"accuracy": "vibration", "tolerance": 1e-5, "max_step": "5 us"})
    _, followed = lines({})
    inside = (frequency > 100.0) & (frequency < 2000.0)
    for axis in range(2):
        spectrum = np.where(inside, true[:, axis], 0.0)
        peaks = np.flatnonzero((spectrum[1:-1] > spectrum[:-2]) & (spectrum[1:-1] >= spectrum[2:])) + 1
        largest = peaks[np.argsort(spectrum[peaks])[-6:]]
        assert followed[largest, axis] == pytest.approx(true[largest, axis], rel=0.03)

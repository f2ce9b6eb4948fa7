"""Test a shaft in motion.

Lumps against the beam, bearings of the whole against the same alone, balance, result, resume.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from lambda_cli.main import main

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.whirl import natural_frequencies
from lambda_core.model.machine_model import PLACES, MachineModel
from lambda_core.model.machine_templates import shaft_text
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.results import reader
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.lumps import LumpedShaft, lump
from lambda_core.solver.drivers.machine_assembly import member_numbers
from lambda_core.solver.drivers.machine_motion import RING_SIGNS, RING_STATES, MachineEngine, machine_engine
from lambda_core.solver.drivers.tables import STATES

STIFF = (5e7, 1e8, 1e8, 1e3, 1e3)  # of a bearing [N/m, N m/rad]


def tables(**changes: Any) -> dict[str, Any]:
    """Return the template's tables with changes.

    With an unbalance.
    """
    found = tomllib.loads(shaft_text("geared-shaft", "box")) | changes
    if "wheel" in found["discs"]:
        found["discs"]["wheel"]["unbalance"] = "50 g mm"
    return found


LONG = {
    "shaft": {"sections": [{"length": "500 mm", "diameter": "40 mm"}]},
    "bearings": {
        "a": {"designation": "SKF 6208", "at": "50 mm"},
        "b": {"designation": "SKF 6208", "at": "450 mm", "support": {"x": "free"}},
    },
    "discs": {},
    "gears": {},
}


def frequencies(model: MachineModel, shaft: LumpedShaft) -> tuple[FloatArray, FloatArray]:
    """Return natural frequencies of lumps and beam.

    On the same springs.
    """
    lumped, beam = shaft.stiffness.copy(), model.body.stiffness.copy()
    places = np.array(PLACES)
    for bearing in model.bearings:
        rows, first = model.body.rows(bearing.position).start + places, 6 * shaft.at(bearing.position) + places
        lumped[first, first] += STIFF
        beam[rows, rows] += STIFF
    each = zip(shaft.mass, shaft.polar_inertia, shaft.transverse_inertia, strict=True)
    mass = np.diag([*np.ravel([[m, m, m, p, j, j] for m, p, j in each]), *[1.0] * (lumped.shape[0] % 6)])
    driven = 6 * shaft.driven + 3 if shaft.driven < shaft.mass.size else lumped.shape[0] - 1
    return natural_frequencies(lumped, mass, [driven])[0], natural_frequencies(beam, model.body.mass, [model.drive])[0]


@pytest.mark.parametrize("changes", [{}, LONG], ids=["gearbox", "ten diameters"])
def test_lumps_keep_mass_centre_inertia_and_low_frequencies(changes: dict[str, Any]) -> None:
    """Compare mass, inertia and frequencies of lumps.

    The gearbox shaft's first five to 0.3 %, ten diameters between bearings: the first six to 1 %.
    """
    model = resolve_machine(tables(**changes))
    shaft = lump(model)
    assert shaft.mass.sum() == pytest.approx(model.body.total_mass, rel=1e-12)
    turn = np.zeros(model.body.mass.shape[0])  # about z through the left end
    turn[1::6], turn[5::6] = model.body.positions, 1.0
    shift = np.zeros_like(turn)
    shift[1::6] = 1.0
    assert shaft.mass @ shaft.positions == pytest.approx(turn @ model.body.mass @ shift, rel=1e-9)
    inertia = shaft.mass @ shaft.positions**2 + shaft.transverse_inertia.sum()
    assert inertia == pytest.approx(turn @ model.body.mass @ turn, rel=1e-6)
    assert shaft.mass.min() > 0.0
    lumped, beam = frequencies(model, shaft)
    first, tolerance = (5, 3e-3) if not changes else (6, 1e-2)
    assert lumped[:first] == pytest.approx(beam[:first], rel=tolerance)


@pytest.fixture(scope="module")
def engine() -> MachineEngine:
    """Return the gearbox shaft at the beginning of its motion."""
    return machine_engine(resolve_machine(tables()))


def evaluated(engine: MachineEngine, y: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return dy/dt and forces without friction.

    The forces act on the bodies.
    """
    bundle = engine.context.bundle
    bundle.system["friction_on"], bundle.system["guides_on"] = 0, 0
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(bundle))
    assert core().evaluate(0.0, y, bundle, dydt, rates, 1) == 1
    bundle.system["friction_on"], bundle.system["guides_on"] = 1, 1
    return dydt, bundle.body_wrenches.view(np.float64).reshape(-1, 6).copy()


def test_the_motion_begins_in_equilibrium(engine: MachineEngine) -> None:
    """Start with only small forces on the lumps.

    They are the weight of the inner rings and the first push of the unbalance.
    """
    _, forces = evaluated(engine, engine._memory.y.copy())
    loads = engine.context.bundle.inputs["force"]["value"]
    weight = engine.context.bundle.bodies["mass"] * 9.80665
    for body in member_numbers(engine.model, engine.start.shaft).lumps:
        left = forces[body, :3] + loads[body] - [0.0, 0.0, weight[body]]
        assert np.abs(left).max() < 6.0  # of 700 N: rings 2 N, unbalance 50 g mm at 314 rad/s 4.9 N over all lumps


def test_a_bearing_of_a_machine_moves_as_it_does_alone(engine: MachineEngine) -> None:
    """Compare forces on balls bit by bit.

    Each bearing is compared with a model of that bearing alone.
    """
    y = engine._memory.y
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(engine.context.bundle))
    assert core().evaluate(0.0, y, engine.context.bundle, dydt, rates, 1) == 1
    bodies = engine._readings.shared(np.zeros(1), y.reshape(1, -1)).reshape(-1, L.NS)
    for part in engine.bearings:
        alone = part.context
        span = part.span
        balls = slice(L.NB * span.first_ball, L.NB * (span.first_ball + span.balls))
        own = np.concatenate([y[balls], bodies[list(span.bodies)].ravel()[alone.bundle.active], alone.bundle.states])
        slope, powers = np.zeros(own.size), np.zeros(L.power_count(alone.bundle))
        assert core().evaluate(0.0, own, alone.bundle, slope, powers, 1) == 1
        assert np.array_equal(slope[: L.NB * span.balls], dydt[balls])


def test_slopes_and_energy_of_the_ties(engine: MachineEngine) -> None:
    """Compare columns of the Jacobian with differences.

    The shaft bends only.
    """
    check_slopes(engine)


def check_slopes(engine: MachineEngine) -> None:
    """Check the slopes.

    The columns of a twist leave out terms of the order of the tilts, 2e-4 of them.
    """
    bundle, y = engine.context.bundle, engine._memory.y.copy()
    base = L.NB * int(bundle.system["balls"][0])
    middle = next(
        b for b in member_numbers(engine.model, engine.start.shaft).lumps if not bundle.bodies["mass"][b] < 1.0
    )
    bundle.system["friction_on"], bundle.system["guides_on"] = 0, 0
    evaluated(engine, y)
    bundle.system["friction_on"], bundle.system["guides_on"] = 0, 0
    assert core().jacobian(0.0, y, bundle, engine.context.blocks) == 1
    bundle.system["friction_on"], bundle.system["guides_on"] = 1, 1
    ours, steps = engine.context.blocks.d, np.array([1e-8, 1e-8, 1e-8, 1e-7, 1e-7, 1e-7])
    for state, step in zip(STATES, steps, strict=True):
        column = int(np.flatnonzero(bundle.active == L.NS * middle + state)[0])
        up, down = y.copy(), y.copy()
        up[base + column] += step
        down[base + column] -= step
        difference = (evaluated(engine, up)[0] - evaluated(engine, down)[0])[base : base + bundle.active.size]
        slope = difference / (2.0 * step)
        near = np.abs(ours[:, column] - slope) / (np.abs(slope).max() + 1.0)
        assert near.max() < (1e-4 if state != L.STHETA else 5e-4)


def test_a_shaft_that_twists() -> None:
    """Twist a shaft between gear and coupling.

    The coupling is at its left end: twist of the equilibrium, energy to 1e-3.
    """
    changed = tables(shaft={**tables()["shaft"], "twists": True})
    engine = machine_engine(resolve_machine(changed))
    check_slopes(engine)
    start = engine.start.state.displacement.reshape(-1, 6)[:, 3]
    expected = [start[engine.model.body.node(float(place))] for place in engine.start.shaft.positions]
    assert min(expected, key=abs) != 0.0
    assert engine.advance(1e-3).ok
    samples, rows = engine.samples(), engine.integrals()
    assert samples.machine["shaft_twist"][-1] == pytest.approx(expected, rel=0.01)
    assert samples.bearings[0]["body_spin"][:, 0] == pytest.approx(100.0 * np.pi, rel=1e-4)
    for row in rows:
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a continued run.

    A case and a run of 6 ms of it that went on to 9 ms, as after a kill.
    """
    found = tmp_path_factory.mktemp("motion")
    (found / "box.toml").write_text(shaft_text("geared-shaft", "box"))
    arguments = ["--set", 'discs.wheel.unbalance="50 g mm"', "--quiet", "--band", "none"]
    part = str(found / "part.h5")
    assert main(["run", str(found / "box.toml"), *arguments, "--out", part, "--duration", "6 ms"]) == 5
    abandon(found / "part.h5")
    assert main(["resume", part, "--quiet", "--duration", "9 ms"]) == 5
    return found


def abandon(path: Path) -> None:
    """Leave a file as a killed writer.

    Still marked as open, so that HDF5 lets nobody write to it.
    """
    kill = "import h5py, os, sys; f = h5py.File(sys.argv[1], 'r+', libver='latest'); f.swmr_mode = True; os._exit(0)"
    again = "import h5py, os, sys; from pathlib import Path; from lambda_core.results import hdf5; "
    again += "p = Path(sys.argv[1]); f = hdf5.open_for_reading(p); "
    again += (
        "from lambda_core.results.run_status import Status; s = Status.from_bytes(bytes(f['status'][()])); f.close(); "
    )
    again += "os.replace(hdf5.copy(p, s.rows, compress=False), p)"  # packed files have no format for writing on
    subprocess.run([sys.executable, "-c", f"{again}; {kill}", str(path)], check=True)
    with pytest.raises(OSError, match="already open for write"):
        h5py.File(path, "r+", libver="latest")


def test_a_run_says_what_it_found(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Report energy, forces and every bearing.

    Energy to 1e-3 (the bar of docs/convergence.md), forces in balance.
    """
    capsys.readouterr()
    assert main(["show", str(folder / "part.h5"), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert not found["converged"]
    assert any("revolutions" in reason for reason in found["reasons"])
    assert abs(found["energy_residual"]) < 1e-3
    assert found["simulated_s"] == pytest.approx(9e-3, abs=1e-4)
    model = api.check(folder / "box.toml")
    forces = np.sum([bearing["force_N"] for bearing in found["bearings"].values()], axis=0)
    given = model.gears["wheel"].force + np.array([0.0, 0.0, -9.80665 * model.body.total_mass])
    assert np.abs(forces + given).max() < 0.03 * np.abs(given).max()  # over a fraction of a turn: vibration, unbalance
    assert found["drive_torque_Nm"] == pytest.approx(-model.gears["wheel"].moment[0], rel=0.01)
    result = api.result(folder / "part.h5")
    for name, bearing in found["bearings"].items():
        alone = result.bearings[name].summary()
        assert alone.friction_torque_Nmm == bearing["friction_torque_Nmm"]
        assert alone.rating.reference_life_h == bearing["rating"]["reference_life_h"] > 1e4
        assert alone.power_loss_W == pytest.approx(1e-3 * alone.friction_torque_Nmm * 314.159, rel=1e-3)
    assert found["system_life_h"] < min(one["rating"]["reference_life_h"] for one in found["bearings"].values())
    assert result.friction_torque_Nmm == pytest.approx(sum(one.friction_torque_Nmm for one in result.bearings.values()))
    assert main(["show", str(folder / "part.h5")]) == 0
    assert "largest orbit" in capsys.readouterr().out


def test_a_run_goes_on_bit_for_bit(folder: Path) -> None:
    """Interrupt a run at 6 ms and continue it.

    The samples of the machine and of every bearing are the same.
    """
    other = folder / "whole.h5"
    changes = ["--set", 'discs.wheel.unbalance="50 g mm"', "--quiet", "--band", "none", "--duration", "9 ms"]
    assert main(["run", str(folder / "box.toml"), "--out", str(other), *changes]) == 5
    results = [api.result(path) for path in (folder / "part.h5", other)]
    first, second = results
    assert {"shaft_position", "reaction_force"} < {channel.name for channel in first.channels}
    for one, two in ((first, second), *zip(first.bearings.values(), second.bearings.values(), strict=True)):
        assert [channel.name for channel in one.channels] == [channel.name for channel in two.channels]
        for channel in one.channels:
            assert one[channel.name].tobytes() == two[channel.name].tobytes(), channel.name
    for name in first.bearings:
        assert np.array_equal(first.bearings[name].revolutions(), second.bearings[name].revolutions())


@pytest.mark.full
def test_a_gear_and_an_unbalance_until_converged(tmp_path: Path) -> None:
    """Converge torques to 1 % with gear and unbalance.

    6208 and 6206 of the template geared-shaft: energy to 1e-3; as in their equilibrium.
    """
    (tmp_path / "box.toml").write_text(shaft_text("geared-shaft", "box"))
    model = api.check(tmp_path / "box.toml", ['discs.wheel.unbalance="50 g mm"'])
    found = api.run(model, out=tmp_path / "run.h5").summary()
    assert found.converged, found.reasons
    assert abs(found.energy_residual) < 1e-3
    at_rest = api.quasistatic(model).bearings
    for name, one in found.bearings.items():
        assert abs(np.linalg.norm(one.force_N) / np.linalg.norm(at_rest[name].force_N) - 1.0) < 0.01
        assert one.friction_torque_Nmm == pytest.approx(at_rest[name].friction_torque_Nmm, rel=0.1)


@pytest.mark.slow
def test_six_bearings_on_one_shaft_until_converged(tmp_path: Path) -> None:
    """Converge six bearings on one shaft.

    Loads between all of them load every bearing.
    """
    free = {"support": {"x": "free"}}
    case = {
        "name": "six",
        "operation": {"speed": "3000 rpm"},
        "lubricant": {"name": "FVA3", "temperature": "70 degC"},
        "shaft": {"sections": [{"length": "600 mm", "diameter": "40 mm"}]},
        "bearings": {
            f"b{i}": {"designation": "SKF 6208", "at": f"{50 + 100 * i} mm"} | (free if i else {})
            for i in range(6)
        },
        "loads": {f"pull{i}": {"at": f"{100 + 100 * i} mm", "force_z": "-1000 N"} for i in range(5)},
    }  # fmt: skip
    found = api.run(case, ["solver.max_wall=900 s"], out=tmp_path / "run.h5").summary()
    assert found.converged, found.reasons
    assert abs(found.energy_residual) < 1e-3
    assert sum(one.force_N[2] for one in found.bearings.values()) == pytest.approx(5000.0, rel=0.02)


def test_what_does_not_go_together(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for arguments, said in (
        (["run", str(folder / "box.toml"), "--duration", "soon"], "duration"),
        (["run", str(folder / "box.toml"), "--out", str(folder / "part.h5")], "exists"),
        (["show", str(folder / "part.h5"), "--bearing", "middle"], '"middle" is not a known bearing'),
        (["resume", str(folder / "part.h5"), "--duration", "1 ms"], "nothing is left to do"),
    ):
        assert main(arguments) in (2, 3)
        assert said in " ".join(capsys.readouterr().err.split()), arguments


def test_what_changes_over_time() -> None:
    """Run up from 500 to 3000 1/min.

    In 4 ms: angle and speed are those of the ramp, energy is balanced to 1e-3.
    """
    ramp = {"kind": "ramp", "start": "500 rpm", "end": "3000 rpm", "end_time": "4 ms"}
    force = {"kind": "harmonic", "amplitude": "100 N", "frequency": "200 Hz"}
    changed = tables(operation={"speed": ramp}, loads={"push": {"at": "110 mm", "force_z": force}})
    with pytest.raises(api.CaseError, match="constant speed"):
        resolve_machine(changed)
    changed["gears"]["wheel"] |= {"power": None, "torque": "20 N m"}
    changed["gears"]["wheel"].pop("power")
    engine = machine_engine(resolve_machine(changed))
    assert engine.advance(2e-3).ok
    t, samples, rows = engine.time, engine.samples(), engine.integrals()
    ramped = np.pi / 30.0 * (500.0 + 2500.0 * samples.bearings[0]["time"] / 4e-3)
    assert samples.bearings[0]["body_spin"][:, 0] == pytest.approx(ramped, rel=1e-9)
    angle = np.pi / 30.0 * (500.0 * t + 0.5 * 2500.0 * t * t / 4e-3)
    for row in rows:
        assert row["inner_angle"] == pytest.approx(angle, rel=1e-4)
        assert row["relative_angle"] == pytest.approx(angle, rel=1e-4)
        losses = sum(value for name, value in row.items() if name.startswith("loss"))
        assert abs(row["input"] - losses - row["stored"]) < 1e-3 * row["input_abs"]


def test_signs_of_the_tied_states() -> None:
    """Compare signs with docs/frames.md.

    Turning about y moves a_z towards -, about z a_y towards +.
    """
    body = np.zeros(1, R.BODY_STATE)
    body.view(np.float64)[RING_STATES] = RING_SIGNS * [1.0, 2.0, 3.0, 0.1, 0.2]
    assert body["position"][0].tolist() == [1.0, 2.0, 3.0]
    assert (-body["tilt"][0, 1], body["tilt"][0, 0]) == (0.1, 0.2)


def test_a_machine_without_cages_counts_the_turns_of_its_balls() -> None:
    """Count turns by balls without a cage.

    The balls of the 6208 go round at 0.40 of the shaft's speed.
    """
    engine = machine_engine(resolve_machine(tables(), ["depth.cage=false"]))
    assert engine.advance(5e-3).ok
    for one, row in zip(engine.model.bearings, engine.integrals(), strict=True):
        g = one.model.geometry
        assert row["cage_angle"] / row["inner_angle"] == pytest.approx(
            0.5 * (1.0 - g.ball_diameter / g.pitch_diameter), rel=0.02
        )
        assert row["loss.pocket"] >= 0.0


def test_a_result_is_checked_once_for_all_of_its_parts(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Find machine and bearings from one of them."""
    checked = []
    check = reader.check_alone
    monkeypatch.setattr(reader, "check_alone", lambda file: checked.append(check(file)))
    left = reader.Result(folder / "part.h5", "left")
    assert [left.of_bearing(name).bearing for name in left.bearing_names] == list(left.bearing_names)
    assert left.of_machine().bearings == left.bearings
    assert left.of_machine().of_machine().bearing == ""
    assert not np.array_equal(left["load"], left.bearings["right"]["load"])
    assert len(checked) == 1

"""Test elastic rings and cages of bearings on shafts."""

from __future__ import annotations

import copy
import math
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE as CAGE_BODY
from lambda_core.domain.errors import CaseError
from lambda_core.model.resolve_machine import resolve_machine
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.damping import damping_matrix
from lambda_core.solver.drivers.dynamics import BearingEngine, initial_state
from lambda_core.solver.drivers.machine_motion import MachineEngine, machine_engine
from lambda_core.solver.drivers.machine_statics import solve_machine
from lambda_core.solver.drivers.modes import dense
from lambda_core.solver.drivers.stiffness import freed, stiffness_at

SOFT = {"housing_stiffness": "100 N/um", "orders": 4}
CAGE = {"orders": 3, "section_height": "3 mm", "section_width": "8 mm"}
COMMON: dict[str, Any] = {
    "operation": {"speed": "3000 rpm"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "gravity": {"z": "0 m/s2"},
}
BEARING = {"designation": "SKF 6319", "clearance": "CN"}
ONE: dict[str, Any] = {
    **COMMON,
    "name": "one",
    "shaft": {"sections": [{"length": "40 mm", "diameter": "95 mm"}], "drive": "20 mm"},
    "bearings": {"only": {**BEARING, "at": "20 mm", "elastic": {"outer_ring": SOFT, "cage": CAGE}}},
    "loads": {"pull": {"at": "20 mm", "force_z": "-16 kN"}},
}


def alone(**elastic: Any) -> api.BearingModel:
    """Return the shaft's bearing alone.

    In a case of its own, with the shaft's mass.
    """
    body = resolve_machine(ONE).body
    return api.check({
        **COMMON, "name": "alone", "bearing": BEARING, "elastic": elastic, "loads": {"radial": "16 kN"},
        "bodies": {"inner_ring": {"shaft_mass": f"{body.total_mass:.12g} kg"}},
    })  # fmt: skip


@pytest.fixture(scope="module")
def complete() -> MachineEngine:
    """Return the shaft in one bearing.

    At the beginning of its motion.
    """
    return machine_engine(resolve_machine(ONE))


def test_equilibrium_of_one_bearing(complete: MachineEngine) -> None:
    """Compare the pose with one bearing to 1e-4.

    The friction of that bearing's balls moves it by 6e-5, elastic or rigid.
    """
    found: QuasiStatic = api.quasistatic(alone(outer_ring=SOFT))
    pose = complete.start.state.pose(complete.model, 0)
    assert 1e6 * pose[2] == pytest.approx(found.inner_ring_displacement_um[2], rel=1e-4)
    rigid = copy.deepcopy(ONE)
    del rigid["bearings"]["only"]["elastic"]
    stiff = solve_machine(resolve_machine(rigid))
    assert stiff.pose(resolve_machine(rigid), 0)[2] > 1.05 * pose[2]  # down; the soft one goes further
    assert complete.start.state.stiffness[0][2, 2] < 0.8 * stiff.stiffness[0][2, 2]


def test_motion_of_one_bearing(complete: MachineEngine) -> None:
    """Compare 2 ms of motion with one bearing.

    Balls and waves to 1 % of the largest: the starts differ.
    """
    one = BearingEngine(alone(outer_ring=SOFT, cage=CAGE))
    engine = machine_engine(complete.model)
    assert one.advance(2e-3).ok
    assert engine.advance(2e-3).ok
    samples, other = engine.samples(), one.samples()
    (both,) = samples.bearings
    for name in ("outer_ring_waves_2", "outer_ring_waves_3", "outer_ring_ovality", "load", "ball_azimuth"):
        times, values = both["time"], both[name].reshape(both["time"].size, -1)
        reference = other[name].reshape(other["time"].size, -1)
        at = np.stack([np.interp(times, other["time"], column) for column in reference.T], axis=1)
        assert np.abs(values - at).max() < 1e-2 * np.abs(reference).max(), name


def feels_the_same(engine: MachineEngine) -> FloatArray:
    """Compare every bearing with itself alone.

    Balls and waves, bit for bit; returns the complete shared state.
    """
    y, bundle = engine._memory.y, engine.context.bundle
    dydt, rates = np.zeros(y.size), np.zeros(L.power_count(bundle))
    assert core().evaluate(0.0, y, bundle, dydt, rates, 1) == 1
    bodies = engine._readings.shared(np.zeros(1), y.reshape(1, -1)).reshape(-1, L.NS)
    slopes = np.array(bundle.shared_rates).reshape(-1, L.NS)
    for part in engine.bearings:
        one = part.context
        balls = slice(L.NB * part.span.first_ball, L.NB * (part.span.first_ball + part.span.balls))
        own = np.concatenate([y[balls], bodies[list(part.span.bodies)].ravel()[one.bundle.active], one.bundle.states])
        slope, powers = np.zeros(own.size), np.zeros(L.power_count(one.bundle))
        assert core().evaluate(0.0, own, one.bundle, slope, powers, 1) == 1
        assert np.array_equal(slope[: L.NB * part.span.balls], dydt[balls])
        waves = np.array(one.bundle.shared_rates).reshape(-1, L.NS)[3:]
        assert np.array_equal(waves, slopes[list(part.span.bodies[3:])])
    return bodies


def test_a_bearing_of_the_machine_moves_as_it_does_alone(complete: MachineEngine) -> None:
    """Compare forces with one bearing bit by bit.

    Balls, waves of both rings, and the cage.
    """
    changed = copy.deepcopy(ONE)
    parts = {"inner_ring": SOFT, "outer_ring": SOFT, "cage": CAGE}
    changed["shaft"] = {"sections": [{"length": "300 mm", "diameter": "95 mm"}]}
    changed["bearings"] = {
        name: {**BEARING, "at": place, "elastic": parts} for name, place in (("a", "40 mm"), ("b", "260 mm"))
    }
    changed["bearings"]["b"]["support"] = {"x": "free"}
    changed["loads"] = {"pull": {"at": "120 mm", "force_z": "-25 kN"}}
    changed["discs"] = {"wheel": {"at": "150 mm", "mass": "5 kg", "unbalance": "1 kg mm", "unbalance_angle": "50 deg"}}
    engine = machine_engine(resolve_machine(changed))
    bodies = feels_the_same(engine)
    # the start: waves of the outer rings rest, but for those of the equilibrium whose balls' friction was left out
    outer = [body for part in engine.bearings for body in part.span.bodies[6 : 6 + 3]]
    assert np.abs(bodies[outer][:, [L.SY, L.SZ]]).max() > 1e-6


def test_kinds_of_bearings_in_a_machine() -> None:
    """Place rows, raceways and laws of three kinds.

    Two rows, four-point contact and one row.
    """
    changed = copy.deepcopy(ONE)
    changed["shaft"] = {"sections": [{"length": "300 mm", "diameter": "40 mm"}]}
    floats = {"support": {"x": "free"}, "elastic": {"outer_ring": SOFT, "cage": {"orders": 2}}}
    changed["bearings"] = {
        "a": {"designation": "SKF 3208 A", "at": "30 mm", "elastic": {"outer_ring": SOFT}},
        "b": {"designation": "SKF QJ 208", "at": "150 mm", **floats},
        "c": {"designation": "SKF 6208", "at": "270 mm", "clearance": "CN", **floats},
    }
    changed["loads"] = {"pull": {"at": "150 mm", "force_z": "-5 kN", "force_x": "500 N"}}
    engine = machine_engine(resolve_machine(changed))
    feels_the_same(engine)
    assert engine.advance(2e-4).ok


def test_damping_lets_waves_follow(complete: MachineEngine) -> None:
    """Compare damping of a ring with waves.

    200 times as heavy, free along z: the complete Jacobian's damping to 4 %.

    As in test_damping.test_a_ring_that_vibrates, where rings are rigid: the eigenvalue near sqrt(k/m), balls and the
    outer ring's waves moving, against k and c of the matrices at that frequency. With waves at rest the damping is
    another one by a tenth and more.
    """
    (found,) = complete.start.equilibria
    context = freed(found.context)
    count, mass = context.model.geometry.balls, 200.0 * context.model.inner_ring.mass
    context.bundle.bodies["mass"][0] = mass
    shared = found.context.bundle.shared.copy()
    shared[found.context.bundle.active] = found.context.shared_part(initial_state(found))
    kept = found.state[found.state.size - found.context.bundle.states.size :]
    y = np.concatenate([found.state[: L.NB * count], shared[context.bundle.active], kept])
    assert core().evaluate(0.0, y, context.bundle, np.zeros(y.size), np.zeros(L.power_count(context.bundle)), 0) == 1
    assert core().jacobian(0.0, y, context.bundle, context.blocks) == 1
    matrix = dense(context.blocks)
    rows = context.bundle.waves
    bent = [L.NS * int(b) + k for b in rows["body"][rows["ring"] != CAGE_BODY] for k in (L.SY, L.SZ, L.SVY, L.SVZ)]
    assert len(bent) == 4 * 3  # two to four waves of the outer ring
    moving = [i for i in range(count * L.NB) if i % L.NB != L.BPSI]
    moves = [*moving, *(count * L.NB + int(context.blocks.index[k]) for k in (*bent, L.SZ, L.SVZ))]
    values, vectors = np.linalg.eig(matrix[np.ix_(moves, moves)])
    guess = np.sqrt(stiffness_at(found.context, freed(found.context), found.state, found.displacement)[2, 2] / mass)
    near = np.flatnonzero((values.imag > 0.9 * guess) & (values.imag < 1.1 * guess))
    root = values[near[np.argmax(np.abs(vectors[-1, near]))]]
    c = damping_matrix(found, float(root.imag))[2, 2]
    assert root.imag == pytest.approx(guess, rel=0.02)
    assert -root.real == pytest.approx(0.5 * c / mass, rel=0.04)
    still = [*moving, *moves[-2:]]  # waves at rest: another stiffness and another damping
    others = np.linalg.eigvals(matrix[np.ix_(still, still)])
    stiff = others[(others.imag > 1.05 * guess) & (others.imag < 1.6 * guess)]
    assert stiff.size
    assert min(abs(-2.0 * mass * one.real / c - 1.0) for one in stiff) > 0.1


def test_balance_of_a_run() -> None:
    """Balance energy to 1e-3.

    The dampers of the waves count to their bearing.
    """
    engine = machine_engine(resolve_machine(ONE))
    assert engine.advance(6e-3).ok
    (row,) = engine.integrals()
    losses = {name: value for name, value in row.items() if name.startswith("loss")}
    assert abs(row["input"] - sum(losses.values()) - row["stored"]) < 1e-3 * row["input_abs"]
    assert losses["loss.bending"] > 0.0
    assert math.isfinite(row["stored"])


def test_a_mistake_is_named_where_it_stands() -> None:
    changed = copy.deepcopy(ONE)
    changed["bearings"]["only"]["elastic"]["outer_ring"] = {"orders": 3}
    with pytest.raises(CaseError, match=r"bearings\.only\.elastic\.outer_ring\.housing_stiffness"):
        resolve_machine(changed)
    changed["bearings"]["only"]["elastic"] = {"cage": {"section_height": "400 mm"}}
    with pytest.raises(CaseError, match=r"bearings\.only\.elastic\.cage\.section_height"):
        resolve_machine(changed)

"""Test an elastic cage.

Natural frequencies, pinched by two pockets, turning, rigid limit, balance of a run, resuming.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import fsolve

from lambda_core import api
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CaseError
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine

from .ring_of_beams import waves_of_beams
from .support import integrate, machine

CASE = "6319-cp10-3000"
THIN = ("elastic.cage.section_height=3 mm", "elastic.cage.section_width=8 mm")
FIRST = 3  # body of two waves
ALONE = (
    "models.cage_contact=none", "gravity.z=0 m/s2", "loads.radial=0 N", "bearing.clearance=300 um",
    "models.fluid_drag=none", "elastic.cage.damping_ratio=0",
)  # fmt: skip


def thin_ring(waves: int) -> float:
    """Return a thin ring's frequency [rad/s].

    Natural angular frequency of the cage as a free ring.

    n (n^2 - 1)/sqrt(n^2 + 1) sqrt(E I/(m/(2 pi R) R^4)) (Love 1927, art. 293), of the cage's mass and the case's words.
    """
    model = api.check(CASE, THIN)
    radius, line = 0.5 * model.geometry.pitch_diameter, model.cage_body.mass / (math.pi * model.geometry.pitch_diameter)
    stiffness = model.cage_material.youngs_modulus * 8e-3 * 3e-3**3 / 12.0
    return waves * (waves**2 - 1) / math.sqrt(waves**2 + 1) * math.sqrt(stiffness / line) / radius**2


def test_natural_frequencies() -> None:
    """Compare a free cage's frequencies to 0.1 %.

    From a run of the compiled core, against the exact ones of a thin ring.
    """
    m = machine(*THIN, *ALONE, "operation.speed=100 rpm", case=CASE)
    start, shortest = m.at_rest(), 2.0 * math.pi / thin_ring(4)
    start.shared[FIRST : FIRST + 3, L.SY] = 20e-6
    with m.frictionless():
        motion = integrate(m, m.vector(start), 18.0 * shortest, 1e-6, samples=1800, fine=True, longest=shortest / 40.0)
    swings = np.array([m.state(y).shared[FIRST : FIRST + 3, L.SY] for y in motion.states]).T
    for waves, swing in zip((2, 3, 4), swings, strict=True):
        falling = np.flatnonzero((swing[:-1] > 0.0) & (swing[1:] <= 0.0))
        crossings = motion.times[falling] + np.diff(motion.times)[falling] * swing[falling] / -np.diff(swing)[falling]
        assert crossings.size >= 3
        assert np.diff(crossings).mean() == pytest.approx(2.0 * math.pi / thin_ring(waves), rel=1e-3)


def test_pinched_by_two_pockets() -> None:
    """Pull opposite pockets and compare with Timoshenko.

    (pi/4 - 2/pi) F R^3/(E I) wider, 0.1 % with 12 waves.

    Across, it becomes narrower by (2/pi - 1/2) F R^3/(E I). The force is the one that the balls feel.
    """
    m = machine(
        *THIN,
        "elastic.cage.orders=12",
        "gravity.z=0 m/s2",
        "bearing.geometry.ball_count=8",
        "parameters.cage_contact.film_width=0",
        case=CASE,
    )
    assert m.count == 8
    state, waves = m.at_rest(), slice(FIRST, FIRST + 11)
    state.balls[[0, 4], L.BR] += 0.5 * m.model.cage.pocket_clearance + 60e-6

    def unbalanced(cosines: FloatArray) -> FloatArray:
        state.shared[waves, L.SY] = cosines
        m.evaluate(m.vector(state))
        return np.array(m.context.bundle.body_rates["velocity"][waves, 1])

    state.shared[waves, L.SY] = fsolve(unbalanced, np.zeros(11), xtol=1e-13)
    cosines = state.shared[waves, L.SY]
    found = m.evaluate(m.vector(state))
    pockets = m.observe(m.vector(state))["pocket_force"]
    force = -pockets[0, 1]
    assert force > 1.0
    assert pockets[4, 1] == pytest.approx(-force, rel=1e-9)
    assert found.body_forces[2, :3] == pytest.approx(0.0, abs=1e-9 * force)
    ring = m.model.elastic["cage"].ring
    unit = force * ring.radius**3 / (ring.youngs_modulus * 8e-3 * 3e-3**3 / 12.0)
    orders = np.arange(2, 13)
    assert 2.0 * cosines.sum() == pytest.approx((math.pi / 4.0 - 2.0 / math.pi) * unit, rel=1e-3)
    across = 2.0 * float(cosines @ np.cos(orders * math.pi / 2.0))
    assert -across == pytest.approx((2.0 / math.pi - 0.5) * unit, rel=1e-3)


def test_pushed_round_by_four_pockets() -> None:
    """Compare bending by four pockets to 1 %.

    Balls push the cage to and fro along its circumference, which bends it as a ring of straight beams.

    At 0, 90, 180 and 270 degrees, forwards and backwards in turn: in balance, and two waves of it.
    """
    m = machine(*THIN, "elastic.cage.orders=6", "gravity.z=0 m/s2", "bearing.geometry.ball_count=8",
                "parameters.cage_contact.film_width=0", case=CASE)  # fmt: skip
    state, waves = m.at_rest(), slice(FIRST, FIRST + 5)
    turn = (0.5 * m.model.cage.pocket_clearance + 20e-6) / (0.5 * m.model.geometry.pitch_diameter)
    state.balls[[0, 2, 4, 6], L.BPSI] += turn * np.array([1.0, -1.0, 1.0, -1.0])

    def unbalanced(amplitudes: FloatArray) -> FloatArray:
        state.shared[waves, L.SY : L.SZ + 1] = amplitudes.reshape(-1, 2)
        m.evaluate(m.vector(state))
        return np.array(m.context.bundle.body_rates["velocity"][waves, 1:]).ravel()

    found = fsolve(unbalanced, np.zeros(10), xtol=1e-13).reshape(-1, 2)
    unbalanced(found)
    pushes = -m.observe(m.vector(state))["pocket_force"][[0, 2, 4, 6]]
    assert np.abs(pushes[:, 2]).min() > 5.0 * np.abs(pushes[:, 1]).max()
    ring, azimuths = m.model.elastic["cage"].ring, state.balls[[0, 2, 4, 6], L.BPSI]
    # the law's force stands in the frame of the ball: turned into that of its pocket
    places = 0.5 * math.pi * np.arange(4)
    c, s = np.cos(azimuths - places), np.sin(azimuths - places)
    forces = np.stack([pushes[:, 1] * c - pushes[:, 2] * s, pushes[:, 1] * s + pushes[:, 2] * c], axis=1)
    bending = ring.youngs_modulus * ring.second_moment
    beams = waves_of_beams(ring.radius, bending, 0.0, forces, places, 2)
    assert found[0] == pytest.approx(beams, abs=0.01 * np.abs(beams).max())
    assert np.abs(found[0]).max() > 1e-6


def test_the_pattern_of_a_turning_cage_lags() -> None:
    """Compare the lag with Bryan 1890 to 1 %.

    Two waves fall back by 0.400 of the cage's speed, from a run.
    """
    m = machine(*THIN, *ALONE, "operation.speed=100 rpm", "elastic.cage.orders=2", case=CASE)
    spin, period = 5e-3 * thin_ring(2), 2.0 * math.pi / thin_ring(2)
    start = m.at_rest()
    start.shared[2, L.SSIGMA], start.shared[FIRST, L.SY] = spin, 20e-6
    with m.frictionless():
        motion = integrate(m, m.vector(start), 20.0 * period, 1e-6, samples=2000, fine=True, longest=period / 40.0)
    seen = np.array([m.state(y).shared[FIRST] for y in motion.states])
    size = np.hypot(seen[:, L.SY], seen[:, L.SZ])
    last = np.flatnonzero(motion.times > 16.0 * period)
    at = int(last[np.argmax(size[last])])
    turned = math.atan2(seen[at, L.SZ], seen[at, L.SY])
    turned -= math.pi * round(turned / math.pi)
    assert -turned / 2.0 / motion.times[at] / spin == pytest.approx(0.400, rel=0.01)


def test_a_stiff_cage_is_the_rigid_one() -> None:
    """Compare a stiff with a rigid cage to 1e-6.

    The cage is 1e9 times as wide; balls, rings and cage after 2 ms of the same steps.
    """
    ends = []
    for changes in ((), (THIN[0], "elastic.cage.section_width=8e6 m", "elastic.cage.damping_ratio=0.5")):
        engine = BearingEngine(api.check(CASE, (*changes, "solver.max_step=2 us", "solver.tolerance=1e-2")))
        assert engine.advance_exactly(2e-3).ok
        ends.append(engine.now())
    for name in ("ball_azimuth", "ball_radius", "ball_velocity", "body_position", "body_spin", "load", "loss"):
        rigid, stiff = (end[name] for end in ends)
        assert np.abs(stiff - rigid).max() < 1e-6 * np.abs(rigid).max(), name
    assert np.abs(ends[1]["cage_waves_2"]).max() < 1e-12
    assert ends[1]["cage_ovality"] < 1e-11


def test_energy_and_waves_of_a_run() -> None:
    """Balance energy to 1e-3 with a bending cage."""
    engine = BearingEngine(api.check(CASE, THIN))
    assert engine.advance(0.02).ok
    integrals = engine.integrals()
    lost = sum(value for name, value in integrals.items() if name.startswith(("loss.", "support")))
    assert abs(integrals["input"] - lost - integrals["stored"]) < 1e-3 * integrals["input_abs"]
    assert integrals["loss.bending"] > 0.0
    samples = engine.samples()
    assert samples["cage_waves_4"].shape == (samples["time"].size, 2)
    assert samples["cage_ovality"].max() > 1e-6
    ellipse = np.hypot(*samples["cage_waves_2"].T)
    assert np.all(samples["cage_ovality"] <= 4.0 * (ellipse + np.hypot(*samples["cage_waves_4"].T)) * (1.0 + 1e-9))
    assert np.all(samples["cage_ovality"] >= 0.0)


def test_a_continued_run_is_the_uninterrupted_one() -> None:
    model = api.check(CASE, (*THIN, "elastic.outer_ring.housing_stiffness=100 N/um", "elastic.outer_ring.orders=3"))
    complete, first, second = (BearingEngine(model) for _ in range(3))
    complete.advance(2e-3)
    complete.advance(4e-3)
    first.advance(2e-3)
    second.restore(first.state())
    second.advance(4e-3)
    for name, value in complete.now().items():
        np.testing.assert_array_equal(second.now()[name], value, err_msg=name)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"elastic": {"cage": {"housing_stiffness": "1 N/m"}}}, "elastic.cage.housing_stiffness"),
        ({"elastic": {"cage": {"orders": 1}}}, "elastic.cage.orders"),
        ({"elastic": {"cage": {"section_height": "400 mm"}}}, "leaves no hole in the cage"),
        ({"elastic": {"cage": {}}, "depth": {"cage": False}}, "there is no cage"),
    ],
)
def test_mistakes(changes: dict[str, dict[str, object]], said: str) -> None:
    with pytest.raises(CaseError) as caught:
        api.check(api.case(CASE).with_(**changes))
    assert said in str(caught.value)

"""Test the formula for vibrations.

Order, what it takes of a swing, energy, samples, continuation.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import least_squares

from lambda_core import api
from lambda_core.results.numerical_damping import NumericalDamping, added
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import continue_static, first_state
from lambda_core.solver.integrator.tableau import EMBEDDED, LOSS, NODES, WEIGHTS, A

from .support import FloatArray, Machine, Motion, integrate, machine
from .test_free_motion import EMPTY

FREQUENCY = 474.0  # [Hz] of a ring of 5 kg on a 6208 under 1 300 N along the shaft
AXIAL = "6208-axial-700"


@cache
def spring() -> Machine:
    """Return a ring on a spring.

    A bearing without contacts, along the shaft.
    """
    empty = machine(*EMPTY, "gravity.z=0 m/s2")
    stiffness = float(empty.constant("mass")[0]) * (2.0 * np.pi * FREQUENCY) ** 2
    held = f'bodies.inner_ring.x={{mode="free", stiffness="{stiffness!r} N/m"}}'
    return machine(*EMPTY, "gravity.z=0 m/s2", held)


def swing(
    amplitude: float, cycles: float, *, longest: float, samples: int, tolerance: float = 1e-3, fine: bool = True
) -> Motion:
    """Let the ring swing without loss.

    From its turning point.
    """
    m = spring()
    start = m.at_rest()
    start.shared[0, L.SX] = amplitude
    return integrate(m, m.vector(start), cycles / FREQUENCY, tolerance, samples=samples, fine=fine, longest=longest)


def place(motion: Motion) -> FloatArray:
    """Return the ring's place.

    All directions of the motion are free.
    """
    return np.array(motion.states[:, L.NB * spring().count + list(spring().active).index(L.SX)])


def exact(motion: Motion, amplitude: float) -> FloatArray:
    return np.array(amplitude * np.cos(2.0 * np.pi * FREQUENCY * motion.times))


def test_the_tableau_has_its_order() -> None:
    """Check order 4, embedded 3, and L-stability.

    Order conditions of Hairer, Norsett and Wanner, II.2.
    """
    c, ones = NODES, np.ones(NODES.size)
    trees = (ones, c, c**2, A @ c, c**3, c * (A @ c), A @ c**2, A @ A @ c)
    wanted = (1.0, 1 / 2, 1 / 3, 1 / 6, 1 / 4, 1 / 8, 1 / 12, 1 / 24)
    assert [float(WEIGHTS @ tree) for tree in trees] == pytest.approx(wanted, abs=1e-14)
    assert [float(EMBEDDED @ tree) for tree in trees[:4]] == pytest.approx(wanted[:4], abs=1e-14)
    for weights in (WEIGHTS, EMBEDDED):
        far = 1e9
        assert abs(1.0 - far * weights @ np.linalg.solve(np.eye(6) + far * A, ones)) < 1e-7
    assert ones @ LOSS @ ones == pytest.approx(0.0, abs=1e-14)  # 2 b.c - (sum b)^2


def test_its_error_goes_with_the_fourth_power_of_the_step() -> None:
    """Compare the error at halved steps.

    Where the ring passes its middle, after 4.25 periods, with the longest steps.
    """
    errors = []
    for steps in (16, 32):
        motion = swing(1e-6, 4.25, longest=1.0 / (steps * FREQUENCY), samples=17, tolerance=0.1)
        assert motion.steps < 4.3 * steps + 40
        errors.append(np.abs(place(motion) - exact(motion, 1e-6))[-1])
    assert errors[0] / errors[1] == pytest.approx(16.0, rel=0.25)


@pytest.mark.parametrize("amplitude", [0.1e-6, 20e-6])
def test_a_swing_without_a_loss_stays(amplitude: float) -> None:
    """Keep energy and frequency of a swing.

    Seven periods with steps for 1 kHz: 0.1 % of the energy in 28 at most; the frequency within 0.02 %.
    """
    motion = swing(amplitude, 7.0, longest=1.0 / (6.0 * 1000.0), samples=280)
    x, t = place(motion), 2.0 * np.pi * FREQUENCY * motion.times

    def off(p: FloatArray) -> FloatArray:
        return np.array(p[0] * np.exp(-p[1] * t) * np.cos((1.0 + p[2]) * t) - x / amplitude)

    found = least_squares(off, [1.0, 0.0, 0.0], x_scale=[1.0, 1e-3, 1e-3])
    assert abs(2.0 * found.x[1] * 28.0 * 2.0 * np.pi) < 1e-3  # share of the energy in 28 periods
    assert abs(found.x[2]) < 2e-4
    # Samples between steps, w h = 1/2, are off by (w h)^6/720 x 0.14 at most; at the start by the cubic's (w h)^4/384.
    assert np.abs(found.fun).max() < 2e-4


def test_a_swing_in_contacts_of_hertz_without_a_loss_stays() -> None:
    """Keep a swing in contacts of Hertz.

    5 kg on an axial 6208 under 1 300 N, released from its rest under the load that presses it 20 um further.

    No friction, no damping, no gravity; 28 periods with the default's steps for 2 kHz. Contacts are not linear: the
    ring swings 23.5 um to the other side, at 466 Hz.
    """
    case, load, pressed = "6208-axial-1300", 1300.0, 2401.6  # [N]
    alone = ("depth.cage=false", "models.damping=none", "models.fluid_drag=none", "gravity.z=0 m/s2",
             "operation.speed=0.01 rpm", "bodies.inner_ring.mass=5 kg")  # fmt: skip

    def at_rest(axial: float) -> tuple[Machine, FloatArray]:
        m = machine(*alone, f"loads.axial={axial} N", case=case)
        state = first_state(m.context, 0.0)
        continue_static(core(), m.context, state, friction=False)
        return m, state

    (m, middle), (_, start) = at_rest(load), at_rest(pressed)
    assert m.state(start).shared[0, L.SX] - m.state(middle).shared[0, L.SX] == pytest.approx(20e-6, rel=1e-3)
    with m.frictionless():
        motion = integrate(m, start, 28.0 / 465.5, 1e-3, samples=60, fine=True, longest=1.0 / (6.0 * 2000.0))

    def energy(y: FloatArray) -> float:
        return m.stored(y) - load * float(m.state(y).shared[0, L.SX])

    swing = np.array([energy(y) for y in motion.states]) - energy(middle)
    assert np.abs(swing / (energy(start) - energy(middle)) - 1.0).max() < 1e-3
    x = np.array([m.state(y).shared[0, L.SX] for y in motion.states]) - m.state(middle).shared[0, L.SX]
    assert x.max() > 15e-6
    assert x.min() < -20e-6


@pytest.mark.parametrize(("fine", "steps"), [(False, 20.0), (False, 50.0), (True, 6.0)])
def test_what_a_formula_does_to_a_swing_is_foretold(fine: bool, steps: float) -> None:
    """Compare damping with the root of its formula.

    To a tenth; and for BDF2 in short steps with (w h)^3/4 and -(w h)^2/3.
    """
    motion = swing(
        1e-6, 40.0 if fine else 8.0, longest=1.0 / (steps * FREQUENCY), samples=400, tolerance=0.1, fine=fine
    )
    x, t = place(motion), 2.0 * np.pi * FREQUENCY * motion.times

    def off(p: FloatArray) -> FloatArray:
        wave = p[0] * np.cos((1.0 + p[2]) * t) + p[3] * np.sin((1.0 + p[2]) * t)
        return np.array((np.exp(-p[1] * t) * wave - x / 1e-6)[40:])

    found = least_squares(off, [1.0, 0.0, 0.0, 0.0], x_scale=[1.0, 1e-3, 1e-3, 1.0]).x
    angle = 2.0 * np.pi / steps
    damping, shift = added(angle, fine=fine)
    assert found[1] == pytest.approx(damping, rel=0.1, abs=1e-5)
    assert found[2] == pytest.approx(shift, rel=0.1, abs=1e-5)
    if not fine and steps > 40.0:
        assert (damping, shift) == pytest.approx((angle**3 / 4.0, -(angle**2) / 3.0), rel=0.1)


def test_of_long_steps_the_damping_still_holds() -> None:
    """Compare damping with eight periods per step.

    4 % of critical for each, not the 0.1 % of half a period; the frequency is lost.
    """
    damping, shift = added(8.0 * 2.0 * np.pi, fine=True)
    assert 0.03 < damping < 0.05
    assert shift == -1.0


def test_a_frequency_that_a_step_does_not_see_is_shifted_by_100_percent() -> None:
    """Write large shares without an exponent.

    It was "-1e+02 %".
    """
    note = NumericalDamping(resolve_Hz=0.0, step_s=1e-3, modes=[]).note(5000.0)
    assert "at 5 kHz and shifts it by -100 %, at 2.5 kHz" in note
    assert "e+" not in note


def test_a_run_says_how_far_its_vibrations_can_be_believed(tmp_path: Path) -> None:
    """Report how far the vibrations are resolved.

    The axial 6208 has a mode of its rings near 1.2 kHz with hardly any damping; BDF2 damps it by percents.
    """
    said, reach = {}, {}
    for accuracy in ("averages", "vibration"):
        out = tmp_path / f"{accuracy}.h5"
        found = api.run(AXIAL, [f'solver.accuracy="{accuracy}"', "solver.duration=20 ms"], out=out).summary().vibrations
        assert found is not None
        low = [mode for mode in found.modes if 1000.0 < mode.frequency_Hz < 1400.0]
        assert low
        assert min(mode.damping_percent for mode in low) < 1.0
        said[accuracy] = found.sentence(), found.note(1000.0), found.at(1000.0)[0]
        reach[accuracy] = max(float(series.x.max()) for series in api.view(out, "ring-spectrum").panels[0].series)
    assert said["averages"][0].startswith("damped by the integration: ")
    assert 0.5 < said["averages"][2] < 10.0
    assert said["vibration"][0] == "resolved to 2 kHz, 0.002 % damping added"
    assert said["vibration"][2] < 1e-3
    assert "at 1 kHz" in said["averages"][1]
    assert reach["vibration"] == pytest.approx(2000.0, rel=0.05)


@cache
def decay(accuracy: str, amplitude: float) -> tuple[float, float]:
    """Return frequency [Hz] and damping ratio.

    A ring of 5 kg swings along the shaft of a turning 6208.

    The difference of two runs that are displaced to either side: balls passing, and what the start excites, cancel.
    """
    traces = []
    for side in (-1.0, 1.0):
        engine = BearingEngine(
            api.check(
                AXIAL,
                [
                    "bodies.inner_ring.shaft_mass=5 kg", "loads.axial=1300 N", "depth.cage=false",
                    "output.interval=0.1 ms", "solver.duration=1 s", *accuracy.split(),
                ],
            )
        )  # fmt: skip
        tail = L.NB * engine.model.geometry.ball_count
        x = tail + list(engine.context.bundle.active).index(L.SX)
        engine._memory.y[x] += side * amplitude
        assert engine.advance(20.0 / FREQUENCY).ok
        times, states = engine.buffered()
        traces.append(states[:400, x])
    t, y = times[:400], (traces[1] - traces[0]) / (2.0 * amplitude)
    late = t > 2e-3

    def off(p: FloatArray) -> FloatArray:
        phase = 2.0 * np.pi * p[0] * t[late]
        wave = p[2] * np.cos(phase) + p[3] * np.sin(phase)
        return np.array(np.exp(-2.0 * np.pi * p[0] * p[1] * t[late]) * wave + p[4] + p[5] * t[late] - y[late])

    found = least_squares(off, [470.0, 0.01, 1.0, 0.0, 0.0, 0.0], x_scale=[1.0, 1e-3, 1.0, 1.0, 0.1, 1.0])
    return float(found.x[0]), float(found.x[1])


@pytest.mark.parametrize("amplitude", [0.1e-6, 20e-6])
def test_a_swing_of_a_bearing_keeps_its_frequency_and_damping(amplitude: float) -> None:
    """Compare with a hundredfold tighter run.

    Frequency within 0.2 %, damping within 0.05 % of critical.
    """
    fine = decay('solver.accuracy="vibration" solver.resolve="474Hz"', amplitude)
    finer = decay('solver.accuracy="vibration" solver.resolve="4kHz" solver.tolerance=1e-5', amplitude)
    assert fine[0] == pytest.approx(finer[0], rel=2e-3)
    assert fine[1] == pytest.approx(finer[1], abs=5e-4)


def test_energy_closes_and_a_continuation_is_the_run_itself() -> None:
    overrides = ('solver.accuracy="vibration"', "solver.duration=1 s")
    complete, first = (BearingEngine(api.check(AXIAL, overrides)) for _ in range(2))
    assert first.advance(2e-3).ok
    second = BearingEngine(api.check(AXIAL, overrides))
    second.restore(first.state())
    for engine in (complete, second):
        assert engine.advance(6e-3).ok
    assert np.array_equal(complete._memory.y, second._memory.y)
    sums = complete.integrals()
    assert sums == second.integrals()
    losses = sum(value for name, value in sums.items() if name.startswith(("loss.", "support")))
    assert abs(sums["input"] - losses - sums["stored"]) < 1e-5 * sums["input_abs"]
    # Not every weight of the formula is positive: a contact of less than a step may give back as little as this.
    assert min(value for name, value in sums.items() if name.startswith("loss.")) >= -1e-9 * losses


def kicked_across(*changes: str) -> FloatArray:
    """Return the ring's speed after a kick [m/s].

    The inner ring of an axial 6208, 3 mm/s across the shaft.

    Half the difference of a kick to either side: what balls and cage do anyway cancels.
    """
    traces = []
    for kick in (3e-3, -3e-3):
        engine = BearingEngine(
            api.check("6208-axial-1300", ["output.interval=0.05 ms", "solver.duration=1 s", *changes])
        )
        across = L.NB * engine.model.geometry.ball_count + list(engine.context.bundle.active).index(L.SVX + 1)
        engine._memory.y[across] += kick
        assert engine.advance(20.1e-3).ok
        traces.append(engine.buffered()[1][40:400, across])
    return 0.5 * np.asarray(traces[0] - traces[1])


@pytest.mark.slow
def test_the_mode_that_hardly_anything_damps() -> None:
    """Compare a mode with 0.21 % of damping.

    1 518 Hz, over 27 periods: the aim is 10 % of its amplitude (docs/vibration.md).

    Stiff friction lowers the order of the formula there; half the step leaves a quarter of the error.
    """
    fine = "solver.accuracy=vibration"
    true = kicked_across(fine, "solver.tolerance=1e-6", "solver.max_step=20 us")
    size = float(np.std(true))
    followed, halved = kicked_across(fine), kicked_across(fine, "solver.max_step=41 us")
    assert float(np.std(followed)) == pytest.approx(size, rel=0.1)
    assert float(np.std(followed - true)) < 0.1 * size
    assert float(np.std(halved - true)) < 0.03 * size
    assert float(np.std(kicked_across("solver.accuracy=averages"))) < 0.7 * size

"""Test rollers that touch each other without a cage."""

from __future__ import annotations

import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lambda_core import api
from lambda_core.elements.roller.roller_equilibrium import balance
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine, initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.solver.drivers.right_hand_side import Handle

from .support import FloatArray

CASE: dict[str, Any] = {
    "name": "complement",
    "bearing": {"designation": "SKF NCF 3008 CV"},
    "lubricant": {"name": "FVA3", "temperature": "70 degC"},
    "loads": {"radial": "5 kN"},
    "operation": {"speed": "1000 rpm"},
}

# Runs without Numba's compiler: functions of the compiled core as plain ones.
PLAIN = """
import math
import numpy as np
from lambda_core.solver import records as R
from lambda_core.solver.roller import motion, neighbours

rng = np.random.default_rng(1)


def one(kind, values=None):
    return (np.zeros(1, kind) if values is None else np.array(values, dtype=np.float64).view(kind))[0]


def inertial(roller, v):
    c, s = math.cos(roller.azimuth), math.sin(roller.azimuth)
    return np.array([v[0], v[1] * c - v[2] * s, v[1] * s + v[2] * c])


guide = one(R.GUIDE)
straight, tapered = one(R.ROW), one(R.ROW)
straight.bar_length, straight.ball_radius = 0.01, 3.5e-3
tapered.bar_length, tapered.ball_radius, tapered.axis_angle = 0.018, 8.5e-3, -0.239
tapered.cone_angle = -math.atan(2.0 * 8.5e-3 / 0.1085 * math.sin(0.239))
for row, circle in ((straight, 27e-3), (tapered, 54.25e-3)):
    chord = 2.0 * row.ball_radius * math.cos(row.cone_angle)  # of rollers that touch
    touching = (0.0, 2.0 * math.asin(chord / 2.0 / circle))
    aligned = [one(R.ROLLER, [0.0, circle, place, *[0.0] * 8]) for place in touching]
    for share in (-1.0, 0.0, 1.0):  # along the whole line
        neighbours._station_state(*aligned, row, share, guide)
        assert abs(math.hypot(*guide.place) - 2.0 * row.ball_radius) < 2e-5
    for gap, share in ((0.0, 0.8), (20e-6, -0.3)):
        first, angle = 0.4, 2.0 * math.asin((chord + gap) / 2.0 / circle)
        states = [
            [1e-4 * rng.normal(), circle, azimuth, *rng.normal(size=3), *(100.0 * rng.normal(size=3)), *tilt]
            for azimuth, tilt in ((first, (1e-3, -2e-3)), (first + angle, (-5e-4, 1e-3)))
        ]
        rollers = [one(R.ROLLER, state) for state in states]
        neighbours._station_state(*rollers, row, share, guide)
        apart = math.hypot(*guide.place)
        assert abs(guide.place[0]) < 1e-16
        assert abs(apart - 2.0 * row.ball_radius - gap) < 4e-5  # they tilt by 3 mrad against each other
        step = 1e-7  # the way that the stations make is the velocity, but for axial slip times the tilts
        later = [one(R.ROLLER, state) for state in states]
        for roller, now in zip(later, rollers):
            roller.x += step * now.velocity[0]
            roller.radius += step * now.velocity[1]
            roller.azimuth += step * now.velocity[2] / now.radius
            turn = np.array([now.velocity[2] / now.radius, 0.0, 0.0])
            moves = np.cross(np.array(motion.from_own(now.spin, row)) - turn, motion.axis_of(now, row))
            axis = np.array(motion.to_own(np.array(motion.axis_of(now, row)) + step * moves, row))
            roller.tilt[0], roller.tilt[1] = axis[1], axis[2]
        closing = np.dot(guide.place, guide.velocity) / apart
        p, v, w = np.array(guide.place), np.array(guide.velocity), np.array(guide.rotation)
        out, on = rng.normal(size=6), [one(R.WRENCH), one(R.WRENCH)]
        out[3:] = p - row.ball_radius * p / apart
        neighbours._apply(*rollers, guide, out, 0.25, *on)
        forces = [inertial(roller, wrench.force) for roller, wrench in zip(rollers, on)]
        moments = [inertial(roller, wrench.moment) for roller, wrench in zip(rollers, on)]
        places = [inertial(roller, (roller.x, roller.radius, 0.0)) for roller in rollers]
        assert np.abs(forces[0] + forces[1]).max() < 1e-15
        about = [m + np.cross(r, f) for m, r, f in zip(moments, places, forces)]
        assert np.abs(about[0] + about[1]).max() < 1e-15
        power = sum(
            np.dot(f, inertial(roller, roller.velocity))
            + np.dot(m, inertial(roller, motion.from_own(roller.spin, row)))
            for f, m, roller in zip(forces, moments, rollers)
        )
        assert abs(power - 0.25 * np.dot(out[:3], v + np.cross(w, out[3:] - p))) < 1e-10
        neighbours._station_state(*later, row, share, guide)
        assert abs((math.hypot(*guide.place) - apart) / step - closing) < 0.01
"""


def test_forces_of_neighbours_are_opposite_and_do_work(tmp_path: Path) -> None:
    """Compare force, moment and power of neighbours.

    Cylinders, and cones, which touch along the whole line.

    Newton's third law; power is force times slip; the distance changes as the velocity requires.
    """
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", PLAIN],
        cwd=tmp_path,
        env=os.environ | {"NUMBA_DISABLE_JIT": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


@cache
def equilibrium() -> Equilibrium:
    return solve(api.check(CASE))


def pressed(pairs: tuple[int, ...]) -> FloatArray:
    """Return a state of touching rollers.

    Each named roller is pressed by a micrometre onto the one after it.
    """
    context = equilibrium().context
    y = initial_state(equilibrium())
    y = y + np.random.default_rng(0).uniform(-1.0, 1.0, y.size) * 1e-3 * context.scale
    rollers, geometry = L.elements_in(context.bundle, y), context.model.geometry
    for j in pairs:
        one, other = rollers[j], rollers[(j + 1) % geometry.ball_count]
        a, b = one["radius"], other["radius"]
        apart = np.arccos((a * a + b * b - (geometry.ball_diameter - 1e-6) ** 2) / (2.0 * a * b))
        other["azimuth"] = one["azimuth"] + apart
    return y


def test_slopes_of_touching_rollers_are_those_of_differences() -> None:
    context, y = equilibrium().context, pressed((3, 4, 23))
    handle, n, count = Handle(context), y.size, context.model.geometry.ball_count
    ours, exact = np.zeros((n, n)), np.zeros((n, n))
    assert handle.jacobian(0.0, y, ours) == 1
    for k in range(L.NR * count):
        step, ahead, back = 1e-5 * context.scale[k], np.zeros(n), np.zeros(n)
        moved: FloatArray = y.copy()
        moved[k] += step
        handle.slope(0.0, moved, ahead)
        moved[k] -= 2.0 * step
        handle.slope(0.0, moved, back)
        exact[:, k] = (ahead - back) / (2.0 * step)
    scaled, found = (m * context.scale[None, :] / context.scale[:, None] for m in (exact, ours))
    of = np.repeat(np.arange(count), L.NR)
    coupling = np.zeros_like(scaled, dtype=bool)
    coupling[: of.size, : of.size] = of[:, None] != of[None, :]
    assert np.linalg.norm((found - scaled)[coupling]) < 0.01 * np.linalg.norm(scaled[coupling])
    for one, other in ((3, 4), (4, 3), (4, 5), (5, 4), (23, 0), (0, 23)):
        block = np.ix_(of == one, of == other)
        assert np.abs(scaled[: of.size, : of.size][block]).max() > 1.0
    assert not scaled[: of.size, : of.size][np.ix_(of == 3, of == 7)].any()


def test_a_full_complement_starts_with_the_loads_of_its_laminae() -> None:
    """Start a full complement with its quasi-static loads.

    Gaps between the rollers are even.
    """
    found = equilibrium()
    assert found.converged
    rollers = found.context.model.rollers
    assert rollers is not None
    weight = found.context.model.inner_ring.mass * 9.81
    alone = balance(rollers, np.array([0.0, 0.0, -5000.0 - weight, 0.0, 0.0]), first_angle=-0.5 * np.pi)
    theirs = alone.inner.sum(axis=1)
    loads = found.arcs[:, 0, L.R.CONTACT_CHANNELS.index("load")]
    assert loads == pytest.approx(theirs, rel=0.01, abs=0.01 * theirs.max())
    places = np.sort(L.elements_in(found.context.bundle, initial_state(found))["azimuth"])
    assert np.diff(places) == pytest.approx(2.0 * np.pi / rollers.count)
    assert rollers.room == pytest.approx(3.51e-3, rel=1e-2)


def test_a_full_complement_runs() -> None:
    """Let rollers of a full complement touch.

    They rub, none passes through another, energy is balanced; a resumed run has these bits.
    """
    model = api.check(CASE)
    # Each has an equilibrium of its own: two engines that start from one share its working memory.
    engine, resumed = (BearingEngine(model, equilibrium=solve(model)) for _ in range(2))
    while engine.time < 0.02:
        engine.advance(0.02)
    resumed.restore(engine.state())
    for one in (engine, resumed):
        while one.time < 0.03:
            one.advance(0.03)
    ours, theirs = engine.now(), resumed.now()
    assert all(np.array_equal(ours[name], theirs[name], equal_nan=True) for name in ours)
    sums = engine.integrals()
    lost = sum(value for name, value in sums.items() if name.startswith(("loss.", "support")))
    assert sums["loss.land"] > 0.0
    assert sums["loss.pocket"] == 0.0
    assert abs(sums["input"] - lost - sums["stored"]) < 1e-3 * sums["input_abs"]
    seen, geometry = engine.samples(), engine.context.model.geometry
    assert np.abs(seen["pocket_force"]).max() > 0.1
    y, z = (seen["ball_radius"] * f(seen["ball_azimuth"]) for f in (np.cos, np.sin))
    apart = np.hypot(y - np.roll(y, -1, axis=1), z - np.roll(z, -1, axis=1))
    assert geometry.ball_diameter - 20e-6 < apart.min() < geometry.ball_diameter
    assert np.abs(seen["roller_lean"]).max() < 11e-3  # ribs allow no more


@pytest.mark.full
def test_a_full_complement_of_tapered_rollers_runs() -> None:
    """Let 19 rollers of a 32216 touch.

    Rollers that the radial load relieves are pushed; the rib holds the skew of all, and energy is balanced.
    """
    case = CASE | {"bearing": {"designation": "SKF 32216", "rollers": {"roller_count": 19}}, "depth": {"cage": False}}
    model = api.check(case | {"loads": {"axial": "6 kN", "radial": "17 kN"}})
    assert model.rollers is not None
    engine = BearingEngine(model, equilibrium=solve(model))
    while engine.time < 0.3:
        engine.advance(0.3)
    sums = engine.integrals()
    lost = sum(value for name, value in sums.items() if name.startswith(("loss.", "support")))
    assert sums["loss.land"] > 0.0
    assert abs(sums["input"] - lost - sums["stored"]) < 1e-3 * sums["input_abs"]
    _, states = engine.buffered()
    assert np.abs(L.elements_in(engine.context.bundle, states)["tilt"]).max() < 5e-3
    seen = engine.samples()
    y, z = (seen["ball_radius"] * f(seen["ball_azimuth"]) for f in (np.cos, np.sin))
    apart = np.hypot(y - np.roll(y, -1, axis=1), z - np.roll(z, -1, axis=1)).min()
    chord = model.rollers.diameter * np.cos(model.rollers.angles.half)
    assert chord - 50e-6 < apart < chord + 50e-6

"""Test Newton's third law.

What the parts of a bearing do to each other sums to nothing.
"""

from __future__ import annotations

import numpy as np
import pytest

from lambda_core.solver.arrays import bundle as L

from .support import (
    ALL_FREE,
    NO_FIELD,
    Evaluation,
    FloatArray,
    Machine,
    State,
    ball_centre,
    inertial,
    jostle,
    machine,
    rolling,
)

DRY = "parameters.cage_contact.film_width=0"  # pockets push where they touch, not before
ROUNDING = 1e-12  # of the sum of all amounts: some hundred additions of double precision
WIDE = "bearing.clearance=200 um"  # room between all parts, so that single contacts can be made


def resultant(state: State, found: Evaluation) -> tuple[float, float]:
    """Return relative sums of forces and moments.

    |sum of forces| and |sum of moments about the origin|, each over the sum of amounts.
    """
    forces, moments, amount, turning = np.zeros(3), np.zeros(3), 0.0, 0.0
    arm = float(state.balls[0, L.BR])

    def add(force: FloatArray, moment: FloatArray, place: FloatArray) -> None:
        nonlocal forces, moments, amount, turning
        forces += force
        moments += moment + np.cross(place, force)
        amount += float(np.linalg.norm(force))
        turning += float(np.linalg.norm(moment)) + arm * float(np.linalg.norm(force))

    for ball, fm in zip(state.balls, found.ball_forces, strict=True):
        psi = ball[L.BPSI]
        add(inertial(psi, fm[:3]), inertial(psi, fm[3:]), ball_centre(ball))
    for body, fm in zip(state.shared, found.body_forces, strict=True):
        add(fm[:3], fm[3:], body[:3])
    assert amount > 0.0
    return float(np.linalg.norm(forces)) / amount, float(np.linalg.norm(moments)) / turning


def check(m: Machine, state: State) -> Evaluation:
    found = m.evaluate(m.vector(state))
    force, moment = resultant(state, found)
    assert force < ROUNDING
    assert moment < ROUNDING
    return found


def touched(found: Evaluation) -> tuple[set[int], set[int]]:
    """Return the balls and the bodies that feel a force."""
    balls, bodies = (np.flatnonzero(np.any(f != 0.0, axis=1)) for f in (found.ball_forces, found.body_forces))
    return set(balls.tolist()), set(bodies.tolist())


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("ring", [0, 1], ids=["inner", "outer"])
def test_one_raceway_contact(ring: int, seed: int) -> None:
    """Press one ball into one raceway.

    The ring is displaced, tilted and spinning; all other bodies are free.
    """
    m, rng = machine(WIDE, *ALL_FREE, *NO_FIELD, "models.cage_contact=none"), np.random.default_rng(seed)
    state = jostle(m, rolling(m, 150.0), rng)
    state.balls[2, :2] += (rng.uniform(-30e-6, 30e-6), (-80e-6, 80e-6)[ring])
    found = check(m, state)
    assert touched(found) == ({2}, {ring})
    assert np.linalg.norm(found.body_forces[ring, :3]) > 10.0


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("pocket", ["spherical-pocket", "cylindrical-pocket"])
def test_one_pocket(pocket: str, seed: int) -> None:
    """Push one ball by a displaced, tilted cage."""
    m, rng = (
        machine(WIDE, *ALL_FREE, *NO_FIELD, f"forces.ball_cage.models.cage_contact={pocket}", DRY),
        np.random.default_rng(seed),
    )
    state = jostle(m, rolling(m, 150.0), rng)
    play = 0.5 * m.model.cage.pocket_clearance
    state.balls[:, L.BPSI] = m.at_rest().balls[:, L.BPSI] + state.shared[2, L.STHETA]
    state.balls[4, L.BPSI] += rng.choice([-1.0, 1.0]) * (play + 40e-6) / state.balls[4, L.BR]
    found = check(m, state)
    assert touched(found) == ({4}, {2})


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize("guidance", ["inner ring", "outer ring"])
def test_one_land(guidance: str, seed: int) -> None:
    """Rest the cage on one land.

    At one or both stations.
    """
    m = machine(
        WIDE, *ALL_FREE, *NO_FIELD, f"bodies.cage.guidance={guidance}", "bodies.cage.land_clearance=100 um",
        "bodies.cage.pocket_clearance=2 mm", DRY,
    )  # fmt: skip
    rng = np.random.default_rng(seed)
    state = jostle(m, rolling(m, 150.0), rng)
    state.shared[2, L.SY : L.SZ + 1] = 80e-6 * np.array([np.cos(seed), np.sin(seed)])
    found = check(m, state)
    assert touched(found) == (set(), {2, ("inner ring", "outer ring").index(guidance)})


@pytest.mark.parametrize("seed", range(8))
def test_two_balls_without_a_cage(seed: int) -> None:
    m, rng = machine(WIDE, "depth.cage=false", *ALL_FREE, *NO_FIELD), np.random.default_rng(seed)
    state = jostle(m, rolling(m, 150.0), rng, motion=0.2)
    state.balls[3, :3] = state.balls[2, :3]
    state.balls[3, L.BPSI] += 2.0 * np.arcsin((m.model.geometry.ball_diameter - 3e-6) / (2.0 * state.balls[2, L.BR]))
    found = check(m, state)
    assert touched(found) == ({2, 3}, set())


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize("cage", ["true", "false"])
def test_everything_at_once(cage: str, seed: int) -> None:
    """Combine all contacts in random states."""
    m, rng = machine("bearing.clearance=10 um", f"depth.cage={cage}", *ALL_FREE, *NO_FIELD), np.random.default_rng(seed)
    state = jostle(m, rolling(m, 150.0), rng, 1.0 + seed / 10.0, 1.0 + seed / 5.0)
    found = check(m, state)
    balls, bodies = touched(found)
    assert len(balls) >= m.count // 2
    assert {0, 1} <= bodies

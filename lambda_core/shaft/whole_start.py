"""Where the motion of a whole begins, and what acts on it: the quasi-static equilibrium, loads, weights, unbalance."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.shaft.lumps import LumpedShaft
from lambda_core.shaft.model import PLACES, ShaftModel
from lambda_core.shaft.shaft_equilibrium import ShaftState
from lambda_core.shaft.whole_tables import (
    SIGNS,
    STATES,
    Part,
    constant,
    harmonic,
    load_signals,
    lump_bodies,
    motion_signal,
)
from lambda_core.solver import layout as L
from lambda_core.solver import records as R
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.tables import CAGE, OUTER

_SPIN = 5  # degree of freedom


def load_terms(model: ShaftModel, shaft: LumpedShaft, parts: tuple[Part, ...]) -> np.ndarray:
    """Return what acts on lumps and outer rings, and what leads them, as terms of compiled code.

    Loads, weight and growth by temperature go to the lumps as the beam hands them on; of the weight the part that
    gravity does to the lumps anyway is taken off.
    """
    terms = []
    given = (shaft.follow.T @ (model.loads + model.weight + model.growth)).reshape(-1, len(PLACES))
    given[:, :3] -= np.outer(shaft.mass, model.gravity)
    for body, own in zip(lump_bodies(shaft), given, strict=True):
        terms += [constant(signal, value) for signal, value in zip(load_signals(int(body)), own, strict=True)]
        terms.append(constant(motion_signal(int(body), _SPIN), model.speed))
    terms += _unbalances(model, shaft)
    for part in parts:
        outer, seating = part.bodies[OUTER], part.bearing.seating
        terms.append(constant(load_signals(outer)[0], seating.force))
        for dof, (stiffness, shift) in enumerate(zip(seating.stiffness, seating.shift, strict=True)):
            if math.isinf(stiffness) and model.housing is None:
                terms.append(constant(motion_signal(outer, dof), shift))
    return np.concatenate(terms)


def _unbalances(model: ShaftModel, shaft: LumpedShaft) -> list[np.ndarray]:
    """Return the forces U omega^2 of every unbalance, which turn with the shaft."""
    frequency, sense = abs(model.speed) / (2.0 * math.pi), math.copysign(1.0, model.speed)
    terms = []
    for unbalance in model.unbalances:
        force, phase = unbalance.amount * model.speed**2, sense * unbalance.angle
        rows = model.body.rows(unbalance.position).start
        along_y, along_z = (shaft.follow[rows + axis].reshape(-1, len(PLACES)) for axis in (1, 2))
        for body, y, z in zip(lump_bodies(shaft), along_y, along_z, strict=True):
            for signal, share_y, share_z in zip(load_signals(int(body)), y, z, strict=True):
                # cos(omega t + angle) along y, sin(omega t + angle) along z
                for share, lead in ((share_y, 0.5 * math.pi), (sense * share_z, 0.0)):
                    if abs(share) > 1e-12:
                        terms.append(harmonic(signal, force * share, frequency, phase + lead))
    return terms


def start_state(
    model: ShaftModel,
    shaft: LumpedShaft,
    parts: tuple[Part, ...],
    active: np.ndarray,
    state: ShaftState,
    equilibria: list[Equilibrium],
) -> FloatArray:
    """Return the state that the motion begins with: equilibrium, every ball at its cage's speed."""
    bodies = np.zeros(shaft.positions.size + 2 * len(parts), R.BODY_STATE)
    flat = bodies.view(np.float64)
    moved = np.array([state.displacement[model.body.rows(float(x)).start + np.array(PLACES)] for x in shaft.positions])
    for body, own in zip(lump_bodies(shaft), moved, strict=True):
        flat[L.NS * body + STATES] = SIGNS * own
    balls, kept = [], []
    for part, found, outer in zip(parts, equilibria, state.outer, strict=True):
        y, alone = initial_state(found), found.context
        n = L.NB * part.balls
        flat[L.NS * part.bodies[OUTER] + STATES] = SIGNS * outer
        own = np.zeros(alone.bundle.bodies.size, R.BODY_STATE)
        own.view(np.float64)[alone.bundle.active] = alone.shared_part(y)
        cage = own[CAGE]
        cage["position"] += outer[:3]
        bodies[part.bodies[CAGE]] = cage
        balls.append(_carried(y[:n].view(R.BALL).copy(), outer).view(np.float64))
        kept.append(y[y.size - alone.bundle.states.size :])
    return np.concatenate([*balls, flat[active], *kept])


def _carried(balls: np.ndarray, pose: FloatArray) -> np.ndarray:
    """Move balls along with an outer ring by a small pose."""
    x, y, z = balls["x"], balls["radius"] * np.cos(balls["azimuth"]), balls["radius"] * np.sin(balls["azimuth"])
    about_y, about_z = pose[3], pose[4]
    balls["x"] = x + pose[0] + about_y * z - about_z * y
    y, z = y + pose[1] + about_z * x, z + pose[2] - about_y * x
    turned = np.arctan2(z, y) - balls["azimuth"]
    balls["azimuth"] += np.remainder(turned + math.pi, 2.0 * math.pi) - math.pi
    balls["radius"] = np.hypot(y, z)
    return balls

"""Compute initial state and loads of a shaft run.

It starts at the quasi-static equilibrium; loads, weights and unbalance act on it.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, INNER, OUTER
from lambda_core.shaft.lumps import LumpedShaft, unbalance_of_lumps
from lambda_core.shaft.machine_assembly import member_numbers
from lambda_core.shaft.shaft_equilibrium import ShaftState
from lambda_core.shaft.whole_tables import RING_SIGNS, RING_STATES, Part
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.tables import SIGNS, STATES
from lambda_core.system.machine import Machine


def start_state(
    model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...], context: SolverContext, state: ShaftState,
    equilibria: list[Equilibrium],
) -> FloatArray:  # fmt: skip
    """Return the state that the motion begins with: equilibrium, every ball at its cage's speed."""
    bodies = np.zeros(context.bundle.bodies.size, R.BODY_STATE)
    numbers = member_numbers(model, shaft)
    flat = bodies.view(np.float64)
    moved = np.array([state.displacement[model.body.rows(float(x))] for x in shaft.positions])
    for body, own, azimuth in zip(numbers.lumps, moved, unbalance_of_lumps(model, shaft)[1], strict=True):
        flat[L.NS * body + STATES] = SIGNS * own
        bodies["angle"][body] *= model.twists
        bodies["angle"][body] += azimuth  # a body's unbalance points to its own angle 0
        bodies["spin"][body] = model.speed
    for body, own in zip(numbers.bodies, state.bodies, strict=True):
        flat[L.NS * body + STATES] = SIGNS * own
    balls, kept = [], []
    for part, found, outer in zip(parts, equilibria, state.outer, strict=True):
        y, alone = initial_state(found), found.context
        n = L.NB * part.balls
        flat[L.NS * part.bodies[OUTER] + RING_STATES] = RING_SIGNS * outer
        own = np.zeros(alone.bundle.bodies.size, R.BODY_STATE)
        own.view(np.float64)[alone.bundle.active] = alone.shared_part(y)
        cage = own[CAGE]
        cage["position"] += outer[:3]
        bodies[part.bodies[CAGE]] = cage
        for body, wave, row in zip(part.bodies[CAGE + 1 :], own[CAGE + 1 :], alone.bundle.waves, strict=True):
            # waves stand in the material of their ring, which a lump's unbalance has turned
            turned = float(row["order"] * bodies["angle"][part.bodies[INNER]]) if row["ring"] == INNER else 0.0
            c, s = math.cos(turned), math.sin(turned)
            _, cosine, sine = wave["position"]
            bodies["position"][body, 1:] = cosine * c + sine * s, sine * c - cosine * s
        balls.append(_carried(y[:n].view(R.BALL).copy(), outer).view(np.float64))
        kept.append(y[y.size - alone.bundle.states.size :])
    return np.concatenate([*balls, flat[context.bundle.active], *kept])


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

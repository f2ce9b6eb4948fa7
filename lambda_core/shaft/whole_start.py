"""Compute initial state and loads of a shaft run.

It starts at the quasi-static equilibrium; loads, weights and unbalance act on it.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, INNER, OUTER
from lambda_core.elastic.beam import NODE
from lambda_core.shaft.lumps import LumpedShaft, unbalance_of_lumps
from lambda_core.shaft.shaft_equilibrium import ShaftState
from lambda_core.shaft.whole_tables import (
    LUMP_SIGNS,
    LUMP_STATES,
    SIGNS,
    STATES,
    Part,
    beside_bodies,
    led_bodies,
    load_signals,
    lump_bodies,
    motion_signal,
    table_size,
)
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.solver_context import state_scales
from lambda_core.solver.drivers.time_tables import add_terms
from lambda_core.system.bearing import TimeFunction
from lambda_core.system.machine import GROUND, PLACES, Machine
from lambda_core.system.time_functions import initial, scaled

_SPIN = 5  # degree of freedom
_ABOUT_X = 3  # row of a node


def load_terms(model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...]) -> tuple[np.ndarray, FloatArray]:
    """Return what acts on lumps and outer rings, and what leads them: terms of compiled code, and their table.

    Loads, weight and growth by temperature go to the lumps as the beam hands them on; of the weight the part that
    gravity does to the lumps anyway is taken off.
    """
    rows: list[np.ndarray] = []
    table: list[float] = []
    lumps = lump_bodies(shaft)
    size, nodes = model.body.mass.shape[0], NODE * model.body.positions.size
    given = (model.loads + model.weight + model.growth)[:size]
    if not model.twists:  # torques go straight to the coupling
        given[_ABOUT_X:nodes:NODE] = 0.0
    changing = dict(model.varying)
    for row, function in model.varying:
        if row >= size or (row % NODE == _ABOUT_X and not model.twists):
            continue
        given[row] -= initial(function)
        for share, signal in zip(shaft.follow[row, : NODE * lumps.size], _signals(lumps), strict=True):
            add_terms(signal, scaled(function, float(share)), rows, table)
    for k, signal in enumerate(_signals(beside_bodies(model, shaft))):
        constant = TimeFunction.constant(float(model.loads[size + k]))
        add_terms(signal, changing.get(size + k, constant), rows, table)
    still = (shaft.follow[:, : NODE * lumps.size].T @ given).reshape(-1, NODE)
    still[:, :3] -= np.outer(shaft.mass, model.gravity)
    for value, signal in zip(still.ravel(), _signals(lumps), strict=True):
        add_terms(signal, TimeFunction.constant(float(value)), rows, table)
    for body in led_bodies(model, shaft):
        add_terms(motion_signal(int(body), _SPIN), model.speed_over_time, rows, table)
    for number, rigid in zip(beside_bodies(model, shaft), model.bodies, strict=True):
        for dof, place in enumerate(PLACES):
            add_terms(motion_signal(int(number), dof), rigid.lead[place], rows, table)
    for part in parts:
        outer, seating = part.bodies[OUTER], part.bearing.seating
        add_terms(load_signals(outer)[0], TimeFunction.constant(seating.force), rows, table)
        for dof, (stiffness, lead) in enumerate(zip(seating.stiffness, seating.lead, strict=True)):
            if math.isinf(stiffness) and (model.housing is None or part.bearing.carrier != GROUND):
                add_terms(motion_signal(outer, dof), lead, rows, table)
        for body, wave in zip(part.bodies[CAGE + 1 :], part.alone.bundle.bodies[CAGE + 1 :], strict=True):
            for signal, gravity in zip(load_signals(body)[:3], model.gravity, strict=True):  # bends no ring
                add_terms(signal, TimeFunction.constant(-float(wave["mass"]) * gravity), rows, table)
    return np.concatenate(rows), np.array(table or [0.0])


def _signals(lumps: np.ndarray) -> list[int]:
    """Return the signals of forces and moments of all lumps, in the order of their stiffness."""
    return [signal for body in lumps for signal in load_signals(int(body))]


def start_state(
    model: Machine,
    shaft: LumpedShaft,
    parts: tuple[Part, ...],
    active: np.ndarray,
    state: ShaftState,
    equilibria: list[Equilibrium],
) -> FloatArray:
    """Return the state that the motion begins with: equilibrium, every ball at its cage's speed."""
    bodies = np.zeros(table_size(model, shaft, parts), R.BODY_STATE)
    flat = bodies.view(np.float64)
    moved = np.array([state.displacement[model.body.rows(float(x))] for x in shaft.positions])
    for body, own, azimuth in zip(lump_bodies(shaft), moved, unbalance_of_lumps(model, shaft)[1], strict=True):
        flat[L.NS * body + LUMP_STATES] = LUMP_SIGNS * own
        bodies["angle"][body] *= model.twists
        bodies["angle"][body] += azimuth  # a body's unbalance points to its own angle 0
        bodies["spin"][body] = model.speed
    for body, own in zip(beside_bodies(model, shaft), state.bodies, strict=True):
        flat[L.NS * body + LUMP_STATES] = LUMP_SIGNS * own
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
        for body, wave, row in zip(part.bodies[CAGE + 1 :], own[CAGE + 1 :], alone.bundle.waves, strict=True):
            # waves stand in the material of their ring, which a lump's unbalance has turned
            turned = float(row["order"] * bodies["angle"][part.bodies[INNER]]) if row["ring"] == INNER else 0.0
            c, s = math.cos(turned), math.sin(turned)
            _, cosine, sine = wave["position"]
            bodies["position"][body, 1:] = cosine * c + sine * s, sine * c - cosine * s
        balls.append(_carried(y[:n].view(R.BALL).copy(), outer).view(np.float64))
        kept.append(y[y.size - alone.bundle.states.size :])
    return np.concatenate([*balls, flat[active], *kept])


def state_sizes(model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...], bundle: L.Bundle) -> FloatArray:
    """Return the absolute scales of all states that the tolerance multiplies: lumps and bodies are as inner rings."""
    shared, lumps = np.zeros(bundle.shared.size), np.zeros(L.NS)
    balls, kept = [], []
    for part in parts:
        n, size = L.NB * part.balls, L.NS * len(part.bodies)
        whole = state_scales(part.alone.model, np.arange(size))
        balls.append(whole[:n])
        kept.append(whole[n + size :])
        bodies = whole[n : n + size].reshape(-1, L.NS)
        lumps += bodies[INNER] / len(parts)
        for body, own in zip(part.bodies[OUTER:], bodies[OUTER:], strict=True):
            shared[L.NS * body :][: L.NS] = own
    for body in (*lump_bodies(shaft), *beside_bodies(model, shaft), *led_bodies(model, shaft)):
        shared[L.NS * body :][: L.NS] = lumps
    return np.concatenate([*balls, shared[bundle.active], *kept])


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

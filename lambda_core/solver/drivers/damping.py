"""Compute the damping matrix of a bearing.

The matrix has shape (6, 6) about the quasi-static equilibrium; balls follow.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, INNER
from lambda_core.domain.errors import SolverError
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium, fault_sentence
from lambda_core.solver.drivers.solver_context import SolverContext, assemble

DIRECTIONS = ("x", "y", "z", "tilt_x", "tilt_y", "tilt_z")
_FREED = ("x", "y", "z", "tilt_y", "tilt_z", "spin")
# State and rate of each direction, and how a displacement moves the state; turning about x moves nothing that contacts
# feel, so that it has a rate alone.
_STATES = (L.SX, L.SY, L.SZ, L.STHETA, L.SAZ, L.SAY)
_SIGNS = np.array([1.0, 1.0, 1.0, 0.0, -1.0, 1.0])
_RATES = (L.SVX, L.SVY, L.SVZ, L.SSIGMA, L.SWY, L.SWZ)
_WAVE = (L.SY, L.SZ, L.SVY, L.SVZ)  # of a wave of an elastic ring
_MOVING = np.array([L.BX, L.BR, L.BVX, L.BVR, L.BVT, L.BWX, L.BWR, L.BWT])  # of a ball: its azimuth stands still
_LEAST_SHAKE = 1.0  # [rad/s] slowest vibration; slower than balls creep there is nothing that could be called damping


def damping_matrix(equilibrium: Equilibrium, frequency: float) -> FloatArray:
    """Return the vibration damping of the inner ring.

    It opposes a vibration against the outer one, in step with its velocity.

    The ring is shaken at an angular frequency w; every ball follows by its own linearised motion b' = A b + B u with
    friction, films, contact damping and inertia, azimuths at rest, the cage left out; so do the waves of elastic rings,
    once the balls are eliminated. The force on the ring is
    -(K + i w C) u; C = Im(-F_u - i w F_u' - F_b (i w - A)^-1 (B_u + i w B_u'))/w.

    Parameters
    ----------
    equilibrium : Equilibrium
        With the friction of the balls in balance.
    frequency : float
        Of the vibration [rad/s]; for unbalance the speed of the shaft.

    Returns
    -------
    float64[:, :], shape (6, 6)
        Order of DIRECTIONS [N s/m, N s/rad, N m s/rad]; not symmetric: balls that roll couple directions.

    Raises
    ------
    SolverError
        When a law refuses.

    Notes
    -----
    The elimination of the stiffness matrix (Jones 1960, J. Basic Eng. 82, 309), at a frequency; on what damps in
    rolling bearings see Dietl, Wensing and van Nijen 2000, Proc. IMechE K 214, 33. For small motion about a steady
    state; balls stand where they are, as they do for stiffness.
    """
    context = _freed(equilibrium.context)
    _fill(context, _moved(equilibrium, context))
    shake = max(abs(frequency), _LEAST_SHAKE)
    found: FloatArray = -_response(context, shake).imag / shake
    return found


def _freed(found: SolverContext) -> SolverContext:
    """Return the context with a free inner ring.

    The bearing is the same. The ring is free to turn, too, and no other force elements act.
    """
    free = found.model.inner_ring.freed(_FREED)
    return assemble(dataclasses.replace(found.model, inner_ring=free, links={}), found.kernels, found.frame, found.oils)


def _moved(equilibrium: Equilibrium, context: SolverContext) -> FloatArray:
    """Return the equilibrium in the freed layout.

    The cage is where the motion begins: it touches no ball.
    """
    old = equilibrium.context
    shared = old.bundle.shared.copy()  # as the last evaluation left it: prescribed degrees of freedom included
    shared[old.bundle.active] = old.shared_part(initial_state(equilibrium))
    balls = equilibrium.state[: int(old.bundle.system["tail"][0])]
    kept = equilibrium.state[equilibrium.state.size - old.bundle.states.size :]
    return np.concatenate([balls, shared[context.bundle.active], kept])


def _fill(context: SolverContext, state: FloatArray) -> None:
    """Fill the context's blocks with the Jacobian."""
    compiled, bundle = core(), context.bundle
    rates = np.zeros(L.power_count(bundle))
    ok = compiled.evaluate(0.0, state, bundle, np.zeros(state.size), rates, 0)
    if ok != 1 or compiled.jacobian(0.0, state, bundle, context.blocks) != 1:
        raise SolverError(f"the damping matrix failed: {fault_sentence(context)}")


def _response(context: SolverContext, shake: float) -> NDArray[np.complex128]:
    """Return the inner ring's response matrix.

    It is forces and moments over its motion exp(i w t), shape (6, 6).
    """
    blocks, body = context.blocks, context.model.inner_ring
    rows = [L.NS * INNER + k for k in _STATES], [L.NS * INNER + k for k in _RATES]
    inertia = np.array([body.mass] * 3 + [body.polar_inertia] + [body.transverse_inertia] * 2)
    direct, own = blocks.shared[INNER], blocks.reach.index[0]  # the inner ring is the first body that a ball touches
    states, rates = own[list(_STATES)], own[list(_RATES)]
    bent, places = _wave_states(context)
    total = direct[:, rows[0]] * _SIGNS + 1j * shake * direct[:, rows[1]]
    by_waves = direct[:, bent].astype(complex)
    slopes, among = blocks.d[blocks.index[bent]], blocks.index
    on_waves = slopes[:, among[rows[0]]] * _SIGNS + 1j * shake * slopes[:, among[rows[1]]]
    waves = slopes[:, among[bent]].astype(complex)
    for ball, on_ball, on_ring in zip(blocks.a, blocks.b, blocks.c, strict=True):
        feel = on_ball[np.ix_(_MOVING, states)] * _SIGNS + 1j * shake * on_ball[np.ix_(_MOVING, rates)]
        feel = np.hstack([feel, on_ball[np.ix_(_MOVING, places)]])
        if not np.any(feel):
            continue  # neither the inner ring nor waves touch this ball
        follow = 1j * shake * np.eye(len(_MOVING)) - ball[np.ix_(_MOVING, _MOVING)]
        moves = np.linalg.solve(follow, feel)
        push = inertia[:, None] * (on_ring[np.ix_(rates, _MOVING)] @ moves)
        bend = on_ring[np.ix_(places, _MOVING)] @ moves
        total += push[:, : len(_STATES)]
        by_waves += push[:, len(_STATES) :]
        on_waves += bend[:, : len(_STATES)]
        waves += bend[:, len(_STATES) :]
    if places.size:
        total += by_waves @ np.linalg.solve(1j * shake * np.eye(places.size) - waves, on_waves)
    return np.asarray(total)


def _wave_states(context: SolverContext) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the waves' states of elastic rings.

    Among all shared ones, and among those that a ball touches.
    """
    rows, reach = context.bundle.waves, context.blocks.reach
    bodies = rows["body"][rows["ring"] != CAGE]
    bent = np.array([L.NS * int(body) + k for body in bodies for k in _WAVE], dtype=np.int64)
    places = [reach.index[0, L.NS * int(reach.place[0, body]) + k] for body in bodies for k in _WAVE]
    return bent, np.array(places, dtype=np.int64)

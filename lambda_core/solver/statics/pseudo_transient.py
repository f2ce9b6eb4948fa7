"""The pseudo-transient system of the quasi-static equilibrium: its rates and its Jacobian blocks."""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.bundle import BR, BVT, BX, NB, NS, SAY, SAZ
from lambda_core.solver.layout import allocating_helper, helper

_MOBILITY = 1e-4  # [s2] turns an acceleration into the rate of a position
_HOLD = 1e4  # [1/s] rate at which an unloaded ball takes the speed of the others


@helper
def _ball_row(state, held, friction_on):
    """Return which acceleration drives a ball state: row index, or -1 when it is fixed."""
    if state in (BX, BR):
        return 3 + state
    if friction_on == 1 and (state >= 6 or (state == BVT and not held)):
        return state
    return -1


@helper
def _shared_row(state, bodies):
    """Return the acceleration that drives a shared position, its sign, or (-1, 0) when fixed."""
    body, c = state // NS, state % NS
    if bodies[body].is_cage == 1:
        return -1, 0.0
    if c < 3:
        return NS * body + 6 + c, 1.0
    # The axis leans to a_y when turned about +z and to -a_z when turned about +y.
    if c == SAY:
        return NS * body + 10, 1.0
    if c == SAZ:
        return NS * body + 9, -1.0
    return -1, 0.0


@helper
def residual(bundle, index, y, dydt, held, orbit, f):
    """Write the rates of the pseudo-transient system."""
    system = bundle.system[0]
    z = system.balls
    f[:] = 0.0
    for j in range(z):
        for i in range(NB):
            row = _ball_row(i, held[j], system.friction_on)
            if row >= 0:
                scale = _MOBILITY if i < 3 else 1.0
                f[NB * j + i] = scale * dydt[NB * j + row]
        if held[j] and system.friction_on == 1:
            f[NB * j + BVT] = _HOLD * (orbit * y[NB * j + BR] - y[NB * j + BVT])
    active = bundle.active
    for k in range(active.size):
        row, sign = _shared_row(active[k], bundle.bodies)
        if row >= 0 and index[row] >= 0:
            f[NB * z + k] = _MOBILITY * sign * dydt[NB * z + index[row]]


@helper
def _copy(source, target):
    """Copy a matrix; an assignment would bring along the words of an error about shapes, seconds to compile."""
    for i in range(source.shape[0]):
        for k in range(source.shape[1]):
            target[i, k] = source[i, k]


@helper
def _moves_ball(state, held, friction_on):
    """Return whether a state of a ball takes part in the pseudo-transient system."""
    return _ball_row(state, held, friction_on) >= 0 or (state == BVT and friction_on == 1)


@helper
def _mask_ball(j, r, bundle, bl, held, a2, b2, c2, on):
    """Turn the blocks of ball j of row r into those of the pseudo-transient system; `on` marks the columns of all."""
    friction_on, reach = bundle.system[0].friction_on, bl.reach
    a, b, c = bl.a[j], bl.b[j], bl.c[j]
    a2[:, :], b2[:, :], c2[:, :] = 0.0, 0.0, 0.0
    for i in range(NB):
        row = _ball_row(i, held, friction_on)
        if row < 0:
            continue
        scale = _MOBILITY if i < 3 else 1.0
        for k in range(NB):
            if _moves_ball(k, held, friction_on):
                a2[i, k] = scale * a[row, k]
        for k in range(reach.width[r]):
            b2[i, k] = scale * b[row, k] * on[reach.columns[r, k]]
    if held and friction_on == 1:
        a2[BVT, BVT] = -_HOLD
    for k in range(reach.width[r]):
        position = reach.columns[r, k]
        row, sign = _shared_row(bundle.active[position], bundle.bodies)
        if on[position] == 1:
            own = reach.index[r, NS * reach.place[r, row // NS] + row % NS]
            for i in range(NB):
                if _moves_ball(i, held, friction_on):
                    c2[k, i] = _MOBILITY * sign * c[own, i]
    _copy(a2, a)
    _copy(b2, b)
    _copy(c2, c)


@allocating_helper
def mask(bundle, bl, held):
    """Turn the blocks of dy/dt into those of the pseudo-transient system, in place."""
    bl.cross[:, :, :, :] = 0.0
    active, n, widest = bundle.active, bl.d.shape[0], bl.b.shape[2]
    on = np.zeros(n, dtype=np.int64)
    for k in range(n):
        row, _ = _shared_row(active[k], bundle.bodies)
        on[k] = 1 if row >= 0 and bl.index[row] >= 0 else 0
    a2, b2, c2 = np.zeros((NB, NB)), np.zeros((NB, widest)), np.zeros((widest, NB))
    for r in range(bundle.rows.size):
        for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
            _mask_ball(j, r, bundle, bl, held[j], a2, b2, c2, on)
    d2 = np.zeros((n, n))
    for k in range(n):
        row, sign = _shared_row(active[k], bundle.bodies)
        if on[k] == 1:
            for m in range(n):
                d2[k, m] = _MOBILITY * sign * bl.d[bl.index[row], m] * on[m]
    _copy(d2, bl.d)

"""The pseudo-transient system of the quasi-static equilibrium: its rates and its Jacobian blocks."""

from __future__ import annotations

import numpy as np

from lambda_core.solver.layout import BR, BVT, BX, NB, NS, SAY, SAZ, allocating_helper, helper

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


@allocating_helper
def mask(bundle, bl, held):
    """Turn the blocks of dy/dt into those of the pseudo-transient system, in place."""
    system = bundle.system[0]
    z, n = system.balls, bl.d.shape[0]
    active = bundle.active
    column_on = np.zeros(n, dtype=np.int64)
    for k in range(n):
        row, sign = _shared_row(active[k], bundle.bodies)
        column_on[k] = 1 if row >= 0 and bl.index[row] >= 0 else 0
    a2, b2 = np.zeros((NB, NB)), np.zeros((NB, n))
    for j in range(z):
        a, b = bl.a[j], bl.b[j]
        a2[:, :] = 0.0
        b2[:, :] = 0.0
        for i in range(NB):
            row = _ball_row(i, held[j], system.friction_on)
            if row < 0:
                continue
            scale = _MOBILITY if i < 3 else 1.0
            for c in range(NB):
                if _ball_row(c, held[j], system.friction_on) >= 0 or (c == BVT and system.friction_on == 1):
                    a2[i, c] = scale * a[row, c]
            for k in range(n):
                b2[i, k] = scale * b[row, k] * column_on[k]
        if held[j] and system.friction_on == 1:
            a2[BVT, BVT] = -_HOLD
        _copy(a2, a)
        _copy(b2, b)
    d2, c2 = np.zeros((n, n)), np.zeros((n, NB))
    for k in range(n):
        row, sign = _shared_row(active[k], bundle.bodies)
        if column_on[k] == 1:
            for m in range(n):
                d2[k, m] = _MOBILITY * sign * bl.d[bl.index[row], m] * column_on[m]
    _copy(d2, bl.d)
    for j in range(z):
        c = bl.c[j]
        c2[:, :] = 0.0
        for k in range(n):
            row, sign = _shared_row(active[k], bundle.bodies)
            if column_on[k] == 1:
                for i in range(NB):
                    if _ball_row(i, held[j], system.friction_on) >= 0 or (i == BVT and system.friction_on == 1):
                        c2[k, i] = _MOBILITY * sign * c[bl.index[row], i]
        _copy(c2, c)

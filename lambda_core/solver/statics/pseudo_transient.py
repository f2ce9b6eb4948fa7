"""Define the pseudo-transient system and its Jacobian."""

from __future__ import annotations

import numpy as np

from lambda_core.solver.arrays.bundle import BR, BVT, BVX, BWR, BWT, BX, NS, RSKEW, RTILT, SAY, SAZ
from lambda_core.solver.layout import allocating_helper, first_of, helper

_MOBILITY = 1e-4  # [s2] turns an acceleration into the rate of a position
_SKEWING = 1e-5  # [s2] the same of a roller's skew under friction
_HOLD = 1e4  # [1/s] rate at which an unloaded ball takes the speed of the others
_FOLLOW = 1e8  # [1/s] rate at which a roller's spins across its axis become those that neither tilt nor skew it


@helper
def _source(state, size, held, friction_on):
    """Return the rate that drives a state.

    The element has `size` states. Also return the factor, which is -1 where the state is fixed.

    A roller's tilt and skew follow their angular accelerations, as positions do. The two spins across its axis are
    those without a rate of tilt and skew: constraints, which hold all the time (pseudo-transient continuation of
    differential-algebraic equations: Coffey, Kelley and Keyes 2003, SIAM J. Sci. Comput. 25, 553). Ribs turn skew into
    friction, and friction into tilt, thrust and skew. Where the skew is as fast as what answers it, these swing for
    ever round a steady state; where it is slower, they do not: a slow and a fast part that are both stable alone are
    stable together (Tikhonov's theorem: Kokotovic, Khalil and O'Reilly 1986, Singular Perturbation Methods in Control,
    ch. 2). A roller that carries nothing is held in its pocket: next to nothing resists its place along the shaft and
    its skew, which are those without friction.
    """
    if friction_on == 1 and held and size > RTILT and state in (BX, RSKEW):
        return -1, 0.0
    if state in (BX, BR):
        return BVX + state, _MOBILITY
    if state == RTILT:
        return BWT, _MOBILITY
    if state == RSKEW:
        return BWR, -(_SKEWING if friction_on == 1 else _MOBILITY)
    if friction_on == 0 or state < BVT or (state == BVT and held):
        return -1, 0.0
    if size > RTILT and state == BWR:
        return RSKEW, _FOLLOW
    if size > RTILT and state == BWT:
        return RTILT, -_FOLLOW
    return state, 1.0


@helper
def _shared_row(state, bodies):
    """Return the acceleration of a shared position.

    Return its place and its sign, or (-1, 0) when fixed.
    """
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
def _ball_residual(first, size, y, dydt, held, orbit, friction_on, f):
    """Write the rates of a ball.

    Its states begin at `first`.
    """
    for i in range(size):
        source, scale = _source(i, size, held, friction_on)
        if source >= 0:
            f[first + i] = scale * dydt[first + source]
    if held and friction_on == 1:
        f[first + BVT] = _HOLD * (orbit * y[first + BR] - y[first + BVT])


@helper
def residual(bundle, index, y, dydt, held, orbit, f):
    """Write the rates of the pseudo-transient system."""
    system = bundle.system[0]
    f[:] = 0.0
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        for j in range(row.first_ball, row.first_ball + row.balls):
            _ball_residual(first_of(row, j), row.size, y, dydt, held[j], orbit, system.friction_on, f)
    active, tail = bundle.active, system.tail
    for k in range(active.size):
        source, sign = _shared_row(active[k], bundle.bodies)
        if source >= 0 and index[source] >= 0:
            f[tail + k] = _MOBILITY * sign * dydt[tail + index[source]]


@helper
def _copy(source, target):
    """Copy a matrix.

    An assignment would bring along the words of an error about shapes, seconds to compile.
    """
    for i in range(source.shape[0]):
        for k in range(source.shape[1]):
            target[i, k] = source[i, k]


@helper
def _moves(state, size, held, friction_on):
    """Tell whether an element's state moves.

    It then takes part in the pseudo-transient system.
    """
    return _source(state, size, held, friction_on)[0] >= 0 or (state == BVT and friction_on == 1)


@helper
def _mask_ball(j, r, size, bundle, bl, held, a2, b2, c2, on):
    """Mask the blocks of ball j.

    The ball is in row r; they go into those of the pseudo-transient system, and `on` marks the columns of all.
    """
    friction_on, reach = bundle.system[0].friction_on, bl.reach
    a, b, c = bl.a[j], bl.b[j], bl.c[j]
    a2[:, :], b2[:, :], c2[:, :] = 0.0, 0.0, 0.0
    for i in range(size):
        row, scale = _source(i, size, held, friction_on)
        if row < 0:
            continue
        for k in range(size):
            if _moves(k, size, held, friction_on):
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
            for i in range(size):
                if _moves(i, size, held, friction_on):
                    c2[k, i] = _MOBILITY * sign * c[own, i]
    _copy(a2, a)
    _copy(b2, b)
    _copy(c2, c)


@allocating_helper
def mask(bundle, bl, held):
    """Mask the blocks of dy/dt, in place.

    They become those of the pseudo-transient system.
    """
    bl.cross[:, :, :, :] = 0.0
    active, n, widest, largest = bundle.active, bl.d.shape[0], bl.b.shape[2], bl.a.shape[1]
    on = np.zeros(n, dtype=np.int64)
    for k in range(n):
        row, _ = _shared_row(active[k], bundle.bodies)
        on[k] = 1 if row >= 0 and bl.index[row] >= 0 else 0
    a2, b2, c2 = np.zeros((largest, largest)), np.zeros((largest, widest)), np.zeros((widest, largest))
    for r in range(bundle.rows.size):
        for j in range(bl.reach.first[r], bl.reach.first[r + 1]):
            _mask_ball(j, r, bundle.rows[r].size, bundle, bl, held[j], a2, b2, c2, on)
    d2 = np.zeros((n, n))
    for k in range(n):
        row, sign = _shared_row(active[k], bundle.bodies)
        if on[k] == 1:
            for m in range(n):
                d2[k, m] = _MOBILITY * sign * bl.d[bl.index[row], m] * on[m]
    _copy(d2, bl.d)

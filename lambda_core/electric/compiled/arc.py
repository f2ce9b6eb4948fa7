"""Parts of a discharge: the network while arcs burn, when that changes, and what the arcs turn into heat.

While arcs burn the network is linear too: an open channel is a resistance R with a voltage fall against the current.
The nodes that matter are the rings and the ball; the other balls keep their charge, and are eliminated by it, unless
metal joins one of them to a ring.
"""

from __future__ import annotations

from lambda_core.electric import columns as L
from lambda_core.electric.compiled.array_types import helper, shared_helper
from lambda_core.electric.compiled.modes import charges, decay_functions, propagate, voltages

_ROOT, _PLACE = 60, 1e-9  # steps of the search for a change at most; how well it is placed
# Gauss and Legendre's four nodes on 0..1 and their weights.
_NODE_1, _NODE_2 = 0.06943184420297371, 0.33000947820757187
_WEIGHT_1, _WEIGHT_2 = 0.17392742256872692, 0.32607257743127308


@shared_helper
def reduce_network(n, shared, ball, keep, c, g, q, c_r, g_r, q_r):
    """Write the network of the rings and one ball (of all balls where `keep` is 1); return its number of nodes."""
    if keep == 1:
        for i in range(n):
            for k in range(n):
                c_r[i, k] = c[i, k]
                g_r[i, k] = g[i, k]
            q_r[i] = q[i]
        return n
    size = shared + 1
    for i in range(size):
        p = i if i < shared else shared + ball
        for k in range(size):
            r = k if k < shared else shared + ball
            c_r[i, k] = c[p, r]
            g_r[i, k] = g[p, r]
        q_r[i] = q[p]
    for other in range(shared, n):
        if other == shared + ball:
            continue
        for i in range(shared):
            share = c[i, other] / c[other, other]
            for k in range(shared):
                c_r[i, k] -= share * c[other, k]
            q_r[i] -= share * q[other]
            g_r[i, i] += g[i, other]  # films that are not part of the discharge do not leak in its time
    return size


@shared_helper
def restore_charges(n, shared, ball, keep, c, v_r, size, c_r, q, q_r):
    """Write the charges of all nodes after a discharge."""
    charges(size, c_r, v_r, q_r)
    if keep == 1:
        for i in range(n):
            q[i] = q_r[i]
        return
    for i in range(shared):
        q[i] = q_r[i]
        for other in range(shared, n):
            if other != shared + ball:
                q[i] += c[i, other] / c[other, other] * q[other]
    q[shared + ball] = q_r[shared]


@helper
def _channel(shared, node, ring, s, y, size):
    """Return the voltage of a contact from the modes' amplitudes [V]."""
    total = 0.0
    for a in range(size):
        total += ((s[a, ring] if ring < shared else 0.0) - s[a, node]) * y[a]
    return total


@helper
def channel_current(voltage, ring, state):
    """Return the current of an open channel [A]."""
    return (voltage - state.sign[ring] * state.fall[ring]) / state.resistance[ring]


@shared_helper
def open_network(size, shared, node, state, g_r, g, inject):
    """Write the conductances with the open channels, and the currents of their falls into the nodes [A]."""
    for i in range(size):
        inject[i] = 0.0
        for k in range(size):
            g[i, k] = g_r[i, k]
    for ring in range(2):
        if state.burns[ring] == 0.0:
            continue
        part = 1.0 / state.resistance[ring]
        fall = state.sign[ring] * state.fall[ring] * part
        g[node, node] += part
        inject[node] -= fall
        if ring < shared:
            g[ring, ring] += part
            g[ring, node] -= part
            g[node, ring] -= part
            inject[ring] += fall


@helper
def _leaky(size, g_r):
    """Return 1 where the network conducts besides its arcs."""
    for i in range(size):
        if g_r[i, i] > 0.0:
            return 1
    return 0


@shared_helper
def book(size, shared, node, state, decay, s, y, drive, dt, at, g_r, v, rows, total):
    """Add up heat, arc energies and charges over one step, by Gauss and Legendre's rule; `at` and `v` are workspace."""
    leaky = _leaky(size, g_r)
    for point in range(4):
        place = _NODE_1 if point in (0, 3) else _NODE_2
        weight = dt * (_WEIGHT_1 if point in (0, 3) else _WEIGHT_2)
        moment = dt * (place if point < 2 else 1.0 - place)
        for a in range(size):
            gone, first, _ = decay_functions(decay[a] * moment)
            at[a] = y[a] * gone + drive[a] * moment * first
        if leaky == 1:
            voltages(size, s, at, v)
            for i in range(size):
                flow = 0.0
                for k in range(size):
                    flow += g_r[i, k] * v[k]
                total[L.T_OHMIC] += weight * v[i] * flow
                total[L.T_LEAK] += weight * flow
        for ring in range(2):
            if state.burns[ring] != 0.0:
                voltage = _channel(shared, node, ring, s, at, size)
                current = channel_current(voltage, ring, state)
                rows[ring, L.E_ENERGY] += weight * voltage * current
                rows[ring, L.E_CHARGE] += weight * abs(current)
                total[L.T_ARC] += weight * voltage * current
                if ring >= shared:
                    total[L.T_ARC_CHARGE] -= weight * current


@shared_helper
def _happens(size, shared, node, state, stand, s, y):
    """Return how far the amplitudes are past the next change: > 0 past it, and which ring it is about."""
    worst, which = -1.0, 0
    for ring in range(2):
        voltage = _channel(shared, node, ring, s, y, size)
        if state.burns[ring] != 0.0:
            # An arc dies where its current falls below the least one, or would turn round.
            past = 1.0 - state.sign[ring] * channel_current(voltage, ring, state) / state.least[ring]
        else:
            past = abs(voltage) / stand[ring] - 1.0
        if past > worst:
            worst, which = past, ring
    return worst, which


@shared_helper
def until_change(size, shared, node, state, stand, decay, s, y, drive, dt, after, area):
    """Return the part of the step dt after which something changes, and the ring that it is about (-1: nothing does).

    A channel that has just opened carries more than the least current, so the step starts before the change.
    """
    low = 0.0
    low_past, ring = _happens(size, shared, node, state, stand, s, y)
    if low_past >= 0.0:
        return 0.0, ring
    propagate(size, decay, y, drive, dt, after, area)
    past, ring = _happens(size, shared, node, state, stand, s, after)
    if past < 0.0:
        return dt, -1
    high, high_past, side = dt, past, 0
    for _ in range(_ROOT):  # false position after the Illinois rule
        at = (low * high_past - high * low_past) / (high_past - low_past)
        propagate(size, decay, y, drive, at, after, area)
        past, which = _happens(size, shared, node, state, stand, s, after)
        if past >= 0.0:
            high, high_past, ring = at, past, which
            low_past *= 0.5 if side == 1 else 1.0
            side = 1
        else:
            low, low_past = at, past
            high_past *= 0.5 if side == -1 else 1.0
            side = -1
        if high - low <= _PLACE * dt or 0.0 <= past < _PLACE:
            break
    return high, ring

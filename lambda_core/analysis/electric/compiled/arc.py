"""Build the network while arcs burn.

While arcs burn the network is linear too: an open channel is a resistance R with a voltage fall against the current.
The nodes that matter are the rings, the ball and balls that metal joins to a ring; the other balls keep their charge,
and are eliminated by it. A cage couples all balls: then all of them take part.
"""

from __future__ import annotations

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper
from lambda_core.analysis.electric.compiled.matrices import across_bearing, potential
from lambda_core.analysis.electric.compiled.modes import charges

SHORT = 1e-6  # a film that leaks slower than this does nothing during a discharge [s]
_AS_WEAK = 2.0  # times the least current


@helper
def is_joined(node, full):
    """Tell whether metal joins a ball to a ring.

    Charge then flows through it in the time of a discharge.
    """
    return full.conductance[node, node] * SHORT > full.capacitance[node, node]


@helper
def _choose(n, shared, ball, everyone, full, members, place):
    """Write the nodes that take part, return their count.

    The ball comes after the rings.
    """
    for ring in range(shared):
        members[ring] = ring
    members[shared] = shared + ball
    m = shared + 1
    for other in range(shared, n):
        place[other] = -1
        if other != shared + ball and (everyone == 1 or is_joined(other, full)):
            place[other] = m
            members[m] = other
            m += 1
    place[shared + ball] = shared
    return m


@shared_helper
def take_part(n, shared, ball, everyone, full, nodes, part, own, members, place):
    """Write the network of a discharge's nodes.

    Return the number of nodes.
    """
    m = _choose(n, shared, ball, everyone, full, members, place)
    c, g = full.capacitance, full.conductance
    for i in range(m):
        p = members[i]
        own.charge[i], own.potential[i] = nodes.charge[p], nodes.potential[p]
        for k in range(m):
            part.capacitance[i, k], part.conductance[i, k] = c[p, members[k]], g[p, members[k]]
    for other in range(shared, n):
        if place[other] != -1:
            continue
        for i in range(shared):
            for k in range(shared):
                part.capacitance[i, k] -= full.share[i, other] * c[other, k]
            own.charge[i] -= full.share[i, other] * nodes.charge[other]
            part.conductance[i, i] += g[i, other]  # such films do not leak in the time of a discharge
    return m


@shared_helper
def give_back(n, m, shared, full, nodes, part, own, members, place):
    """Write the charges of all nodes after a discharge."""
    charges(m, part.capacitance, own.potential, own.charge)
    for i in range(m):
        nodes.charge[members[i]] = own.charge[i]
    for other in range(shared, n):
        if place[other] == -1:
            for i in range(shared):
                nodes.charge[i] += full.share[i, other] * nodes.charge[other]


@helper
def channel_voltage(ring, shared, v, arcs):
    """Return the voltage of a contact [V].

    It is the potential of the ring less that of the ball.
    """
    return potential(arcs.terminal[ring], v) - v[shared]


@helper
def channel_current(voltage, ring, state):
    """Return the current of an open channel [A]."""
    return (voltage - state.sign[ring] * state.fall[ring]) / state.resistance[ring]


@shared_helper
def open_channel(ring, ball, now, net, v, held, arcs):
    """Let a channel conduct in its voltage's direction.

    Return the status of its law; 0 if it cannot conduct.
    """
    voltage, out = channel_voltage(ring, net.shared, v, arcs), arcs.out
    state, row, par = arcs.state, arcs.rows[ring], arcs.par[2 * net.bearing[ball] + ring]
    status = arcs.law(abs(voltage), held.film[ball, ring], held.area[ball, ring], par, out)
    if status != 1:
        return status
    if not abs(voltage) > out[1] + out[0] * out[2]:
        return 0
    state.burns[ring] = 1.0
    state.sign[ring] = 1.0 if voltage >= 0.0 else -1.0
    state.resistance[ring], state.fall[ring], state.least[ring] = out[0], out[1], out[2]
    if row[L.E_CONTACT_VOLTAGE] == 0.0:
        row[L.E_TIME] = now
        row[L.E_CONTACT_VOLTAGE] = voltage
        row[L.E_BEARING_VOLTAGE] = across_bearing(arcs.terminal[1], v)
    return 1


@helper
def quench(ring, now, shared, v, arcs):
    """Let an arc die.

    The other one dies with it if it is in series with it and as weak; tell whether none is left.
    """
    state = arcs.state
    for which in range(2):
        if state.burns[which] == 0.0:
            continue
        current = abs(channel_current(channel_voltage(which, shared, v, arcs), which, state))
        if which == ring or current < _AS_WEAK * state.least[which]:
            state.burns[which] = 0.0
            arcs.rows[which, L.E_DURATION] = now - arcs.rows[which, L.E_TIME]
    return state.burns[0] == 0.0 and state.burns[1] == 0.0


@helper
def conduct(m, shared, arcs, part, own):
    """Write conductances and fall currents of open channels.

    The currents of their falls flow into the nodes [A].
    """
    state = arcs.state
    for i in range(m):
        own.fall[i] = 0.0
        for k in range(m):
            part.opened[i, k] = part.conductance[i, k]
    for ring in range(2):
        if state.burns[ring] == 0.0:
            continue
        conductance = 1.0 / state.resistance[ring]
        fall = state.sign[ring] * state.fall[ring] * conductance
        part.opened[shared, shared] += conductance
        own.fall[shared] -= fall
        node = arcs.terminal[ring]
        if node >= 0:
            part.opened[node, node] += conductance
            part.opened[node, shared] -= conductance
            part.opened[shared, node] -= conductance
            own.fall[node] += fall

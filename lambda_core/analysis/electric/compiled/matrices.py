"""Assemble the network.

Rotor, insulated outer rings and the balls of all bearings are its nodes.
"""

from __future__ import annotations

from lambda_core.analysis.electric.columns import ROTOR
from lambda_core.analysis.electric.compiled.array_types import helper


@helper
def assemble(net, machine, bearings, cap, cond, c, g):
    """Write the capacitance and conductance matrices [F], [S]."""
    balls, n = cap.shape[0], net.shared + cap.shape[0]
    for i in range(n):
        for k in range(n):
            c[i, k] = 0.0
            g[i, k] = 0.0
    c[ROTOR, ROTOR] = machine.winding + machine.rotor
    g[ROTOR, ROTOR] = machine.brush
    for b in range(bearings.rings.size):
        _rings(b, net, bearings, c, g)
        for j in range(balls):
            if net.bearing[j] == b:
                _ball(j, net, machine.twins, cap, cond, c, g)
        c[ROTOR, ROTOR] += machine.twins * bearings.rings[b]
        if bearings.pocket[b] > 0.0:
            _cage(b, n, net, bearings, c)


@helper
def _rings(b, net, bearings, c, g):
    """Add the capacitances and conductances of a bearing's rings.

    They act between the rings past the balls, and between the outer ring and the frame.
    """
    rings, node = bearings.rings[b], net.ring[b]
    c[ROTOR, ROTOR] += rings
    if node >= 0:
        c[node, node] = rings + bearings.coating[b]
        c[ROTOR, node] = -rings
        c[node, ROTOR] = -rings
        g[node, node] = bearings.bridge[b]


@helper
def _ball(j, net, twins, cap, cond, c, g):
    """Add a ball with its two contacts."""
    node = net.shared + j
    c[node, node] = cap[j, 0] + cap[j, 1]
    g[node, node] = cond[j, 0] + cond[j, 1]
    for side in range(2):
        ring = ROTOR if side == 0 else net.outer[j]
        if ring < 0:
            continue
        c[ring, ring] += cap[j, side]
        c[ring, node] = -cap[j, side]
        c[node, ring] = -cap[j, side]
        g[ring, ring] += cond[j, side]
        g[ring, node] = -cond[j, side]
        g[node, ring] = -cond[j, side]
    c[ROTOR, ROTOR] += twins * cap[j, 0] * cap[j, 1] / (cap[j, 0] + cap[j, 1])


@helper
def _to_cage(node, b, net, bearings):
    """Return a node's capacitance against a cage [F]."""
    if node == ROTOR:
        return bearings.cage_inner[b]
    if node < net.shared:
        return bearings.cage_outer[b] if node == net.ring[b] else 0.0
    return bearings.pocket[b] if net.bearing[node - net.shared] == b else 0.0


@helper
def _cage(b, n, net, bearings, c):
    """Add a conducting cage that touches nothing.

    The cage's node has no charge and is eliminated (star to mesh).
    """
    balls = 0
    for j in range(n - net.shared):
        if net.bearing[j] == b:
            balls += 1
    total = bearings.cage_inner[b] + bearings.cage_outer[b] + balls * bearings.pocket[b]
    for i in range(n):
        own = _to_cage(i, b, net, bearings)
        c[i, i] += own
        for k in range(n):
            c[i, k] -= own * _to_cage(k, b, net, bearings) / total


@helper
def shares(n, shared, c, share):
    """Write c_ri/c_ii of every ball i.

    A ball that keeps its charge follows ring r by minus this part of its change.
    """
    for ring in range(shared):
        for i in range(shared, n):
            share[ring, i] = c[ring, i] / c[i, i]


@helper
def leaks(n, g, s, workspace, out):
    """Write the leakage current per mode amplitude.

    It flows to ground through the conductances.
    """
    for i in range(n):
        workspace[i] = 0.0
        for k in range(n):
            workspace[i] += g[k, i]
    for a in range(n):
        out[a] = 0.0
        for i in range(n):
            out[a] += workspace[i] * s[a, i]


@helper
def potential(node, v):
    """Return the potential of a node [V].

    The frame has 0 V.
    """
    return v[node] if node >= 0 else 0.0


@helper
def across(net, v, ball, side):
    """Return the voltage of a contact [V].

    It is the potential of the ring less that of the ball.
    """
    return potential(ROTOR if side == 0 else net.outer[ball], v) - v[net.shared + ball]


@helper
def across_bearing(ring, v):
    """Return the potential of the inner ring [V].

    It is relative to an outer ring, or to the frame with GROUND.
    """
    return v[ROTOR] - v[ring] if ring >= 0 else v[ROTOR]

"""Matrices of the network: nodes are the rotor, the outer ring where it is insulated, and the balls."""

from __future__ import annotations

from lambda_core.electric.columns import RING, ROTOR
from lambda_core.electric.compiled.array_types import helper


@helper
def assemble(insulated, machine, cap, cond, c, g):
    """Write the capacitance and conductance matrices [F], [S] and return the number of nodes."""
    balls = cap.shape[0]
    shared = 2 if insulated == 1 else 1
    n = shared + balls
    for i in range(n):
        for k in range(n):
            c[i, k] = 0.0
            g[i, k] = 0.0
    c[ROTOR, ROTOR] = machine.winding + machine.rotor + machine.rings
    g[ROTOR, ROTOR] = machine.brush
    if insulated == 1:
        c[RING, RING] = machine.rings + machine.coating
        c[ROTOR, RING] = -machine.rings
        c[RING, ROTOR] = -machine.rings
        g[RING, RING] = machine.bridge
    for j in range(balls):
        node = shared + j
        c[node, node] = cap[j, 0] + cap[j, 1]
        g[node, node] = cond[j, 0] + cond[j, 1]
        for ring in range(shared):
            c[ring, ring] += cap[j, ring]
            c[ring, node] = -cap[j, ring]
            c[node, ring] = -cap[j, ring]
            g[ring, ring] += cond[j, ring]
            g[ring, node] = -cond[j, ring]
            g[node, ring] = -cond[j, ring]
        c[ROTOR, ROTOR] += machine.twins * cap[j, 0] * cap[j, 1] / (cap[j, 0] + cap[j, 1])
    c[ROTOR, ROTOR] += machine.twins * machine.rings
    if machine.pocket > 0.0:
        _cage(n, shared, machine, c)
    return n


@helper
def _to_cage(node, shared, machine):
    """Return the capacitance of a node against the cage [F]."""
    if node == ROTOR:
        return machine.cage_inner
    return machine.cage_outer if node < shared else machine.pocket


@helper
def _cage(n, shared, machine, c):
    """Add a cage that conducts and touches nothing: its node, without charge, is eliminated (star to mesh)."""
    full = machine.cage_inner + machine.cage_outer + (n - shared) * machine.pocket
    for i in range(n):
        own = _to_cage(i, shared, machine)
        c[i, i] += own
        for k in range(n):
            c[i, k] -= own * _to_cage(k, shared, machine) / full


@helper
def shares(n, shared, c, share):
    """Write c_ri/c_ii of every ball i: a ball that keeps its charge follows ring r by minus this part of its change."""
    for ring in range(shared):
        for i in range(shared, n):
            share[ring, i] = c[ring, i] / c[i, i]


@helper
def leaks(n, g, s, workspace, out):
    """Write the current to ground through the conductances per amplitude of each mode."""
    for i in range(n):
        workspace[i] = 0.0
        for k in range(n):
            workspace[i] += g[k, i]
    for a in range(n):
        out[a] = 0.0
        for i in range(n):
            out[a] += workspace[i] * s[a, i]


@helper
def across(shared, v, ball, ring):
    """Return the voltage of a contact: potential of the ring less that of the ball [V]."""
    potential = v[ring] if ring < shared else 0.0
    return potential - v[shared + ball]


@helper
def across_bearing(shared, v):
    """Return the potential of the inner ring less that of the outer ring [V]."""
    return v[ROTOR] - v[RING] if shared == 2 else v[ROTOR]

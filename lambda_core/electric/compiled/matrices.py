"""Matrices of the network: nodes are the rotor, the outer ring where it is insulated, and the balls."""

from __future__ import annotations

from lambda_core.electric.columns import M_BRIDGE, M_BRUSH, M_COATING, M_RINGS, M_ROTOR, M_WINDING, RING, ROTOR
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
    c[ROTOR, ROTOR] = machine[M_WINDING] + machine[M_ROTOR] + machine[M_RINGS]
    g[ROTOR, ROTOR] = machine[M_BRUSH]
    if insulated == 1:
        c[RING, RING] = machine[M_RINGS] + machine[M_COATING]
        c[ROTOR, RING] = -machine[M_RINGS]
        c[RING, ROTOR] = -machine[M_RINGS]
        g[RING, RING] = machine[M_BRIDGE]
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
    return n


@helper
def across(shared, v, ball, ring):
    """Return the voltage of a contact: potential of the ring less that of the ball [V]."""
    potential = v[ring] if ring < shared else 0.0
    return potential - v[shared + ball]


@helper
def across_bearing(shared, v):
    """Return the potential of the inner ring less that of the outer ring [V]."""
    return v[ROTOR] - v[RING] if shared == 2 else v[ROTOR]

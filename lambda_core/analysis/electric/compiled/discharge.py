"""Integrate one discharge of a ball.

The integration takes the discharge from the breakdown until the last arc quenches.

The first film that breaks down lets the ball's voltage collapse within a nanosecond; the other film of the ball then
carries the full bearing voltage. Where it breaks down too, the rotor's charge flows through both: both contacts of a
ball make one discharge. Balls are followed one at a time: after the first the voltage of the bearing is gone. Where the
other film of the ball holds, or another bearing keeps its voltage, an edge of the source may drive that on: the
discharge ends when a film of another ball breaks down, which is the next one.
"""

from __future__ import annotations

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.arc import conduct, give_back, open_channel, quench, take_part
from lambda_core.analysis.electric.compiled.arc_interval import NEVER, OTHER, burn
from lambda_core.analysis.electric.compiled.array_types import helper
from lambda_core.analysis.electric.compiled.matrices import across_bearing
from lambda_core.analysis.electric.compiled.modes import amplitudes, charges, factorise, modes

_MOST_CHANGES = 1000


@helper
def _cut(now, arcs):
    """End the arcs that still burn in the table."""
    for ring in range(2):
        if arcs.state.burns[ring] != 0.0:
            arcs.rows[ring, L.E_DURATION] = now - arcs.rows[ring, L.E_TIME]


@helper
def discharge(n, net, ball, ring, elapsed, everyone, full, nodes, part, own, held, films, arcs, source, sums):
    """Compute a discharge that begins in one contact.

    Return a status of the integration.

    Parameters
    ----------
    elapsed : float
        Time since `held` began that says which patches films are on [s].
    everyone : int
        1 where all balls take part.
    nodes : Nodes
        Charges and potentials before; charges after the discharge.
    own, part : PartNodes, Part
        Workspace.
    arcs : Arcs
        With the voltages that the films of the ball stand; what the arcs did is left in its rows: the peak current is
        0 for a film that held.
    sums : Accumulators
        With the time, which is moved on.
    """
    total, shared = sums.total, net.shared
    now = total[L.T_TIME]
    m = take_part(n, shared, ball, everyone, full, nodes, part, own, arcs.members, arcs.place)
    if factorise(m, part.capacitance, part.factor) == 0:
        return L.NOT_POSITIVE
    arcs.terminal[0], arcs.terminal[1] = L.ROTOR, net.outer[ball]
    for b in range(arcs.opened.size):
        arcs.opened[b] = abs(across_bearing(net.ring[b], own.potential))
    arcs.rows[:, :] = 0.0
    arcs.state.burns[:] = 0.0
    for _ in range(_MOST_CHANGES):
        if arcs.state.burns[ring] == 0.0:
            status = open_channel(ring, ball, now, net, own.potential, held, arcs)
            if status != 1:
                total[L.T_STATUS] = status
                return L.ARC_STARVED if status == 0 else L.NO_ARC
        elif quench(ring, now, shared, own.potential, arcs):
            break
        conduct(m, shared, arcs, part, own)
        modes(m, part.factor, part.opened, part.turned, part.shape, own.decay)
        charges(m, part.capacitance, own.potential, own.charge)
        amplitudes(m, part.shape, own.charge, own.amplitude)
        now, ring = burn(now, m, n, net, ball, elapsed, full, nodes, part, own, held, films, arcs, source, sums)
        if ring == NEVER:
            return L.ENDLESS
        if ring == OTHER:
            _cut(now, arcs)
            break
    else:
        return L.ENDLESS
    give_back(n, m, shared, full, nodes, part, own, arcs.members, arcs.place)
    total[L.T_TIME] = now
    return L.OK

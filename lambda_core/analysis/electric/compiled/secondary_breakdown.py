"""Detect breakdown of other balls' films during an arc.

The voltage that continues while an arc burns in one film of a ball may break them down.
"""

from __future__ import annotations

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper
from lambda_core.analysis.electric.compiled.matrices import potential
from lambda_core.analysis.electric.compiled.modes import propagate, voltages
from lambda_core.analysis.electric.compiled.patches import threshold

_ROOT, _PLACE = 60, 1e-9  # steps of the search at most; how well the moment is placed


@shared_helper
def watch(ball, elapsed, held, films, limit):
    """Write the other balls' breakdown voltages.

    Their films lie on the patches that they reach `elapsed` after `held` began.
    """
    for j in range(held.film.shape[0]):
        for ring in range(2):
            limit[ring, j] = 0.0
            if j != ball and held.film[j, ring] > 0.0:
                limit[ring, j] = max(threshold(j, ring, elapsed, held, films), 0.0)


@shared_helper
def past_breakdown(n, net, full, nodes, limit, v, arcs):
    """Return another film's relative excess over its breakdown.

    It is >= 0 when the film of another ball is past it.

    Only bearings count whose voltage is above that at which the discharge began.

    Parameters
    ----------
    v : float64[:]
        Potentials of the nodes that take part [V]; other balls keep their charge.
    """
    worst, shared, place = -1.0, net.shared, arcs.place
    for other in range(shared, n):
        if place[other] == shared or arcs.raised[net.bearing[other - shared]] == 0:
            continue
        if place[other] >= 0:
            own = v[place[other]]
        else:
            own = nodes.charge[other] / full.capacitance[other, other]
            for i in range(shared):
                own -= full.share[i, other] * v[i]
        for ring in range(2):
            stands = limit[ring, other - shared]
            if stands > 0.0:
                voltage = potential(L.ROTOR if ring == 0 else net.outer[other - shared], v) - own
                worst = max(worst, abs(voltage) / stands - 1.0)
    return worst


@helper
def breakdown_ahead(m, n, net, dt, full, nodes, part, own, arcs):
    """Return another film's excess over its breakdown.

    The film belongs to another ball, and the excess is that after dt.
    """
    propagate(m, own.decay, own.amplitude, own.drive, dt, own.after, own.area)
    voltages(m, part.shape, own.after, own.ahead)
    return past_breakdown(n, net, full, nodes, part.limit, own.ahead, arcs)


@shared_helper
def first_moment(m, n, net, low, high, high_past, full, nodes, part, own, arcs):
    """Return the moment of another film's breakdown [s].

    The film belongs to another ball. The moment lies between two times, on the far side of the change.

    False position after the Illinois rule; `high_past` is how far it is past its breakdown at the later time.
    """
    low_past, side = breakdown_ahead(m, n, net, low, full, nodes, part, own, arcs), 0
    if low_past >= 0.0:
        return low
    for _ in range(_ROOT):
        if high - low <= _PLACE * high or high_past < _PLACE:
            break
        at = (low * high_past - high * low_past) / (high_past - low_past)
        found = breakdown_ahead(m, n, net, at, full, nodes, part, own, arcs)
        if found >= 0.0:
            high, high_past = at, found
            low_past *= 0.5 if side == 1 else 1.0
            side = 1
        else:
            low, low_past = at, found
            high_past *= 0.5 if side == -1 else 1.0
            side = -1
    return high

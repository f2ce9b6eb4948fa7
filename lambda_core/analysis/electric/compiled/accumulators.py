"""Accumulate sums and records of a circuit simulation.

These are sums that have to balance, the record of voltages, and the table of discharges.
"""

from __future__ import annotations

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper
from lambda_core.analysis.electric.compiled.matrices import across_bearing


@helper
def dot(n, one, other):
    """Return the sum of the products of n numbers."""
    total = 0.0
    for a in range(n):
        total += one[a] * other[a]
    return total


@helper
def energy(n, q, v):
    """Return the energy of charged nodes [J].

    It is q v / 2.
    """
    return 0.5 * dot(n, q, v)


@helper
def _sum(n, q):
    total = 0.0
    for i in range(n):
        total += q[i]
    return total


@helper
def _stored(n, winding, volt, q, v):
    """Return the energy of nodes and winding [J].

    It includes the winding's field.
    """
    return energy(n, q, v) + winding * volt * (0.5 * volt - v[L.ROTOR])


@helper
def is_recorded(sums, now):
    """Tell whether the record's window holds a moment."""
    return sums.window[0] <= now <= sums.window[1]


@shared_helper
def record(sums, now, volt, v, current):
    """Write one row of the record.

    It writes only while the record is inside its window and has room.
    """
    row = int(sums.total[L.T_TRACE])
    if row < sums.trace.shape[0] and is_recorded(sums, now):
        trace = sums.trace[row]
        trace[0], trace[1], trace[2] = now, volt, current
        for b in range(sums.ring.size):
            trace[L.N_TRACE + b] = across_bearing(sums.ring[b], v)
        sums.total[L.T_TRACE] += 1.0


@shared_helper
def begin_sums(n, winding, volt, q, v, sums):
    """Begin to count below the breakdown voltages.

    The films can then hold the voltages that they have.

    The start is that of films which never break down. One that does not stand it breaks down at once, at a voltage
    that would not have come about: neither this discharge nor the voltage before it is one of the operation.
    """
    total = sums.total
    total[L.T_SETTLING], total[L.T_BEGAN], total[L.T_TRACE] = 0.0, total[L.T_TIME], 0.0
    for k in (L.T_SOURCE, L.T_OHMIC, L.T_ARC, L.T_MOTION, L.T_LEAK, L.T_ARC_CHARGE):
        total[k] = 0.0
    total[L.T_STORED_0] = _stored(n, winding, volt, q, v)
    total[L.T_CHARGE_0] = _sum(n, q)
    record(sums, total[L.T_TIME], volt, v, 0.0)


@helper
def end_sums(n, winding, volt, q, v, total):
    """Write what is stored at the end of a stretch."""
    total[L.T_STORED], total[L.T_CHARGE] = _stored(n, winding, volt, q, v), _sum(n, q)


@shared_helper
def store(sums, rows, ball, sample):
    """Append a discharge to the table.

    The contact that broke down first comes before the other; return 0 when the table is full.
    """
    total, events = sums.total, sums.events
    both = rows[0, L.E_PEAK] > 0.0 and rows[1, L.E_PEAK] > 0.0
    turned = both and rows[1, L.E_TIME] < rows[0, L.E_TIME]
    for place in range(2):
        ring = 1 - place if turned else place
        if rows[ring, L.E_PEAK] == 0.0:
            continue
        k = int(total[L.T_EVENTS])
        if k >= events.shape[0]:
            return 0
        for column in range(L.N_EVENT):
            events[k, column] = rows[ring, column]
        events[k, L.E_BALL], events[k, L.E_RACEWAY] = ball, ring
        events[k, L.E_DISCHARGE], events[k, L.E_SAMPLE] = total[L.T_DISCHARGES], sample
        total[L.T_EVENTS] += 1.0
    total[L.T_DISCHARGES] += 1.0
    return 1

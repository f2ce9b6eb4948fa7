"""Integrate the network from switching edge to edge.

Discharges on the way are included.
"""

from __future__ import annotations

import math

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.accumulators import begin_sums, dot, end_sums, energy, record, store
from lambda_core.analysis.electric.compiled.array_types import (
    array1,
    array2,
    array3,
    bearings_t,
    channels_t,
    full_network_t,
    held_t,
    helper,
    i8,
    iarray1,
    iarray2,
    law_of,
    machine_t,
    nodes_t,
    part_nodes_t,
    part_t,
    tables_t,
    wiring_t,
)
from lambda_core.analysis.electric.compiled.discharge import discharge
from lambda_core.analysis.electric.compiled.initial_charge import periodic
from lambda_core.analysis.electric.compiled.intervals import hold, longest
from lambda_core.analysis.electric.compiled.matrices import across_bearing, assemble, leaks, shares
from lambda_core.analysis.electric.compiled.modes import (
    amplitudes,
    charges,
    factorise,
    heat,
    modes,
    propagate,
    voltages,
)
from lambda_core.analysis.electric.compiled.patches import first_breakdown, stood_by
from lambda_core.analysis.electric.compiled.source_segment import slope_at, source_work, voltage_at

integrate_sig = i8(
    i8, array1, array1, array1, array1, array1, tables_t, machine_t, bearings_t, wiring_t,
    law_of("breakdown"), array2, law_of("discharge"), array2, i8, i8,
    full_network_t, nodes_t, part_t, part_nodes_t, held_t, channels_t, iarray2, array2, array1, array1, array2, array1,
    iarray2, iarray1, array3, array2, array2, array1, array1,
)  # fmt: skip


@helper
def _prepare(n, net, machine, bearings, full, nodes, held):
    """Find the modes of the full network.

    Return 0 when a node has no capacitance.
    """
    assemble(net, machine, bearings, held.capacitance, held.conductance, full.capacitance, full.conductance)
    if factorise(n, full.capacitance, full.factor) == 0:
        return 0
    modes(n, full.factor, full.conductance, full.turned, full.shape, nodes.decay)
    shares(n, net.shared, full.capacitance, full.share)
    leaks(n, full.conductance, full.shape, nodes.ahead, nodes.leak)
    return 1


@helper
def _enter(n, machine, rest_t, rest_v, full, nodes, source, total):
    """Bring the network into an interval.

    The first interval has the charges of a long operation; later ones have those before them.

    Where capacitances change, charges stay and surfaces do work.
    """
    if total[L.T_SEGMENTS] == 0.0 and rest_t.size > 1:
        periodic(
            n, nodes.decay, full.shape, machine.winding, rest_t, rest_v, nodes.amplitude, nodes.drive, nodes.after,
            nodes.area, nodes.mean,
        )  # fmt: skip
        voltages(n, full.shape, nodes.amplitude, nodes.potential)
        return
    before, held_at = energy(n, nodes.charge, nodes.potential), nodes.potential[L.ROTOR]
    amplitudes(n, full.shape, nodes.charge, nodes.amplitude)
    voltages(n, full.shape, nodes.amplitude, nodes.potential)
    if total[L.T_SEGMENTS] > 0.0:
        volt = voltage_at(total[L.T_TIME], source)
        total[L.T_MOTION] += energy(n, nodes.charge, nodes.potential) - before
        total[L.T_SOURCE] -= machine.winding * volt * (nodes.potential[L.ROTOR] - held_at)


@helper
def _accept(n, volt, slope, dt, full, nodes, source, sums, i):
    """Accept a step and record it.

    The end of the step is known.
    """
    total, winding = sums.total, source.winding
    total[L.T_OHMIC] += heat(n, nodes.decay, nodes.amplitude, nodes.drive, dt, nodes.after)
    before, after = nodes.potential[L.ROTOR], nodes.ahead[L.ROTOR]
    total[L.T_SOURCE] += source_work(n, winding, volt, slope, dt, before, after, full.shape, nodes.area)
    total[L.T_LEAK] += dot(n, nodes.leak, nodes.area)
    for a in range(n):
        nodes.amplitude[a], nodes.potential[a] = nodes.after[a], nodes.ahead[a]
    total[L.T_TIME] += dt
    if total[L.T_SETTLING] == 0.0:
        for b in range(sums.ring.size):
            bearing = across_bearing(sums.ring[b], nodes.potential)
            sums.extremes[i, b, 0] = min(sums.extremes[i, b, 0], bearing)
            sums.extremes[i, b, 1] = max(sums.extremes[i, b, 1], bearing)
    record(sums, total[L.T_TIME], volt + slope * dt, nodes.potential, 0.0)


@helper
def _move(n, dt, full, nodes):
    """Write where the network is after dt."""
    propagate(n, nodes.decay, nodes.amplitude, nodes.drive, dt, nodes.after, nodes.area)
    voltages(n, full.shape, nodes.after, nodes.ahead)


@helper
def _segment(i, n, net, begin, stop, step, settles, everyone, full, nodes, part, own, held, films, arcs, source, sums):
    """Integrate to the next change.

    It is a corner of the source, a change of the contacts or a breakdown, and then the discharge there.

    Parameters
    ----------
    i : int
        Number of the interval of samples.
    step : float
        Longest step [s].
    settles : int
        1 where films may break down at once before the operation begins.
    """
    total = sums.total
    now = total[L.T_TIME]
    total[L.T_SEGMENTS] += 1.0
    slope, end = slope_at(now, source)
    volt = voltage_at(now, source)
    dt = min(min(stop, end) - now, step)
    for a in range(n):
        nodes.drive[a] = full.shape[a, L.ROTOR] * source.winding * slope
    _move(n, dt, full, nodes)
    elapsed = now + dt - begin
    best, ball, ring = first_breakdown(net, nodes.potential, nodes.ahead, held, elapsed, films)
    if best < 0.0:
        total[L.T_STATUS] = -best - 1.0
        return L.NO_VOLTAGE
    if total[L.T_SETTLING] == 1.0 and (best != 0.0 or settles == 0):
        charges(n, full.capacitance, nodes.potential, nodes.charge)
        begin_sums(n, source.winding, volt, nodes.charge, nodes.potential, sums)
    if best <= 1.0:
        dt *= best
        _move(n, dt, full, nodes)
    _accept(n, volt, slope, dt, full, nodes, source, sums, i)
    if best > 1.0:
        return L.OK
    charges(n, full.capacitance, nodes.potential, nodes.charge)
    refused = stood_by(ball, elapsed, held, films, arcs.stand)
    if refused < 0.0:
        total[L.T_STATUS] = -refused - 1.0
        return L.NO_VOLTAGE
    status = discharge(n, net, ball, ring, elapsed, everyone, full, nodes, part, own, held, films, arcs, source, sums)
    if status != L.OK:
        return status
    if total[L.T_SETTLING] == 0.0 and store(sums, arcs.rows, ball, float(i)) == 0:
        return L.EVENTS_FULL
    amplitudes(n, full.shape, nodes.charge, nodes.amplitude)
    voltages(n, full.shape, nodes.amplitude, nodes.potential)
    return L.OK


@helper
def _begin(first, n, nodes, source, total, t):
    """Begin a stretch.

    The source alone has charged the rotor, or the last stretch ended there.
    """
    if first == 0:
        return
    total[L.T_TIME], total[L.T_SETTLING] = t[0], 1.0
    for i in range(n):
        nodes.charge[i], nodes.potential[i] = 0.0, 0.0
    nodes.charge[L.ROTOR] = source.winding * voltage_at(t[0], source)


def integrate(
    first, rest_t, rest_v, source_t, source_v, t, tables, machine, bearings, wiring,
    break_law, break_par, arc_law, arc_par, seed, substeps,
    full, nodes, part, own, held, state, known, drawn, break_out, arc_out, rows, stand,
    members, place, extremes, events, trace, window, total,
):  # fmt: skip
    """Integrate the shaft's network through a time span.

    This is an entry point of the compiled code.

    Parameters
    ----------
    first : int
        1 where the integration begins, 0 where it goes on from what `nodes` and `total` hold.
    rest_t, rest_v : float64[:]
        Corners of one period of the source, for the charges at the start; empty: uncharged.
    source_t, source_v : float64[:], shape (k,)
        Corners of the common-mode voltage [s], [V].
    t : float64[:], shape (n,)
        Times of the contact samples [s].
    tables : Tables
        The contacts at these times; `film` is the central one where it may break down (0: none).
    machine : CircuitConstants
        What stands between winding, rotor and frame.
    bearings : BearingConstants
        What surrounds the films of each bearing.
    wiring : Wiring
        The nodes of balls and bearings.
    break_law, break_par, arc_law, arc_par
        Laws of the roles breakdown and discharge, and their parameters per ring of each bearing.
    seed, substeps : int
        Key of the random numbers; intervals of constant capacitance per sample.
    nodes : Nodes
        Charges and potentials are kept between stretches.
    full, part, own, held, state, known, drawn, break_out, arc_out, rows, stand, members, place
        Workspace.
    extremes : float64[:, :, :], shape (n - 1, bearings + 1, 2)
        Smallest and largest voltage of each bearing, and of the shaft, between samples [V].
    events, trace : float64[:, :]
        Discharges (E_*); moments inside `window` [s].
    total : float64[:]
        Sums (T_*).

    Returns
    -------
    int
        OK, EVENTS_FULL, NOT_POSITIVE, ENDLESS, or of a law: NO_VOLTAGE, NO_ARC, ARC_STARVED.
    """
    shared, everyone, settles = 1, 0, int(rest_t.size > 1)
    for b in range(bearings.rings.size):
        shared += int(wiring.ring[b] >= 0)
        everyone = max(everyone, int(bearings.pocket[b] > 0.0))
    n, net = shared + held.film.shape[0], L.Net(shared, wiring.bearing, wiring.outer, wiring.ring)
    films = L.Standing(
        break_law, break_par, break_out, wiring.bearing, bearings.roughness, bearings.least, seed, known, drawn
    )
    arcs = L.Arcs(
        arc_law,
        arc_par,
        arc_out,
        state,
        rows,
        stand[:2],
        stand[2:],
        place[2:4],
        place[4:],
        members[0],
        members[1],
        place[1:2],
    )
    source = L.Source(source_t, source_v, place[:1], machine.winding)
    sums = L.Accumulators(total, extremes, events, trace, wiring.ring, window)
    _begin(first, n, nodes, source, total, t)
    for i in range(t.size - 1):
        extremes[i, :, 0], extremes[i, :, 1] = math.inf, -math.inf
        length = (t[i + 1] - t[i]) / substeps
        for k in range(substeps):
            begin = t[i] + k * length
            stop = t[i + 1] if k == substeps - 1 else t[i] + (k + 1) * length
            if stop <= total[L.T_TIME]:
                continue  # a discharge went on beyond this part
            hold(i, k, substeps, t, tables, held, known)
            if _prepare(n, net, machine, bearings, full, nodes, held) == 0:
                return L.NOT_POSITIVE
            _enter(n, machine, rest_t, rest_v, full, nodes, source, total)
            step = longest(held)
            while total[L.T_TIME] < stop:
                status = _segment(
                    i, n, net, begin, stop, step, settles, everyone, full, nodes, part, own, held, films, arcs,
                    source, sums,
                )  # fmt: skip
                if status != L.OK:
                    return status
            charges(n, full.capacitance, nodes.potential, nodes.charge)
    volt = voltage_at(total[L.T_TIME], source)
    end_sums(n, machine.winding, volt, nodes.charge, nodes.potential, total)
    return L.OK

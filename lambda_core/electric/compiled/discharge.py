"""One discharge: arcs through the films of one ball, from the breakdown until the last one quenches.

The first film that breaks down lets the ball's voltage collapse within a nanosecond; the other film of the ball then
stands the whole bearing voltage. Where it breaks down too, the rotor's charge flows through both: both contacts of a
ball make one discharge. Balls are followed one at a time: after the first the voltage is gone. Where the other film of
the ball holds, an edge of the source may drive the voltage on: the discharge ends when a film of another ball breaks
down, which is the next one.
"""

from __future__ import annotations

from lambda_core.electric import columns as L
from lambda_core.electric.compiled.arc import (
    book,
    channel_current,
    open_network,
    reduce_network,
    restore_charges,
    until_change,
)
from lambda_core.electric.compiled.array_types import helper, shared_helper
from lambda_core.electric.compiled.bystanders import first_moment, past_breakdown, watch
from lambda_core.electric.compiled.matrices import across_bearing
from lambda_core.electric.compiled.modes import amplitudes, charges, modes, propagate, voltages
from lambda_core.electric.compiled.source import slope_at, source_work, voltage_at

# First step over the fastest mode's time, after an arc opens or dies and after a corner of the source; each step over
# the one before.
_FIRST, _CORNER, _GROWTH = 0.3, 1.0, 1.9
_MOST_CHANGES, _MOST_STEPS = 1000, 100000
_AS_WEAK = 2.0  # times the least current
_SPENT = 1.0  # times the fastest mode's time: the ball that an arc discharges has lost most of its voltage
_OTHER = -2  # in place of a ring: a film of another ball
_SHORT = 1e-6  # a film that leaks slower than this does nothing during a discharge [s]


@shared_helper
def joined(n, shared, ball, c, g):
    """Return 1 where metal joins another ball to a ring, so that it takes part in a discharge."""
    for other in range(shared, n):
        if other != shared + ball and g[other, other] * _SHORT > c[other, other]:
            return 1
    return 0


@shared_helper
def record(trace, total, window, now, volt, bearing, current):
    """Write one row of the record while it is inside its window and there is room."""
    row = int(total[L.T_TRACE])
    if row < trace.shape[0] and window[0] <= now <= window[1]:
        trace[row, 0], trace[row, 1], trace[row, 2], trace[row, 3] = now, volt, bearing, current
        total[L.T_TRACE] += 1.0


@helper
def _open_channel(ring, ball, now, shared, node, v, held, law, par, out, state, rows):
    """Let a channel conduct, in the direction that its voltage drives; return the status of its law, 0: it cannot."""
    voltage = (v[ring] if ring < shared else 0.0) - v[node]
    status = law(abs(voltage), held.film[ball, ring], held.area[ball, ring], par[ring], out)
    if status != 1:
        return status
    if not abs(voltage) > out[1] + out[0] * out[2]:
        return 0
    state.burns[ring] = 1.0
    state.sign[ring] = 1.0 if voltage >= 0.0 else -1.0
    state.resistance[ring], state.fall[ring], state.least[ring] = out[0], out[1], out[2]
    if rows[ring, L.E_CONTACT_VOLTAGE] == 0.0:
        rows[ring, L.E_TIME] = now
        rows[ring, L.E_CONTACT_VOLTAGE] = voltage
        rows[ring, L.E_BEARING_VOLTAGE] = across_bearing(shared, v)
    return 1


@helper
def _quench(ring, now, shared, node, state, v, rows):
    """Let an arc die, and the other one with it that is in series with it and as weak."""
    for which in range(2):
        if state.burns[which] == 0.0:
            continue
        voltage = (v[which] if which < shared else 0.0) - v[node]
        if which == ring or abs(channel_current(voltage, which, state)) < _AS_WEAK * state.least[which]:
            state.burns[which] = 0.0
            rows[which, L.E_DURATION] = now - rows[which, L.E_TIME]


@helper
def _largest_current(shared, node, state, v, rows):
    """Keep the peaks of the open channels' currents, and return the larger one now [A]."""
    largest = 0.0
    for ring in range(2):
        if state.burns[ring] != 0.0:
            current = abs(channel_current((v[ring] if ring < shared else 0.0) - v[node], ring, state))
            rows[ring, L.E_PEAK] = max(rows[ring, L.E_PEAK], current)
            largest = max(largest, current)
    return largest


@shared_helper
def burn(
    now, size, shared, node, state, stand, decay, s, y, fall, machine, source_t, source_v, place,
    g_r, v, vectors, rows, total, trace, window, opened, n, ball, keep, c, g, q, held, begin, roughness, least,
    break_law, break_par, break_out, seed, known, drawn,
):  # fmt: skip
    """March with the same channels open until something changes; return the time and what.

    Returns
    -------
    now : float
        [s]
    ring : int
        The contact of the ball that opens or quenches; _OTHER where a film of another ball breaks down; -1: nothing.
    """
    after, area, drive, ahead, limits = vectors[9], vectors[10], vectors[12], vectors[20], vectors[21:23]
    fastest = 0.0
    for a in range(size):
        fastest = max(fastest, decay[a])
    dt, segment, watched = 0.0, -1, 0
    # Where metal bridges the other film, the rotor's charge flows: such an arc is no partial one.
    own = shared + ball
    alone = state.burns[0] + state.burns[1] == 1.0 and not g[own, own] * _SHORT > c[own, own]
    started = now
    _largest_current(shared, node, state, v, rows)
    for _ in range(_MOST_STEPS):
        slope, end = slope_at(now, source_t, source_v, place)
        if place[0] == segment:
            dt *= _GROWTH
        else:
            dt = (_FIRST if segment < 0 else _CORNER) / fastest
            segment = place[0]
        volt = voltage_at(now, source_t, source_v, place)
        fall[L.ROTOR] += machine.winding * slope
        amplitudes(size, s, fall, drive)
        fall[L.ROTOR] -= machine.winding * slope
        part, ring = until_change(size, shared, node, state, stand, decay, s, y, drive, min(dt, end - now), after, area)
        if alone and now - started > _SPENT / fastest:
            propagate(size, decay, y, drive, part, after, area)
            voltages(size, s, after, ahead)
            if abs(across_bearing(shared, ahead)) > opened:
                if watched == 0:
                    watched = 1
                    watch(
                        ball, held, now - begin, roughness, least, break_law, break_par,
                        break_out, seed, known, drawn, limits,
                    )  # fmt: skip
                if past_breakdown(n, shared, ball, keep, c, q, ahead, limits) >= 0.0:
                    ring = _OTHER
                    part = first_moment(
                        part, size, decay, s, y, drive, after, area, ahead, n, shared, ball, keep, c, q, limits
                    )
        book(size, shared, node, state, decay, s, y, drive, part, after, g_r, vectors[14], rows, total)
        before = v[L.ROTOR]
        propagate(size, decay, y, drive, part, after, area)
        for a in range(size):
            y[a] = after[a]
        voltages(size, s, y, v)
        total[L.T_SOURCE] += source_work(size, machine.winding, volt, slope, part, before, v[L.ROTOR], s, area)
        now += part
        current = _largest_current(shared, node, state, v, rows)
        record(trace, total, window, now, volt + slope * part, across_bearing(shared, v), current)
        if ring != -1:
            return now, ring
    return now, -1


@shared_helper
def discharge(
    now, ball, ring, n, shared, c, g, q, v, stand, held, law, par, out, machine, source_t, source_v, place,
    work, vectors, rows, state, total, trace, window, begin, roughness, least, break_law, break_par, break_out, seed,
    known, drawn,
):  # fmt: skip
    """Follow a discharge that begins at `now` in one contact; return when it is over, and a status of the march.

    Parameters
    ----------
    q, v : float64[:]
        Charges of the nodes, left as they are after the discharge; potentials before it.
    stand : float64[:], shape (2,)
        Voltages that the two films of the ball stand [V].
    rows : float64[:, :], shape (2, N_EVENT)
        What the arcs did; the peak current is 0 for a film that held.
    law, par, out
        Law of the role discharge, its parameters per ring, and room for what it says.
    begin : float
        Time from which `held` counts what was rolled [s].
    roughness, least, break_law, break_par, break_out, seed, known, drawn
        What the films of other balls stand.
    state : Channels
        Workspace.
    """
    c_r, g_r, g_o, low, b, s = work[3], work[4], work[5], work[6], work[7], work[8]
    q_r, v_r, y, decay, fall = vectors[6], vectors[7], vectors[8], vectors[11], vectors[13]
    # A cage couples the balls: then all of them take part.
    keep = 1 if machine.pocket > 0.0 else joined(n, shared, ball, c, g)
    size = reduce_network(n, shared, ball, keep, c, g, q, c_r, g_r, q_r)
    node = shared + ball if keep == 1 else shared
    for i in range(size):
        v_r[i] = v[shared + ball] if keep == 0 and i == shared else v[i]
    opened = abs(across_bearing(shared, v))
    rows[:, :] = 0.0
    state.burns[:] = 0.0
    for _ in range(_MOST_CHANGES):
        if state.burns[ring] == 0.0:
            status = _open_channel(ring, ball, now, shared, node, v_r, held, law, par, out, state, rows)
            if status != 1:
                total[L.T_STATUS] = status
                return now, L.ARC_STARVED if status == 0 else L.NO_ARC
        else:
            _quench(ring, now, shared, node, state, v_r, rows)
            if state.burns[0] == 0.0 and state.burns[1] == 0.0:
                restore_charges(n, shared, ball, keep, c, v_r, size, c_r, q, q_r)
                return now, L.OK
        open_network(size, shared, node, state, g_r, g_o, fall)
        if modes(size, c_r, g_o, low, b, s, decay) == 0:
            return now, L.ENDLESS
        charges(size, c_r, v_r, q_r)
        amplitudes(size, s, q_r, y)
        now, ring = burn(
            now, size, shared, node, state, stand, decay, s, y, fall, machine, source_t, source_v, place,
            g_r, v_r, vectors, rows, total, trace, window, opened, n, ball, keep, c, g, q, held, begin, roughness,
            least, break_law, break_par, break_out, seed, known, drawn,
        )  # fmt: skip
        if ring == _OTHER:
            for which in range(2):
                if state.burns[which] != 0.0:
                    rows[which, L.E_DURATION] = now - rows[which, L.E_TIME]
            restore_charges(n, shared, ball, keep, c, v_r, size, c_r, q, q_r)
            return now, L.OK
        if ring < 0:
            return now, L.ENDLESS
    return now, L.ENDLESS

"""Integrate a discharge while its channels do not change.

The interval ends when a film breaks down or an arc quenches.

From corner to corner of the source the modes are exact, so that steps only look for the first change: they double, and
with them the decay functions, exp(-2 x) = exp(-x)^2, without an exponential of their own.
"""

from __future__ import annotations

import math

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.compiled.accumulators import dot, is_recorded, record
from lambda_core.analysis.electric.compiled.arc import channel_current, is_joined
from lambda_core.analysis.electric.compiled.array_types import helper
from lambda_core.analysis.electric.compiled.matrices import across_bearing, potential
from lambda_core.analysis.electric.compiled.modes import amplitudes, decay_functions, products, propagate, voltages
from lambda_core.analysis.electric.compiled.secondary_breakdown import first_moment, past_breakdown, watch
from lambda_core.analysis.electric.compiled.source_segment import slope_at, source_work, voltage_at

NOTHING, OTHER, NEVER = -1, -2, -3  # in place of a ring: no change; the film of another ball; no end
# First step over the fastest mode's time, after an arc opens or dies and after a corner of the source.
_FIRST, _CORNER = 0.3, 1.0
_MOST_CORNERS, _DOUBLINGS, _ROOT = 100000, 200, 60
_PLACE = 1e-9  # how well a change is placed, relative
_SPENT = 1.0  # times the fastest mode's time: the ball that an arc discharges has lost most of its voltage


@helper
def _past(ring, m, part, y, arcs):
    """Return the distance past a contact's next change.

    It is >= 0 past the change of a contact of the ball.
    """
    voltage, state = dot(m, part.channel[ring], y), arcs.state
    if state.burns[ring] == 0.0:
        return abs(voltage) / arcs.stand[ring] - 1.0
    # An arc dies where its current falls below the least one, or would turn round.
    return 1.0 - state.sign[ring] * channel_current(voltage, ring, state) / state.least[ring]


@helper
def _worst(m, part, y, arcs):
    """Return the distance past the first change.

    Also return the contact of this change.
    """
    inner, outer = _past(0, m, part, y, arcs), _past(1, m, part, y, arcs)
    return (outer, 1) if outer > inner else (inner, 0)


@helper
def _nearer(ring, past, m, part, own, arcs):
    """Return the distance of the change from now.

    It counts from the amplitudes `own.after` [s], by Newton's rule; arcs decay, so on a logarithm.

    It aims half the allowance behind the change.
    """
    state, speed = arcs.state, 0.0
    for a in range(m):
        speed += part.channel[ring, a] * (own.drive[a] - own.decay[a] * own.after[a])
    if state.burns[ring] == 0.0:
        sign = 1.0 if dot(m, part.channel[ring], own.after) >= 0.0 else -1.0
        return (0.5 * _PLACE - past) * arcs.stand[ring] / (sign * speed)
    rate = -state.sign[ring] * speed / (state.resistance[ring] * state.least[ring])
    left = 1.0 - past
    return (left * math.log(left / (1.0 - 0.5 * _PLACE)) if left > 0.0 else 0.5 * _PLACE - past) / rate


@helper
def _moment(m, part, own, arcs, low, high, past, ring):
    """Return the moment of a contact's next change.

    The moment lies between two times, on the far side of the change. Also return which contact of the ball changes.

    Newton's rule inside a bracket; `past` and `ring` are those of `own.after`, the amplitudes at the later time.
    """
    found, at = ring, high
    for _ in range(_ROOT):
        at += _nearer(found, past, m, part, own, arcs)
        if not low < at < high:
            at = 0.5 * (low + high)
        for a in range(m):
            gone, mean, _ = decay_functions(own.decay[a] * at)
            own.after[a] = own.amplitude[a] * gone + own.drive[a] * at * mean
        past, found = _worst(m, part, own.after, arcs)
        if past >= 0.0:
            high, ring = at, found
        else:
            low = at
        if 0.0 <= past < _PLACE or high - low <= _PLACE * high:
            break
    return high, ring


@helper
def _peak(m, part, y, arcs):
    """Keep the peaks of the open channels' currents.

    Return the larger current now [A].
    """
    largest = 0.0
    for ring in range(2):
        if arcs.state.burns[ring] != 0.0:
            current = abs(channel_current(dot(m, part.channel[ring], y), ring, arcs.state))
            arcs.rows[ring, L.E_PEAK] = max(arcs.rows[ring, L.E_PEAK], current)
            largest = max(largest, current)
    return largest


@helper
def _decay_to(m, own, dt):
    """Write the decay functions of all modes after dt."""
    for a in range(m):
        x = own.decay[a] * dt
        _, own.mean[a], _ = decay_functions(x)
        own.lost[a] = x * own.mean[a]


@helper
def _others(low, at, m, n, net, ball, alone, elapsed, full, nodes, part, own, held, films, arcs):
    """Return the moment of another ball's breakdown [s].

    The moment lies between two times; it is -1 if none breaks down.

    Where no bearing has more voltage than the discharge began at, nothing can have happened. While an arc leads through
    an insulated bearing, only the others without insulation keep a voltage that the arc does not bound.
    """
    propagate(m, own.decay, own.amplitude, own.drive, at, own.after, own.area)
    voltages(m, part.shape, own.after, own.ahead)
    any_raised = 0
    for b in range(arcs.opened.size):
        watched = alone or net.ring[b] < 0
        arcs.raised[b] = int(watched and abs(across_bearing(net.ring[b], own.ahead)) > arcs.opened[b])
        any_raised = max(any_raised, arcs.raised[b])
    if any_raised == 0:
        return -1.0
    if arcs.watched[0] == 0:
        arcs.watched[0] = 1
        watch(ball, elapsed, held, films, part.limit)
    past = past_breakdown(n, net, full, nodes, part.limit, own.ahead, arcs)
    return -1.0 if past < 0.0 else first_moment(m, n, net, low, at, past, full, nodes, part, own, arcs)


@helper
def _until_change(
    first, limit, now, volt, slope, spent, m, n, net, ball, alone, elapsed, full, nodes, part, own, held, films, arcs,
    sums,
):  # fmt: skip
    """Return the time until something changes [s].

    It is a part of `limit`; also return what changes (NOTHING: nothing does).

    A channel that has just opened carries more than the least current, so the search starts before the change.

    Parameters
    ----------
    first : float
        Step to begin with [s].
    spent : float
        Time from `now` on after which films of other balls are looked at [s].
    """
    past, ring = _worst(m, part, own.amplitude, arcs)
    if past >= 0.0:
        return 0.0, ring
    low, high = 0.0, min(first, limit)
    _decay_to(m, own, high)
    for _ in range(_DOUBLINGS):
        for a in range(m):
            own.after[a] = own.amplitude[a] * (1.0 - own.lost[a]) + own.drive[a] * high * own.mean[a]
        past, ring = _worst(m, part, own.after, arcs)
        at, ring = _moment(m, part, own, arcs, low, high, past, ring) if past >= 0.0 else (high, NOTHING)
        if low > spent:
            sooner = _others(low, at, m, n, net, ball, alone, elapsed, full, nodes, part, own, held, films, arcs)
            if sooner >= 0.0:
                return sooner, OTHER
        if ring != NOTHING or at == limit:
            return at, ring
        current = _peak(m, part, own.after, arcs)
        if is_recorded(sums, now + high):
            voltages(m, part.shape, own.after, own.ahead)
            record(sums, now + high, volt + slope * high, own.ahead, current)
        low = high
        if 2.0 * high >= limit:
            high = limit
            _decay_to(m, own, high)
        else:
            high *= 2.0
            for a in range(m):
                own.mean[a] *= 1.0 - 0.5 * own.lost[a]
                own.lost[a] *= 2.0 - own.lost[a]
    return low, NEVER


@helper
def _accumulate(m, dt, part, own, arcs, total):
    """Add up heat, arc energies and charges over dt.

    The amplitudes at its end are `own.after`.
    """
    state, rows = arcs.state, arcs.rows
    products(m, own.decay, own.amplitude, own.drive, dt, own.after, own.area, own.middle, part.product)
    for ring in range(2):
        if state.burns[ring] == 0.0:
            continue
        channel, square = part.channel[ring], 0.0
        for a in range(m):
            for b in range(m):
                square += channel[a] * channel[b] * part.product[a, b]
        linear, fall = dot(m, channel, own.area), state.sign[ring] * state.fall[ring]
        heat = (square - fall * linear) / state.resistance[ring]
        charge = (linear - fall * dt) / state.resistance[ring]
        rows[ring, L.E_ENERGY] += heat
        rows[ring, L.E_CHARGE] += abs(charge)
        total[L.T_ARC] += heat
        if arcs.terminal[ring] < 0:
            total[L.T_ARC_CHARGE] -= charge
    for a in range(m):
        for i in range(m):
            flow = dot(m, part.conductance[i], part.shape[a])
            total[L.T_LEAK] += flow * own.area[a]
            for b in range(m):
                total[L.T_OHMIC] += flow * part.shape[b, i] * part.product[a, b]


@helper
def _channels(m, shared, part, arcs):
    """Write both contact voltages of the ball.

    The voltages are per amplitude of each mode.
    """
    for ring in range(2):
        for a in range(m):
            part.channel[ring, a] = potential(arcs.terminal[ring], part.shape[a]) - part.shape[a, shared]


@helper
def burn(now, m, n, net, ball, elapsed, full, nodes, part, own, held, films, arcs, source, sums):
    """Integrate with the same channels open until something changes.

    Parameters
    ----------
    m : int
        Nodes that take part; the ball is the one behind the rings.
    elapsed : float
        Time since `held` began that says which patches films are on [s].

    Returns
    -------
    now : float
        [s]
    ring : int
        The contact of the ball that opens or quenches; OTHER, NEVER.
    """
    fastest = 0.0
    for a in range(m):
        fastest = max(fastest, own.decay[a])
    shared = net.shared
    _channels(m, shared, part, arcs)
    # Where metal bridges the other film, the rotor's charge flows: such an arc is no partial one.
    node = shared + ball
    alone = arcs.state.burns[0] + arcs.state.burns[1] == 1.0 and not is_joined(node, full)
    insulated = arcs.terminal[1] >= 0 and arcs.opened.size > 1
    spent = now + _SPENT / fastest if alone or insulated else math.inf
    first, arcs.watched[0] = _FIRST / fastest, 0
    _peak(m, part, own.amplitude, arcs)
    for _ in range(_MOST_CORNERS):
        slope, end = slope_at(now, source)
        volt, before = voltage_at(now, source), own.potential[L.ROTOR]
        amplitudes(m, part.shape, own.fall, own.drive)
        for a in range(m):
            own.drive[a] += part.shape[a, L.ROTOR] * source.winding * slope
        dt, ring = _until_change(
            first, end - now, now, volt, slope, spent - now, m, n, net, ball, alone, elapsed, full, nodes, part, own,
            held, films, arcs, sums,
        )  # fmt: skip
        propagate(m, own.decay, own.amplitude, own.drive, dt, own.after, own.area)
        _accumulate(m, dt, part, own, arcs, sums.total)
        for a in range(m):
            own.amplitude[a] = own.after[a]
        voltages(m, part.shape, own.amplitude, own.potential)
        sums.total[L.T_SOURCE] += source_work(
            m, source.winding, volt, slope, dt, before, own.potential[L.ROTOR], part.shape, own.area
        )
        now += dt
        current = _peak(m, part, own.amplitude, arcs)
        record(sums, now, volt + slope * dt, own.potential, current)
        if ring != NOTHING:
            return now, ring
        first = _CORNER / fastest
    return now, NEVER

"""The network through time: from switching edge to switching edge, and through every discharge on the way."""

from __future__ import annotations

import math

from lambda_core.electric import columns as L
from lambda_core.electric.compiled.array_types import (
    array1,
    array2,
    array3,
    channels_t,
    f8,
    held_t,
    helper,
    i8,
    iarray1,
    iarray2,
    law_of,
    machine_t,
    shared_helper,
)
from lambda_core.electric.compiled.discharge import discharge, record
from lambda_core.electric.compiled.matrices import across, across_bearing, assemble
from lambda_core.electric.compiled.modes import amplitudes, charges, heat, modes, propagate, voltages
from lambda_core.electric.compiled.patches import threshold
from lambda_core.electric.compiled.rest import periodic
from lambda_core.electric.compiled.source import slope_at, source_work, voltage_at

march_sig = i8(
    i8, array1, array1, array1, array1, array1, array3, array3, array3, array3, array3, array3, machine_t, f8, f8,
    law_of("breakdown"), array2, law_of("discharge"), array2, i8, i8, i8,
    array3, array2, held_t, iarray2, array2, array1, array1, array2, channels_t, iarray1, array2, array2, array2,
    array1, array1,
)  # fmt: skip
N_WORK, N_VECTORS = 9, 23
_NO_PATCH = -(2**62)


@helper
def _between(table, i, x, out):
    """Write a row of a table of samples, interpolated linearly between samples i and i + 1."""
    for j in range(out.shape[0]):
        for ring in range(2):
            out[j, ring] = (1.0 - x) * table[i, j, ring] + x * table[i + 1, j, ring]


@helper
def _closed(film, i, out):
    """Take out the film of contacts that have none at one end of the interval: half a film would break down at once."""
    for j in range(out.shape[0]):
        for ring in range(2):
            if film[i, j, ring] <= 0.0 or film[i + 1, j, ring] <= 0.0:
                out[j, ring] = 0.0


@helper
def _dot(n, one, other):
    total = 0.0
    for a in range(n):
        total += one[a] * other[a]
    return total


@helper
def _energy(n, q, v):
    """Return the energy q v / 2 of charged nodes [J]."""
    return 0.5 * _dot(n, q, v)


@helper
def _sum(n, q):
    total = 0.0
    for i in range(n):
        total += q[i]
    return total


@helper
def _patch(spin, rate, elapsed):
    """Return the number of the patch of surface that a contact is on."""
    return math.floor(spin + rate * elapsed)


@shared_helper
def first_breakdown(shared, v, v1, held, elapsed, roughness, least, law, par, out, seed, known, drawn):
    """Return the part of the step after which a film breaks down (2: none does, < 0: refused), its ball and its ring.

    Between the ends of a step the voltages are straight lines.
    """
    best, at_ball, at_ring = 2.0, -1, -1
    for j in range(held.film.shape[0]):
        for ring in range(2):
            end = across(shared, v1, j, ring)
            if held.film[j, ring] <= 0.0 or abs(end) < least:
                continue
            patch = _patch(held.rolled[j, ring], held.rate[j, ring], elapsed)
            stands = threshold(j, ring, patch, held, roughness, least, law, par, out, seed, known, drawn)
            if stands < 0.0:
                return stands, j, ring
            if abs(end) < stands:
                continue
            sign = 1.0 if end > 0.0 else -1.0
            begin = sign * across(shared, v, j, ring)
            part = 0.0 if begin >= stands else (stands - begin) / (abs(end) - begin)
            if part < best:
                best, at_ball, at_ring = part, j, ring
    return best, at_ball, at_ring


@shared_helper
def _store(events, total, rows, ball, sample):
    """Append what a discharge did, the contact that broke down first before the other; 0 when the table is full."""
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


@shared_helper
def _open_books(n, winding, volt, now, q, v, total):
    """Begin to count, once the films stand the voltages that they have.

    The start is that of films which never break down. One that does not stand it breaks down at once, at a voltage
    that would not have come about: neither this discharge nor the voltage before it is one of the operation.
    """
    total[L.T_SETTLING], total[L.T_BEGAN], total[L.T_TRACE] = 0.0, now, 0.0
    for k in (L.T_SOURCE, L.T_OHMIC, L.T_ARC, L.T_MOTION, L.T_LEAK, L.T_ARC_CHARGE):
        total[k] = 0.0
    total[L.T_STORED_0] = _energy(n, q, v) + winding * volt * (0.5 * volt - v[L.ROTOR])
    total[L.T_CHARGE_0] = _sum(n, q)


@helper
def _longest(held):
    """Return a step in which no contact that may break down rolls over more than one patch [s]."""
    fastest = 0.0
    for j in range(held.film.shape[0]):
        for ring in range(2):
            if held.film[j, ring] > 0.0:
                fastest = max(fastest, abs(held.rate[j, ring]))
    return 1.0 / fastest if fastest > 0.0 else math.inf


@helper
def _leaks(n, g, s, out):
    """Write the current to ground through the conductances per amplitude of each mode."""
    for a in range(n):
        out[a] = 0.0
        for i in range(n):
            for k in range(n):
                out[a] += g[k, i] * s[a, i]


def march(
    first, rest_t, rest_v, source_t, source_v, t, cap, cond, film, thinnest, area_of, rolled, machine, roughness, least,
    break_law, break_par, arc_law, arc_par, insulated, seed, substeps,
    work, vectors, held, known, drawn, break_out, arc_out, rows, state, place, extremes, events, trace, window,
    total,
):  # fmt: skip
    """March the network of one bearing through a stretch of time; an entry point.

    Parameters
    ----------
    first : int
        1 where the march begins, 0 where it goes on from what `vectors` and `total` hold.
    rest_t, rest_v : float64[:]
        Corners of one period of the source, for the charges that the march begins with; empty: it begins uncharged.
    source_t, source_v : float64[:], shape (k,)
        Corners of the common-mode voltage [s], [V].
    t : float64[:], shape (n,)
        Times of the contact samples [s].
    cap, cond, film, thinnest, area_of, rolled : float64[:, :, :], shape (n, Z, 2)
        Capacitance [F] and conductance [S] of the contacts, central film that may break down (0: none) and its
        minimum [m], Hertzian area [m2], patches of surface rolled over since the start.
    machine : Machine
        What surrounds the films.
    roughness, least : float
        Composite rms roughness [m]; voltage below which nothing breaks down [V].
    break_law, break_par, arc_law, arc_par
        Laws of the roles breakdown and discharge, and their parameters per ring.
    insulated, seed, substeps : int
        Whether the outer ring is a node; key of the random numbers; intervals of constant capacitance per sample.
    work, vectors, held, known, drawn, break_out, arc_out, rows, state, place
        Workspace.
    extremes : float64[:, :], shape (n - 1, 2)
        Smallest and largest bearing voltage between samples [V].
    events, trace : float64[:, :]
        Discharges (E_*); moments inside `window` [s].
    total : float64[:]
        Sums (T_*).

    Returns
    -------
    int
        OK, EVENTS_FULL, NOT_POSITIVE, ENDLESS, or of a law: NO_VOLTAGE, NO_ARC, ARC_STARVED.
    """
    shared = 2 if insulated == 1 else 1
    c, g, s = work[0], work[1], work[2]
    y, v, v1, after, area, decay = vectors[0], vectors[1], vectors[2], vectors[3], vectors[4], vectors[5]
    q, drive, stand, leaks, mean = vectors[15], vectors[16], vectors[17], vectors[18], vectors[19]
    now, n, winding = t[0] if first == 1 else total[L.T_TIME], shared + cap.shape[1], machine.winding
    place[0] = 0
    slope_at(now, source_t, source_v, place)
    if first == 1:
        for i in range(n):
            q[i], v[i] = 0.0, 0.0
        q[L.ROTOR] = winding * voltage_at(now, source_t, source_v, place)
        total[L.T_SETTLING] = 1.0
    total[L.T_BEGAN] = now
    began = 1 - first
    for i in range(t.size - 1):
        extremes[i, 0], extremes[i, 1] = math.inf, -math.inf
        length = (t[i + 1] - t[i]) / substeps
        for ring in range(2):
            for j in range(cap.shape[1]):
                held.rate[j, ring] = (rolled[i + 1, j, ring] - rolled[i, j, ring]) / (t[i + 1] - t[i])
        for part in range(substeps):
            begin = t[i] + part * length
            stop = t[i + 1] if part == substeps - 1 else t[i] + (part + 1) * length
            if stop <= now:
                continue  # a discharge went on beyond this interval
            middle = (part + 0.5) / substeps
            _between(cap, i, middle, held.capacitance)
            _between(cond, i, middle, held.conductance)
            _between(film, i, middle, held.film)
            _closed(film, i, held.film)
            _between(thinnest, i, middle, held.thinnest)
            _between(area_of, i, middle, held.area)
            _between(rolled, i, part / substeps, held.rolled)
            known[:, :] = _NO_PATCH
            longest = _longest(held)
            before, held_at = _energy(n, q, v), v[L.ROTOR]
            assemble(insulated, machine, held.capacitance, held.conductance, c, g)
            if modes(n, c, g, work[3], work[4], s, decay) == 0:
                return L.NOT_POSITIVE
            _leaks(n, g, s, leaks)
            if began == 0 and rest_t.size > 1:
                periodic(n, decay, s, winding, rest_t, rest_v, y, drive, after, area, mean)
            else:
                amplitudes(n, s, q, y)
            voltages(n, s, y, v)
            volt = voltage_at(now, source_t, source_v, place)
            if began == 1:
                total[L.T_MOTION] += _energy(n, q, v) - before
                total[L.T_SOURCE] -= winding * volt * (v[L.ROTOR] - held_at)
            began = 1
            while now < stop:
                total[L.T_SEGMENTS] += 1.0
                slope, end = slope_at(now, source_t, source_v, place)
                volt = voltage_at(now, source_t, source_v, place)
                dt = min(min(stop, end) - now, longest)
                for a in range(n):
                    drive[a] = s[a, L.ROTOR] * winding * slope
                propagate(n, decay, y, drive, dt, after, area)
                voltages(n, s, after, v1)
                best, ball, raceway = first_breakdown(
                    shared, v, v1, held, now + dt - begin, roughness, least, break_law, break_par, break_out, seed,
                    known, drawn,
                )  # fmt: skip
                if best < 0.0:
                    total[L.T_STATUS] = -best - 1.0
                    return L.NO_VOLTAGE
                if total[L.T_SETTLING] == 1.0 and (best != 0.0 or rest_t.size < 2):
                    charges(n, c, v, q)
                    _open_books(n, winding, volt, now, q, v, total)
                    record(trace, total, window, now, volt, across_bearing(shared, v), 0.0)
                patch_time = now + dt - begin
                if best <= 1.0:
                    dt *= best
                    propagate(n, decay, y, drive, dt, after, area)
                    voltages(n, s, after, v1)
                total[L.T_OHMIC] += heat(n, decay, y, drive, dt)
                total[L.T_SOURCE] += source_work(n, winding, volt, slope, dt, v[L.ROTOR], v1[L.ROTOR], s, area)
                total[L.T_LEAK] += _dot(n, leaks, area)
                for a in range(n):
                    y[a], v[a] = after[a], v1[a]
                now += dt
                bearing = across_bearing(shared, v)
                if total[L.T_SETTLING] == 0.0:
                    extremes[i, 0], extremes[i, 1] = min(extremes[i, 0], bearing), max(extremes[i, 1], bearing)
                record(trace, total, window, now, volt + slope * dt, bearing, 0.0)
                if best > 1.0:
                    continue
                charges(n, c, v, q)
                for ring in range(2):
                    stand[ring] = math.inf
                    if held.film[ball, ring] > 0.0:
                        patch = _patch(held.rolled[ball, ring], held.rate[ball, ring], patch_time)
                        stand[ring] = threshold(
                            ball,
                            ring,
                            patch,
                            held,
                            roughness,
                            least,
                            break_law,
                            break_par,
                            break_out,
                            seed,
                            known,
                            drawn,
                        )
                        if stand[ring] < 0.0:
                            total[L.T_STATUS] = -stand[ring] - 1.0
                            return L.NO_VOLTAGE
                now, status = discharge(
                    now, ball, raceway, n, shared, c, g, q, v, stand, held, arc_law, arc_par, arc_out, machine,
                    source_t, source_v, place, work, vectors, rows, state, total, trace, window, begin, roughness,
                    least, break_law, break_par, break_out, seed, known, drawn,
                )  # fmt: skip
                if status != L.OK:
                    return status
                if total[L.T_SETTLING] == 0.0 and _store(events, total, rows, ball, float(i)) == 0:
                    return L.EVENTS_FULL
                amplitudes(n, s, q, y)
                voltages(n, s, y, v)
            charges(n, c, v, q)
    volt = voltage_at(now, source_t, source_v, place)
    total[L.T_STORED] = _energy(n, q, v) + winding * volt * (0.5 * volt - v[L.ROTOR])
    total[L.T_CHARGE], total[L.T_TIME] = _sum(n, q), now
    return L.OK

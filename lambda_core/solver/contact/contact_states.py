"""Pass states of contacts to laws and their rates back.

They stand behind the motion in the state vector: stepped, controlled and sampled with it. A law reads one behind its
parameters, where it is written before every call, so that laws without states know nothing of it. Rounding may carry
the number in the state vector past its bounds; laws never see that, and at a bound no rate points outwards.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.arrays.fault_roles import CONTACT_STATE
from lambda_core.solver.faults import report
from lambda_core.solver.layout import helper, part, raceway_laws


@helper
def first_state(raceway, j):
    """Return the first state of a contact.

    Its place is counted among those of all contacts, for ball j.
    """
    return raceway.first_state + j * raceway.states


@helper
def hand_states(raceway, j, bundle):
    """Write a contact's states for its laws.

    The contact is one of ball j; the laws of its raceway read the states.
    """
    first = first_state(raceway, j)
    for i in range(raceway.slots[0], raceway.slots[1]):
        slot = bundle.slots[i]
        bundle.par[slot.place] = min(max(bundle.states[first + slot.state], slot.lower), slot.upper)


@helper
def lost_in(losses, k):
    """Return the power lost in raceway k so far [W].

    It sums all balls.
    """
    return (
        losses.sliding[k] + losses.spin[k] + losses.boundary[k]
        + losses.rolling[k] + losses.hysteresis[k] + losses.damping[k]
    )  # fmt: skip


@helper
def _rates(t, raceway, kin, contact, power, law, par, out, n, fault):
    """Call the law of a contact.

    The contact is closed, or with `power` below zero open.
    """
    out[:n] = np.nan
    bulk = raceway.oil.temperature
    if power < 0.0:
        status = law(t, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, bulk, bulk, par, out)
    else:
        slide = math.sqrt(kin.slip_t**2 + kin.slip_s**2)
        status = law(
            t, contact.load, contact.semi_axis_a, contact.semi_axis_b, contact.max_pressure, contact.entrainment,
            slide, kin.rotation_n, contact.film_central, contact.film_parameter, contact.asperity_share, power,
            contact.film_temperature, bulk, par, out,
        )  # fmt: skip
    total = 0.0
    for s in range(n):
        total += abs(out[s])
    if status != 1 or not total < np.inf:
        load = contact.load if power >= 0.0 else 0.0
        return report(fault, CONTACT_STATE, status, raceway.number, t, load, max(power, 0.0), par[par.size - n])
    return 1


@helper
def _stop_at_bounds(raceway, par_end, n, bundle, out):
    """Set rates past a bound to zero.

    They would carry a state past the bound at which it is.
    """
    for i in range(raceway.slots[0], raceway.slots[1]):
        slot = bundle.slots[i]
        s = slot.place - (par_end - n)
        if 0 <= s < n:
            at = bundle.par[slot.place]
            if (out[s] < 0.0 and at <= slot.lower) or (out[s] > 0.0 and at >= slot.upper):
                out[s] = 0.0


@helper
def state_rates(t, raceway, j, power, bundle):
    """Write the rates of a contact's states.

    The slopes of the states are written with them; return 1 when well.

    Parameters
    ----------
    power : float
        That the contact dissipates [W]; below zero where it is open. Of a closed one scratch holds kinematics and
        scalars.
    """
    scratch, n, first = bundle.scratch[0], raceway.states, first_state(raceway, j)
    kin, contact, out, fault = scratch.kinematics[0], scratch.contact[0], scratch.out[:], scratch.fault
    law = raceway_laws(bundle.laws.raceways, raceway.laws).contact_state
    par = part(bundle.par, raceway.parameters.contact_state)
    if _rates(t, raceway, kin, contact, power, law, par, out, n, fault) != 1:
        fault.ball = j
        return 0
    end = raceway.parameters.contact_state[1]
    _stop_at_bounds(raceway, end, n, bundle, out)
    for s in range(n):
        bundle.state_rates[first + s] = out[s]
    for c in range(n):
        place, step = par.size - n + c, bundle.state_steps[first + c]
        here = par[place]
        par[place] += step
        ok = _rates(t, raceway, kin, contact, power, law, par, out, n, fault)
        _stop_at_bounds(raceway, end, n, bundle, out)
        par[place] = here
        if ok != 1:
            fault.ball = j
            return 0
        for s in range(n):
            bundle.state_slopes[first + s, c] = (out[s] - bundle.state_rates[first + s]) / step
    return 1

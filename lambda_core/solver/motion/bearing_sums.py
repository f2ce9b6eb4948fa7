"""Sum forces and powers of each bearing.

A bypassed bearing keeps its last sums.

The balls of a bearing touch bodies that those of no other one touch (records.BODY.bearing), so that what its contacts
do to them is known by the body.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import MECHANISMS
from lambda_core.solver.layout import helper
from lambda_core.solver.vec import clear

AGAIN = 3  # of `want` in forces.evaluate


@helper
def is_bypassed(bearing, bundle, want):
    """Return whether forces and powers of a bearing stand."""
    return want == AGAIN and bundle.bypassed[bearing] == 1


@helper
def _copy(wrench, other):
    for i in range(3):
        wrench.force[i], wrench.moment[i] = other.force[i], other.moment[i]


@helper
def keep_contacts(bundle):
    """Keep the contacts' forces on bodies.

    They are kept only where there are several bearings.
    """
    if bundle.bypassed.size > 1:
        for b in range(bundle.bodies.size):
            _copy(bundle.contact_wrenches[b], bundle.body_wrenches[b])


@helper
def clear_again(bundle, rates):
    """Clear the sums of forces and powers.

    They are the sums of raceway powers; bearings that rest keep theirs.
    """
    raceways = bundle.raceways.size
    for b in range(bundle.bodies.size):
        bearing = bundle.bodies[b].bearing
        if bearing >= 0 and bundle.bypassed[bearing] == 1:
            _copy(bundle.body_wrenches[b], bundle.contact_wrenches[b])
        else:
            clear(bundle.body_wrenches[b])
    for r in range(bundle.rows.size):
        row = bundle.rows[r]
        if bundle.bypassed[row.bearing] == 1:
            continue
        for j in range(row.first_ball, row.first_ball + row.balls):
            clear(bundle.ball_wrenches[j])
        for k in range(row.first_raceway, row.first_raceway + row.raceways):
            for m in range(MECHANISMS):
                rates[m * raceways + k] = 0.0
    for i in range(MECHANISMS * raceways, rates.size):
        rates[i] = 0.0
    for b in range(bundle.bypassed.size):
        if bundle.bypassed[b] == 0:
            _clear_powers(bundle.bearing_powers[b])


@helper
def _clear_powers(own):
    own.pocket, own.land, own.drag, own.input = 0.0, 0.0, 0.0, 0.0


@helper
def clear_bearing_powers(bundle):
    """Begin the sums of powers of all bearings."""
    for b in range(bundle.bearing_powers.size):
        _clear_powers(bundle.bearing_powers[b])


@helper
def powers_of_bearing(bundle, bearing, running):
    """Return the place of a bearing's powers.

    A bearing that is alone sums to the powers of all.
    """
    return running if bundle.bypassed.size == 1 else bundle.bearing_powers[bearing]


@helper
def add_bearing_powers(bundle, running):
    """Add the powers of several bearings to those of all."""
    if bundle.bypassed.size == 1:
        return
    for b in range(bundle.bearing_powers.size):
        own = bundle.bearing_powers[b]
        running.pocket += own.pocket
        running.land += own.land
        running.drag += own.drag
        running.input += own.input

"""What a sample shows beyond the state: contact channels, energies. Off the hot path."""

from __future__ import annotations

import numpy as np

from lambda_core.physics.compiled.cage import guide_force, land_state, pocket_apply, pocket_state
from lambda_core.physics.compiled.electric import bulk_permittivity, contact_capacitance, gap_capacitance
from lambda_core.physics.compiled.elements import add_contact, clear_forces
from lambda_core.physics.compiled.energy import stored_energy
from lambda_core.physics.compiled.kinematics import axis_x, contact_angle, contact_kinematics, surface_lift
from lambda_core.physics.compiled.layout import (
    BODY_FM,
    C_A,
    C_B,
    C_DAMP,
    C_HCEN,
    C_HMIN,
    C_LAMBDA,
    C_LOAD,
    C_PMAX,
    C_PSI,
    C_TMEAN,
    CAGE,
    FAULT,
    GUIDE,
    INNER,
    KIN,
    NB,
    NL,
    NS,
    OUT,
    OUTER,
    P_LAND,
    P_POCKET,
    Q_UT,
    Q_VT,
    Q_WN,
    SAY,
    SAZ,
    SCALARS,
    SHARED,
    WRENCH,
    array1,
    array2,
    array3,
    array4,
    bundle_t,
    f8,
    helper,
    i8,
    par_of,
)
from lambda_core.physics.compiled.losses import raceway_losses
from lambda_core.physics.compiled.memory import evaluate_t
from lambda_core.physics.compiled.timefunctions import fill_shared

# Contact channels, in this order along the last axis of `contacts`.
CONTACT_CHANNELS = (
    "load",
    "contact_angle",
    "max_pressure",
    "semi_axis_a",
    "semi_axis_b",
    "film_central",
    "film_minimum",
    "film_parameter",
    "asperity_share",
    "film_temperature",
    "slip",
    "entrainment",
    "spin_velocity",
    "capacitance_hertz",
    "capacitance",
    "contact_loss",
)
observe_sig = i8(array1, array2, bundle_t, evaluate_t, f8, array4, array3, array3, array2, array2, array2, array1)


@helper
def _raceway_channels(y, j, which, bundle, shorted, channels, losses, rates):
    """Write the channels of one contact; zeros and the gap's capacitance when it is open.

    Adds its forces to those of ball and ring and its losses to `rates`, as the right-hand side does.
    """
    scratch = bundle.scratch
    system = bundle.system[0]
    laws = bundle.laws.inner if which == INNER else bundle.laws.outer
    par = bundle.par
    ball = y[NB * j : NB * j + NB]
    ring = scratch[SHARED][NS * which : NS * which + NS]
    channels[:] = 0.0
    kin = scratch[KIN]
    if system.surfaces == 1:
        surface_lift(ball, ring, which, bundle, kin)
    delta = contact_kinematics(ball, ring, which, system, kin)
    if not delta < np.inf:
        return 0
    channels[1] = contact_angle(kin, which)
    channels[9] = system.oil_temperature
    if delta <= 0.0:
        channels[14] = bulk_permittivity(which, laws, bundle) * gap_capacitance(system, which, -delta)
        return 1
    scalars = scratch[SCALARS]
    ok = bundle.wrench(
        which, kin, laws, par, bundle.system, bundle.grid, bundle.cells[0], scratch, scalars,
        scratch[WRENCH],
    )  # fmt: skip
    if ok != 1:
        return 0
    losses[:] = 0.0
    raceway_losses(which, kin, system, bundle.grid, scalars, bundle.cells[0], losses)
    channels[0] = scalars[C_LOAD] + scalars[C_DAMP]
    channels[2], channels[3], channels[4] = scalars[C_PMAX], scalars[C_A], scalars[C_B]
    channels[5], channels[6], channels[7] = (scalars[C_HCEN], scalars[C_HMIN], scalars[C_LAMBDA])
    channels[8], channels[9] = scalars[C_PSI], scalars[C_TMEAN]
    channels[10], channels[11], channels[12] = kin[Q_VT], kin[Q_UT], kin[Q_WN]
    add_contact(which, bundle.ball_fm[j], scratch)
    for i in range(NL):
        channels[15] += losses[i]
        rates[i] += losses[i]
    return contact_capacitance(which, kin, laws, bundle, shorted, channels)


@helper
def _cage_channels(y, bundle, pockets, lands):
    """Write the forces of the pockets on the balls and of the lands on the cage."""
    scratch, system = bundle.scratch, bundle.system[0]
    g, out, fault, eta0 = scratch[GUIDE], scratch[OUT], scratch[FAULT], system.eta0
    cage = scratch[SHARED][NS * CAGE : NS * CAGE + NS]
    law, par = bundle.laws.pocket, par_of(bundle.par, system, P_POCKET)
    for j in range(system.balls):
        ball = y[NB * j : NB * j + NB]
        pocket_state(ball, cage, j, system, g)
        if guide_force(law, par, g, eta0, out, fault, -1.0) != 1:
            return 0
        bundle.ball_fm[:, :] = 0.0
        pocket_apply(ball, cage, g, out, bundle.ball_fm[0], scratch[BODY_FM + CAGE])
        for k in range(3):
            pockets[j, k] = bundle.ball_fm[0, k]
    for which in range(2):
        if system.land_on[which] == 0:
            continue
        law = bundle.laws.land_inner if which == INNER else bundle.laws.land_outer
        par = par_of(bundle.par, system, P_LAND + which)
        ring = scratch[SHARED][NS * which : NS * which + NS]
        for side in range(2):
            land_state(cage, ring, (2 * side - 1) * system.land_offset, g)
            if guide_force(law, par, g, eta0, out, fault, which) != 1:
                return 0
            for axis in range(3):
                for k in range(3):
                    lands[which, axis] += out[k] * g[9 + 3 * k + axis]
    return 1


@helper
def _observe_one(t, y, bundle, shorted, contacts, pockets, lands, extra, rates):
    """Write what one sample shows; see observe."""
    scratch = bundle.scratch
    system = bundle.system[0]
    scratch[FAULT][0] = -1.0
    extra[0] = stored_energy(t, y, bundle)
    fill_shared(t, y, bundle)
    pockets[:, :] = 0.0
    lands[:, :] = 0.0
    if system.cage_on == 1 and _cage_channels(y, bundle, pockets, lands) != 1:
        return 0
    clear_forces(bundle)
    rates[:] = 0.0
    total = 0.0
    for j in range(system.balls):
        for which in range(2):
            if _raceway_channels(y, j, which, bundle, shorted, contacts[j, which], extra[2:], rates) != 1:
                scratch[FAULT][2] = j
                return 0
        ci, co = contacts[j, INNER, 14], contacts[j, OUTER, 14]
        total += 1.0 / (1.0 / ci + 1.0 / co) if ci > 0.0 and co > 0.0 else 0.0
    extra[1] = total
    return 1


def observe(times, states, bundle, evaluate, shorted, contacts, pockets, lands, extra, shared, rates, dydt):
    """Write what samples show; an entry point.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (at least n, 9 Z + n_active)
    evaluate : pointer
        The right-hand side.
    shorted : float
        Asperity share above which a contact counts as touching metal; below zero the stored energy alone is written.
    contacts : float64[:, :, :, :], shape (n, Z, 2, 16)
        CONTACT_CHANNELS.
    pockets : float64[:, :, :], shape (n, Z, 3)
        Force of the cage on each ball, axes x, r, t [N].
    lands : float64[:, :, :], shape (n, 2, 3)
        Force of each ring's land on the cage, inertial [N].
    extra : float64[:, :], shape (n, NI + 2)
        [:, 0] stored energy [J]; [:, 1] capacitance of the bearing [F]; [:, 2] torque that balances the contacts of the
        inner ring about its axis [N m]; the rest is scratch.
    shared : float64[:, :], shape (n, 36)
        The whole shared state.
    rates : float64[:, :], shape (n, NI)
        Losses [W] and the rates of the other running integrals.
    dydt : float64[:], shape (9 Z + n_active,)
        Workspace.

    Returns
    -------
    int
        1 when every kernel was well; otherwise 0 and scratch[FAULT] says which was not.
    """
    for i in range(times.size):
        y = states[i]
        if shorted < 0.0:
            extra[i, 0] = stored_energy(times[i], y, bundle)
            continue
        if _observe_one(times[i], y, bundle, shorted, contacts[i], pockets[i], lands[i], extra[i], rates[i]) != 1:
            return 0
        if evaluate(times[i], y, bundle, dydt, rates[i], 2) != 1:
            return 0
        for k in range(3 * NS):
            shared[i, k] = bundle.scratch[SHARED, k]
        ay, az = shared[i, SAY], shared[i, SAZ]
        m = bundle.scratch[BODY_FM + INNER]
        extra[i, 2] = -(m[3] * axis_x(ay, az) + m[4] * ay + m[5] * az)
    return 1

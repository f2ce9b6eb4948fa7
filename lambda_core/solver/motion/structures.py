"""Compute forces of elastic structures between bodies.

They have one matrix of stiffness and one of damping.

Forces are -K (u - u_0) - C du/dt of positions, components of axes and angles about them, with the potential
(u - u_0).K (u - u_0)/2: small deflections of linear bodies. A force along a component of a body's axis is a moment on
the body, one along its angle a moment about its axis.
"""

from __future__ import annotations

from lambda_core.solver.arrays.bundle import NS, SAY, SAZ, SSIGMA, SVX, SWY, SWZ
from lambda_core.solver.contact.contact_kinematics import axis_x
from lambda_core.solver.layout import helper
from lambda_core.solver.lu import inner_product


@helper
def _measure(bundle):
    """Write the structures' displacements.

    They are measured from where they are without force.
    """
    for k in range(bundle.tied.size):
        bundle.tie_moves[k] = bundle.shared[bundle.tied[k]] - bundle.tie_rest[k]


@helper
def _rate(entry, bundle):
    """Return the rate of a tied entry.

    An axis changes by w x a, an angle by the spin.
    """
    now, c = bundle.bodies_now[entry // NS], entry % NS
    if c < SAY:
        return now.velocity[c]
    ay, az, wy, wz = now.tilt[0], now.tilt[1], now.tilt_velocity[0], now.tilt_velocity[1]
    ax = axis_x(ay, az)
    wx = -(wy * ay + wz * az) / ax
    return wz * ax - wx * az if c == SAY else (wx * ay - wy * ax if c == SAZ else now.spin)


@helper
def _measure_rates(bundle):
    """Write how fast they change."""
    for k in range(bundle.tie_damping.shape[1]):
        bundle.tie_rates[k] = _rate(bundle.tied[k], bundle)


@helper
def structure_forces(bundle, running):
    """Add all structures' forces.

    They act on the bodies; their dampers add power to the losses.

    The power of a force f along the axis a of a body is f.da/dt = (a x f).omega.
    """
    n = bundle.tied.size
    _measure(bundle)
    _measure_rates(bundle)
    for i in range(n):
        b, c = bundle.tied[i] // NS, bundle.tied[i] % NS
        wrench, force = bundle.body_wrenches[b], -inner_product(bundle.tie_stiffness[i], bundle.tie_moves, n)
        if bundle.tie_damping.size > 0:
            resist = inner_product(bundle.tie_damping[i], bundle.tie_rates, n)
            running.support += resist * bundle.tie_rates[i]
            force -= resist
        if c < SAY:
            wrench.force[c] += force
            continue
        ay, az = bundle.bodies_now[b].tilt[0], bundle.bodies_now[b].tilt[1]
        ax = axis_x(ay, az)
        if c == SAY:
            wrench.moment[0] -= az * force
            wrench.moment[2] += ax * force
        elif c == SAZ:
            wrench.moment[0] += ay * force
            wrench.moment[1] -= ax * force
        else:
            wrench.moment[0] += ax * force
            wrench.moment[1] += ay * force
            wrench.moment[2] += az * force


@helper
def structure_columns(bundle, bl):
    """Add the slopes of structures' forces.

    They are of first order in small tilts.
    """
    for i in range(bundle.tied.size):
        b, c = bundle.tied[i] // NS, bundle.tied[i] % NS
        row, sign = (c, 1.0) if c < SAY else ((5, 1.0) if c == SAY else ((4, -1.0) if c == SAZ else (3, 1.0)))
        for k in range(bundle.tied.size):
            bl.shared[b, row, bundle.tied[k]] -= sign * bundle.tie_stiffness[i, k]
        for k in range(bundle.tie_damping.shape[1]):
            e = bundle.tied[k] % NS
            rate = SVX + e if e < SAY else (SWZ if e == SAY else (SWY if e == SAZ else SSIGMA))
            turned = -1.0 if e == SAZ else 1.0  # the axis leans towards -z where it turns about y
            bl.shared[b, row, bundle.tied[k] - e + rate] -= sign * turned * bundle.tie_damping[i, k]


@helper
def structure_energy(bundle):
    """Return the elastic energy of all structures [J]."""
    energy, n = 0.0, bundle.tied.size
    _measure(bundle)
    for i in range(n):
        energy += 0.5 * inner_product(bundle.tie_stiffness[i], bundle.tie_moves, n) * bundle.tie_moves[i]
    return energy

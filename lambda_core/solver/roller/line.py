"""Compute the line contact of a roller.

Loads of slices, then the stages of a point contact with slices as cells.

Slice k, at x_k along the contact, approaches by delta + x_k tilt - drop_k and carries the load that the normal law has
for it; films follow from the load spread evenly over the length that carries, rolling resistance from that of every
slice. Loads are those of the contact. Every slice is a cell whose slip is that at its middle, so that skew, spin and
the taper's sliding are integrated along the line.
"""

from __future__ import annotations

import math

import numpy as np

from lambda_core.elements.roller.rolling import FLOW_SHEAR
from lambda_core.laws.jit.binding import STRIDE
from lambda_core.solver.arrays.fault_roles import NORMAL_CONTACT
from lambda_core.solver.cage.guides import GAUSS_NODES, GAUSS_WEIGHTS
from lambda_core.solver.contact.dissipation import raceway_losses
from lambda_core.solver.contact.resultant import sum_wrench
from lambda_core.solver.contact.scalar_stages import film_stage, line_damping, rolling_forces
from lambda_core.solver.contact.shear import shear_stage, slip_field
from lambda_core.solver.faults import report
from lambda_core.solver.layout import cells_of, grid_of, helper, of, part, raceway_laws
from lambda_core.solver.records import BATCH, PLACES
from lambda_core.solver.vec import clear

PLACE, WIDTH, DROP, RADIUS = range(4)  # rows of Bundle.lines
ACROSS, ALONG, PRESSURE, AREA, WIDTH_ACROSS, WIDTH_ALONG, LOAD = range(7)  # rows of Bundle.slices: a Grid, and loads
_MEAN = 0.25 * math.pi  # mean over the maximum of Hertz's pressure across a line


@helper
def closest(raceway, kin, bundle):
    """Return the nearest slice's approach [m].

    The approach is to the raceway.
    """
    line, found = bundle.lines[raceway.line], -np.inf
    for k in range(line.shape[1]):
        found = max(found, kin.penetration + line[PLACE, k] * kin.line_tilt - line[DROP, k])
    return found


@helper
def _slice_loads(raceway, kin, law, bundle, contact, fault):
    """Write load, width and pressure of slices.

    Every slice has them; return the loads' moment about t [N m], NaN on a fault.

    `contact` takes the load of all, the largest half width and pressure.
    """
    line, slices, scratch = bundle.lines[raceway.line], bundle.slices, bundle.scratch[0]
    out, one = scratch.out[:], of(scratch.lanes.delta, 0, 1)
    par = part(bundle.par, raceway.parameters.normal_contact)
    total, moment, widest, highest, half = 0.0, 0.0, 0.0, 0.0, 0.5 * raceway.radius_y
    for k in range(line.shape[1]):
        x, width = line[PLACE, k], line[WIDTH, k]
        delta = kin.penetration + x * kin.line_tilt - line[DROP, k]
        load, b, p = 0.0, 0.0, 0.0
        if delta > 0.0:
            out[:4], one[0] = np.nan, delta
            status = law(one, line[RADIUS, k], raceway.radius_y, raceway.modulus, par, of(out, 0, STRIDE))
            if status != 1 or not abs(out[0]) + abs(out[2]) + abs(out[3]) < np.inf:
                report(
                    fault, NORMAL_CONTACT, status, raceway.number, delta, line[RADIUS, k], raceway.radius_y,
                    raceway.modulus,
                )  # fmt: skip
                return np.nan
            load, b, p = out[0] * width / raceway.radius_y, out[2], out[3]
        slices[ACROSS, k], slices[ALONG, k], slices[LOAD, k] = x / half, 0.0, load
        slices[PRESSURE, k], slices[AREA, k] = _MEAN * p, 2.0 * b * width
        slices[WIDTH_ACROSS, k], slices[WIDTH_ALONG, k] = width / half, 2.0 * b
        total += load
        moment -= x * load
        widest, highest = max(widest, b), max(highest, p)
    contact.load, contact.max_pressure = total, highest
    contact.semi_axis_a, contact.semi_axis_b = half, widest
    return moment


@helper
def _scale_slices(contact, slices):
    """Scale slices to the contact.

    Divide areas, pressures and widths by those of the contact, as in a Grid; return the sum of the areas.
    """
    total, area = 0.0, 1.0 / (contact.semi_axis_a * contact.semi_axis_b)
    for k in range(slices.shape[1]):
        slices[AREA, k] *= area
        slices[PRESSURE, k] /= contact.max_pressure
        slices[WIDTH_ALONG, k] /= contact.semi_axis_b
        total += slices[AREA, k]
    return total


@helper
def _carrying_length(contact, slices):
    """Return the carrying length of a load [m].

    A spread load has on it the same integral of the root of its load per length.

    Of profiled rollers under light load a part of the line.
    """
    roots = 0.0
    for k in range(slices.shape[1]):
        roots += math.sqrt(slices[LOAD, k] * slices[WIDTH_ACROSS, k] * contact.semi_axis_a)
    return roots * roots / contact.load


@helper
def _mean_half_width(contact, slices):
    """Return the half width that the mean newton has [m].

    Losses in the solids are load times half width, slice by slice; those of the widest slice would be too large.
    """
    moment = 0.0
    for k in range(slices.shape[1]):
        moment += slices[LOAD, k] * slices[WIDTH_ALONG, k]
    return 0.5 * contact.semi_axis_b * moment / contact.load


@helper
def _rolling_force(raceway, place, contact, laws, par, slices, scratch):
    """Multiply the rolling force by that of slices.

    It hardly depends on the load of a slice, so that it is no matter of a mean load; return 0 on a fault.
    """
    lanes, count, k, total = scratch.lanes, slices.shape[1], 0, 0.0
    while k < count:
        n = 0
        for i in range(BATCH, PLACES):
            lanes.load[i] = 0.0
        while k < count and n < BATCH:
            if slices[LOAD, k] > 0.0:
                i = BATCH + n
                lanes.u_mean[i], lanes.load[i] = lanes.u_mean[place], slices[LOAD, k] * count
                lanes.semi_a[i] = contact.semi_axis_a
                lanes.semi_b[i] = 0.5 * contact.semi_axis_b * slices[WIDTH_ALONG, k]
                n += 1
            k += 1
        for i in range(BATCH + n, PLACES):
            lanes.u_mean[i], lanes.semi_a[i], lanes.semi_b[i] = lanes.u_mean[place], contact.semi_axis_a, 0.0
        if n > 0 and rolling_forces(raceway, BATCH, BATCH if 2 * n > BATCH else BATCH // 2, laws, par, scratch) != 1:
            return 0
        for i in range(n):
            total += scratch.out[STRIDE * i]
    contact.rolling_force *= total / count
    return 1


@helper
def _films(raceway, place, length, width, laws, par, scratch):
    """Run the scalar laws of a line.

    The carrying length serves R_y, the mean half width the semi-axis along rolling; return 0 on a fault.
    """
    contact = scratch.contact[place]
    full, widest = raceway.radius_y, contact.semi_axis_b
    raceway.radius_y, contact.semi_axis_b = length, width
    status = film_stage(raceway, place, 1, laws, par, scratch)
    raceway.radius_y, contact.semi_axis_b = full, widest
    return status


@helper
def _shear_around(raceway, length, contact):
    """Return the oil's force per slip [N s/m].

    It holds before and behind the flat; see rolling.flow_shear.
    """
    return FLOW_SHEAR * raceway.oil.viscosity * length * math.sqrt(raceway.radius_x / contact.film_central)


@helper
def _resist(kin, per_slip, wrench):
    """Add the oil's shear around the flat.

    It acts against the slip at the middle of the line.
    """
    wrench.force[0] -= per_slip * kin.slip_t
    wrench.force[1] -= per_slip * kin.slip_s


@helper
def _lean_on(kin, moment, wrench):
    """Add the slice loads' moment.

    It works on the tilt of the line alone, not on what spins.

    Pressure on a body of revolution does not turn it. On a skewed roller the moment acts along own axis x normal, and a
    force couple of the tangential force F rho = M skew, on roller and ring at the roller's centre, keeps the ring's
    spin free of it: together they are the slope of the contacts' energy. The same couple makes the moment of shear
    about the normal work on the slip that kinematics._write gives a tilted roller.
    """
    skew, reach = kin.line_skew, kin.reach
    rho = math.sqrt(kin.arm[1] * kin.arm[1] + kin.arm[2] * kin.arm[2]) - reach * kin.outward
    turning = moment * skew + kin.line_tilt * wrench.moment[2]
    force = kin.outward * turning / rho
    wrench.force[0] += force
    wrench.moment[0] += moment
    wrench.moment[1] -= turning + reach * force


@helper
def line_wrench(raceway, place, bundle):
    """Write the line contact's wrench.

    It is at a place of scratch. It acts on the roller, about its middle, in axes t, s, n.

    Returns 1 when every kernel was well; otherwise 0 and scratch.fault says which was not.
    """
    scratch, system, par, slices = bundle.scratch[0], bundle.system[0], bundle.par, bundle.slices
    kin, contact, wrench = scratch.kinematics[place], scratch.contact[place], scratch.wrench[place]
    laws = raceway_laws(bundle.laws.raceways, raceway.laws)
    contact.wet, contact.damping_force = 0, 0.0
    moment = _slice_loads(raceway, kin, laws.normal_contact, bundle, contact, scratch.fault)
    if not abs(moment) < np.inf:
        return 0
    if system.guides_on == 1 and line_damping(raceway, place, laws, par, scratch) != 1:
        return 0
    if system.friction_on == 0 or contact.load <= 0.0:
        clear(wrench)
        wrench.force[2] = -(contact.load + contact.damping_force)
        _lean_on(kin, moment, wrench)
        return 1
    area = _scale_slices(contact, slices)
    length = _carrying_length(contact, slices)
    if _films(raceway, place, length, _mean_half_width(contact, slices), laws, par, scratch) != 1:
        return 0
    if _rolling_force(raceway, place, contact, laws, par, slices, scratch) != 1:
        return 0
    grid, cells = grid_of(slices), cells_of(bundle.line_cells, 0, 1, slices.shape[1])
    slip_field(raceway, kin, system, grid, contact, cells)
    if shear_stage(raceway, place, 1, laws, par, grid, bundle.line_cells, scratch) != 1:
        return 0
    contact.film_temperature *= math.pi / area
    sum_wrench(raceway, kin, system, grid, contact, cells, wrench)
    contact.shear_around = _shear_around(raceway, length, contact)
    _resist(kin, contact.shear_around, wrench)
    _lean_on(kin, moment, wrench)
    return 1


@helper
def line_losses(raceway, bundle, losses):
    """Add the power that the contact dissipates.

    The contact is in scratch; to layout.Losses [W]; call after line_wrench.
    """
    scratch = bundle.scratch[0]
    kin, contact = scratch.kinematics[0], scratch.contact[0]
    raceway_losses(
        raceway, kin, bundle.system[0], grid_of(bundle.slices), contact,
        cells_of(bundle.line_cells, 0, 1, bundle.slices.shape[1]), losses,
    )  # fmt: skip
    if contact.wet == 1:
        losses.sliding[raceway.number] += contact.shear_around * (kin.slip_t * kin.slip_t + kin.slip_s * kin.slip_s)


@helper
def line_energy(raceway, kin, bundle):
    """Return a line contact's elastic energy [J].

    The work of its slices' loads as they close.
    """
    line, scratch, n, total = bundle.lines[raceway.line], bundle.scratch[0], GAUSS_NODES.size, 0.0
    out, lane = scratch.out[:], of(scratch.lanes.delta, 0, n)
    law = raceway_laws(bundle.laws.raceways, raceway.laws).normal_contact
    par = part(bundle.par, raceway.parameters.normal_contact)
    for k in range(line.shape[1]):
        delta = kin.penetration + line[PLACE, k] * kin.line_tilt - line[DROP, k]
        if delta <= 0.0:
            continue
        share = line[WIDTH, k] / raceway.radius_y
        for i in range(n):
            lane[i] = delta * GAUSS_NODES[i]
        law(lane, line[RADIUS, k], raceway.radius_y, raceway.modulus, par, of(out, 0, STRIDE * n))
        for i in range(n):
            total += GAUSS_WEIGHTS[i] * delta * out[STRIDE * i] * share
    return total

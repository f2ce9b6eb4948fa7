"""Differentiate a raceway wrench by its kinematics.

Shear along the slip costs one extra evaluation of the cells for all five slip kinematics together, penetration and
entrainment one each; laws are called once for all of them. Kernels are elementwise, so a plugin needs no derivative of
its own.
"""

from __future__ import annotations

from lambda_core.solver.contact.raceway import ENLARGED, pipeline
from lambda_core.solver.contact.resultant import rolling_speeds
from lambda_core.solver.contact.shear import CELL_VARIANCE
from lambda_core.solver.layout import cells_of, grid_of, helper, vector_helper
from lambda_core.solver.records import SWEEPS
from lambda_core.solver.vec import clear, store


@vector_helper
def _slip_column(a, b, curvature, along, across, spread, grid, cells, tau2, step, column):
    """Write d(wrench)/d(one slip kinematic) from the cells' tangent moduli.

    The slip along rolling changes by along[0] + along[1] s + along[2] z, across by across[0] + across[1] t +
    across[2] z, half its squared spread inside a cell as `spread` says: powers of s/R over the cell's width across,
    then the share of its width along.
    """
    tau, inverse, vt, vs = cells.shear, cells.inverse_slip, cells.slip_t, cells.slip_s
    grid_s, grid_t, grid_area = grid.across, grid.along, grid.area
    grid_ds, grid_dt = grid.width_across, grid.width_along
    t0, t1, t2 = along
    s0, s1, s2 = across
    p0, p1, p2, p3 = spread
    width_s, width_t = CELL_VARIANCE * a * a, CELL_VARIANCE * b * b
    sum_t, sum_s, sum_mt, sum_ms, sum_mn = 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(tau.size):
        s, t = a * grid_s[i], b * grid_t[i]
        kink = s * curvature
        z = 0.5 * s * kink
        dvt, dvs = t0 + t1 * s + t2 * z, s0 + s1 * t + s2 * z
        rise = width_s * grid_ds[i] * grid_ds[i] * (p0 + kink * (p1 + kink * p2))
        rise += width_t * grid_dt[i] * grid_dt[i] * p3
        g = tau[i] * inverse[i]
        dg = ((tau2[i] - tau[i]) / step - tau[i]) * inverse[i] * inverse[i] * inverse[i]
        dg *= vt[i] * dvt + vs[i] * dvs + rise
        ft = -grid_area[i] * (dg * vt[i] + g * dvt)
        fs = -grid_area[i] * (dg * vs[i] + g * dvs)
        sum_t += ft
        sum_s += fs
        sum_ms -= z * ft
        sum_mt += z * fs
        sum_mn += t * fs - s * ft
    ab = a * b
    column.force[0], column.force[1] = ab * sum_t, ab * sum_s
    column.moment[0], column.moment[1], column.moment[2] = ab * sum_mt, ab * sum_ms, ab * sum_mn


@helper
def _slip_columns(raceway, kin, grid, contact, cells, tau2, step, slope):
    """Write d(wrench)/d(slip, relative rotation).

    They come from the shear at slightly larger slip.
    """
    a, b = contact.semi_axis_a, contact.semi_axis_b
    c = 1.0 / raceway.radius_deformed
    wt, ws, wn = kin.rotation_t, kin.rotation_s, kin.rotation_n
    none, still = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    _slip_column(a, b, c, (1.0, 0.0, 0.0), none, still, grid, cells, tau2, step, slope.slip_t)
    _slip_column(a, b, c, none, (1.0, 0.0, 0.0), still, grid, cells, tau2, step, slope.slip_s)
    _slip_column(a, b, c, none, (0.0, 0.0, 1.0), (0.0, 0.0, wt, 0.0), grid, cells, tau2, step, slope.rotation_t)
    _slip_column(a, b, c, (0.0, 0.0, -1.0), none, (0.0, wn, ws, 0.0), grid, cells, tau2, step, slope.rotation_s)
    turn = (wn, ws, 0.0, wn)
    _slip_column(a, b, c, (0.0, -1.0, 0.0), (0.0, 1.0, 0.0), turn, grid, cells, tau2, step, slope.rotation_n)


@helper
def _rolling_columns(raceway, kin, system, contact, slope):
    """Add the derivative of rolling directions.

    It concerns rolling resistance and hysteresis.
    """
    rx = raceway.radius_x
    roll, bend = rolling_speeds(raceway, kin)
    f2 = system.roll_floor * system.roll_floor
    droll = contact.rolling_force * f2 / (roll * roll + f2) ** 1.5
    dbend = contact.hysteresis_moment * f2 / (bend * bend + f2) ** 1.5
    lever = 2.0 * rx / raceway.ball_radius - 1.0
    by_slip = -(rx / raceway.ball_radius - 0.5)
    slope.slip_t.force[0] += droll * by_slip * lever
    slope.rotation_s.force[0] += droll * rx * lever
    slope.slip_t.moment[1] -= 2.0 * rx * droll * by_slip
    slope.rotation_s.moment[1] -= 2.0 * rx * droll * rx + dbend * rx


@helper
def _quotient(changed, base, step, column):
    """Write the difference of two wrenches over a step."""
    for i in range(3):
        column.force[i] = (changed.force[i] - base.force[i]) / step
        column.moment[i] = (changed.moment[i] - base.moment[i]) / step


@helper
def _change_velocity(kin):
    """Enlarge the normal velocity; returns the step."""
    step = 1e-4 * abs(kin.normal_velocity) + 1e-6
    kin.normal_velocity += step
    return step


@helper
def _deepen(kin):
    """Enlarge the penetration; returns the step."""
    step = ENLARGED * abs(kin.penetration) + 1e-13
    kin.penetration += step
    return step


@helper
def _rolls_along(kin):
    """Tell whether entrainment is along rolling.

    It is across where a ball at rest is pushed sideways.
    """
    return abs(kin.entrainment_t) >= abs(kin.entrainment_s)


@helper
def _hasten(kin):
    """Enlarge the larger component of entrainment; returns the step."""
    along = _rolls_along(kin)
    entrainment = kin.entrainment_t if along else kin.entrainment_s
    step = (ENLARGED * abs(entrainment) + 1e-8) * (1.0 if entrainment >= 0.0 else -1.0)
    if along:
        kin.entrainment_t += step
    else:
        kin.entrainment_s += step
    return step


@helper
def _clear_all(slope):
    """Set every derivative to zero."""
    clear(slope.penetration)
    clear(slope.normal_velocity)
    clear(slope.slip_t)
    clear(slope.slip_s)
    clear(slope.rotation_t)
    clear(slope.rotation_s)
    clear(slope.rotation_n)
    clear(slope.entrainment_t)
    clear(slope.entrainment_s)


def contact_tangent(raceway, laws, par, system, grid_table, block, scratch, slope):
    """Write d(wrench)/d(kinematics) and the wrench.

    It writes a TANGENT. It is a separate entry point, called by pointer.

    Runs the pipeline of the contact at place 0 of scratch and of the same contact at neighbouring kinematics together:
    with a larger penetration, a larger entrainment, and a larger normal velocity and slip.

    Left out: the effect of slip on the thermal film factor and of the smaller component of entrainment, both
    small; the integrator's Newton iteration only needs the slope, not its last digit.
    """
    kin, base = scratch.kinematics[0], scratch.wrench[0]
    for k in range(1, SWEEPS):
        scratch.kinematics[k] = scratch.kinematics[0]
    deeper, faster = _deepen(scratch.kinematics[1]), _hasten(scratch.kinematics[2])
    sooner = _change_velocity(scratch.kinematics[3])
    if pipeline(raceway, 0, SWEEPS, 1, laws, par, system, grid_table, block, scratch) != 1:
        return 0
    _clear_all(slope)
    contact = scratch.contact[0]
    if system.guides_on == 1:
        slope.normal_velocity.force[2] = (contact.damping_force - scratch.contact[3].damping_force) / sooner
    _quotient(scratch.wrench[1], base, deeper, slope.penetration)
    if contact.wet == 0:
        return 1
    if _rolls_along(kin):
        _quotient(scratch.wrench[2], base, faster, slope.entrainment_t)
    else:
        _quotient(scratch.wrench[2], base, faster, slope.entrainment_s)
    grid, width = grid_of(grid_table), grid_table.shape[1]
    cells, larger = cells_of(block, 0, 1, width), cells_of(block, SWEEPS - 1, 1, width)
    _slip_columns(raceway, kin, grid, contact, cells, larger.shear, ENLARGED, slope)
    _rolling_columns(raceway, kin, system, contact, slope)
    return 1


@helper
def _add_slope(wrench, column, amount):
    """Add amount times one derivative."""
    for i in range(3):
        wrench.force[i] += column.force[i] * amount
        wrench.moment[i] += column.moment[i] * amount


@helper
def wrench_at(kin, kin0, wrench0, slope, wrench):
    """Write the wrench to first order.

    It holds at kinematics `kin` near `kin0`.
    """
    store(wrench.force, wrench0.force)
    store(wrench.moment, wrench0.moment)
    _add_slope(wrench, slope.penetration, kin.penetration - kin0.penetration)
    _add_slope(wrench, slope.normal_velocity, kin.normal_velocity - kin0.normal_velocity)
    _add_slope(wrench, slope.slip_t, kin.slip_t - kin0.slip_t)
    _add_slope(wrench, slope.slip_s, kin.slip_s - kin0.slip_s)
    _add_slope(wrench, slope.rotation_t, kin.rotation_t - kin0.rotation_t)
    _add_slope(wrench, slope.rotation_s, kin.rotation_s - kin0.rotation_s)
    _add_slope(wrench, slope.rotation_n, kin.rotation_n - kin0.rotation_n)
    _add_slope(wrench, slope.entrainment_t, kin.entrainment_t - kin0.entrainment_t)
    _add_slope(wrench, slope.entrainment_s, kin.entrainment_s - kin0.entrainment_s)

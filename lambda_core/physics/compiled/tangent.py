"""Derivative of one raceway contact's wrench with respect to its kinematics q.

Stage by stage: shear along the slip costs one extra evaluation of the cells for all five
slip kinematics together, penetration and entrainment one each. Kernels are elementwise, so a
plugin needs no derivative of its own.
"""

from __future__ import annotations

from lambda_core.physics.compiled.layout import (
    C_A,
    C_B,
    C_DAMP,
    C_HYST,
    C_LOAD,
    C_ROLL,
    FAULT,
    GRID_AREA,
    GRID_DS,
    GRID_DT,
    GRID_S,
    GRID_T,
    NC,
    NQ,
    NW,
    OUT,
    Q_DELTA,
    Q_UT,
    Q_VN,
    Q_VT,
    Q_WN,
    Q_WS,
    Q_WT,
    R_DAMPING,
    RACEWAY_KERNELS,
    SCALARS,
    SCALARS2,
    W_FN,
    W_FS,
    W_FT,
    W_MN,
    W_MS,
    W_MT,
    WRENCH,
    WRENCH2,
    X_P,
    X_SLIP,
    X_TAU,
    X_VS,
    X_VT,
    helper,
    par_of,
)
from lambda_core.physics.compiled.raceway import (
    _CELL_VARIANCE,
    film_stage,
    pipeline,
    rolling_speeds,
    shear_stage,
    slip_field,
    sum_wrench,
)

_RELATIVE = 1e-5  # relative step of the small differences; the laws are smooth at this scale


@helper
def slip_columns(which, q, system, grid, scalars, cells, tau2, step, slope):
    """Add d(wrench)/d(V_t, V_s, W_t, W_s, W_n) from the cells' tangent moduli."""
    a, b = scalars[C_A], scalars[C_B]
    curvature = 1.0 / system.radius_deformed[which]
    tau, slip, vt, vs = cells[X_TAU], cells[X_SLIP], cells[X_VT], cells[X_VS]
    wt, ws, wn = q[Q_WT], q[Q_WS], q[Q_WN]
    ab = a * b
    for i in range(grid.shape[1]):
        v = slip[i]
        area = ab * grid[GRID_AREA, i]
        modulus = (tau2[i] - tau[i]) / (step * v)
        g = tau[i] / v
        s, t = a * grid[GRID_S, i], b * grid[GRID_T, i]
        z = 0.5 * s * s * curvature
        kink = s * curvature
        ds2 = _CELL_VARIANCE * (a * grid[GRID_DS, i]) ** 2
        dt2 = _CELL_VARIANCE * (b * grid[GRID_DT, i]) ** 2
        for k in range(5):
            # Change of slip vector and of the in-cell spread by this kinematic input.
            dvt, dvs, spread = 0.0, 0.0, 0.0
            column = Q_VT + k
            if k == 0:
                dvt = 1.0
            elif k == 1:
                dvs = 1.0
            elif k == 2:
                dvs = z
                spread = ds2 * wt * kink * kink
            elif k == 3:
                dvt = -z
                spread = ds2 * (wn + ws * kink) * kink
            else:
                dvt, dvs = -s, t
                spread = ds2 * (wn + ws * kink) + dt2 * wn
            dv = (vt[i] * dvt + vs[i] * dvs + spread) / v
            dg = (modulus - g) * dv / v
            ft = -area * (dg * vt[i] + g * dvt)
            fs = -area * (dg * vs[i] + g * dvs)
            slope[W_FT, column] += ft
            slope[W_FS, column] += fs
            slope[W_MS, column] -= z * ft
            slope[W_MT, column] += z * fs
            slope[W_MN, column] += t * fs - s * ft


@helper
def rolling_columns(which, q, system, scalars, slope):
    """Add the derivative of the directions of rolling resistance and hysteresis."""
    rx = system.radius_x[which]
    roll, bend = rolling_speeds(which, q, system)
    f2 = system.roll_floor * system.roll_floor
    droll = scalars[C_ROLL] * f2 / (roll * roll + f2) ** 1.5
    dbend = scalars[C_HYST] * f2 / (bend * bend + f2) ** 1.5
    lever = 2.0 * rx / system.ball_radius - 1.0
    by_vt = -(rx / system.ball_radius - 0.5)
    slope[W_FT, Q_VT] += droll * by_vt * lever
    slope[W_FT, Q_WS] += droll * rx * lever
    slope[W_MS, Q_VT] -= 2.0 * rx * droll * by_vt
    slope[W_MS, Q_WS] -= 2.0 * rx * droll * rx + dbend * rx


def contact_tangent(which, q, laws, par, systems, grid, blocks, scratch, slope):
    """Write d(wrench)/dq, shape (6, 9), and the wrench itself; an entry point of its own, called by pointer.

    Runs the pipeline at q into scratch[SCALARS], scratch[WRENCH] and blocks[0], then at neighbours of q.

    Left out: the effect of slip on the thermal film factor and of the smaller component of entrainment, both
    small; the integrator's Newton iteration only needs the slope, not its last digit.
    """
    system, out, fault = systems[0], scratch[OUT], scratch[FAULT]
    scalars, cells, wrench = scratch[SCALARS], blocks[0], scratch[WRENCH]
    scalars2, cells2, wrench2 = scratch[SCALARS2], blocks[1], scratch[WRENCH2]
    if pipeline(which, q, laws, par, systems, grid, cells, scratch, scalars, wrench) != 1:
        return 0
    slope[:, :] = 0.0
    if system.guides_on == 1:
        step = 1e-4 * abs(q[Q_VN]) + 1e-6
        out[0] = 0.0
        laws.damping(
            q[Q_DELTA],
            q[Q_VN] + step,
            scalars[C_LOAD],
            par_of(par, system, RACEWAY_KERNELS * which + R_DAMPING),
            out,
        )
        slope[W_FN, Q_VN] = -(max(out[0], -scalars[C_LOAD]) - scalars[C_DAMP]) / step
    # Penetration.
    delta = q[Q_DELTA]
    step = _RELATIVE * delta + 1e-13
    q[Q_DELTA] = delta + step
    ok = pipeline(which, q, laws, par, systems, grid, cells2, scratch, scalars2, wrench2)
    q[Q_DELTA] = delta
    if ok != 1:
        return 0
    for i in range(NW):
        slope[i, Q_DELTA] = (wrench2[i] - wrench[i]) / step
    if system.friction_on == 0:
        return 1
    # Entrainment: along rolling, or across it where a ball at rest is pushed sideways.
    column = Q_UT if abs(q[Q_UT]) >= abs(q[Q_UT + 1]) else Q_UT + 1
    entrainment = q[column]
    step = (_RELATIVE * abs(entrainment) + 1e-8) * (1.0 if entrainment >= 0.0 else -1.0)
    q[column] = entrainment + step
    for i in range(NC):
        scalars2[i] = scalars[i]
    ok = film_stage(which, q, laws, par, system, scalars2, out, fault)
    if ok == 1:
        slip_field(which, q, system, grid, scalars2, cells2)
        ok = shear_stage(which, laws, par, system, grid, scalars2, cells2, fault)
    if ok == 1:
        sum_wrench(which, q, system, grid, scalars2, cells2, wrench2)
    q[column] = entrainment
    if ok != 1:
        return 0
    for i in range(NW):
        slope[i, column] = (wrench2[i] - wrench[i]) / step
    # Slip: the same cells at slightly larger slip.
    for i in range(grid.shape[1]):
        cells2[X_SLIP, i] = cells[X_SLIP, i] * (1.0 + _RELATIVE)
        cells2[X_P, i] = cells[X_P, i]
    for i in range(NC):
        scalars2[i] = scalars[i]
    if shear_stage(which, laws, par, system, grid, scalars2, cells2, fault) != 1:
        return 0
    slip_columns(which, q, system, grid, scalars, cells, cells2[X_TAU], _RELATIVE, slope)
    rolling_columns(which, q, system, scalars, slope)
    return 1


@helper
def wrench_at(kin, kin0, wrench0, slope, wrench):
    """Write the wrench to first order at kinematics `kin` near `kin0`."""
    for i in range(NW):
        w = wrench0[i]
        for k in range(NQ):
            w += slope[i, k] * (kin[k] - kin0[k])
        wrench[i] = w

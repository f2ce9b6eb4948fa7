"""Derivative of one raceway contact's wrench with respect to its kinematics q.

Stage by stage: shear along the slip costs one extra evaluation of the cells for all five
slip kinematics together, penetration and entrainment one each. Kernels are elementwise, so a
plugin needs no derivative of its own.
"""

from __future__ import annotations

import numpy as np

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
    Q_VS,
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
    X_INVERSE,
    X_P,
    X_SLIP,
    X_TAU,
    X_VS,
    X_VT,
    helper,
    par_of,
    vector_helper,
)
from lambda_core.physics.compiled.raceway import pipeline
from lambda_core.physics.compiled.resultant import rolling_speeds, sum_wrench
from lambda_core.physics.compiled.scalar_stages import film_stage
from lambda_core.physics.compiled.shear import CELL_VARIANCE, shear_stage

_RELATIVE = 1e-5  # relative step of the small differences; the laws are smooth at this scale


@vector_helper
def _slip_column(a, b, curvature, along, across, spread, grid, cells, tau2, step, slope, column):
    """Write d(wrench)/d(one slip kinematic) from the cells' tangent moduli.

    The slip along rolling changes by along[0] + along[1] s + along[2] z, across by across[0] + across[1] t +
    across[2] z, half its squared spread inside a cell as `spread` says: powers of s/R over the cell's width across,
    then the share of its width along.
    """
    tau, inverse, vt, vs = cells[X_TAU], cells[X_INVERSE], cells[X_VT], cells[X_VS]
    grid_s, grid_t, grid_area = grid[GRID_S], grid[GRID_T], grid[GRID_AREA]
    grid_ds, grid_dt = grid[GRID_DS], grid[GRID_DT]
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
    slope[W_FT, column], slope[W_FS, column] = ab * sum_t, ab * sum_s
    slope[W_MT, column], slope[W_MS, column], slope[W_MN, column] = ab * sum_mt, ab * sum_ms, ab * sum_mn


@helper
def slip_columns(which, q, system, grid, scalars, cells, tau2, step, slope):
    """Write d(wrench)/d(V_t, V_s, W_t, W_s, W_n) from the shear at slightly larger slip."""
    a, b = scalars[C_A], scalars[C_B]
    c = 1.0 / system.radius_deformed[which]
    wt, ws, wn = q[Q_WT], q[Q_WS], q[Q_WN]
    # Numba would compile the function anew for every number that stands in its call.
    none, still = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    _slip_column(a, b, c, (1.0, 0.0, 0.0), none, still, grid, cells, tau2, step, slope, np.int64(Q_VT))
    _slip_column(a, b, c, none, (1.0, 0.0, 0.0), still, grid, cells, tau2, step, slope, np.int64(Q_VS))
    _slip_column(a, b, c, none, (0.0, 0.0, 1.0), (0.0, 0.0, wt, 0.0), grid, cells, tau2, step, slope, np.int64(Q_WT))
    _slip_column(a, b, c, (0.0, 0.0, -1.0), none, (0.0, wn, ws, 0.0), grid, cells, tau2, step, slope, np.int64(Q_WS))
    turn = (wn, ws, 0.0, wn)
    _slip_column(a, b, c, (0.0, -1.0, 0.0), (0.0, 1.0, 0.0), turn, grid, cells, tau2, step, slope, np.int64(Q_WN))


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


@helper
def _damping_column(which, q, laws, par, system, scratch, slope):
    """Write d(wrench)/d(V_n), which the damping law alone depends on."""
    scalars, out = scratch[SCALARS], scratch[OUT]
    step = 1e-4 * abs(q[Q_VN]) + 1e-6
    out[0] = 0.0
    par_damping = par_of(par, system, RACEWAY_KERNELS * which + R_DAMPING)
    laws.damping(q[Q_DELTA], q[Q_VN] + step, scalars[C_LOAD], par_damping, out)
    slope[W_FN, Q_VN] = -(max(out[0], -scalars[C_LOAD]) - scalars[C_DAMP]) / step


@helper
def _penetration_column(which, q, laws, par, systems, grid, cells, scratch, slope):
    """Write d(wrench)/d(penetration) from the whole pipeline at a slightly larger one."""
    wrench, wrench2, delta = scratch[WRENCH], scratch[WRENCH2], q[Q_DELTA]
    step = _RELATIVE * delta + 1e-13
    q[Q_DELTA] = delta + step
    ok = pipeline(which, q, laws, par, systems, grid, cells, scratch, scratch[SCALARS2], wrench2)
    q[Q_DELTA] = delta
    if ok != 1:
        return 0
    for i in range(NW):
        slope[i, Q_DELTA] = (wrench2[i] - wrench[i]) / step
    return 1


@helper
def _entrainment_column(which, q, laws, par, system, grid, blocks, scratch, slope):
    """Write d(wrench)/d(entrainment): along rolling, or across it where a ball at rest is pushed sideways."""
    scalars, scalars2, fault = scratch[SCALARS], scratch[SCALARS2], scratch[FAULT]
    wrench, wrench2, cells, cells2 = scratch[WRENCH], scratch[WRENCH2], blocks[0], blocks[1]
    column = Q_UT if abs(q[Q_UT]) >= abs(q[Q_UT + 1]) else Q_UT + 1
    entrainment = q[column]
    step = (_RELATIVE * abs(entrainment) + 1e-8) * (1.0 if entrainment >= 0.0 else -1.0)
    q[column] = entrainment + step
    for i in range(NC):
        scalars2[i] = scalars[i]
    for row in range(X_P, cells.shape[0]):  # pressure and slip do not change with entrainment
        for i in range(cells.shape[1]):
            cells2[row, i] = cells[row, i]
    ok = film_stage(which, q, laws, par, system, scalars2, scratch[OUT], fault)
    if ok == 1:
        ok = shear_stage(which, laws, par, system, grid, scalars2, cells2, fault)
    if ok == 1:
        sum_wrench(which, q, system, grid, scalars2, cells2, wrench2)
    q[column] = entrainment
    if ok != 1:
        return 0
    for i in range(NW):
        slope[i, column] = (wrench2[i] - wrench[i]) / step
    return 1


def contact_tangent(which, q, laws, par, systems, grid, blocks, scratch, slope):
    """Write d(wrench)/dq, shape (6, 9), and the wrench itself; an entry point of its own, called by pointer.

    Runs the pipeline at q into scratch[SCALARS], scratch[WRENCH] and blocks[0], then at neighbours of q.

    Left out: the effect of slip on the thermal film factor and of the smaller component of entrainment, both
    small; the integrator's Newton iteration only needs the slope, not its last digit.
    """
    system, scalars, scalars2 = systems[0], scratch[SCALARS], scratch[SCALARS2]
    cells, cells2 = blocks[0], blocks[1]
    if pipeline(which, q, laws, par, systems, grid, cells, scratch, scalars, scratch[WRENCH]) != 1:
        return 0
    slope[:, :] = 0.0
    if system.guides_on == 1:
        _damping_column(which, q, laws, par, system, scratch, slope)
    if _penetration_column(which, q, laws, par, systems, grid, cells2, scratch, slope) != 1:
        return 0
    if system.friction_on == 0:
        return 1
    if _entrainment_column(which, q, laws, par, system, grid, blocks, scratch, slope) != 1:
        return 0
    # Slip: the same cells at slightly larger slip.
    for i in range(grid.shape[1]):
        cells2[X_SLIP, i] = cells[X_SLIP, i] * (1.0 + _RELATIVE)
    for i in range(NC):
        scalars2[i] = scalars[i]
    if shear_stage(which, laws, par, system, grid, scalars2, cells2, scratch[FAULT]) != 1:
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

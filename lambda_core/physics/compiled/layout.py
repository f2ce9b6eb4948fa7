"""Layout of states, records and arrays that the compiled code works on.

State vector y, float64, shape (9 Z + n_active,):

* ball j, ``y[9 j : 9 j + 9]``: x, r, psi, v_x, v_r, v_t, omega_x, omega_r, omega_t
  [m, m, rad, m/s x 3, rad/s x 3], cylindrical frame (x, r, t) that turns with the ball's azimuth.
* the rest: the free entries of the *shared* state, shape (36,), three bodies (inner ring,
  outer ring, cage) of 12: x, y, z, a_y, a_z, theta, v_x, v_y, v_z, w_y, w_z, sigma in the inertial
  frame. (a_x, a_y, a_z) is the unit vector of the body's axis, w its angular velocity
  across that axis, theta and sigma angle and speed about it.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from lambda_core.registry import inlined
from lambda_core.registry.machine_code import OPTIONS, role_signature
from lambda_core.registry.roles import ROLES

NB = 9  # states of a ball
NS = 12  # states of a shared body
BX, BR, BPSI, BVX, BVR, BVT, BWX, BWR, BWT = range(9)
SX, SY, SZ, SAY, SAZ, STHETA, SVX, SVY, SVZ, SWY, SWZ, SSIGMA = range(12)
INNER, OUTER, CAGE = range(3)

# Contact kinematics q (the inputs of the contact laws) and wrench (force and couple on the ball
# at the contact's centre, axes t along rolling, s across, n from ball to ring).
Q_DELTA, Q_VN, Q_VT, Q_VS, Q_WT, Q_WS, Q_WN, Q_UT, Q_US = range(9)
NQ = 9
W_FT, W_FS, W_FN, W_MT, W_MS, W_MN = range(6)
NW = 6

# Scalars of one contact, kept for output and for the tangent.
C_LOAD, C_A, C_B, C_PMAX, C_DAMP, C_HCEN, C_HMIN, C_LAMBDA = range(8)
C_PSI, C_ROLL, C_HYST, C_UMEAN, C_TMEAN, C_CHANGE, C_HISO, C_WET = range(8, 16)
NC = 16

# Dissipators, in the order of lambda_core.physics.channels.LOSSES.
L_SLIDE, L_SPIN, L_BOUNDARY, L_ROLL, L_HYST, L_DAMP = range(0, 12, 2)  # + ring
L_POCKET, L_LAND, L_DRAG, L_SUPPORT = 12, 13, 14, 15
NL = 16
# Running integrals: the losses, then these.
I_INPUT, I_INPUT_ABS, I_DRIVE, I_ANGLE, I_X, I_Y, I_Z = range(NL, NL + 7)
NI = NL + 7

# Channels of time functions: motion of (body, dof), then force and moment of (body, axis).
CH_MOTION, CH_FORCE, CH_MOMENT = 0, 18, 27
NCH = 36
FREE, LOCKED, PRESCRIBED = range(3)
TF_CONSTANT, TF_RAMP, TF_HARMONIC, TF_TABLE = range(4)

# Order of the raceway roles: index in the fault report.
RACEWAY_ROLES = (
    "normal_contact",
    "damping",
    "rheology",
    "film_thickness",
    "thermal_correction",
    "contact_temperature",
    "traction",
    "rolling_resistance",
    "elastic_hysteresis",
    "asperity_load",
    "boundary_friction",
    "permittivity",
    "capacitance",
    "surface",
    "cage_contact",
    "fluid_drag",
)
R_NORMAL, R_DAMPING, R_RHEOLOGY, R_FILM, R_THERMAL, R_TEMPERATURE, R_TRACTION, R_ROLLING = range(8)
R_HYSTERESIS, R_ASPERITY, R_BOUNDARY, R_PERMITTIVITY, R_CAPACITANCE, R_SURFACE, R_CAGE, R_DRAG = range(8, 16)

# Constants of the system, one record. [2]: inner, outer. [3]: inner ring, outer ring, cage.
SYSTEM = np.dtype(
    [
        ("balls", np.int64),
        ("cage_on", np.int64),
        ("active", np.int64),  # number of free shared states
        ("ball_radius", np.float64),  # [m]
        ("ball_mass", np.float64),  # [kg]
        ("ball_inertia", np.float64),  # [kg m2]
        ("groove_circle", np.float64, (2,)),  # radius of the circle of groove centres [m]
        ("groove_radius", np.float64, (2,)),  # [m]
        ("radius_x", np.float64, (2,)),  # reduced, along rolling [m]
        ("radius_y", np.float64, (2,)),  # reduced, across rolling [m]
        ("e_eff", np.float64, (2,)),  # [Pa]
        ("radius_deformed", np.float64, (2,)),  # common radius across rolling [m]
        ("mass", np.float64, (3,)),  # [kg]
        ("transverse_inertia", np.float64, (3,)),  # [kg m2]
        ("polar_inertia", np.float64, (3,)),  # [kg m2]
        ("unbalance", np.float64, (3,)),  # [kg m]
        ("mode", np.int64, (18,)),  # FREE, LOCKED, PRESCRIBED of (body, dof)
        ("stiffness", np.float64, (18,)),  # support of (body, dof) [N/m, N m/rad]
        ("damping", np.float64, (18,)),  # [N s/m, N m s/rad]
        ("gravity", np.float64, (3,)),  # [m/s2]
        ("oil_temperature", np.float64),  # [K]
        ("eta0", np.float64),  # [Pa s]
        ("alpha_p", np.float64),  # [1/Pa]
        ("beta", np.float64),  # [1/K]
        ("k_oil", np.float64),  # [W/(m K)]
        ("rho0", np.float64),  # [kg/m3]
        ("roughness", np.float64),  # [m]
        ("starvation", np.float64),  # [-]
        ("pocket_circle", np.float64),  # radius of the pockets' circle [m]
        ("land_offset", np.float64),  # half the distance of the two land stations [m]
        ("land_on", np.int64, (2,)),
        ("drag_on", np.int64),
        ("surface_on", np.int64, (2,)),  # 0: nominal raceway
        ("surfaces", np.int64),  # 0: both are nominal
        ("roll_floor", np.float64),  # width of the change of sign of rolling losses [m/s]
        ("slip_floor", np.float64),  # smallest slip that directions are computed with [m/s]
        ("par_start", np.int64, (40,)),  # where each kernel's parameters begin in Bundle.par
        ("friction_on", np.int64),  # 0: normal forces only (static equilibrium)
        ("guides_on", np.int64),  # 0: no cage forces, nominal raceways (quasi-static equilibrium)
    ],
    align=True,
)

f8 = types.float64
i8 = types.int64
array1 = types.float64[::1]
array2 = types.float64[:, ::1]
array3 = types.float64[:, :, ::1]
array4 = types.float64[:, :, :, ::1]
iarray1 = types.int64[::1]
system_t = types.Array(numba.from_dtype(SYSTEM), 1, "C")


class RacewayLaws(NamedTuple):
    """Pointers to the kernels of one ball-raceway force element."""

    normal_contact: Any
    damping: Any
    rheology: Any
    film_thickness: Any
    thermal_correction: Any
    contact_temperature: Any
    traction: Any
    rolling_resistance: Any
    elastic_hysteresis: Any
    asperity_load: Any
    boundary_friction: Any
    permittivity: Any
    capacitance: Any
    surface: Any


class Laws(NamedTuple):
    """All kernels of the model."""

    inner: Any
    outer: Any
    pocket: Any
    land_inner: Any
    land_outer: Any
    drag: Any


# Index of a kernel's parameters: 14 per raceway (order of RACEWAY_ROLES), then these.
RACEWAY_KERNELS = 14
P_POCKET, P_LAND, P_DRAG = 28, 29, 31
N_PAR = 32

# Rows of Bundle.grid, cells on the unit ellipse: position across rolling over a, along rolling over b, mean
# pressure over p_max, area over a b, width across over a, width along over b.
GRID_S, GRID_T, GRID_P, GRID_AREA, GRID_DS, GRID_DT = range(6)

# Rows of Bundle.scratch, each of 64 numbers. Contents do not survive a call, but for FAULT.
(
    SHARED,  # 36: the whole shared state
    KIN,  # NKIN
    KIN2,
    WRENCH,  # NW
    WRENCH2,
    SCALARS,  # NC
    SCALARS2,
    OUT,  # results of scalar kernels
    GUIDE,  # 24: state of one cage contact
    STILL,  # 9: the same at rest
    RING_FM,  # 6: force and moment of one contact on its ring, inertial
    RATE,  # 12: time derivative of one shared body
    FAULT,  # 8: role, status, ball, ring, inputs
    SURFACE,  # 3: height of a raceway and its slopes
    BODY_FM,  # 3 rows of 6: force and moment of all contacts on each shared body, inertial
) = range(15)
N_SCRATCH = 17

# Kinematics of one contact beyond q: frame and arms (components x, r, t).
# K_AXIAL, K_RADIAL: ball centre from the groove's centre; K_COS, K_SIN: of the ball's azimuth. K_LIFT: height
# of the raceway's surface; K_RISE: its slopes with the ball centre's place along t and s.
K_T, K_S, K_N, K_D, K_ARM, K_AXIAL, K_RADIAL, K_COS, K_SIN, K_LIFT, K_RISE = (
    NQ + i for i in (0, 3, 6, 9, 10, 13, 14, 15, 16, 17, 18)
)
NKIN = NQ + 20

# Rows of one block of Bundle.cells; the first X_RESULTS of them are written by kernels.
# X_P and what follows depends on the kinematics alone: pressure, slip, its inverse, its two components.
(X_LN0, X_TAU0, X_T1, X_LN, X_TAU, X_MU, X_RHO, X_T, X_P, X_SLIP, X_INVERSE, X_VT, X_VS) = range(13)
X_RESULTS = 6
N_CELL_ROWS = 13


def _law_t(role: str) -> Any:
    return types.FunctionType(role_signature(ROLES[role]))


raceway_laws_t = types.NamedTuple([_law_t(role) for role in RacewayLaws._fields], RacewayLaws)
laws_t = types.NamedTuple([raceway_laws_t, raceway_laws_t, *[_law_t("cage_contact")] * 3, _law_t("fluid_drag")], Laws)
# One contact: (ring, q, laws, par, system, grid, cells, scratch, scalars, wrench) -> status
wrench_sig = i8(i8, array1, raceway_laws_t, array1, system_t, array2, array2, array2, array1, array1)
# Its tangent: (ring, q, laws, par, system, grid, cells, scratch, slope, wrench pointer) -> status
tangent_sig = i8(i8, array1, raceway_laws_t, array1, system_t, array2, array3, array2, array2)


class Bundle(NamedTuple):
    """Everything that the compiled code works on, in one argument."""

    system: Any  # SYSTEM record, shape (1,)
    laws: Any  # Laws
    wrench: Any  # pointer: wrench of one raceway contact
    tangent: Any  # pointer: its derivative
    par: Any  # float64: parameters of all kernels, one after another (system.par_start)
    grid: Any  # (6, cells)
    terms: Any  # (n, 8) time functions: channel, kind, 4 values, offset and length in `table`
    table: Any  # knots and spline coefficients
    active: Any  # int64 (n_active,): free entries of the shared state
    channels: Any  # (36, 3) value and two derivatives of every time function
    cells: Any  # (2, N_CELL_ROWS, cells)
    scratch: Any  # (N_SCRATCH, 64)
    ball_fm: Any  # (Z, 6) force and moment on each ball, axes x, r, t


bundle_t = types.NamedTuple(
    [
        system_t,
        laws_t,
        types.FunctionType(wrench_sig),
        types.FunctionType(tangent_sig),
        array1,
        array2,
        array2,
        array1,
        iarray1,
        array2,
        array3,
        array2,
        array2,
    ],
    Bundle,
)


_ANY_ORDER = {"reassoc", "contract", "nsz"}


def vector_helper(function):
    """Compile a helper whose loops over cells may be summed in any order, so that they vectorise.

    Only the order of sums, fused multiply-adds and the sign of zero are set free: NaN and infinity keep their meaning.
    """
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "fastmath": _ANY_ORDER})(function)


def rows_helper(function):
    """Compile a vector helper whose arrays are all apart: rows of a block, of which none is given twice."""
    return numba.njit(**{**OPTIONS, **inlined.APART, "fastmath": _ANY_ORDER})(function)


def helper(function):
    """Compile a helper of the core into its callers; never cached by itself, they are."""
    return numba.njit(**OPTIONS, **inlined.OPTIONS)(function)


def allocating_helper(function):
    """Compile a helper that makes arrays of its own, off the hot path."""
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "forceinline": False, "_nrt": True})(function)


@numba.njit(inline="always")  # a function of its own could not return a view without counting references
def par_of(par, system, k):
    """Return the parameters of kernel k, a view."""
    return par[system.par_start[k] : system.par_start[k + 1]]

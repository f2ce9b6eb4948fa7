"""State vector, tables and workspaces of the compiled code, in one bundle, and the types of its contact functions.

State vector y, float64, shape (9 Z + n_active + states of contacts,):

* ball j, ``y[9 j : 9 j + 9]``: a records.BALL (x, radius, azimuth, velocity, spin).
* then the free entries of the *shared* state, shape (12 bodies,), one records.BODY_STATE per body: inner ring,
  outer ring, cage.
* the rest: what contacts keep by laws of the role contact_state, raceway by raceway, ball by ball; mostly nothing.
"""

from __future__ import annotations

from collections import namedtuple
from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from lambda_core.domain.roles import ROLES
from lambda_core.laws.jit import inlined
from lambda_core.laws.jit.function_tables import TABLE, reader
from lambda_core.laws.jit.machine_code import OPTIONS, role_signature
from lambda_core.laws.jit.references import by_reference, reference_t
from lambda_core.solver import records as R

# Places in the state vector, for what goes through states one by one: integrator, Jacobian, tolerances.
NB = R.floats_of(R.BALL)
NS = R.floats_of(R.BODY_STATE)
BX, BR, BPSI, BVX, BVR, BVT, BWX, BWR, BWT = range(NB)
SX, SY, SZ, SAY, SAZ, STHETA, SVX, SVY, SVZ, SWY, SWZ, SSIGMA = range(NS)
NQ = len(R.DRIVERS)

f8 = types.float64
i8 = types.int64
array1 = types.float64[::1]
array2 = types.float64[:, ::1]
array3 = types.float64[:, :, ::1]
array4 = types.float64[:, :, :, ::1]
iarray1 = types.int64[::1]
iarray2 = types.int64[:, ::1]


def record_t(kind: np.dtype[Any]) -> Any:
    """Return the type of one record in compiled code."""
    return numba.from_dtype(kind)


def table_t(kind: np.dtype[Any]) -> Any:
    """Return the type of an array of records in compiled code."""
    return types.Array(record_t(kind), 1, "C")


# Pointers to the kernels of one ball-raceway force element, by role.
RacewayLaws: Any = namedtuple("RacewayLaws", R.RACEWAY_ROLES)  # type: ignore[misc] # its fields are the roles


@by_reference
class Laws(NamedTuple):
    """All kernels of the model: tables of their addresses, read with raceway_laws, guide_law, drag_law, and so on."""

    raceways: Any  # int64 (sets of laws, roles of a raceway contact)
    guides: Any  # int64 (laws, 1): of pockets, of balls with each other, of lands
    drag: Any  # int64 (laws, 1)
    links: Any  # int64 (laws, 1): of force elements between bodies
    times: Any  # int64 (laws, 1): of loads and motions over time


class Losses(NamedTuple):
    """Power that raceway contacts dissipate, by mechanism: each an array with one entry per raceway [W]."""

    sliding: Any
    spin: Any
    boundary: Any
    rolling: Any
    hysteresis: Any
    damping: Any


# Powers, and their running integrals: Losses of every raceway, then records.RUNNING, which begins with losses too.
MECHANISMS = len(Losses._fields)
RUNNING_SIZE = R.floats_of(R.RUNNING)
BESIDE_LOSSES = RUNNING_SIZE - 4  # powers at the end that are no losses


def power_count(bundle: Bundle) -> int:
    """Return how many powers the raceways of a bundle have."""
    return MECHANISMS * int(bundle.raceways.size) + RUNNING_SIZE


class Grid(NamedTuple):
    """Cells on the unit ellipse, each an array with one entry per cell."""

    across: Any  # place across rolling over a
    along: Any  # place along rolling over b
    pressure: Any  # mean over p_max
    area: Any  # over a b
    width_across: Any  # over a
    width_along: Any  # over b


class Cells(NamedTuple):
    """What the cells of one contact hold, each an array with one entry per cell.

    Pressure and what follows depends on the kinematics alone.
    """

    guard: Any  # (_RESULTS + 1, GUARD): what stands behind the rows that laws write
    results: Any  # these rows with their guards, but for that of the density
    ln_eta_inlet: Any  # logarithm of the viscosity at the inlet's temperature [ln(Pa s)]
    shear_inlet: Any  # shear stress there; in the end the film's share of it [Pa]
    temperature: Any  # of the film [K]
    ln_eta: Any  # at the film's temperature
    shear: Any  # stress of film and asperities [Pa]
    friction: Any  # coefficient of the asperities; in the end their share of the shear stress [Pa]
    density: Any  # [kg/m3]
    inlet: Any  # inlet's temperature [K]
    pressure: Any  # [Pa]
    slip: Any  # speed, with its spread inside the cell [m/s]
    inverse_slip: Any  # [s/m]
    slip_t: Any  # velocity of the ball over the ring along rolling [m/s]
    slip_s: Any  # and across


CELL_ROWS = len(Cells._fields) - 2
GUARD = 8  # cells behind each row, which nobody writes, a line of cache: what stands first there shows an index too far
_RESULTS = 6  # rows that laws write
KINEMATIC_ROWS = Cells._fields.index("pressure") - 2  # the first row that depends on the kinematics alone


def _law_t(role: str) -> Any:
    return types.FunctionType(role_signature(ROLES[role]))


raceway_laws_t = types.NamedTuple([_law_t(role) for role in R.RACEWAY_ROLES], RacewayLaws)
raceway_laws = reader(raceway_laws_t)
guide_law = reader(_law_t("cage_contact"))
drag_law = reader(_law_t("fluid_drag"))
link_law = reader(_law_t("force_element"))
time_law = reader(_law_t("time_function"))
laws_t = reference_t(Laws, dict.fromkeys(Laws._fields, TABLE))
# One contact: (raceway, kinematics, laws, par, system, grid, cells, scratch, contact, wrench) -> status
wrench_sig = i8(
    record_t(R.RACEWAY), record_t(R.KINEMATICS), raceway_laws_t, array1, record_t(R.SYSTEM), array2, array2,
    record_t(R.SCRATCH), record_t(R.CONTACT), record_t(R.WRENCH),
)  # fmt: skip
# Its tangent: (raceway, kinematics, laws, par, system, grid, cells, scratch, tangent) -> status
tangent_sig = i8(
    record_t(R.RACEWAY), record_t(R.KINEMATICS), raceway_laws_t, array1, record_t(R.SYSTEM), array2, array3,
    record_t(R.SCRATCH), record_t(R.TANGENT),
)  # fmt: skip


@by_reference
class Bundle(NamedTuple):
    """Everything that the compiled code works on, in one argument."""

    system: Any  # SYSTEM, shape (1,)
    bodies: Any  # BODY (bodies,)
    rows: Any  # ROW (rows,)
    raceways: Any  # RACEWAY (raceways,)
    waves: Any  # WAVE (waves of elastic rings,): mostly none
    lands: Any  # LAND (stations,)
    links: Any  # LINK (force elements between bodies,)
    tied: Any  # int64 (n,): entries of the shared state that elastic structures tie together; mostly none
    tie_stiffness: Any  # (n, n): of shafts and housings between them [N/m, N, N m]
    tie_damping: Any  # (n, n), or (0, 0) where nothing is damped [N s/m, N s, N m s]
    tie_rest: Any  # (n,): where they are without force
    tie_moves: Any  # (n,): how far they are from there
    tie_rates: Any  # (n,) or (0,): and how fast they change, where something is damped
    slots: Any  # SLOT (places where laws read states of contacts,)
    state_steps: Any  # (states of contacts,): for differences
    laws: Any  # Laws
    wrench: Any  # pointer: wrench of one raceway contact
    tangent: Any  # pointer: its derivative
    par: Any  # float64: parameters of all kernels, one after another
    grid: Any  # (6, cells): rows of Grid
    terms: Any  # TERM (n,)
    table: Any  # knots and spline coefficients
    active: Any  # int64 (n_active,): free entries of the shared state
    inputs: Any  # INPUTS (bodies,)
    signals: Any  # SIGNAL (12 bodies,): the same memory
    cells: Any  # (2, CELL_ROWS, cells + GUARD): rows of Cells
    scratch: Any  # SCRATCH (1,)
    shared: Any  # (12 bodies,) the whole shared state
    bodies_now: Any  # BODY_STATE (bodies,): the same memory
    ground: Any  # BODY_STATE (1,): at rest
    shared_rates: Any  # (12 bodies,) its time derivative
    body_rates: Any  # BODY_STATE (bodies,): the same memory
    body_wrenches: Any  # WRENCH (bodies,) of all contacts
    contact_wrenches: Any  # WRENCH (bodies,): the share of raceways, pockets and lands, where bearings are several
    ball_wrenches: Any  # WRENCH (Z,)
    resting: Any  # int64 (bearings,): 1 where forces of the last evaluation stand
    bearing_powers: Any  # RUNNING (bearings,): what pockets, lands, drag and weights of each have of the powers
    states: Any  # (states of contacts,)
    state_rates: Any  # (states of contacts,) their time derivatives
    state_slopes: Any  # (states of contacts, most of one contact): of the rates with the states of the same contact
    state_pivots: Any  # int64 (most of one contact,)


_TYPES = {
    "system": table_t(R.SYSTEM),
    "bodies": table_t(R.BODY),
    "rows": table_t(R.ROW),
    "raceways": table_t(R.RACEWAY),
    "waves": table_t(R.WAVE),
    "lands": table_t(R.LAND),
    "links": table_t(R.LINK),
    "tied": iarray1,
    "tie_stiffness": array2,
    "tie_damping": array2,
    "tie_rest": array1,
    "tie_moves": array1,
    "tie_rates": array1,
    "slots": table_t(R.SLOT),
    "state_steps": array1,
    "laws": laws_t,
    "wrench": types.FunctionType(wrench_sig),
    "tangent": types.FunctionType(tangent_sig),
    "par": array1,
    "grid": array2,
    "terms": table_t(R.TERM),
    "table": array1,
    "active": iarray1,
    "inputs": table_t(R.INPUTS),
    "signals": table_t(R.SIGNAL),
    "cells": array3,
    "scratch": table_t(R.SCRATCH),
    "shared": array1,
    "bodies_now": table_t(R.BODY_STATE),
    "ground": table_t(R.BODY_STATE),
    "shared_rates": array1,
    "body_rates": table_t(R.BODY_STATE),
    "body_wrenches": table_t(R.WRENCH),
    "contact_wrenches": table_t(R.WRENCH),
    "ball_wrenches": table_t(R.WRENCH),
    "resting": iarray1,
    "bearing_powers": table_t(R.RUNNING),
    "states": array1,
    "state_rates": array1,
    "state_slopes": array2,
    "state_pivots": iarray1,
}
bundle_t = reference_t(Bundle, _TYPES)


_ANY_ORDER = {"reassoc", "contract", "nsz"}


def vector_helper(function):
    """Compile a helper whose loops over cells may be summed in any order, so that they vectorise.

    Only the order of sums, fused multiply-adds and the sign of zero are set free: NaN and infinity keep their meaning.
    """
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "fastmath": _ANY_ORDER})(function)


def rows_helper(function):
    """Compile a vector helper whose arrays are all apart: rows of a block, of which none is given twice."""
    return numba.njit(**{**OPTIONS, **inlined.APART, "fastmath": _ANY_ORDER})(function)


def ordered_rows_helper(function):
    """Compile a helper whose arrays are all apart, and whose sums keep their order."""
    return numba.njit(**{**OPTIONS, **inlined.APART})(function)


def helper(function):
    """Compile a helper of the core into its callers; never cached by itself, they are."""
    return numba.njit(**OPTIONS, **inlined.OPTIONS)(function)


def large_helper(function):
    """Compile a large helper as a function that its callers call: one copy of it in the code of an entry point."""
    return numba.njit(**OPTIONS, **inlined.LARGE)(function)


def allocating_helper(function):
    """Compile a helper that makes arrays of its own, off the hot path."""
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "forceinline": False, "_nrt": True})(function)


# Functions of their own could not return a view without counting references.
@numba.njit(inline="always")
def part(par, span):
    """Return the parameters of one law, a view."""
    return par[span[0] : span[1]]


@numba.njit(inline="always")
def grid_of(table):
    """Return the rows of Bundle.grid by name."""
    return Grid(table[0], table[1], table[2], table[3], table[4], table[5])


@numba.njit(inline="always")
def cells_of(block):
    """Return the rows of one block of Bundle.cells by name."""
    n = block.shape[1] - GUARD
    return Cells(
        block[: _RESULTS + 1, n:], block[:_RESULTS], block[0][:n], block[1][:n], block[2][:n], block[3][:n],
        block[4][:n], block[5][:n], block[6][:n], block[7][:n], block[8][:n], block[9][:n], block[10][:n],
        block[11][:n], block[12][:n],
    )  # fmt: skip


@numba.njit(inline="always")
def losses_of(rates, n):
    """Return the losses of n raceways in an array of powers, by name."""
    return Losses(
        rates[:n], rates[n : 2 * n], rates[2 * n : 3 * n], rates[3 * n : 4 * n], rates[4 * n : 5 * n],
        rates[5 * n : 6 * n],
    )  # fmt: skip


@numba.njit(inline="always")
def running_of(rates):
    """Return what stands behind the raceways' losses in an array of powers: a table of one record."""
    return rates[rates.size - RUNNING_SIZE :].view(R.RUNNING)

"""Define types and options of compiled code.

:mod:`.arrays` has the arrays.
"""

from __future__ import annotations

from typing import Any

import numba
import numpy as np
from numba import types

from lambda_core.domain.roles import ROLES
from lambda_core.laws.jit import inlined
from lambda_core.laws.jit.function_tables import reader
from lambda_core.laws.jit.machine_code import OPTIONS, role_signature
from lambda_core.laws.jit.references import reference_t
from lambda_core.solver import records as R
from lambda_core.solver.arrays.bundle import RUNNING_SIZE, Bundle, Grid, Losses, RacewayLaws, named_balls, named_cells

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
    """Return the type of a record array.

    It is for compiled code.
    """
    return types.Array(record_t(kind), 1, "C")


def _law_t(role: str) -> Any:
    return types.FunctionType(role_signature(ROLES[role]))


raceway_laws_t = types.NamedTuple([_law_t(role) for role in R.RACEWAY_ROLES], RacewayLaws)
raceway_laws = reader(raceway_laws_t)
guide_law = reader(_law_t("cage_contact"))
drag_law = reader(_law_t("fluid_drag"))
link_law = reader(_law_t("force_element"))
time_law = reader(_law_t("time_function"))
# Contacts: (raceway, first, count, laws, par, system, grid, cells, scratch) -> status
wrench_sig = i8(
    record_t(R.RACEWAY), i8, i8, raceway_laws_t, array1, record_t(R.SYSTEM), array2, array2, record_t(R.SCRATCH)
)
# The tangent of one: (raceway, laws, par, system, grid, cells, scratch, tangent) -> status
tangent_sig = i8(
    record_t(R.RACEWAY), raceway_laws_t, array1, record_t(R.SYSTEM), array2, array2, record_t(R.SCRATCH),
    record_t(R.TANGENT),
)  # fmt: skip
bundle_t = reference_t(Bundle, {"wrench": types.FunctionType(wrench_sig), "tangent": types.FunctionType(tangent_sig)})


_ANY_ORDER = {"reassoc", "contract", "nsz"}


def vector_helper(function):
    """Compile a helper with vectorised loops.

    Sums over cells may have any order.

    Only the order of sums, fused multiply-adds and the sign of zero are set free: NaN and infinity keep their meaning.
    """
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "fastmath": _ANY_ORDER})(function)


def rows_helper(function):
    """Compile a vector helper of separate arrays.

    They are rows of a block, of which none is given twice.
    """
    return numba.njit(**{**OPTIONS, **inlined.APART, "fastmath": _ANY_ORDER})(function)


def ordered_rows_helper(function):
    """Compile a helper with ordered sums.

    Its arrays are all separate.
    """
    return numba.njit(**{**OPTIONS, **inlined.APART})(function)


def helper(function):
    """Compile a helper into its callers.

    It belongs to the core and is never cached by itself; its callers are.
    """
    return numba.njit(**OPTIONS, **inlined.OPTIONS)(function)


def large_helper(function):
    """Compile a large helper as a function.

    Its callers call one copy of it in the code of an entry point.
    """
    return numba.njit(**OPTIONS, **inlined.LARGE)(function)


def allocating_helper(function):
    """Compile a helper that allocates arrays.

    It is off the hot path.
    """
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "forceinline": False, "_nrt": True})(function)


# Functions of their own could not return a view without counting references.
@numba.njit(inline="always")
def part(par, span):
    """Return the parameters of one law, a view."""
    return par[span[0] : span[1]]


@numba.njit(inline="always")
def of(lane, first, count):
    """Return the contacts' numbers from `first` on.

    The result is a view.
    """
    return lane[first : first + count]


@helper
def first_of(row, j):
    """Return the first state of ball j.

    It is its place in the state vector, for a ball of a row.
    """
    return row.first_state + row.size * (j - row.first_ball)


@numba.njit(inline="always")
def grid_of(table):
    """Return the rows of Bundle.grid by name."""
    return Grid(table[0], table[1], table[2], table[3], table[4], table[5])


# And so that Python has them, too, without the compiler.
balls_of = numba.njit(inline="always")(named_balls)
cells_of = numba.njit(inline="always")(named_cells)


@numba.njit(inline="always")
def losses_of(rates, n):
    """Return the losses of n raceways.

    They are in an array of powers, by name.
    """
    return Losses(
        rates[:n], rates[n : 2 * n], rates[2 * n : 3 * n], rates[3 * n : 4 * n], rates[4 * n : 5 * n],
        rates[5 * n : 6 * n],
    )  # fmt: skip


@numba.njit(inline="always")
def running_of(rates):
    """Return the powers behind the losses.

    They are in an array of powers, after those of the raceways, as a table of one record.
    """
    return rates[rates.size - RUNNING_SIZE :].view(R.RUNNING)

"""Define array types of the compiled network."""

from __future__ import annotations

import numba

from lambda_core.analysis.electric.columns import (
    BearingConstants,
    Channels,
    CircuitConstants,
    FullNetwork,
    Held,
    Nodes,
    Part,
    PartNodes,
    Tables,
    Wiring,
)
from lambda_core.domain.roles import ROLES
from lambda_core.laws.jit import inlined
from lambda_core.laws.jit.machine_code import OPTIONS, role_signature

array1 = numba.types.float64[::1]
array2 = numba.types.float64[:, ::1]
array3 = numba.types.float64[:, :, ::1]
iarray1 = numba.types.int64[::1]
iarray2 = numba.types.int64[:, ::1]
i8, f8 = numba.types.int64, numba.types.float64
machine_t = numba.types.NamedUniTuple(f8, len(CircuitConstants._fields), CircuitConstants)
bearings_t = numba.types.NamedUniTuple(array1, len(BearingConstants._fields), BearingConstants)
wiring_t = numba.types.NamedUniTuple(iarray1, len(Wiring._fields), Wiring)
held_t = numba.types.NamedUniTuple(array2, len(Held._fields), Held)
tables_t = numba.types.NamedUniTuple(array3, len(Tables._fields), Tables)
full_network_t = numba.types.NamedUniTuple(array2, len(FullNetwork._fields), FullNetwork)
nodes_t = numba.types.NamedUniTuple(array1, len(Nodes._fields), Nodes)
part_t = numba.types.NamedUniTuple(array2, len(Part._fields), Part)
part_nodes_t = numba.types.NamedUniTuple(array1, len(PartNodes._fields), PartNodes)
channels_t = numba.types.NamedUniTuple(array1, len(Channels._fields), Channels)


def law_of(role):
    """Return the pointer type of a role's law."""
    return numba.types.FunctionType(role_signature(ROLES[role]))


def helper(function):
    """Compile a helper into its callers.

    It is never cached by itself; its callers are.
    """
    return numba.njit(**OPTIONS, **inlined.OPTIONS)(function)


def shared_helper(function):
    """Compile a helper as a function of its own.

    It is called from several places.
    """
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "forceinline": False})(function)

"""Types of the arrays that the compiled network works on, and how its helpers are compiled."""

from __future__ import annotations

import numba

from lambda_core.laws.jit import inlined
from lambda_core.laws.jit.machine_code import OPTIONS

array1 = numba.types.float64[::1]
array2 = numba.types.float64[:, ::1]
array3 = numba.types.float64[:, :, ::1]
iarray1 = numba.types.int64[::1]
iarray2 = numba.types.int64[:, ::1]
i8, f8 = numba.types.int64, numba.types.float64


def helper(function):
    """Compile a helper into its callers; never cached by itself, they are."""
    return numba.njit(**OPTIONS, **inlined.OPTIONS)(function)


def shared_helper(function):
    """Compile a helper that is called from several places as a function of its own."""
    return numba.njit(**{**OPTIONS, **inlined.OPTIONS, "forceinline": False})(function)

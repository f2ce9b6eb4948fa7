"""Define options of functions that exist in callers only.

They are options of ``numba.njit``; there are none without Numba's internals.

They come from :mod:`inside_callers`.
"""

from __future__ import annotations

from typing import Any

from lambda_core.laws.jit.plain import is_plain

OPTIONS: dict[str, Any] = {}
APART: dict[
    str, Any
] = {}  # the same for a function none of whose arrays shares memory with another one that is written
LARGE: dict[str, Any] = {}  # the same for a large function, which is called and not copied into its callers
LAW: dict[str, Any] = {}  # for a law, which is called from elsewhere; its arrays are apart, too
if not is_plain():
    from lambda_core.laws.jit import inside_callers

    OPTIONS, APART, LARGE = inside_callers.OPTIONS, inside_callers.APART, inside_callers.LARGE
    LAW = inside_callers.LAW

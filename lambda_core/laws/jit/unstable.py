"""Name the parts of Numba that may change."""

from __future__ import annotations

from numba.core.errors import NumbaExperimentalFeatureWarning

__all__ = ["NumbaExperimentalFeatureWarning", "know_pointers"]


def know_pointers() -> None:
    """Teach Numba the type of function pointers.

    Numba forgets it until their module is imported.
    """
    import numba.experimental.function_type  # noqa: F401

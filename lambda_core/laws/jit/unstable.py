"""What Numba offers without a promise to keep it: named here alone, so that a new version is met in one room."""

from __future__ import annotations

from numba.core.errors import NumbaExperimentalFeatureWarning

__all__ = ["NumbaExperimentalFeatureWarning", "know_pointers"]


def know_pointers() -> None:
    """Teach Numba the type of pointers to functions, which it forgets until their module is imported."""
    import numba.experimental.function_type  # noqa: F401

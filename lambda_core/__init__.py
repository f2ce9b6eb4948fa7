"""Dynamics of rolling bearings: machines, contact mechanics, integrator, results.

``import lambda_core as lb`` and build a :class:`lb.Machine <lambda_core.machine.Machine>`; all other calls are in
:mod:`lambda_core.api` (running things) and :mod:`lambda_core.plugins` (extending things). Everything else is internal.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.machine import Machine

__version__ = "0.1.0"
__all__ = ["Machine"]


def __getattr__(name: str) -> Any:
    """Import the class of machines when it is first asked for: commands start faster without it."""
    if name != "Machine":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from lambda_core.machine import Machine

    return Machine


def __dir__() -> list[str]:
    """Return the names that a notebook completes."""
    return sorted({*globals(), *__all__})

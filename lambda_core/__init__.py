"""Dynamics of rolling bearings: machines, contact mechanics, integrator, results.

``import lambda_core as lb``: build a :class:`lb.Machine <lambda_core.machine.Machine>` and ask it: ``machine.run()``,
``machine.study(...)``. Calls of :mod:`lambda_core.api` for cases and files are here, too, where no package has their
name: ``lb.quasistatic``, ``lb.result``, ``lb.modes``. Plugins extend the program by :mod:`lambda_core.plugins`.
Everything else is internal.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.machine import Machine

__version__ = "0.1.0"
__all__ = ["Machine"]


def __getattr__(name: str) -> Any:
    """Import what is asked for when it is first asked for: commands start faster without it."""
    if name == "Machine":
        from lambda_core.machine import Machine

        return Machine
    if not name.startswith("_"):
        api = import_module("lambda_core.api")
        if name == "api":
            return api
        if name in api.__all__:
            return getattr(api, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """Return the names that a notebook completes."""
    return sorted({*globals(), *__all__, "api", *import_module("lambda_core.api").__all__})

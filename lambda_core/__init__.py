"""Simulate the dynamics of rolling bearings.

``import lambda_core as lb``: build a :class:`lb.Machine <lambda_core.machine.Machine>` and ask it, ``machine.run()``,
or ask about a case file: ``lb.run("box.toml")``. Calls that few scripts need are in :mod:`lambda_core.api`, names for
plugins in :mod:`lambda_core.plugins`. Everything else is internal.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from lambda_core.api import (
        CaseError,
        LambdaError,
        UsageError,
        animate,
        check,
        choose,
        cite,
        compare,
        cross_check,
        duty,
        electric,
        estimate,
        export_fmu,
        fit,
        iterate,
        modes,
        quasistatic,
        report,
        result,
        resume,
        run,
        save,
        stribeck,
        study,
        thermal,
        view,
    )
    from lambda_core.machine import Machine

__version__ = "0.1.0"
# No name of a package of this folder may be in the list: its import would replace the function.
__all__ = [
    "CaseError",
    "LambdaError",
    "Machine",
    "UsageError",
    "animate",
    "check",
    "choose",
    "cite",
    "compare",
    "cross_check",
    "duty",
    "electric",
    "estimate",
    "export_fmu",
    "fit",
    "iterate",
    "modes",
    "quasistatic",
    "report",
    "result",
    "resume",
    "run",
    "save",
    "stribeck",
    "study",
    "thermal",
    "view",
]


def __getattr__(name: str) -> Any:
    """Import a name at its first use.

    Commands start faster without it."""
    if name == "api":
        return import_module("lambda_core.api")
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module("lambda_core.machine" if name == "Machine" else "lambda_core.api"), name)


def __dir__() -> list[str]:
    """Return the names that a notebook completes."""
    return sorted({*globals(), *__all__, "api"})

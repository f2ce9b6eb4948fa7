"""Explain how to convert laws of earlier role versions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from lambda_core.domain.plugin_errors import PluginError

if TYPE_CHECKING:
    from lambda_core.laws.law import Law

_GONE = ("model", "Model", "LazyModel", "default_par")


# What version 3 changed of roles; kernels of all others stay as they are.
_SINCE_2 = {
    "traction": "take the film as an array, h[i] in place of h",
    "film_thickness": "take cos2, the square of the cosine of the angle, in place of theta",
}


def new_form(item: Law) -> str:
    """Explain the present form of an old law.

    The law was written for an earlier version.
    """
    if item.role_api == 2:
        change = _SINCE_2.get(item.role)
        return f"{change}, and write role_api=3" if change else "its kernel stays as it is, write role_api=3"
    fields = list(item.parameters.model_fields)
    named = f", {item.parameters.__name__}" if fields else ""
    reads = f"read par.{fields[0]}" if fields else "read parameters"
    above = f'@law("{item.role}", "{item.name}"{named}, role_api=3, reference=...)'
    return f"write {above} above the kernel and {reads} by name, not by position"


def __getattr__(name: str) -> Any:
    """Explain the new form to old plugins.

    A plugin of version 1 imports `model`; other names do not exist.
    """
    if name in _GONE:
        raise PluginError(
            f"{name} belongs to version 1 of the role interface: "
            'write @law("traction", "my-law", Parameters, role_api=3, reference=...) above the kernel, '
            "and read par.limit_ratio by name, not by position"
        )
    raise AttributeError(f"module 'lambda_core.plugins' has no attribute '{name}'")

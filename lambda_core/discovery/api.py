"""Offer what other packages ask of installed plugins.

What stands behind a name is imported when the name is asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from lambda_core.domain.lazy_names import lazy_names

if TYPE_CHECKING:
    from lambda_core.discovery.apart import LIMIT, answer, check_apart, tried_apart
    from lambda_core.discovery.hookspecs import hookimpl
    from lambda_core.discovery.local_files import guests
    from lambda_core.discovery.manager import as_guests_of, built_in, registry, switch_off, use_plugin
    from lambda_core.discovery.packages import new_plugin, plugin_faults, plugin_model, plugin_parts, plugins
    from lambda_core.discovery.registry import Registry
    from lambda_core.discovery.shown import data_of, view_of
    from lambda_core.discovery.survey import (
        CheckCard,
        ModelCard,
        NoteCard,
        PartCard,
        Verdict,
        chosen_others,
        split_label,
    )

(_HOME,) = lazy_names(__file__)
__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    """Import what is asked for."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name]), name)

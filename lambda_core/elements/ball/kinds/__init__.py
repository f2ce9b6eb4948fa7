"""Collect the kinds of ball bearings.

Every module of this folder declares one as KIND.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

from lambda_core.elements.ball.ball_kind import BallKind


@cache
def kinds() -> Mapping[str, BallKind]:
    """Return every kind by name."""
    modules = (importlib.import_module(f"{__name__}.{found.name}") for found in pkgutil.iter_modules(__path__))
    return MappingProxyType({module.KIND.name: module.KIND for module in modules})


def kind_of(geometry: Mapping[str, Any]) -> BallKind:
    """Return the kind of a bearing from its geometry."""
    return next(kind for kind in kinds().values() if kind.belongs(geometry))


def written_kind(inline: Any, row: Any) -> BallKind | None:
    """Return the kind that a catalogue row or case names."""
    named = kinds().get(row.kind) if row is not None else None
    if named is not None and named.written is not None:
        return named
    return next((kind for kind in kinds().values() if kind.written is not None and kind.written(inline)), None)

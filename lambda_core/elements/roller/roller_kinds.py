"""Define kinds of roller bearings by their ribs."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

from lambda_core.elements.kind import LINE, RIB, BearingKind, ElementKind
from lambda_core.elements.roller.roller_bearing import RIBS

_TITLES = {"needle": "Needle roller bearing", "tapered": "Tapered roller bearing"}


@cache
def roller_kinds() -> Mapping[str, BearingKind]:
    """Return every kind by name."""
    return MappingProxyType({name: BearingKind(name, _TITLES.get(name, "Cylindrical roller bearing")) for name in RIBS})


ROLLER = ElementKind("roller", "rollers", (LINE, RIB), 11, roller_kinds)

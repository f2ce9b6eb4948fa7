"""Place values of bearings in their machine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from lambda_core.model.bearing_model import ResolvedValue


def placed_values(bearings: Mapping[str, Sequence[ResolvedValue]]) -> tuple[ResolvedValue, ...]:
    """Return the values of all bearings.

    Those that all have alike stand once, at the place of the machine's option. The others are at the place of their
    bearing, ``bearings.NAME``.

    Parameters
    ----------
    bearings : mapping of str to sequence of ResolvedValue
        By name, from left to right. A bearing without a machine has the name "" and keeps its paths.
    """
    if "" in bearings:
        return tuple(bearings[""])
    first, *others = ({value.path: value for value in values} for values in bearings.values())
    shared = {path for path, value in first.items() if all(other.get(path) == value for other in others)}
    found: dict[str, ResolvedValue] = {}
    for name, values in bearings.items():
        for value in values:
            section, _, option = value.path.partition(".")
            place = value.path
            if section in ("bearing", "bodies"):
                place = f"bearings.{name}.{option}"
            elif value.path not in shared:
                place = f"bearings.{name}.{value.path}"
            found.setdefault(place, replace(value, path=place))
    return tuple(found.values())

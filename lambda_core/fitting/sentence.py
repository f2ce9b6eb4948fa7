"""Say in one sentence what the data determine."""

from __future__ import annotations

import math
from collections.abc import Sequence

from lambda_core.fitting.least_squares import Fit

DETERMINED = 0.5  # share of a range that the interval of a parameter leaves at most, where the data determine it
UNCHANGED = 0.95  # share from which a 95 % interval says no more than the range, whose 95 % are as wide


def sentence(found: Fit) -> str:
    """Return what the data say about each parameter.

    Its 95 % interval is compared with its range: the data determine a parameter, narrow its range, or do not.
    """
    held = [found.parameters[index].name for index in found.held]
    free = [found.parameters[index].name for index in found.free]
    begin = f"The {found.data.values.size} measured values"
    if found.is_interrupted:
        return f"Interrupted: of {_list(free or held)} these are the best values so far."
    if not free and len(held) == 1:
        return f"{begin} do not determine {held[0]}, which keeps its start value."
    if not free:
        return f"{begin} determine none of the parameters {_list(held)}."
    clauses = [*_of_fitted(found), *([f"do not determine {_of_held(found, held)}"] if held else [])]
    return f"{begin} {'; they '.join(clauses)}."


def range_left(low: float, high: float, interval: tuple[float, float]) -> float:
    """Return the share of a range that an interval leaves.

    0 where the range has no ends.
    """
    inside = min(high, interval[1]) - max(low, interval[0])
    return inside / (high - low) if math.isfinite(high - low) else 0.0


def _of_fitted(found: Fit) -> list[str]:
    """Return a clause for each kind of fitted parameters."""
    determined: list[str] = []
    narrowed: list[str] = []
    unchanged: list[str] = []
    for index in found.free:
        parameter = found.parameters[index]
        left = range_left(parameter.low, parameter.high, found.interval(index))
        kind = determined if left <= DETERMINED else narrowed if left < UNCHANGED else unchanged
        kind.append(parameter.name)
    found_so = [f"determine {_list(determined)}"] if determined else []
    found_so += [f"narrow the {_range_of(narrowed)}"] if narrowed else []
    covers = "its 95 % interval covers it" if len(unchanged) == 1 else "their 95 % intervals cover them"
    return [*found_so, *([f"do not narrow the {_range_of(unchanged)}: {covers}"] if unchanged else [])]


def _of_held(found: Fit, held: Sequence[str]) -> str:
    """Return parameters that keep their start values, and why."""
    weak = next((d for d in reversed(found.directions) if not d.is_determined), None)
    partners = [name for name in (weak.weights if weak else {}) if name not in held]
    why = f"cannot be separated from {_list(partners)}" if partners else "has too small an effect"
    kept = f"{_list(held)}, which {'each ' if len(held) > 1 else ''}{why} and keeps its start value"
    this = "this value" if len(held) == 1 else "these values"
    return f"{kept}: intervals of {_list(partners)} hold for {this} only" if partners else kept


def _range_of(names: Sequence[str]) -> str:
    return f"{'range' if len(names) == 1 else 'ranges'} of {_list(names)}"


def _list(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"

"""Compute how far computed temperatures may be off.

Conductances to the surroundings have ranges and published alternatives, and losses err with their laws. What contacts
see follows the temperatures, and results follow what contacts see.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from lambda_core.analysis.band.effects import Effect
from lambda_core.analysis.band.graded import NetworkRange, network_ranges
from lambda_core.analysis.thermal.found_temperatures import FoundTemperatures
from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.time_limit import check_time

LOSS = "power loss"  # result by which laws and ranges move temperatures
GIVEN = ("lubricant.temperature",)  # its range is that of a temperature that is given
_OF_ONE_BEARING = ("bearing.", "surface.", "lubricant.")  # ranges that bearings of a machine do not share


class BearingEffects(Protocol):
    """Effects of ranges and exchanges on a bearing's results."""

    case: str
    names: tuple[str, ...]
    left_out: list[str]

    def all(self) -> Iterator[Effect]:
        """Yield the effects at given temperatures.

        They are those on logarithms of the results.
        """

    def by_seen(self) -> FloatArray:
        """Return slopes of the logarithms, shape (2, n).

        The slopes are by the temperature of the oil [1/K] and by the clearance [1/m].
        """

    def values_at_all_positions(self) -> FloatArray:
        """Return the results, averaged over all positions."""


def in_time(one: BearingEffects) -> Iterator[Effect]:
    """Yield effects up to the limit of wall time.

    Behind it a SolverError leaves the band out.
    """
    for effect in one.all():
        check_time(f"{one.case}: the model band")
        yield effect


@dataclass(frozen=True)
class _Shared:
    """One effect on bearings and on all temperatures.

    Attributes
    ----------
    effect : Effect
        With the alternatives of the temperatures of all nodes [K].
    results : mapping of int to float64[:, :]
        Alternatives of the results at given temperatures, by the number of the bearing.
    """

    effect: Effect
    results: Mapping[int, FloatArray]


def following(
    found: FoundTemperatures, each: Sequence[BearingEffects], labels: Sequence[str]
) -> tuple[list[list[Effect]], list[Effect]]:
    """Return the effects with temperatures that follow them.

    All are of first order.

    A range or a law moves the losses of all bearings that have it, these move the temperatures, and both move the
    results.

    Parameters
    ----------
    found : FoundTemperatures
        Of a bearing alone, or of a machine.
    each : sequence of BearingEffects
        Of every bearing, with :data:`LOSS` among the results and without the ranges :data:`GIVEN`.
    labels : sequence of str
        Names of the bearings; empty of one alone.

    Returns
    -------
    tuple of (list of list of Effect, list of Effect)
        Of the results of each bearing; of the temperatures of all nodes [K].
    """
    shared = [*_by_losses(found, each, labels), *_by_conductances(found)]
    rows = []
    for number, one in enumerate(each):
        slopes, own = one.by_seen(), []
        for part in shared:
            seen = np.array([found.seen(moved) for moved in part.effect.alternatives])[:, [number, len(each) + number]]
            fixed = part.results.get(number, np.zeros((1, len(one.names))))
            own.append(Effect(part.effect.name, part.effect.source, fixed + seen @ slopes, part.effect.is_range))
        rows.append(own)
    return rows, [part.effect for part in shared]


def _by_losses(found: FoundTemperatures, each: Sequence[BearingEffects], labels: Sequence[str]) -> Iterator[_Shared]:
    """Yield the effects of all bearings.

    Laws of the same name err together in all of them; those of balls and of rollers have other alternatives.
    """
    warming = found.by_loss()
    groups: dict[tuple[str, int], dict[int, Effect]] = {}
    for number, one in enumerate(each):
        for effect in in_time(one):
            is_own = effect.name.startswith(_OF_ONE_BEARING) and labels[number]
            name = f"{labels[number]}: {effect.name}" if is_own else effect.name
            groups.setdefault((name, len(effect.alternatives)), {})[number] = effect
    several = {name for name, times in Counter(name for name, _ in groups).items() if times > 1}
    for (name, count), members in groups.items():
        moved = np.zeros((count, len(found.names)))
        for number, effect in members.items():
            loss = effect.alternatives[:, each[number].names.index(LOSS)]
            moved += np.outer(loss, warming[:, number])
        first = next(iter(members.values()))
        whose = f"{name} of {', '.join(labels[number] for number in members)}" if name in several else name
        results = {number: effect.alternatives for number, effect in members.items()}
        yield _Shared(Effect(whose, first.source, moved, first.is_range), results)


def _by_conductances(found: FoundTemperatures) -> Iterator[_Shared]:
    """Yield the effects of conductances to the surroundings."""
    section = found.section
    for one in network_ranges(section):
        changes = [_with(one, value) for value in one.values(found.loop.usual_area)]
        moved = [found.by_network(change) for change in changes]
        if not one.is_range:
            moved = [np.zeros(len(found.names)), *moved]
        yield _Shared(Effect(f"thermal.{one.option}", one.source, np.array(moved), one.is_range), {})


def _with(one: NetworkRange, value: float | str) -> Callable[[Thermal], Thermal]:
    """Return what sets an option of the network.

    A bearing that has it of its own keeps it.
    """

    def change(section: Thermal) -> Thermal:
        is_given = one.is_range and one.option in section.model_fields_set
        return section if is_given else section.model_copy(update={one.option: value})

    return change

"""Read points of studies from runs.

A bearing that is alone has the empty name; those of a machine have names.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from lambda_core.analysis.electric.current_numbers import CurrentNumbers, circuit_numbers

if TYPE_CHECKING:
    from lambda_core.results.bearing_summary import BearingSummary
    from lambda_core.results.rating import Rating
    from lambda_core.results.reader import Result
    from lambda_core.results.summary import Summary


@dataclass
class DynamicPoint:
    """A dynamic point: a result and its summary.

    Attributes
    ----------
    result : Result
    summary : Summary or BearingSummary
        Of the run; of a bearing of a machine its own.
    machine : DynamicPoint or None
        The run of the machine that it belongs to.
    """

    result: Result
    summary: Summary | BearingSummary
    machine: DynamicPoint | None = None

    @property
    def rating(self) -> Rating | None:
        """Lives and safety at the start."""
        found: Rating | None = self.summary.rating
        return found

    @property
    def currents(self) -> CurrentNumbers:
        """Bearing currents on the films of the run."""
        return (self.machine or self).circuit[self.result.bearing]

    @cached_property
    def circuit(self) -> Mapping[str, CurrentNumbers]:
        """Bearing currents on the films of a run.

        Each bearing has its own.
        """
        return circuit_numbers(self.result)

    def bearing(self, name: str) -> DynamicPoint:
        """Return one bearing of a machine by its name.

        A bearing that is alone has the empty name.
        """
        if not name:
            return self
        return DynamicPoint(self.result.bearings[name], self.summary.bearings[name], self)  # type: ignore[union-attr]

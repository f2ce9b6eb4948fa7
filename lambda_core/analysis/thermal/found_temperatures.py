"""Tell how temperatures that were found answer to changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.analysis.thermal.feedback import Loop, Steady
from lambda_core.analysis.thermal.losses import Point
from lambda_core.analysis.thermal.machine_network import MachineNetwork
from lambda_core.case.thermal import Thermal
from lambda_core.domain.arrays import FloatArray

_STEP = 0.01  # of a loss, for slopes


@dataclass(frozen=True)
class FoundTemperatures:
    """Steady temperatures of a network with their loop.

    Answers are of first order: a change forces the temperatures while losses stay, and the loop of temperature and
    loss follows, dT = (1 - A B)^-1 dT_forced, with A = d(temperatures)/d(seen) and B = d(seen)/d(temperatures).

    Attributes
    ----------
    loop : Loop
        Of temperature and loss.
    steady : Steady
        What it found.
    """

    loop: Loop
    steady: Steady

    @property
    def section(self) -> Thermal:
        """Section of the case."""
        return self.loop.thermal

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the nodes."""
        return self.loop.nodes.names

    def by_loss(self) -> FloatArray:
        """Return slopes by each bearing's loss, shape (n, bearings).

        The slopes are by the logarithm of the loss [K].
        """
        points, columns = self.steady.points, []
        for number, point in enumerate(points):
            more = point.with_losses({name: (1.0 + _STEP) * value for name, value in point.losses.items()})
            moved = [more if i == number else one for i, one in enumerate(points)]
            columns.append(self._answered(moved, self.loop.nodes) / _STEP)
        return np.column_stack(columns)

    def by_network(self, change: Callable[[Thermal], Thermal]) -> FloatArray:
        """Return how far other conductances move temperatures [K].

        Parameters
        ----------
        change : callable
            Returns another section of the case, which has the same nodes.
        """
        return self._answered(self.steady.points, self.loop.nodes_with(change))

    def seen(self, moved: FloatArray) -> FloatArray:
        """Return how far what contacts see moves.

        See :meth:`Loop.seen`.
        """
        found: FloatArray = self.steady.inward @ moved
        return found

    def _answered(self, points: Sequence[Point], nodes: MachineNetwork) -> FloatArray:
        steady, temperatures = self.steady, self.steady.temperatures
        forced = self.loop.answer(points, temperatures, nodes)[0] - temperatures
        return np.asarray(np.linalg.solve(np.eye(forced.size) - steady.outward @ steady.inward, forced))

"""Time one integration in pieces and read its results."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from benchmarks.accuracy import Outcome, engine_totals
from benchmarks.timing import now, sum_of_minima
from lambda_core.domain.errors import SolverError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium

PIECES_PER_TURN = 1  # of the cage: long against the millisecond that a call from Python costs


@dataclass(frozen=True)
class Horizon:
    """Length of an integration.

    Cage revolutions to discard and to average.
    """

    discarded: float
    averaged: float

    def ends(self, turn: float) -> tuple[list[float], int]:
        """Return the ends of the pieces [s].

        And how many of them are discarded; `turn` is one cage revolution [s].
        """
        count = round(PIECES_PER_TURN * (self.discarded + self.averaged))
        ends = [turn * (k + 1) / PIECES_PER_TURN for k in range(count)]
        return ends, round(PIECES_PER_TURN * self.discarded)


@dataclass(frozen=True)
class Passage:
    """Cost and results of one integration."""

    pieces: tuple[float, ...]  # wall time of each [s]
    simulated: float  # [s]
    turns: float  # of the inner ring
    outcome: Outcome
    displacement: float  # of the inner ring downwards, mean since the start [m]
    statistics: dict[str, float]


def passage(model: BearingModel, start: Equilibrium, horizon: Horizon, *, samples: bool = True) -> Passage:
    """Integrate once from the equilibrium.

    As a run does: samples are turned into channels on the way.

    Raises
    ------
    SolverError
        When the integrator cannot go on.
    """
    engine = BearingEngine(model, equilibrium=start)
    ends, discarded = horizon.ends(2.0 * math.pi / abs(start.orbit))
    origin = first = engine_totals(engine)
    pieces = []
    for k, end in enumerate(ends):
        began = now()
        done = engine.advance(end)
        if samples:
            engine.samples()
        pieces.append(now() - began)
        if not done.ok:
            raise SolverError(f"{model.name}: {done.message}")
        if k + 1 == discarded:
            first = engine_totals(engine)
    last = engine_totals(engine)
    outcome = Outcome.of(origin, first, last)
    displacement = -engine.integrals()["z"] / last.time
    return Passage(
        tuple(pieces), last.time, abs(last.inner_angle) / (2.0 * math.pi), outcome, displacement, engine.statistics()
    )


def wall(repeats: Sequence[Passage]) -> float:
    """Return the wall time of one integration [s].

    From repeats of it.
    """
    return sum_of_minima([repeat.pieces for repeat in repeats])

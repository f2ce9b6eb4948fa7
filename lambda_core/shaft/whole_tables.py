"""Bearings of a machine in the tables and states of the whole."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lambda_core.shaft.machine_assembly import with_free_bodies
from lambda_core.solver.drivers.assembly import Assembly, BearingSpan
from lambda_core.solver.drivers.solver_context import SolverContext, assemble
from lambda_core.solver.drivers.tables import SIGNS, STATES
from lambda_core.system.machine import PLACES, Machine, MountedBearing

# State that each displacement of POSE moves, and its sign.
RING_STATES, RING_SIGNS = STATES[np.array(PLACES)], SIGNS[np.array(PLACES)]


@dataclass(frozen=True)
class Part:
    """Where a bearing stands in the tables and states of the whole, and how it is read alone."""

    bearing: MountedBearing
    alone: SolverContext
    span: BearingSpan

    @property
    def bodies(self) -> tuple[int, ...]:
        """Lump that carries the inner ring, outer ring, cage; then the waves of elastic ones."""
        return self.span.bodies

    @property
    def first_ball(self) -> int:
        """Among those of all bearings."""
        return self.span.first_ball

    @property
    def first_raceway(self) -> int:
        """Among those of all bearings."""
        return self.span.first_raceway

    @property
    def first_state(self) -> int:
        """Among what contacts keep."""
        return self.span.first_state

    @property
    def balls(self) -> int:
        """How many."""
        return self.span.balls


def all_free(found: SolverContext) -> SolverContext:
    """Return the context of the same bearing whose bodies are free in every direction."""
    return assemble(with_free_bodies(found.model), found.kernels, found.frame, found.oils)


def make_parts(model: Machine, assembly: Assembly, alone: list[SolverContext]) -> tuple[Part, ...]:
    """Give every bearing its places."""
    return tuple(map(Part, model.bearings, alone, assembly.spans()))

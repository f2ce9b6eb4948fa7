"""Estimate equilibrium, rating life and run time of a case."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

from pydantic import Field

from lambda_core.results.convergence import AVERAGED_AT_LEAST, DISCARDED_AT_LEAST
from lambda_core.results.quasistatic import QuasiStatic, quasistatic_of
from lambda_core.results.rating import Rating
from lambda_core.results.record import Record
from lambda_core.run.engineering import rating_of
from lambda_core.shaft.machine_equilibrium import MachineEquilibrium, equilibrium_of
from lambda_core.shaft.machine_modes import MachineModes, modes_of
from lambda_core.shaft.shaft_equilibrium import solve_shaft
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve
from lambda_core.system.bearing import BearingModel
from lambda_core.system.machine import Machine
from lambda_core.system.time_functions import initial
from lambda_core.views.method import Method

# Share of a cage turn that is simulated to see how fast it goes; the first steps are no slower than later ones.
_TRIAL = 0.05
_TRIAL_WALL = 2.0  # [s] longest trial; slow bearings do not get as far


class Estimate(Record):
    """Numbers for a case that is being set up; null where there is none."""

    equilibrium: QuasiStatic
    rating_life_h: float | None = Field(description="basic rating life L_10h (ISO 281)")
    viscosity_ratio: float | None = Field(description="kappa = nu/nu_1 (ISO 281)")
    rating: Rating = Field(description="life, safety and catalogue friction")
    simulated_s: float | None = Field(description="shortest simulated time of the run")
    run_s: float | None = Field(description="wall time of the run, from a trial of 1/20 cage turn on this machine")


class MachineEstimate(Record):
    """Numbers for a machine that is being set up."""

    equilibrium: MachineEquilibrium
    modes: MachineModes


def machine_estimate(model: Machine, announce: Callable[[str], None] | None = None) -> MachineEstimate:
    """Solve the equilibrium of a machine once and say what follows from it.

    Raises
    ------
    SolverError
        When there is no equilibrium.
    """
    state = solve_shaft(model, announce)
    return MachineEstimate(equilibrium=equilibrium_of(model, state), modes=modes_of(model, state))


def estimate(
    model: BearingModel, methods: Mapping[str, Method], announce: Callable[[str], None] | None = None
) -> Estimate:
    """Solve the equilibrium of a model and say what follows from it.

    Parameters
    ----------
    methods : mapping
        Installed comparison methods by name; the life comes from the one of ISO 281.

    Raises
    ------
    SolverError
        When there is no equilibrium.
    """
    found = solve(model, announce=announce)
    rating = rating_of(found, methods)
    simulated = _simulated_time(model, found)
    return Estimate(
        equilibrium=quasistatic_of(found),
        rating_life_h=rating.basic_life_h,
        viscosity_ratio=rating.viscosity_ratio,
        rating=rating,
        simulated_s=simulated,
        run_s=None if simulated is None else _wall_time(model, found, simulated, announce),
    )


def _cage_turn(model: BearingModel, found: Equilibrium) -> float:
    """Return the duration of one cage turn against the outer ring [s]; inf at rest."""
    speed = abs(found.orbit - initial(model.outer_ring.dofs["spin"].motion))
    return 2.0 * math.pi / speed if speed > 0.0 else math.inf


def _simulated_time(model: BearingModel, found: Equilibrium) -> float | None:
    solver = model.solver
    if solver.duration > 0.0:
        return solver.duration
    discard = max(DISCARDED_AT_LEAST, math.ceil(solver.discard_revolutions))
    turns = discard + max(AVERAGED_AT_LEAST, math.ceil(solver.average_revolutions))
    needed = min(turns * _cage_turn(model, found), solver.max_duration)
    return needed if math.isfinite(needed) else None


def _wall_time(
    model: BearingModel, found: Equilibrium, simulated: float, announce: Callable[[str], None] | None
) -> float | None:
    """Return the wall time of a run from that of its first moments, None where these cannot be computed."""
    engine = BearingEngine(model, announce, found)
    begin = time.perf_counter()
    advance = engine.advance(
        min(_TRIAL * _cage_turn(model, found), simulated), lambda: time.perf_counter() - begin > _TRIAL_WALL
    )
    spent = time.perf_counter() - begin
    return spent * simulated / engine.time if advance.ok and engine.time > 0.0 else None

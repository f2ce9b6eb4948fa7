"""Estimate a case before it is run."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass

from pydantic import Field

from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
from lambda_core.analysis.rotor.machine_modes import MachineModes
from lambda_core.model.bearing_model import BearingModel, Solver
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.machine_model import MachineModel
from lambda_core.results.answer import Answer
from lambda_core.results.convergence import AVERAGED_AT_LEAST, DISCARDED_AT_LEAST
from lambda_core.results.quasistatic import QuasiStatic
from lambda_core.runs.beginning import begin
from lambda_core.solver.drivers.dynamics import MotionEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium

# Share of a cage turn that is simulated to see how fast it goes; the first steps are no slower than later ones.
_TRIAL = 0.05
_TRIAL_WALL = 2.0  # [s] longest trial; slow bearings do not get as far


class Estimate(Answer):
    """Numbers for a case in preparation.

    Null where there is none.
    """

    equilibrium: QuasiStatic | MachineEquilibrium = Field(description="of one bearing or a machine, with its lives")
    modes: MachineModes | None = Field(description="of a machine; null of one bearing", default=None)
    simulated_s: float | None = Field(
        description="simulated time of the run: that of the case, or the shortest in which it can converge"
    )
    processor_s: float | None = Field(
        description="processor time of the run on this machine, from a trial; null where there is none"
    )
    basis: str = Field(description="what both times follow from")

    def text(self) -> str:
        """Return what a run takes, and what that follows from."""
        case = self.equilibrium.case
        if self.processor_s is None:
            return f"{case}: nothing is known of the time that a run takes\nbasis  {self.basis}"
        simulated = f"{self.simulated_s:.3g} s"
        return f"{case}: a run of {simulated} takes {_time(self.processor_s)} of processor time\nbasis  {self.basis}"

    def __repr__(self) -> str:
        """Return case and processor time."""
        return f"<Estimate {self.equilibrium.case}, {_time(self.processor_s)} of processor time>"


def _time(seconds: float | None) -> str:
    return "unknown" if seconds is None else f"{seconds:.2g} s" if seconds < 100.0 else f"{seconds / 60.0:.3g} min"


def estimate(model: BearingModel | MachineModel, announce: Callable[[str], None] | None = None) -> Estimate:
    """Solve a model once and estimate from it.

    Raises
    ------
    SolverError
        When there is no equilibrium.
    """
    begun = begin(model, announce)
    engine = MotionEngine(begun.motion, announce)
    each = list(zip(model.bearing_models.values(), begun.equilibria, strict=True))
    turn = max(_cage_turn(*one) for one in each)
    times = [_simulated_time(*one) for one in each]
    simulated = max(times, key=lambda time: math.inf if time is None else time)
    trial = None if simulated is None else _trial(engine, turn, simulated)
    return Estimate(
        equilibrium=begun.point.answer, modes=begun.point.modes, simulated_s=simulated,
        processor_s=None if trial is None else trial.seconds, basis=_basis(model, simulated, turn, trial),
    )  # fmt: skip


def _cage_turn(model: BearingModel, found: Equilibrium) -> float:
    """Return the duration of one cage turn [s].

    The cage turns against the outer ring; the result is inf at rest.
    """
    speed = abs(found.orbit - initial(model.outer_ring.dofs["spin"].motion))
    return 2.0 * math.pi / speed if speed > 0.0 else math.inf


def _simulated_time(model: BearingModel, found: Equilibrium) -> float | None:
    solver = model.solver
    if solver.duration > 0.0:
        return solver.duration
    needed = min(_turns(solver) * _cage_turn(model, found), solver.max_duration)
    return needed if math.isfinite(needed) else None


def _turns(solver: Solver) -> int:
    """Return the least cage turns of a run.

    It needs them to converge.
    """
    discard = max(DISCARDED_AT_LEAST, math.ceil(solver.discard_revolutions))
    return discard + max(AVERAGED_AT_LEAST, math.ceil(solver.average_revolutions))


@dataclass(frozen=True)
class _Trial:
    """First moments of a run.

    It has their simulated time [s], their processor time, and the simulated time of the run [s].
    """

    simulated: float
    spent: float
    seconds: float


def _trial(engine: MotionEngine, turn: float, simulated: float) -> _Trial | None:
    """Integrate the first moments of a run.

    None where these cannot be computed.
    """
    wall, begin = time.perf_counter(), time.process_time()
    advance = engine.advance(min(_TRIAL * turn, simulated), lambda: time.perf_counter() - wall > _TRIAL_WALL)
    spent = time.process_time() - begin
    if not advance.ok or not engine.time > 0.0:
        return None
    return _Trial(engine.time, spent, spent * simulated / engine.time)


def _basis(model: BearingModel | MachineModel, simulated: float | None, turn: float, trial: _Trial | None) -> str:
    """Say what an estimate follows from."""
    solver, each = model.solver, model.bearing_models.values()
    if simulated is None:
        return "nothing turns and the case has no solver.duration: a run has no end of its own"
    if trial is None:
        return "the first moments of a run could not be computed"
    if solver.duration > 0.0:
        end = "solver.duration of the case"
    elif simulated < _turns(solver) * turn:
        end = "solver.max_duration"
    else:
        slowest = "roller orbits" if all(one.full_complement for one in each) else "turns of the slowest cage"
        end = f"{_turns(solver)} {slowest}, the fewest after which a run can have converged"
    return f"{end}; a trial of {1e3 * trial.simulated:.3g} ms took {1e3 * trial.spent:.3g} ms on this machine"

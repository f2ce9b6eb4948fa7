"""Compare our integrator with CVODE on one model.

With its cage on a prescribed path a bearing has one trajectory, and two integrators must find the same. A free cage is
chaotic: single trajectories part, what agrees is the mean dissipated power, within the confidence intervals of both.

No bound can be narrower than the solvers' own errors. By the triangle inequality our power may lie off that of the
reference, CVODE at a hundredth of the tolerance, by what our own changes when its tolerance is a hundredth, too; by
what the two may differ there, 0.02 %; and by what the reference does not resolve, the absolute tolerance of its energy.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.loading import CARRYING
from lambda_core.results.answer import Answer
from lambda_core.results.averages import estimate, finite
from lambda_core.results.record import Record
from lambda_core.runs.beginning import begin
from lambda_core.runs.cvode import ENERGY, integrate
from lambda_core.solver.drivers.dynamics import MotionEngine, MotionStart
from lambda_core.solver.drivers.readings import MachineSamples

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel

_FINER = 1e-2  # tolerance of CVODE over ours where a trajectory is compared with a much finer one
_OUTPUTS = 20
# Cage turns that are simulated unless `solver.duration` says otherwise: on a fixed path, free.
_TURNS = (0.5, 9.0)
# Within which two integrators agree at a hundredth of the tolerance: of the power; in tolerances.
_POWER, _STATES = 2e-4, 10.0


class Integration(Record):
    """One integrator over the same stretch of time."""

    power_W: float = Field(description="dissipated energy over time")
    power_ci_W: float | None = Field(description="95 % half-width from blocks of one cage turn; null on a fixed path")
    calls: int = Field(description="of the right-hand side")
    jacobians: int


class CrossCheck(Answer):
    """Results of two integrators for one case."""

    case: str
    cage: str = Field(description='"locked" to its kinematic speed, or "free"')
    tolerance: float
    duration_s: float
    ours: Integration
    cvode: Integration = Field(description="at our tolerance")
    reference: Integration | None = Field(description="CVODE at a hundredth of our tolerance; null with a free cage")
    power_deviation: float = Field(description="our power over that of the reference (of CVODE: cage free), less 1")
    power_bound: float | None = Field(
        description="the change of our power with a hundredth of the tolerance, 0.02 % and what the reference resolves "
        "of the energy together; null with a free cage"
    )
    deviation: float | None = Field(
        description="largest distance of rings, cage and gripped balls or rollers from the reference's, root mean "
        "square over their states, in units of tolerance times scale; null with a free cage"
    )
    cvode_deviation: float | None = Field(
        description="the same distance of CVODE at our tolerance from the reference; null with a free cage"
    )
    drift: float | None = Field(
        description="the same of unloaded balls or rollers: nothing brings their azimuth back; "
        "null when there are none, and with a free cage"
    )
    agree: bool = Field(
        description="power at a hundredth of the tolerance within 0.02 %, states within 10 tolerances; cage free: "
        "power within the joint 95 % interval, or 0.02 %"
    )

    def text(self) -> str:
        """Return the lines for people."""
        head = f"{self.case}: cage {self.cage}, {1e3 * self.duration_s:.4g} ms, tolerance {self.tolerance:g}"
        rows = {"ours": self.ours, "CVODE": self.cvode, f"CVODE at {_FINER * self.tolerance:g}": self.reference}
        lines = [head, *(_line(name, row) for name, row in rows.items() if row is not None)]
        distances = {
            "rings, gripped elements": self.deviation,
            "the same of CVODE": self.cvode_deviation,
            "unloaded elements": self.drift,
        }
        for name, distance in distances.items():
            if distance is not None:
                lines.append(f"  {name:<25}{distance:.2f} tolerances apart at most")
        bound = "" if self.power_bound is None else f"  (at most {100.0 * self.power_bound:.4f} %)"
        lines.append(f"  {'dissipated power':<25}{100.0 * self.power_deviation:+.4f} %{bound}")
        return "\n".join([*lines, f"  the two {'agree' if self.agree else 'DO NOT AGREE'}"])


def _line(name: str, row: Integration) -> str:
    spread = f" +- {row.power_ci_W:.4f}" if row.power_ci_W is not None else ""
    return f"  {name:<25}{row.power_W:.4f}{spread} W  {row.calls} calls  {row.jacobians} Jacobians"


@dataclass(frozen=True)
class _Checked:
    """A bearing or a machine at its start."""

    name: str
    motion: MotionStart
    duration: float | None  # that the case asks for [s]
    orbit: float  # speed of the slowest cage [rad/s]

    @property
    def turn(self) -> float:
        """Time of one turn of the slowest cage [s]."""
        return 2.0 * math.pi / self.orbit


def cross_check(
    model: BearingModel | MachineModel, *, free_cage: bool = False, announce: Callable[[str], None] | None = None
) -> CrossCheck:
    """Integrate a model with both integrators and compare.

    Both start from the model's equilibrium.

    Parameters
    ----------
    model : BearingModel or MachineModel
        Its `solver.duration` is simulated; half a cage turn when there is none, nine with a free cage. Of a machine
        all bearings move with the shaft, and turns are those of the slowest cage.
    free_cage : bool
        Leave the cage free and compare mean powers over whole cage turns after the first.

    Raises
    ------
    UsageError
        When scikit-sundae is not installed.
    SolverError
        When either integrator cannot go on, the rings stand still, or a free cage makes less than three turns.
    """
    begun = _started(model, free_cage, announce)
    duration = begun.duration or _TURNS[free_cage] * begun.turn
    if free_cage:
        return _means(begun, int(duration / begun.turn + 1e-9))
    return _trajectories(begun, duration)


def _started(model: BearingModel | MachineModel, free_cage: bool, announce: Callable[[str], None] | None) -> _Checked:
    """Return a model at its start.

    Its cages are guided unless they are free.
    """
    begun = begin(model, announce, guides_cages=not free_cage)
    if all(found.relative_speed == 0.0 for found in begun.equilibria):
        raise SolverError("the rings stand still, so there is no power to compare: give operation.speed")
    orbit = min(abs(found.orbit) for found in begun.equilibria)
    return _Checked(model.name, begun.motion, model.solver.duration, orbit)


def _trajectories(begun: _Checked, duration: float) -> CrossCheck:
    tolerance, context = begun.motion.tolerance, begun.motion.context
    engine = MotionEngine(replace(begun.motion, sample_interval=duration / _OUTPUTS))
    _advanced(engine, duration)
    times, states = engine.buffered()
    gripped = np.concatenate([_gripped(load) for load in _inner_loads(engine.all_samples())], axis=1)
    lost, end = engine.spent()[0], engine.time
    grid = np.append(times[times < end], end)
    same, fine = (integrate(begun.motion, grid, tolerance * share) for share in (1.0, _FINER))
    unit = tolerance * context.scale
    apart, theirs = ((found - fine.states[:-1]) / unit for found in (states[: grid.size - 1], same.states[:-1]))
    held = np.ones(apart.shape, dtype=bool)
    table, tail = context.bundle.rows, int(context.bundle.system["tail"][0])
    held[:, :tail] = np.repeat(gripped[: grid.size - 1], np.repeat(table["size"], table["balls"]), axis=1)
    deviation = float(_distance(apart, held).max())
    power = fine.dissipated()[-1] / end
    rows = [
        Integration(power_W=run.dissipated()[-1] / end, power_ci_W=None, calls=run.evaluations, jacobians=run.jacobians)
        for run in (same, fine)
    ]
    off = float(lost / end / power - 1.0)
    bound, is_same_limit = _power_bound(begun.motion, end, lost, power * end)
    return CrossCheck(
        case=begun.name,
        cage="locked",
        tolerance=tolerance,
        duration_s=end,
        ours=_ours(engine, lost / end, math.nan),
        cvode=rows[0],
        reference=rows[1],
        power_deviation=off,
        power_bound=bound,
        deviation=deviation,
        cvode_deviation=float(_distance(theirs, held).max()),
        drift=None if held.all() else float(_distance(apart, ~held).max()),
        agree=is_same_limit and deviation < _STATES,
    )


def _power_bound(motion: MotionStart, end: float, lost: float, reference: float) -> tuple[float, bool]:
    """Return the allowed share of the energy difference.

    Our energy may differ from that of the reference [J] by it; also return whether both tend to one limit.

    See the head of this module.
    """
    finer = MotionEngine(replace(motion, tolerance=_FINER * motion.tolerance, sample_interval=end))
    _advanced(finer, end)
    energy = finer.spent()[0] * end / finer.time
    both = _POWER + _FINER * motion.tolerance * ENERGY / abs(reference)
    return float(both + abs(lost - energy) / abs(reference)), abs(energy / reference - 1.0) < both


def _inner_loads(samples: MachineSamples) -> list[FloatArray]:
    """Return the loads of the inner contacts [N].

    They belong to every bearing; the array has shape (time, ball).
    """
    return [channels["load"][:, :, RINGS.index("inner")] for channels in samples.bearings]


def _gripped(load: FloatArray) -> NDArray[np.bool_]:
    """Mark the balls that were always loaded.

    The inner ring loads them; the array has shape (time, ball), from the inner contacts' loads.
    """
    pressed = load > CARRYING * load.max(axis=1, keepdims=True)
    return np.asarray(np.logical_and.accumulate(pressed, axis=0))


def _distance(apart: FloatArray, chosen: NDArray[np.bool_]) -> FloatArray:
    """Return the rms of the chosen states.

    It holds at each time, and is 0 where there is none.
    """
    total: FloatArray = np.sqrt(np.sum(np.where(chosen, apart, 0.0) ** 2, axis=1) / np.maximum(chosen.sum(axis=1), 1))
    return total


def _means(begun: _Checked, turns: int) -> CrossCheck:
    turn, tolerance = begun.turn, begun.motion.tolerance
    if turns < 3:
        raise SolverError(
            f"the cage makes {turns} turns of {turn:.3g} s: at least 3 are needed for a confidence interval: take more"
        )
    times = turn * np.arange(turns + 1, dtype=np.float64)
    engine = MotionEngine(begun.motion)
    ours = [(0.0, 0.0)]
    for time in times[1:]:
        _advanced(engine, float(time))
        engine.forget_samples()
        ours.append((engine.time, engine.spent()[0]))
    run = integrate(begun.motion, times, tolerance)
    mine = np.diff([lost for _, lost in ours]) / np.diff([time for time, _ in ours])
    theirs = np.diff(run.dissipated()) / turn
    one, other = estimate(mine[1:]), estimate(theirs[1:])  # the first turn is the start's
    return CrossCheck(
        case=begun.name,
        cage="free",
        tolerance=tolerance,
        duration_s=float(times[-1]),
        ours=_ours(engine, one.mean, one.half_width),
        cvode=Integration(
            power_W=other.mean, power_ci_W=finite(other.half_width), calls=run.evaluations, jacobians=run.jacobians
        ),
        reference=None,
        power_deviation=one.mean / other.mean - 1.0,
        power_bound=None,
        deviation=None,
        cvode_deviation=None,
        drift=None,
        agree=abs(one.mean - other.mean) <= max(math.hypot(one.half_width, other.half_width), _POWER * other.mean),
    )


def _advanced(engine: MotionEngine, until: float) -> None:
    done = engine.advance(until)
    if not done.ok:
        raise SolverError(done.message)


def _ours(engine: MotionEngine, power: float, half_width: float) -> Integration:
    counters = engine.statistics()
    return Integration(
        power_W=power,
        power_ci_W=finite(half_width),
        calls=int(counters["rhs_calls"]),
        jacobians=int(counters["jacobians"]),
    )

"""Our integrator against CVODE: the same model from the same start, how far the two get from each other.

With its cage on a prescribed path a bearing has one trajectory, and two integrators must find the same. A free cage is
chaotic: single trajectories part, what agrees is the mean dissipated power, within the confidence intervals of both.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, RINGS
from lambda_core.domain.errors import SolverError
from lambda_core.formulas.loading import CARRYING
from lambda_core.model.bearing_model import BearingModel, DofState, TimeFunction
from lambda_core.results.averages import estimate, finite
from lambda_core.results.record import Record
from lambda_core.run.cvode import integrate
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

_FINER = 1e-2  # tolerance of CVODE over ours where a trajectory is compared with a much finer one
_OUTPUTS = 20
# Cage turns that are simulated unless `solver.duration` says otherwise: on a fixed path, free.
_TURNS = (0.5, 9.0)
_POWER, _STATES = 2e-4, 10.0  # within which two integrators agree: of the power; tolerances


class Integration(Record):
    """One integrator over the same stretch of time."""

    power_W: float = Field(description="dissipated energy over time")
    power_ci_W: float | None = Field(description="95 % half-width from blocks of one cage turn; null on a fixed path")
    calls: int = Field(description="of the right-hand side")
    jacobians: int


class CrossCheck(Record):
    """What two integrators make of one case."""

    case: str
    cage: str = Field(description='"locked" to its kinematic speed, or "free"')
    tolerance: float
    duration_s: float
    ours: Integration
    cvode: Integration = Field(description="at our tolerance")
    reference: Integration | None = Field(description="CVODE at a hundredth of our tolerance; null with a free cage")
    power_deviation: float = Field(description="our power over that of the reference (of CVODE: cage free), less 1")
    deviation: float | None = Field(
        description="largest distance of rings, cage and gripped balls from the reference's, root mean square over "
        "their states, in units of tolerance times scale; null with a free cage"
    )
    cvode_deviation: float | None = Field(
        description="the same distance of CVODE at our tolerance from the reference; null with a free cage"
    )
    drift: float | None = Field(
        description="the same of the unloaded balls: nothing brings their azimuth back; "
        "null when there are none, and with a free cage"
    )
    agree: bool = Field(
        description="power within 0.02 % and states within 10 tolerances; cage free: power within the joint 95 % "
        "interval, or 0.02 %"
    )

    def text(self) -> str:
        """Return the lines for people."""
        head = f"{self.case}: cage {self.cage}, {1e3 * self.duration_s:.4g} ms, tolerance {self.tolerance:g}"
        rows = {"ours": self.ours, "CVODE": self.cvode, f"CVODE at {_FINER * self.tolerance:g}": self.reference}
        lines = [head, *(_line(name, row) for name, row in rows.items() if row is not None)]
        distances = {
            "rings, gripped balls": self.deviation,
            "the same of CVODE": self.cvode_deviation,
            "unloaded balls": self.drift,
        }
        for name, distance in distances.items():
            if distance is not None:
                lines.append(f"  {name:<22}{distance:.2f} tolerances apart at most")
        lines.append(f"  {'dissipated power':<22}{100.0 * self.power_deviation:+.4f} %")
        return "\n".join([*lines, f"  the two {'agree' if self.agree else 'DO NOT AGREE'}"])


def _line(name: str, row: Integration) -> str:
    spread = f" +- {row.power_ci_W:.4f}" if row.power_ci_W is not None else ""
    return f"  {name:<22}{row.power_W:.4f}{spread} W  {row.calls} calls  {row.jacobians} Jacobians"


def with_locked_cage(model: BearingModel, start: Equilibrium) -> BearingModel:
    """Return the model with the cage on its kinematic path: centred, at the balls' mean orbital speed."""
    count = model.geometry.balls
    axial = float(np.mean(start.state[: L.NB * count].reshape(count, L.NB)[:, L.BX]))
    dofs = dict.fromkeys(model.cage_body.dofs, DofState("locked"))
    dofs["x"] = DofState("prescribed", TimeFunction.constant(axial))
    dofs["spin"] = DofState("prescribed", TimeFunction.constant(start.orbit))
    return replace(model, cage_body=replace(model.cage_body, dofs=dofs))


def cross_check(
    model: BearingModel, *, free_cage: bool = False, announce: Callable[[str], None] | None = None
) -> CrossCheck:
    """Integrate a model with both integrators from its equilibrium and compare.

    Parameters
    ----------
    model : BearingModel
        Its `solver.duration` is simulated; half a cage turn when there is none, nine with a free cage.
    free_cage : bool
        Leave the cage free and compare mean powers over whole cage turns after the first.

    Raises
    ------
    UsageError
        When scikit-sundae is not installed.
    SolverError
        When either integrator cannot go on, the rings stand still, or a free cage makes less than three turns.
    """
    start = solve(model, announce=announce)
    if start.relative_speed == 0.0:
        raise SolverError("the rings stand still: there is no power to compare")
    turn = 2.0 * math.pi / abs(start.orbit)
    duration = model.solver.duration or _TURNS[free_cage] * turn
    if free_cage:
        return _means(model, start, turn, int(duration / turn + 1e-9))
    led = with_locked_cage(model, start)
    return _trajectories(led, solve(led, announce=announce), duration)


def _trajectories(model: BearingModel, start: Equilibrium, duration: float) -> CrossCheck:
    tolerance = model.solver.tolerance
    outputs = replace(model.output, interval=duration / _OUTPUTS)
    engine = _advanced(BearingEngine(replace(model, output=outputs), equilibrium=start), duration)
    times, states = engine.buffered()
    gripped = _gripped(engine.samples()["load"][:, :, RINGS.index("inner")])
    lost, end = _lost(engine), engine.time
    grid = np.append(times[times < end], end)
    same, fine = (integrate(start, grid, tolerance * share) for share in (1.0, _FINER))
    unit = tolerance * start.context.scale
    apart, theirs = ((found - fine.states[:-1]) / unit for found in (states[: grid.size - 1], same.states[:-1]))
    held = np.ones(apart.shape, dtype=bool)
    held[:, : L.NB * gripped.shape[1]] = np.repeat(gripped[: grid.size - 1], L.NB, axis=1)
    deviation = float(_distance(apart, held).max())
    power = fine.dissipated()[-1] / end
    rows = [
        Integration(power_W=run.dissipated()[-1] / end, power_ci_W=None, calls=run.evaluations, jacobians=run.jacobians)
        for run in (same, fine)
    ]
    off = float(lost / end / power - 1.0)
    return CrossCheck(
        case=model.name,
        cage="locked",
        tolerance=tolerance,
        duration_s=end,
        ours=_ours(engine, lost / end, math.nan),
        cvode=rows[0],
        reference=rows[1],
        power_deviation=off,
        deviation=deviation,
        cvode_deviation=float(_distance(theirs, held).max()),
        drift=None if held.all() else float(_distance(apart, ~held).max()),
        agree=abs(off) < _POWER and deviation < _STATES,
    )


def _gripped(load: FloatArray) -> NDArray[np.bool_]:
    """Say which balls the inner ring has pressed all along, shape (time, ball), from the inner contacts' loads."""
    pressed = load > CARRYING * load.max(axis=1, keepdims=True)
    return np.asarray(np.logical_and.accumulate(pressed, axis=0))


def _distance(apart: FloatArray, chosen: NDArray[np.bool_]) -> FloatArray:
    """Return the root mean square over the chosen states at each time, 0 where there is none."""
    total: FloatArray = np.sqrt(np.sum(np.where(chosen, apart, 0.0) ** 2, axis=1) / np.maximum(chosen.sum(axis=1), 1))
    return total


def _means(model: BearingModel, start: Equilibrium, turn: float, turns: int) -> CrossCheck:
    if turns < 3:
        raise SolverError(
            f"the cage makes {turns} turns of {turn:.3g} s: at least 3 are needed for a confidence interval"
        )
    times = turn * np.arange(turns + 1, dtype=np.float64)
    engine = BearingEngine(model, equilibrium=start)
    ours = [(0.0, 0.0)]
    for time in times[1:]:
        _advanced(engine, float(time))
        ours.append((engine.time, _lost(engine)))
    run = integrate(start, times, model.solver.tolerance)
    mine = np.diff([lost for _, lost in ours]) / np.diff([time for time, _ in ours])
    theirs = np.diff(run.dissipated()) / turn
    one, other = estimate(mine[1:]), estimate(theirs[1:])  # the first turn is the start's
    return CrossCheck(
        case=model.name,
        cage="free",
        tolerance=model.solver.tolerance,
        duration_s=float(times[-1]),
        ours=_ours(engine, one.mean, one.half_width),
        cvode=Integration(
            power_W=other.mean, power_ci_W=finite(other.half_width), calls=run.evaluations, jacobians=run.jacobians
        ),
        reference=None,
        power_deviation=one.mean / other.mean - 1.0,
        deviation=None,
        cvode_deviation=None,
        drift=None,
        agree=abs(one.mean - other.mean) <= max(math.hypot(one.half_width, other.half_width), _POWER * other.mean),
    )


def _advanced(engine: BearingEngine, until: float) -> BearingEngine:
    done = engine.advance(until)
    if not done.ok:
        raise SolverError(done.message)
    return engine


def _lost(engine: BearingEngine) -> float:
    """Return the energy dissipated since the start [J]."""
    found = engine.integrals()
    return sum(found[f"loss.{name}"] for name in LOSSES)


def _ours(engine: BearingEngine, power: float, half_width: float) -> Integration:
    counters = engine.statistics()
    return Integration(
        power_W=power,
        power_ci_W=finite(half_width),
        calls=int(counters["rhs_calls"]),
        jacobians=int(counters["jacobians"]),
    )

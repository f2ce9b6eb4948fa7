"""Compare our integrator with CVODE and SciPy.

All use the same compiled right-hand side in one process.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from benchmarks import accuracy
from benchmarks.accuracy import Outcome, trajectory_totals
from benchmarks.cases import MIDDLE, with_tolerance, without_samples
from benchmarks.handle import Handle
from benchmarks.passage import Horizon, Passage, passage, wall
from benchmarks.speed import REFERENCE
from benchmarks.tables import Cell, Section, Table, Target
from benchmarks.timing import Effort, best, now
from lambda_core.domain.arrays import FloatArray
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver.drivers.dynamics import initial_state
from lambda_core.solver.drivers.equilibrium import Equilibrium, solve

FIRST_STEP = 1e-7  # [s]
_SMALLEST_RELATIVE = 1e-12  # errors are controlled on absolute scales; SciPy refuses 0
_MANY = 10_000_000


@dataclass(frozen=True)
class Trajectory:
    """Trajectory of an integrator.

    And how often it called back into Python.
    """

    times: FloatArray
    states: FloatArray
    evaluations: int
    jacobians: int


class Problem:
    """Initial value problem for other integrators.

    It counts their calls.
    """

    def __init__(self, model: BearingModel, start: Equilibrium, end: float) -> None:
        self.end = end
        self.max_step = model.solver.max_step
        self.scale = start.context.scale
        self.handle = Handle(start.context)
        self.initial = initial_state(start)
        self.evaluations = self.jacobians = 0

    def reset(self) -> None:
        """Start counting anew."""
        self.evaluations = self.jacobians = 0

    def slope(self, t: float, y: FloatArray, out: FloatArray) -> int:
        """Write dy/dt.

        Return 0, or 1 where a kernel refuses, as CVODE reads it.
        """
        self.evaluations += 1
        return 0 if self.handle.slope(t, y, out) == 1 else 1

    def jacobian(self, t: float, y: FloatArray, slope: FloatArray, out: FloatArray) -> int:
        """Write the dense Jacobian."""
        self.jacobians += 1
        return 0 if self.handle.jacobian(t, y, out) == 1 else 1

    def callback_cost(self) -> float:
        """Return the overhead of a call [s].

        From Python beyond the evaluation itself.
        """
        y, out, calls = self.initial, np.zeros_like(self.initial), 2000
        self.handle.settle_at(0.0, y, 1e-5)
        inside = best(lambda: self.handle.repeat_slope(calls, 0.0), 5) / calls
        outside = best(lambda: [self.slope(0.0, y, out) for _ in range(calls)], 5) / calls
        return max(outside - inside, 0.0)


def cvode(problem: Problem, tolerance: float, linear: str, *, own_jacobian: bool, order: int = 2) -> Trajectory:
    """Integrate with CVODE.

    BDF up to an order (ours has 2), every step kept.
    """
    from sksundae.cvode import CVODE

    options = {} if own_jacobian else {"jacfn": problem.jacobian}
    solver = CVODE(
        problem.slope,
        rtol=0.0,
        atol=tolerance * problem.scale,
        method="BDF",
        max_order=order,
        linsolver=linear,
        max_step=problem.max_step,
        first_step=FIRST_STEP,
        max_num_steps=_MANY,
        **options,
    )
    problem.reset()
    found = solver.solve(np.array([0.0, problem.end]), problem.initial)
    if not found.success:
        raise RuntimeError(f"CVODE: {found.message}")
    return Trajectory(found.t, found.y, problem.evaluations, problem.jacobians)


def scipy_integrator(problem: Problem, tolerance: float, method: str) -> Trajectory:
    """Integrate with SciPy, our Jacobian supplied."""
    from scipy import integrate

    solve_ivp: Any = integrate.solve_ivp  # its stubs know no Jacobian for every method

    size = problem.initial.size

    def slope(t: float, y: FloatArray) -> FloatArray:
        out = np.zeros(size)
        problem.slope(t, y, out)
        return out

    def jacobian(t: float, y: FloatArray) -> FloatArray:
        out = np.zeros((size, size))
        problem.jacobian(t, y, y, out)
        return out

    problem.reset()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that the relative tolerance is too small is meant
        found = solve_ivp(
            slope,
            (0.0, problem.end),
            problem.initial,
            method=method,
            jac=jacobian,
            rtol=_SMALLEST_RELATIVE,
            atol=tolerance * problem.scale,
            max_step=problem.max_step,
            first_step=FIRST_STEP,
        )
    if not found.success:
        raise RuntimeError(f"SciPy {method}: {found.message}")
    return Trajectory(found.t, np.ascontiguousarray(found.y.T), problem.evaluations, problem.jacobians)


@dataclass
class Contender:
    """An integrator at one setting, and what became of it."""

    name: str
    family: str
    tolerance: float
    work: Callable[[Problem, float], Trajectory]
    seconds: float = float("inf")
    found: Trajectory | None = None

    def go(self, problem: Problem) -> None:
        """Integrate once and keep the shortest time."""
        began = now()
        self.found = self.work(problem, self.tolerance)
        self.seconds = min(self.seconds, now() - began)


def contenders(effort: Effort) -> list[Contender]:
    """Return every integrator at the tolerances it is tried at."""
    kinds: list[tuple[str, str, Callable[[Problem, float], Trajectory], tuple[float, ...]]] = [
        ("SciPy Radau, our Jacobian", "scipy", lambda p, tol: scipy_integrator(p, tol, "Radau"), (1e-2, 1e-3)),
        ("SciPy LSODA, our Jacobian", "scipy", lambda p, tol: scipy_integrator(p, tol, "LSODA"), (1e-2, 1e-3)),
    ]
    try:
        import sksundae  # noqa: F401
    except ImportError:
        pass
    else:
        ladder = (1e-3,) if effort.quick else (1e-2, 1e-3, 3e-4, 1e-4)
        kinds += [
            (
                f"CVODE dense, up to order {order}, our Jacobian",
                "cvode",
                partial(cvode, linear="dense", own_jacobian=False, order=order),
                ladder,
            )
            for order in (3, 5)
        ]
        for linear in ("dense", "lapackdense"):
            kinds += [
                (
                    f"CVODE {linear}, our Jacobian",
                    "cvode",
                    lambda p, tol, linear=linear: cvode(p, tol, linear, own_jacobian=False),  # type: ignore[misc]
                    ladder,
                ),
                (
                    f"CVODE {linear}, its own Jacobian",
                    "cvode-own",
                    lambda p, tol, linear=linear: cvode(p, tol, linear, own_jacobian=True),  # type: ignore[misc]
                    ladder,
                ),
            ]
    return [Contender(name, family, tol, work) for name, family, work, tols in kinds for tol in tols]


def measure(effort: Effort) -> Section:
    """Integrate the same problem with every integrator, repeats interleaved."""
    model = without_samples(MIDDLE.model())
    start = solve(model)
    horizon = Horizon(0.0, effort.pick(1, 2))
    reference = passage(with_tolerance(model, REFERENCE), start, horizon, samples=False)
    problem = Problem(model, start, reference.simulated)
    ladder = (1e-3,) if effort.quick else (1e-2, 1e-3, 3e-4, 1e-4)
    own: dict[float, list[Passage]] = {tolerance: [] for tolerance in ladder}
    others = contenders(effort)
    for repeat in range(effort.repeats):
        for tolerance in ladder:
            own[tolerance].append(passage(with_tolerance(model, tolerance), start, horizon, samples=False))
        for other in others:
            if repeat == 0 or other.family != "scipy":
                other.go(problem)
    callback = problem.callback_cost()
    rows: list[tuple[Cell, ...]] = []
    fastest: dict[str, float] = {}
    for tolerance, repeats in own.items():
        one = repeats[0]
        seconds, steps = wall(repeats) / one.simulated, one.statistics["steps"] / one.simulated
        rows.append(_row("ours", tolerance, steps, seconds, seconds, one.outcome, reference.outcome))
        _keep(fastest, "ours", seconds, one.outcome, reference.outcome)
    for other in others:
        assert other.found is not None
        totals = trajectory_totals(problem.handle, other.found.times, other.found.states, (0.0, problem.end))
        outcome = Outcome.of(totals[0], totals[0], totals[1])
        seconds = other.seconds / problem.end
        net = seconds - callback * (other.found.evaluations + other.found.jacobians) / problem.end
        steps = (other.found.times.size - 1) / problem.end
        rows.append(_row(other.name, other.tolerance, steps, seconds, net, outcome, reference.outcome))
        _keep(fastest, other.family, net, outcome, reference.outcome)
    table = Table(
        f"Integrators on the same right-hand side, {MIDDLE.name}",
        ("integrator", "tolerance", "steps/s", "wall s/s", "less callbacks s/s", *accuracy.COLUMNS),
        tuple(rows),
        (
            f"{horizon.averaged:g} cage revolutions from the quasi-static equilibrium, {problem.initial.size} states, "
            "the same absolute scales, longest and first step for all; CVODE up to order 2 unless stated otherwise. "
            f"Others call back through Python: what that costs ({1e6 * callback:.1f} us a call) is taken off in the "
            "fifth column, and the targets compare with that. Their losses are integrated over their own steps after "
            "the timing.",
        ),
    )
    return Section("integrators", (table,), _targets(fastest))


def _row(
    name: str, tolerance: float, steps: float, seconds: float, net: float, outcome: Outcome, reference: Outcome
) -> tuple[Cell, ...]:
    return (name, f"{tolerance:.0e}", steps, seconds, net, *outcome.cells(reference))


def _keep(fastest: dict[str, float], family: str, seconds: float, outcome: Outcome, reference: Outcome) -> None:
    if outcome.good(reference):
        fastest[family] = min(seconds, fastest.get(family, float("inf")))


def _targets(fastest: dict[str, float]) -> tuple[Target, ...]:
    """Compare the fastest accurate settings."""
    limits = {"cvode": ("CVODE with our Jacobian", 1.3, 3.0), "cvode-own": ("CVODE with its own Jacobian", 3.0, None)}
    if "ours" not in fastest:
        return ()
    return tuple(
        Target(f"faster than {name}", "times", fastest[family] / fastest["ours"], must, goal, at_least=True)
        for family, (name, must, goal) in limits.items()
        if family in fastest
    )

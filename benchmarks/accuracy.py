"""Compare integrations with tight references of the same run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from benchmarks.handle import FloatArray as FloatArray
from benchmarks.handle import Handle
from lambda_core.domain.channels import LOSSES
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers import tables
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.observation import observe
from lambda_core.solver.drivers.solver_context import SolverContext

# How close a run has to come to the reference to count, and how well its energy has to balance.
RACEWAY, CAGE, ENERGY = 5e-3, 1e-3, 1e-3
_RACEWAYS = LOSSES.index("pocket")  # losses before this one are those of the raceways


@dataclass(frozen=True)
class Totals:
    """Running integrals from t = 0, SI."""

    time: float
    raceway: float  # energy dissipated in the raceways [J]
    dissipated: float  # by everything [J]
    cage_angle: float
    inner_angle: float
    input: float
    input_abs: float
    stored: float

    @staticmethod
    def of(time: float, integrals: Mapping[str, float]) -> Totals:
        """Return the totals of an engine."""
        losses = [*(integrals[f"loss.{name}"] for name in LOSSES), integrals["support"]]
        names = ("cage_angle", "inner_angle", "input", "input_abs", "stored")
        return Totals(time, sum(losses[:_RACEWAYS]), sum(losses), *(integrals[name] for name in names))


@dataclass(frozen=True)
class Outcome:
    """The numbers that integrations are compared by."""

    raceway_power: float  # mean [W]
    cage_ratio: float  # mean cage speed over inner ring speed
    energy_residual: float  # of the whole run, over the integral of the absolute input power

    @staticmethod
    def of(start: Totals, first: Totals, last: Totals) -> Outcome:
        """Return means and the energy balance.

        Means from `first` to `last`, the balance since `start`.
        """
        power = (last.raceway - first.raceway) / (last.time - first.time)
        turned = last.inner_angle - first.inner_angle
        missing = (last.input - start.input) - (last.dissipated - start.dissipated) - (last.stored - start.stored)
        return Outcome(
            power, (last.cage_angle - first.cage_angle) / turned, missing / (last.input_abs - start.input_abs)
        )

    def raceway_error(self, reference: Outcome) -> float:
        """Return the relative error of the raceway dissipation."""
        return abs(self.raceway_power / reference.raceway_power - 1.0)

    def cage_error(self, reference: Outcome) -> float:
        """Return the relative error of the cage speed."""
        return abs(self.cage_ratio / reference.cage_ratio - 1.0)

    def good(self, reference: Outcome) -> bool:
        """Tell whether the run is accurate enough.

        The accuracy is the requested one.
        """
        return (
            self.raceway_error(reference) <= RACEWAY
            and self.cage_error(reference) <= CAGE
            and abs(self.energy_residual) <= ENERGY
        )

    def cells(self, reference: Outcome | None) -> tuple[float | None, float | None, float, str]:
        """Return errors [%], energy residual and verdict.

        As COLUMNS names them.
        """
        if reference is None:
            return None, None, self.energy_residual, ""
        errors = 100.0 * self.raceway_error(reference), 100.0 * self.cage_error(reference)
        return *errors, self.energy_residual, "yes" if self.good(reference) else "no"


COLUMNS = ("raceway loss, error %", "cage speed, error %", "energy residual", "accurate")


def engine_totals(engine: BearingEngine) -> Totals:
    """Return the running integrals of an engine now."""
    return Totals.of(engine.time, engine.integrals())


def trajectory_totals(handle: Handle, times: FloatArray, states: FloatArray, at: tuple[float, ...]) -> list[Totals]:
    """Return totals of a stored trajectory.

    Integrated by the trapezoidal rule over its own steps.

    Parameters
    ----------
    times : float64[:], shape (n,)
    states : float64[:, :], shape (n, size)
    at : tuple of float
        Times [s]; the first step at or after each is taken.
    """
    rates = handle.rates(times, states)
    running = np.zeros_like(rates)
    running[1:] = np.cumsum(0.5 * np.diff(times)[:, None] * (rates[1:] + rates[:-1]), axis=0)
    powers = tables.running(running)
    picked = [min(int(np.searchsorted(times, t - 1e-12)), times.size - 1) for t in at]
    stored = observe(core(), handle.context, times[picked], np.ascontiguousarray(states[picked]))["stored_energy"]
    angles = [_angles(handle.context, times[k], states[k]) for k in picked]
    return [
        Totals(
            float(times[k]),
            float(running[k, :_RACEWAYS].sum()),
            float(running[k, : -L.NOT_DISSIPATED].sum()),
            *angles[i],
            float(powers["input"][k]),
            float(powers["input_abs"][k]),
            float(stored[i]),
        )
        for i, k in enumerate(picked)
    ]


def _angles(context: SolverContext, t: float, y: FloatArray) -> tuple[float, float]:
    """Return cage and inner ring angle [rad].

    Relative to the outer ring.
    """
    channels = observe(core(), context, np.array([t]), np.ascontiguousarray(y).reshape(1, -1))
    inner, outer, cage = (float(angle) for angle in channels["body_spin_angle"][0])
    if not context.model.depth.cage:
        cage = float(np.mean(channels["ball_azimuth"][0]))
    return cage - outer, inner - outer

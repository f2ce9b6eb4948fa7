"""Compute velocities of balls along their paths.

Axial and radial, in addition to the orbital speed, where loads differ.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import EquilibriumError
from lambda_core.domain.log_sentences import SOLVER
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.drivers.viscosity_continuation import StaticReport

log = logging.getLogger(SOLVER)

PATH_ITERATIONS = 20
PATH_SHARE = 0.5  # of the remaining difference between paths and velocities, where differences before foretell it
_MEMORY = 2  # steps of the iteration that are combined, as in source/start.c of the units
_STEPS = (1.0, 0.5, 0.25)  # shares of a step along the paths that are tried
PATH_TOLERANCE = 0.05  # of the largest axial velocity
NO_PATH = 1e-6  # of rolling
Driven = NDArray[np.int64]  # 1 for balls that the cage drives
# Solves for the equilibrium from a state, in place, and returns its report. Which balls the cage drives is given, or
# decided at the state.
Solve = Callable[[FloatArray, Driven | None], StaticReport]


class _Stage(NamedTuple):
    """An equilibrium on the way, and the velocities it has."""

    state: FloatArray
    moving: FloatArray
    off: FloatArray  # of the paths from these velocities
    driven: Driven
    report: StaticReport


def follow_paths(
    context: SolverContext,
    state: FloatArray,
    report: StaticReport,
    solve: Solve,
    driven_at: Callable[[FloatArray], Driven],
) -> StaticReport:
    """Move balls along their paths.

    They move axially and radially; the friction's equilibrium is then found again, in place.

    A ball that is carried across the grooves while it goes round drags the rings sideways where it slips; at rest it
    would drag them twice as much. Under a radial or an axial load alone there is no axial path and nothing to do. The
    sphere of a self-aligning outer ring gives a ball no place of its own along the shaft: friction holds it where it
    is; so it does rollers. The iteration is the mixing of D. G. Anderson (1965, J. ACM 12, 547) in the form of H. F.
    Walker and P. Ni (2011, SIAM J. Numer. Anal. 49, 1715, eq. 2.2 and 2.3): steps of a fixed share diverge at low speed
    where few balls carry. Where no equilibrium follows a step of the iteration, the last one stands. Where velocities
    and paths still differ by more than PATH_TOLERANCE, a warning in the log says so.

    Which balls the cage drives is decided anew with every step. A ball may carry too little to hold itself while it
    does so, and enough once the cage drives it: then the steps alternate between two motions. The iteration goes on in
    the first of them, in which that ball is as it was decided before.

    Parameters
    ----------
    state : float64[:], shape (size,)
        The friction's equilibrium of balls without such velocities.
    report : StaticReport
        Of the search for it; returned where nothing is to be done.
    solve : callable
        Finds the equilibrium from a state, in place; raises EquilibriumError where it finds none.
    driven_at : callable
        Returns the balls that the cage would drive in a search from a state.
    """
    g = context.model.geometry
    if g.kind.on_sphere or context.model.rollers is not None:
        return report
    balls = L.elements_in(context.bundle, state)
    rolling = float(np.abs(balls["velocity"][:, 2]).max())
    moving = np.zeros((balls.size, 2))
    stages: list[_Stage] = []
    held: Driven | None = None
    for _ in range(PATH_ITERATIONS):
        aim = np.concatenate([path_velocities(row) for row in np.split(balls, g.rows)])
        across = float(np.abs(aim[:, 0]).max())
        change = float(np.abs(aim - moving)[:, 0].max())
        if across <= NO_PATH * rolling or change <= PATH_TOLERANCE * across:
            return report
        stages.append(_Stage(state.copy(), moving.copy(), aim - moving, context.driven.copy(), report))
        if held is None and (first := _first_of_alternating(stages, driven_at(state))) is not None:
            stages, held = [first], first.driven
            state[:], moving, report = first.state, first.moving.copy(), first.report
            context.driven[:] = held
        taken = _step_along(context.bundle, state, moving, _mixed(stages), solve, held)
        if taken is None:
            break
        report, done = taken
        moving += done
    log.warning(
        "the axial velocities of the balls deviate from their paths by %.0f %% of the largest velocity "
        "(more than %g %%): the friction torque of this equilibrium is less accurate",
        100.0 * change / across,
        100.0 * PATH_TOLERANCE,
    )
    return report


def _first_of_alternating(stages: list[_Stage], now: Driven) -> _Stage | None:
    """Return the stage to go on from where two alternate.

    `now` are the balls that the cage would drive in the next step. All steps, an even number, would end in the motion
    of stages with an even number.
    """
    if len(stages) < 2 or (now == stages[-1].driven).all() or (now != stages[-2].driven).any():
        return None
    return stages[-1] if len(stages) % 2 else stages[-2]


def _mixed(stages: list[_Stage]) -> FloatArray:
    """Return the fixed-point iteration's next step.

    It follows from its points and from their distances to the fixed point's map.

    The combination of the last differences that is least foretells where they vanish.
    """
    latest = stages[-1].off
    if len(stages) == 1:
        return latest
    recent = stages[-_MEMORY - 1 :]
    moved, changed = (
        np.diff([one.ravel() for one in each], axis=0).T
        for each in ([stage.moving for stage in recent], [stage.off for stage in recent])
    )
    weights = np.linalg.lstsq(changed, latest.ravel(), rcond=None)[0]
    step: FloatArray = PATH_SHARE * latest - ((moved + PATH_SHARE * changed) @ weights).reshape(latest.shape)
    return step


def _step_along(
    bundle: L.Bundle, state: FloatArray, moving: FloatArray, step: FloatArray, solve: Solve, held: Driven | None
) -> tuple[StaticReport, FloatArray] | None:
    """Change the balls' axial and radial velocities.

    They change by a step or a part of it; find the equilibrium, in place.

    Returns the report and the part; None, and the state as it was, where no equilibrium follows.
    """
    for share in _STEPS:
        trial, part = state.copy(), share * step
        L.elements_in(bundle, trial)["velocity"][:, :2] = moving + part
        try:
            report = solve(trial, held)
        except EquilibriumError:
            continue
        state[:] = trial
        return report, part
    return None


def path_velocities(balls: NDArray[Any]) -> FloatArray:
    """Return each ball's axial and radial velocity.

    The ball belongs to a row; the places of its neighbours give the velocity.

    In steady running every ball comes by where its neighbour is now, so that place is a function of azimuth, x(psi),
    and dx/dt = omega dx/dpsi. The balls of a row are evenly spaced: the derivative is that of the trigonometric
    polynomial through them.

    Parameters
    ----------
    balls : records.BALL[:], shape (Z,)
        One row, by azimuth.

    Returns
    -------
    float64[:, :], shape (Z, 2)
        Axial, radial [m/s].
    """
    orbit = balls["velocity"][:, 2] / balls["radius"]
    return np.stack([orbit * _slope(balls["x"]), orbit * _slope(balls["radius"])], axis=1)


def _slope(values: FloatArray) -> FloatArray:
    """Return the derivative with respect to azimuth.

    The values are known at evenly spaced azimuths.
    """
    waves = np.fft.rfft(values)
    order = np.arange(waves.size)
    if values.size % 2 == 0:
        order[-1] = 0  # the shortest wave has its extremes at the balls
    slope: FloatArray = np.fft.irfft(1j * order * waves, values.size)
    return slope

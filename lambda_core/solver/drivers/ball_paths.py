"""Compute velocities of balls along their paths.

Axial and radial, in addition to the orbital speed, where loads differ.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Any

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
_SAME = 0.02  # by which two differences agree of an iteration that goes to and fro
# Solves for the equilibrium from a state, in place, and returns its report.
Solve = Callable[[FloatArray], StaticReport]


def follow_paths(context: SolverContext, state: FloatArray, report: StaticReport, solve: Solve) -> StaticReport:
    """Move balls along their paths.

    They move axially and radially; the friction's equilibrium is then found again, in place.

    A ball that is carried across the grooves while it goes round drags the rings sideways where it slips; at rest it
    would drag them twice as much. Under a radial or an axial load alone there is no axial path and nothing to do. The
    sphere of a self-aligning outer ring gives a ball no place of its own along the shaft: friction holds it where it
    is; so it does rollers. The iteration is the mixing of D. G. Anderson (1965, J. ACM 12, 547) in the form of H. F.
    Walker and P. Ni (2011, SIAM J. Numer. Anal. 49, 1715, eq. 2.2 and 2.3): steps of a fixed share diverge at low speed
    where few balls carry. Where no equilibrium follows a step of the iteration, the last one stands. Where friction
    turns about with every step, it goes to and fro between two states and ends in the one that all steps end in. Where
    velocities and paths still differ by more than PATH_TOLERANCE, a warning in the log says so.

    Parameters
    ----------
    state : float64[:], shape (size,)
        The friction's equilibrium of balls without such velocities.
    report : StaticReport
        Of the search for it; returned where nothing is to be done.
    solve : callable
        Finds the equilibrium from a state, in place; raises EquilibriumError where it finds none.
    """
    g = context.model.geometry
    if g.kind.on_sphere or context.model.rollers is not None:
        return report
    balls = L.elements_in(context.bundle, state)
    rolling = float(np.abs(balls["velocity"][:, 2]).max())
    moving = np.zeros((balls.size, 2))
    points: list[FloatArray] = []
    differences: list[FloatArray] = []
    sizes: list[float] = []
    for number in range(PATH_ITERATIONS):
        aim = np.concatenate([path_velocities(row) for row in np.split(balls, g.rows)])
        across = float(np.abs(aim[:, 0]).max())
        change = float(np.abs(aim - moving)[:, 0].max())
        if across <= NO_PATH * rolling or change <= PATH_TOLERANCE * across:
            return report
        sizes.append(change / across)
        if (PATH_ITERATIONS - number) % 2 == 0 and _goes_to_and_fro(sizes):
            break
        points.append(moving.copy())
        differences.append(aim - moving)
        taken = _step_along(context.bundle, state, moving, _mixed(points, differences), solve)
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


def _goes_to_and_fro(sizes: list[float]) -> bool:
    """Tell whether differences repeat those of two steps before."""
    latest, before = sizes[-2:], sizes[-4:-2]
    return len(before) == len(latest) and all(
        abs(now - then) <= _SAME * now for now, then in zip(latest, before, strict=True)
    )


def _mixed(points: list[FloatArray], differences: list[FloatArray]) -> FloatArray:
    """Return the fixed-point iteration's next step.

    It follows from its points and from their distances to the fixed point's map.

    The combination of the last differences that is least foretells where they vanish.
    """
    latest = differences[-1]
    if len(points) == 1:
        return latest
    moved, changed = (
        np.diff([one.ravel() for one in each[-_MEMORY - 1 :]], axis=0).T for each in (points, differences)
    )
    weights = np.linalg.lstsq(changed, latest.ravel(), rcond=None)[0]
    step: FloatArray = PATH_SHARE * latest - ((moved + PATH_SHARE * changed) @ weights).reshape(latest.shape)
    return step


def _step_along(
    bundle: L.Bundle, state: FloatArray, moving: FloatArray, step: FloatArray, solve: Solve
) -> tuple[StaticReport, FloatArray] | None:
    """Change the balls' axial and radial velocities.

    They change by a step or a part of it; find the equilibrium, in place.

    Returns the report and the part; None, and the state as it was, where no equilibrium follows.
    """
    for share in _STEPS:
        trial, part = state.copy(), share * step
        L.elements_in(bundle, trial)["velocity"][:, :2] = moving + part
        try:
            report = solve(trial)
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

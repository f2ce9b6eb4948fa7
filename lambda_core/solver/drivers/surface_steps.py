"""Limit time steps by the shortest surface feature."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.model.laws.law_context import max_speed
from lambda_core.solver.drivers.law_inputs import RACEWAYS
from lambda_core.solver.drivers.solver_context import SolverContext

_PLACES = 20_000  # azimuths at which a surface is looked at: 20 um apart on a raceway of 130 mm
_STEPS = 4.0  # per length over which the surface changes, 25 per wave
_COUNTS = 0.01  # share of the steepest slope from which on a single harmonic has to be resolved


def longest_step(context: SolverContext) -> float:
    """Return the longest step for surfaces [s].

    It resolves the raceways' surfaces; inf for nominal raceways.

    The length over which a surface changes is its height over its slope: 1/k of a radian for k waves, and 1/k of every
    harmonic that has 1 % of the slope, for a short wave on a long one. Balls pass it with the speed of the cage
    relative to the ring, at most (1 + D_w/d_m)/2 of the highest planned speed.
    """
    model = context.model
    ratio = model.geometry.ball_diameter / model.geometry.pitch_diameter
    longest = math.inf
    for i, element in enumerate(RACEWAYS):
        if context.raceway(element)["surface_on"] == 0:
            continue
        passing = 0.5 * (1.0 + (ratio if i == 0 else -ratio)) * max_speed(model)
        width = _shortest(context, element, context.frame.angles[i])
        if passing > 0.0:
            longest = min(longest, width / (_STEPS * passing))
    return longest


def _shortest(context: SolverContext, element: str, angle: float) -> float:
    """Return the shortest angle of a surface [rad].

    The surface, or one of its harmonics, changes over it; it is inf where the surface is flat.
    """
    law = context.kernels.compiled[element, "surface"].dispatcher
    par = context.parameters(element, "surface")
    found = np.zeros((_PLACES, 3))
    for azimuth, out in zip(np.linspace(-math.pi, math.pi, _PLACES), found, strict=True):
        law(azimuth, angle, par, out)
    steepest = float(np.abs(found[:, 1]).max())
    if steepest == 0.0:
        return math.inf
    slopes = 2.0 / (_PLACES - 1) * np.abs(np.fft.rfft(found[:-1, 1]))
    orders = np.flatnonzero(slopes[1:] > _COUNTS * steepest) + 1
    return float(min(0.5 * np.ptp(found[:, 0]) / steepest, 1.0 / max(orders, default=1)))

"""Provide the 6208 of the paper under axial load.

Syla et al. 2026, table 6: reference equilibrium.
"""

from __future__ import annotations

import math

from lambda_core.formulas.hertz import ball_raceway_radii, reduced_modulus, stiffness_constant
from lambda_core.formulas.kinematics import cage_speed

from .reference import AxialEquilibrium, axial_equilibrium

STEEL = reduced_modulus(210e9, 0.3, 210e9, 0.3)

BALL, PITCH, INNER, OUTER = 11.91e-3, 60e-3, 6.19e-3, 6.31e-3
CLEARANCE = 71.917e-3 - 48.083e-3 - 2.0 * BALL
SPEED = 2750.0 * math.pi / 30.0


def axial_6208(axial_load: float, *, running: bool) -> AxialEquilibrium:
    """Return the equilibrium of an axial load.

    Radii are frozen at the angles found (fixed-point).
    """
    angles = (0.25, 0.25)
    mass = math.pi / 6.0 * BALL**3 * 7850.0
    for _ in range(30):
        stiffness = tuple(
            stiffness_constant(*ball_raceway_radii(BALL, PITCH, groove, angle, inner=inner), STEEL)
            for groove, angle, inner in ((INNER, angles[0], True), (OUTER, angles[1], False))
        )
        orbit = cage_speed(SPEED, 0.0, BALL * math.cos(0.5 * sum(angles)) / PITCH)
        force = mass * 0.5 * PITCH * orbit**2 if running else 0.0
        result = axial_equilibrium(
            axial_load, 9, (INNER - BALL / 2, OUTER - BALL / 2), CLEARANCE, (stiffness[0], stiffness[1]), force
        )
        angles = (result.angle_inner, result.angle_outer)
    return result

"""Compute the capacitance of a gap between ball and raceway.

Plain Python, compiled with the code that calls it.
"""

from __future__ import annotations

import math

VACUUM_PERMITTIVITY = 8.8541878128e-12  # [F/m], CODATA 2018


def gap_capacitance(gap: float, radius_x: float, radius_y: float, ball_radius: float) -> float:
    """Return the capacitance [F] of ball and raceway.

    They are `gap` [m] apart, in vacuum.

    Plates in each element (Derjaguin 1934): dA/(h + x^2/(2 R_x) + y^2/(2 R_y)) over the ball's projection, in closed
    form 4 pi sqrt(R_x R_y) ln{[sqrt(h_x/R_y) + sqrt(h_y/R_x)]/[sqrt(h/R_y) + sqrt(h/R_x)]}, h_x = h + R_b^2/(2 R_x).
    The edge is that of the law `gap-integral`, which this meets at vanishing load. Under load the surfaces outside the
    contact stand closer together than these paraboloids at the same distance in the middle: it is a lower bound.

    Parameters
    ----------
    gap : float
        Distance of the surfaces in the middle [m], greater than 0.
    radius_x, radius_y : float
        Reduced radii along and across rolling [m].
    ball_radius : float
        Radius of the ball [m], where its projection ends.

    Returns
    -------
    float
    """
    s = 0.5 * ball_radius * ball_radius
    edge = math.sqrt((gap + s / radius_x) / radius_y) + math.sqrt((gap + s / radius_y) / radius_x)
    middle = math.sqrt(gap / radius_y) + math.sqrt(gap / radius_x)
    return VACUUM_PERMITTIVITY * 4.0 * math.pi * math.sqrt(radius_x * radius_y) * math.log(edge / middle)

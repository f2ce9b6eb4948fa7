"""Compute drag of rollers in an oil bath (SKF)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from lambda_core.elements.roller.roller_bearing import RollerBearing

# V_M of roller bearings over H/d_m: SKF, Rolling bearings, 2018, "Friction", a chart, as a public tool tabulates it.
_HEIGHTS = (
    *(0.0, 0.0037, 0.0270, 0.0533, 0.0819, 0.1044, 0.1270, 0.1496, 0.1778),
    *(0.2196, 0.2739, 0.4109, 0.5522, 0.7587, 0.9587, 1.1978),
)
_VOLUMES = (
    *(0.0, 1.69e-6, 1.81e-5, 4.36e-5, 8.47e-5, 1.235e-4, 1.727e-4, 2.293e-4, 2.974e-4),
    *(3.40e-4, 4.19e-4, 5.83e-4, 7.33e-4, 9.42e-4, 1.150e-3, 1.434e-3),
)
_DEEPEST = 1.44e-3  # V_M above H = 1.2 d_m


def drag_volume(height: float) -> float:
    """Return V_M of roller bearings over H/d_m [-].

    Linear between the points of SKF's chart.
    """
    return _DEEPEST if height > _HEIGHTS[-1] else float(np.interp(height, _HEIGHTS, _VOLUMES))


def bath_drag(
    bearing: RollerBearing, speed: float, viscosity: float, oil_height: float, constants: tuple[float, float]
) -> float:
    """Return the bath's drag on one row [N m].

    It is M_drag of rollers in an oil bath.

    4 V_M K_roll C_w B d_m^4 n^2 + 1.093e-7 n^2 d_m^3 (n d_m^2 f_t/nu)^-1.379 R_s, K_roll = K_L K_Z (d + D)/(D - d)
    1e-12, C_w = 2.789e-10 l^3 - 2.786e-4 l^2 + 0.0195 l + 0.6439, l = 5 K_L B/d_m, R_s = 0.36 d_m^2 (t - sin t) f_A,
    f_A = 0.05 K_Z (D + d)/(D - d), t = 2 acos((0.6 d_m - H)/(0.6 d_m)), H at most 1.2 d_m, f_t = sin(t/2) for t < pi,
    else 1 (mm, 1/min, mm2/s, N mm): SKF, Rolling bearings, 2018, "Friction".

    Parameters
    ----------
    bearing : RollerBearing
        Boundary dimensions.
    speed : float
        Of one ring against the other [rad/s].
    viscosity : float
        Kinematic, of the oil [m2/s].
    oil_height : float
        H above the lowest point of the outer raceway [m]; zero or less is no bath.
    constants : tuple of float
        K_L and K_Z.
    """
    rpm = abs(speed) * 30.0 / math.pi
    if oil_height <= 0.0 or rpm == 0.0:
        return 0.0
    sizes = (1e3 * bearing.bore, 1e3 * bearing.outside, 1e3 * bearing.width)
    square, viscous = bath_drag_terms(*sizes, 1e3 * oil_height, constants)
    return float((square * rpm**2 + viscous * rpm**0.621 * (1e6 * viscosity) ** 1.379) * 1e-3)


def bath_drag_terms(
    bore: float, outside: float, width: float, oil_height: float, constants: tuple[float, float]
) -> tuple[float, float]:
    """Return the drag terms of a bath.

    They are the drag of rollers over n^2 and over n^0.621 nu^1.379.

    In N mm, 1/min and mm2/s; the equation is that of :func:`bath_drag`.

    Parameters
    ----------
    bore, outside, width : float
        Boundary dimensions d, D and B [mm].
    oil_height : float
        H above the lowest point of the outer raceway, above zero [mm].
    constants : tuple of float
        K_L and K_Z.

    Returns
    -------
    tuple of float
        Factors of n^2 and of n^0.621 nu^1.379.
    """
    k_l, k_z = constants
    mean, slenderness = 0.5 * (bore + outside), (outside + bore) / (outside - bore)
    slim = 5.0 * k_l * width / mean
    factor = 2.789e-10 * slim**3 - 2.786e-4 * slim**2 + 0.0195 * slim + 0.6439
    square = 4.0 * drag_volume(oil_height / mean) * k_l * k_z * slenderness * 1e-12 * factor * width * mean**4
    angle = 2.0 * math.acos(max((0.6 * mean - oil_height) / (0.6 * mean), -1.0))
    wetted = 0.36 * mean**2 * (angle - math.sin(angle)) * 0.05 * k_z * slenderness
    across = math.sin(0.5 * angle) if angle < math.pi else 1.0
    return square, 1.093e-7 * mean**3 * (mean**2 * across) ** -1.379 * wetted

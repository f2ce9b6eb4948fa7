"""SKF's friction variables of angular contact ball bearings, of single and double row and of four-point contact.

Source: SKF, general catalogue 6000, "Friction": tables 2a, 3 and 5, footnote: F_a is the external axial load.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

# Series -> geometric constant (table 5).
K_Z = {"70": 4.4, "72": 4.4, "73": 4.4, "32": 3.1, "33": 3.1, "QJ2": 3.1, "QJ3": 3.1}
SERIES = tuple(K_Z)


@dataclass(frozen=True)
class AngularConstants:
    """Constants of one kind (mm, N, 1/min; G_rr and G_sl in N mm)."""

    r1: float
    r2: float
    r3: float
    s1: float
    s2: float
    s3: float


SINGLE_ROW = AngularConstants(5.03e-7, 1.97, 1.90e-12, 1.30e-2, 0.68, 1.91e-12)
TWO_ROWS = AngularConstants(6.34e-7, 1.41, 7.83e-13, 7.56e-3, 1.21, 7.83e-13)
FOUR_POINT = AngularConstants(4.78e-7, 2.42, 1.40e-12, 1.20e-2, 0.9, 1.40e-12)


def angular_variables(
    mean_diameter: float, radial_load: float, axial_load: float, speed: float, series: str = "72"
) -> tuple[float, float]:
    """Load and geometry variables (G_rr, G_sl) in the catalogue's units (torque in N mm).

    G_rr = R1 d_m^1.97 (F_r + F_g + R2 F_a)^0.54 with F_g = R3 d_m^4 n^2; G_sl = S1 d_m^0.26 ((F_r + F_g)^(4/3) +
    S2 F_a^(4/3)) with F_g = S3 d_m^4 n^2 (mm, N, 1/min).

    Parameters
    ----------
    mean_diameter : float
        (d + D)/2 [m].
    speed : float
        Relative speed of the rings [rad/s]: centrifugal force F_g of the balls.
    """
    diameter, rpm = mean_diameter * 1e3, speed * 30.0 / math.pi
    c = FOUR_POINT if series.startswith("QJ") else TWO_ROWS if series.startswith("3") else SINGLE_ROW
    pressed = diameter**4 * rpm**2
    rolling = c.r1 * diameter**1.97 * (radial_load + c.r3 * pressed + c.r2 * axial_load) ** 0.54
    loads = (radial_load + c.s3 * pressed) ** (4.0 / 3.0) + c.s2 * axial_load ** (4.0 / 3.0)
    return rolling, c.s1 * diameter**0.26 * loads

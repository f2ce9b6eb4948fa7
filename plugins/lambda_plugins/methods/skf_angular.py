"""Define SKF's friction variables of other ball bearings.

They are those that are not deep groove ball bearings.

Angular contact of one and two rows, four-point contact, self-aligning. Source: SKF, general catalogue 6000, "Friction":
tables 2a, 3, 3b and 5, footnote: F_a is the external axial load.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_plugins.methods.skf_drag import K_Z as DEEP_GROOVE
from lambda_plugins.methods.skf_drag import K_Z_OF_KINDS

_ANGULAR, _ALIGNING = K_Z_OF_KINDS["angular contact"], K_Z_OF_KINDS["self-aligning"]
# Series -> geometric constant.
K_Z = dict.fromkeys(("70", "72", "73"), _ANGULAR) | dict.fromkeys(("32", "33", "QJ2", "QJ3"), DEEP_GROOVE)
K_Z |= dict.fromkeys(("12", "13", "22", "23"), _ALIGNING)
SERIES = tuple(K_Z)


@dataclass(frozen=True)
class AngularConstants:
    """Constants of one kind in mm, N and 1/min.

    G_rr and G_sl are in N mm.
    """

    r1: float
    r2: float
    r3: float
    s1: float
    s2: float
    s3: float


SINGLE_ROW = AngularConstants(5.03e-7, 1.97, 1.90e-12, 1.30e-2, 0.68, 1.91e-12)
TWO_ROWS = AngularConstants(6.34e-7, 1.41, 7.83e-13, 7.56e-3, 1.21, 7.83e-13)
FOUR_POINT = AngularConstants(4.78e-7, 2.42, 1.40e-12, 1.20e-2, 0.9, 1.40e-12)
SELF_ALIGNING = {
    "12": AngularConstants(3.25e-7, 6.51, 2.43e-12, 4.36e-3, 9.33, 2.43e-12),
    "13": AngularConstants(3.11e-7, 5.76, 3.52e-12, 5.76e-3, 8.03, 3.52e-12),
    "22": AngularConstants(3.13e-7, 5.54, 3.12e-12, 5.84e-3, 6.60, 3.12e-12),
    "23": AngularConstants(3.11e-7, 3.87, 5.41e-12, 0.01, 4.35, 5.41e-12),
}
# Exponents of d_m in G_rr, G_sl and F_g.
_POWERS, _POWERS_ALIGNING = (1.97, 0.26, 4.0), (2.0, -0.12, 3.5)


def angular_variables(
    mean_diameter: float, radial_load: float, axial_load: float, speed: float, series: str = "72"
) -> tuple[float, float]:
    """Return the load and geometry variables G_rr and G_sl.

    They are in the catalogue's units (torque in N mm).

    G_rr = R1 d_m^1.97 (F_r + F_g + R2 F_a)^0.54 with F_g = R3 d_m^4 n^2; G_sl = S1 d_m^0.26 ((F_r + F_g)^(4/3) +
    S2 F_a^(4/3)) with F_g = S3 d_m^4 n^2 (mm, N, 1/min); of self-aligning bearings d_m has the powers 2, -0.12, 3.5.

    Parameters
    ----------
    mean_diameter : float
        (d + D)/2 [m].
    speed : float
        Relative speed of the rings [rad/s]: centrifugal force F_g of the balls.
    """
    diameter, rpm = mean_diameter * 1e3, speed * 30.0 / math.pi
    c = FOUR_POINT if series.startswith("QJ") else TWO_ROWS if series.startswith("3") else SINGLE_ROW
    c = SELF_ALIGNING.get(series, c)
    to_roll, to_slide, to_press = _POWERS_ALIGNING if series in SELF_ALIGNING else _POWERS
    pressed = diameter**to_press * rpm**2
    rolling = c.r1 * diameter**to_roll * (radial_load + c.r3 * pressed + c.r2 * axial_load) ** 0.54
    loads = (radial_load + c.s3 * pressed) ** (4.0 / 3.0) + c.s2 * axial_load ** (4.0 / 3.0)
    return rolling, c.s1 * diameter**to_slide * loads

"""Compute forces of a spur or helical gear.

All values are in SI.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class GearForces:
    """Forces of a mesh on the shaft.

    They are in the frame of the case, about the shaft's axis at the gear's middle.
    """

    force: tuple[float, float, float]  # [N]
    moment: tuple[float, float, float]  # of the force at the pitch circle about the axis [N m]
    tangential: float  # sizes [N]
    radial: float
    axial: float


def gear_forces(
    torque: float,
    pitch_diameter: float,
    *,
    mesh: float,
    role: Literal["driving", "driven"],
    spin: float,
    pressure_angle: float,
    helix_angle: float = 0.0,
    hand: Literal["right", "left"] = "right",
) -> GearForces:
    """Return the forces of a mesh without friction.

    F_t = 2 T/d, F_r = F_t tan(alpha_n)/cos(beta), F_a = F_t tan(beta) (Budynas and Nisbett, Shigley's Mechanical
    Engineering Design, ch. 13). A driven gear is pushed along its rotation, a driving one against it; the radial force
    points from the mesh to the axis. The axial one follows from the tooth's normal: a right-hand tooth runs along
    (cos(beta), sin(beta)) in x and azimuth, so that F_a along +x is -tan(beta) times the force along growing azimuth.

    Parameters
    ----------
    torque : float
        Transmitted, positive [N m].
    mesh : float
        Azimuth of the mesh, from +y to +z [rad].
    spin : float
        Of the shaft about +x; its sign counts [rad/s].
    pressure_angle, helix_angle : float
        Normal pressure angle, helix angle at the pitch circle [rad].
    """
    tangential = 2.0 * torque / pitch_diameter
    radial = tangential * math.tan(pressure_angle) / math.cos(helix_angle)
    axial = tangential * math.tan(helix_angle)
    along = math.copysign(1.0, spin) * (1.0 if role == "driven" else -1.0)
    handed = -1.0 if hand == "right" else 1.0
    c, s = math.cos(mesh), math.sin(mesh)
    force_x = handed * along * axial
    force_y = -along * tangential * s - radial * c
    force_z = along * tangential * c - radial * s
    arm_y, arm_z = 0.5 * pitch_diameter * c, 0.5 * pitch_diameter * s
    moment = (arm_y * force_z - arm_z * force_y, arm_z * force_x, -arm_y * force_x)
    return GearForces((force_x, force_y, force_z), moment, tangential, radial, axial)

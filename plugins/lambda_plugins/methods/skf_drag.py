"""Compute SKF's drag loss M_drag in two editions.

It covers ball bearings of one row; K_Z is that of deep groove ball bearings.

The older formula is printed as eq. (40) of Syla et al. 2026 after the SKF catalogue of 2008. V_M is a chart over H/d_m
in both editions, not available as numbers: it is an input. SI in and out, mm, 1/min and mm2/s inside.
"""

from __future__ import annotations

import math

# Geometric constant of ball bearings, and of the kinds that have another one (SKF, general catalogue 6000, "Friction",
# table 5): deep groove, double row and four-point contact 3.1.
K_Z = 3.1
K_Z_OF_KINDS = {"angular contact": 4.4, "self-aligning": 4.8}


def drag_torque(
    bore_diameter: float,
    outside_diameter: float,
    speed: float,
    kinematic_viscosity: float,
    oil_height: float,
    volume_factor: float,
    *,
    oil_jet: bool = False,
    k_z: float = K_Z,
) -> tuple[float, float]:
    """Return both parts of the drag torque [N m].

    They are M_drag of a single-row ball bearing in an oil bath: (part of V_M, churning part).

    0.4 V_M K_ball d_m^5 n^2 + 1.093e-7 n^2 d_m^3 (n d_m^2 f_t/nu)^-1.379 R_s, K_ball = K_Z (d + D)/(D - d) 1e-12,
    R_s = 0.36 d_m^2 (t - sin t) f_A, f_A = 0.05 K_Z (D + d)/(D - d), t = 2 acos((0.6 d_m - H)/(0.6 d_m)), H at most
    1.2 d_m, f_t = sin(t/2) for t < pi, else 1; an oil jet doubles it. As SKF's catalogue since 2013; not checked
    against a printed example.

    Parameters
    ----------
    speed : float
        Relative speed of the rings [rad/s].
    oil_height : float
        H, oil above the lowest point of the outer raceway [m].
    volume_factor : float
        V_M, read from the catalogue's chart at H/d_m [-].
    """
    bore, outside = bore_diameter * 1e3, outside_diameter * 1e3
    diameter = 0.5 * (bore + outside)
    rpm = speed * 30.0 / math.pi
    if rpm <= 0.0 or oil_height <= 0.0:
        return 0.0, 0.0
    jet = 2.0 if oil_jet else 1.0
    slenderness = (outside + bore) / (outside - bore)
    volume_part = 0.4 * volume_factor * k_z * slenderness * 1e-12 * diameter**5 * rpm**2
    height = min(oil_height * 1e3, 1.2 * diameter)
    angle = 2.0 * math.acos((0.6 * diameter - height) / (0.6 * diameter))
    width_factor = math.sin(0.5 * angle) if angle < math.pi else 1.0
    wetted = 0.36 * diameter**2 * (angle - math.sin(angle)) * 0.05 * k_z * slenderness
    reynolds = rpm * diameter**2 * width_factor / (kinematic_viscosity * 1e6)
    churning = 1.093e-7 * rpm**2 * diameter**3 * reynolds**-1.379 * wetted
    return jet * volume_part * 1e-3, jet * churning * 1e-3


def drag_torque_2008(
    bore_diameter: float, outside_diameter: float, speed: float, volume_factor: float, k_z: float = K_Z
) -> tuple[float, float]:
    """Return M_drag of the older catalogue [N m].

    It is (M_drag, 0), with M_drag = V_M K_ball d_m^5 n^2 (Syla et al. 2026, eq. 40).

    Without the factor 0.4 of the newer edition: take V_M from the chart of the same edition.
    """
    bore, outside = bore_diameter * 1e3, outside_diameter * 1e3
    rpm = speed * 30.0 / math.pi
    constant = k_z * (outside + bore) / (outside - bore) * 1e-12
    return volume_factor * constant * (0.5 * (bore + outside)) ** 5 * rpm**2 * 1e-3, 0.0

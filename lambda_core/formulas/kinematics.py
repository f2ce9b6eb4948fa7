"""Compute epicyclic kinematics of a ball bearing.

Angular speeds are in rad/s and positive about the shaft axis; ``gamma = D_w cos(alpha)/d_m`` has the pitch diameter.
The source is Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 1, ch. 10.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray


@dataclass(frozen=True)
class FrequencyOrders:
    """Characteristic frequencies per inner ring revolution.

    The outer ring is fixed.
    """

    cage: float  # FTF
    outer_pass: float  # BPFO
    inner_pass: float  # BPFI
    ball_spin: float  # BSF: turns of a ball about its own axis relative to the cage
    ball_defect: float  # 2 BSF: one spot of the ball meets both raceways once per turn


def diameter_ratio(ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0) -> float:
    """Return gamma = D_w cos(alpha)/d_m [-]."""
    return ball_diameter * math.cos(contact_angle) / pitch_diameter


def cage_speed(inner_speed: float, outer_speed: float, gamma: float) -> float:
    """Return the orbital speed of balls [rad/s].

    It is that of the cage: [omega_i (1 - gamma) + omega_o (1 + gamma)]/2 (Harris ch. 10).
    """
    return 0.5 * (inner_speed * (1.0 - gamma) + outer_speed * (1.0 + gamma))


def rolling_ratio(
    load: FloatArray, angle: FloatArray, radius: FloatArray, spin: FloatArray, orbit: FloatArray, ball_diameter: float,
    *, approach: FloatArray | float = 0.0, rise: FloatArray | None = None,
) -> float:  # fmt: skip
    """Return the cage speed over inner ring speed.

    The balls roll at both raceways; both speeds are relative to the outer ring.

    A ball whose own axis leans by b against the shaft rolls where R omega_b cos(a - b) is the speed of the raceway
    past it: omega_c/omega = (r_i - e) c_o/[r_i c_o + r_o c_i], c = (R - h) cos(a - b), r_i = r - (R - h_i) cos(a_i),
    r_o = r + (R - h_o) cos(a_o) (Jones 1959, J. Basic Eng. 81, 1; Harris and Kotzalas 2006, vol. 2, ch. 2, with b of
    the ball itself in place of one raceway's control). The inner ring, nearer by e, turns about its own centre; h is
    the height over the middle of the track at which the contact rolls. With equal angles,
    e = 0 and h = 0, b drops out and Harris's (1 - D_w cos(a)/d_m)/2 is left. Mean over balls, weighted by the load at
    the inner ring; NaN without load.

    Parameters
    ----------
    load, angle : float64[..., Z, 2]
        Contact loads [N] and angles [rad], inner then outer.
    radius : float64[..., Z]
        Distance of the balls' centres from the shaft axis [m].
    spin : float64[..., Z, 3]
        Angular velocity of the balls: axial, radial, tangential [rad/s].
    orbit : float64[..., Z]
        Orbital speed of the balls [rad/s].
    ball_diameter : float
        D_w [m].
    approach : float64[..., Z] or float
        e, displacement of the inner ring towards each ball [m].
    rise : float64[..., Z, 2], optional
        h at both rings [m]; absent: 0.
    """
    inner, outer = angle[..., 0], angle[..., 1]
    arm = 0.5 * ball_diameter - (np.zeros_like(angle) if rise is None else rise)
    axial, radial = orbit - spin[..., 0], spin[..., 1]
    # the axis has no direction of its own: between -90 and 90 degrees, whichever way the ball turns
    lean = np.arctan2(np.where(axial < 0.0, -radial, radial), np.abs(axial))
    turn_inner, turn_outer = arm[..., 0] * np.cos(inner - lean), arm[..., 1] * np.cos(outer - lean)
    at_inner = (radius - arm[..., 0] * np.cos(inner)) * turn_outer
    at_outer = (radius + arm[..., 1] * np.cos(outer)) * turn_inner
    weight = np.where(load.min(axis=-1) > 0.0, load[..., 0], 0.0)
    carried = weight > 0.0
    if not carried.any():
        return math.nan
    # a ball that flies between the raceways may lean so that there is no such speed
    ratio = (at_inner - approach * turn_outer)[carried] / (at_inner + at_outer)[carried]
    return float(weight[carried] @ ratio / weight[carried].sum())


def ball_speed(
    inner_speed: float, outer_speed: float, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the spin of a ball [rad/s].

    It is about its own axis relative to the cage, positive like a forward-turning inner ring's.

    -(d_m/(2 D_w)) (1 - gamma^2) (omega_i - omega_o) (Harris ch. 10, with the sign: an inner ring that turns
    forward turns the balls backward).
    """
    gamma = diameter_ratio(ball_diameter, pitch_diameter, contact_angle)
    return -0.5 * pitch_diameter / ball_diameter * (1.0 - gamma**2) * (inner_speed - outer_speed)


def entrainment_speed(
    inner_speed: float, outer_speed: float, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> float:
    """Return the mean surface speed of a contact [m/s].

    It is (u_1 + u_2)/2 in the contact's frame, the same at both raceways.

    (d_m/4) (1 - gamma^2) |omega_i - omega_o|: the "hydrodynamic speed" from geometry alone (Barz 1996, as used
    in Syla et al. 2026, section 4.3).
    """
    gamma = diameter_ratio(ball_diameter, pitch_diameter, contact_angle)
    return 0.25 * pitch_diameter * (1.0 - gamma**2) * abs(inner_speed - outer_speed)


def frequency_orders(
    ball_count: int, ball_diameter: float, pitch_diameter: float, contact_angle: float = 0.0
) -> FrequencyOrders:
    """Return the orders of the characteristic frequencies.

    Multiplied by (omega_i - omega_o)/(2 pi) they give Hz.

    The cage order is relative to a fixed outer ring.
    """
    gamma = diameter_ratio(ball_diameter, pitch_diameter, contact_angle)
    spin = 0.5 * pitch_diameter / ball_diameter * (1.0 - gamma**2)
    return FrequencyOrders(
        cage=0.5 * (1.0 - gamma),
        outer_pass=0.5 * ball_count * (1.0 - gamma),
        inner_pass=0.5 * ball_count * (1.0 + gamma),
        ball_spin=spin,
        ball_defect=2.0 * spin,
    )

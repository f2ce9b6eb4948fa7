"""Share the fluid loss of a bearing among its balls.

The share follows from the immersion of each ball in the oil bath.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from lambda_core.plugins import Context
from lambda_plugins.shapes import at_least, at_most

_EVERYWHERE = 1e3  # [m] oil level of a bearing whose oil level is not known: every ball takes its even share
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)


class OilBath(NamedTuple):
    """Oil level among the balls."""

    level: float  # above the lowest point of the pitch circle [m]
    pitch_radius: float  # [m]
    ball_radius: float  # [m]


def oil_geometry(context: Context) -> OilBath:
    """Return the oil bath of a bearing.

    The bath of a grease reaches no ball.
    """
    if context.lubrication not in ("oil bath", "grease"):
        raise ValueError(f'it needs an oil bath, and the case has "{context.lubrication}": take "cavity-mixture"')
    level = context.oil_level if math.isfinite(context.oil_level) else _EVERYWHERE
    return OilBath(level, 0.5 * context.pitch_diameter, 0.5 * context.ball_diameter)


def immersion(azimuth: float, bath: OilBath) -> float:
    """Return the submerged share of a ball's volume, 0..1.

    The ball's centre stands pitch_radius (1 + sin azimuth) above the lowest point of the pitch circle (azimuth from +y
    to +z, gravity along -z). A spherical cap of depth 2 R x holds the share x^2 (3 - 2 x) of the sphere, a smooth law.
    """
    depth = bath.level - bath.pitch_radius * (1.0 + math.sin(azimuth))
    x = at_most(at_least(0.5 * (depth / bath.ball_radius + 1.0), 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def mean_immersion(bath: OilBath) -> float:
    """Return the mean of :func:`immersion` over the azimuth."""
    level, pitch_radius, ball_radius = bath

    def angle(height: float) -> float:
        """Return the angle of a ball at a height.

        It is measured from the lowest point, for a centre at `height` above it.
        """
        return math.acos(min(max(1.0 - height / pitch_radius, -1.0), 1.0))

    full, none = angle(level - ball_radius), angle(level + ball_radius)
    partly = full + 0.5 * (none - full) * (_NODES + 1.0)
    shares = [immersion(each - 0.5 * math.pi, bath) for each in partly]
    return (full + 0.5 * (none - full) * float(_WEIGHTS @ shares)) / math.pi


def kinematic_speeds(context: Context, speed: float) -> tuple[float, float]:
    """Return the kinematic speeds of a ball.

    They are (orbital speed of its centre [m/s], spin [rad/s]) at `speed` [rad/s].

    Pure rolling with the outer ring at rest and no contact angle: cage at (1 - gamma)/2 of the inner ring's speed,
    gamma = D_w/d_m (Harris and Kotzalas 2006, eq. 10.12). The spin is that against the oil at rest, (1 - gamma)/(2
    gamma) of the ring's speed: the ball rolls on the outer ring; against the cage it is 1 + gamma times as fast (eq.
    10.14).
    """
    gamma = context.ball_diameter / context.pitch_diameter
    orbit = 0.5 * (1.0 - gamma) * speed
    spin = 0.5 * speed * (1.0 - gamma) / gamma
    return 0.5 * context.pitch_diameter * orbit, spin

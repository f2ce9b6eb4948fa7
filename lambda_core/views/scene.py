"""Describe a bearing in motion as plain data.

What animations are drawn from, whatever draws them. Inertial frame, SI; see docs/frames.md.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray


@dataclass(frozen=True)
class RollerShape:
    """Length and angles of rollers.

    Attributes
    ----------
    length : float
        [m]
    axis : float
        Lean of their axes to that of the bearing, towards it along +x [rad]; zero of cylinders, as all angles.
    inner, outer : float
        The same of the raceways [rad].
    """

    length: float
    axis: float
    inner: float
    outer: float

    @property
    def half(self) -> float:
        """Half of their cone angle [rad]."""
        return self.outer - self.axis

    def raceway(self, ring: str, middle: float, radius: float, x: FloatArray) -> FloatArray:
        """Return the raceway's radii at places along the bearing [m].

        It is a cone without ribs, `middle` its radius where axes of rollers of `radius` do not lean [m].
        """
        side, lean = (-1.0, self.inner) if ring == "inner" else (1.0, self.outer)
        touched = middle - side * radius * (1.0 - math.cos(self.axis))
        return np.asarray(touched - (x - side * radius * math.sin(self.axis)) * math.tan(lean))


@dataclass(frozen=True)
class Scene:
    """Frames of a run, evenly spaced in time.

    Attributes
    ----------
    title, source : str
        Of what run.
    geometry : mapping
        Of the resolved model [m]: ``ball_diameter``, ``race_diameter_inner``, ``bore_diameter`` and so on.
    has_cage : bool
        Whether there is a cage; without one its entries stay at the origin.
    cage_play : float
        Free radius of the cage [m]; NaN if unknown.
    time : float64[:], shape (frames,)
        [s]
    body_position : float64[:, :, :], shape (frames, 3, 3)
        Centres of inner ring, outer ring and cage [m].
    body_tilt : float64[:, :, :], shape (frames, 3, 2)
        About y and z [rad].
    body_angle : float64[:, :], shape (frames, 3)
        Rotation of each body about its own axis [rad].
    ball_position : float64[:, :, :], shape (frames, balls, 3)
        Centres of the balls [m].
    ball_azimuth : float64[:, :], shape (frames, balls)
        Unwrapped [rad].
    ball_rotation : float64[:, :, :], shape (frames, balls, 4)
        Orientation of each ball as a quaternion x, y, z, w; the identity at the sample before the first frame.
    load : float64[:, :, :], shape (frames, balls, 2)
        Normal forces at inner and outer ring [N].
    contact_angle : float64[:, :, :], shape (frames, balls, 2)
        [rad]
    pocket_force : float64[:, :, :], shape (frames, balls, 3)
        Force of the cage on each ball, x, y, z [N].
    rollers : RollerShape, optional
        Of rollers; None of balls.
    """

    title: str
    source: str
    geometry: Mapping[str, Any]
    has_cage: bool
    cage_play: float
    time: FloatArray
    body_position: FloatArray
    body_tilt: FloatArray
    body_angle: FloatArray
    ball_position: FloatArray
    ball_azimuth: FloatArray
    ball_rotation: FloatArray
    load: FloatArray
    contact_angle: FloatArray
    pocket_force: FloatArray
    rollers: RollerShape | None = None

    @property
    def element(self) -> str:
        """Name of a rolling element."""
        return "ball" if self.rollers is None else "roller"

    @property
    def frames(self) -> int:
        """Number of frames."""
        return self.time.size

    def load_vectors(self) -> FloatArray:
        """Return the ball forces on the rings [N].

        They are normal forces, shape (frames, balls, 2, 3).

        On the outer ring outwards, on the inner ring inwards; a positive contact angle turns the force on the outer
        ring towards +x.
        """
        angle, outwards = self.contact_angle, np.array([-1.0, 1.0])
        axial = self.load * np.sin(angle) * outwards
        radial = self.load * np.cos(angle) * outwards
        y, z = np.cos(self.ball_azimuth), np.sin(self.ball_azimuth)
        return np.stack([axial, radial * y[..., None], radial * z[..., None]], axis=-1)

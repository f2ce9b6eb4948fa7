"""Make frames of an animation from channels."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.elements.roller.rib import tapered_angles
from lambda_core.views.scene import RollerShape, Scene

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


def scene_of(run: Result, *, start: float | None, turns: float, frames: int) -> Scene:
    """Return evenly spaced frames of a run.

    Between recorded samples everything is interpolated linearly.

    Parameters
    ----------
    start : float or None
        First moment [s]; None: the last `turns` of the run.
    turns : float
        Revolutions of the cage (of the balls, without one) to show.
    frames : int
        Number of frames.

    Raises
    ------
    UsageError
        When the run has no such moment.
    """
    times = run["time"]
    if times.size < 2:
        raise UsageError(f"{run.path} has one sample only: an animation needs several")
    turned = np.abs(run["ball_azimuth"] - run["ball_azimuth"][0]).mean(axis=1) / (2.0 * math.pi)
    begin, end = _interval(times, turned, start, turns, str(run.path))
    at = np.linspace(begin, end, frames)
    model = run.model
    azimuth = _at(times, run["ball_azimuth"], at)
    axial, radius = _at(times, run["ball_axial"], at), _at(times, run["ball_radius"], at)
    y, z = np.cos(azimuth), np.sin(azimuth)
    pocket, rollers = _at(times, run["pocket_force"], at), _shape(model)
    turned = run["ball_azimuth"], run["ball_spin"], at
    along_y = pocket[..., 1] * y - pocket[..., 2] * z
    along_z = pocket[..., 1] * z + pocket[..., 2] * y
    return Scene(
        title=run.title,
        source=run.headline.splitlines()[-1],
        geometry=model["geometry"],
        has_cage=bool(model["depth"]["cage"]),
        cage_play=_play(model["cage"]),
        time=at,
        body_position=_at(times, run["body_position"], at),
        body_tilt=_at(times, run["body_tilt"], at),
        body_angle=_at(times, run["body_spin_angle"], at),
        ball_position=np.stack([axial, radius * y, radius * z], axis=-1),
        ball_azimuth=azimuth,
        ball_rotation=_rotations(times, *turned) if rollers is None else _of_rollers(times, *turned, rollers.axis),
        load=_at(times, run["load"], at),
        contact_angle=_at(times, run["contact_angle"], at),
        pocket_force=np.stack([pocket[..., 0], along_y, along_z], axis=-1),
        rollers=rollers,
    )


def _shape(model: Mapping[str, Any]) -> RollerShape | None:
    """Return the shape of a model's rollers; None of balls."""
    found = model.get("rollers")
    if found is None:
        return None
    outer, inner = float(found["contact_angle"]), 0.0
    if outer > 0.0:
        inner = tapered_angles(found["diameter"], found["pitch_diameter"], outer).inner
    inner, outer = inner * found["faces"], outer * found["faces"]
    return RollerShape(float(found["length"]), 0.5 * (inner + outer), inner, outer)


def _interval(
    times: FloatArray, turned: FloatArray, start: float | None, turns: float, path: str
) -> tuple[float, float]:
    """Return the first and the last moment to show [s]."""
    first, last = float(times[0]), float(times[-1])
    if start is None:
        wanted = max(float(turned[-1]) - turns, 0.0)
        return float(np.interp(wanted, turned, times)), last
    if not first <= start < last:
        raise UsageError(f"{path} has no moment t = {start:g} s: it reaches from {first:g} to {last:g} s")
    wanted = float(np.interp(start, times, turned)) + turns
    return start, float(np.interp(wanted, turned, times))


def _at(times: FloatArray, values: FloatArray, at: FloatArray) -> FloatArray:
    """Interpolate a channel linearly in time, its other axes kept."""
    right = np.clip(np.searchsorted(times, at), 1, times.size - 1)
    share = (at - times[right - 1]) / (times[right] - times[right - 1])
    share = share.reshape(-1, *[1] * (values.ndim - 1))
    found: FloatArray = (1.0 - share) * values[right - 1] + share * values[right]
    return found


def _play(cage: dict[str, object]) -> float:
    """Return the free radius of the cage [m].

    It is half the clearance of the guide.
    """
    name = "pocket_clearance" if cage["guidance"] == "ball" else "land_clearance"
    return 0.5 * float(str(cage[name]))


def _of_rollers(times: FloatArray, azimuth: FloatArray, spin: FloatArray, at: FloatArray, axis: float) -> FloatArray:
    """Return the orientation of each roller at moments.

    The shape is that of :func:`_rotations`. A roller leans by the angle of its axis and turns about it; its tilt and
    skew of milliradians are left out, which nobody would see.
    """
    from scipy.spatial.transform import Rotation

    own = spin[..., 0] - math.cos(axis) * np.gradient(azimuth, times, axis=0)
    steps = 0.5 * (own[1:] + own[:-1]) * np.diff(times)[:, None]
    turned = _at(times, np.concatenate([np.zeros_like(own[:1]), np.cumsum(steps, axis=0)]), at)
    round_about = Rotation.from_euler("x", _at(times, azimuth, at).reshape(-1, 1))
    found = round_about * Rotation.from_euler("z", -axis) * Rotation.from_euler("x", turned.reshape(-1, 1))
    return np.asarray(found.as_quat().reshape(*turned.shape, 4))


def _rotations(times: FloatArray, azimuth: FloatArray, spin: FloatArray, at: FloatArray) -> FloatArray:
    """Return the orientation of each ball at moments.

    The shape is (frames, balls, 4): quaternions x, y, z, w.

    The angular velocity is taken as constant between recorded samples (their mean), turned by its exponential map.
    """
    from scipy.spatial.transform import Rotation

    y, z = np.cos(azimuth), np.sin(azimuth)
    velocity = np.stack(
        [spin[..., 0], spin[..., 1] * y - spin[..., 2] * z, spin[..., 1] * z + spin[..., 2] * y], axis=-1
    )
    balls = azimuth.shape[1]
    begin = max(int(np.searchsorted(times, at[0], "right")) - 1, 0)
    found = np.empty((at.size, balls, 4))
    state = Rotation.identity(balls)
    frame = 0
    for row in range(begin, times.size - 1):
        mean = 0.5 * (velocity[row] + velocity[row + 1])
        while frame < at.size and at[frame] <= times[row + 1]:
            found[frame] = (Rotation.from_rotvec(mean * (at[frame] - times[row])) * state).as_quat()
            frame += 1
        if frame == at.size:
            break
        state = Rotation.from_rotvec(mean * (times[row + 1] - times[row])) * state
    found[frame:] = state.as_quat()
    return found

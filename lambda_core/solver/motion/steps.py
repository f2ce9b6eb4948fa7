"""Take differences of cheap functions for the Jacobian."""

from __future__ import annotations

from lambda_core.solver.layout import helper

_POSITION = 1e-8  # [m]
_ANGLE = 1e-7  # [rad]
_CLOSE = 0.1  # of both, for laws that are called with the place itself: films of a micrometre
_LINEAR = 1e-2  # velocities enter the kinematics linearly
_SLOW = 1e-5  # [m/s] step for laws that are called with the velocity itself
_TURN = 1e-3  # [rad/s] likewise


@helper
def ball_step(c, direct):
    """Return the difference step of state c.

    State c is one of a ball; `direct` is for laws called with velocities.
    """
    if c <= 2:
        return (_POSITION if c < 2 else _ANGLE) * (_CLOSE if direct else 1.0)
    if not direct:
        return _LINEAR
    return _SLOW if c < 6 else _TURN


@helper
def body_step(c, direct):
    """Return the difference step of shared state c."""
    if c < 6:
        return (_POSITION if c < 3 else _ANGLE) * (_CLOSE if direct else 1.0)
    if not direct:
        return _LINEAR
    return _SLOW if c < 9 else _TURN


@helper
def add_slope(slopes, column, changed, base, step):
    """Add a wrench's difference to a column.

    The difference is over a step. The column belongs to the slopes of a force and moment, (6, n).
    """
    for i in range(3):
        slopes[i, column] += (changed.force[i] - base.force[i]) / step
        slopes[3 + i, column] += (changed.moment[i] - base.moment[i]) / step

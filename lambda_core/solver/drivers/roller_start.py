"""Guess the first state of rollers."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.elements import BODIES, INNER, OUTER, POSE
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_equilibrium import balance
from lambda_core.elements.roller.roller_motion import rolling_motion
from lambda_core.elements.roller.roller_thrust import thrust_problem
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.time_functions import initial


def press_rollers(model: BearingModel, rollers: RollerBearing, bodies: NDArray[Any], places: NDArray[Any]) -> None:
    """Move ring and rollers to equilibrium, in place.

    Free directions of the inner ring, the rollers, and waves of rings, to where the convex equilibrium has them.

    A guess: it counts the centrifugal force of rolling, and nothing of friction. Without an equilibrium all stays where
    it is, and the continuation says what is missing.

    Parameters
    ----------
    bodies : records.BODY_STATE[:]
        Inner ring and outer ring at the places of their prescribed motions; cage; waves of rings, then of the cage.
    places : records.ROLLER[:]
        Azimuths are theirs already.
    """
    ring, weight = model.inner_ring, np.array(model.gravity) * model.inner_ring.mass
    loads = np.array([*(initial(f) for f in ring.force), *(initial(m) for m in ring.moment[1:])])
    loads[:3] += weight
    held = tuple(ring.dofs[name].mode != "free" for name in POSE)
    mirror = np.array([rollers.faces, 1.0, 1.0, rollers.faces, rollers.faces])  # from the shaft's axes to theirs
    if not held[0] and thrust_problem(rollers, float(mirror[0] * loads[0])):
        return
    inner, outer = (initial(b.dofs["spin"].motion) for b in (model.inner_ring, model.outer_ring))
    apart = bodies["position"][INNER] - bodies["position"][OUTER]
    tilt = bodies["tilt"][INNER] - bodies["tilt"][OUTER]
    given = np.array([*apart, -tilt[1], tilt[0]]) * np.array(held)
    motion = rolling_motion(rollers, inner, outer) if inner != outer else None
    try:
        found = balance(
            rollers,
            mirror * loads,
            held=held,  # type: ignore[arg-type]
            displacement=mirror * given,
            inertial=None if motion is None else motion.inertial(rollers),
            first_angle=float(places["azimuth"][0]),
        )
    except (ArithmeticError, ValueError):
        return
    x, y, z, tilt_y, tilt_z = mirror * found.ring
    moved = np.array([x, y, z, tilt_z, -tilt_y])
    free = ~np.array([*held[:3], held[4], held[3]])
    bodies["position"][INNER] += np.where(free[:3], moved[:3] - apart, 0.0)
    bodies["tilt"][INNER] += np.where(free[3:], moved[3:] - tilt, 0.0)
    places["x"] = bodies["position"][OUTER, 0] + rollers.faces * found.rollers[:, 0]
    places["radius"] = rollers.centre + found.rollers[:, 1]
    bodies["position"][len(BODIES) : len(BODIES) + len(found.waves), 1:] = found.waves
    places["tilt"][:, 0] = rollers.faces * found.rollers[:, 2]


def roll_rollers(rollers: RollerBearing, inner: float, outer: float, places: NDArray[Any]) -> None:
    """Set the rollers to pure rolling, in place.

    It sets orbital speeds and spins without sliding between rings of these speeds [rad/s].
    """
    motion, axis = rolling_motion(rollers, inner, outer), rollers.faces * rollers.angles.roller
    spin = -math.copysign(motion.spin, inner - outer)
    places["velocity"][:, 2] = motion.cage * places["radius"]
    # own axes lean by -axis to the shaft's
    places["spin"] = spin + motion.cage * math.cos(axis), motion.cage * math.sin(axis), 0.0

"""Compute the axial play of the rings."""

from __future__ import annotations

import math

from lambda_core.case.parts import Bearing
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.geometry.resolve_clearance import picked


def axial_play(model: BearingModel, clearance: float) -> float:
    """Return the axial play to contact [m].

    It is the way from the middle until the elements touch, without load.

    A (sin(alpha_0) - sin(alpha_s)) with cos(alpha_0) = cos(alpha_s) - G_r/(2 A), A = r_i + r_o - D_w, alpha_s the
    resting angle of four-point contact, else 0 (Harris and Kotzalas 2006, eq. 2.9 and ch. 2). Of one row. Rollers
    between ribs have their end play; tapered ones touch where they are drawn.

    Parameters
    ----------
    clearance : float
        G_r, radial [m].
    """
    g = model.geometry
    if model.rollers is not None:
        return 0.0 if model.rollers.contact_angle else model.rollers.end_play
    distance = g.groove_radius_inner + g.groove_radius_outer - g.ball_diameter
    cosine = math.cos(g.resting_angle) - 0.5 * max(clearance, 0.0) / distance
    return distance * (math.sqrt(max(0.0, 1.0 - cosine**2)) - math.sin(g.resting_angle))


def bought_clearance(given: Bearing, model: BearingModel) -> float:
    """Return the clearance before mounting [m].

    The reduction by fits and temperatures adds to the preload.
    """
    return model.geometry.clearance if model.mounting is None else picked(model.mounting.bought, given.clearance_pick)

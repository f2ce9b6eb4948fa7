"""Construct the first guess for the equilibrium search.

Rings are in contact, balls evenly spaced and rolling.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import DOFS, INNER, OUTER
from lambda_core.elements.ball.raceways import row_places
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.roller_start import press_rollers, roll_rollers
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.records import CONTACT_CHANNELS

FIRST_AZIMUTH = -0.5 * math.pi  # of a ball or roller: one of them is lowest
_LOAD, _ANGLE = CONTACT_CHANNELS.index("load"), CONTACT_CHANNELS.index("contact_angle")


def first_frame(model: BearingModel) -> ContactFrame:
    """Guess contact angle and load at t = 0.

    They follow from the external loads; rollers touch at the angles of their cones.
    """
    force = [initial(f) for f in model.inner_ring.force]
    force = [f + model.inner_ring.mass * a for f, a in zip(force, model.gravity, strict=True)]
    total = math.sqrt(sum(f * f for f in force))
    load = max(total * 3.0 / model.geometry.balls, 1.0)
    if model.rollers is not None:
        return ContactFrame((model.rollers.angles.inner, model.rollers.angles.outer), (load, load))
    free = free_contact_angle(model) if abs(force[0]) > 0.1 * total else model.geometry.resting_angle
    return ContactFrame((free, free), (load, load))


def free_contact_angle(model: BearingModel) -> float:
    """Return the free contact angle [rad].

    The axial play is just taken up, without load.

    cos(alpha_0) = cos(alpha_s) - G_r/(2 A), A = r_i + r_o - D_w, with the resting angle alpha_s, 0 of single arcs that
    face each other (Harris and Kotzalas 2006, eq. 2.9 and ch. 2 on four-point contact).
    """
    g = model.geometry
    distance = g.groove_radius_inner + g.groove_radius_outer - g.ball_diameter
    return math.acos(max(-1.0, min(1.0, math.cos(g.resting_angle) - 0.5 * max(g.clearance, 0.0) / distance)))


def first_state(context: SolverContext, phase: float = 0.0) -> FloatArray:
    """Return evenly spaced balls in contact.

    One is lowest, moved on by `phase` pitches; the inner ring is in contact.
    """
    model = context.model
    g = model.geometry
    force = [initial(f) for f in model.inner_ring.force]
    force = [f + model.inner_ring.mass * a for f, a in zip(force, model.gravity, strict=True)]
    total = math.sqrt(sum(f * f for f in force))
    move = [0.0, 0.0, 0.0]
    if total > 0.0:
        distance = g.groove_radius_inner + g.groove_radius_outer - g.ball_diameter
        axial_play = distance * (math.sin(free_contact_angle(model)) - math.sin(g.resting_angle))
        move[0] = (axial_play + 2e-6) * force[0] / total if abs(force[0]) > 0.1 * total else 0.0
        radial = math.hypot(force[1], force[2])
        if radial > 0.1 * total:
            for i in (1, 2):
                move[i] = (0.5 * g.clearance + 2e-6) * force[i] / total
    bodies = np.zeros(context.bundle.bodies.size, R.BODY_STATE)
    for b, body in enumerate((model.inner_ring, model.outer_ring, model.cage_body)):
        for d, name in enumerate(DOFS[:3]):
            dof = body.dofs[name]
            if dof.mode == "prescribed":
                bodies["position"][b, d] = initial(dof.motion)
            elif b == INNER and dof.mode == "free":
                bodies["position"][b, d] = move[d]
        if body.dofs["spin"].mode == "free":
            bodies["spin"][b] = initial(body.dofs["spin"].motion)
    y = np.zeros(context.size)
    balls = L.elements_in(context.bundle, y)
    balls["x"] = 0.5 * (bodies["position"][INNER, 0] + bodies["position"][OUTER, 0])
    balls["radius"] = 0.5 * g.pitch_diameter
    for i, place in enumerate(row_places(g)):
        row, count = balls[i * g.ball_count : (i + 1) * g.ball_count], g.ball_count
        row["x"] += place
        row["azimuth"] = [FIRST_AZIMUTH + 2.0 * math.pi * (j + phase + 0.5 * i) / count for j in range(count)]
    if model.rollers is not None:
        press_rollers(model, model.rollers, bodies, balls)
    context.shared_part(y)[:] = bodies.view(np.float64)[context.bundle.active]
    y[context.size - context.bundle.states.size :] = context.bundle.states
    roll(model, context.frame, balls)
    return y


def place_between(context: SolverContext, state: FloatArray, near: FloatArray) -> None:
    """Place balls and rings as in another state, in place.

    Every ball gets the place between those two that stand on both sides of its azimuth in the other state.
    """
    balls, others = L.elements_in(context.bundle, state), L.elements_in(context.bundle, near)
    context.shared_part(state)[:] = context.shared_part(near)
    for row in np.split(np.arange(balls.size), context.model.geometry.rows):
        at, old = balls["azimuth"][row], others["azimuth"][row]
        for name in ("x", "radius"):
            balls[name][row] = np.interp(at, old, others[name][row], period=2.0 * math.pi)


def roll(model: BearingModel, frame: ContactFrame, balls: NDArray[Any], contacts: FloatArray | None = None) -> None:
    """Set the balls to pure rolling, in place.

    It sets orbital speeds and spins at the frozen contact angle.

    With two arcs or rows the axis of each ball lies between the normals of its `contacts`, shape (balls, contacts, 16).
    """
    g = model.geometry
    inner, outer = (initial(b.dofs["spin"].motion) for b in (model.inner_ring, model.outer_ring))
    if model.rollers is not None:
        roll_rollers(model.rollers, inner, outer, balls)
        return
    angle = float(np.mean(frame.angles))
    lever = 0.5 * g.ball_diameter * math.cos(angle)
    v_inner, v_outer = inner * (0.5 * g.pitch_diameter - lever), outer * (0.5 * g.pitch_diameter + lever)
    spin = (v_outer - v_inner) / g.ball_diameter
    balls["velocity"][:, 2] = 0.5 * (v_inner + v_outer)
    if g.resting_angle == 0.0 or contacts is None:
        balls["spin"] = spin * math.cos(angle), -spin * math.sin(angle), 0.0
        return
    load, normal = contacts[..., _LOAD], contacts[..., _ANGLE]
    axis = (load * normal).sum(axis=1) / np.maximum(load.sum(axis=1), 1e-300)
    turn = spin / np.cos(angle - np.abs(axis))
    balls["spin"] = np.stack([turn * np.cos(axis), -turn * np.sin(axis), np.zeros(g.balls)], axis=1)

"""Resolve preload, support and ratings of a seated bearing."""

from __future__ import annotations

import math

from lambda_core.case.holding import Dof
from lambda_core.case.machine import MachineBearing
from lambda_core.domain.elements import POSE
from lambda_core.elements.roller.roller_thrust import takes_one_side, thrust_problem
from lambda_core.formulas.ratings import dynamic_rating, fatigue_load_limit, static_rating
from lambda_core.model.bearing_model import BearingModel, TimeFunction
from lambda_core.model.bodies.rigid_bodies import refuse_far
from lambda_core.model.geometry.axial_play import axial_play, bought_clearance
from lambda_core.model.laws.time_functions import added, initial, time_function
from lambda_core.model.ledger import Ledger
from lambda_core.model.machine_model import GROUND, LOCKED, MountedBearing, Seating
from lambda_core.model.rollers_in_motion import facing

_SIGN = {"+x": 1, "-x": -1, None: 0}


def mounted(
    name: str, given: MachineBearing, model: BearingModel, carrier: int, growth: float, ledger: Ledger
) -> MountedBearing:
    """Return a bearing at its place.

    Preload and the housing's growth displace its outer ring.

    Parameters
    ----------
    carrier : int
        Body that the outer ring sits in.
    growth : float
        How far the warm housing carries the outer ring along x [m].
    """
    takes, rollers = _SIGN[given.takes], model.rollers
    angle = model.geometry.contact_angle if rollers is None else rollers.contact_angle
    sided = bool(angle) and model.geometry.rated_rows == 1 if rollers is None else takes_one_side(rollers)
    if sided and not takes:
        kind = "an angular contact bearing" if rollers is None else f"a roller bearing of kind {rollers.kind}"
        ledger.problem(f"bearings.{name}.takes", f'is required: {kind} needs "+x" or "-x"')
    if takes and not sided and (rollers is not None or model.geometry.rated_rows > 1):
        both = rollers is None or not thrust_problem(rollers, 1.0)
        what = "takes thrust from both sides" if both else "takes no thrust"
        ledger.problem(f"bearings.{name}.takes", f"leave it out: this bearing {what}")
    if rollers is not None and takes:
        model = facing(model, rollers, takes)
    if model.geometry.kind.on_sphere:
        ledger.assume(f"{name}: a self-aligning bearing follows every tilt of the shaft without resistance")
    play = axial_play(model, bought_clearance(given, model)) if takes else 0.0
    drawn = TimeFunction.constant(growth - takes * (play + (given.preload or 0.0)))
    motions = [time_function(getattr(given.support, dof).motion) for dof in POSE]
    prescribed = (added(drawn, motions[0]), *motions[1:])
    dynamic, static, fatigue = _ratings(name, angle, model, ledger)
    return MountedBearing(
        name=name,
        position=given.place,
        model=model,
        carrier=carrier,
        seating=Seating(
            stiffness=_seat(name, given, model, carrier, ledger),
            shift=tuple(map(initial, prescribed)),
            force=-takes * (given.preload_force or 0.0),
            damping=tuple(getattr(given.support, dof).damping for dof in POSE),
            prescribed=prescribed,
        ),
        takes=takes,
        nominal_angle=angle,
        dynamic_rating=dynamic,
        static_rating=static,
        fatigue_limit=fatigue,
    )


def refuse_motion(name: str, given: MachineBearing, is_carried: bool, ledger: Ledger) -> None:
    """Note motions of a ring that are decided elsewhere.

    `is_carried` tells whether a body or an elastic housing carries the ring.
    """
    for dof in POSE:
        where, motion = f"bearings.{name}.support.{dof}.motion", getattr(given.support, dof).motion
        if motion is None:
            continue
        refuse_far(where, dof, time_function(motion), ledger)
        if is_carried:
            ledger.problem(
                where,
                "only a ring whose `outer` is the ground, without an elastic housing, can have a prescribed motion",
            )
        elif dof == "x" and given.preload_force is not None:
            ledger.problem(where, "`preload_force` makes the ring slide along x; give either it or this motion")


def _seat(name: str, given: MachineBearing, model: BearingModel, carrier: int, ledger: Ledger) -> tuple[float, ...]:
    """Return the stiffness of the seat.

    A seat that is locked in a moving body is very stiff; tilts are at its radius.
    """
    found = [_stiffness(given, dof) for dof in POSE]
    if carrier == GROUND or not any(map(math.isinf, found)):
        return tuple(found)
    radius = 0.5 * model.geometry.outside_diameter
    ledger.assume(f"{name}: its seat, locked in a body that moves, gives way by 1 um under {LOCKED * 1e-9:.0f} kN")
    return tuple(
        k if math.isfinite(k) else LOCKED * (radius**2 if dof.startswith("tilt") else 1.0)
        for dof, k in zip(POSE, found, strict=True)
    )


def _stiffness(given: MachineBearing, dof: str) -> float:
    """Return the housing's stiffness of one motion.

    It is infinite where the motion is locked and 0 where it is free.
    """
    held: Dof = getattr(given.support, dof)
    return 0.0 if dof == "x" and given.preload_force is not None and held.mode == "locked" else held.hold


def _ratings(name: str, angle: float, model: BearingModel, ledger: Ledger) -> tuple[float, float, float]:
    """Return C, C_0 and C_u [N].

    The catalogue's or the case's where they are known, else of the inner geometry.
    """
    known = {value.path: value.value for value in model.values if isinstance(value.value, float)}
    g = model.geometry
    dynamic, static, fatigue = (
        known.get(f"bearing.{key}") for key in ("dynamic_rating", "static_rating", "fatigue_limit")
    )
    size = (g.ball_count, g.ball_diameter, g.pitch_diameter)
    if dynamic is None:
        dynamic = dynamic_rating(*size, contact_angle=angle, rows=g.rated_rows, on_sphere=g.kind.on_sphere)
        ledger.assume(f"{name}: C = {dynamic * 1e-3:.1f} kN from the inner geometry (ISO 281)")
    if static is None:
        static = static_rating(*size, contact_angle=angle, rows=g.rated_rows, on_sphere=g.kind.on_sphere)
        ledger.assume(f"{name}: C_0 = {static * 1e-3:.1f} kN from the inner geometry (ISO 76)")
    if fatigue is None:
        fatigue = fatigue_load_limit(static, g.pitch_diameter)
        ledger.assume(f"{name}: C_u = {fatigue * 1e-3:.2f} kN from C_0 (ISO 281, simplified)")
    return dynamic, static, fatigue

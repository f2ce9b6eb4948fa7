"""Refuse bodies and prescribed motions that no bearing has.

A unit is wrong then, and no solver would find a motion.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lambda_core.case.case import Case
from lambda_core.domain.elements import BODIES, TILTS, TRANSLATIONS, BodyName
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.model.bearing_model import Body
from lambda_core.model.laws.time_functions import peak, time_function
from lambda_core.model.ledger import Ledger

# [m/s] on the pitch circle: a ring of steel would be under rho v^2 = 7.9 GPa of hoop stress (Timoshenko and Goodier,
# Theory of Elasticity, rotating rings), three times what bearing steel bears.
FASTEST = 1000.0
LARGEST_ROTOR = 10.0  # pitch diameters that the centre of mass of what stands on a ring is at most away from the axis


def check_possible(case: Case, geometry: Geometry, bodies: Mapping[BodyName, Body], ledger: Ledger) -> None:
    """Note what no bearing does.

    These are spins at which rings and cage fly apart, centres of mass far outside the bearing, and motions that carry
    balls out of their raceways or pockets.
    """
    _check_spins(case, geometry, ledger)
    for name, body in bodies.items():
        most = LARGEST_ROTOR * geometry.pitch_diameter * body.mass
        if body.unbalance > most:
            ledger.problem(
                f"bodies.{name}.unbalance",
                f"{show(body.unbalance, 'unbalance', 4)} put the centre of {show(body.mass, 'mass', 3)} more than "
                f"{LARGEST_ROTOR:g} pitch diameters from the axis: at most {show(most, 'unbalance', 3)}",
            )
    for dof in (*TRANSLATIONS, *TILTS):
        _check_motion(dof, geometry, bodies, ledger)


def _check_motion(dof: str, geometry: Geometry, bodies: Mapping[BodyName, Body], ledger: Ledger) -> None:
    """Compare prescribed motions with the free way.

    Balls leave it between rings, pockets leave it to balls.

    What a free body may follow is left alone.
    """
    ways = {name: peak(body.dofs[dof].motion) for name, body in bodies.items() if body.dofs[dof].mode != "free"}
    ball, quantity = geometry.ball_diameter, "length"
    if dof in TILTS:
        ball, quantity = ball / (0.5 * geometry.pitch_diameter), "angle"
    rings = [ways[name] for name in ("inner_ring", "outer_ring") if name in ways]
    for name, way in ways.items():
        others = rings if name == "cage" else [ways[other] for other in ways if other not in (name, "cage")]
        most = ball if name != "cage" else 0.5 * ball
        if others and way - max(others) > most:
            passed = "pockets pass their balls" if name == "cage" else "raceways pass each other"
            ledger.problem(
                f"bodies.{name}.{dof}.motion",
                f"reaches {show(way, quantity, 4)}: from {show(most, quantity, 3)} on {passed}",
            )


def _check_spins(case: Case, geometry: Geometry, ledger: Ledger) -> None:
    """Refuse prescribed spins that would burst parts.

    Rings and cage are the parts.
    """
    highest = 2.0 * FASTEST / geometry.pitch_diameter
    spins: dict[str, Any] = {"operation.speed": case.operation.speed}
    for name in BODIES:
        spins[f"bodies.{name}.spin.motion"] = getattr(getattr(case.bodies, name).spin, "motion", None)
    for place, motion in spins.items():
        if peak(time_function(motion)) > highest:
            ledger.problem(place, f"is too fast: steel bursts far below {show(highest, 'rotational_speed', 3)}")

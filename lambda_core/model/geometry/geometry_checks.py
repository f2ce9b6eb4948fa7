"""Check a bearing geometry and report each contradiction."""

from __future__ import annotations

import math
from collections.abc import Callable

from lambda_core.elements.ball.geometry import Geometry
from lambda_core.model.ledger import Ledger

# Contacts of a deep-groove bearing stay on the groove up to about this free contact angle.
LARGEST_FREE_ANGLE = math.radians(45.0)
# An interference of this share of the ball diameter alone presses every ball with about 4 GPa, the static
# limit of ISO 76 (Palmgren's 0.436e-6 Q^(2/3)/D_w^(1/3) scaled from a 6319: 2.05 GPa at 0.0019 D_w).
LARGEST_INTERFERENCE = 0.007


def mm(length: float) -> str:
    """Write a length for people."""
    return f"{length * 1e3:.6g} mm"


def check_geometry(geometry: Geometry, races: tuple[float | None, float | None], ledger: Ledger) -> None:
    """Note everything that makes a geometry impossible."""
    g = geometry
    ball, pitch = g.ball_diameter, g.pitch_diameter
    say = ledger.problem

    if not abs(g.clearance) < ball:
        say("bearing.clearance", f"{mm(g.clearance)} is not possible for balls of {mm(ball)}")
        return
    if not g.bore_diameter < pitch < g.outside_diameter:
        say(
            "bearing.geometry.pitch_diameter",
            f"{mm(pitch)} does not lie between the bore of {mm(g.bore_diameter)} and {mm(g.outside_diameter)} outside",
        )
        return
    if ball > pitch * math.sin(math.pi / g.ball_count):
        fits = math.floor(math.pi / math.asin(min(ball / pitch, 1.0)))
        say(
            "bearing.geometry.ball_count",
            f"{g.ball_count} balls of {mm(ball)} do not fit on a pitch diameter of {mm(pitch)}: at most {fits}",
        )
    for ring, radius in (("inner", g.groove_radius_inner), ("outer", g.groove_radius_outer)):
        if radius <= 0.5 * ball:
            say(
                f"bearing.geometry.groove_radius_{ring}",
                f"{mm(radius)} is a conformity of {radius / ball:.4g}: it must be larger than half the ball diameter",
            )
    if not g.bore_diameter < g.race_diameter_inner or not g.race_diameter_outer < g.outside_diameter:
        say(
            "bearing.geometry.ball_diameter",
            f"{mm(ball)} leaves no ring between raceway and bore or outside diameter",
        )
    if races[0] is not None and races[1] is not None:
        _check_races(g, races[0], races[1], say)
    inner_ok = g.race_diameter_inner < g.shoulder_diameter_inner < pitch
    outer_ok = pitch < g.shoulder_diameter_outer < g.race_diameter_outer
    if g.kind.on_sphere:
        _check_sphere(g, say)
        outer_ok = True
    for ring, fine, edge, race in (
        ("inner", inner_ok, g.shoulder_diameter_inner, g.race_diameter_inner),
        ("outer", outer_ok, g.shoulder_diameter_outer, g.race_diameter_outer),
    ):
        if not fine:
            say(
                f"bearing.geometry.shoulder_diameter_{ring}",
                f"{mm(edge)} must lie between raceway and pitch: "
                + " to ".join(mm(end) for end in sorted((race, pitch))),
            )
    grooves = ("inner",) if g.kind.on_sphere else ("inner", "outer")
    cut = 2.0 * max(_half_width(g, ring) for ring in grooves) + g.row_distance
    if g.rows == 2 and math.hypot(g.row_distance, pitch * math.sin(0.5 * math.pi / g.ball_count)) < ball:
        say("bearing.geometry.row_distance", f"{mm(g.row_distance)} lets the balls of both rows run into each other")
    if inner_ok and outer_ok and g.width <= cut:
        say("bearing.geometry.width", f"{mm(g.width)} is narrower than the grooves, which are {mm(cut)} wide")


def _check_sphere(g: Geometry, say: Callable[[str, str], None]) -> None:
    """Refuse a sphere that does not fit.

    The outer ring cannot hold it, or it ends before the rows.
    """
    if not 0.5 * g.row_distance < 0.5 * g.width:
        say("bearing.contact_angle", f"puts the rows {mm(g.row_distance)} apart, wider than the ring of {mm(g.width)}")
    elif not g.shoulder_diameter_outer <= g.race_diameter_outer < g.outside_diameter:
        say(
            "bearing.geometry.pitch_diameter",
            f"{mm(g.pitch_diameter)} makes a sphere of {mm(g.race_diameter_outer)}, which needs more than "
            f"{mm(g.outside_diameter)} outside",
        )


def _half_width(g: Geometry, ring: str) -> float:
    """Return half the chord of a groove [m].

    The chord joins the shoulders; its half is the square root of h (2 r - h).
    """
    radius = getattr(g, f"groove_radius_{ring}")
    height = 0.5 * abs(getattr(g, f"shoulder_diameter_{ring}") - getattr(g, f"race_diameter_{ring}"))
    return math.sqrt(max(height * (2.0 * radius - height), 0.0))


def _check_races(g: Geometry, inner: float, outer: float, say: Callable[[str, str], None]) -> None:
    if not inner < g.pitch_diameter < outer:
        say(
            "bearing.geometry.race_diameter_inner",
            f"raceways of {mm(inner)} and {mm(outer)} do not enclose the pitch",
        )
    elif abs(0.5 * (inner + outer) - g.pitch_diameter) > 0.02 * g.ball_diameter:
        say(
            "bearing.geometry.pitch_diameter",
            f"{mm(g.pitch_diameter)} contradicts the raceway diameters, whose mean is {mm(0.5 * (inner + outer))}",
        )
    elif abs(outer - inner - 2.0 * g.ball_diameter) > 0.05 * g.ball_diameter:
        say(
            "bearing.geometry.ball_diameter",
            f"{mm(g.ball_diameter)} contradicts the raceway diameters, which leave {mm(0.5 * (outer - inner))}",
        )


def check_clearance(g: Geometry, ledger: Ledger, *, has_grooves: bool = True) -> None:
    """Refuse a clearance of no real bearing.

    The free contact angle, or the preload, would be impossible. Raceways of rollers have no grooves:
    :func:`~lambda_core.model.geometry.roller_limits.check_roller_clearance` judges them.
    """
    if not math.isfinite(g.clearance):
        ledger.problem("bearing.clearance", "is not finite with these dimensions and temperatures: check their units")
        return
    if not has_grooves:
        return
    curvature = g.groove_radius_inner + g.groove_radius_outer - g.ball_diameter
    shown = f"{g.clearance * 1e6:.4g} um"
    most = 2.0 * curvature * (math.cos(g.resting_angle) - math.cos(LARGEST_FREE_ANGLE))
    if curvature > 0.0 and g.clearance > most:
        ledger.problem(
            "bearing.clearance", f"{shown} lets the contacts leave the grooves (free contact angle over 45 deg)"
        )
    if g.clearance < -LARGEST_INTERFERENCE * g.ball_diameter:
        limit = f"{-LARGEST_INTERFERENCE * g.ball_diameter * 1e6:.3g} um"
        ledger.problem("bearing.clearance", f"{shown} is more interference than a bearing survives (limit {limit})")

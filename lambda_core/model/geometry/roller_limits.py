"""Refuse rollers, ribs and profiles that cannot be built."""

from __future__ import annotations

import math
from collections.abc import Iterator

from lambda_core.case.parts import InlineGeometry
from lambda_core.case.rollers import SHARED_GEOMETRY
from lambda_core.domain.units import show
from lambda_core.elements.roller.line_contact import STEEL_MODULUS, iso_approach
from lambda_core.elements.roller.roller_bearing import RollerBearing
from lambda_core.elements.roller.roller_ratings import HIGHEST_ROLLER_PRESSURE
from lambda_core.elements.roller.slices import SLICES
from lambda_core.model.ledger import Ledger

SLENDEREST = 20.0  # length over diameter of any roller; needles have 3 to 10 (ISO 5593)


def is_possible(bearing: RollerBearing, ledger: Ledger) -> bool:
    """Tell whether a bearing can be built.

    The ledger gets what no roller bearing can have.
    """
    found = list(_impossible(bearing))
    for option, sentence in found:
        ledger.problem(f"bearing.rollers.{option}", sentence)
    return not found


def _impossible(bearing: RollerBearing) -> Iterator[tuple[str, str]]:
    """Yield options and what is wrong with them."""
    half = 0.5 * bearing.diameter
    if bearing.length > bearing.width:
        room = show(bearing.width, "length", 4)
        yield (
            "roller_length",
            f"{show(bearing.length, 'length', 4)}: a roller must fit into the bearing's width, {room}",
        )
    if bearing.length > SLENDEREST * bearing.diameter:
        diameter, length = (show(size, "length", 4) for size in (bearing.diameter, bearing.length))
        words = f"{diameter} is too thin for a roller of {length}: at most {SLENDEREST:g} diameters long"
        yield "roller_diameter", words
        return
    deepest = float(bearing.drops(SLICES).max())
    if not deepest < half:
        yield (
            "profile",
            (
                f"falls by {show(deepest, 'length', 3)} at the ends: must stay below half of the roller's diameter, "
                f"{show(half, 'length', 3)}"
            ),
        )
    if bearing.is_conical:
        large = bearing.diameter + bearing.length * math.tan(bearing.angles.half)
        if bearing.contact_height >= large:
            yield "contact_height", f"must be below the large end's diameter, {show(large, 'length', 4)}"
    elif bearing.rib_height >= half:
        yield "rib_height", f"must be below half of the roller's diameter, {show(half, 'length', 4)}"
        return
    least = half - 0.5 * bearing.rib_height
    if not bearing.is_conical and 0.0 < bearing.end_radius <= least:
        yield "end_radius", f"must be above {show(least, 'length', 4)}, where the end touches the rib"
        return
    try:
        _ = bearing.ribs
    except ValueError as error:
        yield "end_radius", f"leaves no contact with the rib: {error}"


def check_roller_clearance(bearing: RollerBearing, ledger: Ledger) -> None:
    """Refuse a clearance that no bearing survives.

    More interference than the static rating of ISO 76 allows presses every roller before any load; with more clearance
    than ribs are high, rollers leave them.
    """
    if bearing.is_conical:
        return
    most, tightest = bearing.rib_height or 0.5 * bearing.diameter, -largest_interference(bearing)
    shown = show(bearing.clearance, "small_length", 4)
    if bearing.clearance >= most:
        words = "lets rollers leave their ribs" if bearing.rib_height else "is not possible for these rollers"
        ledger.problem("bearing.clearance", f"{shown} {words}: must be below {show(most, 'length', 3)}")
    if bearing.clearance < tightest:
        ledger.problem(
            "bearing.clearance",
            f"{shown} is more interference than a bearing survives: every roller has the 4 GPa of the static rating "
            f"(ISO 76) at {show(tightest, 'small_length', 3)}",
        )


def largest_interference(bearing: RollerBearing) -> float:
    """Return the interference of 4 GPa [m].

    It alone presses every roller with the pressure of the static rating (ISO 76) on the inner raceway:
    w = 2 pi R p^2/E' (Johnson 1985, eq. 4.45), with the approach of ISO 16281 at both sides of the bearing.
    """
    modulus, radius = bearing.moduli[0], bearing.radius("inner")
    line_load = 2.0 * math.pi * radius * HIGHEST_ROLLER_PRESSURE**2 / modulus
    as_steel = line_load * bearing.effective_length * STEEL_MODULUS / modulus
    return 2.0 * float(iso_approach(as_steel, bearing.effective_length))


def refuse_geometry_of_balls(inline: InlineGeometry | None, ledger: Ledger) -> None:
    """Note values of [bearing.geometry] that describe balls."""
    for name in inline.model_fields_set if inline is not None else ():
        if name not in SHARED_GEOMETRY and getattr(inline, name) is not None:
            ledger.problem(
                f"bearing.geometry.{name}", "is that of ball bearings; rollers are described in bearing.rollers"
            )

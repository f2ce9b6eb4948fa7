"""Judge roller bearings of the catalogue for an operating point."""

from __future__ import annotations

import math

from lambda_core.catalogue.protocol import RollerRow
from lambda_core.elements.roller.axial_limit import axial_limit
from lambda_core.elements.roller.roller_bearing import FULL_COMPLEMENT, family_of
from lambda_core.elements.roller.roller_life import roller_basic_life
from lambda_core.elements.roller.roller_ratings import (
    roller_equivalent_load,
    roller_fatigue_load_limit,
    roller_static_load,
)
from lambda_core.formulas.life import (
    RADIAL_ROLLER,
    contamination_range,
    life_hours,
    life_modification_factor,
    reference_viscosity,
)
from lambda_core.model.checks.operating_limits import MINIMUM_ROLLER_LOAD
from lambda_core.model.fresh_case import HALF_LOADED_LINES

_THRUST = ("NJ", "NUP", "NCF")  # kinds whose ribs pass it on


def against_thrust(row: RollerRow, radial: float, axial: float, speed: float) -> str:
    """Return the objection of thrust to rollers.

    Loads are in N, the speed in rad/s; ribs count as oiled, the verdict of a solved bearing knows grease. The text is
    empty where ribs or cones carry the thrust, or there is none.
    """
    if row.contact_angle is not None:
        least = HALF_LOADED_LINES * math.tan(row.contact_angle.value) * radial
        if axial <= 0.0 or axial < least:
            return "have tapered rollers and need more axial load or a second bearing"
        return ""
    if axial == 0.0:
        return ""
    if row.kind not in _THRUST:
        return "have rollers that carry no axial load (NU, N, needle)"
    limits = axial_limit(
        radial,
        speed or 1.0,  # at rest heat does not count
        bore=row.bore_diameter.value,
        outside=row.outside_diameter.value,
        width=row.width.value,
        static_rating=row.static_rating.value,
        light_series=row.series == "2",
        complement="full" if row.kind in FULL_COMPLEMENT else "cage",
    )
    most = limits.continuous if speed > 0.0 else min(limits.mechanical, limits.guidance)
    return "have ribs that carry less axial load" if axial > most else ""


def against_load(
    row: RollerRow,
    loads: tuple[float, float],
    speed: float,
    wanted: tuple[float, float],
    viscosity: float | None,
    contamination: float | str | None,
) -> str:
    """Return the objection of loads to rollers.

    Life with the exponent 10/3 (ISO 281), static safety (ISO 76), minimum load 0.02 C.

    Parameters
    ----------
    loads : tuple of float
        Radial and axial [N].
    speed : float
        Of the inner ring [rad/s].
    wanted : tuple of float
        Life [h] and static safety.
    viscosity, contamination
        Of the oil in operation [m2/s], and e_C or its level, where modified lives count.
    """
    radial, axial = loads
    life, safety = wanted
    angle = row.contact_angle.value if row.contact_angle is not None else 0.0
    thrust = axial if angle > 0.0 else 0.0
    load = roller_equivalent_load(radial, thrust, angle).load
    if row.static_rating.value < safety * roller_static_load(radial, thrust, angle):
        return "have too little static safety"
    if speed > 0.0 and load < MINIMUM_ROLLER_LOAD * row.dynamic_rating.value:
        return "have rollers that are loaded below 0.02 C"
    found = life_hours(roller_basic_life(row.dynamic_rating.value, load), speed)
    if viscosity is not None and contamination is not None and speed > 0.0:
        pitch = row.pitch_diameter.value
        dirt = contamination_range(contamination, pitch)[0] if isinstance(contamination, str) else contamination
        given, static = row.fatigue_limit, row.static_rating.value
        limit = given.value if given is not None else roller_fatigue_load_limit(static, pitch)
        ratio = viscosity / reference_viscosity(speed, pitch)
        found *= life_modification_factor(ratio, dirt, limit, load, RADIAL_ROLLER) if ratio >= 0.1 else 0.0
    return "do not reach the life" if found < life else ""


def is_of_kind(row: RollerRow, kind: str | None) -> bool:
    """Tell whether rollers are of a kind or family."""
    return kind is None or kind in (row.kind, family_of(row.kind))

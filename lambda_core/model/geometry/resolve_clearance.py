"""Resolve the clearance: as bought, mounted and warm."""

from __future__ import annotations

import math

from lambda_core.case.case import Case
from lambda_core.case.parts import CLEARANCE_CLASSES, Bearing, Fits
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.domain.units import parse, show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.formulas.fits import (
    REFERENCE_TEMPERATURE,
    Mounting,
    OperatingClearance,
    Rings,
    Seat,
    Solid,
    Temperatures,
    housing_interference,
    operating_clearance,
    shaft_interference,
)
from lambda_core.formulas.kind_clearance import KindClearance
from lambda_core.formulas.tolerances import Limits
from lambda_core.model.ledger import Ledger

PATH = "bearing.clearance"
CLEARANCE_HOLDS = "the clearance is that of the mounted, warm bearing"
Races = tuple[float | None, float | None]


def clearance_as_bought(
    bearing: Bearing, races: Races, ball: float, bore: float, catalogue: Catalogue, ledger: Ledger
) -> Limits | None:
    """Return the limits of the bought clearance [m].

    They limit the radial internal clearance; the result is None after a problem.

    Parameters
    ----------
    races : tuple of float or None
        Raceway diameters at the grooves' bottoms, inner and outer [m].
    ball, bore : float
        Ball diameter and bore [m].
    """
    inline = bearing.geometry
    both_inline = bool(inline and inline.race_diameter_inner and inline.race_diameter_outer)
    text = bearing.clearance or ("geometry" if both_inline else "CN")
    from_races = races[1] - races[0] - 2.0 * ball if races[0] and races[1] else math.nan
    if text[:2] in CLEARANCE_CLASSES:
        return _from_class(bearing, text, bore, catalogue, ledger)
    if text == "geometry":
        if math.isnan(from_races):
            ledger.problem(PATH, '"geometry" needs both raceway diameters and the ball diameter')
            return None
        ledger.record(PATH, from_races, "small_length", "from the raceway diameters", "derived")
        return Limits(from_races, from_races)
    clearance = parse(text, "small_length")
    ledger.given(PATH, clearance, "small_length")
    if both_inline and abs(clearance - from_races) > 0.5e-6:
        implied = show(from_races, "small_length", 4)
        ledger.problem(PATH, f'"{text}" contradicts the raceway diameters, which leave {implied}: give one of them')
    return Limits(clearance, clearance)


def _from_class(bearing: Bearing, name: str, bore: float, catalogue: Catalogue, ledger: Ledger) -> Limits | None:
    row = None if math.isnan(bore) else ledger.ask(PATH, lambda: catalogue.clearance(bore, name[:2]))
    if row is None:
        return None
    limits = Limits(row.minimum, row.maximum)
    if name[2:]:
        above = _class_above(name, bore, catalogue, ledger) if name.endswith("P") else limits
        if above is None:
            return None
        limits = part_of_class(limits, above, name[2:])
    pick = bearing.clearance_pick
    clearance = picked(limits, pick)
    ledger.record(PATH, clearance, "small_length", f"{pick} of {name}: {row.source}", "assumed", row.grade)
    stated = "" if bearing.clearance else "class not stated, "
    span = f"{limits.minimum * 1e6:.4g} to {limits.maximum * 1e6:.4g} um"
    ledger.assume(f"clearance {show(clearance, 'small_length', 4)}: {stated}{pick} of {name} ({span})")
    return limits


def class_of_kind(table: KindClearance, bearing: Bearing, bore: float, where: str, ledger: Ledger) -> Limits | None:
    """Return the limits of a clearance class [m].

    The kind has limits of its own. The class is CN where none is named; the result is None after a problem.

    Parameters
    ----------
    bore : float
        [m]
    where : str
        Path of the clearance that the table is of, radial or axial.
    """
    name = bearing.clearance or "CN"
    if math.isnan(bore):
        return None
    try:
        limits = table.limits(bore, name)
    except ValueError as error:
        ledger.problem(PATH, str(error))
        return None
    value = picked(limits, bearing.clearance_pick)
    ledger.record(where, value, "small_length", f"{bearing.clearance_pick} of {name}: {table.source}", "assumed", "A-")
    stated = "" if bearing.clearance else "class not stated, "
    span = f"{limits.minimum * 1e6:.4g} to {limits.maximum * 1e6:.4g} um"
    what = "axial clearance" if table.direction == "axial" else "clearance"
    ledger.assume(f"{what} {show(value, 'small_length', 4)}: {stated}{bearing.clearance_pick} of {name} ({span})")
    return limits


def _class_above(name: str, bore: float, catalogue: Catalogue, ledger: Ledger) -> Limits | None:
    index = CLEARANCE_CLASSES.index(name[:2]) + 1
    if index == len(CLEARANCE_CLASSES):
        ledger.problem(PATH, f'"{name}" reaches into the class above {name[:2]}, and there is none: write a value')
        return None
    row = ledger.ask(PATH, lambda: catalogue.clearance(bore, CLEARANCE_CLASSES[index]))
    return Limits(row.minimum, row.maximum) if row else None


def part_of_class(limits: Limits, above: Limits, part: str) -> Limits:
    """Return the part of a clearance class.

    A letter behind the class stands for it.

    L lower half, H upper half, M the two middle quarters, P the upper half and the lower half of the next class
    (`above`); the convention of SKF's supplementary designations.
    """
    quarter = 0.25 * (limits.maximum - limits.minimum)
    middle = limits.minimum + 2.0 * quarter
    return {
        "L": Limits(limits.minimum, middle),
        "H": Limits(middle, limits.maximum),
        "M": Limits(middle - quarter, middle + quarter),
        "P": Limits(middle, 0.5 * (above.minimum + above.maximum)),
    }[part]


def picked(limits: Limits, pick: str) -> float:
    """Return the minimum, middle or maximum of a tolerated quantity."""
    return {"minimum": limits.minimum, "middle": limits.middle, "maximum": limits.maximum}[pick]


def resolve_mounting(
    case: Case, geometry: Geometry, bought: Limits, rings: Solid, balls: Solid, ledger: Ledger
) -> Mounting | None:
    """Return the data of the operating clearance.

    It lacks the temperatures; the result is None after a problem.
    """
    fits, given = case.bearing.fits, case.bearing.temperatures
    shaft, housing = _seats(fits, geometry, ledger) if fits else (None, None)
    try:
        diameters = Rings(
            bore_diameter=geometry.bore_diameter,
            outside_diameter=geometry.outside_diameter,
            race_diameter_inner=geometry.race_diameter_inner,
            race_diameter_outer=geometry.race_diameter_outer,
            ball_diameter=geometry.ball_diameter,
            rings=rings,
            balls=balls,
        )
    except ValueError as error:
        if fits is not None or given is not None or case.operation.temperatures == "computed":
            ledger.problem("bearing.fits", str(error))
        return None
    reference = given.reference if given else REFERENCE_TEMPERATURE
    return Mounting(diameters, bought, shaft, housing, case.bearing.clearance_pick, reference)


def clearance_in_operation(case: Case, geometry: Geometry, mounting: Mounting, ledger: Ledger) -> float:
    """Return the operating radial clearance [m].

    It is that of the mounted, warm bearing; each step is recorded.

    Without [bearing.fits] and [bearing.temperatures] the clearance counts as that in operation.
    """
    bearing = case.bearing
    if bearing.fits is None and bearing.temperatures is None:
        if case.operation.temperatures == "given":
            ledger.assume(f"{CLEARANCE_HOLDS}: no fits or temperatures are given")
        return geometry.clearance
    try:
        found = operating_clearance(
            mounting.rings, mounting.bought, mounting.shaft, mounting.housing, _temperatures(case)
        )
    except ValueError as error:
        ledger.problem("bearing.fits", str(error))
        return geometry.clearance
    return _recorded(found, bearing.clearance_pick, ledger)


def _recorded(found: OperatingClearance, pick: str, ledger: Ledger) -> float:
    clearance = picked(found.limits, pick)
    for step in found.steps:
        value = picked(step.limits, pick)
        ledger.record(f"{PATH}: {step.name}", value, "small_length", step.explanation, "derived")
    ledger.assume(
        f"clearance in operation {show(clearance, 'small_length', 4)}: {pick} of the mounted, warm bearing "
        "(steel shaft and housing; seats ground where an ISO class is given)"
    )
    return clearance


def _seats(fits: Fits, geometry: Geometry, ledger: Ledger) -> tuple[Seat | None, Seat | None]:
    """Return the seats of both rings.

    A class is a ground seat, a value is the effective interference.
    """
    shaft = _interference("shaft", fits.shaft, geometry.bore_diameter, ledger)
    housing = _interference("housing", fits.housing, geometry.outside_diameter, ledger)
    bore = fits.shaft_bore or math.nan
    outside = fits.housing_outside_diameter
    return (
        Seat(shaft[0], free_diameter=bore, finish=shaft[1]) if shaft else None,
        Seat(housing[0], free_diameter=outside or math.nan, finish=housing[1]) if housing else None,
    )


def _interference(part: str, text: str | None, diameter: float, ledger: Ledger) -> tuple[Limits, str] | None:
    if text is None:
        return None
    try:
        value = parse(text, "small_length")
        return Limits(value, value), "none"
    except ValueError:
        of_class = shaft_interference if part == "shaft" else housing_interference
    try:
        return of_class(diameter, text), "ground"
    except ValueError as error:
        ledger.problem(f"bearing.fits.{part}", str(error))
        return None


def _temperatures(case: Case) -> Temperatures:
    """Return the parts' temperatures.

    Absent ones are the oil's; shaft and housing have those of their rings.
    """
    given = case.bearing.temperatures
    if given is None:
        return Temperatures()
    oil = case.lubricant.temperature
    inner, outer = given.inner_ring or oil, given.outer_ring or oil
    return Temperatures(
        inner_ring=inner,
        outer_ring=outer,
        balls=given.balls or oil,
        shaft=given.shaft or inner,
        housing=given.housing or outer,
        reference=given.reference,
    )

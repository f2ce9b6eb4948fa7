"""Write a commented case for any bearing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lambda_core.elements.ball.kinds import kinds
from lambda_core.elements.roller.roller_bearing import kind_words
from lambda_core.model.machine_templates import ROLLERS, MachineTemplate, start_text

if TYPE_CHECKING:
    from lambda_core.catalogue.designation import Designation
    from lambda_core.catalogue.protocol import BearingRow
    from lambda_core.catalogue.roller_designation import RollerDesignation

_NO_RATING = 10e3  # [N], where the catalogue has no rating to take a share of
_MOST_SPEED = 0.5  # of the limiting speed that a new case starts with
_PICK = '\nclearance_pick = "middle"'
_MEASURED = 'or a measured value such as "{}"'
# Thrust over radial load times tan(alpha) at which half the circumference is loaded (NSK, CAT. No. E728, 5.1);
# with less fewer balls carry, and an angular contact bearing alone comes apart.
HALF_LOADED = 1.216
# The same for line contact (Harris and Kotzalas, vol. 1, ch. 7: 1.215), and some more.
HALF_LOADED_LINES = 1.3


@dataclass(frozen=True)
class FreshBearing:
    """Bearing of a new case, with its template.

    Attributes
    ----------
    title : str
        Kind, for the first line.
    designation, maker : str
    rating : float or None
        Dynamic load rating C [N].
    limiting_speed : float
        [rad/s]; inf where the catalogue has none.
    clearance : str
        Lines of clearance or contact angle.
    thrust, why : float, str
        Axial over radial load, and the comment on it.
    machine : MachineTemplate
    """

    title: str
    designation: str
    maker: str
    rating: float | None
    limiting_speed: float
    clearance: str
    thrust: float
    why: str
    machine: MachineTemplate


def fresh_balls(row: BearingRow, read: Designation, machine: MachineTemplate) -> FreshBearing:
    """Describe a ball bearing in a machine."""
    thrust, why = _thrust(machine, row)
    return FreshBearing(
        title=kinds()[row.kind].title,
        designation=read.text,
        maker=row.maker,
        rating=row.dynamic_rating.value if row.dynamic_rating else None,
        limiting_speed=row.limiting_speed.value if row.limiting_speed else math.inf,
        clearance=_clearance(machine, row, read),
        thrust=thrust,
        why=why,
        machine=machine,
    )


def fresh_rollers(found: RollerDesignation) -> FreshBearing:
    """Describe a roller bearing; a tapered one has no clearance."""
    row, words = found.row, kind_words(found.row.kind)
    thrust, why = 0.0, "along the shaft; NU and N take none, NJ and NUP through their ribs"
    if row.contact_angle is not None:
        thrust = HALF_LOADED_LINES * math.tan(row.contact_angle.value)
        why = "along the shaft; with less the bearing alone opens"
    return FreshBearing(
        title=f"{words[0].upper()}{words[1:]} roller bearing",
        designation=" ".join(word for word in found.text.split() if word.upper() != row.maker.upper()),
        maker=row.maker,
        rating=row.dynamic_rating.value,
        limiting_speed=math.inf,
        clearance="" if row.contact_angle is not None or found.clearance else _class(ROLLERS.clearance, "40 um"),
        thrust=thrust,
        why=why,
        machine=ROLLERS,
    )


def fresh_case(name: str, bearing: FreshBearing, given: float | None = None) -> str:
    """Write the case of a bearing in a machine.

    Loads follow from its rating, everything else is default.

    Suffixes of the designation stay in it and decide what they stand for. A `given` radial load [N] takes the place of
    that by the rating, and the axial load follows from it.
    """
    machine, rating = bearing.machine, bearing.rating
    radial = machine.load * (rating or _NO_RATING) if given is None else abs(given)
    part = "a tenth of C" if machine.load == 0.1 else f"{machine.load:.2g} of C"
    share = f"{part} = {rating / 1e3:.4g} kN" if rating else "the catalogue has no load rating"
    oil, load, speed = machine.about
    about = f"{share}; {load}" if given is None else load
    rpm = min(machine.speed, _MOST_SPEED * bearing.limiting_speed * 30.0 / math.pi)
    return start_text(
        "one-bearing",
        kind=bearing.title,
        name=name,
        designation=bearing.designation,
        words=f", {machine.words}" if machine.words else "",
        maker=bearing.maker,
        clearance=f"{bearing.clearance}\n" if bearing.clearance else "",
        oil=_told(f'name = "{machine.oil}"', oil),
        temperature=_told(f'temperature = "{machine.temperature} degC"', ""),
        radial=_told(f'radial = "{_newton(radial)}"', about),
        axial=_told(f'axial = "{_newton(bearing.thrust * radial)}"', bearing.why),
        speed=_told(f'speed = "{rpm:.4g} rpm"', speed),
        tail=f"\n{machine.tail}" if machine.tail else "",
    )


def _clearance(machine: MachineTemplate, bearing: BearingRow, read: Designation) -> str:
    """Return the lines of clearance or contact angle.

    The clearance may follow from the contact angle.
    """
    classes = [written for written, suffix in read.suffixes if suffix.kind == "clearance"]
    axial = kinds()[bearing.kind].axial_clearance
    if axial and not classes:
        other = f'or axial_clearance = "{axial}"'
        return _told('clearance = "CN"', f"class of the axial clearance, {other}") + _PICK
    if bearing.needs_thrust and bearing.contact_angle is not None:
        angle = f"{math.degrees(bearing.contact_angle.value):.3g} deg"
        return _told(f'# contact_angle = "{angle}"', "of the catalogue: the clearance follows from it")
    if classes:
        why = f"stands in the designation; {_MEASURED.format('14 um').removeprefix('or ')} would win"
        return _told(f'# clearance = "{classes[0]}"', why) + _PICK
    return _class(machine.clearance, "14 um")


def _class(clearance: str, measured: str) -> str:
    return _told(f'clearance = "{clearance}"', f"class of ISO 5753-1, {_MEASURED.format(measured)}") + _PICK


def _thrust(machine: MachineTemplate, bearing: BearingRow) -> tuple[float, str]:
    """Return axial over radial load, with comment.

    Angular contact needs enough axial load to be held together.
    """
    least = kinds()[bearing.kind].least_thrust
    if least > 0.0:
        return max(machine.thrust, least), f"along the shaft: {least:g} of the radial load at least, SKF"
    alone = bearing.needs_thrust and bearing.contact_angle is not None
    least = HALF_LOADED * math.tan(bearing.contact_angle.value) if alone and bearing.contact_angle else 0.0
    if least > machine.thrust:
        return 1.1 * least, "along the shaft; less opens a single angular contact bearing"
    return machine.thrust, f"{machine.thrust:.2g} of it, along the shaft" if machine.thrust else "along the shaft"


def _told(text: str, why: str) -> str:
    return f"{text:<25} # {why}" if why else text


def _newton(load: float) -> str:
    return f"{load / 1e3:.3g} kN" if load >= 1e3 else f"{load:.3g} N"

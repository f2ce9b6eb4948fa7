"""Write a commented case for any ball bearing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lambda_core.elements.ball.kinds import kinds
from lambda_core.model.machine_templates import GENERAL, MachineTemplate

if TYPE_CHECKING:
    from lambda_core.catalogue.designation import Designation
    from lambda_core.catalogue.protocol import BearingRow

_TEXT = """\
# {kind} {designation} of {maker}{words}: change what differs on your machine.
name = "{name}"
description = "{designation} of {maker}{words}"

[bearing]
designation = "{designation}"
maker = "{maker}"
{clearance}

[lubricant]
{oil}
{temperature}

[loads]
{radial}
{axial}

[operation]
{speed}

{tail}"""
_NO_RATING = 10e3  # [N], where the catalogue has no rating to take a share of
_MOST_SPEED = 0.5  # of the limiting speed that a new case starts with
_PICK = '\nclearance_pick = "middle"'
_MEASURED = 'or a measured value such as "14 um"'
# Thrust over radial load times tan(alpha) at which half the circumference is loaded (NSK, CAT. No. E728, 5.1);
# with less fewer balls carry, and an angular contact bearing alone comes apart.
HALF_LOADED = 1.216


def fresh_case(
    name: str,
    bearing: BearingRow,
    read: Designation,
    machine: MachineTemplate = GENERAL,
    given: float | None = None,
) -> str:
    """Write the case of a bearing in a machine.

    Loads follow from its rating, everything else is default.

    Suffixes of the designation stay in it and decide what they stand for. A `given` radial load [N] takes the place of
    that by the rating, and the axial load follows from it.
    """
    rating = bearing.dynamic_rating
    radial = machine.load * (rating.value if rating else _NO_RATING) if given is None else abs(given)
    part = "a tenth of C" if machine.load == 0.1 else f"{machine.load:.2g} of C"
    share = f"{part} = {rating.value / 1e3:.4g} kN" if rating else "the catalogue has no load rating"
    oil, load, speed = machine.about
    about = f"{share}; {load}" if given is None else load
    share_of, why = _thrust(machine, bearing)
    return _TEXT.format(
        kind=kinds()[bearing.kind].title,
        name=name,
        designation=read.text,
        words=f", {machine.words}" if machine.words else "",
        maker=bearing.maker,
        clearance=_clearance(machine, bearing, read),
        oil=_told(f'name = "{machine.oil}"', oil),
        temperature=_told(f'temperature = "{machine.temperature} degC"', ""),
        radial=_told(f'radial = "{_newton(radial)}"', about),
        axial=_told(f'axial = "{_newton(share_of * radial)}"', why),
        speed=_told(f'speed = "{_speed(machine, bearing):.4g} rpm"', speed),
        tail=machine.tail,
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
    if bearing.kind == "angular contact" and bearing.contact_angle is not None:
        angle = f"{math.degrees(bearing.contact_angle.value):.3g} deg"
        return _told(f'# contact_angle = "{angle}"', "of the catalogue: the clearance follows from it")
    if classes:
        why = f"stands in the designation; {_MEASURED.removeprefix('or ')} would win"
        return _told(f'# clearance = "{classes[0]}"', why) + _PICK
    return _told(f'clearance = "{machine.clearance}"', f"class of ISO 5753-1, {_MEASURED}") + _PICK


def _thrust(machine: MachineTemplate, bearing: BearingRow) -> tuple[float, str]:
    """Return axial over radial load, with comment.

    Angular contact needs enough axial load to be held together.
    """
    least = kinds()[bearing.kind].least_thrust
    if least > 0.0:
        return max(machine.thrust, least), f"along the shaft: {least:g} of the radial load at least, SKF"
    alone = bearing.kind == "angular contact" and bearing.contact_angle is not None
    least = HALF_LOADED * math.tan(bearing.contact_angle.value) if alone and bearing.contact_angle else 0.0
    if least > machine.thrust:
        return 1.1 * least, "along the shaft; less opens a single angular contact bearing"
    return machine.thrust, f"{machine.thrust:.2g} of it, along the shaft" if machine.thrust else "along the shaft"


def _told(text: str, why: str) -> str:
    return f"{text:<25} # {why}" if why else text


def _newton(load: float) -> str:
    return f"{load / 1e3:.3g} kN" if load >= 1e3 else f"{load:.3g} N"


def _speed(machine: MachineTemplate, bearing: BearingRow) -> float:
    """Return the initial speed [rpm].

    Well below the limit of the bearing where the catalogue has one.
    """
    limit = bearing.limiting_speed
    return min(machine.speed, _MOST_SPEED * limit.value * 30.0 / math.pi) if limit else machine.speed

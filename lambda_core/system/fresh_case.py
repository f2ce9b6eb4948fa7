"""A commented case to start from, for any bearing of the catalogue."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lambda_core.system.machine_templates import GENERAL, Machine

if TYPE_CHECKING:
    from lambda_core.catalogue.designation import Designation
    from lambda_core.catalogue.protocol import BearingRow

_TEXT = """\
# Deep-groove ball bearing {designation} of {maker}{words}: change what differs on your machine.
name = "{name}"
description = "{designation} of {maker}{words}"

[bearing]
designation = "{designation}"
maker = "{maker}"
{clearance}
clearance_pick = "middle"

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
_MEASURED = 'or a measured value such as "14 um"'


def fresh_case(name: str, bearing: BearingRow, read: Designation, machine: Machine = GENERAL) -> str:
    """Write the text of a case for a bearing in a machine: loads by its rating, everything else default.

    Suffixes of the designation stay in it and decide what they stand for.
    """
    classes = [written for written, suffix in read.suffixes if suffix.kind == "clearance"]
    rating = bearing.dynamic_rating
    radial = machine.load * (rating.value if rating else _NO_RATING)
    part = "a tenth of C" if machine.load == 0.1 else f"{machine.load:.2g} of C"
    share = f"{part} = {rating.value / 1e3:.4g} kN" if rating else "the catalogue has no load rating"
    oil, load, speed = machine.about
    thrust = f"{machine.thrust:.2g} of it, along the shaft" if machine.thrust else "along the shaft"
    return _TEXT.format(
        name=name,
        designation=read.text,
        words=f", {machine.words}" if machine.words else "",
        maker=bearing.maker,
        clearance=_told(
            f'# clearance = "{classes[0]}"', f"stands in the designation; {_MEASURED.removeprefix('or ')} would win"
        )
        if classes
        else _told(f'clearance = "{machine.clearance}"', f"class of ISO 5753-1, {_MEASURED}"),
        oil=_told(f'name = "{machine.oil}"', oil),
        temperature=_told(f'temperature = "{machine.temperature} degC"', ""),
        radial=_told(f'radial = "{_newton(radial)}"', f"{share}; {load}"),
        axial=_told(f'axial = "{_newton(machine.thrust * radial)}"', thrust),
        speed=_told(f'speed = "{_speed(machine, bearing):.4g} rpm"', speed),
        tail=machine.tail,
    )


def _told(text: str, why: str) -> str:
    return f"{text:<25} # {why}" if why else text


def _newton(load: float) -> str:
    return f"{load / 1e3:.3g} kN" if load >= 1e3 else f"{load:.3g} N"


def _speed(machine: Machine, bearing: BearingRow) -> float:
    """Return the speed to start with [rpm], well below the limit of the bearing where the catalogue has one."""
    limit = bearing.limiting_speed
    return min(machine.speed, _MOST_SPEED * limit.value * 30.0 / math.pi) if limit else machine.speed

"""Write a commented case for any roller bearing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from lambda_core.elements.roller.roller_bearing import kind_words

if TYPE_CHECKING:
    from lambda_core.catalogue.roller_designation import RollerDesignation

_TEXT = """\
# {kind} roller bearing {designation} of {maker}: change what differs on your machine.
name = "{name}"
description = "{designation} of {maker}"

[bearing]
designation = "{designation}"
maker = "{maker}"
{clearance}
[lubricant]
name = "FVA3"
temperature = "60 degC"

[loads]
radial = "{radial:.3g} kN"{share}
axial = "{axial:.3g} kN"        # {why}

[operation]
speed = "1500 rpm"
"""
_CLEARANCE = """\
clearance = "CN"          # class of ISO 5753-1, or a measured value such as "40 um"
clearance_pick = "middle"
"""
_SHARE = 0.1  # of C that a new case is loaded with
# Thrust over radial load times tan(alpha) at which half the circumference is loaded, line contact (Harris and Kotzalas,
# vol. 1, ch. 7: 1.215), and some more.
_HALF_LOADED = 1.3


def fresh_roller_case(name: str, found: RollerDesignation, given: float | None = None) -> str:
    """Return the case of a roller bearing.

    Loads follow from its rating, everything else is default.

    A `given` radial load [N] takes the place of that by the rating, and the axial load follows from it.
    """
    row = found.row
    rating = 1e-3 * row.dynamic_rating.value
    radial = _SHARE * rating if given is None else 1e-3 * abs(given)
    axial, why = 0.0, "along the shaft; NU and N take none, NJ and NUP through their ribs"
    if row.contact_angle is not None:
        axial = _HALF_LOADED * math.tan(row.contact_angle.value) * radial
        why = "along the shaft; with less the bearing alone opens"
    kind = kind_words(row.kind)
    return _TEXT.format(
        kind=kind[0].upper() + kind[1:],
        designation=" ".join(word for word in found.text.split() if word.upper() != row.maker.upper()),
        maker=row.maker,
        name=name,
        clearance="" if row.contact_angle is not None or found.clearance else _CLEARANCE,
        radial=radial,
        axial=axial,
        share=f"       # a tenth of C = {rating:.4g} kN" if given is None else "",
        why=why,
    )

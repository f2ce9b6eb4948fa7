"""A commented case to start from, for any bearing of the catalogue."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.catalogue.designation import Designation
    from lambda_core.catalogue.protocol import BearingRow

_TEXT = """\
# Deep-groove ball bearing {designation} of {maker}: change what differs on your machine.
name = "{name}"
description = "{designation} of {maker}"

[bearing]
designation = "{designation}"
maker = "{maker}"
{clearance}
clearance_pick = "middle"

[lubricant]
name = "FVA3A"            # lambda-bearing db search --lubricants
temperature = "60 degC"

[loads]
radial = "{load}"{pad}# {why}; acts downwards on the inner ring
axial = "0 N"             # along the shaft

[operation]
speed = "1500 rpm"        # inner ring; the outer ring stands still

[bodies.inner_ring]
tilt_y = "locked"         # a shaft on two bearings hardly tilts; "free" where nothing else holds it,
tilt_z = "locked"         # or {{ stiffness = "20 N m/mrad" }} of the shaft
"""
_NO_RATING = 1000.0  # [N], where the catalogue has no rating to take a tenth of


_CLASS = 'clearance = "CN"          # class of ISO 5753-1, or a measured value such as "14 um"'
_CLASS_OF_SUFFIX = '# clearance = "{}"        # stands in the designation; a measured value such as "14 um" would win'


def fresh_case(name: str, bearing: BearingRow, read: Designation) -> str:
    """Write the text of a case for a bearing: a tenth of its dynamic rating as radial load, everything else default.

    Suffixes of the designation stay in it and decide what they stand for.
    """
    classes = [written for written, suffix in read.suffixes if suffix.kind == "clearance"]
    rating = bearing.dynamic_rating
    load = f"{(0.1 * rating.value if rating else _NO_RATING) / 1e3:.4g} kN"
    why = f"a tenth of C = {rating.value / 1e3:.4g} kN" if rating else "the catalogue has no load rating"
    return _TEXT.format(
        name=name,
        designation=read.text,
        clearance=_CLASS_OF_SUFFIX.format(classes[0]) if classes else _CLASS,
        maker=bearing.maker,
        load=load,
        why=why,
        pad=" " * max(1, 15 - len(load)),
    )

"""Recognise designations of bearings that are not simulated."""

from __future__ import annotations

import re

# Series of ISO 15, ISO 104 and ISO 5593 and makers' own ones (SKF, Rolling bearings, 2018, "Basic designations"): what
# a bearing is, and the kind that is simulated and has its raceways or takes its loads best.
_TAPERED = 'tapered roller bearings, such as "32216"'
_CYLINDRICAL = 'cylindrical roller bearings of one row, such as "NU 208"'
_KINDS = (
    (r"(213|222|223|230|231|232|233|238|239|240|241|248|249)", "a spherical roller bearing", _TAPERED),
    (r"(51[1-4]|52[2-4]|53[2-4]|54[2-4])", "a thrust ball bearing", 'angular contact ball bearings, such as "7208B"'),
    (r"(811|812|874|893|894|AXK\d?)", "a cylindrical or needle roller thrust bearing", _TAPERED),
    (r"(292|293|294)", "a spherical roller thrust bearing", _TAPERED),
    (r"NNU?(30|40|41|48|49|50|60)", "a double row cylindrical roller bearing", _CYLINDRICAL),
    (r"C(22|23|30|31|32|39|40|41|49|50|59|60|69)", "a toroidal roller bearing", 'needle rollers, such as "NA 4905"'),
)


def other_kind(designation: str) -> str | None:
    """Return a sentence about a kind that is not simulated.

    None for a designation of no such kind.
    """
    squeezed = re.sub(r"\s+", "", designation.upper())
    for series, what, instead in _KINDS:
        if re.search(rf"(?<!\d){series}(\d\d|/\d{{3,4}})(?!\d)", squeezed):
            return f'"{designation}" is {what}, a kind that is not simulated; nearest kind: {instead}'
    return None

"""Resolve the profile of the rollers of a case."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from lambda_core.case.rollers import InlineRollers
from lambda_core.catalogue.protocol import RollerRow
from lambda_core.domain.units import show
from lambda_core.model.ledger import Ledger

# Options that a profile needs, and those that it may have; the others are refused.
_NEEDS: Mapping[str, tuple[str, ...]] = {
    "logarithmic": ("profile_scale", "profile_length"),
    "crowned": ("profile_radius",),
    "two-radii": ("profile_length", "profile_radius"),
    "tabulated": ("profile_points",),
}
_MAY: Mapping[str, tuple[str, ...]] = {"two-radii": ("profile_middle_radius",)}
_OPTIONS = ("profile_scale", "profile_length", "profile_radius", "profile_middle_radius", "profile_points")


def profile_of(
    rollers: InlineRollers, row: RollerRow | None, diameter: float, length: float, ledger: Ledger
) -> dict[str, Any]:
    """Return a profile's fields of RollerBearing.

    They come from the case, otherwise from the catalogue, otherwise from ISO 16281.

    Parameters
    ----------
    diameter, length : float
        Of the roller, and effective length of its contacts [m].
    """
    written = {name: getattr(rollers, name) for name in _OPTIONS if getattr(rollers, name) is not None}
    given = dict(written)
    if row is not None and rollers.profile in (None, "logarithmic"):
        known = {"profile_scale": row.profile_scale, "profile_length": row.profile_length}
        given = {name: value.value for name, value in known.items() if value is not None} | written
    name = rollers.profile or ("logarithmic" if {*_NEEDS["logarithmic"]} <= {*given} else "iso")
    needs = _NEEDS.get(name, ())
    takes = (*needs, *_MAY.get(name, ()))
    if missing := [option for option in needs if option not in given]:
        ledger.problem("bearing.rollers.profile", f"{name} needs {' and '.join(needs)}; {missing[0]} is absent")
        return {}
    for option in written:
        if option not in takes:
            ledger.problem(f"bearing.rollers.{option}", f"is no option of the profile {name}: leave it out")
    if name == "iso" and rollers.profile is None:
        ledger.assume("profile of the rollers after ISO 16281: none is given")
    if problem := _no_profile(name, given, length):
        ledger.problem(*problem)
        return {}
    found = {option: value for option, value in given.items() if option in takes}
    if "profile_scale" in found:
        found["profile_scale"] *= diameter
    if "profile_points" in found:
        found["profile_points"] = tuple(found["profile_points"])
    return {"profile": name, **found}


def _no_profile(name: str, given: Mapping[str, Any], length: float) -> tuple[str, str] | None:
    """Return which option allows no profile on a contact.

    Also return why not; None: all are well.
    """
    half, where = 0.5 * length, "bearing.rollers.profile"
    half_text = f"half of the contact's length, {show(half, 'length', 3)}"
    if name == "crowned" and given["profile_radius"] <= half:
        return f"{where}_radius", f"must be above {half_text}"
    if name == "two-radii":
        middle, ends = 0.5 * given["profile_length"], given["profile_radius"]
        slope = middle / given.get("profile_middle_radius", float("inf"))
        if middle >= half:
            return f"{where}_length", f"must be below the contact's length, {show(length, 'length', 3)}"
        if slope >= 1.0 or slope + (half - middle) / ends >= 1.0:
            return f"{where}_radius", "is too small: the arcs end before the contact does"
    if name == "tabulated":
        points = given["profile_points"]
        if len(points) < 2 or points[0][0] != 0.0 or points[-1][0] < half:
            return f"{where}_points", f"must begin at 0 mm, the middle, and reach {half_text}, or beyond"
        if any(after[0] <= before[0] for before, after in pairwise(points)):
            return f"{where}_points", "the distances from the middle must increase"
        if any(drop < 0.0 for _, drop in points):
            return f"{where}_points", "a drop must be at least 0 um"
    return None

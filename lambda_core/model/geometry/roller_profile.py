"""Resolve the profile of the rollers of a case."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any, get_args

from lambda_core.case.rollers import PROFILE_OPTIONS, InlineRollers
from lambda_core.catalogue.protocol import RollerRow
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.units import show
from lambda_core.elements.roller.profiles import Name
from lambda_core.model.laws.given_parameters import given_parameters, record_parameters
from lambda_core.model.ledger import Ledger
from lambda_core.views.roller_profile import RollerShape, profile_points

_MAY_BE_ABSENT = "profile_middle_radius"
_PARAMETERS = "profile_parameters"  # of a plugin's
_OPTIONS = (
    *("profile_scale", "profile_length", "profile_radius", "profile_middle_radius", "profile_points"),
    _PARAMETERS,
)


def profile_of(rollers: InlineRollers, row: RollerRow | None, roller: RollerShape, ledger: Ledger) -> dict[str, Any]:
    """Return a profile's fields of RollerBearing.

    They come from the case, otherwise from the catalogue, otherwise from ISO 16281. A plugin's profile is a table here.
    """
    if rollers.profile not in (None, *get_args(Name)):
        return _of_plugin(rollers, str(rollers.profile), roller, ledger)
    written = {name: getattr(rollers, name) for name in _OPTIONS if getattr(rollers, name) is not None}
    given = dict(written)
    if row is not None and rollers.profile in (None, "logarithmic"):
        known = {"profile_scale": row.profile_scale, "profile_length": row.profile_length}
        given = {name: value.value for name, value in known.items() if value is not None} | written
    name = rollers.profile or ("logarithmic" if {*PROFILE_OPTIONS["logarithmic"]} <= {*given} else "iso")
    takes = PROFILE_OPTIONS[name]
    needs = [option for option in takes if option != _MAY_BE_ABSENT]
    if missing := [option for option in needs if option not in given]:
        ledger.problem("bearing.rollers.profile", f"{name} needs {' and '.join(needs)}; {missing[0]} is absent")
        return {}
    for option in written:
        if option not in takes:
            ledger.problem(f"bearing.rollers.{option}", f"is no option of the profile {name}: leave it out")
    if name == "iso" and rollers.profile is None:
        ledger.assume("profile of the rollers after ISO 16281: none is given")
    if problem := _no_profile(name, given, roller.effective_length):
        ledger.problem(*problem)
        return {}
    found = {option: value for option, value in given.items() if option in takes}
    if "profile_scale" in found:
        found["profile_scale"] *= roller.diameter
    if "profile_points" in found:
        found["profile_points"] = tuple(found["profile_points"])
    return {"profile": name, **found}


def _of_plugin(rollers: InlineRollers, name: str, roller: RollerShape, ledger: Ledger) -> dict[str, Any]:
    """Return the table of a plugin's profile."""
    from lambda_core.discovery.api import registry

    where, known = "bearing.rollers.profile", registry().profiles
    if name not in known:
        nearest = unknown_name("profile", name, (*get_args(Name), *known))
        ledger.problem(where, f"{nearest}; for a profile of a plugin give --plugin FILE or install its package")
        return {}
    for option in _OPTIONS:
        if option != _PARAMETERS and getattr(rollers, option) is not None:
            ledger.problem(f"bearing.rollers.{option}", f"is no option of the profile {name}: leave it out")
    item, texts, place = known[name], rollers.profile_parameters or {}, f"{where}_parameters"
    parameters = given_parameters(f"the profile {name}", item.parameters, texts, place, ledger)
    points = parameters and ledger.ask(where, lambda: profile_points(item, roller, parameters))
    if parameters is None or points is None:
        return {}
    ledger.record(where, name, "", item.distribution, "given")
    record_parameters(parameters, texts, place, ledger)
    return {"profile": "tabulated", "profile_points": points}


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

"""Draw random cases of all bearings, oils and laws."""

from __future__ import annotations

import random
from contextlib import closing
from dataclasses import dataclass
from functools import cache
from typing import Any

from lambda_core import api
from lambda_core.discovery.manager import registry
from lambda_core.domain.roles import DEFAULT_LINE_MODELS, DEFAULT_SHAPE_MODELS, MOTION_ROLES

_LAW_CHANCE = 0.25  # of a role to have another law than its default
# Roles whose laws need data that an oil has or has not, or belong to parts that the case may not have.
_LEFT = ("rheology", "surface", "permittivity", "cage_contact")
SHAPED = DEFAULT_LINE_MODELS.keys() | DEFAULT_SHAPE_MODELS.keys()  # roles whose laws differ for points and lines
_ROLLERS = 0.25  # share of the cases
_THRUST = ("NJ", "NUP", "tapered")  # kinds of roller bearings that carry an axial load; tapered ones need it
_CLASSES = ("deep groove", "self-aligning")  # kinds that have classes of radial clearance
_TURNS = 1.3  # cage revolutions of a simulated case by its planned speed, so that there is at least one
_CAGE_SHARE = 0.4  # cage speed over that of the inner ring, about
_TO_THE_END = 0.25  # share of the cases that run until they have converged


@dataclass(frozen=True)
class Stock:
    """Stock of draws."""

    bearings: tuple[Any, ...]  # of balls
    rollers: tuple[Any, ...]
    oils: tuple[str, ...]
    laws: dict[str, tuple[str, ...]]  # role -> names of those that serve point contacts
    line_laws: dict[str, tuple[str, ...]]  # of those that serve line contacts


@cache
def stock() -> Stock:
    """Return the stock of the catalogue.

    Bearings with an inner geometry, its oils, and the laws of every role.
    """
    with closing(api.catalogue()) as catalogue:
        bearings = tuple(row for row in catalogue.bearings("", limit=1000) if row.ball_count)
        rollers = tuple(catalogue.rollers())
        oils = tuple(catalogue.names("lubricant"))
    laws, line_laws = _laws_of("point"), _laws_of("line")
    return Stock(bearings, rollers, oils, laws, line_laws)


def _laws_of(shape: str) -> dict[str, tuple[str, ...]]:
    """Return the laws that serve contacts of a shape."""
    found = {role: registry().models(role) for role in MOTION_ROLES}
    return {
        role: tuple(name for name, law in laws.items() if law.contact in (shape, "any") or role not in SHAPED)
        for role, laws in found.items()
    }


def case(seed: int) -> dict[str, Any]:
    """Return a random case as plain tables.

    Loads up to C/3, n d_m up to 5e5 mm/min, oil between -20 and 110 degC.

    Parameters
    ----------
    seed : int
        The same seed gives the same case.
    """
    draw = random.Random(seed)
    found = stock()
    are_rollers = draw.random() < _ROLLERS
    bearing = draw.choice(found.rollers if are_rollers else found.bearings)
    rating = bearing.dynamic_rating.value if bearing.dynamic_rating else 1e4
    mean_mm = 500.0 * (bearing.bore_diameter.value + bearing.outside_diameter.value)
    speed = 10 ** draw.uniform(1.0, 5.7) / mean_mm  # n d_m from 10 to 5e5
    radial = rating * 10 ** draw.uniform(-2.5, -0.5)
    axial = draw.choice([0.0, 0.0, rating * 10 ** draw.uniform(-2.5, -1.0)])
    if are_rollers:
        axial = radial * draw.uniform(0.1, 1.0) * (bearing.kind in _THRUST) * (bearing.kind == "tapered" or axial > 0.0)
    elif axial and draw.random() < 0.2:
        radial = 0.0
    share_at_end = draw.uniform(0.0, 1.5) if draw.random() < 0.15 else None  # of a ramp's speed
    mean_speed = speed if share_at_end is None else 0.5 * (1.0 + share_at_end) * speed
    duration = _TURNS * 60.0 / (_CAGE_SHARE * mean_speed)
    made: dict[str, Any] = {
        "name": f"attack-{seed}",
        "bearing": {
            "designation": bearing.designation,
            "maker": bearing.maker,
            **({"clearance": draw.choice(["C2", "CN", "C3", "C4"])} if bearing.kind in _CLASSES else {}),
        },
        "lubricant": {
            "name": draw.choice(found.oils),
            "temperature": f"{draw.choice([draw.uniform(-20.0, 20.0), draw.uniform(20.0, 110.0)]):.4g} degC",
        },
        "loads": {"radial": f"{radial:.6g} N", "axial": f"{axial:.6g} N"},
        "operation": {"speed": f"{speed:.6g} rpm"},
        "solver": {"duration": f"{duration:.6g} s"},
    }
    models = {
        role: draw.choice(names)
        for role, names in (found.line_laws if are_rollers else found.laws).items()
        if role not in _LEFT and draw.random() < _LAW_CHANCE
    }
    if models:
        made["models"] = models
    if draw.random() < 0.15 and not are_rollers:
        made["depth"] = {"cage": False}
    if share_at_end is not None:
        made["operation"]["speed"] = {
            "kind": "ramp", "start": f"{speed:.6g} rpm", "end": f"{share_at_end * speed:.6g} rpm",
            "end_time": f"{duration:.6g} s",
        }  # fmt: skip
    elif draw.random() < _TO_THE_END:
        del made["solver"]
    return made

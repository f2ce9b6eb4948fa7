"""Resolve elastic rings and cages."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.formulas.elastic.ring import ElasticRing, RingWaves
from lambda_core.laws.context import Material
from lambda_core.model.bearing_model import Cage
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.elastic import BendingCage, BendingRing

_THICK = 0.25  # height of a section over the ring's radius from which on bending alone is a poor account of it
_RINGS: tuple[tuple[BodyName, str], ...] = (("inner_ring", "inner"), ("outer_ring", "outer"))
_Usual = tuple[tuple[str, float, str], ...]  # field, its usual value, where that is from


def resolve_elastic(
    case: Case, geometry: Geometry, cage: tuple[Cage, float], materials: Mapping[str, Material], ledger: Ledger
) -> dict[BodyName, RingWaves]:
    """Return the rings and the cage that bend.

    Complete unless there are problems.

    Parameters
    ----------
    cage : tuple of Cage and float
        Its geometry and its mass [kg].
    """
    found: dict[BodyName, RingWaves] = {}
    for body, part in _RINGS:
        options: BendingRing | None = getattr(case.elastic, body)
        if options is not None:
            found[body] = _resolve_ring(body, options, geometry, materials[part], ledger)
    if case.elastic.cage is not None:
        if not case.depth.cage:
            ledger.problem("elastic.cage", "contradicts depth.cage = false: there is no cage; leave one of the two out")
        found["cage"] = _resolve_cage(case.elastic.cage, geometry, *cage, materials["cage"], ledger)
    return found


def _resolve_ring(
    body: BodyName, options: BendingRing, geometry: Geometry, material: Material, ledger: Ledger
) -> RingWaves:
    path, name = f"elastic.{body}", BODIES[body].split(" with")[0]
    if body == "inner_ring":
        seat, bottom = 0.5 * geometry.bore_diameter, 0.5 * geometry.race_diameter_inner
    else:
        seat, bottom = 0.5 * geometry.outside_diameter, 0.5 * geometry.race_diameter_outer
    height, width = _section(
        path,
        options,
        (
            ("section_height", abs(bottom - seat), "from the seat to the groove's bottom"),
            ("section_width", geometry.width, "the bearing's width"),
        ),
        ledger,
    )
    # The height that the case gives to the section does not move the seat.
    radius = seat + 0.5 * height if body == "inner_ring" else seat - 0.5 * height
    if radius <= 0.5 * height:
        ledger.problem(
            f"{path}.section_height", f"{show(height, 'length', 4)} leaves no hole in the ring: choose a smaller one"
        )
        radius = seat
    _record(path, options, (("housing_stiffness", "stiffness"), ("orders", ""), ("damping_ratio", "")), ledger)
    ring = ElasticRing.rectangle(
        radius, height, width, material.youngs_modulus, material.density, housing=options.housing_stiffness
    )
    backed = show(options.housing_stiffness, "stiffness", 4) if options.housing_stiffness else "nothing"
    ledger.assume(
        f"the {name} bends in its plane with 2 to {options.orders} waves, as a thin ring of "
        f"{show(height, 'length', 4)} by {show(width, 'length', 4)} in a "
        f"bedding of {backed} that does not know where the ring lifts off; normal forces alone bend it"
    )
    _tell(name, ring, options, height, ledger)
    return RingWaves(ring, options.orders, options.damping_ratio)


def _resolve_cage(
    options: BendingCage, geometry: Geometry, cage: Cage, mass: float, material: Material, ledger: Ledger
) -> RingWaves:
    """Return the waves of the cage.

    It is a ring of its mass; its section bends as in the case.
    """
    path, radius = "elastic.cage", 0.5 * geometry.pitch_diameter
    area = mass / (2.0 * math.pi * radius * material.density)
    written = options.section_height
    mean = area / (cage.radial_thickness if written is None else written)
    height, width = _section(
        path,
        options,
        (
            ("section_height", cage.radial_thickness, "the cage's radial thickness"),
            ("section_width", mean, "that of a ring without pockets of the cage's mass"),
        ),
        ledger,
    )
    if 0.5 * height >= radius:
        ledger.problem(
            f"{path}.section_height", f"{show(height, 'length', 4)} leaves no hole in the cage: choose a smaller one"
        )
    _record(path, options, (("orders", ""), ("damping_ratio", "")), ledger)
    moment = width * height**3 / 12.0
    ring = ElasticRing(radius, area, moment, material.youngs_modulus, material.density)
    ledger.assume(
        f"the cage bends in its plane with 2 to {options.orders} waves, as a thin ring of its mass whose section is "
        f"{show(height, 'length', 4)} by {show(width, 'length', 4)} all round"
    )
    if options.section_width is None:
        ledger.assume(
            "pockets reduce the mass of the cage but not its stiffness: give elastic.cage.section_width if bars and "
            "rims are known"
        )
    _tell("cage", ring, options, height, ledger)
    return RingWaves(ring, options.orders, options.damping_ratio)


def _section(path: str, options: BendingRing | BendingCage, usual: _Usual, ledger: Ledger) -> tuple[float, float]:
    """Return the section's height and width, written or usual [m]."""
    sizes = []
    for field, value, why in usual:
        written: float | None = getattr(options, field)
        if written is None:
            ledger.record(f"{path}.{field}", value, "length", why, "derived")
        else:
            ledger.given(f"{path}.{field}", written, "length")
        sizes.append(value if written is None else written)
    return sizes[0], sizes[1]


def _record(path: str, options: BendingRing | BendingCage, fields: tuple[tuple[str, str], ...], ledger: Ledger) -> None:
    """Note the values of fields with a default."""
    for field, quantity in fields:
        value = float(getattr(options, field))
        if field in options.model_fields_set:
            ledger.given(f"{path}.{field}", value, quantity)
        else:
            ledger.record(f"{path}.{field}", value, quantity, "default", "assumed")


def _tell(name: str, ring: ElasticRing, options: BendingRing | BendingCage, height: float, ledger: Ledger) -> None:
    """Report the damping of waves and thick sections."""
    if "damping_ratio" not in options.model_fields_set:
        ledger.assume(f"waves of the {name} are damped by {options.damping_ratio:g} of critical")
    if height > _THICK * ring.radius:
        ledger.assume(f"the {name} is {height / ring.radius:.2f} of its radius thick: a thin ring bends too little")

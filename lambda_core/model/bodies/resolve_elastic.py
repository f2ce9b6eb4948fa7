"""Resolve elastic rings and cages."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.domain.units import show
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.formulas.elastic.ring import ElasticRing, RingWaves
from lambda_core.laws.context import Material
from lambda_core.model.bearing_model import Cage
from lambda_core.model.bodies.resolve_materials import materials_apart
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.elastic import BendingCage, BendingRing, Elastic
    from lambda_core.catalogue.protocol import Catalogue
    from lambda_core.elements.roller.roller_bearing import RollerBearing

_THICK = 0.25  # height of a section over the ring's radius from which on bending alone is a poor account of it
_RINGS: tuple[tuple[BodyName, str], ...] = (("inner_ring", "inner"), ("outer_ring", "outer"))
_Usual = tuple[tuple[str, float, str], ...]  # field, its usual value, where that is from


@dataclass(frozen=True)
class RingSections:
    """Sections of both rings, inner ring first.

    Attributes
    ----------
    seats, raceways : tuple of float
        Radii of bore and outside, and of the raceways where they are lowest [m].
    width : float
        Of the bearing [m].
    """

    seats: tuple[float, float]
    raceways: tuple[float, float]
    width: float

    @staticmethod
    def of_balls(geometry: Geometry) -> RingSections:
        """Return those of a ball bearing."""
        raceways = 0.5 * geometry.race_diameter_inner, 0.5 * geometry.race_diameter_outer
        return RingSections((0.5 * geometry.bore_diameter, 0.5 * geometry.outside_diameter), raceways, geometry.width)

    @staticmethod
    def of_rollers(rollers: RollerBearing) -> RingSections:
        """Return those of a roller bearing.

        Raceways count at the middle of the rollers.
        """
        lever = 0.5 * rollers.diameter * math.cos(rollers.angles.roller)
        raceways = rollers.centre - lever, rollers.centre + lever
        return RingSections((0.5 * rollers.bore, 0.5 * rollers.outside), raceways, rollers.width)


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
    found = resolve_rings(case.elastic, RingSections.of_balls(geometry), materials, ledger)
    if case.elastic.cage is not None:
        if not case.depth.cage:
            ledger.problem("elastic.cage", "contradicts depth.cage = false: there is no cage; leave one of the two out")
        if cage[0].per_row:
            ledger.problem("elastic.cage", "is for one cage of all rows; leave out bodies.cage.per_row")
        found["cage"] = _resolve_cage(case.elastic.cage, geometry, *cage, materials["cage"], ledger)
    return found


def bent_rings(rollers: RollerBearing, case: Case, catalogue: Catalogue, ledger: Ledger) -> RollerBearing:
    """Return a roller bearing whose rings bend.

    They bend as in its case.
    """
    if case.elastic.inner_ring is None and case.elastic.outer_ring is None:
        return rollers
    materials = materials_apart([part for _, part in _RINGS], case, catalogue, ledger)
    found = resolve_rings(case.elastic, RingSections.of_rollers(rollers), materials, ledger)
    return replace(rollers, inner_waves=found.get("inner_ring"), outer_waves=found.get("outer_ring"))


def waves_of_rings(rollers: RollerBearing) -> dict[BodyName, RingWaves]:
    """Return the waves of the rings that bend."""
    found: tuple[tuple[BodyName, RingWaves | None], ...] = (
        ("inner_ring", rollers.inner_waves),
        ("outer_ring", rollers.outer_waves),
    )
    return {body: waves for body, waves in found if waves is not None}


def resolve_rings(
    elastic: Elastic, sections: RingSections, materials: Mapping[str, Material], ledger: Ledger
) -> dict[BodyName, RingWaves]:
    """Return the rings that bend.

    Complete unless there are problems.
    """
    found: dict[BodyName, RingWaves] = {}
    for i, (body, part) in enumerate(_RINGS):
        options: BendingRing | None = getattr(elastic, body)
        if options is not None:
            sizes = sections.seats[i], sections.raceways[i], sections.width
            found[body] = _resolve_ring(body, options, sizes, materials[part], ledger)
    return found


def _resolve_ring(
    body: BodyName, options: BendingRing, sizes: tuple[float, float, float], material: Material, ledger: Ledger
) -> RingWaves:
    """Return the waves of a ring.

    Its `sizes` are the radii of seat and raceway, and the bearing's width [m].
    """
    path, name = f"elastic.{body}", BODIES[body].split(" with")[0]
    seat, bottom, wide = sizes
    height, width = _section(
        path,
        options,
        (
            ("section_height", abs(bottom - seat), "from the seat to the raceway"),
            ("section_width", wide, "the bearing's width"),
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

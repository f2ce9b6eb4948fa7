"""Elastic rings of a case: their sections and what they lie in."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.domain.units import show
from lambda_core.elastic.ring import ElasticRing, RingWaves
from lambda_core.laws.context import Material
from lambda_core.system.bearing import Geometry
from lambda_core.system.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.elastic import BendingRing

_THICK = 0.25  # height of a section over the ring's radius from which on bending alone is a poor account of it
_RINGS: tuple[tuple[BodyName, str], ...] = (("inner_ring", "inner"), ("outer_ring", "outer"))


def resolve_elastic(
    case: Case, geometry: Geometry, materials: Mapping[str, Material], ledger: Ledger
) -> dict[BodyName, RingWaves]:
    """Return the rings that bend; complete unless there are problems."""
    found: dict[BodyName, RingWaves] = {}
    for body, part in _RINGS:
        options: BendingRing | None = getattr(case.elastic, body)
        if options is not None:
            found[body] = _resolve_ring(body, options, geometry, materials[part], ledger)
    return found


def _resolve_ring(
    body: BodyName, options: BendingRing, geometry: Geometry, material: Material, ledger: Ledger
) -> RingWaves:
    path, name = f"elastic.{body}", BODIES[body].split(" with")[0]
    if body == "inner_ring":
        seat, bottom = 0.5 * geometry.bore_diameter, 0.5 * geometry.race_diameter_inner
    else:
        seat, bottom = 0.5 * geometry.outside_diameter, 0.5 * geometry.race_diameter_outer
    sizes = []
    for field, usual, why in (
        ("section_height", abs(bottom - seat), "from the seat to the groove's bottom"),
        ("section_width", geometry.width, "the bearing's width"),
    ):
        written: float | None = getattr(options, field)
        if written is None:
            ledger.record(f"{path}.{field}", usual, "length", why, "derived")
        else:
            ledger.given(f"{path}.{field}", written, "length")
        sizes.append(usual if written is None else written)
    height, width = sizes
    # The seat stays where it is, however high the section is said to be.
    radius = seat + 0.5 * height if body == "inner_ring" else seat - 0.5 * height
    if radius <= 0.5 * height:
        ledger.problem(f"{path}.section_height", f"{show(height, 'length', 4)} leaves no hole in the ring")
        radius = seat
    for field, quantity in (("housing_stiffness", "stiffness"), ("orders", ""), ("damping_ratio", "")):
        value = float(getattr(options, field))
        if field in options.model_fields_set:
            ledger.given(f"{path}.{field}", value, quantity)
        else:
            ledger.record(f"{path}.{field}", value, quantity, "default", "assumed")
    ring = ElasticRing.rectangle(
        radius, height, width, material.youngs_modulus, material.density, housing=options.housing_stiffness
    )
    _tell(name, ring, options, (height, width), ledger)
    return RingWaves(ring, options.orders, options.damping_ratio)


def _tell(name: str, ring: ElasticRing, options: BendingRing, sizes: tuple[float, float], ledger: Ledger) -> None:
    """Say what the ring is taken for."""
    height, width = (show(size, "length", 4) for size in sizes)
    backed = show(options.housing_stiffness, "stiffness", 4) if options.housing_stiffness else "nothing"
    ledger.assume(
        f"the {name} bends in its plane with 2 to {options.orders} waves, as a thin ring of {height} by {width} in a "
        f"bedding of {backed} that does not know where the ring lifts off; normal forces alone bend it"
    )
    if "damping_ratio" not in options.model_fields_set:
        ledger.assume(f"waves of the {name} are damped by {options.damping_ratio:g} of critical")
    if sizes[0] > _THICK * ring.radius:
        ledger.assume(f"the {name} is {sizes[0] / ring.radius:.2f} of its radius thick: a thin ring bends too little")

"""Resolve the material of a shaft, wheel or body.

It is a catalogue name or a table of properties.
"""

from __future__ import annotations

from lambda_core.case.parts import InlineMaterial
from lambda_core.catalogue.protocol import Catalogue
from lambda_core.elastic.sections import BodyMaterial
from lambda_core.system.ledger import Ledger


def body_material(
    choice: str | InlineMaterial, where: str, catalogue: Catalogue, ledger: Ledger
) -> BodyMaterial | None:
    """Return the material; None where the catalogue has none of that name, which is noted at `where`."""
    if isinstance(choice, InlineMaterial):
        return BodyMaterial(choice.youngs_modulus, choice.poisson_ratio, choice.density, choice.thermal_expansion)
    row = ledger.ask(where, lambda: catalogue.material(choice))
    if row is None:
        return None
    names = ("youngs_modulus", "poisson_ratio", "density", "thermal_expansion")
    return BodyMaterial(*(getattr(row, name).value for name in names))

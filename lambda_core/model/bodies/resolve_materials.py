"""Resolve materials and oil from the catalogue or the case."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from lambda_core.case.case import Case
from lambda_core.case.parts import InlineMaterial, Lubricant
from lambda_core.catalogue.protocol import Catalogue, LubricantRow, Value
from lambda_core.domain.lubrication import Lubrication
from lambda_core.domain.units import show
from lambda_core.formulas.elastic.sections import BodyMaterial
from lambda_core.formulas.fits import Solid
from lambda_core.laws.context import Material, Oil
from lambda_core.model.laws.oil_data import FROM_CASE
from lambda_core.model.ledger import Ledger

# No lubricating oil is liquid below, and none is left above: hydrocarbons crack from about 350 degC on, the most
# stable fluids (polyphenyl ethers) from about 450 degC.
COLDEST, HOTTEST = 173.15, 773.15  # [K]
_QUANTITIES = {
    "youngs_modulus": "modulus",
    "poisson_ratio": "",
    "density": "density",
    "thermal_conductivity": "thermal_conductivity",
    "specific_heat": "specific_heat",
}
_OF_GREASE = {"nlgi": "", "lowest_temperature": "temperature", "highest_temperature": "temperature"}
# Class values of mineral oils, +-15 % (after Larsson and Andersson 2000, J. Eng. Tribology 214).
_CLASS_OIL = {"thermal_conductivity": 0.137, "specific_heat": 1930.0}


@dataclass(frozen=True)
class PartMaterial:
    """Material for the contact laws.

    It has the properties for thermal growth, too.
    """

    material: Material
    thermal_expansion: float  # [1/K]

    @property
    def solid(self) -> Solid:
        """Elastic and thermal properties for fits."""
        return Solid(self.material.youngs_modulus, self.material.poisson_ratio, self.thermal_expansion)


UNKNOWN = PartMaterial(Material("unknown", *[math.nan] * 5), math.nan)


def resolve_material(
    part: str, case: Case, catalogue: Catalogue, ledger: Ledger, usual: str | None = None
) -> PartMaterial:
    """Return the material of a part.

    The result is UNKNOWN after a problem; `usual` is the name where the case has none.
    """
    where = f"materials.{part}"
    choice = getattr(case.materials, part) or usual
    if choice is None:
        return UNKNOWN
    if isinstance(choice, InlineMaterial):
        for name, quantity in _QUANTITIES.items():
            ledger.given(f"{where}.{name}", getattr(choice, name), quantity)
        own = Material(f"{part} of the case", *(getattr(choice, name) for name in _QUANTITIES))
        return PartMaterial(own, choice.thermal_expansion)
    row = ledger.ask(where, lambda: catalogue.material(choice))
    if row is None:
        return UNKNOWN
    if part in case.materials.model_fields_set:
        ledger.given(where, row.name)
    else:
        ledger.record(where, row.name, "", "cage type" if part == "cage" else "default", "assumed")
        if part != "cage":
            ledger.assume(f"rings and rolling elements of {row.name} where the case names no other material")
    numbers = [ledger.row(f"{where}.{name}", getattr(row, name), quantity) for name, quantity in _QUANTITIES.items()]
    return PartMaterial(Material(row.name, *numbers), row.thermal_expansion.value)


def materials_apart(parts: Iterable[str], case: Case, catalogue: Catalogue, ledger: Ledger) -> dict[str, Material]:
    """Return materials by part, without their values.

    Assumptions and problems count; the models in motion list the values.
    """
    apart = Ledger()
    found = {part: resolve_material(part, case, catalogue, apart).material for part in parts}
    ledger.problems += [problem for problem in apart.problems if problem not in ledger.problems]
    for sentence in apart.assumptions:
        ledger.assume(sentence)
    return found


def resolve_lubricant(
    lubricant: Lubricant, catalogue: Catalogue, ledger: Ledger
) -> tuple[LubricantRow | None, Oil | None]:
    """Return the lubricant's row and its oil.

    The oil has the case's temperature.
    """
    row = _inline_row(lubricant)
    if row is None:
        row = ledger.ask("lubricant.name", lambda: catalogue.lubricant(lubricant.name))
    if row is None:
        return None, None
    ledger.given("lubricant.name", row.name)
    if not COLDEST <= lubricant.temperature <= HOTTEST:
        shown = [show(value, "temperature", 4) for value in (lubricant.temperature, COLDEST, HOTTEST)]
        ledger.problem("lubricant.temperature", f"{shown[0]}: no oil is liquid there ({shown[1]} to {shown[2]})")
    numbers = {}
    for name, usual in _CLASS_OIL.items():
        path = f"lubricant.{name}"
        value = row.properties.get(name)
        if value is None:
            ledger.record(path, usual, name, "class value of mineral oils", "assumed", "C")
            ledger.assume(f"{path} {usual:g} (SI): class value of mineral oils, not known for {row.name}")
            numbers[name] = usual
        else:
            numbers[name] = ledger.row(path, value, name)
    if is_grease(row):
        _tell_grease(row, lubricant, ledger)
    return row, Oil(row.name, row.base_type, lubricant.temperature, **numbers)


def is_grease(row: LubricantRow) -> bool:
    """Tell whether a lubricant is a grease.

    A grease has an NLGI class.
    """
    return "nlgi" in row.properties


def _tell_grease(row: LubricantRow, lubricant: Lubricant, ledger: Ledger) -> None:
    """Record what only a grease has.

    Report what the model leaves out of it.
    """
    for name, quantity in _OF_GREASE.items():
        if name in row.properties:
            ledger.row(f"lubricant.{name}", row.properties[name], quantity)
    ledger.assume(
        f"the grease {row.name} is taken as its base oil, which it bleeds: no bath, so no drag; the contacts are "
        "supplied as the supply law says; the film of its thickener and the churning of a fresh filling are left out"
    )


def lubrication_of(lubricant: Lubricant, row: LubricantRow | None) -> Lubrication:
    """Return the lubrication method.

    The case names the method; an oil without one lubricates as a bath.
    """
    usual: Lubrication = "grease" if row is not None and is_grease(row) else "oil bath"
    return lubricant.lubrication or usual


def _check_lubrication(lubricant: Lubricant, row: LubricantRow | None, ledger: Ledger) -> None:
    """Record the lubrication method.

    Note a method that does not fit the lubricant.
    """
    if lubricant.lubrication is None:
        return
    ledger.given("lubricant.lubrication", lubricant.lubrication)
    if row is not None and is_grease(row) and lubricant.lubrication != "grease":
        ledger.problem("lubricant.lubrication", f'{row.name} is a grease: leave the line out, or write "grease"')
    elif row is not None and not is_grease(row) and lubricant.lubrication == "grease":
        ledger.problem("lubricant.lubrication", f"{row.name} is an oil, not a grease: name a grease or choose another")


def resolve_oil_level(lubricant: Lubricant, row: LubricantRow | None, ball_diameter: float, ledger: Ledger) -> float:
    """Return the oil level [m].

    Above the lowest point of the pitch circle; below every ball without a bath.
    """
    given, lubrication = "oil_level" in lubricant.model_fields_set, lubrication_of(lubricant, row)
    _check_lubrication(lubricant, row, ledger)
    if row is not None and is_grease(row):
        if given:
            ledger.problem("lubricant.oil_level", f"{row.name} is a grease, which has no level: remove the line")
        return -ball_diameter
    if lubrication != "oil bath":
        if given:
            ledger.problem("lubricant.oil_level", f'"{lubrication}" has no bath: leave the line out')
        return -ball_diameter
    if given:
        ledger.given("lubricant.oil_level", lubricant.oil_level, "length")
    else:
        ledger.record("lubricant.oil_level", lubricant.oil_level, "length", "default", "assumed")
        ledger.assume("oil level at the centre of the lowest rolling element")
    return lubricant.oil_level


def _inline_row(lubricant: Lubricant) -> LubricantRow | None:
    """Return the lubricant of the case itself.

    Its law's parameters are in [parameters].
    """
    own = lubricant.properties
    if own is None:
        return None
    names = ("thermal_conductivity", "specific_heat", "kinematic_viscosity_40", "kinematic_viscosity_100", "density_15")
    properties = {
        name: Value(value=number, source=FROM_CASE, grade="")
        for name in names
        if (number := getattr(own, name)) is not None
    }
    return LubricantRow(
        name=lubricant.name, base_type=own.base_type, rheology=own.rheology, properties=properties, parameters={}
    )


_BODY = (
    "youngs_modulus",
    "poisson_ratio",
    "density",
    "thermal_expansion",
    "thermal_conductivity",
    "specific_heat",
)


def body_material(
    choice: str | InlineMaterial, where: str, catalogue: Catalogue, ledger: Ledger
) -> BodyMaterial | None:
    """Return the material of a body.

    The body is a shaft, a wheel or a rigid body. A name that the catalogue lacks is noted at `where`.
    """
    if isinstance(choice, InlineMaterial):
        return BodyMaterial(*(getattr(choice, name) for name in _BODY))
    row = ledger.ask(where, lambda: catalogue.material(choice))
    if row is None:
        return None
    return BodyMaterial(*(getattr(row, name).value for name in _BODY))

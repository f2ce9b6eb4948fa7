"""Take the data of a law from an oil."""

from __future__ import annotations

from collections.abc import Mapping

from lambda_core.catalogue.protocol import LubricantRow, Parameter
from lambda_core.domain.units import Quantity, show
from lambda_core.laws.law import Law

FROM_CASE = "case"  # source of the properties of an oil that is written in the case


def oil_data(law: Law, row: LubricantRow, known: Mapping[str, Parameter]) -> dict[str, Parameter]:
    """Return an oil's data for a law.

    A required parameter that `known` lacks is the oil's property of that name: an oil of one's own has its viscosities
    and its density once.
    """
    found = dict(known)
    for name, field in law.parameters.model_fields.items():
        quantity = next((one for one in field.metadata if isinstance(one, Quantity)), None)
        if quantity is None or name in found or not field.is_required() or name not in row.properties:
            continue
        held = row.properties[name]
        number, _, unit = show(held.value, quantity.name).partition(" ")
        found[name] = Parameter(
            value=float(number), unit=unit, source=held.source, grade=held.grade, status=held.status
        )
    return found

"""Describe the default parameters of laws.

Each has a value, a source, a published range and a grade.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lambda_core.domain.value_status import ValueStatus
from lambda_core.model.bearing_model import ChosenLaw
from lambda_core.model.ledger import Ledger

MEASURED = ", measured, grade "  # what the origin of a measured value of the oil contains
_WEAK = ("grade C)", "grade D)")  # how the origin of an estimate ends


def law_sentences(laws: Mapping[str, Mapping[str, ChosenLaw]]) -> list[str]:
    """Return a sentence per default and weak value.

    The weak values are the oil's; `laws` by element and role.
    """
    found = []
    for roles in laws.values():
        for role, law in roles.items():
            written = law.parameters.model_dump(mode="json")
            found += default_sentences(role, law, written)
            found += [
                f"{role} {law.model.name}: {key} {short(written[key])}, {origin}"
                for key, origin in law.origins.items()
                if origin.endswith(_WEAK)
            ]
    return found


def record_law(ledger: Ledger, element: str, role: str, law: ChosenLaw, chosen_by: ValueStatus) -> None:
    """Record a law and its parameters with their origins."""
    source = law.model.distribution or "built-in"
    ledger.record(f"forces.{element}.models.{role}", law.model.name, "", source, chosen_by)
    for key, value in law.parameters.model_dump(mode="json").items():
        origin = law.origins[key]
        status: ValueStatus = "assumed" if origin.endswith(_WEAK) else "published"
        if origin in ("case", "default"):
            status = "given" if origin == "case" else "default"
        elif MEASURED in origin:
            status = "measured"
        plain: float | str = value if isinstance(value, int | float | str) else str(value)
        ledger.record(f"forces.{element}.parameters.{role}.{key}", plain, "", origin, status)


def default_sentences(role: str, law: ChosenLaw, written: Mapping[str, Any]) -> list[str]:
    """Return a sentence for each default parameter.

    The sentences name those that neither the case nor the oil gives.

    `written` is what its parameters are in a file. The last word is the grade: published, unconfirmed, assumed, or
    numerical (a regularisation without physical meaning). A default that is absent stands for what the law computes,
    and is left out.
    """
    return [
        f"{role} {law.model.name}: {key} {short(written[key])}, {_origin(law, key)}"
        for key, origin in law.origins.items()
        if origin == "default" and written[key] is not None
    ]


def _origin(law: ChosenLaw, key: str) -> str:
    info = type(law.parameters).model_fields[key]
    extra = info.json_schema_extra if isinstance(info.json_schema_extra, dict) else {}
    source = extra.get("source") or info.description or "no source is named"
    ends = extra.get("published_range")
    span = f"; published {ends[0]} to {ends[1]}" if isinstance(ends, list) else ""
    return f"default ({source}{span}; {extra.get('status', 'assumed')})"


def short(value: object) -> str:
    """Write a value of a parameter briefly."""
    return f"{value:g}" if isinstance(value, float) else str(value)

"""Rate roller bearings by case, catalogue or standard."""

from __future__ import annotations

from typing import Any

from lambda_core.case.case import Case
from lambda_core.catalogue.protocol import RollerRow
from lambda_core.domain.units import show
from lambda_core.elements.roller.roller_ratings import (
    roller_dynamic_rating,
    roller_fatigue_load_limit,
    roller_static_rating,
)
from lambda_core.model.ledger import Ledger


def ratings_of(case: Case, row: RollerRow | None, shape: dict[str, Any], ledger: Ledger) -> tuple[float, float, float]:
    """Return C, C_0 and C_u [N].

    They are those of the case, those of the catalogue, or those of ISO 281 and ISO 76 for the geometry.
    """
    dynamic = _rating("dynamic_rating", case, row, ledger) or _computed(
        "dynamic_rating", roller_dynamic_rating(**shape), "ISO 281", ledger
    )
    static = _rating("static_rating", case, row, ledger) or _computed(
        "static_rating", roller_static_rating(**shape), "ISO 76", ledger
    )
    limit = _rating("fatigue_limit", case, row, ledger)
    return dynamic, static, limit or roller_fatigue_load_limit(static, shape["pitch_diameter"])


def _rating(name: str, case: Case, row: RollerRow | None, ledger: Ledger) -> float | None:
    """Return a rating of case or catalogue [N]."""
    written, found = getattr(case.bearing.geometry, name, None), getattr(row, name, None)
    if written is not None:
        ledger.given(f"bearing.{name}", written, "force")
        return float(written)
    return None if found is None else ledger.row(f"bearing.{name}", found, "force")


def _computed(name: str, value: float, standard: str, ledger: Ledger) -> float:
    """Record a rating after a standard [N]."""
    words = f"after {standard} from the inner geometry"
    ledger.assume(f"{name.replace('_', ' ')} {show(value, 'force', 4)} {words}")
    ledger.record(f"bearing.{name}", value, "force", words, "derived")
    return value

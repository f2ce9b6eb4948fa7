"""Resolve the contamination factor e_C of ISO 281."""

from __future__ import annotations

from lambda_core.case.case import Case
from lambda_core.formulas.life import contamination_range
from lambda_core.model.ledger import Ledger

ASSUMED = "normal cleanliness"  # of bearings whose case gives nothing: shown, and no verdict goes by it


def contamination_of(case: Case, pitch_diameter: float, ledger: Ledger) -> float | None:
    """Return the contamination factor e_C.

    A level has its lower end (ISO 281:2007, table 13); the result is None without a level.
    """
    given = case.life.contamination
    if not isinstance(given, str):
        return given
    low, high = contamination_range(given, pitch_diameter)
    ledger.assume(f"e_C {low:g}, the lower end of {low:g} to {high:g} for {given} (ISO 281, table 13)")
    return low


def known_contamination(given: float | None, pitch_diameter: float) -> float:
    """Return e_C as given or normal.

    The lower end of normal cleanliness (ISO 281:2007, table 13).
    """
    return contamination_range(ASSUMED, pitch_diameter)[0] if given is None else given

"""Read contact angle and consistency of bearings with two rows."""

from __future__ import annotations

import math

from lambda_core.elements.ball.ball_kind import Given


def contact_angle(given: Given) -> float:
    """Return the free contact angle of two rows [rad].

    It is NaN after a problem.
    """
    if given.bearing.contact_angle is not None:
        given.ledger.given("bearing.contact_angle", given.bearing.contact_angle, "angle")
        return float(given.bearing.contact_angle)
    if given.row is not None and given.row.contact_angle is not None:
        return float(given.ledger.row("bearing.contact_angle", given.row.contact_angle, "angle"))
    given.ledger.problem("bearing.contact_angle", "is required for two rows")
    return math.nan


def is_consistent(given: Given, kind: str, arrangements: tuple[str, ...]) -> bool:
    """Tell whether case and catalogue agree on rows.

    They are two rows of a kind with these arrangements; a difference is noted as a problem.
    """
    inline, row, ledger = given.inline, given.row, given.ledger
    if row is None:
        return True
    if row.kind != kind:
        ledger.problem("bearing.geometry.rows", f"{row.designation} has one row: write two rows without a designation")
        return False
    if inline.rows == 1:
        ledger.problem("bearing.geometry.rows", f"{row.designation} has two rows: write one row without a designation")
        return False
    if inline.arrangement is not None and inline.arrangement not in arrangements:
        ledger.problem("bearing.geometry.arrangement", f"{row.designation} is a bearing of the kind {row.kind}")
        return False
    return True

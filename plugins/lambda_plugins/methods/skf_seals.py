"""Compute SKF's friction torque of contact seals.

It is M_seal = K_S1 d_s^beta + K_S2, for seals on both sides.

SKF, General catalogue 6000 (2008), chapter Friction, table 4 (exponent and constants of contact seals), read in its
German edition; the same numbers stand in the edition 10000 EN (2013), after the public transcription of JRaposo-m,
SKF-Bearing-Selection-Tool. Rows of deep-groove ball bearings; d_s and D in mm, M_seal in N mm. It does not depend on
speed or load.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass


@dataclass(frozen=True)
class SealRow:
    """One row of the table of seals.

    It holds the limit of the outside diameter, the exponent and the constants.
    """

    up_to: float  # D [mm], included
    beta: float
    k_s1: float
    k_s2: float


# RZ seals do not touch. Each kind has its rows by outside diameter; beyond the last the table has none.
SEALS: dict[str, tuple[SealRow, ...]] = {
    "RZ": (SealRow(175.0, 0.0, 0.0, 0.0),),
    "RSL": (SealRow(25.0, 0.0, 0.0, 0.0), SealRow(52.0, 2.25, 0.0018, 0.0)),
    "RSH": (SealRow(52.0, 2.25, 0.028, 2.0),),
    "RS1": (
        SealRow(62.0, 2.25, 0.023, 2.0),
        SealRow(80.0, 2.25, 0.018, 20.0),
        SealRow(100.0, 2.25, 0.018, 15.0),
        SealRow(math.inf, 2.25, 0.018, 0.0),
    ),
}
_WRITTEN = re.compile(r"(?<![A-Z0-9])(2?)(RZ|RSL|RSH|RS1)(?![A-Z0-9])")  # of NBR; the table is silent on FKM (RSH2)


def seals_of(designation: str) -> tuple[str, int]:
    """Return kind and number of seals of a designation.

    SKF's suffix gives them; they are ("", 0) for none.
    """
    match = _WRITTEN.search(designation.upper())
    return (match[2], 2 if match[1] else 1) if match else ("", 0)


def seal_torque(kind: str, outside_diameter: float, counterface: float, sides: int = 2) -> float | None:
    """Return the friction torque of the seals [N m].

    The bearing is a deep-groove ball bearing; the result is None where the table has no row.

    M_seal = K_S1 d_s^beta + K_S2 of two seals; one has half of it.

    Parameters
    ----------
    kind : str
        ``RZ``, ``RSL``, ``RSH`` or ``RS1``.
    outside_diameter : float
        D of the bearing [m].
    counterface : float
        d_s, the diameter that the lip slides on [m].
    sides : int
        1 or 2.
    """
    row = next((row for row in SEALS[kind] if round(outside_diameter * 1e3, 6) <= row.up_to), None)
    if row is None:
        return None
    slides = row.k_s1 * (counterface * 1e3) ** row.beta if row.k_s1 else 0.0
    return 0.5 * sides * (slides + row.k_s2) * 1e-3

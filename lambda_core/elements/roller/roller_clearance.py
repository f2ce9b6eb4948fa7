"""Tabulate radial clearance of roller bearings with cylindrical bore."""

from __future__ import annotations

from lambda_core.domain.errors import unknown_name

# ISO 5753-1:2009, cylindrical roller bearings: bore up to and including [mm], limits of C2, CN, C3, C4, C5 [um].
_LIMITS: tuple[tuple[int, tuple[tuple[int, int], ...]], ...] = (
    (24, ((0, 25), (20, 45), (35, 60), (50, 75), (65, 90))),
    (30, ((0, 25), (20, 45), (35, 60), (50, 75), (70, 95))),
    (40, ((5, 30), (25, 50), (45, 70), (60, 85), (80, 105))),
    (50, ((5, 35), (30, 60), (50, 80), (70, 100), (95, 125))),
    (65, ((10, 40), (40, 70), (60, 90), (80, 110), (110, 140))),
    (80, ((10, 45), (40, 75), (65, 100), (90, 125), (130, 165))),
    (100, ((15, 50), (50, 85), (75, 110), (105, 140), (155, 190))),
)
CLASSES = ("C2", "CN", "C3", "C4", "C5")


def roller_clearance(bore: float, clearance_class: str) -> tuple[float, float]:
    """Return the limits of radial clearance [m].

    They are those of a bore [m] (ISO 5753-1:2009, as remembered).

    Raises
    ------
    ValueError
        For an unknown class, or a bore outside 10 to 100 mm.
    """
    if clearance_class not in CLASSES:
        raise ValueError(unknown_name("clearance class", clearance_class, CLASSES))
    size = 1e3 * bore
    if not 10.0 <= size <= _LIMITS[-1][0]:
        raise ValueError(f"clearance classes of rollers are tabulated for bores of 10 to 100 mm, not {size:g} mm")
    row = next(row for row in _LIMITS if size <= row[0])
    low, high = row[1][CLASSES.index(clearance_class)]
    return 1e-6 * low, 1e-6 * high

"""Axial internal clearance of ball bearings that have one: four-point contact.

Micrometres over bores in millimetres, as SKF prints them (general catalogue 6000, Russian edition, page 453, table 1:
unmounted, under next to no load), the classes of ISO 5753-2.
"""

from __future__ import annotations

from lambda_core.domain.tolerances import Limits

SOURCE = "SKF general catalogue 6000, four-point contact ball bearings, table 1 (ISO 5753-2)"
_CLASSES = ("C2", "CN", "C3", "C4")
# Bore over, to; least and largest of each class.
_FOUR_POINT = (
    (10, 17, (15, 55), (45, 85), (75, 125), (115, 165)),
    (17, 40, (26, 66), (56, 106), (96, 146), (136, 186)),
    (40, 60, (36, 86), (76, 126), (116, 166), (156, 206)),
    (60, 80, (46, 96), (86, 136), (126, 176), (166, 226)),
    (80, 100, (56, 106), (96, 156), (136, 196), (186, 246)),
    (100, 140, (66, 126), (116, 176), (156, 216), (206, 266)),
    (140, 180, (76, 156), (136, 196), (176, 246), (226, 296)),
    (180, 220, (96, 176), (156, 226), (206, 276), (256, 326)),
)


def four_point_clearance(bore: float, name: str) -> Limits:
    """Return the limits of the axial internal clearance of a four-point contact bearing [m].

    Parameters
    ----------
    bore : float
        [m]
    name : str
        "C2", "CN", "C3" or "C4".

    Raises
    ------
    ValueError
        For a class or a bore that the table does not have.
    """
    if name not in _CLASSES:
        raise ValueError(f'"{name}" is no class of axial clearance here: {", ".join(_CLASSES)}, or write a value')
    for over, to, *limits in _FOUR_POINT:
        if over < 1e3 * bore <= to:
            least, largest = limits[_CLASSES.index(name)]
            return Limits(1e-6 * least, 1e-6 * largest)
    span = f"{_FOUR_POINT[0][0]} to {_FOUR_POINT[-1][1]} mm"
    raise ValueError(f"no axial clearance is known for a bore of {1e3 * bore:.6g} mm ({span}): write a value")

"""Tabulate clearance of other ball bearings.

Axial of four-point contact and two rows, radial of self-aligning bearings.

Micrometres over bores in millimetres, as SKF prints them (general catalogue 6000, Russian edition: four-point contact
page 453, table 1; double row angular contact page 438, table 2; self-aligning with cylindrical bore page 477, table 5):
unmounted, under next to no load. The first and the last are the classes of ISO 5753-2 and ISO 5753-1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lambda_core.formulas.tolerances import Limits


@dataclass(frozen=True)
class KindClearance:
    """Classes of the internal clearance of one kind.

    Attributes
    ----------
    direction : str
        In which the rings move by it.
    source : str
        Where the classes are printed.
    classes : tuple of str
        From the tightest to the widest.
    rows : tuple
        Bore over and up to [mm], then least and largest of each class [um]; None where the class has none.
    """

    direction: Literal["axial", "radial"]
    source: str
    classes: tuple[str, ...]
    rows: tuple[tuple[float, float, tuple[tuple[float, float] | None, ...]], ...]

    def limits(self, bore: float, name: str) -> Limits:
        """Return the limits of a class [m].

        Parameters
        ----------
        bore : float
            [m]
        name : str
            One of the classes.

        Raises
        ------
        ValueError
            For a class or a bore that the table does not have.
        """
        if name not in self.classes:
            known = ", ".join(self.classes)
            raise ValueError(f'"{name}" is not a class of {self.direction} clearance here: {known}, or write a value')
        for over, to, limits in self.rows:
            found = limits[self.classes.index(name)]
            if over < 1e3 * bore <= to and found is not None:
                return Limits(1e-6 * found[0], 1e-6 * found[1])
        span = f"{self.rows[0][0]:g} to {self.rows[-1][1]:g} mm"
        raise ValueError(
            f"no {self.direction} clearance is known for a bore of {1e3 * bore:.6g} mm ({span}): write a value"
        )


FOUR_POINT = KindClearance(
    "axial",
    "SKF general catalogue 6000, four-point contact ball bearings, table 1 (ISO 5753-2)",
    ("C2", "CN", "C3", "C4"),
    (
        (10, 17, ((15, 55), (45, 85), (75, 125), (115, 165))),
        (17, 40, ((26, 66), (56, 106), (96, 146), (136, 186))),
        (40, 60, ((36, 86), (76, 126), (116, 166), (156, 206))),
        (60, 80, ((46, 96), (86, 136), (126, 176), (166, 226))),
        (80, 100, ((56, 106), (96, 156), (136, 196), (186, 246))),
        (100, 140, ((66, 126), (116, 176), (156, 216), (206, 266))),
        (140, 180, ((76, 156), (136, 196), (176, 246), (226, 296))),
        (180, 220, ((96, 176), (156, 226), (206, 276), (256, 326))),
    ),
)

DOUBLE_ROW = KindClearance(
    "axial",
    "SKF general catalogue 6000, double row angular contact ball bearings, table 2, series 32 A and 33 A",
    ("C2", "CN", "C3"),
    (
        (0, 10, ((1, 11), (5, 21), (12, 28))),
        (10, 18, ((1, 12), (6, 23), (13, 31))),
        (18, 24, ((2, 14), (7, 25), (16, 34))),
        (24, 30, ((2, 15), (8, 27), (18, 37))),
        (30, 40, ((2, 16), (9, 29), (21, 40))),
        (40, 50, ((2, 18), (11, 33), (23, 44))),
        (50, 65, ((3, 22), (13, 36), (26, 48))),
        (65, 80, ((3, 24), (15, 40), (30, 54))),
        (80, 100, ((3, 26), (18, 46), (35, 63))),
        (100, 110, ((4, 30), (22, 53), (42, 73))),
    ),
)

SELF_ALIGNING = KindClearance(
    "radial",
    "SKF general catalogue 6000, self-aligning ball bearings with cylindrical bore, table 5 (ISO 5753-1)",
    ("C2", "CN", "C3", "C4"),
    (
        (2.5, 6, ((1, 8), (5, 15), (10, 20), (15, 25))),
        (6, 10, ((2, 9), (6, 17), (12, 25), (19, 33))),
        (10, 14, ((2, 10), (6, 19), (13, 26), (21, 35))),
        (14, 18, ((3, 12), (8, 21), (15, 28), (23, 37))),
        (18, 24, ((4, 14), (10, 23), (17, 30), (25, 39))),
        (24, 30, ((5, 16), (11, 24), (19, 35), (29, 46))),
        (30, 40, ((6, 18), (13, 29), (23, 40), (34, 53))),
        (40, 50, ((6, 19), (14, 31), (25, 44), (37, 57))),
        (50, 65, ((7, 21), (16, 36), (30, 50), (45, 69))),
        (65, 80, ((8, 24), (18, 40), (35, 60), (54, 83))),
        (80, 100, ((9, 27), (22, 48), (42, 70), (64, 96))),
        (100, 120, ((10, 31), (25, 56), (50, 83), (75, 114))),
        (120, 140, ((10, 38), (30, 68), (60, 100), (90, 135))),
        (140, 150, (None, None, (70, 120), None)),
        (150, 180, (None, None, (80, 130), None)),
        (180, 200, (None, None, (90, 150), None)),
        (200, 220, (None, None, (100, 165), None)),
        (220, 240, (None, None, (110, 180), None)),
    ),
)

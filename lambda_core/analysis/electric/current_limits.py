"""Define published limits of bearing currents.

None of them was read in its original here: results list them, and the program decides nothing by them.
"""

from __future__ import annotations

from lambda_core.results.record import Record


class Limit(Record):
    """A published limit or usual value."""

    quantity: str
    value: str
    source: str
    read_in_the_original: bool


# Bounds of the classes of J_b in the first limit [A/mm2]: without influence, suspicious, dangerous.
DENSITY_CLASSES = (0.1, 0.3, 0.8)

LIMITS: tuple[Limit, ...] = (
    Limit(
        quantity="apparent current density J_b, peak current over Hertzian area",
        value="up to 0.1 A/mm2 without influence on life; 0.3 to 0.8 A/mm2 suspicious; above dangerous",
        source="Muetze and Binder 2007, IEEE Trans. Ind. Electron. 54, 1614, and works that it builds on",
        read_in_the_original=False,
    ),
    Limit(
        quantity="breakdown voltage of lubricating films",
        value="0.4 to 30 V for films of 0.2 to 2 um",
        source="Busse et al. 1997, IEEE Trans. Ind. Appl. 33, 567",
        read_in_the_original=False,
    ),
    Limit(
        quantity="bearing voltage ratio of machines on the mains frame size",
        value="0.02 to 0.10",
        source="Muetze and Binder 2007, IEEE Trans. Ind. Electron. 54, 1614",
        read_in_the_original=False,
    ),
)

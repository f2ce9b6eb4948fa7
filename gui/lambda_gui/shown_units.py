"""Show numbers in the user's units."""

from __future__ import annotations

from lambda_core.domain.unit_systems import UnitSystem


def fact_in_units(fact: tuple[str, str, str], units: UnitSystem) -> tuple[str, str, str]:
    """Return a named number in another unit.

    ("Q max", "1 440", "N inner") has "324", "lbf inner".

    Parameters
    ----------
    fact : tuple of str
        Name; one number, or two with what joins them, as they stand on the screen; a unit of the program, and words
        behind it.
    """
    name, number, unit = fact
    known = sorted(units.shown, key=len, reverse=True)
    base = next((one for one in known if unit == one or unit.startswith(f"{one} ")), None)
    if base is None:
        return fact
    shown = units.unit(base)
    return name, units.sentence(f"{number} {base}").removesuffix(shown).rstrip(), shown + unit.removeprefix(base)

"""Define units of the catalogue's columns and properties.

Tables have the printed numbers, the Protocol SI floats.
"""

from __future__ import annotations

from functools import cache, lru_cache

from lambda_core.domain.units import UNITS, parse

# Ending of a column's name -> (quantity, unit).
ENDINGS: dict[str, tuple[str, str]] = {
    "_mm": ("length", "mm"),
    "_um": ("small_length", "um"),
    "_kN": ("force", "kN"),
    "_rpm": ("rotational_speed", "rpm"),
    "_kg": ("mass", "kg"),
    "_deg": ("angle", "deg"),
    "_GPa": ("modulus", "GPa"),
    "_kg_m3": ("density", "kg/m3"),
    "_W_mK": ("thermal_conductivity", "W/(m K)"),
    "_J_kgK": ("specific_heat", "J/(kg K)"),
    "_1e6_K": ("thermal_expansion", "1e-6/K"),
    "_degC": ("temperature", "degC"),
}

# Properties of lubricants with a fixed meaning -> quantity ("" is a plain number). "_40" and the like: degC.
PROPERTIES: dict[str, str] = {
    "density_15": "density",
    "thermal_expansion": "thermal_expansion",
    "kinematic_viscosity_40": "kinematic_viscosity",
    "kinematic_viscosity_100": "kinematic_viscosity",
    "viscosity_30": "viscosity",
    "viscosity_40": "viscosity",
    "viscosity_60": "viscosity",
    "viscosity_100": "viscosity",
    "thermal_conductivity": "thermal_conductivity",
    "specific_heat": "specific_heat",
    "permittivity": "",
    "alpha_p_30": "pressure_viscosity",
    "alpha_p_40": "pressure_viscosity",
    "alpha_p_60": "pressure_viscosity",
    "alpha_p_100": "pressure_viscosity",
    "gold_s": "",
    "gold_t": "",
    "nlgi": "",  # the class of a grease; only greases have it
    "lowest_temperature": "temperature",  # that a grease is made for
    "highest_temperature": "temperature",
}


@cache
def column_unit(column: str) -> tuple[str, str] | None:
    """Return (quantity, unit) of a column.

    It is None for a plain number or text.
    """
    for ending in sorted(ENDINGS, key=len, reverse=True):
        if column.endswith(ending):
            return ENDINGS[ending]
    return None


@cache
def bare_name(column: str) -> str:
    """Return a column's name without its unit: ``bore_diameter_mm`` is ``bore_diameter``."""
    for ending in sorted(ENDINGS, key=len, reverse=True):
        if column.endswith(ending):
            return column.removesuffix(ending)
    return column


@lru_cache(maxsize=65536)  # the same few thousand numbers are shown again with every search
def column_si(column: str, value: float) -> float:
    """Convert a column's printed number to SI.

    It works exactly as a case file's unit string.
    """
    unit = column_unit(column)
    return float(value) if unit is None else parse(f"{value!r} {unit[1]}", unit[0])


@cache
def quantity_of_unit(unit: str) -> str | None:
    """Return the first quantity that knows `unit`.

    None if there is none.
    """
    return next((quantity for quantity, units in UNITS.items() if unit in units), None)


def to_si(value: float, unit: str, quantity: str | None = None) -> float:
    """Convert a published number with its unit to SI.

    An empty unit is a plain number.

    Raises
    ------
    ValueError
        If the unit is not known, or not one of `quantity`.
    """
    if quantity == "" and unit:
        raise ValueError(f'"{unit}": this value is a plain number; leave the unit out')
    if not unit:
        if quantity:
            raise ValueError(f"{value:g} has no unit; allowed: {', '.join(UNITS[quantity])}")
        return float(value)
    found = quantity or quantity_of_unit(unit)
    if found is None:
        known = sorted({name for units in UNITS.values() for name in units})
        raise ValueError(f'"{unit}" is not a unit; known: {", ".join(known)}')
    return parse(f"{value!r} {unit}", found)

"""Define the units of the interface."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Unit:
    """One unit.

    Attributes
    ----------
    base : dict of str to int
        Exponents of SI units.
    shown : tuple of (str, float, float), optional
        What a host shows: name, how many of them are one, and what is added to that.
    """

    base: dict[str, int]
    shown: tuple[str, float, float] | None = None


_RPM = 9.549296585513721  # 30 / pi
UNITS = {
    "1": Unit({}),
    "s": Unit({"s": 1}),
    "Hz": Unit({"s": -1}),
    "m": Unit({"m": 1}, ("um", 1e6, 0.0)),
    "m2": Unit({"m": 2}),
    "m3": Unit({"m": 3}),
    "m/s": Unit({"m": 1, "s": -1}),
    "m/s2": Unit({"m": 1, "s": -2}),
    "m2/s": Unit({"m": 2, "s": -1}, ("mm2/s", 1e6, 0.0)),
    "m3/s": Unit({"m": 3, "s": -1}),
    "rad": Unit({"rad": 1}, ("mrad", 1e3, 0.0)),
    "rad/s": Unit({"rad": 1, "s": -1}, ("1/min", _RPM, 0.0)),
    "rad/s2": Unit({"rad": 1, "s": -2}),
    "kg": Unit({"kg": 1}),
    "kg m": Unit({"kg": 1, "m": 1}, ("g mm", 1e6, 0.0)),
    "kg m2": Unit({"kg": 1, "m": 2}),
    "kg/m3": Unit({"kg": 1, "m": -3}),
    "N": Unit({"kg": 1, "m": 1, "s": -2}),
    "N m": Unit({"kg": 1, "m": 2, "s": -2}, ("N mm", 1e3, 0.0)),
    "N/m": Unit({"kg": 1, "s": -2}, ("N/um", 1e-6, 0.0)),
    "N s/m": Unit({"kg": 1, "s": -1}),
    "N m/rad": Unit({"kg": 1, "m": 2, "s": -2, "rad": -1}),
    "N m s/rad": Unit({"kg": 1, "m": 2, "s": -1, "rad": -1}),
    "W": Unit({"kg": 1, "m": 2, "s": -3}),
    "J": Unit({"kg": 1, "m": 2, "s": -2}),
    "Pa": Unit({"kg": 1, "m": -1, "s": -2}, ("GPa", 1e-9, 0.0)),
    "1/Pa": Unit({"kg": -1, "m": 1, "s": 2}, ("1/GPa", 1e9, 0.0)),
    "Pa s": Unit({"kg": 1, "m": -1, "s": -1}, ("mPa s", 1e3, 0.0)),
    "K": Unit({"K": 1}, ("degC", 1.0, -273.15)),
    "1/K": Unit({"K": -1}),
    "W/K": Unit({"kg": 1, "m": 2, "s": -3, "K": -1}),
    "W/(m K)": Unit({"kg": 1, "m": 1, "s": -3, "K": -1}),
    "W/(m2 K)": Unit({"kg": 1, "s": -3, "K": -1}),
    "J/K": Unit({"kg": 1, "m": 2, "s": -2, "K": -1}),
    "J/(kg K)": Unit({"m": 2, "s": -2, "K": -1}),
    "V": Unit({"kg": 1, "m": 2, "s": -3, "A": -1}),
    "V/s": Unit({"kg": 1, "m": 2, "s": -4, "A": -1}),
    "V/m": Unit({"kg": 1, "m": 1, "s": -3, "A": -1}),
    "A": Unit({"A": 1}),
    "Ohm": Unit({"kg": 1, "m": 2, "s": -3, "A": -2}),
    "S/m": Unit({"kg": -1, "m": -3, "s": 3, "A": 2}),
    "F": Unit({"kg": -1, "m": -2, "s": 4, "A": 2}, ("pF", 1e12, 0.0)),
    "1/m3": Unit({"m": -3}),
}

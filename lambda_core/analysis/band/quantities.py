"""Names of columns in a file of measurements: operating conditions and measured quantities."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Condition:
    """An operating condition.

    Attributes
    ----------
    path : str
        Option of the case that it sets.
    quantity : str
        Its physical quantity.
    error_quantity : str
        That of its error.
    """

    path: str
    quantity: str
    error_quantity: str


@dataclass(frozen=True)
class Measured:
    """A measured quantity.

    Attributes
    ----------
    response : str
        Number of a quasi-static solution that it is compared with.
    quantity : str
        Its physical quantity.
    unit : str
        In which it is fitted and shown.
    """

    response: str
    quantity: str
    unit: str


def _condition(path: str, quantity: str) -> Condition:
    return Condition(path, quantity, "temperature_difference" if quantity == "temperature" else quantity)


CONDITIONS: dict[str, Condition] = {
    "speed": _condition("operation.speed", "rotational_speed"),
    "radial load": _condition("loads.radial", "force"),
    "axial load": _condition("loads.axial", "force"),
    "moment y": _condition("loads.moment_y", "moment"),
    "moment z": _condition("loads.moment_z", "moment"),
    "oil temperature": _condition("lubricant.temperature", "temperature"),
    "oil level": _condition("lubricant.oil_level", "length"),
    "inner ring temperature": _condition("bearing.temperatures.inner_ring", "temperature"),
    "outer ring temperature": _condition("bearing.temperatures.outer_ring", "temperature"),
}
MEASURED: dict[str, Measured] = {
    "friction torque": Measured("friction_torque_Nmm", "moment", "N mm"),
    "power loss": Measured("power_loss_W", "power", "W"),
    "minimum film": Measured("min_film_um", "small_length", "um"),
    "capacitance": Measured("bearing_capacitance_nF", "capacitance", "nF"),
    "displacement x": Measured("inner_ring_displacement_um.x", "small_length", "um"),
    "displacement y": Measured("inner_ring_displacement_um.y", "small_length", "um"),
    "displacement z": Measured("inner_ring_displacement_um.z", "small_length", "um"),
}


@dataclass(frozen=True)
class Vocabulary:
    """Names that the columns of a file may have.

    Attributes
    ----------
    conditions, measured : mapping
        By name; at least one column of a file is measured.
    example : str
        A header, for messages.
    most : int
        Largest number of lines.
    """

    conditions: Mapping[str, Condition]
    measured: Mapping[str, Measured]
    example: str
    most: int = 2000


OPERATING_POINTS = Vocabulary(CONDITIONS, MEASURED, '"speed [1/min],radial load [kN],friction torque [N mm]"')
ERROR = " error"  # ends the name of a column of errors
LABEL = "label"  # a column of words, kept for tables

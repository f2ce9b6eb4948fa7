"""Name the columns of a file of measurements."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from lambda_core.domain.units import UNITS


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
    is_signed : bool
        Whether it may be below zero: a direction, not a size.
    """

    response: str
    quantity: str
    unit: str
    is_signed: bool = False

    @property
    def error_quantity(self) -> str:
        """Physical quantity of its error."""
        return error_quantity(self.quantity)

    @property
    def error_unit(self) -> str:
        """Unit in which its error is fitted."""
        return self.unit if self.error_quantity == self.quantity else next(iter(UNITS[self.error_quantity]))


def error_quantity(quantity: str) -> str:
    """Return the physical quantity of an error of a quantity."""
    return "temperature_difference" if quantity == "temperature" else quantity


def _condition(path: str, quantity: str) -> Condition:
    return Condition(path, quantity, error_quantity(quantity))


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
# Temperatures of a case: conditions where it gives them, measured where it computes them.
TEMPERATURES = ("oil temperature", "inner ring temperature", "outer ring temperature")
# Diagonal of a bearing's stiffness matrix: what the inner ring moves along or tilts about, and its place there.
STIFFNESS = {"stiffness x": 0, "stiffness y": 1, "stiffness z": 2, "stiffness tilt y": 3, "stiffness tilt z": 4}
_FIRST_TILT = 3
STIFFNESSES: dict[str, Measured] = {
    name: Measured(name, "stiffness", "N/um")
    if place < _FIRST_TILT
    else Measured(name, "angular_stiffness", "N m/mrad")
    for name, place in STIFFNESS.items()
}
MEASURED: dict[str, Measured] = {
    "friction torque": Measured("friction_torque_Nmm", "moment", "N mm"),
    "power loss": Measured("power_loss_W", "power", "W"),
    "minimum film": Measured("min_film_um", "small_length", "um"),
    "capacitance": Measured("bearing_capacitance_nF", "capacitance", "nF"),
    "cage speed": Measured("cage_speed_rpm", "rotational_speed", "1/min"),
    "displacement x": Measured("inner_ring_displacement_um.x", "small_length", "um", is_signed=True),
    "displacement y": Measured("inner_ring_displacement_um.y", "small_length", "um", is_signed=True),
    "displacement z": Measured("inner_ring_displacement_um.z", "small_length", "um", is_signed=True),
    **STIFFNESSES,
}
# Quantities of a shaft, and what a case of one bearing answers.
_OF_A_SHAFT = ("natural frequency", "bending frequency", "first critical speed", "largest deflection")
_NO_SHAFT = 'a bearing alone has no shaft that vibrates or bends: name the case of a machine, or measure "stiffness z"'


def stiffness_reading(name: str, matrix: Sequence[Sequence[float]]) -> float:
    """Return a stiffness in the unit of its name.

    The matrix is that of :func:`lambda_core.solver.drivers.stiffness.stiffness_matrix`, SI.
    """
    place, one = STIFFNESS[name], STIFFNESSES[name]
    return float(matrix[place][place]) / UNITS[one.quantity][one.unit]


def no_measured(name: str) -> str:
    """Return why a case of one bearing lacks a quantity."""
    return _NO_SHAFT if name.startswith(_OF_A_SHAFT) else ""


def nothing_known(name: str) -> str:
    """Return no reason."""
    del name
    return ""


def no_option(path: str, unit: str) -> Condition | None:
    """Return the condition of a column without a case.

    None, since an option of a case names the column.
    """
    del path, unit
    return None


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
    option : callable
        Returns the condition of a column that is named by the path of an option, from this and its unit; None where
        there is no such option.
    why_not : callable
        Returns why there is no such measured quantity, "" where its name says nothing.
    """

    conditions: Mapping[str, Condition]
    measured: Mapping[str, Measured]
    example: str
    most: int = 2000
    option: Callable[[str, str], Condition | None] = no_option
    why_not: Callable[[str], str] = nothing_known

    def condition(self, name: str, unit: str = "") -> Condition | None:
        """Return the operating condition that a column holds."""
        return self.conditions.get(name) or (self.option(name, unit) if "." in name else None)


OPERATING_POINTS = Vocabulary(CONDITIONS, MEASURED, '"speed [1/min],radial load [kN],friction torque [N mm]"')
ERROR = " error"  # ends the name of a column of errors
COMMON_ERROR = " common error"  # likewise, of errors that all points have in common
LABEL = "label"  # a column of words, kept for tables

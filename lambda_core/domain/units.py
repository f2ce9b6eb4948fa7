"""Read and write unit strings; inside are SI floats.

Each physical quantity has a closed list of units. A dimensional field is written as a
string ("16 kN"); a bare number, a decimal comma or a unit of another quantity is an
error that says what to write instead.
"""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from functools import cache, lru_cache
from typing import Annotated, Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from lambda_core.domain.errors import nearest, unknown_name

_RPM = math.pi / 30.0
_ZERO_CELSIUS = Decimal("273.15")

# quantity -> {unit: factor to SI}; the first unit is the one engineers read, used for output.
UNITS: dict[str, dict[str, float]] = {
    "length": {"mm": 1e-3, "um": 1e-6, "nm": 1e-9, "m": 1.0, "cm": 1e-2},
    "small_length": {"um": 1e-6, "nm": 1e-9, "mm": 1e-3, "m": 1.0},
    "force": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "moment": {"N m": 1.0, "N mm": 1e-3, "kN m": 1e3},
    "pressure": {"MPa": 1e6, "GPa": 1e9, "kPa": 1e3, "Pa": 1.0, "bar": 1e5},
    "modulus": {"GPa": 1e9, "MPa": 1e6, "Pa": 1.0},
    "rotational_speed": {"rpm": _RPM, "1/min": _RPM, "rad/s": 1.0},
    "velocity": {"m/s": 1.0, "mm/s": 1e-3, "um/s": 1e-6, "nm/s": 1e-9},
    "temperature": {"degC": 1.0, "K": 1.0},
    "temperature_difference": {"K": 1.0},
    "time": {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0},
    "frequency": {"Hz": 1.0, "kHz": 1e3, "MHz": 1e6},
    "mass": {"kg": 1.0, "g": 1e-3},
    "acceleration": {"m/s2": 1.0, "mm/s2": 1e-3, "g": 9.80665},  # g: standard gravity (CGPM 1901, exact)
    "inertia": {"kg m2": 1.0, "kg mm2": 1e-6},
    "angle": {"deg": math.pi / 180.0, "rad": 1.0, "mrad": 1e-3},
    "stiffness": {"N/m": 1.0, "N/um": 1e6, "N/mm": 1e3, "kN/mm": 1e6},
    "damping": {"N s/m": 1.0, "N s/mm": 1e3},
    "angular_stiffness": {"N m/rad": 1.0, "N m/mrad": 1e3},
    "angular_damping": {"N m s/rad": 1.0},
    "viscosity": {"mPa s": 1e-3, "Pa s": 1.0},
    "kinematic_viscosity": {"mm2/s": 1e-6, "cSt": 1e-6, "m2/s": 1.0},
    "density": {"kg/m3": 1.0, "g/cm3": 1e3},
    "thermal_conductivity": {"W/(m K)": 1.0},
    "specific_heat": {"J/(kg K)": 1.0, "kJ/(kg K)": 1e3},
    "thermal_expansion": {"1/K": 1.0, "1e-6/K": 1e-6},
    "pressure_viscosity": {"1/GPa": 1e-9, "mm2/N": 1e-6, "1/Pa": 1.0},
    "volume": {"mm3": 1e-9, "m3": 1.0, "ml": 1e-6, "l": 1e-3},
    "area": {"mm2": 1e-6, "cm2": 1e-4, "m2": 1.0},
    "power": {"W": 1.0, "kW": 1e3, "mW": 1e-3},
    "thermal_conductance": {"W/K": 1.0, "mW/K": 1e-3},
    "heat_transfer": {"W/(m2 K)": 1.0},
    "heat_capacity": {"J/K": 1.0, "kJ/K": 1e3},
    "volume_flow": {"l/min": 1e-3 / 60.0, "ml/min": 1e-6 / 60.0, "mm3/s": 1e-9, "m3/s": 1.0},
    "unbalance": {"g mm": 1e-6, "kg m": 1.0, "kg mm": 1e-3},
    "voltage": {"V": 1.0, "mV": 1e-3, "kV": 1e3},
    "current": {"A": 1.0, "mA": 1e-3, "uA": 1e-6, "kA": 1e3},
    "resistance": {"Ohm": 1.0, "mOhm": 1e-3, "kOhm": 1e3, "MOhm": 1e6, "GOhm": 1e9},
    "capacitance": {"pF": 1e-12, "nF": 1e-9, "uF": 1e-6, "F": 1.0},
    "field_strength": {"V/um": 1e6, "kV/mm": 1e6, "MV/m": 1e6, "V/mm": 1e3, "V/m": 1.0},
    "conductivity": {"S/m": 1.0, "pS/m": 1e-12, "nS/m": 1e-9, "uS/m": 1e-6},
    "ratio": {"-": 1.0, "%": 1e-2},
    "number_density": {"1/mm3": 1e9, "1/m3": 1.0},
}

# Units of the international yard and pound (1959, exact), and of the horse power of 550 ft lbf/s.
INCH, FOOT, POUND = 0.0254, 0.3048, 0.45359237
POUND_FORCE = 4.4482216152605  # POUND times 9.80665 m/s2
PSI = 6894.757293168361  # POUND_FORCE/INCH^2
HORSEPOWER = 745.6998715822702  # 550 FOOT POUND_FORCE
# quantity -> {unit: factor to SI}: read wherever a value is written, never written by the program itself.
CUSTOMARY: dict[str, dict[str, float]] = {
    "length": {"in": INCH, "ft": FOOT},
    "small_length": {"in": INCH, "uin": 2.54e-8},
    "force": {"lbf": POUND_FORCE},
    "moment": {"lbf in": 0.1129848290276167, "lbf ft": 1.3558179483314004},
    "pressure": {"psi": PSI, "ksi": 6894757.293168361},
    "modulus": {"psi": PSI, "ksi": 6894757.293168361},
    "velocity": {"ft/s": FOOT, "in/s": INCH},
    "acceleration": {"ft/s2": FOOT},
    "temperature": {"degF": 5.0 / 9.0},
    "mass": {"lb": POUND},
    "stiffness": {"lbf/in": 175.12683524647636},
    "viscosity": {"cP": 1e-3},
    "power": {"hp": HORSEPOWER},
    "area": {"in2": 6.4516e-4},
    "volume": {"in3": 1.6387064e-5},
    "volume_flow": {"gal/min": 6.30901964e-5},
}
_FAHRENHEIT = Decimal("459.67")  # between the zeros of the Fahrenheit scale and of thermodynamic temperature

_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_VALUE = re.compile(rf"^\s*({_NUMBER})\s*(.*?)\s*$")
_COMMA = re.compile(r"^\s*([+-]?\d+),(\d+)\s*(.*?)\s*$")
# Thousands set apart: "6,000", "1,234.5", "6 000", "6'000"
_GROUPED = re.compile(
    r"^\s*([+-]?[1-9]\d{0,2})((?:,\d{3})+|(?:[ '\u00a0\u2009\u202f]\d{3})+)(\.\d*)?(?!\d)\s*(.*?)\s*$"
)


_ALSO_WRITTEN = {
    "deg C": "degC", "C": "degC", "deg F": "degF", "min-1": "1/min", "Nm": "N m", "Nmm": "N mm", "inch": "in",
    "lbf-in": "lbf in", "in lbf": "lbf in", "lbf-ft": "lbf ft", "ft lbf": "lbf ft", "lbs": "lb",
}  # fmt: skip


@lru_cache(maxsize=256)
def _spelling(unit: str) -> str:
    """Fold the common spellings of one unit.

    It folds micro signs, dots, superscripts and spaces.
    """
    table = str.maketrans({"µ": "u", "μ": "u", "·": " ", "*": " ", "²": "2", "³": "3", "°": "deg"})
    folded = re.sub(r"\s+", " ", unit.translate(table)).strip().replace("^", "")
    return _ALSO_WRITTEN.get(folded, folded)


def misread(text: str, unit: str = "") -> str:
    """Correct a number with commas.

    A comma, or grouped digits; "" when there is neither.

    Where two readings are possible ("6,000 rpm") both are named and none is advised. `unit` stands where `text` has
    none.
    """
    grouped = _GROUPED.match(text)
    if grouped:
        head, groups, fraction, rest = grouped[1], grouped[2], grouped[3] or "", grouped[4] or unit
        joined = f"{head}{re.sub(r'[^0-9]', '', groups)}{fraction} {rest}".rstrip()
        if groups.count(",") == 1 and not fraction:
            point = f"{head}.{groups[1:]} {rest}".rstrip()
            return f'"{text}" can be read two ways: write "{joined}" or "{point}", without a comma'
        return f'"{text}": write the digits together: "{joined}"'
    comma = _COMMA.match(text)
    if comma:
        point = f"{comma[1]}.{comma[2]} {comma[3] or unit}".rstrip()
        return f'"{text}": write a decimal point: "{point}"'
    return ""


_EVERYDAY = (1e-3, 1e5)  # sizes of numbers that people write in the first unit of a quantity


def _unit_meant(value: float, units: Mapping[str, float]) -> str:
    """Return the unit to propose for a bare number.

    It is the SI unit for a very large or small number.
    """
    first = next(iter(units))
    if value == 0.0 or _EVERYDAY[0] <= abs(value) < _EVERYDAY[1]:
        return first
    return next((unit for unit, factor in units.items() if factor == 1.0), first)


def parse(text: object, quantity: str) -> float:
    """Read a unit string as an SI float.

    Parameters
    ----------
    text : object
        What stands in the file, for example ``"16 kN"``.
    quantity : str
        Key of :data:`UNITS`.

    Returns
    -------
    float
        Value in SI units (temperatures in K, angles in rad, speeds of rotation in rad/s).

    Raises
    ------
    ValueError
        With a sentence that says what to write.
    """
    units = units_of(quantity)
    first = next(iter(units))
    if isinstance(text, bool) or not isinstance(text, int | float | str):
        article = "an" if quantity[0] in "aeiou" else "a"
        raise ValueError(f'expected {article} {quantity.replace("_", " ")} with its unit, for example "1 {first}"')
    if isinstance(text, int | float):
        if not abs(text) <= sys.float_info.max:
            raise ValueError(f'must be a finite number with its unit, for example "1 {first}"')
        unit = _unit_meant(float(text), units)
        raise ValueError(f'{text:g} has no unit: write "{text:g} {unit}" (allowed: {", ".join(units)})')
    if mistake := misread(text, first):
        raise ValueError(mistake)
    match = _VALUE.match(text)
    if not match:
        raise ValueError(f'"{text}" is not a number with a unit, for example "1 {first}"')
    unit = _spelling(match[2])
    if not unit:
        unit = _unit_meant(float(match[1]), units)
        raise ValueError(f'"{text}" has no unit: write "{match[1]} {unit}" (allowed: {", ".join(units)})')
    if unit not in units:
        close = nearest(unit, units)
        hint = f"; did you mean {close[0]}?" if close else ""
        raise ValueError(f'"{text}": {unit} is not a unit of {quantity}; allowed: {", ".join(units)}{hint}')
    value = _to_si(match[1], quantity, unit)
    if not math.isfinite(value):
        raise ValueError(f'"{text}" is not a finite number')
    if quantity == "temperature" and value <= 0.0:
        raise ValueError(f'"{text}" is at or below absolute zero')
    return value


@cache
def units_of(quantity: str) -> dict[str, float]:
    """Return every unit of a value.

    Those of :data:`UNITS` come first, each with its factor to SI.
    """
    return UNITS[quantity] | CUSTOMARY.get(quantity, {})


@cache
def _factor(quantity: str, unit: str) -> Decimal:
    return Decimal(repr(units_of(quantity)[unit]))


def _to_si(number: str, quantity: str, unit: str) -> float:
    """Convert the digits of a number.

    Decimal arithmetic rounds once: "0.1 um" is 1e-07, not 9.999999999999999e-08.
    """
    try:
        if quantity == "temperature" and unit == "degF":
            return float((Decimal(number) + _FAHRENHEIT) * 5 / 9)
        exact = Decimal(number) * _factor(quantity, unit)
        return float(exact + _ZERO_CELSIUS if quantity == "temperature" and unit == "degC" else exact)
    except ArithmeticError:
        return math.inf


def from_si(value: float, quantity: str, unit: str | None = None) -> float:
    """Convert an SI float to `unit`.

    The default is the first unit of the quantity.
    """
    unit = unit or next(iter(UNITS[quantity]))
    exact = Decimal(repr(float(value)))
    if quantity == "temperature" and unit == "degC":
        return float(exact - _ZERO_CELSIUS)
    if quantity == "temperature" and unit == "degF":
        return float(exact * 9 / 5 - _FAHRENHEIT)
    return float(exact / _factor(quantity, unit))


_FEW_DIGITS = 8


def _digits(number: str) -> int:
    """Return the count of a number's significant digits.

    Zeros before and behind do not count.
    """
    return len(number.partition("e")[0].replace(".", "").strip("-0"))


def _decades_off(number: float) -> float:
    """Return the decades outside 0.1 to 1000.

    Begun ones count.
    """
    if number == 0.0 or 0.1 <= abs(number) < 1000.0:
        return 0.0
    decades = math.log10(abs(number))
    return max(-1.0 - decades, math.floor(decades - 3.0) + 1.0)


def show(value: float, quantity: str, digits: int | None = None) -> str:
    """Write an SI float as a unit string.

    It is exact (reads back equal) unless `digits` is given.

    The exact spelling takes the first unit of the quantity in which the number has few digits and lies between 0.1 and
    1000, or comes nearest to that.
    """
    if digits is not None:
        return _rounded(value, quantity, digits)
    return _exact(repr(float(value)), quantity)


@lru_cache(maxsize=4096)  # a study resolves thousands of cases that differ in a few numbers
def _exact(given: str, quantity: str) -> str:
    value = float(given)  # by its text: -0.0 is not 0.0
    spellings: list[tuple[bool, float, str]] = []
    for unit in UNITS[quantity]:
        converted = from_si(value, quantity, unit)
        if not math.isfinite(converted):
            continue
        for number in (f"{converted:.12g}", repr(converted)):
            if _to_si(number, quantity, unit) == value:
                off = 0.0 if quantity == "temperature" else _decades_off(converted)
                spellings.append((_digits(number) > _FEW_DIGITS, off, f"{number} {unit}"))
                break
    if not spellings:
        raise ValueError(f"{value!r} has no exact spelling as a {quantity}")
    return min(spellings, key=lambda spelling: spelling[:2])[2]


# Quantities that people read in one unit, whatever the magnitude.
_ONE_UNIT = ("temperature", "rotational_speed", "angle")


def _rounded(value: float, quantity: str, digits: int) -> str:
    """Write a rounded number with its unit.

    The unit is the first one in which the number lies between 0.1 and 1000.
    """
    units = list(UNITS[quantity])
    handy = [u for u in units if 0.1 <= abs(from_si(value, quantity, u)) < 1000.0]
    unit = units[0] if quantity in _ONE_UNIT or not handy else handy[0]
    return f"{from_si(value, quantity, unit):.{digits}g} {unit}"


@dataclass(frozen=True)
class Quantity:
    """Annotation of a dimensional field: ``Annotated[float, Quantity("force")]``.

    It is a unit string in files and an SI float in Python. A Python float passes as SI only when the model is built
    with ``context={"si": True}`` (``model_validate``).
    """

    name: str

    def __post_init__(self) -> None:
        if self.name not in UNITS:
            raise ValueError(unknown_name("quantity", self.name, UNITS))

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        def validate(value: Any, info: core_schema.ValidationInfo) -> float:
            if info.context and info.context.get("si") and type(value) in (int, float):
                return float(value)
            return parse(value, self.name)

        return core_schema.with_info_before_validator_function(
            validate,
            handler(source),
            serialization=core_schema.plain_serializer_function_ser_schema(
                lambda value: show(value, self.name) if isinstance(value, float) else value, when_used="json"
            ),
        )

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        units = list(UNITS[self.name])
        return {
            "type": "string",
            "x-quantity": self.name,
            "x-units": units,
            "examples": [f"1 {units[0]}"],
        }


Length = Annotated[float, Quantity("length")]
SmallLength = Annotated[float, Quantity("small_length")]
Force = Annotated[float, Quantity("force")]
Moment = Annotated[float, Quantity("moment")]
Pressure = Annotated[float, Quantity("pressure")]
Modulus = Annotated[float, Quantity("modulus")]
RotationalSpeed = Annotated[float, Quantity("rotational_speed")]
Velocity = Annotated[float, Quantity("velocity")]
Acceleration = Annotated[float, Quantity("acceleration")]
Temperature = Annotated[float, Quantity("temperature")]
Time = Annotated[float, Quantity("time")]
Frequency = Annotated[float, Quantity("frequency")]
Mass = Annotated[float, Quantity("mass")]
Inertia = Annotated[float, Quantity("inertia")]
Angle = Annotated[float, Quantity("angle")]
Stiffness = Annotated[float, Quantity("stiffness")]
Damping = Annotated[float, Quantity("damping")]
AngularStiffness = Annotated[float, Quantity("angular_stiffness")]
AngularDamping = Annotated[float, Quantity("angular_damping")]
Viscosity = Annotated[float, Quantity("viscosity")]
KinematicViscosity = Annotated[float, Quantity("kinematic_viscosity")]
Density = Annotated[float, Quantity("density")]
ThermalConductivity = Annotated[float, Quantity("thermal_conductivity")]
SpecificHeat = Annotated[float, Quantity("specific_heat")]
ThermalExpansion = Annotated[float, Quantity("thermal_expansion")]
PressureViscosity = Annotated[float, Quantity("pressure_viscosity")]
Unbalance = Annotated[float, Quantity("unbalance")]
Volume = Annotated[float, Quantity("volume")]
VolumeFlow = Annotated[float, Quantity("volume_flow")]
Area = Annotated[float, Quantity("area")]
Power = Annotated[float, Quantity("power")]
ThermalConductance = Annotated[float, Quantity("thermal_conductance")]
HeatTransfer = Annotated[float, Quantity("heat_transfer")]
HeatCapacity = Annotated[float, Quantity("heat_capacity")]
Voltage = Annotated[float, Quantity("voltage")]
Current = Annotated[float, Quantity("current")]
Resistance = Annotated[float, Quantity("resistance")]
Capacitance = Annotated[float, Quantity("capacitance")]
FieldStrength = Annotated[float, Quantity("field_strength")]
Conductivity = Annotated[float, Quantity("conductivity")]
NumberDensity = Annotated[float, Quantity("number_density")]

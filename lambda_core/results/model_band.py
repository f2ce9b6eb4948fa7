"""Define the model band of results."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Self

from pydantic import Field

from lambda_core.domain.number_text import rounded
from lambda_core.results.record import INTERFACE, Record

COVERAGE = 0.9  # of a model band
# Quantity -> number of the machine interface that it is the band of.
FIELDS = {
    "friction torque": "friction_torque_Nmm",
    "power loss": "power_loss_W",
    "minimum film": "min_film_um",
    "maximum pressure": "max_pressure_GPa",
    "capacitance": "bearing_capacitance_nF",
    "rating life": "reference_life_h",
    "oil temperature": "oil_temperature_degC",
    "inner ring temperature": "inner_ring_temperature_degC",
    "outer ring temperature": "outer_ring_temperature_degC",
}
# Quantity -> what it is a temperature of; they have bands where they are computed.
TEMPERATURES = {name: name.removesuffix(" temperature") for name in FIELDS if name.endswith("temperature")}
QUANTITIES = tuple(FIELDS)
_ENDS = "ends of the 90 % model band; empty without one"
_COMPUTED = "ends of the 90 % model band of a computed temperature; empty where it is given"
LAW_OF = "law of "  # begins the name of a contributor that exchanges the laws of a role
_SIDES = {"low": "lower", "high": "upper"}
_NAMED = 3  # largest contributors
LEAST_SHARE = 0.5  # [%] below it a band is not worth its causes
_NEAR_END = 0.02  # of the width of a band or of a contributor
NARROW = f"within {LEAST_SHARE:g} %"


def temperature_of(node: str) -> str:
    """Return the quantity of a thermal node's temperature."""
    return f"{node.replace('_', ' ')} temperature"


class Contributor(Record):
    """One source of the band."""

    name: str
    share: float = Field(description="of the variance of the band")
    low: float = Field(description="result at one end of the range, or the smallest of all laws")
    high: float
    source: str


class Band(Record):
    """The band of one result."""

    quantity: str
    unit: str
    value: float = Field(
        description="of the result; of a band alone: quasi-static, mean over the positions of the balls"
    )
    low: float
    high: float
    contributors: list[Contributor]

    @property
    def title(self) -> str:
        """Name in texts; a life has its symbol."""
        return f"{self.quantity} L_10rh" if FIELDS.get(self.quantity) == "reference_life_h" else self.quantity

    @property
    def half_width_pct(self) -> float:
        """Half of the width over the value [%]."""
        return 50.0 * (self.high - self.low) / abs(self.value) if self.value else math.nan

    def around(self, value: float) -> list[float]:
        """Return the ends for another value.

        It is the result of a run, say: they lie as far off in proportion.
        """
        moved = self.moved(value)
        return [moved.low, moved.high]

    def moved(self, value: float) -> Self:
        """Return the band of another value, with its contributors."""
        if value == self.value:
            return self

        def at(one: float) -> float:
            return value * one / self.value if self.value else value

        causes = [one.model_copy(update={"low": at(one.low), "high": at(one.high)}) for one in self.contributors]
        ends = {"value": value, "low": at(self.low), "high": at(self.high)}
        return self.model_copy(update={**ends, "contributors": causes})

    def mostly(self) -> str:
        """Return the names and shares of the largest contributors."""
        return ", ".join(f"{c.name} {100.0 * c.share:.0f} %" for c in self.contributors[:_NAMED])

    def why(self) -> str:
        """Return the causes, and why the value is an end."""
        return "; ".join(text for text in (self.mostly(), self.at_end()) if text)

    def at_end(self) -> str:
        """Say why the value is an end of its band.

        Empty where it is not, or where no contributor tells why.
        """
        for end, most in (("low", "smallest"), ("high", "largest")):
            if not self._is_near(end, self):
                continue
            cause = next((one.name for one in self.contributors[:_NAMED] if self._is_near(end, one)), "")
            if cause:
                of_laws = f"the {cause} gives the {most} value of all laws"
                reason = of_laws if cause.startswith(LAW_OF) else f"{cause} is at an end of its range"
                return f"the value is near the {_SIDES[end]} end of its band, because {reason}"
        return ""

    def _is_near(self, end: str, whose: Band | Contributor) -> bool:
        """Tell whether the value is near an end."""
        return abs(float(getattr(whose, end)) - self.value) <= _NEAR_END * (whose.high - whose.low)

    def text(self) -> str:
        """Return the band in one line.

        It is rounded to the meaningful digits.
        """
        half = 0.5 * (self.high - self.low)
        shown = [rounded(number, half) for number in (self.value, self.low, self.high)]
        names = self.why()
        why = f"; mostly {names}" if names else ""
        return f"{self.title} {shown[0]} {self.unit}, 90 % model band {shown[1]}..{shown[2]} {self.unit}{why}"


class ModelBand(Record):
    """Bands of the results of a case.

    The case may also be one bearing of a machine.
    """

    interface: int = INTERFACE
    case: str
    coverage: float
    bands: list[Band]
    left_out: list[str] = Field(description="what could not be varied, and why")

    def band(self, quantity: str) -> Band:
        """Return the band of one result."""
        return next(band for band in self.bands if band.quantity == quantity)

    def put_around(self, values: Mapping[str, float | None]) -> Self:
        """Return the same around the numbers of a result.

        Bands whose number is None are left out.

        Parameters
        ----------
        values : mapping
            Numbers under their names in the machine interface; a band without one stays where it is.
        """
        numbers = [(band, values.get(FIELDS[band.quantity], band.value)) for band in self.bands]
        return self.model_copy(update={"bands": [band.moved(to) for band, to in numbers if to is not None]})

    def fields(self) -> dict[str, list[float]]:
        """Return the ends of each band by name.

        The name is that of its number in the machine interface, with ``_band``.
        """
        return {f"{FIELDS[band.quantity]}_band": [band.low, band.high] for band in self.bands}

    def shares(self) -> list[str]:
        """Return the uncertainty of each result.

        Each result has one line in % or K.
        """
        found = []
        for band in self.bands:
            why = f"   mostly {band.why()}" if band.contributors else ""
            if band.quantity in TEMPERATURES:
                found.append(f"{band.quantity} {band.low - band.value:+.1f} .. {band.high - band.value:+.1f} K{why}")
                continue
            low, high = (100.0 * (end / band.value - 1.0) for end in (band.low, band.high))
            if max(abs(low), abs(high)) < LEAST_SHARE:
                found.append(f"{band.title} {NARROW}")
                continue
            found.append(f"{band.title} {low:+.0f} .. {high:+.0f} %{why}")
        return found

    def text(self) -> str:
        """Return a heading and one line per result."""
        head = "model band, quasi-static, mean over the positions of the rolling elements:"
        return "\n".join([head, *(band.text() for band in self.bands), *self.left_out])


class Banded(Record):
    """Model band of a result's numbers.

    It has their names with ``_band``.
    """

    friction_torque_Nmm_band: list[float] = Field(description=_ENDS, default=[])
    power_loss_W_band: list[float] = Field(description=_ENDS, default=[])
    min_film_um_band: list[float] = Field(description=_ENDS, default=[])
    max_pressure_GPa_band: list[float] = Field(description=_ENDS, default=[])
    bearing_capacitance_nF_band: list[float] = Field(description=_ENDS, default=[])
    reference_life_h_band: list[float] = Field(description=_ENDS, default=[])
    oil_temperature_degC_band: list[float] = Field(description=_COMPUTED, default=[])
    inner_ring_temperature_degC_band: list[float] = Field(description=_COMPUTED, default=[])
    outer_ring_temperature_degC_band: list[float] = Field(description=_COMPUTED, default=[])
    model_band: ModelBand | None = Field(
        description="the same bands with their causes; null without them", default=None
    )

    def with_band(self, band: ModelBand | None) -> Self:
        """Return the same with a model band around its numbers."""
        if band is None:
            return self
        numbers = dict(self)
        rating = numbers.get("rating")
        if rating is not None:
            numbers["reference_life_h"] = rating.reference_life_h
        own = band.put_around(numbers)
        return self.model_copy(update={**own.fields(), "model_band": own})


class MachineBand(Record):
    """Bands of each bearing of a machine.

    They are those of the results under its loads there.
    """

    interface: int = INTERFACE
    case: str
    bearings: dict[str, ModelBand]

    def fields(self) -> dict[str, list[float]]:
        """Return the bands of all bearings' torque.

        They are the ends of the bands of torque and power loss.

        Their errors are those of the same laws: they add up.
        """
        each = [band.fields() for band in self.bearings.values()]
        added = ("friction_torque_Nmm_band", "power_loss_W_band")
        return {name: sum_of_bands([own.get(name) for own in each]) for name in added}

    def shares(self) -> list[str]:
        """Return the uncertainty of each result [%].

        It has a line for each bearing and result.
        """
        return [f"{name}: {text}" for name, band in self.bearings.items() for text in band.shares()]

    def text(self) -> str:
        """Return the lines of all bearings' bands.

        Each bearing has a heading and one line per result.
        """
        return "\n".join(f"{name}: {band.text()}" for name, band in self.bearings.items())


def sum_of_bands(bands: Sequence[Sequence[float] | None]) -> list[float]:
    """Return the sum of correlated bands.

    The errors go together, so their ends add up. The result is empty where a band is missing.
    """
    known = [band for band in bands if band]
    return [sum(band[end] for band in known) for end in (0, 1)] if len(known) == len(bands) and known else []

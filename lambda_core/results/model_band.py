"""The model band of results: what ranges of parameters and the choice of laws leave open."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from pydantic import Field

from lambda_core.domain.number_text import rounded
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.record import INTERFACE, Record

COVERAGE = 0.9  # of a model band
# Quantity -> number of the machine interface that it is the band of.
FIELDS = {
    "friction torque": "friction_torque_Nmm",
    "power loss": "power_loss_W",
    "minimum film": "min_film_um",
    "maximum pressure": "max_pressure_GPa",
    "capacitance": "bearing_capacitance_nF",
    "oil temperature": "oil_temperature_degC",
    "rating life": "reference_life_h",
}
QUANTITIES = ("friction torque", "power loss", "minimum film", "maximum pressure", "capacitance")
_NAMED = 3  # largest contributors


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
    value: float = Field(description="quasi-static, mean over the positions of the balls")
    low: float
    high: float
    contributors: list[Contributor]

    @property
    def half_width_pct(self) -> float:
        """Half of the width over the value [%]."""
        return 50.0 * (self.high - self.low) / abs(self.value) if self.value else math.nan

    def around(self, value: float) -> list[float]:
        """Return the ends for another value of the result, as of a run: they lie as far off in proportion."""
        if not self.value:
            return [value, value]
        return [value * self.low / self.value, value * self.high / self.value]

    def mostly(self) -> str:
        """Return the names and shares of the largest contributors."""
        return ", ".join(f"{c.name} {100.0 * c.share:.0f} %" for c in self.contributors[:_NAMED])

    def text(self) -> str:
        """Return the band in one line, rounded to what it leaves a meaning."""
        half = 0.5 * (self.high - self.low)
        shown = [rounded(number, half) for number in (self.value, self.low, self.high)]
        names = self.mostly()
        why = f"; mostly {names}" if names else ""
        return f"{self.quantity} {shown[0]} {self.unit}, 90 % model band {shown[1]}..{shown[2]} {self.unit}{why}"


class ModelBand(Record):
    """The bands of the results of a case."""

    interface: int = INTERFACE
    case: str
    coverage: float
    bands: list[Band]
    left_out: list[str] = Field(description="what could not be varied, and why")

    def band(self, quantity: str) -> Band:
        """Return the band of one result."""
        return next(band for band in self.bands if band.quantity == quantity)

    def fields(self, values: Mapping[str, float | None] | None = None) -> dict[str, list[float]]:
        """Return the ends of each band under the name of its number in the machine interface, with ``_band``.

        Parameters
        ----------
        values : mapping, optional
            Numbers of a run under their names in that interface, which the bands are put around.
        """
        found = {}
        for band in self.bands:
            value = band.value if values is None else values.get(FIELDS[band.quantity])
            if value is not None:
                found[f"{FIELDS[band.quantity]}_band"] = band.around(value)
        return found

    def text(self) -> str:
        """Return a heading and one line per result."""
        head = "model band, quasi-static, mean over the positions of the balls:"
        return "\n".join([head, *(band.text() for band in self.bands), *self.left_out])


def banded(value: float | None, ends: Sequence[float] | None, unit: str, units: UnitSystem = SI) -> str:
    """Return a number and its model band, both rounded to what the band leaves a meaning; nothing without a band."""
    if value is None or not ends:
        return ""
    shown = [units.value(number, unit) for number in (value, *ends)]
    half = 0.5 * abs(shown[2] - shown[1])
    texts = [rounded(number, half) for number in shown]
    return f"{texts[0]} {units.unit(unit)}   90 % model band {texts[1]} .. {texts[2]} {units.unit(unit)}"

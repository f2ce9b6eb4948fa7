"""Judge a solution against required life and limits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from pydantic import Field

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.elements.roller.roller_ratings import HIGHEST_ROLLER_PRESSURE
from lambda_core.model.checks.operating_limits import (
    LARGEST_LIFE_LOAD,
    OIL_TEMPERATURES,
    ROLLER_TILT,
    is_preloaded,
    known_value,
    minimum_load,
    permissible_tilt,
    ratings,
    relative_speed,
)
from lambda_core.results.limits import highest_pressure
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel

_ZERO_CELSIUS = 273.15
_LEAST_SAFETY = 1.0  # ISO 76: the total dent of 0.0001 D_w is reached at P_0 = C_0


class Margin(Record):
    """Margin to a requirement or a limit.

    A requirement comes from the case, a limit from the bearing, the oil or a standard.
    """

    name: str
    value: float
    limit: float
    unit: str
    side: Literal["at most", "at least"]
    is_required: bool = Field(description="whether the case requires it; otherwise the limit is a general one")
    met: bool
    share: float = Field(description="value over limit")
    basis: str = Field(description="where the number or the limit comes from")

    def number(self, value: float, units: UnitSystem = SI) -> str:
        """Write a number in the unit of this margin."""
        return hours(value) if self.unit == "h" else _written(value, self.unit, units)

    def text(self, units: UnitSystem = SI) -> str:
        """Return name, share and limit in a few words."""
        limit = _written(self.limit, self.unit, units)
        if self.unit == "h":
            return f"{self.name} {hours(self.value)} of {limit} required"
        if self.name == "load":
            if self.met:
                return f"minimum load met {_times(self.share)} times"
            return f"load {100.0 * self.share:.0f} % of the minimum of {limit}"
        if self.side == "at most" and self.unit != "degC":
            return f"{self.name} {100.0 * self.share:.0f} % of {limit}"
        return f"{self.name} {_written(self.value, self.unit, units)} ({self.side} {limit})"


class Verdict(Record):
    """Verdict on all requirements and limits."""

    met: bool = Field(description="whether all requirements and limits are met")
    sentence: str = Field(description="the verdict in one sentence, SI")
    margins: list[Margin] = Field(description="requirements of the case first, then limits")

    def lines(self, units: UnitSystem = SI) -> tuple[str, list[str]]:
        """Return the verdict with met margins.

        They are those to limits that are not named in it.
        """
        return units.sentence(self.sentence), [
            one.text(units) for one in self.margins if one.met and not one.is_required
        ]


class Limits(Record):
    """Requirements and limits of a bearing.

    Requirements of its case, limits of bearing, oil and standards.
    """

    speed_rpm: float = Field(description="largest relative speed of the rings")
    limiting_speed_rpm: float | None = Field(description="of the catalogue")
    minimum_load_N: float | None = Field(description="0.01 C of balls, 0.02 C of rollers; null at rest, preloaded")
    largest_load_N: float | None = Field(description="C/2 of ISO 281; null at rest")
    axial_load_N: float | None = Field(description="on ribs of cylindrical rollers; null without", default=None)
    largest_axial_load_N: float | None = Field(description="permissible constant load of these ribs", default=None)
    pressure_GPa: float = Field(description="where steel yields (ISO 76)")
    tilt_mrad: float = Field(description="that bearings of this kind take")
    oil_degC: float
    oil_limit_degC: float = Field(description="of the grease, or of laws of viscosity")
    required_life_h: float | None
    required_static_safety: float | None
    required_viscosity_ratio: float | None
    required_film_parameter: float | None
    required_oil_degC: float | None


@dataclass(frozen=True)
class Found:
    """Numbers of a solution for the verdict.

    None where there are none.
    """

    pressure_GPa: float | None
    film_parameter: float | None  # smallest
    tilt_mrad: float
    equivalent_load_N: float | None
    static_safety: float | None
    viscosity_ratio: float | None
    life_h: float | None
    life_name: str  # the rating life that counts


def limits_of(model: BearingModel) -> Limits:
    """Return what a bearing has to keep to."""
    speed, required = 30.0 / math.pi * relative_speed(model), model.requirements
    dynamic, _ = ratings(model)
    most = known_value(model, "bearing.limiting_speed")
    grease = known_value(model, "lubricant.highest_temperature")
    kind, rollers, least = model.geometry.kind.name, model.rollers is not None, minimum_load(model)
    return Limits(
        speed_rpm=speed,
        limiting_speed_rpm=None if most is None else 30.0 / math.pi * most,
        minimum_load_N=least * dynamic if speed and not is_preloaded(model) else None,
        largest_load_N=LARGEST_LIFE_LOAD * dynamic if speed else None,
        pressure_GPa=1e-9 * (HIGHEST_ROLLER_PRESSURE if rollers else highest_pressure(kind)),
        tilt_mrad=1e3 * (ROLLER_TILT if rollers else permissible_tilt(kind)),
        oil_degC=model.oil.temperature - _ZERO_CELSIUS,
        oil_limit_degC=OIL_TEMPERATURES[1] if grease is None else grease - _ZERO_CELSIUS,
        required_life_h=None if required.life is None else required.life / 3600.0,
        required_static_safety=required.static_safety,
        required_viscosity_ratio=required.viscosity_ratio,
        required_film_parameter=required.film_parameter,
        required_oil_degC=None if required.temperature is None else required.temperature - _ZERO_CELSIUS,
    )


def verdict(limits: Limits, found: Found) -> Verdict:
    """Compare a solution with requirements and limits."""
    margins = [*_required(limits, found), *_general(limits, found)]
    missing = [] if limits.required_life_h is None or found.life_h is not None else ["no rating life is known"]
    failed = [*missing, *(one.text() for one in margins if not one.met)]
    wanted = [one for one in margins if one.is_required and one.met]
    if failed:
        sentence = f"NOT MET: {'; '.join(failed)}"
    elif wanted:
        sentence = f"MET: {'; '.join(one.text() for one in wanted)}"
    else:
        sentence = "within all limits; no life is required (requirements.life)"
    return Verdict(met=not failed, sentence=sentence, margins=margins)


def _required(limits: Limits, found: Found) -> Iterator[Margin]:
    """Return margins to what the case requires."""
    if limits.required_life_h is not None and found.life_h is not None:
        yield _margin(found.life_name, found.life_h, limits.required_life_h, "h", "at least", "requirements.life")
    for name, value, least, key in (
        ("static safety", found.static_safety, limits.required_static_safety, "static_safety"),
        ("kappa", found.viscosity_ratio, limits.required_viscosity_ratio, "viscosity_ratio"),
        ("Lambda", found.film_parameter, limits.required_film_parameter, "film_parameter"),
    ):
        if least is not None and value is not None:
            yield _margin(name, value, least, "", "at least", f"requirements.{key}")
    if limits.required_oil_degC is not None:
        basis = "requirements.temperature"
        yield _margin("oil temperature", limits.oil_degC, limits.required_oil_degC, "degC", "at most", basis)


def _general(limits: Limits, found: Found) -> Iterator[Margin]:
    """Return margins to limits of bearing, oil and standards."""
    load, maker = found.equivalent_load_N, "catalogue"
    if limits.limiting_speed_rpm is not None:
        yield _margin("n", limits.speed_rpm, limits.limiting_speed_rpm, "1/min", "at most", maker, required=False)
    if load is not None and limits.minimum_load_N is not None:
        basis = f"SKF: {LARGEST_LIFE_LOAD * limits.minimum_load_N / (limits.largest_load_N or math.inf):.3g} C"
        yield _margin("load", load, limits.minimum_load_N, "N", "at least", basis, required=False)
    if load is not None and limits.largest_load_N is not None:
        yield _margin("P", load, limits.largest_load_N, "N", "at most", "ISO 281: C/2", required=False)
    if limits.axial_load_N is not None and limits.largest_axial_load_N is not None:
        basis = "SKF: axial load of ribs"
        yield _margin(
            "axial load", limits.axial_load_N, limits.largest_axial_load_N, "N", "at most", basis, required=False
        )
    if found.pressure_GPa is not None:
        yield _margin("p", found.pressure_GPa, limits.pressure_GPa, "GPa", "at most", "ISO 76", required=False)
    if found.static_safety is not None and limits.required_static_safety is None:
        yield _margin("static safety", found.static_safety, _LEAST_SAFETY, "", "at least", "ISO 76", required=False)
    yield _margin("tilt", found.tilt_mrad, limits.tilt_mrad, "mrad", "at most", maker, required=False)
    if limits.required_oil_degC is None:
        basis = "grease or laws of viscosity"
        yield _margin("oil", limits.oil_degC, limits.oil_limit_degC, "degC", "at most", basis, required=False)


def _margin(
    name: str, value: float, limit: float, unit: str, side: Literal["at most", "at least"], basis: str, *,
    required: bool = True,
) -> Margin:  # fmt: skip
    met = value <= limit if side == "at most" else value >= limit
    return Margin(
        name=name, value=value, limit=limit, unit=unit, side=side, is_required=required, met=met,
        share=value / limit if limit else math.inf if value else 0.0, basis=basis,
    )  # fmt: skip


def _written(value: float, unit: str, units: UnitSystem) -> str:
    """Write a number with its unit."""
    if unit == "h":
        return f"{number(value, 0)} h"
    shown = units.value(value, unit)
    short = float(f"{shown:.3g}")
    text = f"{short:g}" if abs(short) < 1e3 else number(float(f"{shown:.4g}"), 0)
    return f"{text} {units.unit(unit)}".rstrip()


def _times(share: float) -> str:
    return f"{share:.2g}" if share < 1e3 else number(share, 0)

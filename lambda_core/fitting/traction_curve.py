"""Compute traction over slide-roll ratio by every law.

The contact is that of a traction machine: a steel ball on the flat face of a steel disc, with a full film.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.band.quantities import Condition, Measured, Vocabulary
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.roles import ROLES
from lambda_core.domain.units import parse, show
from lambda_core.fitting.measurements import Measurements, read_measurements
from lambda_core.fitting.overlay import BARS, NORMAL
from lambda_core.formulas.hertz import hertz_contact, load_at_pressure
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.record import INTERFACE, Record
from lambda_core.views.chart import Axis, Panel, Series, ViewData

BALL = 19.05e-3  # diameter, that of usual traction machines [m]
_BEARING = "SKF 6208"  # brings steel, and the laws of the oil; its geometry counts for nothing
_ELEMENT = "ball_inner"
RATIOS = tuple(np.concatenate([[0.0], np.geomspace(1e-4, 0.5, 60)]).tolist())
# Discs yield from 4 GPa on, and none runs at more than some 100 m/s; films of slower ones are too thin to be measured.
PRESSURES, SPEEDS = (1e6, 1e10), (1e-4, 1e3)  # [Pa], [m/s]
LARGEST_RATIO = 20.0  # difference of both speeds over their mean; 2 where one surface stands still
LARGEST_TRACTION = 1.0
_RINGS = 24  # of the contact, by Gauss' rule over the square of the radius
_RESULTS = 8  # room for the results of a law without cells
_ROUNDS, _CLOSED = 60, 1e-6  # of the loop of temperature and traction
_RATIO, _TRACTION = "slide-roll ratio", "traction coefficient"
COLUMNS = Vocabulary(
    {_RATIO: Condition("", "ratio", "ratio")},
    {_TRACTION: Measured("", "ratio", "-")},
    f'"{_RATIO} [%],{_TRACTION} [-]"',
)


class MeasuredTraction(Record):
    """Measured traction coefficients."""

    file: str
    slide_roll_ratio: list[float]
    coefficient: list[float]
    error: list[float] = Field(default=[], description="standard deviations; empty where the file has none")


class TractionCurve(Record):
    """Traction of an oil over slide-roll ratio, by law."""

    interface: int = INTERFACE
    oil: str = Field(description="name in the catalogue")
    pressure_GPa: float = Field(description="largest Hertzian pressure")
    temperature_degC: float = Field(description="of the oil at the inlet")
    speed_m_s: float = Field(description="mean of both surfaces")
    load_N: float = Field(description="of a ball of 19.05 mm on a flat disc, both of steel")
    film_um: float = Field(description="central film in pure rolling")
    slide_roll_ratio: list[float] = Field(description="difference of both speeds over their mean")
    coefficient: dict[str, list[float]] = Field(description="tangential over normal force, by law")
    left_out: list[str] = Field(default=[], description="laws that could not be computed, and why")
    measured: MeasuredTraction | None = Field(default=None, description="points of a file; null without one")

    def text(self) -> str:
        """Return a table for people."""
        laws = list(self.coefficient)
        head = ("slide-roll ratio [%]", *laws)
        rows = [
            (f"{100.0 * ratio:.3g}", *(f"{self.coefficient[law][i]:.4f}" for law in laws))
            for i, ratio in enumerate(self.slide_roll_ratio)
            if i % 6 == 0
        ]
        widths = [max(len(row[i]) for row in (head, *rows)) for i in range(len(head))]
        lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in (head, *rows)]
        if self.measured is not None:
            lines += self._errors(self.measured)
        return "\n".join([self._title(), *lines, *self.left_out])

    def picture(self) -> ViewData:
        """Return the curves, and what was measured, for :func:`draw`."""
        ratios = 100.0 * np.array(self.slide_roll_ratio)
        lines = [Series(name, ratios, np.array(values)) for name, values in self.coefficient.items()]
        high = 20.0  # beyond it little changes
        if (found := self.measured) is not None:
            values = np.array(found.coefficient)
            spread = np.array(found.error) if found.error else np.zeros_like(values)
            low, top = (values - NORMAL * spread, values + NORMAL * spread) if found.error else (None, None)
            at = 100.0 * np.array(found.slide_roll_ratio)
            words = BARS if found.error else ""
            lines.append(Series(found.file, at, values, "points", "measured", low=low, high=top, band=words))
            high = max(1.1 * float(at.max()), 1.0)
        panel = Panel("", Axis("slide-roll ratio", "%", low=0.0, high=high), Axis(_TRACTION, low=0.0), tuple(lines))
        notes = ("ball of 19.05 mm on a flat disc, both of steel; full film, asperities left out",)
        return ViewData("traction", "Traction over slide-roll ratio", self._title(), (panel,), notes=notes)

    def _title(self) -> str:
        return (
            f"{self.oil}, {self.temperature_degC:.4g} degC, {self.pressure_GPa:.3g} GPa, {self.speed_m_s:.4g} m/s, "
            f"central film {self.film_um:.3g} um"
        )

    def _errors(self, found: MeasuredTraction) -> list[str]:
        values, lines = np.array(found.coefficient), [f"{found.file}: {len(found.coefficient)} measured points"]
        for law, curve in self.coefficient.items():
            errors = np.interp(found.slide_roll_ratio, self.slide_roll_ratio, curve) - values
            lines.append(
                f"  {law}: mean error {errors.mean():+.4f}, root mean square {np.sqrt(np.mean(errors**2)):.4f}"
            )
        return lines


def traction_of(
    oil: str,
    pressure: str | float,
    temperature: str | float,
    speed: str | float,
    *,
    measured: str | Path | None = None,
    parameters: Mapping[str, Any] | None = None,
    announce: Callable[[str], None] | None = None,
) -> TractionCurve:
    """Return an oil's traction over slide-roll ratio by every law."""
    points = None if measured is None else _measured(read_measurements(measured, COLUMNS))
    contact_pressure, inlet = _read("pressure", pressure, "pressure"), _read("temperature", temperature, "temperature")
    mean_speed = _read("speed", speed, "velocity")
    for option, value, (low, high), quantity in (
        ("pressure", contact_pressure, PRESSURES, "pressure"),
        ("speed", mean_speed, SPEEDS, "velocity"),
    ):
        if not low <= value <= high:
            ends = f"{show(low, quantity)} to {show(high, quantity)}"
            raise UsageError(
                f"{option} {show(value, quantity, 4)}: is out of the range of traction machines; allowed: {ends}"
            )
    ratios = np.array(RATIOS)
    if points is not None:
        ratios = np.unique(np.concatenate([ratios, points.slide_roll_ratio]))
    found: dict[str, list[float]] = {}
    left_out: list[str] = []
    contact = None
    for name in _laws():
        try:
            model = _model(oil, inlet, name, parameters or {})
            contact = _Contact.of(model, contact_pressure, mean_speed, announce)
            found[name] = [contact.coefficient(ratio * mean_speed) for ratio in ratios.tolist()]
        except SolverError as error:
            left_out.append(f"{name} is left out: {error}")
    if contact is None or not found:
        raise SolverError("; ".join(left_out) or "no traction law is installed")
    return TractionCurve(
        oil=oil,
        pressure_GPa=1e-9 * contact_pressure,
        temperature_degC=inlet - 273.15,
        speed_m_s=mean_speed,
        load_N=contact.load,
        film_um=1e6 * contact.film(0.0),
        slide_roll_ratio=ratios.tolist(),
        coefficient=found,
        left_out=left_out,
        measured=points,
    )


def _read(option: str, text: str | float, quantity: str) -> float:
    try:
        return parse(text, quantity)
    except ValueError as error:
        raise UsageError(f"{option}: {error}") from None


def _measured(data: Measurements) -> MeasuredTraction:
    """Return measured points; their order does not matter."""
    values = data.measured[_TRACTION]
    if _RATIO not in data.conditions:
        raise UsageError(f'{data.name}: no column "{_RATIO} [%]": add one')
    if bool(np.any(data.conditions[_RATIO] < 0.0)):
        raise UsageError(f"{data.name}: a slide-roll ratio is negative: write its size")
    for name, column, most in (
        (_RATIO, data.conditions[_RATIO], LARGEST_RATIO),
        (_TRACTION, np.abs(values), LARGEST_TRACTION),
    ):
        if bool(np.any(column > most)):
            line = data.lines[int(np.argmax(column > most))]
            raise UsageError(f"{data.name} line {line}: a {name} is above {most:g}: is the unit in the header right?")
    error = data.deviations(_TRACTION)
    return MeasuredTraction(
        file=data.name,
        slide_roll_ratio=data.conditions[_RATIO].tolist(),
        coefficient=values.tolist(),
        error=[] if error is None else error.tolist(),
    )


def _laws() -> Sequence[str]:
    from lambda_core.discovery.api import registry

    return list(registry().models("traction"))


def _model(oil: str, temperature: float, law: str, parameters: Mapping[str, Any]) -> BearingModel:
    """Return a bearing with this oil and law.

    The traction law needs this context.
    """
    from lambda_core.case.case_io import bearing_case
    from lambda_core.discovery.api import registry
    from lambda_core.model.checking import resolve

    own = {name: value for name, value in parameters.items() if name in _fields(registry().model("traction", law))}
    tables: dict[str, Any] = {
        "name": "traction",
        "bearing": {"designation": _BEARING},
        "operation": {"speed": "1000 rpm"},
        "loads": {"radial": "1 kN"},
        "lubricant": {"name": oil, "temperature": f"{temperature!r} K"},
        "models": {"traction": law},
    }
    if own:
        tables["parameters"] = {"traction": own}
    return resolve(bearing_case(tables), is_static=True)


def _fields(law: Any) -> Mapping[str, Any]:
    fields: Mapping[str, Any] = law.parameters.model_fields
    return fields


@dataclass(frozen=True)
class _Contact:
    """Ball on a disc with compiled laws.

    They are the laws of one oil.

    Attributes
    ----------
    load, radius : float
        Load [N] and radius of the contact [m].
    pressure, weights : float64[:]
        Of rings of equal pressure [Pa]; shares of the area.
    """

    load: float
    radius: float
    speed: float
    pressure: FloatArray
    weights: FloatArray
    law: Callable[..., FloatArray]
    oil: Any
    modulus: float

    @staticmethod
    def of(model: BearingModel, pressure: float, speed: float, announce: Callable[[str], None] | None) -> _Contact:
        """Return the contact of a pressure.

        It has the laws of a model.
        """
        from lambda_core.model.laws.law_context import ContactFrame, build_context, effective_modulus, prepare
        from lambda_core.solver.drivers.compiled_laws import Kernels, check_laws, derive_oils

        modulus = effective_modulus(model.ball_material, model.inner_material)
        load = load_at_pressure(pressure, 0.5 * BALL, 0.5 * BALL, modulus)
        frame, kernels = ContactFrame((0.0, 0.0), (load, load)), Kernels(model, announce)
        oils = derive_oils(model, kernels, frame)
        check_laws(model, kernels, frame, oils)
        context = dataclasses.replace(
            build_context(model, _ELEMENT, frame, oils[0]), ball_diameter=BALL, radius_x=0.5 * BALL, radius_y=0.5 * BALL
        )
        pars = {role: prepare(law, context) for role, law in model.laws[_ELEMENT].items()}

        def call(role: str, *values: Any, outputs: int = 1, cells: int = _RESULTS) -> FloatArray:
            found = np.full((outputs, cells), math.nan)
            # A batch of one contact: what differs from contact to contact stands in an array.
            arguments = [
                np.array([value]) if argument.each else value
                for argument, value in zip(ROLES[role].arguments, values, strict=False)
            ]
            status = kernels.compiled[_ELEMENT, role].dispatcher(*arguments, pars[role], *found)
            if status != 1:
                law = model.laws[_ELEMENT][role].model
                raise SolverError(f"{law.label} refuses: {law.errors.get(status, f'status {status}')}")
            return found

        # Over the unit circle the mean of f is the integral of f over the square of the radius.
        squares, shares = np.polynomial.legendre.leggauss(_RINGS)
        squares = 0.5 * (squares + 1.0)
        radius = hertz_contact(load, 0.5 * BALL, 0.5 * BALL, modulus).semi_a
        return _Contact(load, radius, speed, pressure * np.sqrt(1.0 - squares), 0.5 * shares, call, oils[0], modulus)

    def film(self, slide: float) -> float:
        """Return the central film with inlet heating [m]."""
        r, oil = 0.5 * BALL, self.oil
        thickness = self.law(
            "film_thickness", self.speed, 1.0, self.load, r, r, self.modulus, oil.viscosity, oil.alpha_p
        )[0, 0]
        heat = self.law(
            "thermal_correction", self.speed, slide, float(self.pressure.max()), self.modulus, oil.viscosity, oil.beta,
            oil.thermal_conductivity,
        )[0, 0]  # fmt: skip
        return float(thickness * heat)

    def coefficient(self, slide: float) -> float:
        """Return the traction coefficient at a sliding speed [m/s].

        Temperature and shear stress of each ring are found together: the temperature is halved in between where the
        stress at it would heat the film less, as the heating falls with the temperature.
        """
        if slide == 0.0:
            return 0.0
        film, inlet, cells = self.film(slide), self.oil.temperature, self.pressure.size
        slip = np.full(cells, slide)
        low = np.full(cells, inlet)
        high = self._heated(self._stress(low, slip, film), slip, film)
        for _ in range(_ROUNDS):
            middle = 0.5 * (low + high)
            hotter = self._heated(self._stress(middle, slip, film), slip, film) > middle
            low, high = np.where(hotter, middle, low), np.where(hotter, high, middle)
            if float(np.max(high - low)) < _CLOSED:
                break
        stress = self._stress(0.5 * (low + high), slip, film)
        return float(math.pi * self.radius**2 * (self.weights @ stress) / self.load)

    def _stress(self, temperature: FloatArray, slip: FloatArray, film: float) -> FloatArray:
        cells = slip.size
        logs = self.law("rheology", self.pressure, temperature, outputs=2, cells=cells)[0]
        found: FloatArray = self.law(
            "traction", slip, self.pressure, temperature, logs, np.full(cells, film), cells=cells
        )[0]
        return found

    def _heated(self, stress: FloatArray, slip: FloatArray, film: float) -> FloatArray:
        inlet = self.oil.temperature
        found: FloatArray = self.law(
            "contact_temperature", inlet, self.speed, film, self.radius, stress, slip, cells=slip.size
        )[0]
        return found

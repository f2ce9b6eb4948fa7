"""Tabulate properties of an oil over temperature and pressure."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from pydantic import BaseModel, ValidationError

from lambda_core.catalogue.protocol import LubricantRow
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import CatalogueError, Problem, unknown_name
from lambda_core.elements.roller.roller_friction import OilState
from lambda_core.formulas.oil import alpha_reciprocal, alpha_secant, alpha_tangent
from lambda_core.laws.context import Oil
from lambda_core.laws.law import Law
from lambda_core.laws.par import flat_kernel, make_par
from lambda_core.laws.probe import trial_context
from lambda_core.model.laws.oil_data import oil_data

if TYPE_CHECKING:
    from lambda_core.discovery.api import Registry

_ZERO_CELSIUS = 273.15
_GIGA = 1e9


class OilPoint(BaseModel):
    """State of the oil at one point.

    Temperature and pressure are in the units of the names.
    """

    temperature_degC: float
    pressure_GPa: float
    viscosity_mPas: float
    kinematic_viscosity_mm2s: float
    density_kgm3: float
    permittivity: float | None = None


class OilCoefficients(BaseModel):
    """Coefficients of an oil at one temperature.

    It holds pressure coefficients by their definitions, and the temperature coefficient.
    """

    temperature_degC: float
    alpha_tangent_per_GPa: float  # d ln(eta)/dp at p = 0
    alpha_secant_per_GPa: float  # ln(eta/eta_0)/p at 0.2 GPa, Gold's definition
    alpha_reciprocal_per_GPa: float  # 1 / int eta_0/eta dp, Blok's reciprocal asymptotic coefficient
    beta_per_K: float  # -d ln(eta)/dT at p = 0


class OilTable(BaseModel):
    """An oil's behaviour with the laws it was computed by."""

    lubricant: str
    rheology: str
    reference: str
    validity: str
    permittivity_law: str | None = None
    points: list[OilPoint]
    coefficients: list[OilCoefficients]


class OilLaw:
    """Rheology law with one lubricant's parameters.

    It returns ln(eta) and rho at any pressure and temperature.
    """

    def __init__(self, row: LubricantRow, models: Registry, name: str | None = None) -> None:
        known = row.parameters.get("rheology", {})
        self.name = name or row.rheology
        if self.name not in (*known, row.rheology):
            raise CatalogueError(row.name, [Problem("rheology", unknown_name("law with data", self.name, known))])
        self.model = models.model("rheology", self.name)
        self._par = _prepared(self.model, row, "rheology")
        self._kernel = flat_kernel(self.model)

    def state(self, pressure: float, temperature: float) -> tuple[float, float]:
        """Return ln(eta / Pa s) and rho [kg/m3].

        The arguments are a pressure [Pa] and a temperature [K].
        """
        ln_eta, rho = self._states(np.array([pressure]), temperature)
        return float(ln_eta[0]), float(rho[0])

    def _states(self, pressures: FloatArray, temperature: float) -> tuple[FloatArray, FloatArray]:
        """Return ln(eta) and rho over pressures."""
        ln_eta, rho = np.full(pressures.size, np.nan), np.full(pressures.size, np.nan)
        status = self._kernel(pressures, np.full(pressures.size, temperature), self._par, ln_eta, rho)
        if status != 1 or not (np.isfinite(ln_eta).all() and np.isfinite(rho).all()):
            sentence = self.model.errors.get(status, "no finite viscosity and density")
            where = f"{pressures.max() / _GIGA:g} GPa, {temperature - _ZERO_CELSIUS:g} degC"
            raise CatalogueError(self.model.label, [Problem(where, sentence)])
        return ln_eta, rho

    def density(self, pressures: FloatArray, temperature: float) -> FloatArray:
        """Return rho [kg/m3] over pressures [Pa] at a temperature [K]."""
        return self._states(pressures, temperature)[1]

    def log_viscosity(self, temperature: float) -> Callable[[float], float]:
        """Return ln(eta) over pressure [Pa] at a temperature [K]."""
        return lambda pressure: self.state(pressure, temperature)[0]


def _prepared(law: Law, row: LubricantRow, role: str) -> FloatArray:
    known = oil_data(law, row, row.parameters.get(role, {}).get(law.name, {}))
    texts = {name: parameter.text() for name, parameter in known.items()}
    try:
        parameters = law.parameters.model_validate(texts)
    except ValidationError as error:
        problems = [Problem(".".join(map(str, e["loc"])), e["msg"]) for e in error.errors()]
        raise CatalogueError(f"{row.name}, {role} {law.name}", problems) from error
    value = {name: v.value for name, v in row.properties.items()}
    oil = Oil(
        row.name,
        row.base_type,
        40.0 + _ZERO_CELSIUS,
        value.get("thermal_conductivity", math.nan),
        value.get("specific_heat", math.nan),
    )
    return make_par(law, parameters, replace(trial_context("ball_inner"), oil=oil))


def oil_table(
    row: LubricantRow,
    models: Registry,
    temperatures: Sequence[float],
    pressures: Sequence[float] = (0.0,),
    rheology: str | None = None,
) -> OilTable:
    """Evaluate an oil over temperatures [K] and pressures [Pa].

    Parameters
    ----------
    row : LubricantRow
        From the catalogue.
    models : Registry
        Installed laws.
    rheology : str, optional
        A law that the oil has data for; the oil's preferred one by default.

    Raises
    ------
    CatalogueError
        When the oil has no data for the law, or the law gives no finite number at a state.
    """
    law = OilLaw(row, models, rheology)
    permittivity = _permittivity(row, models)
    points, coefficients = [], []
    for temperature in temperatures:
        for pressure in pressures:
            ln_eta, rho = law.state(pressure, temperature)
            points.append(
                OilPoint(
                    temperature_degC=_celsius(temperature),
                    pressure_GPa=pressure / _GIGA,
                    viscosity_mPas=math.exp(ln_eta) * 1e3,
                    kinematic_viscosity_mm2s=math.exp(ln_eta) / rho * 1e6,
                    density_kgm3=rho,
                    permittivity=permittivity[1](pressure, temperature, rho) if permittivity else None,
                )
            )
        coefficients.append(coefficients_of(law, temperature))
    return OilTable(
        lubricant=row.name,
        rheology=law.name,
        reference=law.model.reference,
        validity=law.model.validity,
        permittivity_law=permittivity[0] if permittivity else None,
        points=points,
        coefficients=coefficients,
    )


def _celsius(temperature: float) -> float:
    return round(temperature - _ZERO_CELSIUS, 9)


def coefficients_of(law: OilLaw, temperature: float) -> OilCoefficients:
    """Return an oil law's coefficients at a temperature [K]."""
    log_viscosity, step = law.log_viscosity(temperature), 0.01
    warmer, colder = (law.state(0.0, temperature + sign * step)[0] for sign in (1.0, -1.0))
    return OilCoefficients(
        temperature_degC=_celsius(temperature),
        alpha_tangent_per_GPa=alpha_tangent(log_viscosity) * _GIGA,
        alpha_secant_per_GPa=alpha_secant(log_viscosity) * _GIGA,
        alpha_reciprocal_per_GPa=alpha_reciprocal(log_viscosity) * _GIGA,
        beta_per_K=(colder - warmer) / (2.0 * step),
    )


def _permittivity(row: LubricantRow, models: Registry) -> tuple[str, Callable[[float, float, float], float]] | None:
    """Return the oil's first permittivity law with data.

    It is a function of pressure, temperature and density.
    """
    known = row.parameters.get("permittivity", {})
    name = next((name for name in ("bode", *known) if name in known), None)
    if name is None:
        return None
    law = models.model("permittivity", name)
    par = _prepared(law, row, "permittivity")

    def value(pressure: float, temperature: float, rho: float) -> float:
        eps = np.full(1, np.nan)
        flat_kernel(law)(np.array([pressure]), np.array([temperature]), np.array([rho]), par, eps)
        return float(eps[0])

    return name, value


def oil_state(law: OilLaw, temperature: float, conductivity: float) -> OilState:
    """Return the oil at a temperature [K] and ambient pressure."""
    point, density = law.state(0.0, temperature)
    found = coefficients_of(law, temperature)
    return OilState(
        viscosity=math.exp(point),
        density=density,
        pressure_viscosity=1e-9 * found.alpha_tangent_per_GPa,
        temperature_slope=found.beta_per_K,
        conductivity=conductivity,
    )

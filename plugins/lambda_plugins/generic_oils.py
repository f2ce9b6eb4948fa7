"""Define oils by two kinematic viscosities.

The oils follow Walther over temperature, and Roelands or Barus over pressure.

Per cell the laws need ln(eta_0) at the cell's temperature. Walther's double exponential is therefore fitted once, by a
polynomial in 1/T (error below 1e-5 in ln eta), and so are the powers of pressure and viscosity that go with it.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple, Self

import numpy as np
from pydantic import model_validator

from lambda_core.plugins import OK, Context, FloatArray, Parameters, Quantity, law, parameter
from lambda_plugins.rheology import capped, dowson_higginson
from lambda_plugins.shapes import at_least, at_most, polynomial, series, smooth_min

_T_LOW = 233.15  # [K]
_T_HIGH = 573.15  # [K]
_T_40 = 313.15
_T_100 = 373.15
_ROELANDS_P = 1.0 / 5.1e-9  # [Pa]
_ROELANDS_LOG = 9.67  # -ln(6.31e-5 Pa s)
_P_HIGH = 6e9  # [Pa]
_ROOT_HIGH = math.sqrt(1.0 + _P_HIGH / _ROELANDS_P)


class TwoPointOil(Parameters):
    """An oil by its viscosity at 40 and 100 degC."""

    kinematic_viscosity_40: Annotated[float, Quantity("kinematic_viscosity")] = parameter(
        ..., "kinematic viscosity at 40 degC", status="lubricant", gt=0.0
    )
    kinematic_viscosity_100: Annotated[float, Quantity("kinematic_viscosity")] = parameter(
        ..., "kinematic viscosity at 100 degC", status="lubricant", gt=0.0
    )
    density_15: Annotated[float, Quantity("density")] = parameter(
        ..., "density at 15 degC and ambient pressure", status="lubricant", gt=0.0
    )
    density_slope: float = parameter(
        ..., "change of density with temperature [kg/(m3 K)]", status="lubricant", le=0.0, ge=-2.0
    )
    alpha_p: Annotated[float, Quantity("pressure_viscosity")] = parameter(
        ..., "pressure-viscosity coefficient at 40 degC", status="lubricant", gt=0.0
    )

    @model_validator(mode="after")
    def _thins(self) -> Self:
        thin, thick = self.kinematic_viscosity_100, self.kinematic_viscosity_40
        if not 0.4e-6 < thin < thick:
            raise ValueError(
                f"kinematic_viscosity_100 ({1e6 * thin:g} mm2/s) must be above 0.4 mm2/s and below "
                f"kinematic_viscosity_40 ({1e6 * thick:g} mm2/s)"
            )
        return self


class RoelandsOil(TwoPointOil):
    """Parameters of Roelands' law."""

    alpha_span: Annotated[float, Quantity("pressure")] = parameter(
        "200 MPa",
        "pressure up to which alpha_p is the mean slope of ln(eta); 0 if it is the slope at ambient pressure",
        source="Gold et al. 2001 give alpha_p as the secant from 0 to 200 MPa, and so do the generic oils",
        published_range=("0 MPa", "200 MPa"),
        ge=0.0,
        le=1e9,
    )


class BarusOil(TwoPointOil):
    """Parameters of the limited Barus law."""

    gold_exponent: float = parameter(
        0.139,
        "t in alpha_p ~ nu^t, which carries alpha_p to other temperatures",
        source="Gold, Schmidt, Dicke, Loos and Assmann 2001, J. Synth. Lubr. 18, 51: 0.139 mineral, 0.1335 PAO, 0.136 "
        "ester, 0.1485 polyglycol",
        published_range=(0.1335, 0.1485),
        ge=0.0,
        le=0.5,
    )
    exponent_limit: float = parameter(
        20.0,
        "largest alpha_p p: Barus' law holds to about 0.5 GPa and grows without bound above",
        status="numerical",
        gt=1.0,
        le=40.0,
    )


def kinematic_viscosity(oil: TwoPointOil, T: FloatArray) -> FloatArray:
    """Return nu(T) [m2/s] after Walther.

    It follows log log (nu + 0.7 mm2/s) = A - B log T, which is ASTM D341 in its simple form.
    """

    def double_log(nu: float) -> float:
        return math.log10(math.log10(1e6 * nu + 0.7))

    at_40, at_100 = double_log(oil.kinematic_viscosity_40), double_log(oil.kinematic_viscosity_100)
    B = (at_40 - at_100) / math.log10(_T_100 / _T_40)
    return np.asarray(1e-6 * (10.0 ** (10.0 ** (at_40 - B * np.log10(T / _T_40))) - 0.7), dtype=np.float64)


def _density(oil: TwoPointOil, T: FloatArray) -> FloatArray:
    return oil.density_15 + oil.density_slope * (T - 288.15)


def _log_viscosity_series(oil: TwoPointOil) -> FloatArray:
    """Return the series of ln(eta_0 / Pa s) over 1/T."""

    def log_viscosity(inverse: FloatArray) -> FloatArray:
        T = 1.0 / inverse
        return np.asarray(np.log(kinematic_viscosity(oil, T) * _density(oil, T)), dtype=np.float64)

    return series(log_viscosity, 1.0 / _T_HIGH, 1.0 / _T_LOW)


def scaled_inverse(T: float) -> float:
    """Return 1/T mapped to -1..1.

    It covers 300 to -40 degC and is constant outside.
    """
    held = at_most(at_least(T, _T_LOW), _T_HIGH)
    return (2.0 / held - 1.0 / _T_HIGH - 1.0 / _T_LOW) / (1.0 / _T_LOW - 1.0 / _T_HIGH)


def oil_density(p: float, T: float, density_15: float, slope: float) -> float:
    """Return the density of an oil [kg/m3].

    It is linear in temperature (limited to -40..300 degC) and follows Dowson and Higginson under pressure.
    """
    held = at_most(at_least(T, _T_LOW), _T_HIGH)
    return (density_15 + slope * (held - 288.15)) * dowson_higginson(p)


def roelands_exponent(oil: RoelandsOil) -> float:
    """Return the exponent Z after Roelands.

    ln(eta) rises by alpha_p times the span at 40 degC; without a span Z follows from the slope at zero.
    """
    distance = math.log(oil.kinematic_viscosity_40 * float(_density(oil, np.array(_T_40)))) + _ROELANDS_LOG
    if distance <= 0.0:
        raise ValueError("the oil is thinner than 0.063 mPa s at 40 degC: Roelands' law does not hold")
    if oil.alpha_span < 1e3:
        return oil.alpha_p * _ROELANDS_P / distance
    rise = oil.alpha_p * oil.alpha_span / distance
    return math.log1p(rise) / math.log1p(oil.alpha_span / _ROELANDS_P)


class RoelandsSeries(NamedTuple):
    """Roelands' law as polynomials."""

    density_15: float  # [kg/m3]
    density_slope: float  # [kg/(m3 K)]
    ambient: FloatArray  # ln(eta_0 / Pa s) over 1/T
    stiffening: FloatArray  # (1 + p/p_0)^Z - 1 over sqrt(1 + p/p_0)


def prepare_roelands(parameters: RoelandsOil, context: Context) -> RoelandsSeries:
    """Return the series of one oil."""
    Z = roelands_exponent(parameters)
    if not 0.0 < Z < 1.5:
        raise ValueError(
            f"alpha_p = {1e9 * parameters.alpha_p:.3g} 1/GPa gives Roelands' Z = {Z:.3g}; oils have 0.2..1.2"
        )
    pressure = series(lambda root: np.asarray(root ** (2.0 * Z) - 1.0, dtype=np.float64), 1.0, _ROOT_HIGH)
    return RoelandsSeries(parameters.density_15, parameters.density_slope, _log_viscosity_series(parameters), pressure)


@law(
    "rheology",
    "roelands",
    RoelandsOil,
    role_api=3,
    reference="Roelands 1966 (thesis, Delft); ASTM D341; density: Dowson and Higginson 1966",
    validity="-40..300 degC, to about 1 GPa; stiffer than measured oils above; ln(eta) capped at 1e12 Pa s",
    prepare=prepare_roelands,
)
def roelands(p: FloatArray, T: FloatArray, par: RoelandsSeries, ln_eta: FloatArray, rho: FloatArray) -> int:
    """Viscosity after Roelands and Walther.

    Roelands' law holds over pressure and Walther's over temperature.

    ln eta = ln eta_0 + (ln eta_0 + 9.67) [(1 + 5.1e-9 p)^Z - 1], Z from alpha_p at 40 degC and constant: Roelands
    1966 (thesis, Delft); Hamrock, Schmid and Jacobson 2004, Fundamentals of Fluid Film Lubrication, section 4.6.
    alpha_p then falls with temperature like ln eta_0 + 9.67. eta_0 by ASTM D341. ln(eta) is capped at 1e12 Pa s;
    outside -40..300 degC and above 6 GPa the nearest bound holds.
    """
    for i in range(ln_eta.size):
        pressure = at_least(p[i], 0.0)
        root = at_most(math.sqrt(1.0 + pressure / _ROELANDS_P), _ROOT_HIGH)
        ambient = polynomial(scaled_inverse(T[i]), par.ambient)
        stiffening = polynomial(2.0 * (root - 1.0) / (_ROOT_HIGH - 1.0) - 1.0, par.stiffening)
        distance = ambient + _ROELANDS_LOG
        ln_eta[i] = capped(ambient + at_least(distance, 0.0) * stiffening)
        rho[i] = oil_density(pressure, T[i], par.density_15, par.density_slope)
    return OK


class BarusSeries(NamedTuple):
    """The limited Barus law as polynomials."""

    density_15: float  # [kg/m3]
    density_slope: float  # [kg/(m3 K)]
    exponent_limit: float
    ambient: FloatArray  # ln(eta_0 / Pa s) over 1/T
    alpha: FloatArray  # alpha_p [1/Pa] over 1/T


def prepare_barus(parameters: BarusOil, context: Context) -> BarusSeries:
    """Return the series of one oil."""

    def alpha(inverse: FloatArray) -> FloatArray:
        nu = kinematic_viscosity(parameters, 1.0 / inverse)
        ratio = (nu / parameters.kinematic_viscosity_40) ** parameters.gold_exponent
        return np.asarray(parameters.alpha_p * ratio, dtype=np.float64)

    return BarusSeries(
        parameters.density_15,
        parameters.density_slope,
        parameters.exponent_limit,
        _log_viscosity_series(parameters),
        series(alpha, 1.0 / _T_HIGH, 1.0 / _T_LOW),
    )


@law(
    "rheology",
    "barus-limited",
    BarusOil,
    role_api=3,
    reference="Barus 1893, Am. J. Sci. 45, 87; Gold et al. 2001, J. Synth. Lubr. 18, 51; ASTM D341",
    validity="-40..300 degC, to about 0.5 GPa; the exponent is limited above",
    prepare=prepare_barus,
)
def barus_limited(p: FloatArray, T: FloatArray, par: BarusSeries, ln_eta: FloatArray, rho: FloatArray) -> int:
    """Viscosity after Barus and Walther.

    Barus' law with a limited exponent holds over pressure, and Walther's over temperature.

    ln eta = ln eta_0 + min(alpha_p p, limit), corner rounded over a unit; Barus 1893, Am. J. Sci. 45, 87. alpha_p goes
    with nu^t over temperature: Gold et al. 2001, J. Synth. Lubr. 18, 51. eta_0 by ASTM D341. ln(eta) is capped at 1e12
    Pa s; outside -40..300 degC the nearest bound holds.
    """
    for i in range(ln_eta.size):
        pressure = at_least(p[i], 0.0)
        x = scaled_inverse(T[i])
        exponent = smooth_min(polynomial(x, par.alpha) * pressure, par.exponent_limit, 0.5)
        ln_eta[i] = capped(polynomial(x, par.ambient) + exponent)
        rho[i] = oil_density(pressure, T[i], par.density_15, par.density_slope)
    return OK

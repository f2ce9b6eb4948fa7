"""Define Bode's density, viscosity and permittivity of an oil.

T is in K and p in bar, as published (Bode 1989; constants of a mineral oil in Syla et al. 2026, Table 5).
"""

from __future__ import annotations

import math
from typing import Annotated, Any, NamedTuple

import numpy as np
from pydantic import Field

from lambda_core.plugins import OK, Context, FloatArray, Parameters, exp, law, log1p, parameter
from lambda_plugins.rheology import capped
from lambda_plugins.shapes import at_least, at_most

_T_LOW = 223.15  # [K]
_T_HIGH = 573.15  # [K]; N(T) of the published oil turns negative near 660 K
_SOURCE = "constants of the oil; a mineral oil in Syla et al. 2026, Lubricants 14, 154, Table 5"


def _constant(description: str, **limits: Any) -> Any:
    return parameter(..., description, source=_SOURCE, status="lubricant", **limits)


class BodeDensity(Parameters):
    """Constants of Bode's density."""

    rho_s: float = _constant("density extrapolated to 0 K [kg/m3]", gt=0.0)
    alpha_s: float = _constant("its relative decrease with temperature [1/K]", ge=0.0)
    a1: float = _constant("a1 [-]", gt=0.0)
    a2: float = _constant("a2 [bar]")
    a3: float = _constant("a3 [bar/K]")
    a4: float = _constant("a4 [bar/K2]")
    a5: float = _constant("a5 [bar/K3]")


class BodeViscosity(BodeDensity):
    """Constants of Bode's density and of the matching viscosity."""

    visc_a1: float = _constant("A1 [mPa s]", gt=0.0)
    visc_a2: float = _constant("A2 [-]", gt=0.0)
    visc_a3: float = _constant("A3 [kg/m3]", gt=0.0)
    visc_a4: float = _constant("A4 [1/K]")


class BodePermittivity(BodeDensity):
    """Constants of Bode's density and permittivity."""

    k1: float = _constant("k1")
    k2: float = _constant("k2 [1/K]")
    k3: float = _constant("k3 [m3/kg]")


def within_range(temperature: float) -> float:
    """Limit the temperature to 223..573 K.

    The polynomial N(T) is positive there.
    """
    return at_most(at_least(temperature, _T_LOW), _T_HIGH)


def pressure_scale(T: float, oil: BodeDensity) -> float:
    """Return the pressure scale N(T) [bar].

    It is N(T) = a2 + a3 T + a4 T^2 + a5 T^3; a1/N is the compressibility at ambient pressure.
    """
    return oil.a2 + T * (oil.a3 + T * (oil.a4 + T * oil.a5))


def bode_density(p: float, T: float, oil: BodeDensity) -> float:
    """Return Bode's density [kg/m3].

    It is rho_s (1 - alpha_s T)/(1 - a1 ln(1 + p/N)), with p in Pa and T in K within range.
    """
    bar = 1e-5 * at_least(p, 0.0)
    compression = 1.0 - oil.a1 * log1p(bar / pressure_scale(T, oil))
    return oil.rho_s * (1.0 - oil.alpha_s * T) / at_least(compression, 0.1)


class Glass(NamedTuple):
    """Density and viscosity of an oil by its glass transition.

    The viscosity follows from the distance to the glass.
    """

    oil: BodeDensity
    ln_A1: float  # ln(A1 / Pa s)
    A2: float
    A3: float  # [kg/m3]
    A4: float  # [1/K]


def prepare_viscosity(parameters: BodeViscosity, context: Context) -> Glass:
    """Return the constants, A1 by its logarithm."""
    _check(parameters)
    v = parameters
    return Glass(v, math.log(1e-3 * v.visc_a1), v.visc_a2, v.visc_a3, v.visc_a4)


def prepare_permittivity(parameters: BodePermittivity, context: Context) -> BodePermittivity:
    """Return the constants."""
    _check(parameters)
    return parameters


def _check(oil: BodeDensity) -> None:
    T = np.linspace(_T_LOW, _T_HIGH, 71)
    if np.any(pressure_scale(T, oil) <= 0.0) or oil.alpha_s * _T_HIGH >= 1.0:  # type: ignore[arg-type]
        raise ValueError("the constants a2..a5 and alpha_s give no positive density between -50 and 300 degC")


@law(
    "rheology",
    "bode",
    BodeViscosity,
    role_api=3,
    reference="Bode 1989; constants in Syla et al. 2026, Lubricants 14, 154, Table 5; form of the viscosity inferred",
    validity="-50..300 degC; ln(eta) capped at 1e12 Pa s near the pole at the glass density",
    prepare=prepare_viscosity,
)
def bode_rheology(p: FloatArray, T: FloatArray, par: Glass, ln_eta: FloatArray, rho: FloatArray) -> int:
    """Density and viscosity after Bode.

    The viscosity follows from the distance of the density to the glass.

    eta = A1 exp[A2/(rho_g/rho - 1)], rho_g = A3 (1 + A4 T), a form inferred from the constants (it gives 97.3 and 8.81
    mPa s at 40 and 100 degC for the published oil). It has a pole at rho = rho_g (2.35 GPa at 40 degC): ln(eta) is
    capped at 1e12 Pa s. Temperatures outside -50..300 degC act like the nearest bound.
    """
    for i in range(ln_eta.size):
        temperature = within_range(T[i])
        density = bode_density(p[i], temperature, par.oil)
        distance = par.A3 * (1.0 + par.A4 * temperature) / density - 1.0
        # A2/60 keeps the exponent finite at and beyond the pole, far above the cap.
        nearest = par.A2 / 60.0
        ln_eta[i] = capped(par.ln_A1 + par.A2 / at_least(distance, nearest))
        rho[i] = density
    return OK


@law(
    "permittivity",
    "bode",
    BodePermittivity,
    role_api=3,
    reference="Bode's equation: Syla et al. 2026, Lubricants 14, 154, eq. 35-37",
    validity="-50..300 degC",
    prepare=prepare_permittivity,
)
def bode_permittivity(p: FloatArray, T: FloatArray, rho: FloatArray, par: BodePermittivity, eps_r: FloatArray) -> int:
    """Relative permittivity after Bode.

    eps_r = k1 beta^-1/2 rho_T^1/6 + k2 T + k3 (rho - rho_T), beta = a1/N the compressibility in 1/bar: Syla et al.
    2026, eq. 35-37. The density is Bode's own, with which the constants were fitted, so that the law does not change
    together with the rheology model.
    """
    for i in range(eps_r.size):
        temperature = within_range(T[i])
        density_T = par.rho_s * (1.0 - par.alpha_s * temperature)
        stiffness = math.sqrt(pressure_scale(temperature, par) / par.a1)
        ambient = par.k1 * stiffness * exp(log1p(density_T - 1.0) / 6.0) + par.k2 * temperature
        eps_r[i] = ambient + par.k3 * (bode_density(p[i], temperature, par) - density_T)
    return OK


class Constant(Parameters):
    """Parameter of a constant permittivity."""

    eps_r: Annotated[float, Field(gt=0.999)] = parameter(
        2.2,
        "relative permittivity",
        source="2.1-2.3 mineral oil and PAO, about 3.2 ester, 4-10 polyglycol (class values)",
        status="unconfirmed",
        published_range=(2.1, 10.0),
    )


@law(
    "permittivity",
    "constant",
    Constant,
    role_api=3,
    reference="-",
    summary="Permittivity that depends on neither pressure nor temperature.",
    validity="non-polar oils within a few percent",
)
def constant(p: FloatArray, T: FloatArray, rho: FloatArray, par: Constant, eps_r: FloatArray) -> int:
    """Permittivity that depends on nothing."""
    for i in range(eps_r.size):
        eps_r[i] = par.eps_r
    return OK

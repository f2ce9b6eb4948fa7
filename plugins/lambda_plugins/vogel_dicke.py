"""Define oils by Vogel's law with Dicke's pressure term."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from lambda_core.plugins import OK, Context, FloatArray, Parameters, Quantity, law, parameter
from lambda_plugins.rheology import DOWSON_RISE, DOWSON_STIFFNESS, capped
from lambda_plugins.shapes import at_least, at_most

_T_LOW = 233.15  # [K]
_T_HIGH = 573.15  # [K]
_SOURCE = "the oil's measurement; FVA3: Wingertszahn et al. 2023, Lubricants 11, 369, Table A1"


class VogelDicke(Parameters):
    """Parameters of Vogel and Dicke in source units."""

    vogel_k: float = parameter(..., "Vogel K [mPa s]", source=_SOURCE, status="lubricant", gt=0.0)
    vogel_b: float = parameter(..., "Vogel B [degC]", source=_SOURCE, status="lubricant", gt=0.0)
    vogel_c: float = parameter(..., "Vogel C [degC]", source=_SOURCE, status="lubricant", gt=40.0)
    dicke_a1: float = parameter(..., "Dicke a1 [bar]", source=_SOURCE, status="lubricant", gt=0.0)
    dicke_a2: float = parameter(..., "Dicke a2 [bar/degC]", source=_SOURCE, status="lubricant")
    dicke_b1: float = parameter(..., "Dicke b1 [-]", source=_SOURCE, status="lubricant")
    dicke_b2: float = parameter(..., "Dicke b2 [1/degC]", source=_SOURCE, status="lubricant")
    density_15: Annotated[float, Quantity("density")] = parameter(
        ..., "density at 15 degC and ambient pressure", source=_SOURCE, status="lubricant", gt=0.0
    )
    density_slope: float = parameter(
        ..., "change of density with temperature [kg/(m3 K)]", source=_SOURCE, status="lubricant", le=0.0
    )


class Constants(NamedTuple):
    """The constants as the formula wants them."""

    ln_K: float  # ln(K / Pa s)
    B: float  # [K]
    C: float  # Vogel's C less 273.15, for temperatures in K
    a1: float  # [bar]
    a2: float  # [bar/K]
    b1: float
    b2: float  # [1/K]
    density_15: float  # [kg/m3]
    density_slope: float  # [kg/(m3 K)]


def prepare(parameters: VogelDicke, context: Context) -> Constants:
    """Return the constants of one oil."""
    v = parameters
    return Constants(
        math.log(v.vogel_k * 1e-3),
        v.vogel_b,
        v.vogel_c - 273.15,
        v.dicke_a1,
        v.dicke_a2,
        v.dicke_b1,
        v.dicke_b2,
        v.density_15,
        v.density_slope,
    )


@law(
    "rheology",
    "vogel-dicke",
    VogelDicke,
    role_api=3,
    reference="Vogel 1921; Dicke's pressure term as in Wingertszahn et al. 2023, Lubricants 11, 369, Table A1; "
    "density: Dowson and Higginson 1966",
    validity="-40..300 degC; ln(eta) capped at 1e12 Pa s (glass transition)",
    prepare=prepare,
)
def vogel_dicke(p: FloatArray, T: FloatArray, par: Constants, ln_eta: FloatArray, rho: FloatArray) -> int:
    """Viscosity after Vogel and Dicke.

    The density is linear in temperature, with Dowson-Higginson compression.

    eta = K exp[B/(C + t)] exp{p/[a1 + a2 t + (b1 + b2 t) p]}, t in degC, p in bar: Wingertszahn et al. 2023, Lubricants
    11, 369, Table A1. ln(eta) is capped at 1e12 Pa s; temperatures outside -40..300 degC act like the nearest bound.
    """
    for i in range(ln_eta.size):
        temperature = at_most(at_least(T[i], _T_LOW), _T_HIGH)
        pressure = at_least(p[i], 0.0)
        t = temperature - 273.15
        bar = 1e-5 * pressure
        stiffening = at_least(par.a1 + par.a2 * t + (par.b1 + par.b2 * t) * bar, 1.0)
        # B/(C + t) + p/stiffening and the density by one division: a loop over cells waits for them most.
        thinning, compression = temperature + par.C, 1.0 + DOWSON_STIFFNESS * pressure
        both = thinning * stiffening
        inverse = 1.0 / (both * compression)
        ln_eta[i] = capped(par.ln_K + (par.B * stiffening + bar * thinning) * (inverse * compression))
        density = par.density_15 + par.density_slope * (t - 15.0)
        rho[i] = density * (1.0 + DOWSON_RISE * pressure * (inverse * both))
    return OK

"""Mixed lubrication: share of the load on asperities and their coefficient of friction."""

from __future__ import annotations

import math
from typing import Annotated, Self

from pydantic import model_validator

from lambda_core.plugins import NoParameters, Quantity, model
from lambda_plugins.fields import FloatArray, Parameters, parameter
from lambda_plugins.shapes import at_least, cubic_friction

_SISTER = "Wingertszahn et al. 2023, Lubricants 11, 369"


class ZhouHoeprich(Parameters):
    """Constants of the exponential load share."""

    B: float = parameter(
        2.32,
        "B in psi = exp(-B Lambda^C)",
        source=f"raceways of {_SISTER} (sigma 0.16 um: 2.32; 0.10 um: 2.1)",
        published_range=(2.1, 2.32),
        gt=0.0,
    )
    C: float = parameter(
        0.97,
        "C in psi = exp(-B Lambda^C)",
        source=f"raceways of {_SISTER} (sigma 0.16 um: 0.97; 0.10 um: 0.85)",
        published_range=(0.85, 0.97),
        gt=0.0,
    )


def zhou_hoeprich(Lambda: float, par: FloatArray, out: FloatArray) -> int:
    """Share of the load on asperities, psi = exp(-B Lambda^C), after Zhou and Hoeprich.

    Zhou and Hoeprich 1991, J. Tribol. 113, 590; constants as in the tapered roller model of Wingertszahn et al. 2023.
    """
    out[0] = math.exp(-par[0] * at_least(Lambda, 0.0) ** par[1])
    return 1


def none(Lambda: float, par: FloatArray, out: FloatArray) -> int:
    """Full film: no load on asperities."""
    out[0] = 0.0
    return 1


class CubicFriction(Parameters):
    """Constants of Teutsch's cubic friction law."""

    mu_s: float = parameter(0.12, "largest coefficient, at v_s", source="assumption", status="assumed", ge=0.0, le=1.0)
    mu_d: float = parameter(
        0.09, "coefficient in full sliding, from v_d", source="assumption", status="assumed", ge=0.0, le=1.0
    )
    v_s: Annotated[float, Quantity("velocity")] = parameter(
        "0.01 m/s", "slip at the largest coefficient", source="assumption", status="assumed", gt=0.0
    )
    v_d: Annotated[float, Quantity("velocity")] = parameter(
        "0.1 m/s", "slip from which the coefficient is constant", source="assumption", status="assumed", gt=0.0
    )

    @model_validator(mode="after")
    def _ordered(self) -> Self:
        if self.v_d <= self.v_s:
            raise ValueError(f"v_d ({self.v_d:g} m/s) must be above v_s ({self.v_s:g} m/s)")
        return self


def cubic(slip: FloatArray, p: FloatArray, par: FloatArray, mu: FloatArray) -> int:
    """Boundary friction that rises from 0 at rest to mu_s at v_s and falls to mu_d at v_d, after Teutsch.

    Teutsch 2005; Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21 with its missing factor.
    """
    per_v_s = 1.0 / par[2]
    per_fall = 1.0 / (par[3] - par[2])
    for i in range(mu.size):
        mu[i] = cubic_friction(slip[i], par[0], par[1], per_v_s, per_fall)
    return 1


class Coulomb(Parameters):
    """Constants of regularised Coulomb friction."""

    mu: float = parameter(0.1, "coefficient of friction", source="assumption", status="assumed", ge=0.0, le=1.0)
    v_0: Annotated[float, Quantity("velocity")] = parameter(
        "0.01 m/s", "slip at which 71 % of it is reached", status="numerical", gt=0.0
    )


def coulomb_regularised(slip: FloatArray, p: FloatArray, par: FloatArray, mu: FloatArray) -> int:
    """Coulomb friction, regularised: mu v/sqrt(v^2 + v_0^2)."""
    for i in range(mu.size):
        mu[i] = par[0] * slip[i] / math.sqrt(slip[i] * slip[i] + par[1] * par[1])
    return 1


ZHOU_HOEPRICH = model(
    "asperity_load",
    "zhou-hoeprich",
    zhou_hoeprich,
    ZhouHoeprich,
    reference="Zhou and Hoeprich 1991, J. Tribol. 113, 590; constants: Wingertszahn et al. 2023, Lubricants 11, 369",
    validity="constants belong to the roughness that they were fitted with",
)

NO_ASPERITIES = model("asperity_load", "none", none, NoParameters, reference="-")

CUBIC = model(
    "boundary_friction",
    "cubic",
    cubic,
    CubicFriction,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21",
    validity="constants are assumptions until measured for the oil and surfaces",
)

COULOMB_REGULARISED = model(
    "boundary_friction",
    "coulomb-regularised",
    coulomb_regularised,
    Coulomb,
    reference="Coulomb's law with a smooth start",
    validity="constant coefficient beyond a few v_0",
)

"""Define asperity load and boundary friction."""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple, Self

from pydantic import model_validator

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, Quantity, law, parameter, power
from lambda_plugins.shapes import at_least, at_most, cubic_friction

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


@law(
    "asperity_load",
    "zhou-hoeprich",
    ZhouHoeprich,
    role_api=3,
    reference="Zhou and Hoeprich 1991, J. Tribol. 113, 590; constants: Wingertszahn et al. 2023, Lubricants 11, 369",
    validity="constants belong to the roughness that they were fitted with",
)
def zhou_hoeprich(Lambda: float, par: ZhouHoeprich, out: FloatArray) -> int:
    """Load share of asperities after Zhou and Hoeprich.

    psi = exp(-B Lambda^C).

    Zhou and Hoeprich 1991, J. Tribol. 113, 590; constants as in the tapered roller model of Wingertszahn et al. 2023.
    """
    out[0] = math.exp(-par.B * at_least(Lambda, 0.0) ** par.C)
    return OK


class SpikesOlver(Parameters):
    """Constant of the friction transition measured on rough discs."""

    exponent: float = parameter(
        2.0, "m in psi = (1 + Lambda)^-m", source="Spikes and Olver 2003: about 2", ge=0.5, le=4.0
    )


@law(
    "asperity_load",
    "spikes-olver",
    SpikesOlver,
    role_api=3,
    reference="Spikes and Olver 2003, Lubr. Sci. 16(1), 3",
    validity="friction of rough point contacts over the whole transition; Lambda of the smooth surfaces",
)
def spikes_olver(Lambda: float, par: SpikesOlver, out: FloatArray) -> int:
    """Share of boundary friction after Spikes and Olver.

    In mixed lubrication it is psi = (1 + Lambda)^-m.

    From friction measured in rough rolling and sliding contacts, mu = mu_film + (mu_bl - mu_film)/(1 + Lambda)^m,
    Lambda the smooth film over the composite rms roughness: Spikes and Olver 2003, Lubr. Sci. 16(1), 3.
    """
    share = 1.0 / (1.0 + at_least(Lambda, 0.0))
    out[0] = share * share if par.exponent == 2.0 else power(share, par.exponent)
    return OK


@law("asperity_load", "none", role_api=3, reference="-")
def none(Lambda: float, par: NoParameters, out: FloatArray) -> int:
    """Full film without load on asperities."""
    out[0] = 0.0
    return OK


class MicroSlip(Parameters):
    """Constants of Coulomb friction with the micro-slip of rolling contacts."""

    mu: float = parameter(
        0.12,
        "coefficient of friction in gross sliding",
        source="mu_bl of a running bearing: SKF, Rolling bearings (2018), Friction; 0.15 at the start",
        published_range=(0.1, 0.15),
        ge=0.0,
        le=1.0,
    )
    v_rest: Annotated[float, Quantity("velocity")] = parameter(
        "0.01 mm/s", "slip of full friction in a contact that does not roll", status="numerical", gt=0.0
    )


class Creep(NamedTuple):
    """Coefficient and limit of gross sliding."""

    mu: float
    per_pressure: float  # creep of gross sliding over the pressure [1/Pa]
    v_rest: float


def prepare_micro_slip(parameters: MicroSlip, context: Context) -> Creep:
    """Return the creep at which nothing sticks, per pressure."""
    per_pressure = 16.0 * parameters.mu / (math.pi * context.e_eff) if context.e_eff > 0.0 else 0.0
    return Creep(parameters.mu, per_pressure, parameters.v_rest)


@law(
    "boundary_friction",
    "micro-slip",
    MicroSlip,
    role_api=3,
    reference="Carter 1926, Proc. R. Soc. A 112, 151; Johnson, Contact Mechanics (1985), section 8.3",
    validity="steady rolling; elastic bodies of equal material; no memory of the contact before a reversal",
    prepare=prepare_micro_slip,
)
def micro_slip(slip: FloatArray, p: FloatArray, u_mean: float, par: Creep, mu: FloatArray) -> int:
    """Coulomb friction of a rolling contact with elastic creep.

    Gross sliding begins at the creep that fills the contact.

    Surfaces that roll against each other stick at the inlet and slip at the outlet; the shear force is
    mu (2 z - z^2) of the load, z = xi/xi_c, with the creep xi = v/u and mu from xi_c = 4 mu p_0/E' on, where the stuck
    zone is gone: Carter 1926, Proc. R. Soc. A 112, 151; Johnson, Contact Mechanics (1985), section 8.3 (there xi_c =
    mu b/R and b/R = 4 p_0/E'), for equal materials in plane strain, strip by strip; p_0 = (4/pi) p of a strip's mean
    pressure. So the slip that friction needs follows the rolling speed and nothing is smoothed away at low speed: with
    mu = 0.12 and 1.5 GPa xi_c is 0.4 %, where slip in conforming grooves is some percent. Slip across rolling is
    treated alike (its creep is 1/(1 - nu) times larger). Full friction takes `v_rest` more, for contacts at rest.
    """
    per_pressure = u_mean * par.per_pressure
    for i in range(mu.size):
        z = at_most(slip[i] / (per_pressure * at_least(p[i], 0.0) + par.v_rest), 1.0)
        mu[i] = par.mu * z * (2.0 - z)
    return OK


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


@law(
    "boundary_friction",
    "cubic",
    CubicFriction,
    role_api=3,
    reference="Teutsch 2005 (thesis, TU Kaiserslautern); Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21",
    validity="constants are assumptions until measured for the oil and surfaces",
)
def cubic(slip: FloatArray, p: FloatArray, u_mean: float, par: CubicFriction, mu: FloatArray) -> int:
    """Boundary friction by a cubic law, after Teutsch.

    It rises from 0 at rest to mu_s at v_s and falls to mu_d at v_d.

    Teutsch 2005; Wingertszahn et al. 2023, Lubricants 11, 369, eq. 21 with its missing factor.
    """
    per_v_s = 1.0 / par.v_s
    per_fall = 1.0 / (par.v_d - par.v_s)
    for i in range(mu.size):
        mu[i] = cubic_friction(slip[i], par.mu_s, par.mu_d, per_v_s, per_fall)
    return OK


class Coulomb(Parameters):
    """Constants of regularised Coulomb friction."""

    mu: float = parameter(0.1, "coefficient of friction", source="assumption", status="assumed", ge=0.0, le=1.0)
    v_0: Annotated[float, Quantity("velocity")] = parameter(
        "0.01 m/s", "slip at which 71 % of it is reached", status="numerical", gt=0.0
    )


@law(
    "boundary_friction",
    "coulomb-regularised",
    Coulomb,
    role_api=3,
    reference="Coulomb's law with a smooth start",
    validity="constant coefficient beyond a few v_0",
)
def coulomb_regularised(slip: FloatArray, p: FloatArray, u_mean: float, par: Coulomb, mu: FloatArray) -> int:
    """Coulomb friction, regularised: mu v/sqrt(v^2 + v_0^2)."""
    for i in range(mu.size):
        mu[i] = par.mu * slip[i] / math.sqrt(slip[i] * slip[i] + par.v_0 * par.v_0)
    return OK

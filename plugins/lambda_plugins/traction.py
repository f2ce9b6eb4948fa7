"""Compute the shear stress of films from their rate."""

from __future__ import annotations

from typing import Annotated

from lambda_core.plugins import OK, FloatArray, Parameters, Quantity, asinh_of, asinh_quotient, exp, law, parameter
from lambda_plugins.shapes import at_least, at_most, corner, smooth_min, smooth_min_by

# ln(eta) is held between them: far outside any liquid, with room to spare for exp()
_LOG_ETA_MIN = -60.0
_LOG_ETA_MAX = 60.0


class LimitedShear(Parameters):
    """Limit of the shear stress.

    Every fluid law needs it, since no liquid carries any shear stress.
    """

    limit_ratio: float = parameter(
        0.065,
        "limiting shear stress over pressure, zeta",
        source="0.05-0.08 mineral oils, 0.03-0.05 PAO and ester (common values, original not seen)",
        status="unconfirmed",
        published_range=(0.03, 0.08),
        gt=0.0,
        le=0.3,
    )


class ReeEyring(LimitedShear):
    """Parameters of Ree-Eyring traction."""

    tau_eyring: Annotated[float, Quantity("pressure")] = parameter(
        "8 MPa",
        "Eyring stress, from which the film departs from Newtonian flow",
        source="upper end of 4-8 MPa for bearing oils (common values, original not seen): nearest to SKF's mu_EHL of "
        "0.05 in mineral oils, of which it makes 0.037",
        status="unconfirmed",
        published_range=("4 MPa", "8 MPa"),
        gt=0.0,
    )


@law(
    "traction",
    "ree-eyring",
    ReeEyring,
    role_api=3,
    reference="Johnson and Tevaarwerk 1977, Proc. R. Soc. A 356, 215; Syla et al. 2026, Lubricants 14, 154, eq. 20-21",
    validity="viscous shear of the film; tau_e and zeta are class values of oils, not measured for this one",
)
def ree_eyring(
    slip: FloatArray, p: FloatArray, T: FloatArray, ln_eta: FloatArray, h: FloatArray, par: ReeEyring, tau: FloatArray
) -> int:
    """Shear stress of an Eyring fluid.

    It is limited to a share of the pressure.

    tau = tau_e asinh(eta gamma_dot/tau_e), gamma_dot = v/h_cen (Johnson and Tevaarwerk 1977, Proc. R. Soc. A 356, 215;
    Syla et al. 2026, eq. 20-21), tau <= zeta p with the corner rounded over the last tenth. Viscous part only: no shear
    compliance of film or bodies.
    """
    # In two loops: from ln(eta) to the stress is a longer chain than a processor looks ahead, a third slower in one.
    for i in range(tau.size):
        viscosity = exp(at_most(at_least(ln_eta[i], _LOG_ETA_MIN), _LOG_ETA_MAX))
        tau[i] = viscosity * slip[i] / (at_least(h[i], 1e-10) * par.tau_eyring)
    for i in range(tau.size):
        y = tau[i]
        limit = at_least(par.limit_ratio * p[i], 0.0)
        width = 0.1 * limit
        # asinh and the rounded corner by one division: a loop over cells waits for them most
        above, below, k = asinh_quotient(y)
        bend = corner(width)
        inverse = 1.0 / (below * bend)
        stress = par.tau_eyring * asinh_of(above * (inverse * bend), k, y)
        tau[i] = smooth_min_by(inverse * below, stress, limit, width)
    return OK


class BairWiner(LimitedShear):
    """Parameters of Bair-Winer traction."""


@law(
    "traction",
    "bair-winer",
    BairWiner,
    role_api=3,
    reference="Bair and Winer 1979, J. Lubr. Technol. 101, 258; Wingertszahn et al. 2023, Lubricants 11, 369, eq. 6",
    validity="viscous shear of the film; limiting stress proportional to pressure",
)
def bair_winer(
    slip: FloatArray, p: FloatArray, T: FloatArray, ln_eta: FloatArray, h: FloatArray, par: BairWiner, tau: FloatArray
) -> int:
    """Shear stress after Bair and Winer.

    It approaches its limit exponentially.

    gamma_dot = -(tau_L/eta) ln(1 - tau/tau_L), tau_L = zeta p: Bair and Winer 1979, J. Lubr. Technol. 101, 258;
    Wingertszahn et al. 2023, Lubricants 11, 369, eq. 6 with its sign corrected. Viscous part only.
    """
    for i in range(tau.size):
        film = at_least(h[i], 1e-10)
        log_eta = at_most(at_least(ln_eta[i], _LOG_ETA_MIN), _LOG_ETA_MAX)
        limit = at_least(par.limit_ratio * p[i], 1e-3)
        share = exp(log_eta) * slip[i] / (film * limit)
        tau[i] = limit * (share * (1.0 - 0.5 * share) if share < 1e-5 else 1.0 - exp(-at_most(share, 700.0)))
    return OK


class Newtonian(LimitedShear):
    """Parameters of Newtonian traction."""


@law(
    "traction",
    "newtonian",
    Newtonian,
    role_api=3,
    reference="Newton's law of viscosity; limiting stress after Johnson and Tevaarwerk 1977",
    validity="small shear stress, or as the upper bound of fluid friction",
)
def newtonian(
    slip: FloatArray, p: FloatArray, T: FloatArray, ln_eta: FloatArray, h: FloatArray, par: Newtonian, tau: FloatArray
) -> int:
    """Shear stress of a Newtonian fluid.

    tau = eta v/h_cen, limited to a share of the pressure.

    Without the limit the stress of a film at bearing pressures would exceed the strength of steel.
    """
    for i in range(tau.size):
        film = at_least(h[i], 1e-10)
        log_eta = at_most(at_least(ln_eta[i], _LOG_ETA_MIN), _LOG_ETA_MAX)
        limit = at_least(par.limit_ratio * p[i], 0.0)
        tau[i] = smooth_min(exp(log_eta) * slip[i] / film, limit, 0.1 * limit)
    return OK

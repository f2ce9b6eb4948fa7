"""Compute the thinning of films by inlet shear heating."""

from __future__ import annotations

from lambda_core.plugins import OK, FloatArray, NoParameters, Parameters, law, parameter, power
from lambda_plugins.shapes import at_least, at_most

_LEAST = 1e-290  # of what a power is taken of


@law(
    "thermal_correction",
    "murch-wilson",
    role_api=3,
    reference="Murch and Wilson 1975, J. Lubr. Technol. 97, 212",
    validity="pure rolling",
)
def murch_wilson(
    u_mean: float,
    u_slide: float,
    p_max: float,
    E_eff: float,
    eta0: float,
    beta: float,
    k_oil: float,
    par: NoParameters,
    out: FloatArray,
) -> int:
    """Thermal film factor for pure rolling, after Murch and Wilson.

    Phi_T = 3.94/(3.94 + L^0.62), L = eta0 beta u_m^2/lambda, u_m the mean velocity, beta = -(1/eta) d eta/dT.
    Murch and Wilson 1975, J. Lubr. Technol. 97, 212; Syla et al. 2026, eq. 23-24.
    """
    L = at_least(eta0 * beta * u_mean * u_mean / k_oil, _LEAST)
    out[0] = 3.94 / (3.94 + power(L, 0.62))
    return OK


class ZhuCheng(Parameters):
    """Parameters of the Zhu-Cheng factor."""

    smallest: float = parameter(
        0.05,
        "smallest factor: the numerator of the fit turns negative far outside its range",
        status="numerical",
        gt=0.0,
        lt=1.0,
    )


@law(
    "thermal_correction",
    "zhu-cheng",
    ZhuCheng,
    role_api=3,
    reference="Gupta, Cheng, Zhu, Forster and Schrand 1992, Tribol. Trans. 35, 269",
    validity="slide-to-roll ratio 0..2; the fit's numerator limits the product of pressure and thermal parameter",
)
def zhu_cheng(
    u_mean: float,
    u_slide: float,
    p_max: float,
    E_eff: float,
    eta0: float,
    beta: float,
    k_oil: float,
    par: ZhuCheng,
    out: FloatArray,
) -> int:
    """Thermal film factor after Zhu and Cheng.

    The factor depends on pressure and slide-to-roll ratio.

    Phi_T = [1 - 13.2 (p_0/E') L^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L^0.64], L = eta0 beta u_m^2/lambda, S = slide over
    mean velocity. Gupta, Cheng, Zhu, Forster and Schrand 1992, Tribol. Trans. 35, 269; Wingertszahn et al. 2023,
    Lubricants 11, 369, eq. 12. S is held at 2, pure sliding of one surface, beyond which there is no fit.
    """
    L = at_least(eta0 * beta * u_mean * u_mean / k_oil, 0.0)
    S = at_most(abs(u_slide) / (u_mean + 1e-9), 2.0)
    factor = (1.0 - 13.2 * (p_max / E_eff) * L**0.42) / (1.0 + 0.213 * (1.0 + 2.23 * S**0.83) * L**0.64)
    out[0] = at_least(factor, par.smallest)
    return OK


@law("thermal_correction", "none", role_api=3, reference="-")
def none(
    u_mean: float,
    u_slide: float,
    p_max: float,
    E_eff: float,
    eta0: float,
    beta: float,
    k_oil: float,
    par: NoParameters,
    out: FloatArray,
) -> int:
    """Isothermal inlet with factor 1."""
    out[0] = 1.0
    return OK

"""Whole capacitance of a contact, surroundings included, from that of its Hertzian area."""

from __future__ import annotations

from lambda_core.plugins import NoParameters, model
from lambda_plugins.fields import FloatArray, Parameters, parameter


def schneider(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: FloatArray,
    out: FloatArray,
) -> int:
    """Correction factor after Schneider et al., C = k_c C_Hertz.

    k_c = 9.5923 U^0.3305 G^0.3431 W^-0.3342 k_e^0.1391 with Hamrock and Dowson's U, G, W (R_x, mean velocity) and
    k_e = a/b: Schneider, Liu, Bader, Furtmann and Poll 2021, Tribol. Int. 154, 106714; Syla et al. 2026, eq. 34. Held
    at 1 and above: the surroundings cannot take capacitance away (slow or heavily loaded contacts outside the fit).
    """
    if C_hertz <= 0.0 or W <= 0.0 or semi_b <= 0.0:
        out[0] = C_hertz
        return 1
    factor = 9.5923 * U**0.3305 * G**0.3431 * W**-0.3342 * (semi_a / semi_b) ** 0.1391
    out[0] = C_hertz * (factor if factor > 1.0 else 1.0)
    return 1


class ConstantFactor(Parameters):
    """Parameter of the constant factor."""

    k_c: float = parameter(
        3.5,
        "whole capacitance over that of the Hertzian area",
        source="Barz 1996 and later (common value, original not seen)",
        status="unconfirmed",
        published_range=(1.5, 5.0),
        ge=1.0,
    )


def constant_factor(
    C_hertz: float,
    h: float,
    semi_a: float,
    semi_b: float,
    R_x: float,
    R_y: float,
    U: float,
    G: float,
    W: float,
    eps_r0: float,
    par: FloatArray,
    out: FloatArray,
) -> int:
    """Constant correction factor, C = k_c C_Hertz.

    Barz 1996 (thesis, Hannover), as cited by Syla et al. 2026, section 3.
    """
    out[0] = par[0] * C_hertz
    return 1


SCHNEIDER = model(
    "capacitance",
    "schneider",
    schneider,
    NoParameters,
    reference="Schneider et al. 2021, Tribol. Int. 154, 106714; Syla et al. 2026, Lubricants 14, 154, eq. 34",
    validity="radial deep groove ball bearings, fully flooded",
)

CONSTANT_FACTOR = model(
    "capacitance",
    "constant-factor",
    constant_factor,
    ConstantFactor,
    reference="Barz 1996 (thesis, Hannover)",
    validity="order of magnitude; the true factor falls with load and rises with film thickness",
)

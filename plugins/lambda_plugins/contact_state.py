"""Declare the default of contacts without states."""

from __future__ import annotations

from lambda_core.plugins import OK, FloatArray, NoParameters, law


@law("contact_state", "none", role_api=3, reference="-")
def none(
    t: float,
    load: float,
    semi_a: float,
    semi_b: float,
    p_max: float,
    u_mean: float,
    u_slide: float,
    spin: float,
    h: float,
    Lambda: float,
    psi: float,
    power: float,
    T_film: float,
    T_in: float,
    par: NoParameters,
    out: FloatArray,
) -> int:
    """No state."""
    return OK

"""Provide functions shared by laws of viscosity and density.

These are the cap on ln(eta) and density under pressure.
"""

from __future__ import annotations

from lambda_plugins.shapes import at_least, smooth_min

# Glass transition by convention: 1e12 Pa s. No law of viscosity is meant for more, and ln(eta) stays bounded.
LN_ETA_CAP = 27.631021115928547
_CAP_WIDTH = 1.0
LN_ETA_FLOOR = -18.0
DOWSON_RISE, DOWSON_STIFFNESS = 0.6e-9, 1.7e-9  # of :func:`dowson_higginson` [1/Pa]


def capped(ln_eta: float) -> float:
    """Return ln(eta / Pa s) within limits.

    They are below 1e12 Pa s (corner rounded over a factor e each way) and above 1.5e-8 Pa s.
    """
    return at_least(smooth_min(ln_eta, LN_ETA_CAP, _CAP_WIDTH), LN_ETA_FLOOR)


def dowson_higginson(p: float) -> float:
    """Return rho(p)/rho(0) of a mineral oil, p in Pa.

    It is 1 + 0.6e-9 p/(1 + 1.7e-9 p), 1.35 at most (Dowson and Higginson 1966, Elasto-hydrodynamic Lubrication).
    """
    return 1.0 + DOWSON_RISE * p / (1.0 + DOWSON_STIFFNESS * p)

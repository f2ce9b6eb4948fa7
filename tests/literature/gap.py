"""Compute the capacitance around a Hertzian contact by quadrature."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_legendre

from lambda_core.formulas.hertz import HertzContact


def gap(x: NDArray[np.float64], y: NDArray[np.float64], contact: HertzContact, e_eff: float) -> NDArray[np.float64]:
    """Return the gap outside the contact [m].

    Distance of the deformed surfaces without a film.

    -(p0 a b/E') integral of (1 - x^2/(b^2 + s) - y^2/(a^2 + s))/sqrt((a^2 + s)(b^2 + s) s) over s from 0 to the
    confocal ellipse through the point: Johnson, Contact Mechanics (1985), section 3.5, with E* = E'/2.
    """
    a2, b2 = contact.semi_a**2, contact.semi_b**2
    p, q = a2 + b2 - x * x - y * y, a2 * b2 - x * x * a2 - y * y * b2
    upper = 0.5 * (-p + np.sqrt(p * p - 4.0 * q))
    nodes, weights = roots_legendre(200)
    # s = t^2 takes the root out; t = sinh spreads the points over the decades between b and the far field
    far = np.arcsinh(np.sqrt(np.maximum(upper, 0.0)) / contact.semi_b)
    w = 0.5 * far * (nodes[:, None] + 1.0)
    t = contact.semi_b * np.sinh(w)
    inner = (1.0 - x * x / (b2 + t * t) - y * y / (a2 + t * t)) / np.sqrt((a2 + t * t) * (b2 + t * t))
    integral = np.sum(0.5 * far * weights[:, None] * inner * 2.0 * contact.semi_b * np.cosh(w), axis=0)
    return np.asarray(-contact.p_max * contact.semi_a * contact.semi_b / e_eff * integral)


def surroundings(contact: HertzContact, e_eff: float, film: float, outer: float) -> float:
    """Return the integral of dA/(film + gap) [m].

    From the contact's edge to the confocal ellipse of major semi-axis `outer`.
    """
    major = max(contact.semi_a, contact.semi_b)
    reach = math.asinh(math.sqrt(outer**2 - major**2) / contact.semi_b)
    w_nodes, w_weights = roots_legendre(120)
    phi_nodes, phi_weights = roots_legendre(60)
    phi = 0.25 * math.pi * (phi_nodes + 1.0)
    total = 0.0
    for node, weight in zip(w_nodes, w_weights, strict=True):
        t = contact.semi_b * math.sinh(0.5 * reach * (node + 1.0))
        A, B = math.hypot(contact.semi_a, t), math.hypot(contact.semi_b, t)
        x, y = B * np.sin(phi), A * np.cos(phi)
        area = t / A * ((A * np.sin(phi)) ** 2 + (B * np.cos(phi)) ** 2)
        ring = np.sum(math.pi * phi_weights * area / (film + gap(x, y, contact, e_eff)))
        total += 0.5 * reach * weight * float(ring)
    return total

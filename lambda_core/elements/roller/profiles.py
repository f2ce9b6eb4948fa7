"""Define profiles of rollers and raceways.

A profile is the drop below cylinder or cone over the coordinate along the contact.

``x`` is the distance from the middle along the contact line [m], an array or a float; every drop is in m, zero or more
and even in x. A profile is any function of x; :func:`total` adds them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray

Profile = Callable[[FloatArray], FloatArray]
Name = Literal["iso", "none", "logarithmic", "crowned", "two-radii", "tabulated"]

# ISO 16281:2025, B.5 and B.6: drop scale over the roller diameter.
_SHORT, _LONG, _TAPERED = 0.00035, 0.0005, 0.00045
_SLENDER = 2.5  # length over diameter up to which a cylindrical roller counts as short


def logarithmic(
    x: FloatArray | float,
    length: float,
    scale: float,
    *,
    flat: float = 0.0,
    exponent: float = 2.0,
    edge_drop: float = math.inf,
) -> FloatArray:
    """Return the drop of a logarithmic profile [m].

    P = A ln(1/(1 - (1 - e^(-P_e/A)) t)), t = ((2|x| - l_f)/(L - l_f))^k, zero on the flat. Lundberg 1939 is l_f = 0,
    k = 2, P_e infinite; Fujiwara and Kawase 2006, NTN Technical Review 75, 140, add the flat and the finite drop P_e at
    the edge; Teutsch 2005 adds the exponent.

    Parameters
    ----------
    x : array or float
        Distance from the middle [m].
    length : float
        Effective length L [m]; without `edge_drop` the drop is infinite at its ends.
    scale : float
        A [m]. An even pressure under the load Q needs A = 2 Q/(pi L E') (Fujiwara and Kawase, eq. 2).
    flat : float
        Length l_f of the cylindrical middle [m].
    exponent : float
        k [-].
    edge_drop : float
        P_e [m].

    Raises
    ------
    ValueError
        Outside the length, or where the flat leaves no crown.
    """
    if not 0.0 <= flat < length:
        raise ValueError(f"`flat` must be zero or more and below `length`, got {flat:g} of {length:g} m")
    reach = 2.0 * np.abs(x)
    if np.any(reach > length * (1.0 + 1e-12)):
        raise ValueError(f"`x` must lie within half of `length` {length:g} m, got {np.max(reach) / 2.0:g} m")
    share = np.clip((reach - flat) / (length - flat), 0.0, 1.0) ** exponent
    limit = -math.expm1(-edge_drop / scale)
    with np.errstate(divide="ignore"):
        found: FloatArray = -scale * np.log1p(-limit * share)
    return found


def iso_cylindrical(x: FloatArray | float, length: float, diameter: float) -> FloatArray:
    """Return the drop of a cylindrical roller [m].

    The profile is that of ISO 16281:2025, B.5.

    0.00035 D_we ln(1/(1 - (2x/L_we)^2)) up to L_we = 2.5 D_we; longer rollers have 0.0005 D_we and a flat of
    L_we - 2.5 D_we. The two forms do not join at 2.5 D_we: the standard's own step, 0.35 to 0.50.
    """
    if length <= _SLENDER * diameter:
        return logarithmic(x, length, _SHORT * diameter)
    return logarithmic(x, length, _LONG * diameter, flat=length - _SLENDER * diameter)


def iso_tapered(x: FloatArray | float, length: float, diameter: float, half_angle: float) -> FloatArray:
    """Return the drop of a tapered roller [m].

    The profile is that of ISO 16281:2025, B.6.

    0.00045 (D_we/cos(beta)) ln(1/(1 - (2x/L_we)^2)), x along the contact line. The factor was read in a secondary
    source only.

    Parameters
    ----------
    x : array or float
        Distance from the middle of the contact line [m].
    length, diameter : float
        L_we and the mean diameter D_we [m].
    half_angle : float
        Half of the roller's cone angle beta [rad].
    """
    return logarithmic(x, length, _TAPERED * diameter / math.cos(half_angle))


def crowned(x: FloatArray | float, radius: float) -> FloatArray:
    """Return the drop of a circular crown [m].

    It is R - sqrt(R^2 - x^2), without cancellation.
    """
    x = np.asarray(x)
    found: FloatArray = x**2 / (radius + np.sqrt(radius**2 - x**2))
    return found


def two_radii(x: FloatArray | float, middle_length: float, middle_radius: float, end_radius: float) -> FloatArray:
    """Return the drop of three tangent arcs [m].

    A middle and two end arcs join without a kink.

    Parameters
    ----------
    x : array or float
        Distance from the middle [m].
    middle_length : float
        Length with `middle_radius` [m].
    middle_radius, end_radius : float
        Profile radii [m]; an infinite middle radius is a cylindrical middle.
    """
    join = 0.5 * middle_length
    slope = join / middle_radius  # sine of the angle where the arcs join
    across = np.minimum(np.abs(x), join)
    middle = across**2 / middle_radius / (1.0 + np.sqrt(1.0 - (across / middle_radius) ** 2))
    sine = slope + np.maximum(np.abs(x) - join, 0.0) / end_radius
    # difference of the cosines at the join and at x, as a product: no cancellation
    drop = (sine - slope) * (sine + slope) / (math.sqrt(1.0 - slope**2) + np.sqrt(1.0 - sine**2))
    found: FloatArray = middle + end_radius * drop
    return found


def tabulated(x: FloatArray | float, positions: Sequence[float], drops: Sequence[float]) -> FloatArray:
    """Return the drop [m] between measured points.

    The curve is monotone between neighbours (PCHIP, Fritsch and Carlson 1980).

    Raises
    ------
    ValueError
        Outside the table: profiles are not extrapolated.
    """
    if np.min(x) < positions[0] or np.max(x) > positions[-1]:
        raise ValueError(f"the table covers {positions[0]:g} to {positions[-1]:g} m: add points up to both ends")
    from scipy.interpolate import PchipInterpolator  # loaded where rollers are computed

    found: FloatArray = np.asarray(PchipInterpolator(positions, drops)(x), dtype=np.float64)
    return found


def total(x: FloatArray, *profiles: Profile) -> FloatArray:
    """Return the sum of all drops [m].

    They are those of roller and raceways; a roller's own profile counts once per contact.
    """
    found: FloatArray = np.zeros_like(x)
    for profile in profiles:
        found = found + profile(x)
    return found

"""Compute the permissible axial load of cylindrical roller bearings.

The rollers have ribs on both rings (NJ, NUP).

SKF, Rolling bearings, PUB BU/P1 17000/1 EN, 2018, p. 513 and table 6. SI in and out; the formulas are in mm, kN and
1/min, converted inside. They hold for 60 K between bearing and surroundings, 0.5 mW/mm2 of heat loss, kappa of 2 and
more, and misalignment up to 1 minute of arc.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Complement = Literal["cage", "full"]
_MM, _KN, _RPM = 1e3, 1e-3, 30.0 / math.pi
# k1 and k2 of single-row bearings (table 6): oil, grease.
_FACTORS = {
    ("cage", True): (1.5, 0.15),
    ("cage", False): (1.0, 0.1),
    ("full", True): (1.0, 0.3),
    ("full", False): (0.5, 0.15),
}
_LARGE_SURFACE = 50e-3  # [m2]
_RADIAL_SHARE = 0.5  # largest F_a/F_r of one row
_BRIEF, _PEAK = 2.0, 3.0


@dataclass(frozen=True)
class AxialLimit:
    """Permissible axial loads [N]."""

    thermal: float  # F_ap: heat of roller ends and ribs; zero where the radial load uses it up
    mechanical: float  # F_ap,max: strength of the ribs under constant load
    guidance: float  # half of the radial load: more would tip and skew the rollers
    brief: float  # about 1000 revolutions
    peak: float  # occasional peaks

    @property
    def continuous(self) -> float:
        """Smallest limit of a constant axial load [N].

        There are three limits.
        """
        return min(self.thermal, self.mechanical, self.guidance)


def axial_limit(
    radial_load: float,
    speed: float,
    *,
    bore: float,
    outside: float,
    width: float,
    static_rating: float,
    light_series: bool = False,
    complement: Complement = "cage",
    oil: bool = True,
) -> AxialLimit:
    """Return the permissible axial load of a single-row bearing.

    F_ap = k1 C_0 10^4/(n (d + D)) - k2 F_r up to a surface pi B (d + D) of 50 000 mm2, above with 7.5 C_0^(2/3) in
    place of C_0; F_ap,max = 0.0045 D^1.5 for the dimension series 2, else 0.0023 D^1.7; brief periods twice, peaks
    three times the smaller one.

    Parameters
    ----------
    radial_load : float
        F_r [N].
    speed : float
        Of one ring against the other [rad/s].
    bore, outside, width : float
        d, D and B [m].
    static_rating : float
        C_0 [N].
    light_series : bool
        Whether the bearing belongs to the dimension series 2 (NJ 2, NUP 2).
    complement : {"cage", "full"}
        Bearings with a cage, or full complement.
    oil : bool
        Oil, or grease.

    Raises
    ------
    ValueError
        At rest, where no heat limits the load and the formula has no value.
    """
    if speed == 0.0:
        raise ValueError("`speed` must not be zero: at rest compare the load with `mechanical` of any speed")
    gain, loss = _FACTORS[complement, oil]
    rating, surface = static_rating * _KN, math.pi * width * (bore + outside)
    capacity = rating if surface <= _LARGE_SURFACE else 7.5 * rating ** (2.0 / 3.0)
    turning = abs(speed) * _RPM * (bore + outside) * _MM
    thermal = max(gain * capacity * 1e4 / turning / _KN - loss * radial_load, 0.0)
    size = outside * _MM
    mechanical = (0.0045 * size**1.5 if light_series else 0.0023 * size**1.7) / _KN
    smaller = min(thermal, mechanical)
    return AxialLimit(thermal, mechanical, _RADIAL_SHARE * radial_load, _BRIEF * smaller, _PEAK * smaller)

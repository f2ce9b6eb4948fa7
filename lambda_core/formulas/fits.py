"""Compute the operating clearance step by step.

It is the unmounted clearance minus the effects of interference fits and temperatures.

Elastic thick rings (Lame); diametral quantities, SI. Dimensions hold at 20 degC (ISO 1) unless told otherwise.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, field

from lambda_core.formulas.tolerances import (
    Limits,
    bore_deviations,
    housing_deviations,
    outside_deviations,
    shaft_deviations,
)

REFERENCE_TEMPERATURE = 293.15  # [K]
# Asperities flattened on mounting: effective over apparent interference is d/(d + s), s [mm] by finish of the seat
# (NSK Rolling Bearings, "Fits and internal clearances").
SMOOTHING = {"none": 0.0, "ground": 2.0, "turned": 3.0}


@dataclass(frozen=True)
class Solid:
    """Elastic and thermal properties of a solid.

    The solid is a ring, shaft, housing or ball.
    """

    youngs_modulus: float = 210e9  # [Pa]
    poisson_ratio: float = 0.3
    thermal_expansion: float = 12e-6  # [1/K]


STEEL = Solid()


@dataclass(frozen=True)
class Rings:
    """Diameters [m] and materials of the rings."""

    bore_diameter: float
    outside_diameter: float
    race_diameter_inner: float
    race_diameter_outer: float
    ball_diameter: float
    rings: Solid = STEEL
    balls: Solid = STEEL

    def __post_init__(self) -> None:
        ordered = (0.0, self.bore_diameter, self.race_diameter_inner, self.race_diameter_outer, self.outside_diameter)
        if any(left >= right for left, right in itertools.pairwise(ordered)):
            raise ValueError("diameters must satisfy 0 < bore < inner race < outer race < outside diameter")


@dataclass(frozen=True)
class Seat:
    """Seat of a ring.

    It is the shaft under the inner ring or the housing around the outer ring.

    Attributes
    ----------
    interference : Limits
        Diametral, at the reference temperature, positive when tight [m]; negative for a loose fit.
    free_diameter : float
        Bore of a hollow shaft or outside diameter of the housing [m]; NaN is a solid shaft, or a housing without
        end. A rigid seat has a `solid` with an infinite modulus.
    finish : str
        Key of :data:`SMOOTHING`; "none" if `interference` is effective already.
    """

    interference: Limits
    solid: Solid = STEEL
    free_diameter: float = math.nan
    finish: str = "ground"


@dataclass(frozen=True)
class Temperatures:
    """Temperatures of the parts [K].

    They are means, with the one at which the dimensions hold.
    """

    inner_ring: float = REFERENCE_TEMPERATURE
    outer_ring: float = REFERENCE_TEMPERATURE
    balls: float = REFERENCE_TEMPERATURE
    shaft: float = REFERENCE_TEMPERATURE
    housing: float = REFERENCE_TEMPERATURE
    reference: float = REFERENCE_TEMPERATURE

    def rises(self) -> dict[str, float]:
        """Return the temperature rise of each part [K].

        It counts from the reference.
        """
        parts = ("inner_ring", "outer_ring", "balls", "shaft", "housing")
        return {part: getattr(self, part) - self.reference for part in parts}


@dataclass(frozen=True)
class Step:
    """One step of the clearance [m].

    It is an addition (or a value), given by its limits and its middle.
    """

    name: str
    limits: Limits
    explanation: str
    counts: bool = True  # an interference is shown for itself; what it does to the clearance is the step after it

    @property
    def value(self) -> float:
        """Middle of the limits [m]."""
        return self.limits.middle


@dataclass(frozen=True)
class OperatingClearance:
    """Radial internal clearance in operation and how it came about."""

    limits: Limits
    steps: tuple[Step, ...] = field(default=())

    @property
    def value(self) -> float:
        """Middle of the limits [m]; negative is preload."""
        return self.limits.middle


def shaft_interference(bore_diameter: float, tolerance_class: str) -> Limits:
    """Return the interference of a shaft class [m].

    The bearing bore is of ISO 492 normal class; positive is tight.
    """
    shaft, bore = shaft_deviations(bore_diameter, tolerance_class), bore_deviations(bore_diameter)
    return Limits(shaft.minimum - bore.maximum, shaft.maximum - bore.minimum)


def housing_interference(outside_diameter: float, tolerance_class: str) -> Limits:
    """Return the interference of a housing class [m].

    The bearing's outside is of ISO 492 normal class; positive is tight.
    """
    hole, ring = housing_deviations(outside_diameter, tolerance_class), outside_deviations(outside_diameter)
    return Limits(ring.minimum - hole.maximum, ring.maximum - hole.minimum)


def inner_ring_expansion(
    interference: float, bore: float, race: float, ring: Solid, shaft: Solid, hollow: float
) -> float:
    """Return the growth of the inner raceway [m].

    Its diameter grows under an effective interference [m]; the growth is zero for a loose fit.

    Pressure of two thick rings (Lame; Harris and Kotzalas, Rolling Bearing Analysis, 5th ed., vol. 2, ch. 3):
    p = (I/d) / {[(k^2 + 1)/(k^2 - 1) + nu]/E_ring + [(1 + q^2)/(1 - q^2) - nu_s]/E_shaft}, k = d_race/d,
    q = d_hollow/d; growth at the raceway 2 p d_race/[E_ring (k^2 - 1)].
    """
    if interference <= 0.0:
        return 0.0
    k, q = race / bore, hollow / bore
    if not 0.0 <= q < 1.0:
        raise ValueError(f"the hollow shaft's bore {hollow:g} m must lie between 0 and the bearing's bore {bore:g} m")
    ring_yield = ((k * k + 1.0) / (k * k - 1.0) + ring.poisson_ratio) / ring.youngs_modulus
    shaft_yield = ((1.0 + q * q) / (1.0 - q * q) - shaft.poisson_ratio) / shaft.youngs_modulus
    pressure = interference / bore / (ring_yield + shaft_yield)
    return 2.0 * pressure * race / (ring.youngs_modulus * (k * k - 1.0))


def outer_ring_contraction(
    interference: float, outside: float, race: float, ring: Solid, housing: Solid, housing_diameter: float
) -> float:
    """Return the shrinkage of the outer raceway [m].

    Its diameter shrinks under an effective interference [m]; the shrinkage is zero for a loose fit.

    Thick rings as in :func:`inner_ring_expansion`, h = d_race/D, q = D/D_housing:
    p = (I/D) / {[(1 + h^2)/(1 - h^2) - nu]/E_ring + [(1 + q^2)/(1 - q^2) + nu_h]/E_housing}; shrinkage at the
    raceway 2 p d_race/[E_ring (1 - h^2)].
    """
    if interference <= 0.0:
        return 0.0
    if housing_diameter <= outside:
        raise ValueError(
            f"the housing's outside diameter {housing_diameter:g} m must be above the bearing's {outside:g} m"
        )
    h, q = race / outside, outside / housing_diameter
    ring_yield = ((1.0 + h * h) / (1.0 - h * h) - ring.poisson_ratio) / ring.youngs_modulus
    housing_yield = ((1.0 + q * q) / (1.0 - q * q) + housing.poisson_ratio) / housing.youngs_modulus
    pressure = interference / outside / (ring_yield + housing_yield)
    return 2.0 * pressure * race / (ring.youngs_modulus * (1.0 - h * h))


def _effective(seat: Seat, diameter: float) -> Limits:
    """Return the interference after flattening of asperities.

    The seat keeps d/(d + s) of it, with d and s in mm.
    """
    if seat.finish not in SMOOTHING:
        raise ValueError(f'"{seat.finish}" is not a finish of a seat; known: {", ".join(SMOOTHING)}')
    factor = diameter * 1e3 / (diameter * 1e3 + SMOOTHING[seat.finish])
    return Limits(*(i * factor if i > 0.0 else i for i in (seat.interference.minimum, seat.interference.maximum)))


def _shifted(limits: Limits, shift: float) -> Limits:
    return Limits(limits.minimum + shift, limits.maximum + shift)


def operating_clearance(
    bearing: Rings,
    clearance: Limits,
    shaft: Seat | None = None,
    housing: Seat | None = None,
    temperatures: Temperatures | None = None,
) -> OperatingClearance:
    """Return the steps to the operating radial clearance.

    Parameters
    ----------
    bearing : Rings
        Diameters and materials of the bearing.
    clearance : Limits
        Radial internal clearance before mounting: a class's limits or twice the same value [m].
    shaft, housing : Seat or None
        Interference fits; None leaves the ring as it is.
    temperatures : Temperatures or None
        Parts' temperatures; None is 20 degC everywhere.

    Returns
    -------
    OperatingClearance
        Limits in the worst case (each step at its own limit), the middle as `value`, and the steps in order.

    Raises
    ------
    ValueError
        For impossible diameters or an unknown finish.
    """
    rise = (temperatures or Temperatures()).rises()
    steps = [Step("unmounted clearance", clearance, "class limits or given value")]
    if shaft is not None:
        steps += _shaft_steps(bearing, shaft, rise)
    if housing is not None:
        steps += _housing_steps(bearing, housing, rise)
    growth = bearing.rings.thermal_expansion * (
        rise["outer_ring"] * bearing.race_diameter_outer - rise["inner_ring"] * bearing.race_diameter_inner
    )
    steps.append(Step("ring temperatures", Limits(growth, growth), "outer raceway's thermal growth minus the inner's"))
    balls = -2.0 * bearing.balls.thermal_expansion * rise["balls"] * bearing.ball_diameter
    steps.append(Step("ball temperature", Limits(balls, balls), "two ball diameters grow"))
    counted = [step.limits for step in steps if step.counts]
    total = Limits(sum(step.minimum for step in counted), sum(step.maximum for step in counted))
    return OperatingClearance(total, (*steps, Step("operating clearance", total, "sum of the steps", counts=False)))


@dataclass(frozen=True)
class Mounting:
    """Data of the operating clearance.

    The temperatures of the parts are not among them.

    Attributes
    ----------
    bought : Limits
        Radial internal clearance before mounting [m].
    pick : str
        Which value of a tolerated clearance counts: minimum, middle, maximum.
    reference : float
        Temperature at which the dimensions hold [K].
    """

    rings: Rings
    bought: Limits
    shaft: Seat | None
    housing: Seat | None
    pick: str
    reference: float = REFERENCE_TEMPERATURE

    def clearance(self, inner_ring: float, outer_ring: float, balls: float, shaft: float, housing: float) -> float:
        """Return the radial internal clearance [m].

        It holds at temperatures of the parts [K].
        """
        warm = Temperatures(inner_ring, outer_ring, balls, shaft, housing, self.reference)
        limits = operating_clearance(self.rings, self.bought, self.shaft, self.housing, warm).limits
        return {"minimum": limits.minimum, "middle": limits.middle, "maximum": limits.maximum}[self.pick]


def _shaft_steps(bearing: Rings, seat: Seat, rise: dict[str, float]) -> list[Step]:
    bore, race = bearing.bore_diameter, bearing.race_diameter_inner
    thermal = bore * (
        seat.solid.thermal_expansion * rise["shaft"] - bearing.rings.thermal_expansion * rise["inner_ring"]
    )
    warm = _shifted(_effective(seat, bore), thermal)
    hollow = 0.0 if math.isnan(seat.free_diameter) else seat.free_diameter
    small, large = (
        inner_ring_expansion(i, bore, race, bearing.rings, seat.solid, hollow) for i in (warm.minimum, warm.maximum)
    )
    return [
        Step("interference on shaft", warm, f"{seat.finish} seat, at running temperatures", counts=False),
        Step("inner ring expansion", Limits(-large, -small), "elastic thick rings"),
    ]


def _housing_steps(bearing: Rings, seat: Seat, rise: dict[str, float]) -> list[Step]:
    outside, race = bearing.outside_diameter, bearing.race_diameter_outer
    thermal = outside * (
        bearing.rings.thermal_expansion * rise["outer_ring"] - seat.solid.thermal_expansion * rise["housing"]
    )
    warm = _shifted(_effective(seat, outside), thermal)
    block = math.inf if math.isnan(seat.free_diameter) else seat.free_diameter
    small, large = (
        outer_ring_contraction(i, outside, race, bearing.rings, seat.solid, block) for i in (warm.minimum, warm.maximum)
    )
    return [
        Step("interference in housing", warm, f"{seat.finish} seat, at running temperatures", counts=False),
        Step("outer ring contraction", Limits(-large, -small), "elastic thick rings"),
    ]

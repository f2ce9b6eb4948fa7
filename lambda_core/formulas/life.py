"""Compute rating lives and static safety of ball bearings.

They follow ISO 281, ISO/TS 16281 and ISO 76 for deep groove and angular contact.

SI in and out. Lives are in million revolutions unless a name says otherwise.
"""

from __future__ import annotations

import bisect
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

from lambda_core.domain.errors import unknown_name
from lambda_core.formulas.ratings import conformity_term

# ISO 281:2007, table 3, radial contact ball bearings, single row: f_0 F_a/C_0r, e, Y; X = 0.56.
_RELATIVE_AXIAL = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
_LIMIT = (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44)
_AXIAL_FACTOR = (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00)
_RADIAL_FACTOR = 0.56
BALL_SLOPE, ROLLER_SLOPE = 10.0 / 9.0, 9.0 / 8.0  # of Weibull's distribution of lives

# ISO 281:2007, table 3, angular contact ball bearings, single row. At 15 deg over f_0 F_a/C_0r, X = 0.44; above: angle
# [deg], e, X, Y.
_RELATIVE_15 = (0.178, 0.357, 0.714, 1.07, 1.43, 2.14, 3.57, 5.35, 7.14)
_LIMIT_15 = (0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56)
_AXIAL_15 = (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00)
_RADIAL_15 = 0.44
_STEEP = (
    (20.0, 0.57, 0.43, 1.00),
    (25.0, 0.68, 0.41, 0.87),
    (30.0, 0.80, 0.39, 0.76),
    (35.0, 0.95, 0.37, 0.66),
    (40.0, 1.14, 0.35, 0.57),
    (45.0, 1.34, 0.33, 0.50),
)
# ISO 76:2006, table 2: angle [deg], Y_0 of single-row angular contact ball bearings; X_0 = 0.5.
_STATIC_AXIAL = ((15.0, 0.46), (20.0, 0.42), (25.0, 0.38), (30.0, 0.33), (35.0, 0.29), (40.0, 0.26), (45.0, 0.22))

# ISO 281:2007, table 3, two rows: angle [deg], Y up to e, then X and Y: 0.625/e, 1.625 X and 1.625 Y of one row.
_TWO_ROWS = (
    (20.0, 1.09, 0.70, 1.63),
    (25.0, 0.92, 0.67, 1.41),
    (30.0, 0.78, 0.63, 1.24),
    (35.0, 0.66, 0.60, 1.07),
    (40.0, 0.55, 0.57, 0.93),
    (45.0, 0.47, 0.54, 0.81),
)

# ISO 281:2007, table 3, self-aligning: e over tan(alpha), Y up to e and above over cot(alpha), X above e; ISO 76: Y_0
# over cot(alpha), X_0 = 1.
_SELF_ALIGNING_LIMIT, _SELF_ALIGNING_BELOW, _SELF_ALIGNING_ABOVE, _SELF_ALIGNING_RADIAL = 1.5, 0.42, 0.65, 0.65
_SELF_ALIGNING_STATIC = 0.44

# ISO 281:2007, table 13: contamination level -> (low, high) of e_C for D_pw < 100 mm and for D_pw >= 100 mm.
CONTAMINATION_LEVELS: dict[str, tuple[tuple[float, float], tuple[float, float]]] = {
    "extreme cleanliness": ((1.0, 1.0), (1.0, 1.0)),
    "high cleanliness": ((0.6, 0.8), (0.8, 0.9)),
    "normal cleanliness": ((0.5, 0.6), (0.6, 0.8)),
    "slight contamination": ((0.3, 0.5), (0.4, 0.6)),
    "typical contamination": ((0.1, 0.3), (0.2, 0.4)),
    "severe contamination": ((0.0, 0.1), (0.0, 0.1)),
    "very severe contamination": ((0.0, 0.0), (0.0, 0.0)),
}


@dataclass(frozen=True)
class EquivalentLoad:
    """Dynamic equivalent load with the factors that made it."""

    load: float  # P [N]
    radial_factor: float  # X
    axial_factor: float  # Y
    limit: float  # e


def _interpolate(x: float, xs: Sequence[float], ys: Sequence[float]) -> float:
    """Interpolate between the table's points, constant outside."""
    if x <= xs[0]:
        return ys[0]
    if x >= xs[-1]:
        return ys[-1]
    i = bisect.bisect_right(xs, x)
    share = (x - xs[i - 1]) / (xs[i] - xs[i - 1])
    return ys[i - 1] + share * (ys[i] - ys[i - 1])


def dynamic_equivalent_load(
    radial_load: float,
    axial_load: float,
    static_rating: float,
    static_factor: float,
    contact_angle: float = 0.0,
    rows: int = 1,
    *,
    on_sphere: bool = False,
) -> EquivalentLoad:
    """Return the dynamic equivalent radial load P.

    It follows ISO 281:2007, 5.3 and table 3.

    P = F_r for F_a/F_r <= e, else X F_r + Y F_a, with e and Y of radial contact (X = 0.56) and of 15 degrees
    interpolated in f_0 F_a/C_0r, at 15 degrees times the number i of rows, which C_0r counts (outside the table its
    first or last column, as the standard allows no extrapolation).
    Between the tabled contact angles all three are linear in the angle, between 0 and 15 degrees too.

    Parameters
    ----------
    contact_angle : float
        Nominal one [rad], at most 45 degrees.
    rows : int
        That carry, 1 or 2; four-point contact counts as two, of which either takes one direction of thrust.
    on_sphere : bool
        Its factors follow from the angle alone: e = 1.5 tan(alpha), Y = 0.42 cot(alpha), then X = 0.65 and
        Y = 0.65 cot(alpha).
    """
    angle = math.degrees(contact_angle)
    limit, radial_factor, axial_factor = _factors(static_factor * axial_load / static_rating, angle, rows)
    below = 0.0
    if on_sphere:
        slope = math.tan(contact_angle)
        limit, radial_factor = _SELF_ALIGNING_LIMIT * slope, _SELF_ALIGNING_RADIAL
        below, axial_factor = _SELF_ALIGNING_BELOW / slope, _SELF_ALIGNING_ABOVE / slope
    elif rows == 2:
        below, radial_factor, axial_factor = _two_rows(limit, radial_factor, axial_factor, angle)
    if axial_load <= limit * radial_load:
        return EquivalentLoad(radial_load + below * axial_load, 1.0, below, limit)
    return EquivalentLoad(radial_factor * radial_load + axial_factor * axial_load, radial_factor, axial_factor, limit)


def _factors(relative: float, angle: float, rows: int) -> tuple[float, float, float]:
    """Return e, X and Y of one row.

    The row belongs to a ball bearing of a contact angle [deg] and some rows.
    """
    radial = (
        _interpolate(relative, _RELATIVE_AXIAL, _LIMIT),
        _RADIAL_FACTOR,
        _interpolate(relative, _RELATIVE_AXIAL, _AXIAL_FACTOR),
    )
    of_row = rows * relative
    fifteen = (
        _interpolate(of_row, _RELATIVE_15, _LIMIT_15),
        _RADIAL_15,
        _interpolate(of_row, _RELATIVE_15, _AXIAL_15),
    )
    table = [(0.0, *radial), (15.0, *fifteen), *_STEEP]
    angles = [line[0] for line in table]
    e, x, y = (_interpolate(angle, angles, [line[i] for line in table]) for i in (1, 2, 3))
    return e, x, y


def _two_rows(limit: float, radial_factor: float, axial_factor: float, angle: float) -> tuple[float, float, float]:
    """Return the factors Y, X, Y of two rows.

    Y holds up to e, and X and Y above. They follow from e, X and Y of one row of that angle [deg].
    """
    if angle < _TWO_ROWS[0][0]:
        return 0.625 / limit, 1.625 * radial_factor, 1.625 * axial_factor
    angles = [row[0] for row in _TWO_ROWS]
    below, x, y = (_interpolate(angle, angles, [row[i] for row in _TWO_ROWS]) for i in (1, 2, 3))
    return below, x, y


def static_equivalent_load(
    radial_load: float, axial_load: float, contact_angle: float = 0.0, rows: int = 1, *, on_sphere: bool = False
) -> float:
    """Return the static equivalent radial load P_0 [N].

    It is max(X_0 F_r + Y_0 F_a, F_r) (ISO 76:2006, table 2).

    0.6 and 0.5 for radial contact; X_0 = 0.5 and Y_0 by the angle from 15 degrees on, where smaller angles count as 15;
    of two rows X_0 = 1 and twice that Y_0; of self-aligning bearings F_r + 0.44 cot(alpha) F_a.
    """
    if on_sphere:
        return radial_load + _SELF_ALIGNING_STATIC / math.tan(contact_angle) * axial_load
    if contact_angle == 0.0:
        return max(0.6 * radial_load + 0.5 * axial_load, radial_load)
    angles, factors = zip(*_STATIC_AXIAL, strict=True)
    axial_factor = _interpolate(math.degrees(contact_angle), angles, factors)
    return max(rows * (0.5 * radial_load + axial_factor * axial_load), radial_load)


def system_life(lives: Sequence[float], slopes: Sequence[float]) -> float:
    """Return the life of a set of bearings.

    90 % of sets reach it: the L with sum (L/L_i)^e_i = 1, in the unit of `lives`; of one slope e for all
    (sum L_i^-e)^(-1/e).

    The product of their Weibull survivals; slopes e are 10/9 of balls (Lundberg and Palmgren 1947; Harris and Kotzalas
    2006) and 9/8 of rollers (Lundberg and Palmgren 1952; ISO/TR 1281-1).
    """
    shortest = min(lives)
    if shortest in (0.0, math.inf):
        return shortest
    if len(set(slopes)) == 1:
        return float(sum(life ** -slopes[0] for life in lives) ** (-1.0 / slopes[0]))

    def excess(share: float) -> float:
        return math.fsum((share * shortest / life) ** slope for life, slope in zip(lives, slopes, strict=True)) - 1.0

    from scipy.optimize import brentq  # few commands need it, and it takes a fifth of a second

    return shortest * float(brentq(excess, 0.0, 1.0))


def basic_rating_life(dynamic_rating: float, equivalent_load: float) -> float:
    """Return the rating life L_10 [1e6 revolutions].

    It is (C/P)^3 (ISO 281:2007, eq. for ball bearings).
    """
    if equivalent_load <= 0.0:
        return math.inf
    return (dynamic_rating / equivalent_load) ** 3


def life_hours(million_revolutions: float, speed: float) -> float:
    """Return a life in hours.

    It holds at the relative speed of the rings [rad/s] and is infinite at rest.
    """
    if speed == 0.0:
        return math.inf
    return million_revolutions * 1e6 * 2.0 * math.pi / abs(speed) / 3600.0


def contamination_range(level: str, pitch_diameter: float) -> tuple[float, float]:
    """Return lowest and highest e_C of a contamination.

    They belong to its level (ISO 281:2007, table 13).

    Raises
    ------
    ValueError
        For a level that the table does not have, with the nearest names.
    """
    try:
        small, large = CONTAMINATION_LEVELS[level]
    except KeyError:
        raise ValueError(unknown_name("contamination level", level, CONTAMINATION_LEVELS)) from None
    return small if pitch_diameter < 0.1 else large


def reference_viscosity(speed: float, pitch_diameter: float) -> float:
    """Return the reference kinematic viscosity nu_1 [m2/s].

    It follows ISO 281:2007, 9.3.3.2.

    45000 n^-0.83 D_pw^-0.5 below 1000 1/min, 4500 n^-0.5 D_pw^-0.5 above (mm2/s, 1/min, mm).

    Raises
    ------
    ValueError
        At zero speed, where the viscosity needed is infinite.
    """
    rpm = abs(speed) * 30.0 / math.pi
    if rpm == 0.0:
        raise ValueError("the reference viscosity of ISO 281 needs a speed above zero")
    pitch = pitch_diameter * 1e3
    if rpm < 1000.0:
        return float(45000e-6 * rpm**-0.83 / math.sqrt(pitch))
    return 4500e-6 / math.sqrt(rpm * pitch)


class LifeFactorNumbers(NamedTuple):
    """Numbers of the factor a_ISO.

    They hold for one kind of bearing, in the formula of :func:`life_modification_factor`.
    """

    level: float
    film: float
    load: float
    power: float
    low: float  # c for 0.1 <= kappa < 0.4
    high: float  # c for 0.4 <= kappa <= 4


RADIAL_BALL = LifeFactorNumbers(2.5671, 0.83, 1.0 / 3.0, -9.3, 2.2649, 1.9987)  # ISO 281:2007, 9.3.3.2, eq. 31-33
LEAST_KAPPA = 0.1  # of the standard's calculation of a_ISO (ISO 281:2007, 9.3.3)
RADIAL_ROLLER = LifeFactorNumbers(1.5859, 1.0, 0.4, -9.185, 1.3993, 1.2348)  # ISO 281:2007, 9.3.3.3


def life_modification_factor(
    viscosity_ratio: float,
    contamination: float,
    fatigue_limit: float,
    equivalent_load: float,
    numbers: LifeFactorNumbers = RADIAL_BALL,
) -> float:
    """Return the factor a_ISO (ISO 281:2007, 9.3.3).

    0.1 [1 - (level - c/kappa^e)^film (e_C C_u/P)^load]^power with e = 0.054381 for 0.1 <= kappa < 0.4, 0.19087 for
    0.4 <= kappa < 1, 0.071739 for 1 <= kappa <= 4; kappa above 4 counts as 4; a_ISO <= 50.

    Parameters
    ----------
    viscosity_ratio : float
        kappa = nu/nu_1.
    contamination : float
        e_C.
    fatigue_limit, equivalent_load : float
        C_u and P [N].
    numbers : LifeFactorNumbers
        Those of the kind of bearing.

    Raises
    ------
    ValueError
        For kappa below 0.1, where the standard's calculation is not valid.
    """
    if viscosity_ratio < LEAST_KAPPA:
        raise ValueError(f"a_ISO is defined for a viscosity ratio kappa of 0.1 and more, got {viscosity_ratio:.3g}")
    kappa = min(viscosity_ratio, 4.0)
    if kappa < 0.4:
        film = numbers.level - numbers.low / kappa**0.054381
    elif kappa < 1.0:
        film = numbers.level - numbers.high / kappa**0.19087
    else:
        film = numbers.level - numbers.high / kappa**0.071739
    if equivalent_load <= 0.0:
        return 50.0
    inner = 1.0 - film**numbers.film * (contamination * fatigue_limit / equivalent_load) ** numbers.load
    if inner <= 0.0:  # beyond the pole the fatigue limit is never reached
        return 50.0
    return float(min(0.1 * inner**numbers.power, 50.0))


@dataclass(frozen=True)
class ReferenceLife:
    """Basic reference rating life of ISO/TS 16281.

    It has its inputs, too.
    """

    life: float  # L_10r [1e6 revolutions]
    equivalent_load: float  # P_ref,r [N]: the radial load of equal basic rating life
    capacity_inner: float  # Q_ci [N]
    capacity_outer: float  # Q_ce [N]
    load_inner: float  # Q_ei [N]
    load_outer: float  # Q_ee [N]


def ball_capacities(
    dynamic_rating: float,
    ball_count: int,
    gamma: float,
    inner_conformity: float,
    outer_conformity: float,
    nominal_angle: float = 0.0,
    rows: int = 1,
) -> tuple[float, float]:
    """Return the rolling element loads (Q_ci, Q_ce).

    They belong to the basic dynamic load rating [N] (ISO/TS 16281:2008, eq. 19-20).

    Q_ci = C/(0.407 Z cos(alpha) i^0.7) (1 + t^(10/3))^0.3 and Q_ce = C/(0.389 Z cos(alpha) i^0.7)
    (1 + t^(-10/3))^0.3, t = 1.044 [(1-g)/(1+g)]^1.72 [(r_i/r_e)(2 r_e - D_w)/(2 r_i - D_w)]^0.41. The numbers
    0.407 and 0.389 are J_r/J_1 and J_r/J_2 of the load distribution with half the raceway loaded.
    """
    term = conformity_term(gamma, inner_conformity, outer_conformity, coefficient=1.044)
    share = dynamic_rating / (ball_count * math.cos(nominal_angle) * rows**0.7)
    inner = share / 0.407 * (1.0 + term ** (10.0 / 3.0)) ** 0.3
    outer = share / 0.389 * (1.0 + term ** (-10.0 / 3.0)) ** 0.3
    return inner, outer


def reference_rating_life(
    inner_loads: Sequence[float],
    outer_loads: Sequence[float],
    *,
    dynamic_rating: float,
    gamma: float,
    inner_conformity: float,
    outer_conformity: float,
    inner_rotates: bool = True,
    nominal_angle: float = 0.0,
    rows: int = 1,
) -> ReferenceLife:
    """Return the basic reference rating life L_10r.

    It follows from the load of every ball (ISO/TS 16281:2008, eq. 21-29).

    L_10r = [(Q_ci/Q_ei)^(-10/3) + (Q_ce/Q_ee)^(-10/3)]^(-9/10). On the ring that rotates relative to the load the
    mean has the exponent 3, on the other 10/3.

    Parameters
    ----------
    inner_loads, outer_loads : sequence of float, length Z times rows
        Normal loads at the inner and outer raceway, zero where unloaded [N]; row by row.
    rows : int
        Raceways of each ring. Their lives add up as Weibull's survivals do, Q_ei and Q_ee are those of the row that
        fares worst.
    """
    count = len(inner_loads) // rows
    if count == 0 or len(inner_loads) != count * rows or len(outer_loads) != len(inner_loads):
        raise ValueError("the inner and the outer loads of every ball are needed, in the same number")

    def mean(loads: Sequence[float], exponent: float) -> float:
        # relative to the largest load: no overflow, and zero stays zero
        top = max(loads)
        return top * (sum((load / top) ** exponent for load in loads) / count) ** (1.0 / exponent) if top > 0 else 0.0

    moving, resting = 3.0, 10.0 / 3.0
    on_inner, on_outer = (moving, resting) if inner_rotates else (resting, moving)
    capacity_inner, capacity_outer = ball_capacities(
        dynamic_rating, count, gamma, inner_conformity, outer_conformity, nominal_angle, rows
    )
    each = []
    for row in (slice(i * count, (i + 1) * count) for i in range(rows)):
        inner, outer = mean(inner_loads[row], on_inner), mean(outer_loads[row], on_outer)
        worn = (inner / capacity_inner) ** (10.0 / 3.0) + (outer / capacity_outer) ** (10.0 / 3.0)
        each.append((worn, inner, outer))
    damage = sum(worn for worn, _, _ in each)
    life = damage**-0.9 if damage > 0.0 else math.inf
    equivalent = dynamic_rating * damage**0.3
    _, load_inner, load_outer = max(each)
    return ReferenceLife(life, equivalent, capacity_inner, capacity_outer, load_inner, load_outer)

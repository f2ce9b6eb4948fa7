"""Compute load ratings of radial roller bearings.

They follow ISO 281 and ISO 76; ratings of laminae follow ISO 16281.

SI in and out; the standards' formulas are in mm and N, converted inside.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.formulas.life import EquivalentLoad

MATERIAL_FACTOR = 1.1  # b_m of ISO 281: cylindrical, tapered and needle bearings with machined rings
REDUCTION_FACTOR = 0.83  # lambda nu of ISO/TR 1281-1: edge loads and uneven load along the roller
HIGHEST_ROLLER_PRESSURE = 4e9  # of the static rating (ISO 76) [Pa]
_MM = 1e3
# Ratio of the raceways' capacities: ISO/TR 1281-1 writes 1.04, ISO 16281 the same number with one digit more.
_RATIO, _RATIO_16281 = 1.04, 1.038
_CAPACITY = 551.13373 * 0.3772  # ISO/TR 1281-1: B_1 of line contact times the load integral ratio
_INNER, _OUTER = 0.378, 0.364  # J_r/J_1 and J_r/J_2 of line contact, half the raceway loaded


@dataclass(frozen=True)
class LaminaRatings:
    """Dynamic load ratings of roller and lamina [N]."""

    roller_inner: float  # Q_ci
    roller_outer: float  # Q_ce
    inner: float  # q_ci
    outer: float  # q_ce


def diameter_ratio(roller_diameter: float, pitch_diameter: float, contact_angle: float = 0.0) -> float:
    """Return gamma = D_we cos(alpha)/D_pw [-].

    Raises
    ------
    ValueError
        Unless 0 < gamma < 1.
    """
    return _checked(roller_diameter * math.cos(contact_angle) / pitch_diameter)


def raceway_ratio(gamma: float, coefficient: float = _RATIO) -> float:
    """Return the ratio of the raceways' capacities.

    It is 1.04 [(1 - g)/(1 + g)]^(143/108) (ISO/TR 1281-1).
    """
    return float(coefficient * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0))


def roller_dynamic_factor(gamma: float, reduction: float = REDUCTION_FACTOR) -> float:
    """Return f_c of ISO 281 for rollers.

    It is that of radial roller bearings (N, mm; without b_m).

    f_c = 207.9 lambda {1 + [1.04 ((1-g)/(1+g))^(143/108)]^(9/2)}^(-2/9) g^(2/9) (1-g)^(29/27)/(1+g)^(1/4)
    (Lundberg and Palmgren 1952; ISO/TR 1281-1): the closed form behind the standard's table.

    Parameters
    ----------
    gamma : float
        D_we cos(alpha)/D_pw, 0 < gamma < 1; the table covers 0.01 to 0.30.
    reduction : float
        lambda nu [-].
    """
    races = (1.0 + raceway_ratio(_checked(gamma)) ** 4.5) ** (-2.0 / 9.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return float(_CAPACITY * reduction * races * shape)


def roller_dynamic_rating(
    count: int,
    roller_diameter: float,
    length: float,
    pitch_diameter: float,
    *,
    contact_angle: float = 0.0,
    rows: int = 1,
    material_factor: float = MATERIAL_FACTOR,
) -> float:
    """Return the rating C_r of rollers [N].

    It is the basic dynamic radial load rating (ISO 281:2007, 7.1).

    C_r = b_m f_c (i L_we cos alpha)^(7/9) Z^(3/4) D_we^(29/27) (mm, N).

    Parameters
    ----------
    count : int
        Rollers per row Z.
    roller_diameter, length : float
        Mean diameter D_we and effective contact length L_we [m].
    pitch_diameter : float
        D_pw [m].
    contact_angle : float
        Nominal angle alpha of the outer raceway [rad].
    rows : int
        i.
    material_factor : float
        b_m: 1.1; 1.0 for drawn cups, 1.15 for spherical roller bearings.
    """
    factor = roller_dynamic_factor(diameter_ratio(roller_diameter, pitch_diameter, contact_angle))
    line = (rows * length * _MM * math.cos(contact_angle)) ** (7.0 / 9.0)
    return float(material_factor * factor * line * count**0.75 * (roller_diameter * _MM) ** (29.0 / 27.0))


def roller_static_rating(
    count: int,
    roller_diameter: float,
    length: float,
    pitch_diameter: float,
    *,
    contact_angle: float = 0.0,
    rows: int = 1,
) -> float:
    """Return the rating C_0r of rollers [N].

    It is the basic static radial load rating (ISO 76:2006, 7.1).

    C_0r = 44 (1 - D_we cos(alpha)/D_pw) i Z L_we D_we cos(alpha) (mm, N): 4000 MPa in the most loaded inner contact.
    Parameters as for :func:`roller_dynamic_rating`.
    """
    gamma = diameter_ratio(roller_diameter, pitch_diameter, contact_angle)
    area = length * roller_diameter * _MM**2
    return 44.0 * (1.0 - gamma) * rows * count * area * math.cos(contact_angle)


def roller_fatigue_load_limit(static_rating: float, pitch_diameter: float) -> float:
    """Return C_u of a roller bearing [N].

    It is the fatigue load limit (ISO 281:2007, annex B, simplified).

    C_0/8.2 up to D_pw = 100 mm, C_0/8.2 (100 mm/D_pw)^0.3 above.
    """
    size = 1.0 if pitch_diameter <= 0.1 else (0.1 / pitch_diameter) ** 0.3
    return static_rating / 8.2 * size


def lamina_ratings(
    dynamic_rating: float, count: int, gamma: float, slices: int, *, contact_angle: float = 0.0, rows: int = 1
) -> LaminaRatings:
    """Return the ratings of roller and lamina.

    They are those of one roller and one of its laminae (ISO 16281:2025, roller bearings).

    Q_ci = C_r/(lambda 0.378 Z cos(alpha) i^(7/9)) {1 + t^(9/2)}^(2/9), Q_ce with 0.364 and the exponent -9/2,
    t = 1.038 [(1-g)/(1+g)]^(143/108), lambda = 0.83; q_c = Q_c n_s^(-7/9). The rating C_r holds lambda already:
    division restores the capacity that an even load along the roller would have.

    Parameters
    ----------
    dynamic_rating : float
        C_r [N].
    count, slices : int
        Rollers per row and laminae n_s.
    gamma : float
        D_we cos(alpha)/D_pw.
    contact_angle : float
        alpha [rad].
    rows : int
        i.
    """
    ratio = raceway_ratio(gamma, _RATIO_16281) ** 4.5
    share = dynamic_rating / (REDUCTION_FACTOR * count * math.cos(contact_angle) * rows ** (7.0 / 9.0))
    inner = share / _INNER * (1.0 + ratio) ** (2.0 / 9.0)
    outer = share / _OUTER * (1.0 + 1.0 / ratio) ** (2.0 / 9.0)
    lamina = slices ** (-7.0 / 9.0)
    return LaminaRatings(inner, outer, inner * lamina, outer * lamina)


def roller_equivalent_load(
    radial_load: float, axial_load: float, contact_angle: float = 0.0, rows: int = 1
) -> EquivalentLoad:
    """Return the equivalent dynamic load of rollers.

    It is the radial load of a roller bearing (ISO 281:2007, table 8).

    e = 1.5 tan(alpha); one row P = F_r up to F_a/F_r = e, above 0.4 F_r + 0.4 cot(alpha) F_a; two rows
    F_r + 0.45 cot(alpha) F_a, above 0.67 F_r + 0.67 cot(alpha) F_a.

    Parameters
    ----------
    radial_load, axial_load : float
        F_r and F_a [N].
    contact_angle : float
        alpha [rad]; zero for cylindrical bearings.
    rows : int
        1 or 2.

    Raises
    ------
    ValueError
        For an axial load on a cylindrical bearing, whose ribs carry it: see
        :mod:`lambda_core.elements.roller.axial_limit`.
    """
    if contact_angle == 0.0:
        if axial_load:
            raise ValueError(
                "`axial_load` has no equivalent radial load without a contact angle: compare it with the ribs"
            )
        return EquivalentLoad(radial_load, 1.0, 0.0, 0.0)
    limit, cotangent = 1.5 * math.tan(contact_angle), 1.0 / math.tan(contact_angle)
    if axial_load <= limit * radial_load:
        radial, axial = 1.0, (0.0 if rows == 1 else 0.45 * cotangent)
    else:
        radial = 0.4 if rows == 1 else 0.67
        axial = radial * cotangent
    return EquivalentLoad(radial * radial_load + axial * axial_load, radial, axial, limit)


def roller_static_load(radial_load: float, axial_load: float, contact_angle: float = 0.0, rows: int = 1) -> float:
    """Return the equivalent static load of rollers [N].

    It is the radial load of a roller bearing (ISO 76:2006, table 3).

    max(X_0 F_r + Y_0 F_a, F_r) with X_0 = 0.5 and Y_0 = 0.22 cot(alpha) of one row, 1 and 0.44 cot(alpha) of two; F_r
    for cylindrical bearings.
    """
    if contact_angle == 0.0:
        return radial_load
    return max(rows * (0.5 * radial_load + 0.22 / math.tan(contact_angle) * axial_load), radial_load)


def _checked(gamma: float) -> float:
    if not 0.0 < gamma < 1.0:
        raise ValueError(f"gamma = D_we cos(alpha)/D_pw must lie between 0 and 1, got {gamma:g}")
    return gamma

"""Compare rollers with standards, catalogues and computations.

Reliability of a value stands in its source: [R] read in the source, [R2] read in a text that retyped or digitised it,
[M] computed by an independent script, [K] remembered.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller import line_contact, profiles, rib, slices
from lambda_core.elements.roller.axial_limit import axial_limit
from lambda_core.elements.roller.roller_bearing import Ring, RollerBearing
from lambda_core.elements.roller.roller_equilibrium import RollerEquilibrium, balance
from lambda_core.elements.roller.roller_life import RollerLife, lamina_life
from lambda_core.elements.roller.roller_ratings import (
    lamina_ratings,
    roller_dynamic_factor,
    roller_dynamic_rating,
    roller_equivalent_load,
    roller_fatigue_load_limit,
    roller_static_rating,
)
from lambda_core.elements.roller.rolling import rolling_force, rolling_torque
from lambda_core.formulas.kinematics import diameter_ratio, entrainment_speed
from lambda_core.formulas.life import RADIAL_ROLLER, life_modification_factor

from .published import Published
from .roller_cases import TAPERED_32216

RPM = math.pi / 30.0
STEEL = 226e9  # [Pa]

# ISO 281:2007, table 7 [K]: f_c of radial roller bearings over gamma = 0.01, 0.02, ... 0.30
DYNAMIC_FACTORS = (
    *(52.1, 60.8, 66.5, 70.7, 74.1, 76.9, 79.2, 81.2, 82.8, 84.2),
    *(85.4, 86.4, 87.1, 87.7, 88.2, 88.5, 88.7, 88.8, 88.8, 88.7),
    *(88.5, 88.2, 87.9, 87.5, 87.0, 86.4, 85.8, 85.2, 84.5, 83.8),
)


@pytest.mark.parametrize(("hundredths", "value"), list(enumerate(DYNAMIC_FACTORS, 1)))
def test_dynamic_factor(hundredths: int, value: float) -> None:
    reason = "last printed digit"
    Published(value, "ISO 281:2007, table 7 [K]", reason, abs=0.075).check(roller_dynamic_factor(0.01 * hundredths))


# designation: Z, mean D_we, L_we, D_pw [mm], alpha [deg], C_r, C_0r [kN]
R5 = (14, 10.53, 11.65, 51.56, 11.859, 59.5, 60.0)  # HR30306J


def test_ratings_of_the_hr30306j() -> None:
    count, diameter, length, pitch, angle, dynamic, static = R5
    shape = (count, diameter * 1e-3, length * 1e-3, pitch * 1e-3)
    source, reason = "NSK catalogue, HR30306J [R2]", "three digits; makers round, and the inner geometry is retyped"
    found = roller_dynamic_rating(*shape, contact_angle=math.radians(angle))
    Published(dynamic, source, reason, rel=0.015).check(found * 1e-3)
    found = roller_static_rating(*shape, contact_angle=math.radians(angle))
    Published(static, source, reason, rel=0.015).check(found * 1e-3)


def test_static_rating_of_the_32216() -> None:
    # the printed inner geometry gives 222 kN after ISO 76; the paper prints 260 kN, SKF's catalogue of 2018 245 kN
    found = roller_static_rating(16, 17e-3, 22.7e-3, 108.5e-3, contact_angle=math.radians(15.64))
    Published(222.0, "ISO 76 with the geometry of Wingertszahn et al. 2023 [M]", "digits", rel=0.003).check(
        found * 1e-3
    )


def test_catalogue_factors_of_the_32216() -> None:
    # the catalogue prints e 0.42 and Y 1.4: a contact angle of 15.64 degrees
    found = roller_equivalent_load(1e3, 1e3, math.radians(15.64))
    Published(0.42, "SKF catalogue, 32216 [K]", "two digits", abs=0.005).check(found.limit)
    Published(1.4, "SKF catalogue, 32216 [K]", "two digits", abs=0.05).check(found.axial_factor)


# designation: C_0 [kN], mean diameter [m], C_u [kN]
@pytest.mark.parametrize(
    ("static", "pitch", "limit"), [(53.0, 60e-3, 6.7), (245.0, 108.5e-3, 28.5)], ids=["NU 208 ECP", "32216"]
)
def test_fatigue_load_limit(static: float, pitch: float, limit: float) -> None:
    reason = "SKF computes C_u from the contacts, ISO 281 offers C_0/8.2 as an estimate"
    found = roller_fatigue_load_limit(static * 1e3, pitch)
    Published(limit, "SKF, Rolling bearings, 2018, product tables [R]", reason, rel=0.04).check(found * 1e-3)


def test_palmgren_and_iso_agree() -> None:
    reason = "two fits to the same measurements: 35948 was rounded from twice 3.84e-5 and its joint exponent"
    for load in (100.0, 1e3, 1e4):
        both = 2.0 * float(line_contact.palmgren_approach(load, 12e-3))
        iso = float(line_contact.iso_approach(load, 12e-3))
        Published(both, "Palmgren 1959", reason, rel=0.035).check(iso)


def test_iso_approach_lies_below_the_half_space() -> None:
    # D_we 11, L_we 12, D_pw 65.5 mm, 2 kN: Lundberg's two half spaces give 11.3 um, the standard 10.1
    radii = [line_contact.raceway_radius(11e-3, 65.5e-3, inner=inner) for inner in (True, False)]
    half_spaces = sum(line_contact.finite_line_approach(2e3, 12e-3, radius, STEEL) for radius in radii)
    reason = "a measured power law against an elastic half space: a model uncertainty of 10 to 15 %"
    Published(half_spaces, "Lundberg 1939", reason, rel=0.15).check(float(line_contact.iso_approach(2e3, 12e-3)))


# R1: Stribeck's numbers of line contact


def cylindrical(count: int) -> RollerBearing:
    """Return plain rollers.

    11 x 12 mm without profile and clearance on a pitch circle of 65.5 mm.
    """
    sizes = (11e-3, 12e-3, 12e-3, 65.5e-3, 40e-3, 90e-3, 23e-3, 69.5e3, 75e3, 9e3)
    return RollerBearing("NU", count, *sizes, profile="none")


def loads_of(
    bearing: RollerBearing, radial: float, axial: float, tilt: float = 0.0, slices: int = 30
) -> RollerEquilibrium:
    """Return the equilibrium under loads.

    Along x and y, at a tilt about z.
    """
    place = np.array([0.0, 0.0, 0.0, 0.0, tilt])
    return balance(bearing, np.array([axial, radial, 0.0, 0.0, 0.0]), displacement=place, slices=slices)


def test_stribeck_number_of_rollers() -> None:
    source, reason = "Stribeck 1901 for line contact, 4.08 F_r/Z [K]", "number of rollers"
    found = loads_of(cylindrical(14), 4450.0, 0.0).inner.sum(axis=1)
    Published(4.08 * 4450.0 / 14.0, source, reason, rel=0.002).check(float(found[0]))
    for value, load in zip((1298.8, 1156.7, 768.4, 244.6), found, strict=False):
        Published(value, "independent script [M]", "printed digits", abs=0.06).check(float(load))


# R4: one life in closed form


def even_life(count: int) -> tuple[RollerLife, float]:
    """Return the life of plain laminae.

    Without profile and stress riser, and the closed form.
    """
    rating, load = 69.5e3, 6e3
    found = loads_of(cylindrical(15), load, 0.0, slices=count)
    ratings = lamina_ratings(rating, 15, 11.0 / 65.5, count)
    return lamina_life(found.inner, ratings, rating, riser=1.0), (rating / (0.83 * load)) ** 4


def test_life_of_even_laminae_is_the_closed_form() -> None:
    found, exact = even_life(30)
    Published(37935.0, "(1/0.83)^4 (C/P)^4 [M]", "0.83^-4 to four digits", rel=1e-4).check(exact)
    reason = "0.378 and 0.364 are load integrals to three digits"
    Published(37935.0, "(1/0.83)^4 (C/P)^4 [M]", reason, rel=0.015).check(found.life)
    Published(37501.0, "independent script [M]", "printed digits", rel=1e-4).check(found.life)


def test_life_of_even_laminae_does_not_depend_on_their_number() -> None:
    assert even_life(60)[0].life == pytest.approx(even_life(30)[0].life, rel=1e-9)


# R5: HR30306J, F_r 30 kN, F_a 9 kN, 1500 1/min; a program's printed report, retyped
R5_TILT = 0.24e-3  # [rad]
R5_SOURCE = "report of a bearing program for the HR30306J after ISO 16281 [R2]"


def r5(drops: float) -> tuple[FloatArray, RollerLife]:
    """Return loads and life of a profile.

    A multiple of that of ISO 16281, 40 laminae, tilt 0.24 mrad.
    """
    count, diameter, length, pitch, degrees, dynamic, _ = R5
    diameter, length, pitch, angle = diameter * 1e-3, length * 1e-3, pitch * 1e-3, math.radians(degrees)
    half = rib.tapered_angles(diameter, pitch, angle).half
    bearing = RollerBearing(
        *("tapered", count, diameter, 12.5e-3, length, pitch, 30e-3, 72e-3, 20.75e-3, dynamic * 1e3, 60e3, 7.3e3),
        contact_angle=angle,
        profile="logarithmic",
        profile_scale=drops * 0.00045 * diameter / math.cos(half),
        profile_length=length,
    )
    found = loads_of(bearing, 30e3, 9e3, R5_TILT, slices=40).outer
    gamma = diameter_ratio(diameter, pitch, angle)
    ratings = lamina_ratings(dynamic * 1e3, count, gamma, 40, contact_angle=angle)
    return found.sum(axis=1), lamina_life(found, ratings, dynamic * 1e3)


def test_the_taper_follows_from_the_cup_angle() -> None:
    # printed end diameters 10.937 and 10.123 mm over 11.65 mm: a second way to the same angle
    half = rib.tapered_angles(10.53e-3, 51.56e-3, math.radians(11.859)).half
    printed = math.asin(0.5 * (10.937 - 10.123) / 11.65)
    Published(printed, "HR30306J, printed end diameters [R2]", "printed digits", rel=0.001).check(half)


def test_lamina_ratings_of_the_hr30306j() -> None:
    ratings = lamina_ratings(
        59.5e3, 14, diameter_ratio(10.53e-3, 51.56e-3, math.radians(11.859)), 40, contact_angle=math.radians(11.859)
    )
    reason = "four printed digits, and a mean diameter from two"
    Published(14.16, R5_SOURCE, reason, rel=0.002).check(ratings.roller_inner * 1e-3)
    Published(24.20, R5_SOURCE, reason, rel=0.002).check(ratings.roller_outer * 1e-3)
    Published(0.803, R5_SOURCE, reason, rel=0.002).check(ratings.inner * 1e-3)
    Published(1.373, R5_SOURCE, reason, rel=0.002).check(ratings.outer * 1e-3)


@pytest.mark.parametrize(("drops", "light"), [(1.0, 0.075), (2.0, 0.05)], ids=["profile", "twice the profile"])
def test_roller_loads_of_the_hr30306j(drops: float, light: float) -> None:
    """Compare the lightest load for two profiles.

    7.4 % low with the standard's drop, 3.0 % with twice that.

    The design tolerance of the lightest two is 7 %: with the profile of ISO 16281 the lightest misses it by 0.4 points.
    """
    found, _ = r5(drops)
    reason = "the profile behind the printed loads is in doubt"
    printed = (8487.0, 7757.0, 5773.0, 3175.0, 949.0)
    for value, load, rel in zip(printed, found, (0.03, 0.03, 0.03, 0.05, light), strict=False):
        Published(value, R5_SOURCE, reason, rel=rel).check(float(load))
    assert float(found[5]) == pytest.approx(0.0, abs=1e-3)


def test_life_of_the_hr30306j_is_an_order_of_magnitude() -> None:
    """Compare life with the printed 19.43 Mrev.

    25.4 Mrev with the standard's drop and the stress riser, 18.9 with twice the drop.
    """
    found = r5(1.0)[1].life
    reason = "40 laminae for 30, and the rib tilts the rollers"
    Published(26.0, "independent script with the stress riser [M]", reason, rel=0.03).check(found)
    Published(19.43, R5_SOURCE, "the profile behind it is in doubt: life as an order", rel=0.4).check(found)
    Published(19.43, R5_SOURCE, "with twice the drop; the stress riser alone is 4 %", rel=0.03).check(r5(2.0)[1].life)


def test_life_factor_of_the_hr30306j() -> None:
    limit = roller_fatigue_load_limit(60e3, 51.56e-3)
    Published(7.317, R5_SOURCE, "printed digits", abs=5e-4).check(limit * 1e-3)
    # One factor for the bearing, at P = C/L^0.3 of the printed life, is 1.57: the printed 1.154 weighs laminae, by a
    # rule that was not seen. The range of both ways of weighing holds it.
    single = life_modification_factor(3.413, 0.8174, limit, 59.5e3 / 19.43**0.3, RADIAL_ROLLER)
    assert 1.0 < 1.154 < single < 1.6


# one roller under tilt: D 11, L 12 mm, profile of ISO 16281 on the roller, both contacts, 2 kN [M]
TILTED = {
    0.0: (14.11, 239.7, 0.0),
    0.5e-3: (14.05, 244.1, 956.0),
    1e-3: (13.88, 256.0, 1877.0),
    2e-3: (13.13, 294.1, 3503.0),
}


@pytest.mark.parametrize("count", [200, 30])
@pytest.mark.parametrize("tilt", TILTED)
def test_tilted_roller(tilt: float, count: int) -> None:
    length = 12e-3
    drop = 2.0 * profiles.iso_cylindrical(slices.slice_positions(length, count), length, 11e-3)
    approach = slices.approach_at_load(2e3, tilt, drop, length)
    found = slices.lamina_loads(approach, tilt, drop, length)
    source = "independent script, 200 laminae [M]"
    rel, reason = (0.0005, "printed digits") if count == 200 else (0.007, "30 laminae for 200")
    delta, largest, moment = TILTED[tilt]
    Published(delta, source, reason, rel=rel).check(approach * 1e6)
    Published(largest, source, reason, rel=rel).check(float(found.loads.max()) / (length / count) * 1e-3)
    Published(moment, source, reason, rel=rel, abs=1e-6).check(float(found.moment) * 1e3)


# the 32216 with F_a 6.5 kN at 2000 1/min: raceway rolling under growing radial load
CUP = math.radians(15.64)
LENGTH = 20.7e-3
VISCOSITY = 0.05  # [Pa s], about FVA3 at 50 degC


def rolling_of_32216(radial_load: float, scale: float = 0.0) -> tuple[float, FloatArray]:
    """Return the 32216's rolling torque [N m].

    With the loads of the rollers [N]; `scale` of a log profile [m].
    """
    bearing = replace(
        TAPERED_32216, profile="logarithmic" if scale else "none", profile_scale=scale, profile_length=LENGTH
    )
    found = loads_of(bearing, radial_load, 6.5e3)
    speed = entrainment_speed(2000.0 * RPM, 0.0, 17e-3, 108.5e-3, CUP)
    width = LENGTH / 30
    rings: tuple[tuple[Ring, FloatArray], ...] = (("inner", found.inner), ("outer", found.outer))
    force = [
        width * rolling_force(loads / width, bearing.radius(ring), speed, VISCOSITY, STEEL) for ring, loads in rings
    ]
    return rolling_torque(np.array(force), speed, 2000.0 * RPM), found.outer.sum(axis=1)


def test_rolling_torque_of_the_32216_falls_with_radial_load() -> None:
    """Lower rolling torque by radial load.

    Rollers leave the contact; the measured torque falls too (text of Wingertszahn et al. 2023 [R]).
    """
    loads = (1e3, 2e3, 4e3, 6.5e3, 9e3, 12e3, 15e3)
    torques = np.array([rolling_of_32216(load)[0] for load in loads])
    assert np.all(np.diff(torques) < 0.0)
    reason = "oil of the script unknown: 0.03 to 0.08 Pa s move the ratios by 2 to 3 %"
    for value, ratio in zip((1.0, 1.0, 0.985, 0.95, 0.84, 0.67), torques[1:] / torques[0], strict=True):
        Published(value, "independent script, no profile [M]", reason, rel=0.02).check(float(ratio))


def test_profiles_do_not_turn_the_sign() -> None:
    torques = np.array([rolling_of_32216(load, 0.0005 * 17e-3)[0] for load in (1e3, 6.5e3, 12e3, 15e3)])
    assert np.all(np.diff(torques) < 0.0)


def test_eleven_rollers_carry_at_16_kn() -> None:
    found = rolling_of_32216(16e3)[1]
    carrying = int((found > 0.0).sum())
    Published(11, "independent script [M]", "one roller at the edge of the zone", abs=1).check(carrying)


def test_rib_of_the_32216() -> None:
    # 6 kN, contact 3 mm above the common generatrix, mu 0.02: 360 to 400 N mm, and omega_rel about 3.7 omega_i [M]
    angles = rib.tapered_angles(17e-3, 108.5e-3, CUP)
    Published(3.7, "independent script [M]", "two digits", abs=0.05).check(rib.relative_speed(angles, 1.0))
    face, _ = rib.rib_load(6e3 / (16 * math.sin(CUP)), angles, 0.0)
    torque = 16 * 0.02 * face * rib.sliding_speed(angles, 1.0, 3e-3)
    Published(380.0, "independent script [M]", "a range, 360 to 400 N mm", abs=20.5).check(torque * 1e3)


def test_axial_limit_of_the_nj_208() -> None:
    # SKF, Rolling bearings, 2018, p. 513: by hand, kN, mm, 1/min
    found = axial_limit(
        5e3, 3000.0 * RPM, bore=40e-3, outside=80e-3, width=18e-3, static_rating=53e3, light_series=True
    )
    source, reason = "SKF, Rolling bearings, 2018, p. 513 and table 6 [R], by hand", "four digits"
    Published(1.5 * 53e4 / (3000 * 120) - 0.15 * 5.0, source, reason, rel=1e-9).check(found.thermal * 1e-3)
    Published(0.0045 * 80.0**1.5, source, reason, rel=1e-9).check(found.mechanical * 1e-3)
    assert found.continuous == found.thermal


def test_large_bearings_join_at_their_surface() -> None:
    # 7.5 C_0^(2/3) equals C_0 at 422 kN: bearings of 50 000 mm2 have 300 to 500 kN, so that the formulas join roughly
    shape = {"bore": 130e-3, "outside": 230e-3, "static_rating": 420e3}
    small, large = (axial_limit(0.0, 100.0, width=width, **shape).thermal for width in (0.0442, 0.0443))
    Published(small, "SKF, Rolling bearings, 2018, p. 513 [R]", "no exact joint", rel=0.01).check(large)

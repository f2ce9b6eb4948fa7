"""Compute load ratings from inner geometry (ISO 281, ISO 76).

The bearings are radial ball bearings of one row or several.

Self-aligning bearings, whose outer raceway is a sphere, have factors of their own: the standards' formulas with that
sphere's radius for the outer groove, inner grooves of 0.53 D_w, no reduction of f_c, and 4600 MPa in place of 4200.
SI in and out; the standards' formulas are in mm and N, converted inside.
"""

from __future__ import annotations

import math

from lambda_core.formulas.hertz import ball_raceway_radii, load_at_pressure

# Ball bearings: permissible pressure of ISO 76 and the modulus its tables were computed with (ISO/TR 10657).
STATIC_PRESSURE = 4200e6  # [Pa]
STATIC_PRESSURE_SELF_ALIGNING = 4600e6  # [Pa]
STATIC_MODULUS = 207e9  # [Pa]
STATIC_POISSON = 0.3
RATING_MATERIAL_FACTOR = 1.3  # b_m of ISO 281 for deep-groove ball bearings
REDUCTION_FACTOR = 0.95  # lambda of ISO 281's f_c for single-row radial contact ball bearings
# Of self-aligning bearings: lambda and the largest inner groove that the tables hold for (ISO/TR 1281-1).
SELF_ALIGNING_REDUCTION, SELF_ALIGNING_CONFORMITY = 1.0, 0.53


def sphere_conformity(gamma: float) -> float:
    """Return the relative radius of a spherical raceway.

    It is that of the outer raceway over the ball diameter, (1 + 1/gamma)/2, with gamma = D_w cos(alpha)/D_pw.
    """
    return 0.5 * (1.0 + 1.0 / gamma)


def conformity_term(
    gamma: float, inner_conformity: float, outer_conformity: float, *, coefficient: float = 1.04
) -> float:
    """Return the ratio of the raceways' capacities.

    It is Q_ci/Q_ce (ISO/TR 1281-1; ISO/TS 16281 writes the coefficient 1.044).

    1.04 [(1-g)/(1+g)]^1.72 [(r_i/r_e) (2 r_e - D_w)/(2 r_i - D_w)]^0.41 with conformities f = r/D_w.
    """
    groove = inner_conformity / outer_conformity * (2.0 * outer_conformity - 1.0) / (2.0 * inner_conformity - 1.0)
    return float(coefficient * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * groove**0.41)


def dynamic_factor(
    gamma: float,
    inner_conformity: float = 0.52,
    outer_conformity: float = 0.52,
    reduction: float = REDUCTION_FACTOR,
) -> float:
    """Return the factor f_c of ISO 281.

    It is in N and mm, without b_m, in closed form (Lundberg and Palmgren 1947; ISO/TR 1281-1).

    f_c = 0.41 * 98.0665 lambda {1 + [Q_ci/Q_ce]^(10/3)}^-0.3 g^0.3 (1-g)^1.39/(1+g)^(1/3)
    [2 r_i/(2 r_i - D_w)]^0.41

    Parameters
    ----------
    gamma : float
        D_w cos(alpha)/D_pw, 0 < gamma < 1.
    inner_conformity, outer_conformity : float
        Groove radius over ball diameter. The standard's table was made with 0.52/0.52 and is to be used for any
        r_i <= 0.52 D_w and r_e <= 0.53 D_w; other values give the theory's number, not the standard's.

    Raises
    ------
    ValueError
        Outside 0 < gamma < 1 or for a conformity not above 0.5.
    """
    if not 0.0 < gamma < 1.0:
        raise ValueError(f"gamma = D_w cos(alpha)/D_pw must lie between 0 and 1, got {gamma:g}")
    if inner_conformity <= 0.5 or outer_conformity <= 0.5:
        raise ValueError("a groove radius must be larger than the ball radius (conformity above 0.5)")
    term = conformity_term(gamma, inner_conformity, outer_conformity)
    races = (1.0 + term ** (10.0 / 3.0)) ** -0.3
    shape = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
    grooves = (2.0 * inner_conformity / (2.0 * inner_conformity - 1.0)) ** 0.41
    return float(0.41 * 98.0665 * reduction * races * shape * grooves)


def sphere_factor(gamma: float) -> float:
    """Return f_c of self-aligning ball bearings.

    It follows ISO 281 (N, mm; without b_m); see :func:`dynamic_factor`.
    """
    return dynamic_factor(gamma, SELF_ALIGNING_CONFORMITY, sphere_conformity(gamma), SELF_ALIGNING_REDUCTION)


def dynamic_rating(
    ball_count: int,
    ball_diameter: float,
    pitch_diameter: float,
    *,
    contact_angle: float = 0.0,
    inner_conformity: float = 0.52,
    outer_conformity: float = 0.52,
    material_factor: float = RATING_MATERIAL_FACTOR,
    rows: int = 1,
    on_sphere: bool = False,
) -> float:
    """Return the dynamic load rating C_r [N].

    It is the basic radial rating (ISO 281, eq. for radial ball bearings).

    C_r = b_m f_c (i cos alpha)^0.7 Z^(2/3) D_w^1.8, with 3.647 D_w^1.4 in place of D_w^1.8 above 25.4 mm (mm, N);
    Z balls in each of i rows. Makers rate four-point contact as two rows. Of self-aligning bearings conformities follow
    from gamma.
    """
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    diameter = ball_diameter * 1e3
    size = diameter**1.8 if diameter <= 25.4 else 3.647 * diameter**1.4
    grooves = dynamic_factor(gamma, inner_conformity, outer_conformity)
    factor = sphere_factor(gamma) if on_sphere else grooves
    one = float(material_factor * factor * math.cos(contact_angle) ** 0.7 * ball_count ** (2.0 / 3.0) * size)
    return one * float(rows**0.7)


def static_factor(
    gamma: float, inner_conformity: float = 0.52, outer_conformity: float = 0.53, *, on_sphere: bool = False
) -> float:
    """Return the factor f_0 of ISO 76.

    It is in N and mm, from Hertz theory (ISO/TR 10657).

    The ball load Q at which the more heavily loaded raceway reaches 4200 MPa (E = 207 GPa, nu = 0.3), and
    Stribeck's Q_max = 5 F_r/(Z cos alpha): f_0 = Q/(5 D_w^2). Reproduces the standard's table within 0.053. Of
    self-aligning bearings 4600 MPa, on the sphere of the outer ring.
    """
    if not 0.0 < gamma < 1.0:
        raise ValueError(f"gamma = D_w cos(alpha)/D_pw must lie between 0 and 1, got {gamma:g}")
    pressure = STATIC_PRESSURE
    if on_sphere:
        pressure = STATIC_PRESSURE_SELF_ALIGNING
        inner_conformity, outer_conformity = SELF_ALIGNING_CONFORMITY, sphere_conformity(gamma)
    modulus = STATIC_MODULUS / (1.0 - STATIC_POISSON**2)
    loads = []
    for conformity, inner in ((inner_conformity, True), (outer_conformity, False)):
        # a ball of 1 m; gamma already holds the contact angle
        radius_x, radius_y = ball_raceway_radii(1.0, 1.0 / gamma, conformity, 0.0, inner=inner)
        loads.append(load_at_pressure(pressure, radius_x, radius_y, modulus))
    return min(loads) / 5.0 * 1e-6


def static_rating(
    ball_count: int,
    ball_diameter: float,
    pitch_diameter: float,
    *,
    contact_angle: float = 0.0,
    inner_conformity: float = 0.52,
    outer_conformity: float = 0.53,
    rows: int = 1,
    on_sphere: bool = False,
) -> float:
    """Return the static load rating C_0r [N].

    It is the basic radial rating f_0 i Z D_w^2 cos(alpha) of i rows (ISO 76).
    """
    gamma = ball_diameter * math.cos(contact_angle) / pitch_diameter
    factor = static_factor(gamma, inner_conformity, outer_conformity, on_sphere=on_sphere) * rows
    return factor * ball_count * (ball_diameter * 1e3) ** 2 * math.cos(contact_angle)


def fatigue_load_limit(static_load_rating: float, pitch_diameter: float) -> float:
    """Return the fatigue load limit C_u [N].

    It is that of a ball bearing by the simplified method of ISO 281:2007, B.3.2.

    C_0/22 up to D_pw = 100 mm, C_0/22 (100 mm/D_pw)^0.5 above.
    """
    size = 1.0 if pitch_diameter <= 0.1 else math.sqrt(0.1 / pitch_diameter)
    return static_load_rating / 22.0 * size

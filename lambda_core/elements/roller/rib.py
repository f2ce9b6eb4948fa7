"""Compute the contact of a tapered roller with its rib.

All lines of a tapered bearing meet in the apex on the bearing's axis. The plane through the axis and the roller has
the local axes e1 along the common generatrix of roller and inner raceway, away from the apex, and e2 from there towards
the roller's axis. The height h counts along e2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from lambda_core.domain.errors import unknown_name


@dataclass(frozen=True)
class TaperedAngles:
    """Angles against the bearing's axis [rad]."""

    inner: float  # inner raceway
    outer: float  # outer raceway, the contact angle of the bearing

    @property
    def half(self) -> float:
        """Half of the roller's cone angle beta."""
        return 0.5 * (self.outer - self.inner)

    @property
    def roller(self) -> float:
        """The roller's axis."""
        return 0.5 * (self.outer + self.inner)


@dataclass(frozen=True)
class RibContact:
    """Contact of the sphere end with the rib.

    Attributes
    ----------
    height : float
        h above the common generatrix [m].
    normal : float
        Angle of the contact's normal against the generatrix, towards the roller's axis [rad].
    distance : float
        From the bearing's axis [m].
    radius_x, radius_y : float
        Reduced radii along sliding (around the bearing's axis) and across it [m].
    end_radius : float
        Of the roller's end [m].
    """

    height: float
    normal: float
    distance: float
    radius_x: float
    radius_y: float
    end_radius: float


def tapered_angles(roller_diameter: float, pitch_diameter: float, outer_angle: float) -> TaperedAngles:
    """Return the angles of a tapered bearing.

    They follow from its printed numbers.

    sin(alpha_r)/tan(beta) = D_pw/D_we and alpha_r + beta = alpha_o, with the diameters at the roller's middle:
    tan(beta) = (D_we/D_pw) sin(alpha_o - beta).
    """
    ratio = roller_diameter / pitch_diameter
    half = ratio * math.sin(outer_angle)
    for _ in range(60):
        half = math.atan(ratio * math.sin(outer_angle - half))
    return TaperedAngles(outer_angle - 2.0 * half, outer_angle)


def rib_contact(
    angles: TaperedAngles, large_diameter: float, end_radius: float, height: float, *, rib: str = "cone"
) -> RibContact:
    """Return the contact of a sphere end.

    It touches a conical or spherical rib.

    The sphere's centre lies on the roller's axis, A - r_s from the apex, A = D_l/(2 tan(beta)); the normal passes
    through it: sin(theta) = (h - (A - r_s) sin(beta))/r_s. The conical rib is concave around the bearing's axis with
    the radius r/sin(alpha_i + theta) along the normal, r the contact's distance from the axis, and straight across; a
    spherical rib about the apex is concave with the contact's distance from the apex in both directions.

    Parameters
    ----------
    angles : TaperedAngles
        Of raceways and roller.
    large_diameter : float
        Of the roller's large end D_l [m].
    end_radius : float
        Radius r_s of the sphere end [m], usually 0.8 to 0.95 of the distance to the apex.
    height : float
        h [m]; D_l/2 is about the roller's axis, so that usual heights are a third of that.
    rib : str
        "cone" or "sphere".

    Raises
    ------
    ValueError
        For a height that the sphere does not reach, or where sphere and rib conform.
    """
    if rib not in ("cone", "sphere"):
        raise ValueError(unknown_name("rib", rib, ("cone", "sphere")))
    centre = 0.5 * large_diameter / math.tan(angles.half) - end_radius
    sine = (height - centre * math.sin(angles.half)) / end_radius
    if not -1.0 < sine < 1.0:
        raise ValueError(f"the sphere end of radius {end_radius:g} m does not reach the height {height:g} m")
    normal = math.asin(sine)
    along = centre * math.cos(angles.half) + end_radius * math.cos(normal)
    distance = along * math.sin(angles.inner) + height * math.cos(angles.inner)
    around = distance / math.sin(angles.inner + normal) if rib == "cone" else math.hypot(along, height)
    if around <= end_radius:
        raise ValueError(f"`end_radius` must be below the rib's radius {around:g} m, got {end_radius:g} m")
    radius_x = 1.0 / (1.0 / end_radius - 1.0 / around)
    return RibContact(height, normal, distance, radius_x, end_radius if rib == "cone" else radius_x, end_radius)


def rib_load(outer_load: float, angles: TaperedAngles, normal: float) -> tuple[float, float]:
    """Return rib and inner loads [N] in balance.

    They balance an outer raceway's load.

    Along the generatrix F_f cos(theta) = Q_o sin(2 beta), across Q_i = Q_o cos(2 beta) + F_f sin(theta); without
    centrifugal force and friction.
    """
    wedge = 2.0 * angles.half
    rib = outer_load * math.sin(wedge) / math.cos(normal)
    return rib, outer_load * math.cos(wedge) + rib * math.sin(normal)


def relative_speed(angles: TaperedAngles, ring_speed: float) -> float:
    """Return the relative roller speed [rad/s].

    It is relative to the inner ring, about their common generatrix.

    |omega_i - omega_o| sin(alpha_o)/sin(2 beta): rolling without sliding on both raceways, whose lines share the apex.
    """
    return abs(ring_speed) * math.sin(angles.outer) / math.sin(2.0 * angles.half)


def orbital_ratio(angles: TaperedAngles) -> float:
    """Return cage speed over inner ring speed.

    The outer ring is at rest.

    sin(alpha_i)/(2 cos(beta) sin(alpha_r)), from the same rolling.
    """
    return math.sin(angles.inner) / (2.0 * math.cos(angles.half) * math.sin(angles.roller))


def sliding_speed(angles: TaperedAngles, ring_speed: float, height: float) -> float:
    """Return the sliding speed at the rib [m/s], omega_rel h.

    Roller and rib turn against each other about the common generatrix, so that a point at the height h slides with
    omega_rel h: sliding with a real lever, no drilling about the contact's own normal.
    """
    return relative_speed(angles, ring_speed) * height


def rib_entrainment(angles: TaperedAngles, ring_speed: float, contact: RibContact) -> float:
    """Return the rib's mean surface speed [m/s].

    It is the mean of rib and roller end in the frame that turns with the cage.

    The outer ring is at rest. The rib moves with (omega_i - omega_c) r; the roller's end is slower by the sliding
    speed.
    """
    rib = abs(ring_speed) * (1.0 - orbital_ratio(angles)) * contact.distance
    return abs(rib - 0.5 * sliding_speed(angles, ring_speed, contact.height))


def rib_film(
    load: float, contact: RibContact, speed: float, viscosity: float, pressure_viscosity: float, e_eff: float
) -> float:
    """Return the central film thickness of the rib contact [m].

    h = 4.31 R_x U^0.68 G^0.49 W^-0.073 {1 - exp[-1.23 (R_y/R_x)^(2/3)]}, U = eta u/(E' R_x), G = alpha E', W = F/(E'
    R_x^2): Chittenden, Dowson, Dunn and Taylor 1985, Proc. R. Soc. A 397, 245, fitted for entrainment along the major
    axis too, as here: with R_x/R_y = 9 (32216) the ellipse is long in the direction of sliding. Hamrock and Dowson's
    fit of 1977 (2.69 U^0.67 ..., k >= 1), which Wingertszahn et al. 2023 use, gives twice the film there. A numerical
    solution (isothermal, Barus, 170 N, 35 mPa s, 18/GPa) has 0.107 and 0.223 um at 0.05 and 0.2 m/s; this formula 0.103
    and 0.261, Hamrock and Dowson's 0.217 and 0.543. Fully flooded, isothermal, smooth, piezoviscous-elastic: at some
    m/s the light contact is nearly rigid, and the film an upper bound.

    Parameters
    ----------
    load : float
        F [N].
    contact : RibContact
        Reduced radii.
    speed : float
        Mean surface speed u [m/s].
    viscosity, pressure_viscosity : float
        eta [Pa s] and alpha [1/Pa] at the inlet.
    e_eff : float
        E' [Pa].
    """
    stiffness = e_eff * contact.radius_x
    flow = viscosity * speed / stiffness
    material = pressure_viscosity * e_eff
    weight = load / (stiffness * contact.radius_x)
    shape = 1.0 - math.exp(-1.23 * (contact.radius_y / contact.radius_x) ** (2.0 / 3.0))
    return float(4.31 * contact.radius_x * flow**0.68 * material**0.49 * weight**-0.073 * shape)

"""Define the inner geometry of roller bearings.

The bearings have one row of cylindrical, tapered or needle rollers.

The plane of a roller has the coordinates (a, r): a along the bearing's axis in the direction in which thrust pushes the
inner ring, r away from the axis. The small end of a tapered roller therefore points to positive a.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import unknown_name
from lambda_core.elements.roller import profiles
from lambda_core.elements.roller.line_contact import STEEL_MODULUS
from lambda_core.elements.roller.rib import RibContact, TaperedAngles, rib_contact, tapered_angles
from lambda_core.elements.roller.slices import slice_positions
from lambda_core.formulas.elastic.ring import RingWaves

Ring = Literal["inner", "outer"]

# Ribs of each kind: ring, and the end of the roller that it guides, -1 or 1 along a. Thrust on an NJ presses its
# inner rib at -1 and its outer rib at 1 (ISO 5593; SKF, Rolling bearings, 2018, "Cylindrical roller bearings").
RIBS: Mapping[str, tuple[tuple[Ring, int], ...]] = {
    "NU": (("outer", -1), ("outer", 1)),
    "N": (("inner", -1), ("inner", 1)),
    "NJ": (("inner", -1), ("outer", 1), ("outer", -1)),
    "NUP": (("inner", -1), ("inner", 1), ("outer", 1), ("outer", -1)),
    "NCF": (("inner", -1), ("inner", 1), ("outer", 1)),
    "needle": (("outer", -1), ("outer", 1)),
    "tapered": (("inner", -1),),
}
FULL_COMPLEMENT = ("NCF",)
FAMILIES = ("cylindrical", "needle", "tapered")


def family_of(kind: str) -> str:
    """Return which of the families a kind belongs to."""
    return kind if kind in FAMILIES else "cylindrical"


def is_conical(kind: str) -> bool:
    """Return whether the rollers are cones.

    Their clearance is set when mounting.
    """
    return family_of(kind) == "tapered"


def kind_words(kind: str) -> str:
    """Return a kind as texts have it.

    Such as tapered, needle, cylindrical NU.
    """
    family = family_of(kind)
    return family if family == kind else f"{family} {kind}"


# Assumed where nothing is known of the ends: the rib opens by half a degree, and a tapered roller's sphere end has 0.9
# of the distance to the apex (0.8 to 0.95 are usual: Machines 2025, 13, 910) and touches a third of its radius high.
_RIB_OPENING = math.radians(0.5)
_END_RATIO, _CONTACT_SHARE = 0.9, 1.0 / 3.0


@dataclass(frozen=True)
class Rib:
    """A rib in the plane of a roller."""

    ring: Ring
    end: int  # -1 or 1, the roller's end along a
    place: tuple[float, float]  # of the contact from the roller's centre (a, r) [m]
    normal: tuple[float, float]  # of its force on the roller, a unit vector
    gap: float  # axial gap of a roller in the middle [m]
    contact: RibContact  # height and reduced radii


@dataclass(frozen=True)
class RollerBearing:
    """One row of rollers, SI.

    Attributes
    ----------
    kind : str
        One of :data:`RIBS`.
    count : int
        Rollers Z.
    diameter, length, effective_length : float
        Mean roller diameter D_we, length of the roller and of its contacts L_we [m].
    pitch_diameter : float
        D_pw at the middle of the rollers [m].
    contact_angle : float
        Of the outer raceway [rad]; zero for cylindrical and needle rollers.
    bore, outside, width : float
        Boundary dimensions d, D and B or T [m].
    dynamic_rating, static_rating, fatigue_limit : float
        C_r, C_0r and C_u [N].
    clearance : float
        Radial clearance [m]; of tapered bearings it is set when mounting and stays zero here.
    end_play : float
        Of the roller between two ribs [m].
    rib_height : float
        Of the ribs of cylindrical rollers [m].
    contact_height : float
        Of the rib contact above the inner generatrix of tapered rollers [m]; 0: a third of the end's radius.
    end_radius : float
        Of the roller's end faces [m]; 0: 0.9 of the distance to the apex, or what the opening of the ribs asks for.
    profile : {"iso", "none", "logarithmic", "crowned", "two-radii", "tabulated"}
        Of the roller.
    profile_scale, profile_length, profile_exponent : float
        A, L and k of the logarithmic profile [m, m, -], Teutsch's a_p D, c_p and k_p; of two radii L is the middle's.
    profile_radius, profile_middle_radius : float
        Of the crown or of both ends, and of the middle of two radii [m].
    profile_points : tuple of (float, float)
        Distance from the middle and drop [m], from zero to the end of the contact.
    rib_roughness : float
        Composite rms roughness of ribs and ends [m]: Wingertszahn et al. 2023, Lubricants 11, 369.
    faces : int
        Direction of a along x of the shaft, 1 or -1: where thrust on the shaft points that presses the rollers.
    limiting_speed : float or None
        Of the catalogue [rad/s].
    caged : bool
        Whether a cage keeps the rollers apart, where the kind has one.
    inner_waves, outer_waves : RingWaves or None
        How the rings bend; None: they are rigid.
    moduli : tuple of float
        E' of the rollers with the inner and with the outer ring [Pa]; default: the steel behind ISO 16281.
    density : float
        Of the rollers [kg/m3].
    """

    kind: str
    count: int
    diameter: float
    length: float
    effective_length: float
    pitch_diameter: float
    bore: float
    outside: float
    width: float
    dynamic_rating: float
    static_rating: float
    fatigue_limit: float
    contact_angle: float = 0.0
    clearance: float = 0.0
    end_play: float = 50e-6
    rib_height: float = 0.0
    contact_height: float = 0.0
    end_radius: float = 0.0
    profile: profiles.Name = "iso"
    profile_scale: float = 0.0
    profile_length: float = 0.0
    profile_exponent: float = 2.0
    profile_radius: float = 0.0
    profile_middle_radius: float = math.inf
    profile_points: tuple[tuple[float, float], ...] = ()
    rib_roughness: float = 0.24e-6
    series: str = ""
    faces: int = 1
    limiting_speed: float | None = None
    caged: bool = True
    inner_waves: RingWaves | None = None
    outer_waves: RingWaves | None = None
    moduli: tuple[float, float] = (STEEL_MODULUS, STEEL_MODULUS)
    density: float = 7850.0

    def __post_init__(self) -> None:
        """Refuse what cannot be built.

        Raises
        ------
        ValueError
            With the dimension and what is allowed.
        """
        if self.kind not in RIBS:
            raise ValueError(unknown_name("kind of roller bearing", self.kind, RIBS))
        if (self.kind == "tapered") != (self.contact_angle > 0.0):
            raise ValueError("`contact_angle` must be above zero for tapered bearings and zero for all others")
        if not 0.0 < self.effective_length <= self.length:
            raise ValueError("`effective_length` must be above zero and at most the roller's length")
        if self.room < 0.0:
            raise ValueError(f"{self.count} rollers of {1e3 * self.diameter:g} mm do not fit on the pitch circle")

    @property
    def full_complement(self) -> bool:
        """True without a cage."""
        return self.kind in FULL_COMPLEMENT or not self.caged

    @property
    def family(self) -> str:
        """One of :data:`FAMILIES`."""
        return family_of(self.kind)

    @property
    def passes_thrust(self) -> bool:
        """True where ribs of both rings pass thrust on."""
        return {("inner", -1), ("outer", 1)} <= {*RIBS[self.kind]}

    @property
    def is_conical(self) -> bool:
        """True with tapered rollers."""
        return is_conical(self.kind)

    @property
    def room(self) -> float:
        """Circumferential clearance [m].

        The arc of the pitch circle that touching rollers leave free.
        Neighbours that touch stand 2 asin(D_we/D_pw) apart (Harris and Kotzalas, vol. 1, ch. 2: chords); cones of half
        angle b about axes at angle g to the bearing's 2 asin(sin(b)/sin(g)) (spherical triangle at their apex).
        """
        chord = self.diameter * math.cos(self.angles.half)
        return (math.pi - self.count * math.asin(chord / self.pitch_diameter)) * self.pitch_diameter

    @property
    def mean_diameter(self) -> float:
        """(d + D)/2 [m]."""
        return 0.5 * (self.bore + self.outside)

    @property
    def angles(self) -> TaperedAngles:
        """Angles of the raceways; zero for cylindrical rollers."""
        if self.contact_angle == 0.0:
            return TaperedAngles(0.0, 0.0)
        return tapered_angles(self.diameter, self.pitch_diameter, self.contact_angle)

    @property
    def centre(self) -> float:
        """Distance of a roller's centre from the bearing's axis [m]."""
        return 0.5 * self.pitch_diameter

    @property
    def mass(self) -> float:
        """Mass of a roller [kg]."""
        return self.density * 0.25 * math.pi * self.diameter**2 * self.length

    @property
    def inertias(self) -> tuple[float, float]:
        """Moments of inertia of a roller [kg m2].

        Polar and transverse, of a cylinder of its mean diameter.
        """
        return self.mass * self.diameter**2 / 8.0, self.mass * (self.diameter**2 / 16.0 + self.length**2 / 12.0)

    def modulus(self, ring: Ring) -> float:
        """Return E' of the rollers with a ring [Pa]."""
        return self.moduli[0 if ring == "inner" else 1]

    def radius(self, ring: Ring) -> float:
        """Return the reduced radius of a raceway contact [m].

        It holds at the roller's middle, across the generatrix.

        1/R = 1/R_1 -+ 1/R_2 with the radii of curvature normal to the generatrix: cones of radius r at the contact have
        r/cos(angle) (Harris and Kotzalas, vol. 1, ch. 2).
        """
        angles = self.angles
        roller = 0.5 * self.diameter / math.cos(angles.half)
        lever = 0.5 * self.diameter * math.cos(angles.roller)
        if ring == "inner":
            return 1.0 / (1.0 / roller + math.cos(angles.inner) / (self.centre - lever))
        return 1.0 / (1.0 / roller - math.cos(angles.outer) / (self.centre + lever))

    def drops(self, slices: int) -> FloatArray:
        """Return the profile drop over the slices [m].

        It is that of the roller; the array has shape (slices,).
        """
        x = slice_positions(self.effective_length, slices)
        if self.profile == "none":
            return np.zeros(slices)
        if self.profile == "logarithmic":
            length = max(self.profile_length, self.effective_length)
            return profiles.logarithmic(x, length, self.profile_scale, exponent=self.profile_exponent)
        if self.profile == "crowned":
            return profiles.crowned(x, self.profile_radius)
        if self.profile == "two-radii":
            return profiles.two_radii(x, self.profile_length, self.profile_middle_radius, self.profile_radius)
        if self.profile == "tabulated":
            places, drops = zip(*self.profile_points, strict=True)
            return profiles.tabulated(np.abs(x), places, drops)
        if self.kind == "tapered":
            return profiles.iso_tapered(x, self.effective_length, self.diameter, self.angles.half)
        return profiles.iso_cylindrical(x, self.effective_length, self.diameter)

    @property
    def ribs(self) -> tuple[Rib, ...]:
        """Ribs that guide the rollers."""
        if self.kind == "tapered":
            return (self._cone_rib(),)
        return tuple(self._plane_rib(ring, end) for ring, end in RIBS[self.kind] if self.rib_height > 0.0)

    def _cone_rib(self) -> Rib:
        """Return the tapered roller's rib.

        It is at the large end.
        """
        angles = self.angles
        large = self.diameter + 2.0 * math.tan(angles.half) * 0.5 * self.length
        apex = 0.5 * self.diameter / math.tan(angles.half)  # from the roller's middle, along its axis
        height = self.contact_height or _CONTACT_SHARE * 0.5 * large
        radius = self.end_radius or _END_RATIO * (apex + 0.5 * self.length)
        contact = rib_contact(angles, large, radius, height)
        inner, axis, theta = angles.inner, angles.roller, contact.normal
        along = np.array([-math.cos(inner), math.sin(inner)])  # generatrix, towards the large end
        across = np.array([math.sin(inner), math.cos(inner)])  # from there towards the roller's axis
        sphere = (apex + 0.5 * self.length - radius) * math.cos(angles.half)  # of its centre from the apex
        beyond = sphere + radius * math.cos(theta) - apex / math.cos(angles.half)
        middle = -0.5 * self.diameter * np.array([math.sin(axis), math.cos(axis)])
        place = middle + beyond * along + height * across
        normal = -(math.cos(theta) * along + math.sin(theta) * across)
        return Rib("inner", -1, (float(place[0]), float(place[1])), (float(normal[0]), float(normal[1])), 0.0, contact)

    def _plane_rib(self, ring: Ring, end: int) -> Rib:
        """Return a rib of cylindrical rollers.

        The end touches in the middle of its height.
        """
        height = 0.5 * self.rib_height
        lever = 0.5 * self.diameter - height
        radius = self.end_radius or lever / math.sin(_RIB_OPENING)
        side = -1.0 if ring == "inner" else 1.0
        distance = self.centre + side * lever
        sine = lever / radius  # of the rib's opening: the sphere's normal there
        cosine = math.sqrt(1.0 - sine * sine)
        contact = RibContact(height, 0.0, distance, radius, radius, radius)
        place = (end * (0.5 * self.length - radius * (1.0 - cosine)), side * lever)
        return Rib(ring, end, place, (-end * cosine, -side * sine), 0.5 * self.end_play, contact)

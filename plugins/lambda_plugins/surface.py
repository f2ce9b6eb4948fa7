"""Define waviness and local defects of a raceway.

Heights count along the surface's normal, towards the ball; azimuth and contact angle are places on the raceway, which
turns with its ring. The penetration of ball and raceway grows by the height, so a rigid surface does work on the
balls, and its reaction on the ring: what a wavy ring puts into the balls comes out of its drive.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

import numpy as np

from lambda_core.plugins import OK, Context, FloatArray, NoParameters, Parameters, Quantity, law, parameter
from lambda_plugins.shapes import at_least, smooth_min

Angle = Annotated[float, Quantity("angle")]
Length = Annotated[float, Quantity("length")]
SmallLength = Annotated[float, Quantity("small_length")]

_MEASURED = "no value of its own: measured on the ring"


@law("surface", "none", role_api=3, reference="-")
def none(azimuth: float, contact_angle: float, par: NoParameters, out: FloatArray) -> int:
    """Nominal raceway."""
    out[0] = 0.0
    out[1] = 0.0
    out[2] = 0.0
    return OK


class Harmonic(Parameters):
    """One harmonic of waviness."""

    waves: int = parameter(..., "waves per circumference", ge=1, le=2000)
    amplitude: SmallLength = parameter(..., "amplitude of the wave, half its peak to valley", ge=0.0)
    phase: Angle = parameter("0 deg", "azimuth of a crest on the ring at the start", status="numerical")
    axial_share: float = parameter(
        0.0,
        "direction in which the groove is displaced: 0 radially, towards the balls; 1 and -1 along the axis",
        source="Wardle 1988 has radial and axial waviness as the two components of the groove's path",
        status="numerical",
        ge=-1.0,
        le=1.0,
    )


class Waviness(Harmonic):
    """Parameters of waviness: a first harmonic and any additional ones."""

    amplitude: SmallLength = parameter(
        "1 um", "amplitude of the wave, half its peak to valley", source=_MEASURED, status="assumed", ge=0.0
    )
    waves: int = parameter(8, "waves per circumference", source=_MEASURED, status="assumed", ge=1, le=2000)
    harmonics: list[Harmonic] = parameter(
        [],
        'further harmonics, each { waves = 17, amplitude = "0.1 um", phase = "40 deg", axial_share = 0.0 }',
        status="numerical",
        max_length=100,
    )


class Waves(NamedTuple):
    """Every harmonic, one after the other."""

    radial: FloatArray  # amplitude towards the balls [m]
    axial: FloatArray  # amplitude along the axis [m]
    number: FloatArray  # waves per circumference
    phase: FloatArray  # [rad]


def prepare_waviness(parameters: Waviness, context: Context) -> Waves:
    """Return the harmonics in order.

    The first one stands before those of the list.
    """
    waves = (parameters, *parameters.harmonics)
    return Waves(
        np.array([wave.amplitude * math.sqrt(1.0 - wave.axial_share * wave.axial_share) for wave in waves]),
        np.array([wave.amplitude * wave.axial_share for wave in waves]),
        np.array([float(wave.waves) for wave in waves]),
        np.array([wave.phase for wave in waves]),
    )


@law(
    "surface",
    "waviness",
    Waviness,
    role_api=3,
    reference="Wardle 1988, Proc. Instn Mech. Engrs 202 C5, 305; Harsha et al. 2004, J. Sound Vib. 272, 557",
    validity="waves long against the contact ellipse; slopes small against 1",
    prepare=prepare_waviness,
)
def waviness(azimuth: float, contact_angle: float, par: Waves, out: FloatArray) -> int:
    """Waviness of a raceway by harmonics.

    w = sum over harmonics of (A_r cos alpha + A_x sin alpha) cos k (psi - phase).

    A groove whose section is displaced by A_r towards the balls and by A_x along the axis rises at contact angle alpha
    by the component along the normal: Wardle 1988, Proc. Instn Mech. Engrs 202 C5, 305 (which also gives the orders
    k = i Z and i Z +- 1 that move a ring); Harsha, Sandeep and Prakash 2004, J. Sound Vib. 272, 557. The contact
    ellipse is short against the wave.
    """
    cos_a = math.cos(contact_angle)
    sin_a = math.sin(contact_angle)
    out[0] = 0.0
    out[1] = 0.0
    out[2] = 0.0
    for i in range(par.number.size):
        wave = par.number[i] * (azimuth - par.phase[i])
        c = math.cos(wave)
        lift = par.radial[i] * cos_a + par.axial[i] * sin_a
        out[0] += lift * c
        out[1] -= lift * par.number[i] * math.sin(wave)
        out[2] += (par.axial[i] * cos_a - par.radial[i] * sin_a) * c
    return OK


class Defect(Parameters):
    """Parameters of a pit or spall."""

    width: Length = parameter(
        "1 mm", "length of the gap along rolling, edge to edge", source=_MEASURED, status="assumed", gt=0.0, le=0.05
    )
    depth: SmallLength = parameter("20 um", "depth of its floor", source=_MEASURED, status="assumed", ge=0.0)
    azimuth: Angle = parameter("-90 deg", "azimuth of its middle on the ring at the start", status="numerical")
    extent: Length | None = parameter(
        None,
        "length across rolling, to which it fades from its middle; absent: across the whole groove",
        source=_MEASURED,
        status="numerical",
        gt=0.0,
    )
    contact_angle: Angle = parameter("0 deg", "contact angle at which its middle lies", status="numerical")
    rounding: float = parameter(
        0.05,
        "length over which the ball turns from one edge to the other, and rounds the floor's corner, over the size",
        status="numerical",
        gt=0.0,
        le=0.5,
    )


class Gap(NamedTuple):
    """A defect on its raceway."""

    half_width: float  # [m]
    depth: float  # [m]
    azimuth: float  # [rad]
    per_half_extent: float  # 1 over half the length across rolling, 0 for the whole groove [1/m]
    contact_angle: float  # [rad]
    radius_x: float  # reduced radius along rolling [m]
    raceway_radius: float  # at the groove's bottom [m]
    groove_radius: float  # [m]
    rounding: float


def prepare_defect(parameters: Defect, context: Context) -> Gap:
    """Return the defect with the radii of its raceway."""
    extent = parameters.extent
    return Gap(
        0.5 * parameters.width,
        parameters.depth,
        parameters.azimuth,
        0.0 if extent is None else 2.0 / extent,
        parameters.contact_angle,
        context.radius_x,
        0.5 * context.race_diameter,
        context.groove_radius,
        parameters.rounding,
    )


@law(
    "surface",
    "defect",
    Defect,
    role_api=3,
    reference="geometry of a circle on an edge; Sawalhi and Randall 2008, Mech. Syst. Signal Process. 22, 1924",
    validity="gap longer along rolling than the contact ellipse; rigid edges",
    prepare=prepare_defect,
)
def defect(azimuth: float, contact_angle: float, par: Gap, out: FloatArray) -> int:
    """Gap in the raceway that a rigid ball crosses.

    The ball turns about the edge behind, then about the edge ahead.

    At the distance e from the nearer edge the ball's centre has dropped by e^2/(2 R_x), at most by the depth: geometry
    of a circle on an edge, entry and exit of Sawalhi and Randall 2008, Mech. Syst. Signal Process. 22, 1924. Floor,
    and change of edge in the middle, where the ball is struck, are rounded. Across the groove the drop fades to the
    ends of the defect as (1 - s^2)^2.
    """
    turn = azimuth - par.azimuth
    turn -= 2.0 * math.pi * math.floor(turn / (2.0 * math.pi) + 0.5)
    x = par.raceway_radius * turn
    out[0] = 0.0
    out[1] = 0.0
    out[2] = 0.0
    if abs(x) >= par.half_width:
        return OK
    s = par.groove_radius * (contact_angle - par.contact_angle) * par.per_half_extent
    if abs(s) >= 1.0:
        return OK
    fade = (1.0 - s * s) * (1.0 - s * s)
    bend = par.rounding * par.half_width
    away = math.sqrt(x * x + bend * bend)
    edge = math.sqrt(par.half_width * par.half_width + bend * bend) - away
    free = 0.5 * edge * edge / par.radius_x
    corner = par.rounding * par.depth
    drop = smooth_min(free, par.depth, corner)
    # d(smooth_min)/d(free): 1 before the corner, 0 behind it
    share = at_least(1.0 - at_least(free - par.depth + corner, 0.0) / (2.0 * corner + 1e-300), 0.0)
    out[0] = -fade * drop
    out[1] = fade * share * edge / par.radius_x * x / away * par.raceway_radius
    out[2] = 4.0 * (1.0 - s * s) * s * par.per_half_extent * par.groove_radius * drop
    return OK

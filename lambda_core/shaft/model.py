"""A shaft in bearings, resolved: everything that its equilibrium needs, SI, immutable."""

from __future__ import annotations

from dataclasses import dataclass

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.gear_forces import GearForces
from lambda_core.elastic.body import ElasticBody
from lambda_core.system.bearing import ZERO, BearingModel, TimeFunction

PLACES = (0, 1, 2, 4, 5)  # of a pose (solver.drivers.held_ring) among the six rows of a node


@dataclass(frozen=True)
class Seating:
    """How an outer ring sits in the housing, in the order of POSE.

    Attributes
    ----------
    stiffness : tuple of 5 floats
        Of the housing, [N/m] and [N m/rad]; inf where locked, 0 where free.
    shift : tuple of 5 floats
        Where the ring stands before any load against its drawn place [m, rad].
    force : float
        Of a spring on the outer ring along x [N].
    """

    stiffness: tuple[float, ...]
    shift: tuple[float, ...]
    force: float = 0.0


@dataclass(frozen=True)
class MountedBearing:
    """A bearing at its place on the shaft."""

    name: str
    position: float  # [m]
    model: BearingModel
    seating: Seating
    takes: int  # axial force on the shaft that it can take: +1, -1, 0 for both
    nominal_angle: float  # contact angle of its ratings [rad]
    dynamic_rating: float  # C [N]
    static_rating: float  # C_0 [N]
    fatigue_limit: float  # C_u [N]


@dataclass(frozen=True)
class Unbalance:
    """A mass that turns with the shaft beside its axis."""

    position: float  # [m]
    amount: float  # mass times eccentricity [kg m]
    angle: float  # azimuth at t = 0, from +y to +z [rad]


@dataclass(frozen=True)
class ShaftSpring:
    """Spring and damper between shaft and ground."""

    name: str
    position: float  # [m]
    stiffness: tuple[float, ...]  # over PLACES [N/m, N m/rad]
    damping: tuple[float, ...]  # likewise [N s/m, N m s/rad]


@dataclass(frozen=True)
class ShaftModel:
    """Shaft, bearings and loads.

    Attributes
    ----------
    body : ElasticBody
        The shaft with its discs.
    bearings : tuple of MountedBearing
        From left to right.
    loads : float64[:], shape (6 n,)
        Nodal forces of loads and gears [N, N m].
    weight : float64[:], shape (6 n,)
        Of shaft and discs [N, N m].
    growth : float64[:], shape (6 n,)
        Forces that stretch the shaft as much as its temperature does [N].
    housing : float64[:, :], shape (5 bearings, 5 bearings), or None
        Stiffness between all outer rings in an elastic housing, zeros where a ring is free; None: rigid seats.
    drive : int
        Row of the turning of the node that the coupling holds.
    outline, discs, load_places, wheels
        What a drawing shows.
    unbalances : tuple of Unbalance
        Of the discs; they count in motion.
    speed_over_time : TimeFunction
        Of the shaft [rad/s].
    springs : tuple of ShaftSpring
        Between shaft and ground.
    """

    name: str
    body: ElasticBody
    bearings: tuple[MountedBearing, ...]
    loads: FloatArray
    weight: FloatArray
    growth: FloatArray
    housing: FloatArray | None
    gravity: tuple[float, float, float]  # [m/s2]
    drive: int
    speed: float  # at t = 0 [rad/s]
    contamination: float | None  # e_C of ISO 281
    gears: dict[str, GearForces]  # forces of each mesh, by name
    assumptions: tuple[str, ...]
    outline: tuple[tuple[float, float, float, float], ...]  # begin, end, diameter, bore of each section [m]
    discs: tuple[tuple[str, float], ...]  # name and position [m]
    load_places: tuple[tuple[str, float], ...]  # of loads and gears [m]
    wheels: tuple[tuple[str, float, float], ...] = ()  # of gears: name, position, pitch diameter [m]
    unbalances: tuple[Unbalance, ...] = ()
    speed_over_time: TimeFunction = ZERO
    varying: tuple[tuple[int, TimeFunction], ...] = ()  # row of a node and its load over time, in place of `loads`
    twists: bool = False  # in motion
    springs: tuple[ShaftSpring, ...] = ()
    case_toml: str = ""  # the case, complete: it runs again as it stands

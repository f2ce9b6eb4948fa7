"""Define the resolved model of a shaft in bearings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, NamedTuple

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.body import ElasticBody
from lambda_core.formulas.gear_forces import GearForces
from lambda_core.model.bearing_model import ZERO, BearingModel, ElectricModel, Solver, TimeFunction
from lambda_core.model.laws.time_functions import initial
from lambda_core.model.settings.machine_heat import MachineHeat

PLACES = (0, 1, 2, 4, 5)  # of a pose (solver.drivers.bearing_reaction) among the six rows of a node
# [N/m] of a seat that is locked in a body that moves: a hundred to a thousand times as stiff as a bearing
LOCKED = 1e11
GROUND, SHAFT = -1, 0  # numbers of bodies; the others follow


@dataclass(frozen=True)
class Seating:
    """Seat of an outer ring in the housing.

    Its values have the order of POSE.

    Attributes
    ----------
    stiffness : tuple of 5 floats
        Of the housing, [N/m] and [N m/rad]; inf where locked, 0 where free.
    shift : tuple of 5 floats
        Where the ring stands before any load against its drawn place [m, rad].
    force : float
        Of a spring on the outer ring along x [N].
    damping : tuple of 5 floats
        Of the seat [N s/m, N m s/rad].
    prescribed : tuple of 5 TimeFunction
        `shift` over time, which is its value at t = 0.
    """

    stiffness: tuple[float, ...]
    shift: tuple[float, ...]
    force: float = 0.0
    damping: tuple[float, ...] = (0.0,) * 5
    prescribed: tuple[TimeFunction, ...] = (ZERO,) * 5


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
    carrier: int = GROUND  # body that the outer ring sits in

    @property
    def is_locked_along(self) -> bool:
        """True if its seat holds the ring axially."""
        return self.seating.stiffness[0] >= LOCKED


@dataclass(frozen=True)
class Unbalance:
    """A mass that turns with the shaft off its axis."""

    position: float  # [m]
    amount: float  # mass times eccentricity [kg m]
    angle: float  # azimuth at t = 0, from +y to +z [rad]


class BearingPart(NamedTuple):
    """Ring or cage as a body.

    An outer ring or a cage of a bearing that carries a place.
    """

    bearing: str
    part: Literal["outer_ring", "cage"]


Carrier = int | BearingPart  # the number of a body, or a part of a bearing


@dataclass(frozen=True)
class Place:
    """A point of a body, and axes there."""

    body: Carrier
    point: tuple[float, float, float]  # where it is drawn, from the left end of the shaft's axis [m]
    axes: FloatArray  # as columns, shape (3, 3)

    @property
    def turn(self) -> FloatArray:
        """Transformation of motions to its axes.

        The matrix of shape (6, 6) leads there from the axes of the case.
        """
        return np.asarray(np.kron(np.eye(2), self.axes.T))


def is_on_cage(place: Place) -> bool:
    """Tell whether a place is on a cage.

    The equilibrium of a shaft has no cages.
    """
    return isinstance(place.body, BearingPart) and place.body.part == "cage"


@dataclass(frozen=True)
class MachineSpring:
    """Spring and damper between two bodies.

    They act at one point; one body may be the ground.
    """

    name: str
    place: Place  # of the one body
    to: Carrier  # the other one
    stiffness: FloatArray  # against the motions and turns of one against the other there, shape (6, 6)
    damping: FloatArray


@dataclass(frozen=True)
class MachineLink:
    """Connection between two places by a law.

    The law's force acts on the second one.
    """

    name: str
    element: str  # its law among those of the first bearing
    first: Place
    second: Place


@dataclass(frozen=True)
class ShaftHold:
    """Rigid ground constraint of the shaft."""

    position: float  # [m]
    prescribed: tuple[TimeFunction | None, ...]  # in the order of POSE [m, rad]; None where it does not hold

    @property
    def held(self) -> tuple[int, ...]:
        """Places in POSE that are held."""
        return tuple(i for i, lead in enumerate(self.prescribed) if lead is not None)

    @property
    def shift(self) -> tuple[float, ...]:
        """Displacement of the constraint at t = 0.

        0 where it is free [m, rad].
        """
        return tuple(0.0 if lead is None else initial(lead) for lead in self.prescribed)


class Resistance(NamedTuple):
    """Load that brakes the shaft.

    The load is proportional to the shaft's speed.
    """

    position: float  # [m]
    damping: float  # [N m s]


@dataclass(frozen=True)
class RigidBody:
    """A rigid body other than the shaft, SI."""

    name: str
    centre: tuple[float, float, float]  # of mass, from the left end of the shaft's axis [m]
    mass: float  # [kg]
    polar_inertia: float  # about x [kg m2]
    transverse_inertia: float  # about y and about z [kg m2]
    hold: tuple[float, ...]  # stiffness of what holds the centre, six; inf where locked, 0 where free [N/m, N m/rad]
    extent: tuple[float, float, float]  # length, width, height of its shape, zeros where there is none [m]
    prescribed: tuple[TimeFunction, ...] = (ZERO,) * 6  # motion of its locked directions [m, rad]
    damping: tuple[float, ...] = (0.0,) * 6  # of what holds the centre [N s/m, N m s/rad]

    @property
    def shift(self) -> tuple[float, ...]:
        """Its prescribed pose at t = 0 [m, rad]."""
        return tuple(map(initial, self.prescribed))


@dataclass(frozen=True)
class MachineModel:
    """Shaft, bearings and loads.

    Attributes
    ----------
    body : ElasticBody
        The shaft with its discs.
    bearings : tuple of MountedBearing
        From left to right.
    loads : float64[:], shape (rows of the shaft + 6 bodies,)
        Nodal forces of loads and gears, then forces and moments on the bodies about their centres [N, N m].
    weight : float64[:], likewise
        Of shaft with discs, and bodies [N, N m].
    growth : float64[:], likewise
        Forces that stretch the shaft as much as its temperature does [N].
    housing : float64[:, :], shape (5 bearings, 5 bearings), or None
        Stiffness between all outer rings in an elastic housing, zeros where a ring is free; None: rigid seats.
    housing_damping : float64[:, :], likewise
    drive : int
        Row of the turning of the node that the coupling holds.
    outline, discs, load_places, wheels
        What a drawing shows.
    unbalances : tuple of Unbalance
        Of the discs; they count in motion.
    speed_over_time : TimeFunction
        Of the shaft [rad/s].
    springs : tuple of MachineSpring
        Between shaft, bodies and ground.
    links : tuple of MachineLink
        Connections by laws.
    hold : ShaftHold or None
        Where the ground holds the shaft.
    resistance : Resistance or None
        To the rotation of the shaft.
    bodies : tuple of RigidBody
        In addition to the shaft.
    markers : tuple of (str, Place)
        Named places.
    part_loads : dict of BearingPart to six TimeFunction
        Forces and moments on outer rings and cages about their centres [N, N m].
    heat : MachineHeat
        The thermal network.
    awaits_temperatures : bool
        Whether they are to be computed before anything else.
    found_temperatures : object
        How the temperatures of the case answer to changes, where its network found them; None: they are given.
    warnings : tuple of str
        What cannot stand on the shaft as it is drawn.
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
    heat: MachineHeat
    speed: float  # at t = 0 [rad/s]
    gears: dict[str, GearForces]  # forces of each mesh, by name
    assumptions: tuple[str, ...]
    outline: tuple[tuple[float, float, float, float], ...]  # begin, end, diameter, bore of each section [m]
    discs: tuple[tuple[str, float], ...]  # name and position [m]
    load_places: tuple[tuple[str, float], ...]  # of loads and gears [m]
    wheels: tuple[tuple[str, float, float], ...] = ()  # of gears: name, position, pitch diameter [m]
    unbalances: tuple[Unbalance, ...] = ()
    speed_over_time: TimeFunction = ZERO
    varying: tuple[tuple[int, TimeFunction], ...] = ()  # row of `loads` and its value over time
    twists: bool = False  # in motion
    torque: TimeFunction | None = None  # of the coupling, in motion; None: it prescribes the speed
    springs: tuple[MachineSpring, ...] = ()
    links: tuple[MachineLink, ...] = ()
    hold: ShaftHold | None = None
    resistance: Resistance | None = None
    bodies: tuple[RigidBody, ...] = ()
    markers: tuple[tuple[str, Place], ...] = ()
    part_loads: Mapping[BearingPart, tuple[TimeFunction, ...]] = field(default_factory=dict)
    housing_damping: FloatArray | None = None
    awaits_temperatures: bool = False
    found_temperatures: Any = field(default=None, compare=False, repr=False)
    warnings: tuple[str, ...] = ()
    electric: ElectricModel | None = None  # circuit of shaft and frame
    case_toml: str = ""  # the case, complete: it runs again as it stands

    @property
    def prescribed_motions(self) -> list[TimeFunction]:
        """Prescribed motions of shaft, seats and bodies."""
        seats = [lead for mounted in self.bearings for lead in mounted.seating.prescribed]
        shaft = [lead for lead in self.hold.prescribed if lead is not None] if self.hold else []
        parts = [body for mounted in self.bearings for body in (mounted.model.outer_ring, mounted.model.cage_body)]
        own = [dof.motion for part in parts for dof in part.dofs.values() if dof.mode == "prescribed"]
        return [self.speed_over_time, *seats, *(lead for body in self.bodies for lead in body.prescribed), *shaft, *own]

    @property
    def bearing_models(self) -> dict[str, BearingModel]:
        """Models of the bearings by name, from left to right."""
        return {bearing.name: bearing.model for bearing in self.bearings}

    @property
    def surroundings(self) -> tuple[str, ...]:
        """Its case, which decides numbers besides the bearings."""
        return (self.case_toml,)

    def with_each(self, change: Callable[[BearingModel], BearingModel]) -> MachineModel:
        """Return the machine with the model of each bearing changed."""
        return replace(self, bearings=tuple(replace(one, model=change(one.model)) for one in self.bearings))

    @property
    def solver(self) -> Solver:
        """Common settings of the integrator.

        Each bearing has its own longest step and time.
        """
        return self.bearings[0].model.solver

    @property
    def held_places(self) -> tuple[float, ...]:
        """Places of springs and drive on the shaft [m].

        Springs, connections, supports and a driving torque act there.
        """
        springs = [s.place.point[0] for s in self.springs if SHAFT in (s.place.body, s.to)]
        ends = [end.point[0] for link in self.links for end in (link.first, link.second) if end.body == SHAFT]
        drive = [] if self.torque is None else [float(self.body.positions[self.drive // 6])]
        holds = [one.position for one in (self.hold, self.resistance) if one is not None]
        return (*springs, *ends, *holds, *drive)

    @property
    def has_changing_torque(self) -> bool:
        """True if torques on the shaft change over time."""
        return any(row < 6 * self.body.positions.size and row % 6 == 3 for row, _ in self.varying)

    def index(self, part: BearingPart) -> int:
        """Return the bearing's number of a part."""
        return next(i for i, bearing in enumerate(self.bearings) if bearing.name == part.bearing)

    def load_on(self, part: BearingPart) -> tuple[TimeFunction, ...]:
        """Return force and moment on a part.

        The part is an outer ring or a cage; the units are N and N m.
        """
        return self.part_loads.get(part, (ZERO,) * 6)

    @property
    def names(self) -> dict[str, list[str]]:
        """Of bearings, bodies and markers."""
        return {
            "bearings": [bearing.name for bearing in self.bearings],
            "bodies": [body.name for body in self.bodies],
            "markers": [name for name, _ in self.markers],
        }

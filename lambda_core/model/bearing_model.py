"""Define the resolved model of a bearing.

Frames: x is the shaft axis, y horizontal, z up; gravity acts along -z; azimuth runs from
+y towards +z. A body's six degrees of freedom are ``x, y, z`` (position of its centre),
``tilt_y, tilt_z`` (rotation about y and z) and ``spin`` (rotation about its own axis).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

from lambda_core.case.requirements import Requirements
from lambda_core.domain.elements import SPIN
from lambda_core.domain.value_status import ValueStatus

if TYPE_CHECKING:
    from pydantic import BaseModel

    from lambda_core.case.case import Case
    from lambda_core.case.electric import Electric
    from lambda_core.case.thermal import Thermal
    from lambda_core.domain.elements import BodyName
    from lambda_core.domain.lubrication import Lubrication
    from lambda_core.elements.ball.geometry import Geometry
    from lambda_core.elements.roller.roller_bearing import RollerBearing
    from lambda_core.formulas.elastic.ring import RingWaves
    from lambda_core.formulas.fits import Mounting
    from lambda_core.laws.context import Material, Oil
    from lambda_core.laws.law import Law
    from lambda_core.views.observer import Action, Event, Observer


@dataclass(frozen=True)
class Term:
    """One summand of a time function, SI.

    kind and values: constant (v,) | ramp (v_0, v_1, t_0, t_1) | harmonic (amplitude, frequency [Hz],
    phase [rad]): amplitude * sin(2 pi f t + phase) | table (t_0, v_0, t_1, v_1, ...), cubics
    through the points (held constant outside).
    """

    kind: Literal["constant", "ramp", "harmonic", "table", "law"]
    values: tuple[float, ...]


@dataclass(frozen=True)
class TableTerm(Term):
    """Points of a table and their curve.

    lambda_core.model.laws.interpolation joins them.
    """

    interpolation: Literal["monotone", "spline"] = "monotone"


@dataclass(frozen=True)
class LawTerm(Term):
    """Time function by a law.

    The term is amplitude * f(t). Its values are the amplitude, f at t = 0, the largest |f| and its highest frequency
    [Hz].
    """

    law: str = ""  # the element of it among the laws of a model, "time.loads.radial"


@dataclass(frozen=True)
class TimeFunction:
    """Sum of terms; no terms means zero."""

    terms: tuple[Term, ...] = ()

    @staticmethod
    def constant(value: float) -> TimeFunction:
        """Return the function that is `value` at all times."""
        return TimeFunction((Term("constant", (value,)),))


ZERO = TimeFunction()
USUAL_RESOLVE = 2000.0  # [Hz]; modes of a ring between the raceways of bearings of usual size lie below


@dataclass(frozen=True)
class DofState:
    """State of one degree of freedom of a body."""

    mode: Literal["free", "locked", "prescribed"]
    # prescribed: position [m] or angle [rad] over time; for spin: angular speed [rad/s] over time. A free spin:
    # its value at t = 0 is the initial speed
    motion: TimeFunction = ZERO
    stiffness: float = 0.0  # elastic support to ground, [N/m] or [N m/rad]
    damping: float = 0.0  # [N s/m] or [N m s/rad]


@dataclass(frozen=True)
class Body:
    """Rigid, axisymmetric body.

    It is an inner ring with its shaft, an outer ring with its housing, or a cage.
    """

    mass: float  # [kg]
    transverse_inertia: float  # about a diameter [kg m2]
    polar_inertia: float  # about its axis [kg m2]
    dofs: Mapping[str, DofState]  # by name in DOFS
    force: tuple[TimeFunction, TimeFunction, TimeFunction] = (ZERO, ZERO, ZERO)  # inertial frame [N]
    # about x, y, z through the body's centre; about x it drives a free spin [N m]
    moment: tuple[TimeFunction, TimeFunction, TimeFunction] = (ZERO, ZERO, ZERO)
    unbalance: float = 0.0  # mass times eccentricity [kg m]

    def freed(self, names: Iterable[str]) -> Body:
        """Return the body free in some directions.

        Its spin has the speed planned for it: laws are set up for that.
        """
        free = {name: DofState("free", self.dofs[name].motion if name == SPIN else ZERO) for name in names}
        return replace(self, dofs={**self.dofs, **free})


@dataclass(frozen=True)
class Cage:
    """Geometry of the cage, SI."""

    type: str
    pocket_clearance: float  # diametral [m]
    land_clearance: float  # diametral; NaN when guided by the balls [m]
    width: float  # [m]
    radial_thickness: float  # [m]
    guidance: Literal["ball", "inner ring", "outer ring"]
    per_row: bool = False  # each of two rows has one; sizes, mass and inertia are those of each


@dataclass(frozen=True)
class ChosenLaw:
    """Chosen model of one role.

    It belongs to one force element and has validated parameters.
    """

    model: Law
    parameters: BaseModel  # instance of model.parameters, SI
    origins: Mapping[str, str]  # parameter -> "case" | "lubricant NAME (source, grade)" | "default"


@dataclass(frozen=True)
class ElectricModel:
    """Electric circuit of the bearing.

    It has the laws of its films.
    """

    options: Electric  # the section of the case
    laws: Mapping[str, ChosenLaw]  # role -> law


@dataclass(frozen=True)
class ChosenObserver:
    """An observer of a plugin, with validated parameters."""

    item: Observer
    parameters: BaseModel  # instance of item.parameters, SI


@dataclass(frozen=True)
class ChosenEvent:
    """Event of a plugin with the run's reaction.

    It has validated parameters.
    """

    item: Event
    parameters: BaseModel  # instance of item.parameters, SI
    action: Action


@dataclass(frozen=True)
class Depth:
    """Modelling depth.

    It sets which parts move, and how finely a contact is divided.
    """

    cage: bool
    strips: int  # strips across the ellipse (along the major axis)
    rows: int  # cells along rolling in each strip; 1 is the slice model of the paper


@dataclass(frozen=True)
class Solver:
    """Settings of the integrator and of the averages."""

    tolerance: float  # dimensionless; multiplies the absolute scales of the states
    duration: float  # simulated time; 0 means "until converged or max_duration" [s]
    max_duration: float  # [s]
    discard_revolutions: float  # cage revolutions before averaging starts
    average_revolutions: float  # cage revolutions that the averages need at least
    max_step: float  # [s]
    max_wall: float  # wall time after which the run stops with a partial result [s], inf for none
    resolve: float = 0.0  # highest frequency that vibrations are followed to [Hz]; 0: averages are the answer


@dataclass(frozen=True)
class Output:
    """Contents and intervals of the output."""

    interval: float  # simulated time between samples; 0 means 1/100 of a cage revolution [s]
    checkpoint_interval: float  # wall time between checkpoints [s]


@dataclass(frozen=True)
class ResolvedValue:
    """One frozen number with its origin.

    A result needs it to be run again and to be believed.
    """

    path: str  # e.g. "bearing.ball_diameter"
    value: float | str
    quantity: str  # key of schema.units.UNITS, or "" for plain numbers and names
    source: str
    grade: str
    status: ValueStatus


@dataclass(frozen=True)
class Marker:
    """Named point on a body.

    Its motion is written to the result.
    """

    body: BodyName
    position: tuple[float, float, float]  # in the body's frame, that of the inertial axes at t = 0 [m]


TIME_PREFIX = "time."  # of loads and motions over time by a law, likewise
ELEMENT_PREFIX = "elements."  # of force elements between bodies, where the laws of a model name them


@dataclass(frozen=True)
class Link:
    """Force element between points on two bodies.

    Its law is among the model's laws as "elements.NAME".
    """

    first: BodyName | None  # None: the ground
    first_place: tuple[float, float, float]  # in the body's frame, that of the inertial axes at t = 0 [m]
    second: BodyName
    second_place: tuple[float, float, float]


@dataclass(frozen=True)
class BearingModel:
    """Everything that a run needs, SI, immutable.

    Attributes
    ----------
    geometry : Geometry
        Inner geometry at the clearance in operation.
    ball_material, inner_material, outer_material, cage_material : Material
        Solid properties of the parts.
    inner_ring, outer_ring, cage_body : Body
        Masses, boundary conditions and loads; the shaft counts to the inner ring.
    cage : Cage
        Its geometry.
    depth, solver, output : Depth, Solver, Output
        Settings.
    thermal : Thermal or None
        The network by which the temperatures are still to be found, before anything runs; None: they are given.
    found_temperatures : object
        How the temperatures of the case answer to changes, where its network found them; None: they are given.
    mounting : Mounting or None
        What the clearance follows from as the temperatures change.
    contradictions : tuple of str
        Where the case says two things, and which of them counts.
    electric : ElectricModel or None
        The circuit that a run computes together with the motion; it does not act on the motion.
    observers, events : mapping of str to ChosenObserver, ChosenEvent
        What plugins write of a run, and what they look out for, by name.
    links : mapping of str to Link
        Force elements between bodies, in addition to those of the bearing, by name.
    elastic : mapping of str to RingWaves
        Rings and cage that bend, in the order of BODIES.
    requirements : Requirements
        Life, safety and limits that the case asks for.
    values : tuple of ResolvedValue
        Every frozen number with its origin.
    rollers : RollerBearing or None
        The rollers that take the place of the balls; `geometry` has their count, diameter and pitch.
    """

    name: str
    title: str  # one line for people: "6319 (Syla2026)"
    geometry: Geometry
    ball_material: Material
    inner_material: Material
    outer_material: Material
    cage_material: Material
    oil: Oil  # viscosity, density, alpha_p, beta are NaN here: the physics layer derives them
    oil_level: float  # above the lowest point of the pitch circle [m]
    lubrication: Lubrication  # the way in which the oil gets to the balls
    oil_flow: float  # through the bearing [m3/s]
    roughness: float  # composite rms roughness sigma of ball and raceway [m]
    starvation: float  # factor on the film, 1 is fully flooded
    gravity: tuple[float, float, float]  # [m/s2]
    inner_ring: Body
    outer_ring: Body
    cage: Cage
    cage_body: Body
    laws: Mapping[str, Mapping[str, ChosenLaw]]  # element -> role -> law
    depth: Depth
    solver: Solver
    output: Output
    values: tuple[ResolvedValue, ...] = ()
    assumptions: tuple[str, ...] = ()
    case_toml: str = ""  # the case as written, for re-running
    plugins: tuple[str, ...] = field(default=())  # "distribution version" of each plugin that was loaded
    markers: Mapping[str, Marker] = field(default_factory=dict)  # by name
    thermal: Thermal | None = None
    mounting: Mounting | None = None
    contradictions: tuple[str, ...] = ()
    electric: ElectricModel | None = None
    observers: Mapping[str, ChosenObserver] = field(default_factory=dict)
    events: Mapping[str, ChosenEvent] = field(default_factory=dict)
    links: Mapping[str, Link] = field(default_factory=dict)
    elastic: Mapping[BodyName, RingWaves] = field(default_factory=dict)
    contamination: float | None = None  # e_C of ISO 281; None: not given
    requirements: Requirements = field(default_factory=Requirements)
    rollers: RollerBearing | None = None
    found_temperatures: Any = field(default=None, compare=False, repr=False)

    @property
    def case(self) -> Case:
        """Its case, read from the text that it keeps."""
        from lambda_core.case.case_io import bearing_case, toml_tables

        return bearing_case(toml_tables(self.case_toml, self.name))

    @property
    def warnings(self) -> tuple[str, ...]:
        """No warnings: only parts of machines can conflict."""
        return ()

    @property
    def bearing_models(self) -> dict[str, BearingModel]:
        """Itself, under the empty name.

        A machine has the same property, with the names of its bearings.
        """
        return {"": self}

    @property
    def surroundings(self) -> tuple[str, ...]:
        """Nothing: no other text decides its numbers."""
        return ()

    def with_each(self, change: Callable[[BearingModel], BearingModel]) -> BearingModel:
        """Return the model changed.

        A machine changes each of its bearings.
        """
        return change(self)

    @property
    def awaits_temperatures(self) -> bool:
        """True where temperatures are still to be computed."""
        return self.thermal is not None

    @property
    def elements(self) -> str:
        """Name of the rolling elements."""
        return "balls" if self.rollers is None else "rollers"

    @property
    def full_complement(self) -> bool:
        """True of rollers without a cage; of balls never."""
        return self.rollers is not None and not self.depth.cage

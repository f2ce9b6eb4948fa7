"""Describe bodies, bearings and ties to the solver.

A single bearing and a machine both become an :class:`Assembly`; :func:`lambda_core.solver.drivers.tables.build` writes
it down as the tables of compiled code.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.elements import BODIES, CAGE, INNER, OUTER
from lambda_core.elements.ball.raceways import raceways
from lambda_core.model.bearing_model import ELEMENT_PREFIX, BearingModel, Body
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.model.laws.state_channels import states_of
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.law_inputs import Oils
from lambda_core.solver.drivers.roller_tables import states_of_an_element
from lambda_core.solver.drivers.row_cages import further_cages
from lambda_core.solver.drivers.wave_tables import waves_of

GROUND = -1  # number of the ground among the bodies that a link connects


@dataclass(frozen=True)
class Member:
    """Rigid body with degrees of freedom.

    It has loads and supports.

    Attributes
    ----------
    name : str
    body : Body
        Displacements of a member that carries a ring are those of the ring: each bearing has its origin at its place.
    """

    name: str
    body: Body


@dataclass(frozen=True)
class AssembledBearing:
    """Bearing in an assembly.

    It has its model, the laws as they are compiled and frozen, and the members that carry its parts.

    Attributes
    ----------
    name : str
        "" for a bearing that is alone.
    model : BearingModel
        Geometry, materials, laws, elastic parts; its bodies, loads and gravity do not count.
    kernels : Kernels
    frame : ContactFrame
        At which radii and films are frozen.
    oils : tuple of 2 Oil
        As the rheology of each raceway has it.
    members : tuple of 3 ints
        That carry inner ring, outer ring and cage.
    """

    name: str
    model: BearingModel
    kernels: Kernels
    frame: ContactFrame
    oils: Oils
    members: tuple[int, int, int] = (INNER, OUTER, CAGE)


@dataclass(frozen=True)
class AssembledLink:
    """Force element between points of two members.

    It may also join a member and the ground.

    Attributes
    ----------
    bearing : int
        Among whose laws its own stands.
    element : str
        Its name there.
    first, second : int
        Members; the first may be GROUND.
    first_place, second_place : tuple of 3 floats
        Of the points, in the frames of the members [m].
    apart : tuple of 3 floats
        Where the second member's origin is drawn from the first one's [m].
    """

    bearing: int
    element: str
    first: int
    first_place: tuple[float, float, float]
    second: int
    second_place: tuple[float, float, float]
    apart: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Ties:
    """Elastic structures between members: shafts, housings, seats, springs, dampers.

    Attributes
    ----------
    member, direction : int64[:], shape (n,)
        Of each row, with the direction among x, y, z and the turns about x, y, z.
    stiffness, damping : float64[:, :], shape (n, n)
        [N/m, N, N m], [N s/m, N s, N m s].
    rest : float64[:], shape (n,)
        Where no tie is stretched [m, rad].
    """

    member: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    direction: np.ndarray = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    stiffness: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    damping: FloatArray = field(default_factory=lambda: np.zeros((0, 0)))
    rest: FloatArray = field(default_factory=lambda: np.zeros(0))

    def joins_others(self, row: int) -> bool:
        """Tell whether a row is tied to any other one."""
        matrices = (self.stiffness, self.damping)
        beyond = (np.delete(line, row) for matrix in matrices for line in (matrix[row], matrix[:, row]))
        return any(line.any() for line in beyond)


@dataclass(frozen=True)
class Assembly:
    """Everything that the compiled solver integrates.

    Attributes
    ----------
    members : tuple of Member
        In the order of the tables. Input power and mean position are those of the first, relative speed that of the
        first two.
    bearings : tuple of AssembledBearing
    gravity : tuple of 3 floats
        [m/s2].
    links : tuple of AssembledLink
    ties : Ties
    """

    members: tuple[Member, ...]
    bearings: tuple[AssembledBearing, ...]
    gravity: tuple[float, float, float]
    links: tuple[AssembledLink, ...] = ()
    ties: Ties = field(default_factory=Ties)

    def spans(self) -> tuple[BearingSpan, ...]:
        """Return where each bearing stands in tables and states."""
        found: list[BearingSpan] = []
        begin = balls = rows = grooves = states = lines = 0
        body = len(self.members)
        for bearing in self.bearings:
            model, g = bearing.model, bearing.model.geometry
            every, further = raceways(g), further_cages(model) + len(waves_of(model))
            kept = g.ball_count * sum(len(states_of(model, groove.element)) for groove in every)
            bodies, end = (
                (*bearing.members, *range(body, body + further)),
                begin + states_of_an_element(model) * g.balls,
            )
            found.append(BearingSpan(bodies, begin, end, balls, g.balls, rows, grooves, states, kept, lines))
            balls, rows, grooves, states = balls + g.balls, rows + g.rows, grooves + len(every), states + kept
            begin, lines = end, lines + (len(RINGS) if model.rollers is not None else 0)
            body += further
        return tuple(found)


@dataclass(frozen=True)
class BearingSpan:
    """Span of a bearing in tables and states.

    Attributes
    ----------
    bodies : tuple of ints
        Members that carry inner ring, outer ring and cage; then a second row's cage and the waves of elastic ones.
    begin, end : int
        Where the states of its balls begin and end in the state vector.
    first_ball, balls, first_row, first_raceway : int
    first_state, states : int
        Among what contacts keep.
    first_line : int
        Among the line contacts of all bearings.
    """

    bodies: tuple[int, ...]
    begin: int
    end: int
    first_ball: int
    balls: int
    first_row: int
    first_raceway: int
    first_state: int
    states: int
    first_line: int = 0


def assembly_of(model: BearingModel, kernels: Kernels, frame: ContactFrame, oils: Oils) -> Assembly:
    """Return the assembly of a bearing alone.

    Its rings and cage are on supports of their own; its force elements are added.
    """
    bodies = (model.inner_ring, model.outer_ring, model.cage_body)
    numbers = list(BODIES)
    return Assembly(
        tuple(Member(name, body) for name, body in zip(numbers, bodies, strict=True)),
        (AssembledBearing("", model, kernels, frame, oils),),
        model.gravity,
        tuple(
            AssembledLink(
                0, f"{ELEMENT_PREFIX}{name}", GROUND if link.first is None else numbers.index(link.first),
                link.first_place, numbers.index(link.second), link.second_place,
            )
            for name, link in model.links.items()
        ),
    )  # fmt: skip

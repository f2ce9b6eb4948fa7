"""Define an elastic body by matrices and nodes."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.beam import NODE, NODES, SPOTS, element_matrices
from lambda_core.formulas.elastic.sections import RoundSection

_SAME = 1e-7  # [m] nodes nearer than this are one


@dataclass(frozen=True)
class Disc:
    """Rigid, axisymmetric body on a shaft, SI.

    It is at one place.
    """

    position: float  # [m]
    mass: float  # [kg]
    transverse_inertia: float  # about a diameter [kg m2]
    polar_inertia: float  # about the axis [kg m2]


@dataclass(frozen=True)
class ElasticBody:
    """Matrices of an elastic body.

    Its nodes have six degrees of freedom; further coordinates follow them.

    Attributes
    ----------
    positions : float64[:], shape (n,)
        Of the nodes along x [m].
    stiffness, mass : float64[:, :], shape (6 n + m, 6 n + m)
        x, y, z and tilts about x, y, z of each node; then m coordinates that no node shows (modes).
    gyroscopic : float64[:, :]
        Times the spin about x.
    """

    positions: FloatArray
    stiffness: FloatArray
    mass: FloatArray
    gyroscopic: FloatArray
    elements: tuple[RoundSection, ...] = ()  # of a shaft, each over four nodes, the last one the next one's first
    discs: tuple[Disc, ...] = ()  # of a shaft, counted in the matrices
    names: tuple[str, ...] = ()  # of the nodes, where they have some
    lumps: tuple[int, ...] = ()  # nodes that carry the mass in motion, of a reduced model that says so
    damping: FloatArray | None = None  # where a reduced model has it [N s/m, N s, N m s]

    def node(self, position: float) -> int:
        """Return the node at a place [m].

        It is the node's number; a place without a node raises a ValueError.
        """
        if not self.has_node(position):
            raise ValueError(f"there is no node at {position:g} m")
        return int(np.argmin(np.abs(self.positions - position)))

    def has_node(self, position: float) -> bool:
        """Tell whether there is a node at a place [m]."""
        return bool(np.abs(self.positions - position).min() <= 10.0 * _SAME)

    def rows(self, position: float) -> slice:
        """Return the six rows of a place's node [m]."""
        node = self.node(position)
        return slice(NODE * node, NODE * (node + 1))

    def weight(self, gravity: Sequence[float]) -> FloatArray:
        """Return the nodal forces of gravity.

        They follow from an acceleration [m/s2] by the consistent mass; the array has shape (6 n + m,).
        """
        pull = np.zeros(self.mass.shape[0])
        for axis in range(3):
            pull[axis : NODE * self.positions.size : NODE] = gravity[axis]
        return self.mass @ pull

    @property
    def is_rigid(self) -> bool:
        """True for a body of one node."""
        return self.positions.size == 1

    def nearest(self, position: float) -> float:
        """Return the place of a point's node [m].

        The point itself has a node, or the body is rigid and has only one.
        """
        return float(self.positions[0]) if self.is_rigid else position

    @property
    def total_mass(self) -> float:
        """[kg]"""
        return float(self.weight((1.0, 0.0, 0.0))[: NODE * self.positions.size : NODE].sum())


def mesh(ends: Sequence[float], places: Sequence[float], longest: Sequence[float]) -> FloatArray:
    """Return the ends of elements [m].

    They lie at the ends of every section and at every place; no element is longer than wanted.

    Parameters
    ----------
    ends : sequence of float, length k + 1
        Where sections begin and end, rising [m].
    places : sequence of float
        Where an element has to end [m].
    longest : sequence of float, length k
        Longest element of each section [m].
    """
    wanted = np.unique(np.concatenate([ends, places]))
    fixed = wanted[np.concatenate([[True], np.diff(wanted) > _SAME])]
    nodes = [float(fixed[0])]
    for begin, end in itertools.pairwise(fixed):
        section = min(int(np.searchsorted(ends, 0.5 * (begin + end))) - 1, len(longest) - 1)
        parts = max(1, math.ceil((end - begin) / longest[section] - 1e-9))
        nodes += [float(begin + (end - begin) * (i + 1) / parts) for i in range(parts)]
    return np.array(nodes)


def elements_of(
    sections: Sequence[tuple[float, RoundSection]], places: Sequence[float], fineness: float = 1.0
) -> FloatArray:
    """Return the ends of a shaft's elements [m].

    The arguments are those of :func:`shaft_body`; discs are among the places.
    """
    return mesh(_ends(sections), places, [fineness * section.outside_diameter for _, section in sections])


def _ends(sections: Sequence[tuple[float, RoundSection]]) -> list[float]:
    return [0.0, *np.cumsum([length for length, _ in sections]).tolist()]


def shaft_body(
    sections: Sequence[tuple[float, RoundSection]],
    *,
    places: Sequence[float] = (),
    discs: Sequence[Disc] = (),
    fineness: float = 1.0,
) -> ElasticBody:
    """Return a shaft of round sections.

    The sections lie one behind the other from x = 0.

    Parameters
    ----------
    sections : sequence of (float, RoundSection)
        Length [m] and section of each.
    places : sequence of float
        Where nodes are needed: bearings, loads [m].
    discs : sequence of Disc
        Rigid bodies on it.
    fineness : float
        Longest element over the outside diameter of its section. Deflections do not depend on it; at 1 the first five
        bending modes of a shaft eight diameters long are good to 0.1 %.
    """
    ends = _ends(sections)
    marks = elements_of(sections, [*places, *(disc.position for disc in discs)], fineness)
    inside = [begin + (end - begin) * SPOTS[:-1] for begin, end in itertools.pairwise(marks)]
    nodes = np.concatenate([*inside, marks[-1:]])
    size = NODE * nodes.size
    stiffness, mass, gyroscopic = (np.zeros((size, size)) for _ in range(3))
    elements = []
    for i, (begin, end) in enumerate(itertools.pairwise(marks)):
        section = sections[min(int(np.searchsorted(ends, 0.5 * (begin + end))) - 1, len(sections) - 1)][1]
        elements.append(section)
        first = NODE * (NODES - 1) * i
        one, rows = element_matrices(section, end - begin), slice(first, first + NODE * NODES)
        stiffness[rows, rows] += one.stiffness
        mass[rows, rows] += one.mass
        gyroscopic[rows, rows] += one.gyroscopic
    return with_discs(ElasticBody(nodes, stiffness, mass, gyroscopic, tuple(elements)), discs)


def rigid_body(position: float) -> ElasticBody:
    """Return a rigid body without mass.

    It has one node at a place [m], to put discs on.
    """
    nothing = np.zeros((NODE, NODE))
    return ElasticBody(np.array([position]), nothing, nothing, nothing)


def with_discs(body: ElasticBody, discs: Sequence[Disc]) -> ElasticBody:
    """Return a body with rigid discs.

    They are at some of its nodes.
    """
    mass, gyroscopic = body.mass.copy(), body.gyroscopic.copy()
    for disc in discs:
        rows = body.rows(disc.position)
        mass[rows, rows] += disc_mass(disc)
        gyroscopic[rows.start + 4, rows.start + 5] += disc.polar_inertia
        gyroscopic[rows.start + 5, rows.start + 4] -= disc.polar_inertia
    return replace(body, mass=mass, gyroscopic=gyroscopic, discs=(*body.discs, *discs))


def disc_mass(disc: Disc) -> FloatArray:
    """Return a disc's part of the mass matrix.

    It is at its node and has shape (6, 6).
    """
    transverse = disc.transverse_inertia
    found: FloatArray = np.diag([disc.mass] * 3 + [disc.polar_inertia, transverse, transverse])
    return found


def internal_forces(
    body: ElasticBody, displacement: FloatArray, gravity: Sequence[float]
) -> tuple[FloatArray, FloatArray]:
    """Return the internal forces of every element.

    Action of the right-hand side of a cut on the left-hand side, at both ends.

    Parameters
    ----------
    body : ElasticBody
        A shaft, with its elements; one from outside has none, and the forces between its nodes are those of the nodes
        left of them.
    displacement : float64[:], shape (6 n,)
        Of its nodes [m, rad].
    gravity : sequence of float
        [m/s2]

    Returns
    -------
    float64[:], shape (2 k,)
        Places [m]; the end of one element is the beginning of the next.
    float64[:, :], shape (2 k, 6)
        Normal and shear forces [N], torque and bending moments about y and z [N m].
    """
    if not body.elements:
        return _forces_between_nodes(body, displacement)
    places, forces = [], []
    for i, section in enumerate(body.elements):
        first = (NODES - 1) * i
        nodes = slice(first, first + NODES)
        ends = body.positions[nodes][[0, -1]]
        one = element_matrices(section, float(ends[1] - ends[0]))
        pull = np.tile([*gravity, 0.0, 0.0, 0.0], NODES)
        wrench = one.stiffness @ displacement[NODE * first : NODE * (first + NODES)] - one.mass @ pull
        places += ends.tolist()
        forces += [-wrench[:NODE], wrench[-NODE:]]
    return np.array(places), np.array(forces)


def _forces_between_nodes(body: ElasticBody, displacement: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the internal forces by the nodes' balance.

    They balance the nodes on the left, each with its share of the weight.
    """
    count = NODE * body.positions.size
    at = (body.stiffness @ displacement)[:count].reshape(-1, NODE)
    places, forces = [], []
    for k, ends in enumerate(itertools.pairwise(body.positions)):
        left = -at[: k + 1].sum(axis=0)
        arms = body.positions[: k + 1, None]
        for end in ends:
            cut = left.copy()  # a force F_y at x turns about z by F_y (x - end)
            cut[4] -= ((end - arms[:, 0]) * at[: k + 1, 2]).sum()
            cut[5] += ((end - arms[:, 0]) * at[: k + 1, 1]).sum()
            places.append(float(end))
            forces.append(cut)
    return np.array(places), np.array(forces).reshape(-1, NODE)

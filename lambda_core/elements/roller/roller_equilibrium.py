"""Solve the quasi-static equilibrium of a row of rollers.

Every roller has three degrees of freedom in its plane, the inner ring five. All contacts are springs that only push:
laminae of ISO 16281 on both raceways, Hertz's point contact at ribs. An elastic ring adds the amplitudes c of its waves
with the energy k c^2/2 (formulas.elastic.ring), an elastic support that of its spring. All of it is convex in
displacements and amplitudes, so that the equilibrium is its only minimum; a damped Newton method with the exact Hessian
finds it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.line_contact import ISO_CONSTANT, ISO_EXPONENT, STEEL_MODULUS
from lambda_core.elements.roller.roller_bearing import Ring, RollerBearing
from lambda_core.elements.roller.roller_thrust import refuse_scarce_thrust, thrust_advice
from lambda_core.elements.roller.slices import SLICES, slice_positions
from lambda_core.formulas.elastic.ring import RingWaves
from lambda_core.formulas.hertz import stiffness_constant

_POINT_EXPONENT = 1.5
_POSE = 5  # displacements of the inner ring; amplitudes of waves follow
_MOST_STEPS = 200
_SETTLED = 1e-9  # imbalance over the largest force
_SOFT = 1e-9  # of the stiffest direction: holds rollers that nothing touches
_LONGEST = 50e-6  # longest step of a displacement [m]


@dataclass(frozen=True)
class RollerEquilibrium:
    """Equilibrium of rings and rollers with their loads.

    Attributes
    ----------
    ring : array
        Displacement of the inner ring: x, y, z [m], tilt about y and z [rad], (5,).
    rollers : array
        Displacement of the rollers: a, r [m], tilt in their plane [rad], (Z, 3).
    azimuths : array
        Of the rollers from y towards z [rad], (Z,).
    inner, outer : array
        Loads of the slices [N], (Z, n).
    ribs : array
        Loads of the ribs [N], (Z, ribs), in the order of :attr:`RollerBearing.ribs`.
    loads : array
        Forces x, y, z [N] and moments about y, z [N m] that the rollers take from the inner ring, (5,).
    steps : int
        Newton steps.
    stiffness : array
        d(loads)/d(ring), rollers and waves in equilibrium throughout, (5, 5) [N/m, N/rad, N m/m, N m/rad].
    waves : array
        Amplitudes of cosine and sine of every wave, outwards, inner ring first [m], (waves, 2); none of rigid rings.
    """

    ring: FloatArray
    rollers: FloatArray
    azimuths: FloatArray
    inner: FloatArray
    outer: FloatArray
    ribs: FloatArray
    loads: FloatArray
    steps: int
    stiffness: FloatArray
    waves: FloatArray

    @property
    def carried(self) -> tuple[float, float]:
        """Load that the rollers carry [N].

        It is radial and axial, and zero where it is below what the balance leaves.
        """
        largest = max(float(part.max(initial=0.0)) for part in (self.inner, self.outer, self.ribs))
        found = float(np.hypot(self.loads[1], self.loads[2])), abs(float(self.loads[0]))
        radial, axial = (0.0 if load < _SETTLED * largest else load for load in found)
        return radial, axial


@dataclass(frozen=True)
class Springs:
    """All contacts of one roller.

    Each has the penetration rollers @ u + ring @ v - gap and the energy c/(p + 1) penetration^(p + 1).
    """

    roller: FloatArray  # (m, 3)
    ring: FloatArray  # (m, 3), of the inner ring's motion in the roller's plane; (m, 4) with an outer ring that bends
    gap: FloatArray  # (m,)
    constant: FloatArray  # (m,)
    exponent: FloatArray  # (m,)

    def forces(self, penetration: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return forces and stiffnesses, (..., m)."""
        closed = np.maximum(penetration, 0.0)
        force = self.constant * closed**self.exponent
        slope = self.constant * self.exponent * closed ** (self.exponent - 1.0)
        return force, np.where(penetration > 0.0, slope, 0.0)

    def energy(self, penetration: FloatArray) -> float:
        """Return the elastic energy of all contacts [J]."""
        closed = np.maximum(penetration, 0.0)
        return float(np.sum(self.constant / (self.exponent + 1.0) * closed ** (self.exponent + 1.0)))


def single_contact_constant(length: float, modulus: float = STEEL_MODULUS) -> float:
    """Return c of one raceway's load [N/m^(10/9)].

    It holds in Q = c delta^(10/9) of ONE raceway.

    ISO 16281's c_L holds for both raceways in series; alike, each takes half of the approach: c = c_L 2^(10/9).
    It is that of steel; other materials are stiffer in proportion to E', the `modulus`.
    """
    return float(modulus / STEEL_MODULUS * ISO_CONSTANT * (length * 1e3) ** (8.0 / 9.0) * (2.0 * 1e3) ** ISO_EXPONENT)


def balance(
    bearing: RollerBearing,
    loads: FloatArray,
    *,
    held: tuple[bool, bool, bool, bool, bool] = (False, False, False, True, True),
    displacement: FloatArray | None = None,
    inertial: FloatArray | None = None,
    slices: int = SLICES,
    first_angle: float = 0.0,
    near: RollerEquilibrium | None = None,
    support: FloatArray | None = None,
) -> RollerEquilibrium:
    """Find the equilibrium of rollers and inner ring.

    The outer ring stands still, but for its waves where it bends; what is found counts from there.

    Parameters
    ----------
    bearing : RollerBearing
        Geometry, and how its rings bend.
    loads : array
        On the inner ring: forces x, y, z [N] and moments about y, z [N m] through the rollers' middle plane, (5,).
        Thrust on the inner ring is positive along x.
    held : tuple of bool
        Which displacements of the inner ring are prescribed.
    displacement : array, optional
        Prescribed ones [m, rad], (5,); zero by default.
    inertial : array, optional
        Centrifugal force and gyroscopic moment on every roller in its plane: a, r [N], moment from a to r [N m], (3,).
    slices : int
        Laminae of a contact.
    first_angle : float
        Azimuth of the first roller [rad].
    near : RollerEquilibrium, optional
        Of the same bearing, from whose rollers the search starts.
    support : array, optional
        Stiffness of springs that draw held directions to the prescribed displacement, (5,) [N/m, N m/rad]; zero: rigid.

    Raises
    ------
    ValueError
        For thrust that the kind of bearing does not take.
    ArithmeticError
        When no equilibrium is found: a free direction that nothing holds, or loads beyond all stiffness.
    """
    centrifugal = 0.0 if inertial is None else float(inertial[1])
    refuse_scarce_thrust(bearing, loads, held, centrifugal)
    springs = single_springs(bearing, slices)
    azimuths = first_angle + 2.0 * math.pi * np.arange(bearing.count) / bearing.count
    carry, bending = carry_of(azimuths, bearing), _bending(bearing)
    drawn = np.zeros(_POSE) if support is None else support
    free = ~np.array(held)
    ring = np.zeros(_POSE) if displacement is None else np.asarray(displacement, dtype=np.float64).copy()
    outside, rest = np.zeros(3) if inertial is None else inertial, ring.copy()
    ring, rollers = _start(bearing, loads, free, ring, azimuths)
    rollers = rollers if near is None else near.rollers
    still = np.zeros(bending.size)
    loads, free = np.append(loads, still), np.append(free | (drawn > 0.0), still == 0.0)
    ring, rest, bending = np.append(ring, still), np.append(rest, still), np.append(drawn, bending)
    merit = np.inf
    given = max(float(np.max(np.abs(loads[:3]))), abs(float(np.max(np.abs(loads[3:])))) / bearing.length, 1e-3)
    # a shadow stiffness: what moves nothing stays where it is, what is in balance does not feel it
    for step in range(_MOST_STEPS):
        plane = np.einsum("zpq,q->zp", carry, ring)
        penetration = rollers @ springs.roller.T + plane @ springs.ring.T - springs.gap
        force, slope = springs.forces(penetration)
        merit = springs.energy(penetration) - float(np.sum(rollers @ outside)) - float(loads @ ring)
        merit += _bent_energy(bending, ring - rest)
        roller_left = force @ springs.roller - outside
        ring_left = np.einsum("zm,mp,zpq->q", force, springs.ring, carry) - loads
        pull = bending * (ring - rest)
        ring_left += pull
        left = max(
            float(np.max(np.abs(roller_left[:, :2]))),
            float(np.max(np.abs(roller_left[:, 2]))) / bearing.length,
            float(np.max(np.abs(np.where(free, ring_left, 0.0)[:3]))),
            float(np.max(np.abs(np.where(free, ring_left, 0.0)[3:_POSE]))) / bearing.length,
            float(np.max(np.abs(ring_left[_POSE:]), initial=0.0)),
        )
        size = max(given, float(force.max()))
        condensed = _condensed(springs, slope, carry, roller_left, bending)
        if left < _SETTLED * size:
            n = slices
            loaded = force[:, n : 2 * n], force[:, :n], force[:, 2 * n :]
            carried, waves = (ring_left - pull + loads)[:_POSE], ring[_POSE:].reshape(-1, 2)
            return RollerEquilibrium(
                ring[:_POSE], rollers, azimuths, *loaded, carried, step, condensed.of_the_pose(bending), waves
            )
        move_ring, move_rollers = _newton(condensed, free, ring_left)
        longest = max(
            float(np.max(np.abs(move_rollers[:, :2]))),
            float(np.max(np.abs(move_ring[:3]))),
            float(np.max(np.abs(move_rollers[:, 2]))) * bearing.length,
            float(np.max(np.abs(move_ring[3:_POSE]))) * bearing.length,
            float(np.max(np.abs(move_ring[_POSE:]), initial=0.0)),
        )
        share = min(1.0, _LONGEST / longest) if longest > 0.0 else 1.0
        descent = float(np.sum(roller_left * move_rollers)) + float(ring_left @ move_ring)
        while share > 1e-12:
            new_ring, new_rollers = ring + share * move_ring, rollers + share * move_rollers
            moved = new_rollers @ springs.roller.T + np.einsum("zpq,q->zp", carry, new_ring) @ springs.ring.T
            value = springs.energy(moved - springs.gap) - float(np.sum(new_rollers @ outside)) - float(loads @ new_ring)
            value += _bent_energy(bending, new_ring - rest)
            if value <= merit + 1e-4 * share * descent + 1e-14 * abs(merit):
                break
            share *= 0.5
        ring, rollers = ring + share * move_ring, rollers + share * move_rollers
    raise ArithmeticError(
        f"no equilibrium of the rollers after {_MOST_STEPS} steps: imbalance {left / size:.1e} of the load; "
        f"{thrust_advice(bearing, loads, held, centrifugal)}"
    )


def single_springs(bearing: RollerBearing, slices: int) -> Springs:
    """Return all contacts of one roller.

    They are outer slices, inner slices and ribs.
    """
    angles, half = bearing.angles, 0.5 * bearing.diameter
    inner, outer, axis = angles.inner, angles.outer, angles.roller
    along = slice_positions(bearing.effective_length, slices)
    up = np.array([math.sin(axis), math.cos(axis)])
    places = [
        half * up + np.outer(along, [-math.cos(outer), math.sin(outer)]),
        -half * up + np.outer(along, [-math.cos(inner), math.sin(inner)]),
    ]
    normals = [
        np.tile([-math.sin(outer), -math.cos(outer)], (slices, 1)),
        np.tile([math.sin(inner), math.cos(inner)], (slices, 1)),
    ]
    ribs = bearing.ribs
    if ribs:
        places.append(np.array([rib.place for rib in ribs]))
        normals.append(np.array([rib.normal for rib in ribs]))
    place, normal = np.concatenate(places), np.concatenate(normals)
    turned = normal[:, 1] * place[:, 0] - normal[:, 0] * place[:, 1]
    from_axis = place + np.array([0.0, bearing.centre])
    ring_turned = normal[:, 1] * from_axis[:, 0] - normal[:, 0] * from_axis[:, 1]
    is_inner = np.array([False] * slices + [True] * slices + [rib.ring == "inner" for rib in ribs])
    ring = np.column_stack([normal, ring_turned]) * is_inner[:, None]
    if bearing.outer_waves is not None:
        ring = np.column_stack([ring, normal[:, 1] * ~is_inner])
    drop = bearing.drops(slices)
    clearance = 0.25 * bearing.clearance  # half of the diametral clearance, shared by both contacts
    lines = [single_contact_constant(bearing.effective_length, bearing.modulus(ring)) for ring in ("outer", "inner")]
    constants = [np.repeat(lines, slices) / slices]
    constants += [
        np.array([stiffness_constant(r.contact.radius_x, r.contact.radius_y, bearing.modulus(r.ring)) for r in ribs])
    ]
    return Springs(
        roller=-np.column_stack([normal, turned]),
        ring=ring,
        gap=np.concatenate([drop + clearance, drop + clearance, [rib.gap for rib in ribs]]),
        constant=np.concatenate(constants),
        exponent=np.concatenate([np.full(2 * slices, ISO_EXPONENT), np.full(len(ribs), _POINT_EXPONENT)]),
    )


def waves_by_ring(bearing: RollerBearing) -> Iterator[tuple[Ring, RingWaves]]:
    """Yield the rings that bend, inner ring first."""
    if bearing.inner_waves is not None:
        yield "inner", bearing.inner_waves
    if bearing.outer_waves is not None:
        yield "outer", bearing.outer_waves


def amplitudes(bearing: RollerBearing, state: RollerEquilibrium) -> dict[Ring, FloatArray]:
    """Return the amplitudes of rings that bend [m].

    Each has shape (orders, 2): of cosine and sine of 2, 3, ... waves.
    """
    found, first = {}, 0
    for ring, waves in waves_by_ring(bearing):
        found[ring] = state.waves[first : first + len(waves.counts)]
        first += len(waves.counts)
    return found


def _bending(bearing: RollerBearing) -> FloatArray:
    """Return the stiffness of every amplitude [N/m]."""
    found = [[waves.ring.stiffness(n)] * 2 for _, waves in waves_by_ring(bearing) for n in waves.counts]
    return np.ravel(found)


def _bent_energy(bending: FloatArray, moved: FloatArray) -> float:
    """Return the energy of supports and bent rings [J].

    It is k c^2/2 of every displacement from its place and of every amplitude.
    """
    return 0.5 * float(bending @ moved**2)


def carry_of(azimuths: FloatArray, bearing: RollerBearing) -> FloatArray:
    """Return the motion of rings at every roller.

    That of the inner ring is in the plane of the roller; the fourth row is the outer raceway's way outwards where it
    bends. Pose and amplitudes have a column each.
    """
    cosine, sine = np.cos(azimuths), np.sin(azimuths)
    rows = 3 if bearing.outer_waves is None else 4
    carry: FloatArray = np.zeros((len(azimuths), rows, _POSE + _bending(bearing).size))
    carry[:, 0, 0] = 1.0
    carry[:, 1, 1], carry[:, 1, 2] = cosine, sine
    carry[:, 2, 3], carry[:, 2, 4] = -sine, cosine
    column = _POSE
    for ring, waves in waves_by_ring(bearing):
        for n in waves.counts:
            turned = np.column_stack([np.cos(n * azimuths), np.sin(n * azimuths)])
            carry[:, 1 if ring == "inner" else 3, column : column + 2] = turned
            column += 2
    return carry


def _start(
    bearing: RollerBearing, loads: FloatArray, free: NDArray[np.bool_], ring: FloatArray, azimuths: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return a first guess of the equilibrium.

    The loaded rollers touch both raceways and the loaded ribs.
    """
    radial = float(np.hypot(loads[1], loads[2]))
    cosine = math.cos(bearing.contact_angle)
    largest = 4.08 * radial / (bearing.count * cosine)
    drop = float(np.min(bearing.drops(40)))
    constant = single_contact_constant(bearing.effective_length)
    reach = 2.0 * (largest / constant) ** (1.0 / ISO_EXPONENT) + 2.0 * drop + 0.5 * bearing.clearance
    if radial > 0.0:
        for index in (1, 2):
            if free[index]:
                ring[index] = reach * loads[index] / radial
    if bearing.kind == "tapered":
        even = max(float(loads[0]), 0.0) / (bearing.count * math.sin(bearing.contact_angle))
        middle = 2.0 * (even / constant) ** (1.0 / ISO_EXPONENT) + 2.0 * drop
        if free[0]:
            ring[0] = middle / math.sin(bearing.contact_angle)
    elif loads[0] != 0.0 and free[0]:
        ring[0] = math.copysign(bearing.end_play + 1e-6, float(loads[0]))
    elif free[0]:
        free[0] = False  # no thrust: nothing presses, and the ring stays in the middle
    rollers: FloatArray = np.zeros((bearing.count, 3))
    rollers[:, 0] = 0.5 * ring[0]
    rollers[:, 1] = 0.5 * (ring[1] * np.cos(azimuths) + ring[2] * np.sin(azimuths))
    return ring, rollers


@dataclass(frozen=True)
class _Condensed:
    """Hessian of ring and rollers, condensed.

    The rollers are eliminated, one 3 x 3 block each.
    """

    stiffness: FloatArray  # of pose and waves, rollers in equilibrium, (q, q)
    diagonal: FloatArray  # of pose and waves, rollers where they are, (q,)
    follow: FloatArray  # how rollers move with them, sign turned, (Z, 3, q)
    alone: FloatArray  # step of the rollers to their own balance, sign turned, (Z, 3)
    left: FloatArray  # on pose and waves, of that step, (q,)

    def of_the_pose(self, bending: FloatArray) -> FloatArray:
        """Return the stiffness of the pose, (5, 5).

        Waves are in equilibrium throughout; supports do not count.
        """
        pose, waves = slice(0, _POSE), slice(_POSE, None)
        found = self.stiffness[pose, pose] - np.diag(bending[pose])
        if len(self.diagonal) > _POSE:
            bent = np.linalg.solve(self.stiffness[waves, waves], self.stiffness[waves, pose])
            found = found - self.stiffness[pose, waves] @ bent
        return found


def _condensed(
    springs: Springs, slope: FloatArray, carry: FloatArray, roller_left: FloatArray, bending: FloatArray
) -> _Condensed:
    """Eliminate the rollers from the Hessian.

    The stiffnesses of all contacts are given.
    """
    own = np.einsum("zm,mi,mj->zij", slope, springs.roller, springs.roller)
    mixed = np.einsum("zm,mi,mp->zip", slope, springs.roller, springs.ring) @ carry
    plane = np.einsum("zm,mp,mr->zpr", slope, springs.ring, springs.ring)
    ring = np.einsum("zpq,zpr,zrs->qs", carry, plane, carry, optimize=True)
    if bending.any():
        ring = ring + np.diag(bending)
    scale = np.maximum(np.einsum("zii->zi", own).max(axis=0), 1.0)
    own = own + _SOFT * np.diag(scale)
    solved = np.linalg.solve(own, np.concatenate([mixed, roller_left[:, :, None]], axis=2))
    return _Condensed(
        stiffness=ring - np.einsum("zip,ziq->pq", mixed, solved[:, :, :-1]),
        diagonal=np.diag(ring),
        follow=solved[:, :, :-1],
        alone=solved[:, :, -1],
        left=np.einsum("zip,zi->p", mixed, solved[:, :, -1]),
    )


def _newton(condensed: _Condensed, free: NDArray[np.bool_], ring_left: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the Newton step of ring and rollers."""
    index = np.flatnonzero(free)
    step: FloatArray = np.zeros(len(free))
    if len(index):
        block = condensed.stiffness[np.ix_(index, index)]
        block = block + _SOFT * np.diag(np.maximum(condensed.diagonal[index], 1.0))
        step[index] = -np.linalg.solve(block, (ring_left - condensed.left)[index])
    return step, -(condensed.alone + np.einsum("zip,p->zi", condensed.follow, step))

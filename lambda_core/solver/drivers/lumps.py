"""Divide a shaft into rigid lumps.

They move on its exact static stiffness.

Lumps stand at every bearing, disc and spring, in the middle of the pieces between them, and at the ends of long
overhangs.
Their stiffness, in bending, along and about the axis, is that of the beam condensed to them and to the turning of the
place where the coupling leads it (Guyan 1965, AIAA J. 3, 380), so that static deflections under any load are exact.
The mass of a piece goes to its two ends and its middle by the weights of the parabola through them
(Simpson's rule where it is uniform: m/6, 2 m/3, m/6), which keep its mass, its centre and its moment of inertia.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.beam import NODE
from lambda_core.formulas.elastic.body import ElasticBody, disc_mass
from lambda_core.model.machine_model import MachineModel

_SAME = 1e-6  # [m] places nearer than this are one
_LONG_OVERHANG = 1.0  # diameters, from which on the end of the shaft has a lump of its own
_LONG_PIECE = 4.0  # diameters of the longest piece with one lump in its middle
_SHORT_PIECE = 0.5  # diameters of the longest piece without one
_MIDDLE = 0.36  # share of a piece from which on a lump counts as in its middle: all weights are positive
_LEAST = 0.05  # of the mass that a lump of equal lumps has, that each of them has to have


@dataclass(frozen=True)
class LumpedShaft:
    """Rigid lumps of a shaft with its discs, SI.

    Attributes
    ----------
    positions, mass, transverse_inertia, polar_inertia : float64[:], shape (n,)
    stiffness : float64[:, :], shape (6 n, 6 n) or (6 n + 1, 6 n + 1)
        Between x, y, z and turns about x, y, z of the lumps; last, where no lump stands there, the coupling's turn.
    follow : float64[:, :], shape (6 nodes, 6 n) or (6 nodes, 6 n + 1)
        How all nodes of the beam follow; turned round, how forces on nodes go to the lumps.
    driven : int
        Lump that the coupling turns; n where it is none of them.
    """

    positions: FloatArray
    mass: FloatArray
    transverse_inertia: FloatArray
    polar_inertia: FloatArray
    stiffness: FloatArray
    follow: FloatArray
    driven: int

    def at(self, position: float) -> int:
        """Return the number of the lump at a place [m]."""
        return int(np.argmin(np.abs(self.positions - position)))


def lump(model: MachineModel) -> LumpedShaft:
    """Cut the shaft into lumps."""
    body = model.body
    places = _places(model)
    masses, polar, transverse = np.zeros((3, 1)) if body.is_rigid else _inertias(body, places)
    for disc in body.discs:
        i = int(np.argmin(np.abs(places - disc.position)))
        masses[i] += disc.mass
        polar[i] += disc.polar_inertia
        transverse[i] += disc.transverse_inertia
    coupling = float(body.positions[model.drive // NODE])
    near = np.flatnonzero(np.abs(places - coupling) <= _SAME)
    driven = int(near[0]) if near.size else places.size
    follow, stiffness = _condensed(body, places, None if near.size else model.drive)
    return LumpedShaft(places, masses, transverse, polar, stiffness, follow, driven)


def _places(model: MachineModel) -> FloatArray:
    """Return the places of lumps [m].

    An imported shaft has them at the nodes that it names, by default at all nodes.
    """
    body = model.body
    held = [*(b.position for b in model.bearings), *model.held_places]
    mains = _distinct([*held, *(place for _, place in model.discs)])
    if body.is_rigid:
        return body.positions
    if not body.elements:
        named = body.lumps or range(body.positions.size)
        return _distinct([*mains, *(float(body.positions[n]) for n in named)])
    places = _between(model, _with_ends(model, mains, _LONG_OVERHANG))
    masses = _inertias(body, places)[0]
    if masses.min() < _LEAST * masses.sum() / masses.size:  # an overhang that its neighbours cannot carry
        places = _between(model, _with_ends(model, mains, 0.0))
    return places


def unbalance_of_lumps(model: MachineModel, shaft: LumpedShaft) -> tuple[FloatArray, FloatArray]:
    """Return every lump's unbalance [kg m] and azimuth.

    The azimuth is at t = 0 [rad].
    """
    total = np.zeros(shaft.positions.size, dtype=complex)
    for unbalance in model.unbalances:
        total[shaft.at(unbalance.position)] += unbalance.amount * np.exp(1j * unbalance.angle)
    return np.abs(total), np.angle(total)


def _distinct(places: Sequence[float]) -> FloatArray:
    ordered = np.array(sorted(places))
    found: FloatArray = ordered[np.concatenate([[True], np.diff(ordered) > _SAME])]
    return found


def _diameter(model: MachineModel, place: float) -> float:
    return next((d for begin, end, d, _ in model.outline if begin <= place <= end), model.outline[-1][2])


def _with_ends(model: MachineModel, mains: FloatArray, long: float) -> FloatArray:
    """Add the ends of the shaft where they stand out."""
    ends = (model.outline[0][0], model.outline[-1][1])
    apart = (mains[0] - ends[0], ends[1] - mains[-1])
    added = [end for end, far in zip(ends, apart, strict=True) if far > max(_SAME, long * _diameter(model, end))]
    if mains.size + len(added) < 2:
        added = list(ends)
    return _distinct([*mains, *added])


def _between(model: MachineModel, mains: FloatArray) -> FloatArray:
    """Add lumps between the required ones.

    They lie at nodes of the beam.
    """
    nodes, found = model.body.positions, [float(mains[0])]
    for begin, end in itertools.pairwise(mains):
        wide = _diameter(model, 0.5 * (begin + end))
        parts = 0 if end - begin < _SHORT_PIECE * wide else 2 * math.ceil((end - begin) / (_LONG_PIECE * wide))
        marks = [begin + (end - begin) * i / parts for i in range(1, parts)]
        found += [float(nodes[np.argmin(np.abs(nodes - mark))]) for mark in marks]
        found.append(float(end))
    return _distinct(found)


def _pieces(places: FloatArray) -> list[tuple[int, int]]:
    """Return first and last lump of every piece.

    A piece ends where the middle one of three lumps stands too near to one of the others.
    """
    edges = [0]
    while edges[-1] < places.size - 1:
        three = places[edges[-1] : edges[-1] + 3]
        share = (three[1] - three[0]) / np.ptp(three) if three.size == 3 else 0.0
        edges.append(edges[-1] + (2 if _MIDDLE <= share <= 1.0 - _MIDDLE else 1))
    return list(itertools.pairwise(edges))


def _parabolas(places: FloatArray, marks: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return every lump's weight along the shaft.

    The weights are at marks, with their slopes; the array has shape (marks, lumps).

    Beyond the first and the last lump the line through these and their neighbours goes on; where two pieces meet the
    slope is the mean of theirs.
    """
    values, slopes = np.zeros((marks.size, places.size)), np.zeros((marks.size, places.size))
    counts = np.zeros(marks.size)
    last, far = places.size - 1, math.inf
    spans = [(i, k, float(places[i]), float(places[k])) for i, k in _pieces(places)]
    for i, k, begin, end in [(0, 1, -far, float(places[0])), *spans, (last - 1, last, float(places[-1]), far)]:
        inside, own = np.flatnonzero((marks >= begin) & (marks <= end)), places[i : k + 1]
        counts[inside] += 1.0
        for n, place in enumerate(own):
            shape = np.polynomial.Polynomial.fromroots(np.delete(own, n))
            shape = shape / shape(place)
            values[inside, i + n] += shape(marks[inside])
            slopes[inside, i + n] += shape.deriv()(marks[inside])
    return values / counts[:, None], slopes / counts[:, None]


def _field(body: ElasticBody, values: FloatArray, slopes: FloatArray) -> FloatArray:
    """Return motions that bend all sections along.

    They bend in the plane of y with the tilt about z; the array has shape (rows, n).
    """
    found: FloatArray = np.zeros((body.mass.shape[0], values.shape[1]))
    found[1 : NODE * body.positions.size : NODE] = values
    found[5 : NODE * body.positions.size : NODE] = slopes
    return found


def _inertias(body: ElasticBody, places: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return mass and inertia of every lump.

    They are in kg, and in kg m2 about polar and transverse axes; discs are left out.

    Of the mass matrix: masses by the parabolas, polar inertia in a straight line between neighbours. What ends beyond
    the outermost lumps lack of the moment of inertia these get - a mass at a distance d beyond a lump, the next one h
    away, is carried as m (1 + d/h) and -m d/h, which lacks m d (d + h) - and what the whole then lacks, the turning of
    its sections, goes to all by their polar inertia.
    """
    mass, marks = body.mass.copy(), body.positions
    for disc in body.discs:
        rows = body.rows(disc.position)
        mass[rows, rows] -= disc_mass(disc)
    ones, at = np.ones((marks.size, 1)), marks[:, None]
    shift, turn = _field(body, ones, 0.0 * ones), _field(body, at, ones)
    each = (shift.T @ mass @ _field(body, *_parabolas(places, marks))).ravel()
    about = np.zeros((mass.shape[0], places.size))
    about[3 : NODE * marks.size : NODE] = np.array([np.interp(marks, places, row) for row in np.eye(places.size)]).T
    polar = (about.sum(axis=1) @ mass @ about).ravel()
    beyond = np.zeros(places.size)
    for end, side, near, far in ((0, -1.0, places[0], places[1]), (-1, 1.0, places[-1], places[-2])):
        d = np.maximum(side * (at - near), 0.0)
        lacking = _field(body, d * (d + abs(far - near)), side * (2.0 * d + abs(far - near)) * (d > 0.0))
        beyond[end] += float((shift.T @ mass @ lacking)[0, 0])
    lacks = float((turn.T @ mass @ turn)[0, 0]) - each @ places**2 - beyond.sum()
    return each, polar, beyond + lacks * polar / polar.sum()


def _condensed(body: ElasticBody, places: FloatArray, coupling: int | None) -> tuple[FloatArray, FloatArray]:
    """Return the condensation to lumps.

    How all nodes follow the lumps and one more row, the coupling's, and the stiffness between these.
    """
    size = body.stiffness.shape[0]
    coupling_row = [] if coupling is None else [coupling]
    kept = np.concatenate([*(np.arange(size)[body.rows(float(place))] for place in places), coupling_row]).astype(int)
    inner = np.setdiff1d(np.arange(size), kept)
    k = body.stiffness
    follow = np.zeros((size, kept.size))
    follow[kept, np.arange(kept.size)] = 1.0
    follow[inner] = -np.linalg.solve(k[np.ix_(inner, inner)], k[np.ix_(inner, kept)])
    stiffness: FloatArray = follow.T @ k @ follow
    return follow, 0.5 * (stiffness + stiffness.T)

"""Quasi-static load distribution over the rollers of one row between rigid rings.

Angles count from the direction of the radial load. The approach of roller j and the tilt of the raceways there are
delta_j = (delta_r cos(phi_j) - s/2) cos(alpha) + delta_a sin(alpha) and tan(psi_j) = tan(psi) cos(phi_j) (ISO
16281:2025; cylindrical bearings with alpha = 0). Displacements and moments refer to the pressure centre, where the
normals of the outer raceway meet the axis: tilt about it moves no roller's middle, and loads at the middles have no
moment. Rollers have no inertia and no friction: the normal load is the outer raceway's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.roller.line_contact import iso_approach
from lambda_core.elements.roller.slices import Elastic, SliceLoads, slice_loads

_SETTLED = 1e-8  # imbalance over the largest load


@dataclass(frozen=True)
class RollerRow:
    """One row of rollers between its rings.

    Attributes
    ----------
    count : int
        Rollers Z.
    length : float
        Effective contact length L_we [m].
    drop : array
        Sum of the profiles of both contacts over the slices [m], (n,).
    contact_angle : float
        Angle alpha of the outer raceway [rad]; zero for cylindrical bearings.
    clearance : float
        Radial clearance s [m]; negative for preload.
    first_angle : float
        Angle of the first roller from the radial load [rad].
    elastic : Elastic, optional
        Deflection matrix of the slices; independent laminae without.
    """

    count: int
    length: float
    drop: FloatArray
    contact_angle: float = 0.0
    clearance: float = 0.0
    first_angle: float = 0.0
    elastic: Elastic | None = None

    @property
    def angles(self) -> FloatArray:
        """Angles phi_j of the rollers [rad], (Z,)."""
        return self.first_angle + 2.0 * math.pi * np.arange(self.count) / self.count


@dataclass(frozen=True)
class Distribution:
    """Equilibrium of one row.

    Attributes
    ----------
    radial, axial : float
        Displacement of the inner ring against the outer one [m].
    tilt : float
        Tilt psi of the inner ring about the axis across the radial load [rad].
    moment : float
        Moment about that axis that the rollers exert against the tilt [N m], through the pressure centre.
    slices : SliceLoads
        Loads of the rollers (Z,) and their slices (Z, n).
    """

    radial: float
    axial: float
    tilt: float
    moment: float
    slices: SliceLoads


def loads_at(row: RollerRow, radial: float, axial: float, tilt: float) -> Distribution:
    """Return the loads of all rollers at given displacements of the inner ring [m, m, rad]."""
    cosine, sine = math.cos(row.contact_angle), math.sin(row.contact_angle)
    around = np.cos(row.angles)
    approach = (radial * around - 0.5 * row.clearance) * cosine + axial * sine
    slices = slice_loads(approach, np.arctan(math.tan(tilt) * around), row.drop, row.length, row.elastic)
    return Distribution(radial, axial, tilt, float(np.sum(around * slices.moment)), slices)


def distribute(
    row: RollerRow, radial_load: float, axial_load: float = 0.0, *, tilt: float | None = 0.0, moment: float = 0.0
) -> Distribution:
    """Find the equilibrium of one row under radial and axial load.

    Parameters
    ----------
    row : RollerRow
        The rollers and their raceways.
    radial_load, axial_load : float
        Loads on the inner ring [N]; a cylindrical row carries no axial load.
    tilt : float or None
        Prescribed tilt [rad]; None leaves it free, so that the rollers balance `moment`.
    moment : float
        Moment on the inner ring about the axis across the radial load [N m], positive where it opens a positive tilt.

    Raises
    ------
    ValueError
        For an axial load on a cylindrical row, or none on a tapered one.
    ArithmeticError
        If no equilibrium is found.
    """
    tapered = row.contact_angle > 0.0
    if tapered != (axial_load > 0.0):
        raise ValueError("`axial_load` must be positive for a tapered row and zero for a cylindrical one")
    start = _start(row, radial_load, axial_load)
    reach = float(np.max(np.abs(start)))
    wide = reach / (0.5 * row.length)  # tilt that moves the ends by as much
    size = max(radial_load, axial_load, abs(moment) / row.length)
    free = np.array([True, tapered, tilt is None])
    scale = np.array([reach, reach, wide])

    def unpack(x: FloatArray) -> list[float]:
        full = np.array([0.0, 0.0, tilt or 0.0])
        full[free] = x * scale[free]
        return [float(value) for value in full]

    def imbalance(x: FloatArray) -> FloatArray:
        found = loads_at(row, *unpack(x))
        forces = _forces(row, found) - np.array([radial_load, axial_load])
        every = np.array([*forces, (found.moment - moment) / row.length]) / size
        return np.asarray(every[free])

    first = np.array([*(start / reach), 0.0])[free]
    from scipy.optimize import root  # loaded where rollers are computed

    solution = root(imbalance, first, method="hybr", tol=1e-12)
    left = float(np.max(np.abs(imbalance(solution.x))))
    if left > _SETTLED:
        raise ArithmeticError(f"no equilibrium of the rollers: imbalance {left:.1e} of the load; check loads and tilt")
    return loads_at(row, *unpack(solution.x))


def _forces(row: RollerRow, found: Distribution) -> FloatArray:
    """Return the radial and axial force of all rollers [N]."""
    radial = math.cos(row.contact_angle) * float(np.sum(np.cos(row.angles) * found.slices.load))
    return np.array([radial, math.sin(row.contact_angle) * float(found.slices.load.sum())])


def _start(row: RollerRow, radial_load: float, axial_load: float) -> FloatArray:
    """Return a guess of the radial and axial displacement [m]: Stribeck's largest load, without profile."""
    cosine, sine = math.cos(row.contact_angle), math.sin(row.contact_angle)
    drop = float(np.min(row.drop))
    largest = 4.08 * radial_load / (row.count * cosine)
    if sine == 0.0:
        return np.array([float(iso_approach(largest, row.length)) + drop + max(0.5 * row.clearance, 0.0), 0.0])
    even = axial_load / (row.count * sine)
    middle = float(iso_approach(even, row.length)) + drop
    # the axial load closes every roller evenly, the radial one adds a cosine
    return np.array([float(iso_approach(largest, row.length)) / (2.0 * cosine), middle / sine])

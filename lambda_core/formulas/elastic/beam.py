"""Compute matrices of a Timoshenko beam element.

It has four nodes of six degrees of freedom: stiffness, mass, gyroscopic matrix.

All six motions are cubic along the element (Lagrange through equally spaced nodes). The solution of Timoshenko's
equations under loads at the ends, deflection cubic and lean of the sections quadratic, is one of these, so that static
deflections are exact and shear does not lock; two-node elements exact in statics converge with the square of their
length only, once shorter than the shaft is thick. Order of a node: x, y, z, tilt about x, y, z; a positive tilt about z
lifts the +x end towards +y, one about y lowers it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.formulas.elastic.sections import RoundSection

NODE = 6  # degrees of freedom of a node
NODES = 4  # of an element
SPOTS = np.linspace(0.0, 1.0, NODES)  # of the nodes on the element
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(NODES)  # exact for the products of cubics
# The deflection and the tilt of each plane, and the sign of the tilt as a slope.
_PLANES = ((1, 5, 1.0), (2, 4, -1.0))


@dataclass(frozen=True)
class ElementMatrices:
    """Matrices of one element.

    They have the shape (24, 24), in the order of its nodes.
    """

    stiffness: FloatArray
    mass: FloatArray
    gyroscopic: FloatArray  # times the spin about x


def shapes(spot: float) -> tuple[FloatArray, FloatArray]:
    """Return the shape functions of an element.

    They are the weight of each node's value at a spot of the element (0 to 1), and its slope per element length.
    """
    values, slopes = np.ones(NODES), np.zeros(NODES)
    for i, own in enumerate(SPOTS):
        others = np.delete(SPOTS, i)
        scale = np.prod(own - others)
        values[i] = np.prod(spot - others) / scale
        slopes[i] = sum(np.prod(spot - np.delete(others, k)) for k in range(NODES - 1)) / scale
    return values, slopes


def element_matrices(section: RoundSection, length: float) -> ElementMatrices:
    """Return the matrices of a straight beam along x.

    Parameters
    ----------
    section : RoundSection
        The same over its length.
    length : float
        [m]
    """
    value, slope = np.zeros((NODES, NODES)), np.zeros((NODES, NODES))
    mixed = np.zeros((NODES, NODES))  # slope times value
    for point, weight in zip(_POINTS, _WEIGHTS, strict=True):
        at, along = shapes(0.5 * (1.0 + point))
        value += 0.5 * length * weight * np.outer(at, at)
        slope += 0.5 / length * weight * np.outer(along, along)
        mixed += 0.5 * weight * np.outer(along, at)
    stiffness, mass, gyroscopic = (np.zeros((NODE * NODES, NODE * NODES)) for _ in range(3))
    line = section.material.density * section.area
    inertia = section.material.density * section.second_moment
    for i, carried in enumerate((line, line, line, 2.0 * inertia, inertia, inertia)):
        mass[i::NODE, i::NODE] = carried * value
    stiffness[0::NODE, 0::NODE] = section.axial_stiffness * slope
    stiffness[3::NODE, 3::NODE] = section.torsional_stiffness * slope
    shear, bending = section.shear_stiffness, section.bending_stiffness
    for deflection, tilt, sign in _PLANES:
        stiffness[deflection::NODE, deflection::NODE] = shear * slope
        stiffness[tilt::NODE, tilt::NODE] = bending * slope + shear * value
        stiffness[deflection::NODE, tilt::NODE] = -sign * shear * mixed
        stiffness[tilt::NODE, deflection::NODE] = -sign * shear * mixed.T
    # Angular momentum 2 rho I spin along the axis (1, tilt_z, -tilt_y): its change loads each tilt by the other's rate.
    gyroscopic[4::NODE, 5::NODE] = 2.0 * inertia * value
    gyroscopic[5::NODE, 4::NODE] = -2.0 * inertia * value
    return ElementMatrices(stiffness, mass, gyroscopic)

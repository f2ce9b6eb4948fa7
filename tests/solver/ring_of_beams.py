"""Model a ring as a polygon of straight beams."""

from __future__ import annotations

import math

import numpy as np

from lambda_core.domain.arrays import FloatArray


def waves_of_beams(
    radius: float, bending: float, bed: float, forces: FloatArray, azimuths: FloatArray, waves: int, elements: int = 360
) -> FloatArray:
    """Return the amplitudes of beam waves [m].

    Cosine and sine of `waves` waves of the radial displacement, outwards.

    Euler-Bernoulli beams (Przemieniecki 1968, Theory of Matrix Structural Analysis, eq. 5.116) that hardly stretch, on
    radial springs, loaded at their corners.

    Parameters
    ----------
    bending, bed : float
        E I [N m2]; stiffness of the bed per length of circumference [N/m2].
    forces : float64[:, :], shape (m, 2)
        Outwards and along growing azimuth [N], at the corners next to the azimuths.
    """
    stretching = 1e5 * bending / radius**2
    spring = bed * (2.0 * math.pi * radius / elements)  # [N/m] of one corner
    size, length = 3 * elements, 2.0 * radius * math.sin(math.pi / elements)
    around = 2.0 * math.pi * np.arange(elements) / elements
    k = np.zeros((size, size))
    a, b, c, d = (
        stretching / length, 12.0 * bending / length**3, 6.0 * bending / length**2, 4.0 * bending / length,
    )  # fmt: skip
    local = np.array(
        [[a, 0, 0, -a, 0, 0], [0, b, c, 0, -b, c], [0, c, d, 0, -c, d / 2],
         [-a, 0, 0, a, 0, 0], [0, -b, -c, 0, b, -c], [0, c, d / 2, 0, -c, d]]
    )  # fmt: skip
    for i in range(elements):
        along = around[i] + math.pi / elements + math.pi / 2.0
        one = np.array([[math.cos(along), math.sin(along), 0], [-math.sin(along), math.cos(along), 0], [0, 0, 1]])
        turn = np.kron(np.eye(2), one)
        rows = np.r_[3 * i : 3 * i + 3, np.arange(3 * (i + 1), 3 * (i + 1) + 3) % size]
        k[np.ix_(rows, rows)] += turn.T @ local @ turn
    force, weak = np.zeros(size), 1e-6 * (spring or bending / radius**3 / elements)
    for i, angle in enumerate(around):
        out = np.array([math.cos(angle), math.sin(angle)])
        k[3 * i : 3 * i + 2, 3 * i : 3 * i + 2] += spring * np.outer(out, out)
        k[3 * i : 3 * i + 2, 3 * i : 3 * i + 2] += weak * np.eye(2)  # nothing else keeps it from turning and moving
    for (outwards, aside), azimuth in zip(forces, azimuths, strict=True):
        i = round(azimuth / (2.0 * math.pi / elements)) % elements
        c, s = math.cos(around[i]), math.sin(around[i])
        force[3 * i : 3 * i + 2] += outwards * np.array([c, s]) + aside * np.array([-s, c])
    moved = np.linalg.solve(k, force).reshape(-1, 3)
    radial = moved[:, 0] * np.cos(around) + moved[:, 1] * np.sin(around)
    return np.array([2.0 * np.mean(radial * f(waves * around)) for f in (np.cos, np.sin)])

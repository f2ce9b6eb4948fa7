"""Compute with three-component vectors as tuples.

They live in registers.
"""

# Numba infers the types of compiled functions.
from __future__ import annotations

import math

import numpy as np

from lambda_core.solver.layout import helper


@helper
def inverse_root(x):
    """Return 1/sqrt(x) of a normal x > 0.

    It is exact to two units in the last place; NaN gives NaN.

    From half the exponent, then Newton's steps (Muller 2016, Elementary Functions, 3rd ed., chapter 2): products are
    done in half the time of a root and a division, which a loop over cells would wait for.
    """
    half = 0.5 * x
    y = np.int64(0x5FE6EB50C7B537A9 - (np.float64(x).view(np.int64) >> 1)).view(np.float64)
    y = y * (1.5 - half * y * y)
    y = y * (1.5 - half * y * y)
    y = y * (1.5 - half * y * y)
    return y * (1.5 - half * y * y)


@helper
def add(a, b):
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@helper
def subtract(a, b):
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@helper
def negative(a):
    """Return -a."""
    return -a[0], -a[1], -a[2]


@helper
def scale(k, a):
    """Return k a."""
    return k * a[0], k * a[1], k * a[2]


@helper
def dot(a, b):
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@helper
def dot_onto(start, a, b):
    """Return start + a . b, summed from the left."""
    return start + a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@helper
def cross(a, b):
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@helper
def point_velocity(v, w, arm):
    """Return v + w x arm.

    The velocity of a point of a body.
    """
    return (
        v[0] + w[1] * arm[2] - w[2] * arm[1],
        v[1] + w[2] * arm[0] - w[0] * arm[2],
        v[2] + w[0] * arm[1] - w[1] * arm[0],
    )


@helper
def combine(k, a, b, c):
    """Return the vector of components k.

    The components are along the axes a, b, c.
    """
    return (
        k[0] * a[0] + k[1] * b[0] + k[2] * c[0],
        k[0] * a[1] + k[1] * b[1] + k[2] * c[1],
        k[0] * a[2] + k[1] * b[2] + k[2] * c[2],
    )


@helper
def combine_onto(start, k, a, b, c):
    """Return start plus the vector of k.

    The components are along the axes a, b, c, summed from the left.
    """
    return (
        start[0] + k[0] * a[0] + k[1] * b[0] + k[2] * c[0],
        start[1] + k[0] * a[1] + k[1] * b[1] + k[2] * c[1],
        start[2] + k[0] * a[2] + k[1] * b[2] + k[2] * c[2],
    )


@helper
def components(v, a, b, c):
    """Return v's components along a, b, c.

    They are axes.
    """
    return dot(v, a), dot(v, b), dot(v, c)


@helper
def turning(v, c, s):
    """Return the turning components x, r, t.

    The vector is inertial; the azimuth has cosine c and sine s.
    """
    return v[0], v[1] * c + v[2] * s, -v[1] * s + v[2] * c


@helper
def inertial(v, c, s):
    """Return the inertial components x, y, z.

    The vector is given in the turning frame.
    """
    return v[0], v[1] * c - v[2] * s, v[1] * s + v[2] * c


@helper
def store(target, v):
    """Write a vector into an array."""
    target[0], target[1], target[2] = v[0], v[1], v[2]


@helper
def increase(target, v):
    """Add a vector to an array."""
    target[0] += v[0]
    target[1] += v[1]
    target[2] += v[2]


@helper
def decrease(target, v):
    """Subtract a vector from an array."""
    target[0] -= v[0]
    target[1] -= v[1]
    target[2] -= v[2]


@helper
def clear(wrench):
    """Set a wrench to zero."""
    store(wrench.force, (0.0, 0.0, 0.0))
    store(wrench.moment, (0.0, 0.0, 0.0))


@helper
def clear_each(wrenches):
    """Set every wrench of a table to zero."""
    for i in range(wrenches.size):
        clear(wrenches[i])


@helper
def length(a):
    """Return |a|."""
    return math.sqrt(dot(a, a))


# pi/2 in three parts, the first two of 33 bits: multiples of them are exact up to a million quarter turns.
_QUARTER_TURNS = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21)
_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding it leaves the nearest integer in the lowest bits


@helper
def cosine_sine(angle):
    """Return an angle's cosine and sine.

    They are exact within 2e-16 and the spacing of numbers as large as the angle.

    Taylor's series on an eighth of a turn to either side, remainder 5e-17 (Muller 2016, Elementary Functions, 3rd ed.,
    chapter 11, for the reduction): branch-free, a third of the time of two calls of the C library.
    """
    first, second, third = _QUARTER_TURNS
    shifted = np.float64(angle * 0.6366197723675814 + _ROUND)
    n, quarter = shifted - _ROUND, shifted.view(np.int64)
    r = ((angle - n * first) - n * second) - n * third
    r2 = r * r
    r4 = r2 * r2
    odd = (-1 / 6 + r2 * (1 / 120)) + r4 * (
        (-1 / 5040 + r2 * (1 / 362880)) + r4 * ((-1 / 39916800 + r2 * (1 / 6227020800)) - r4 * (1 / 1307674368000))
    )
    even = (-0.5 + r2 * (1 / 24)) + r4 * (
        (-1 / 720 + r2 * (1 / 40320))
        + r4 * ((-1 / 3628800 + r2 * (1 / 479001600)) + r4 * (-1 / 87178291200 + r2 * (1 / 20922789888000)))
    )
    s, c = r + r * r2 * odd, 1.0 + r2 * even
    turned = quarter & 1 == 1
    cosine, sine = s if turned else c, c if turned else s
    return -cosine if (quarter + 1) & 2 == 2 else cosine, -sine if quarter & 2 == 2 else sine

"""Solve the network exactly between two switching edges.

Capacitances and conductances are constant there.

C dv/dt + G v = i with C and G symmetric. v = S y with S' C S = 1 and S' G S = diag(lambda), so that every mode obeys
dy/dt = -lambda y + b on its own, b = S' i, and y = S' q with the charges q = C v of the nodes. Row a of the array `s`
is the shape of mode a: S transposed.
"""

from __future__ import annotations

import math

from lambda_core.analysis.electric.compiled.array_types import helper, shared_helper

_SWEEPS = 40
_RELATIVE, _ABSOLUTE = 1e-16, 1e-19
SLOW = 1e-2  # below, the decay functions are summed: x^6/5040 is beyond double precision


@shared_helper
def factorise(n, c, low):
    """Write the Cholesky factor of the capacitances.

    Return 0 where they are not positive.
    """
    for i in range(n):
        for j in range(i + 1):
            total = c[i, j]
            for k in range(j):
                total -= low[i, k] * low[j, k]
            if i == j:
                if not total > 0.0:
                    return 0
                low[i, i] = math.sqrt(total)
            else:
                low[i, j] = total / low[j, j]
    return 1


@shared_helper
def modes(n, low, g, b, s, decay):
    """Find the modes of a network of n nodes.

    They follow from the Cholesky factor of its capacitances; `b` is workspace.

    Jacobi's rotations of L^-1 G L^-T keep small decay rates accurate next to large ones (Demmel and Veselic 1992, SIAM
    J. Matrix Anal. 13, 1204): oil leaks in seconds where touching metal does in picoseconds.
    """
    for j in range(n):  # b = L^-1 G
        for i in range(n):
            total = g[i, j]
            for k in range(i):
                total -= low[i, k] * b[k, j]
            b[i, j] = total / low[i, i]
    for i in range(n):  # b = (L^-1 G) L^-T, row by row
        for j in range(n):
            total = b[i, j]
            for k in range(j):
                total -= low[j, k] * b[i, k]
            b[i, j] = total / low[j, j]
    _rotate(n, b, s)
    for a in range(n):
        decay[a] = max(b[a, a], 0.0)
        for i in range(n - 1, -1, -1):  # S = L^-T P
            total = s[a, i]
            for k in range(i + 1, n):
                total -= low[k, i] * s[a, k]
            s[a, i] = total / low[i, i]


@shared_helper
def _rotate(n, b, s):
    """Turn b into a diagonal matrix by Jacobi's rotations.

    s holds the rotations, row by row.
    """
    trace = 0.0
    for i in range(n):
        for j in range(n):
            s[i, j] = 0.0
        s[i, i] = 1.0
        trace += b[i, i]
    for _ in range(_SWEEPS):
        turned = 0
        for p in range(n - 1):
            for q in range(p + 1, n):
                off = b[p, q]
                if abs(off) <= _RELATIVE * math.sqrt(abs(b[p, p] * b[q, q])) + _ABSOLUTE * trace:
                    continue
                turned = 1
                theta = 0.5 * (b[q, q] - b[p, p]) / off
                t = math.copysign(1.0, theta) / (abs(theta) + math.sqrt(theta * theta + 1.0))
                cos = 1.0 / math.sqrt(t * t + 1.0)
                sin = t * cos
                b[p, p] -= t * off
                b[q, q] += t * off
                b[p, q] = 0.0
                b[q, p] = 0.0
                for k in range(n):
                    if k not in (p, q):
                        kp, kq = b[k, p], b[k, q]
                        b[k, p] = cos * kp - sin * kq
                        b[p, k] = b[k, p]
                        b[k, q] = sin * kp + cos * kq
                        b[q, k] = b[k, q]
                    kp, kq = s[p, k], s[q, k]
                    s[p, k] = cos * kp - sin * kq
                    s[q, k] = sin * kp + cos * kq
        if turned == 0:
            return


@helper
def decay_functions(x):
    """Return three decay functions of x.

    They are exp(-x), (1 - exp(-x))/x and (1 - (1 - exp(-x))/x)/x.
    """
    if x < SLOW:
        second = 0.5 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120 - x * (1 / 720 - x / 5040))))
        first = 1.0 - x * second
        return 1.0 - x * first, first, second
    gone = math.exp(-x)
    first = (1.0 - gone) / x
    return gone, first, (1.0 - first) / x


@shared_helper
def propagate(n, decay, y, drive, dt, after, area):
    """Move the modes on by dt.

    The drive is constant; `area` is the integral of y over dt.
    """
    for a in range(n):
        gone, first, second = decay_functions(decay[a] * dt)
        after[a] = y[a] * gone + drive[a] * dt * first
        area[a] = dt * (y[a] * first + drive[a] * dt * second)


@helper
def halfway(decay, y, drive, dt):
    """Return the amplitude of a mode after half of dt."""
    gone, first, _ = decay_functions(0.5 * decay * dt)
    return y * gone + 0.5 * drive * dt * first


@helper
def heat(n, decay, y, drive, dt, after):
    """Return the heat of the conductances in dt [J].

    It is the integral of the sum of lambda y^2.

    Slow modes by Simpson's rule (relative error x^4/2880 < 4e-12), the others in closed form.

    Parameters
    ----------
    y, after : float64[:]
        Amplitudes at the beginning and the end.
    """
    total = 0.0
    for a in range(n):
        x = decay[a] * dt
        if x == 0.0:
            continue
        if x < SLOW:
            middle = halfway(decay[a], y[a], drive[a], dt)
            total += x * (y[a] * y[a] + 4.0 * middle * middle + after[a] * after[a]) / 6.0
        else:
            gone = math.exp(-x)
            steady = drive[a] / decay[a]
            rest = y[a] - steady
            total += steady * steady * x + 2.0 * steady * rest * (1.0 - gone) + 0.5 * rest * rest * (1.0 - gone * gone)
    return total


@helper
def products(n, decay, y, drive, dt, after, area, middle, found):
    """Write the products' integrals of two amplitudes.

    The integrals are over dt.

    d(y_a y_b)/dt = -(lambda_a + lambda_b) y_a y_b + b_a y_b + b_b y_a, integrated; for two slow modes, where this
    would be a difference of nearly equal numbers, Simpson's rule as in `heat`.
    """
    for a in range(n):
        if 2.0 * decay[a] * dt < SLOW:
            middle[a] = halfway(decay[a], y[a], drive[a], dt)
    for a in range(n):
        for b in range(a + 1):
            both = decay[a] + decay[b]
            if both * dt < SLOW and max(decay[a], decay[b]) * 2.0 * dt < SLOW:
                one = dt * (y[a] * y[b] + 4.0 * middle[a] * middle[b] + after[a] * after[b]) / 6.0
            else:
                one = (y[a] * y[b] - after[a] * after[b] + drive[a] * area[b] + drive[b] * area[a]) / both
            found[a, b] = one
            found[b, a] = one


@helper
def voltages(n, s, y, v):
    """Write the nodes' potentials v = S y."""
    for i in range(n):
        v[i] = 0.0
    for a in range(n):
        part = y[a]
        for i in range(n):
            v[i] += s[a, i] * part


@helper
def amplitudes(n, s, q, y):
    """Write the modes' amplitudes y = S' q."""
    for a in range(n):
        total = 0.0
        for i in range(n):
            total += s[a, i] * q[i]
        y[a] = total


@helper
def charges(n, c, v, q):
    """Write the nodes' charges q = C v."""
    for i in range(n):
        total = 0.0
        for k in range(n):
            total += c[i, k] * v[k]
        q[i] = total

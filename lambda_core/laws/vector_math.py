"""Define exp, log and asinh that compilers vectorise.

They are branch-free plain Python, accurate to a few units in the last place.

Calls of the C library keep a loop over cells scalar; these take a fifth of the time. The exponent of a float is read
and written through its bits, the rest is a polynomial (Muller 2016, Elementary Functions, 3rd ed., chapters 2 and 11).
Divisions by constants are written as products: the compiler leaves them divisions.
"""

from __future__ import annotations

import math

import numpy as np

_ROUND = 6755399441055744.0  # 1.5 * 2^52: adding it leaves the nearest integer in the lowest bits
_LN2_HIGH = 0.6931471803691238
_LN2_LOW = 1.9082149292705877e-10
_LN2 = 0.6931471805599453
_SQRT_HALF_BITS = 0x3FE6A09E667F3BCD
_ROUND_BITS = 0x4338000000000000


def exp(x: float) -> float:
    """Return e^x for -700 < x < 700.

    Parameters
    ----------
    x : float
        Exponent.

    Returns
    -------
    float
    """
    shifted = np.float64(x * 1.4426950408889634 + _ROUND)
    n = shifted - _ROUND
    r = (x - n * _LN2_HIGH) - n * _LN2_LOW
    # Taylor series of degree 12 on |r| <= ln(2)/2, remainder 2e-16; in pairs of terms that need not wait
    r2 = r * r
    tail = (1 / 40320 + r * (1 / 362880)) + r2 * ((1 / 3628800 + r * (1 / 39916800)) + r2 * (1 / 479001600))
    tail = (1 / 24 + r * (1 / 120)) + r2 * ((1 / 720 + r * (1 / 5040)) + r2 * tail)
    p = (1.0 + r) + r2 * ((0.5 + r * (1 / 6)) + r2 * tail)
    scale = np.int64((shifted.view(np.int64) << 52) + (1023 << 52)).view(np.float64)
    return float(p * scale)


def _octave(x: float) -> int:
    """Return the octave k of x.

    x / 2^k lies between sqrt(1/2) and sqrt(2).
    """
    bits = np.float64(x).view(np.int64)
    return np.int64((bits - _SQRT_HALF_BITS) >> 52)  # type: ignore[return-value]


def _mantissa(x: float, k: int) -> float:
    """Return x / 2^k."""
    bits = np.float64(x).view(np.int64)
    return np.int64(bits - (k << 52)).view(np.float64)


def _log(z: float, k: int) -> float:
    """Return k ln 2 + 2 artanh(z).

    The logarithm's series has |z| <= 0.172 and a remainder of 1e-17.
    """
    q = z * z
    q2 = q * q
    tail = (1 / 9 + q * (1 / 11)) + q2 * ((1 / 13 + q * (1 / 15)) + q2 * (1 / 17 + q * (1 / 19)))
    series = 2.0 * z * ((1.0 + q * (1 / 3)) + q2 * ((1 / 5 + q * (1 / 7)) + q2 * tail))
    exponent = np.int64(k + _ROUND_BITS).view(np.float64) - _ROUND
    return float(series + exponent * _LN2)


def log(x: float) -> float:
    """Return ln x for 1e-300 < x < 1e300.

    NaN for what has no logarithm.

    Parameters
    ----------
    x : float
        Positive number.

    Returns
    -------
    float
    """
    k = _octave(x)
    mantissa = _mantissa(x, k)
    value = _log((mantissa - 1.0) / (mantissa + 1.0), k)
    # x - x is 0, or NaN where x is not finite: the bits alone would hide it
    return value + (x - x) if x > 0.0 else math.nan


def power(x: float, y: float) -> float:
    """Return x^y.

    It holds for 1e-300 < x < 1e300 and |y ln x| < 700; the relative error is about |y ln x| times that of exp.

    Parameters
    ----------
    x : float
        Positive base.
    y : float
        Exponent.

    Returns
    -------
    float
    """
    return exp(y * log(x))


def log1p(d: float) -> float:
    """Return ln(1 + d) for 0 <= d < 1e300.

    Parameters
    ----------
    d : float
        Excess over 1.

    Returns
    -------
    float
    """
    k = _octave(1.0 + d)
    # below sqrt(2) the sum 1 + d has lost digits of d that the argument still has
    rest = d if k == 0 else _mantissa(1.0 + d, k) - 1.0
    return _log(rest / (2.0 + rest), k) + (d - d)


def asinh_quotient(y: float) -> tuple[float, float, int]:
    """Return (above, below, k) of an asinh.

    asinh(y) is :func:`asinh_of` above/below; 0 <= y < 1e150, 1 < below.

    Parameters
    ----------
    y : float
        Argument; only its size counts, the caller keeps the sign.

    Returns
    -------
    tuple of (float, float, int)
    """
    root = math.sqrt(1.0 + y * y)
    k = _octave(y + root)
    mantissa = _mantissa(y + root, k)
    part = y * (1.0 + root) + y * y
    above = part if k == 0 else mantissa - 1.0
    below = 2.0 * (1.0 + root) + part if k == 0 else mantissa + 1.0
    return above, below, k


def asinh_of(quotient: float, k: int, y: float) -> float:
    """Return asinh(y) from its quotient.

    The quotient is that of :func:`asinh_quotient`; NaN where y is not finite.

    Parameters
    ----------
    quotient : float
        ``above/below`` of :func:`asinh_quotient`.
    k : int
        Its power of two.
    y : float
        The argument that it was asked for.

    Returns
    -------
    float
    """
    return _log(quotient, k) + (y - y)


def asinh(y: float) -> float:
    """Return asinh(y) for 0 <= y < 1e150.

    It is ln(1 + d) with d = y + y^2/(1 + sqrt(1 + y^2)), with one division for both.

    Parameters
    ----------
    y : float
        Argument, not negative.

    Returns
    -------
    float
    """
    above, below, k = asinh_quotient(y)
    return asinh_of(above / below, k, y)

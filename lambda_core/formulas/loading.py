"""Define loaded balls and the largest contact load."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

Ring = Literal["inner", "outer"]  # in the order of channels.RINGS
# A contact below this share of the largest load does not count as carrying it.
CARRYING = 0.01


def carries(inner: ArrayLike) -> NDArray[np.bool_]:
    """Mark the balls that carry load.

    The load acts between the rings; see :func:`loaded_elements`.
    """
    load = np.asarray(inner, float)
    return np.asarray(load > CARRYING * load.max(initial=0.0))


def loaded_elements(inner: ArrayLike) -> int:
    """Count the balls that carry load between the rings.

    Parameters
    ----------
    inner : array_like, shape (Z,)
        Contact loads at the inner ring [N]; at the outer ring centrifugal force loads every ball.

    Returns
    -------
    int
        Balls whose load is more than :data:`CARRYING` of the largest.
    """
    return int(carries(inner).sum())


def largest_contact(load: ArrayLike) -> tuple[float, Ring]:
    """Return Q_max [N] and its ring.

    It is the largest contact load.

    Parameters
    ----------
    load : array_like, shape (Z, 2)
        Contact loads [N], of each ball at the inner and at the outer ring.
    """
    inner, outer = np.asarray(load, float).max(axis=0)
    return (float(inner), "inner") if inner >= outer else (float(outer), "outer")

"""Add the capacitances of contacts to that of a bearing."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray


def between_rings(contacts: FloatArray) -> float:
    """Return the capacitance between two rings [F].

    The rolling elements are parallel, the contacts of one with both rings in series. A contact that asperities short
    has inf; so has the result where they short both contacts of an element.

    Parameters
    ----------
    contacts : float64[:, :], shape (elements, 2)
        Of every element with each ring [F].
    """
    with np.errstate(divide="ignore"):
        return float((1.0 / (1.0 / contacts).sum(axis=1)).sum())

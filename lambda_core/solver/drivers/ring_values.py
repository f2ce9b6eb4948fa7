"""Combine raceway values into one value for each ring.

Results show a ring where it has two arcs.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import LOSSES, RIBS, RINGS
from lambda_core.elements.ball.geometry import Geometry
from lambda_core.elements.ball.raceways import raceways, raceways_of_a_ball
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.records import CONTACT_CHANNELS

_LOAD = CONTACT_CHANNELS.index("load")
# Of both contacts together; all else is that of the one which carries more.
_SUMMED = tuple(CONTACT_CHANNELS.index(name) for name in ("capacitance_hertz", "capacitance", "contact_loss"))


def rings_of_contacts(geometry: Geometry) -> NDArray[np.int64]:
    """Return the ring of each contact.

    A contact of a ball has 0 for the inner and 1 for the outer ring.
    """
    return np.array([raceway.ring for raceway in raceways_of_a_ball(geometry)])


def are_ribs(geometry: Geometry) -> NDArray[np.bool_]:
    """Mark the contacts with ribs.

    They are those of rollers; balls have none.
    """
    return np.array([raceway.end != 0 for raceway in raceways_of_a_ball(geometry)])


def contacts_by_ring(geometry: Geometry, contacts: FloatArray) -> FloatArray:
    """Return contacts by ring from raceways.

    They are those of each ball, shape (..., Z, 2, channels).

    Of two arcs the one that carries more is shown, with the capacitance and the loss of both; of rollers the raceway,
    with the losses of the ring's ribs.
    """
    if contacts.shape[-2] == len(RINGS):
        return contacts
    rings, ribs = rings_of_contacts(geometry), are_ribs(geometry)
    found = np.empty((*contacts.shape[:-2], len(RINGS), contacts.shape[-1]))
    for ring in range(len(RINGS)):
        arcs = contacts[..., (rings == ring) & ~ribs, :]
        most = np.argmax(arcs[..., _LOAD], axis=-1)[..., None, None]
        found[..., ring, :] = np.take_along_axis(arcs, most, axis=-2)[..., 0, :]
        found[..., ring, _SUMMED] = contacts[..., rings == ring, :][..., _SUMMED].sum(axis=-2)
    return found


def loads_of_ribs(geometry: Geometry, contacts: FloatArray) -> FloatArray:
    """Return the rib loads on rollers [N].

    They act on each roller; the array has shape (..., Z, 4), as channels.RIBS has them.
    """
    found = np.zeros((*contacts.shape[:-2], len(RIBS)))
    for place, raceway in enumerate(raceways_of_a_ball(geometry)):
        if raceway.end:
            name = f"{RINGS[raceway.ring]} {'+x' if raceway.end > 0 else '-x'}"
            found[..., RIBS.index(name)] = contacts[..., place, _LOAD]
    return found


def losses_by_ring(geometry: Geometry, powers: FloatArray) -> FloatArray:
    """Return losses by ring.

    They have the form of channels.LOSSES, shape (..., 16), and come from every raceway and the rest.
    """
    rings = np.array([raceway.ring for raceway in raceways(geometry)])
    if rings.size == len(RINGS):
        return powers
    count = L.MECHANISMS * rings.size
    each = powers[..., :count].reshape(*powers.shape[:-1], L.MECHANISMS, rings.size)
    sums = np.stack([each[..., rings == ring].sum(axis=-1) for ring in range(len(RINGS))], axis=-1)
    return np.concatenate([sums.reshape(*powers.shape[:-1], L.MECHANISMS * len(RINGS)), powers[..., count:]], axis=-1)


def losses_of_raceways(geometry: Geometry, powers: FloatArray, first: int) -> dict[str, float]:
    """Return one bearing's losses of raceways.

    It is one of several, as channels.LOSSES has it; the rest is 0.

    Parameters
    ----------
    powers : float64[:]
        Of all bearings, or their integrals.
    first : int
        The bearing's first raceway.
    """
    count = len(raceways(geometry))
    own = powers[: -L.RUNNING_SIZE].reshape(L.MECHANISMS, -1)[:, first : first + count]
    rest = np.zeros(len(LOSSES) - L.MECHANISMS * len(RINGS))
    return dict(zip(LOSSES, losses_by_ring(geometry, np.append(own.ravel(), rest)).tolist(), strict=True))

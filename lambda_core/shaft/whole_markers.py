"""Compute the motion of bodies and markers from shaft samples."""

from __future__ import annotations

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elastic.beam import NODE
from lambda_core.shaft.lumps import LumpedShaft
from lambda_core.system.locations import carried
from lambda_core.system.machine import GROUND, SHAFT, Machine

_AXES = 3


def motions(bodies: np.ndarray, twist: FloatArray | None = None) -> FloatArray:
    """Return x, y, z and turns about x, y, z of bodies in samples, shape (n, bodies, 6), `twist` in place of angles."""
    about = bodies["angle"] if twist is None else twist
    turns = [about[..., None], -bodies["tilt"][..., 1:], bodies["tilt"][..., :1]]
    return np.concatenate([bodies["position"], *turns], axis=-1)


class MarkerMotion:
    """Displacements of the named places of a whole from the motions of its lumps and bodies."""

    def __init__(self, model: Machine, shaft: LumpedShaft) -> None:
        count = len(model.markers)
        self._of_lumps = np.zeros((count, _AXES, NODE * shaft.positions.size))
        self._of_bodies = np.zeros((count, _AXES, NODE * len(model.bodies)))
        for k, (_, place) in enumerate(model.markers):
            if place.body == SHAFT:
                node = shaft.follow[model.body.rows(place.point[0]), : self._of_lumps.shape[2]]
                self._of_lumps[k] = (carried([0.0, *place.point[1:]]) @ node)[:_AXES]
            elif place.body != GROUND:
                own, first = model.bodies[place.body - 1], NODE * (place.body - 1)
                arm = np.subtract(place.point, own.centre)
                self._of_bodies[k, :, first : first + NODE] = carried(arm)[:_AXES]

    def displacements(self, lumps: FloatArray, bodies: FloatArray) -> FloatArray:
        """Return x, y, z of every place, shape (n, markers, 3), from motions of shape (n, lumps or bodies, 6)."""
        n = len(lumps)
        found: FloatArray = np.einsum("maj,nj->nma", self._of_lumps, lumps.reshape(n, -1))
        found += np.einsum("maj,nj->nma", self._of_bodies, bodies.reshape(n, -1))
        return found

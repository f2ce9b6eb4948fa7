"""Write waves of elastic rings as tables and channels.

Behind the bodies of a bearing stands one for each number of waves of each elastic body: its y and z are the amplitudes
of cosine and sine, on supports as stiff and damped as the wave, and no weight.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.formulas.elastic.ring import RingWaves, ovality
from lambda_core.model.bearing_model import BearingModel
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.row_cages import own_bodies

AMPLITUDES = (L.SY, L.SZ)
_CAGE = list(BODIES).index("cage")


def waves_of(model: BearingModel) -> list[tuple[int, int, RingWaves]]:
    """Return body, order and waves.

    Each wave has a ring or cage (number of its body); waves follow the order of their bodies.
    """
    bodies = list(BODIES)
    return [(bodies.index(body), n, waves) for body, waves in model.elastic.items() for n in waves.counts]


def wave_rows(model: BearingModel, bodies: Sequence[int]) -> Any:
    """Return the table of waves, records.WAVE.

    Parameters
    ----------
    bodies : sequence of int
        Numbers of inner ring, outer ring, cages, and of every wave.
    """
    found = waves_of(model)
    rows = np.zeros(len(found), R.WAVE)
    for row, body, (ring, order, waves) in zip(rows, bodies[own_bodies(model) :], found, strict=True):
        row["ring"], row["body"], row["order"], row["coupling"] = bodies[ring], body, order, waves.coupling(order)
    return rows


def wave_bodies(model: BearingModel) -> Any:
    """Return the bodies of the waves, records.BODY."""
    found = waves_of(model)
    rows = np.zeros(len(found), R.BODY)
    for row, (ring, order, waves) in zip(rows, found, strict=True):
        row["is_cage"], row["is_wave"] = ring == _CAGE, 1
        row["mass"], row["transverse_inertia"], row["polar_inertia"] = waves.ring.mass(order), 1.0, 1.0
        row["mode"], row["moves"] = R.LOCKED, 1
        for axis in AMPLITUDES:
            row["mode"][axis] = R.FREE
            row["stiffness"][axis], row["damping"][axis] = waves.ring.stiffness(order), waves.damping(order)
    return rows


def give_waves(table: Any, body: str, waves: Any, before: int) -> None:
    """Write the places of waves into rows.

    Every row of a table has a field that names its elastic body.

    Parameters
    ----------
    before : int
        Waves of the bearings before.
    """
    for row in table:
        own = np.flatnonzero(waves["ring"] == row[body])
        row["waves"] = (before + own[0], before + own[-1] + 1) if own.size else (0, 0)


def waves_at(bundle: L.Bundle, model: BearingModel, free: FloatArray) -> dict[BodyName, FloatArray]:
    """Return the amplitudes of elastic bodies [m].

    Each has shape (orders, 2), from free entries of the shared state.
    """
    bodies = np.zeros((1, bundle.bodies.size), R.BODY_STATE)
    bodies[0].view(np.float64)[bundle.active] = free
    return {body: amplitudes[0] for body, amplitudes in _amplitudes(bodies, model).items()}


def _amplitudes(bodies: Any, model: BearingModel) -> dict[BodyName, FloatArray]:
    """Return the amplitudes from states [m].

    Every elastic body has shape (n, orders, 2), from states of shape (n, bodies).
    """
    first, found = own_bodies(model), {}
    for body, waves in model.elastic.items():
        found[body] = bodies["position"][:, first : first + len(waves.counts), 1:].copy()
        first += len(waves.counts)
    return found


def wave_values(bodies: Any, model: BearingModel) -> dict[str, FloatArray]:
    """Return the channels of elastic bodies.

    They come from states of bodies, records.BODY_STATE of shape (n, bodies).
    """
    found: dict[str, FloatArray] = {}
    for body, amplitudes in _amplitudes(bodies, model).items():
        for i, order in enumerate(model.elastic[body].counts):
            found[f"{body}_waves_{order}"] = amplitudes[:, i].copy()
        found[f"{body}_ovality"] = ovality(amplitudes)
    return found

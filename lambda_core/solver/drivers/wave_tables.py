"""Waves of elastic rings and cages as rows of the tables of compiled code, and as channels of a result.

Behind the bodies of a bearing stands one for each number of waves of each elastic body: its y and z are the amplitudes
of cosine and sine, on supports as stiff and damped as the wave, and no weight.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, BodyName
from lambda_core.elastic.ring import RingWaves, ovality
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.system.bearing import BearingModel

_AMPLITUDES = (L.SY, L.SZ)
_RATES = (L.SVY, L.SVZ)
_CAGE = list(BODIES).index("cage")


def waves_of(model: BearingModel) -> list[tuple[int, int, RingWaves]]:
    """Return ring or cage (number of its body), order and waves of every wave, in the order of their bodies."""
    bodies = list(BODIES)
    return [(bodies.index(body), n, waves) for body, waves in model.elastic.items() for n in waves.counts]


def wave_rows(model: BearingModel) -> Any:
    """Return the table of waves, records.WAVE."""
    found = waves_of(model)
    rows = np.zeros(len(found), R.WAVE)
    for i, (row, (ring, order, waves)) in enumerate(zip(rows, found, strict=True)):
        row["ring"], row["body"], row["order"], row["coupling"] = ring, len(BODIES) + i, order, waves.coupling(order)
    return rows


def wave_bodies(model: BearingModel) -> Any:
    """Return the bodies of the waves, records.BODY."""
    found = waves_of(model)
    rows = np.zeros(len(found), R.BODY)
    for row, (ring, order, waves) in zip(rows, found, strict=True):
        row["is_cage"] = ring == _CAGE
        row["mass"], row["transverse_inertia"], row["polar_inertia"] = waves.ring.mass(order), 1.0, 1.0
        row["mode"], row["moves"] = R.LOCKED, 1
        for axis in _AMPLITUDES:
            row["mode"][axis] = R.FREE
            row["stiffness"][axis], row["damping"][axis] = waves.ring.stiffness(order), waves.damping(order)
    return rows


def give_waves(table: Any, body: str, waves: Any) -> None:
    """Write into every row of a table where the waves of its elastic body stand, which is named in a field."""
    for row in table:
        own = np.flatnonzero(waves["ring"] == row[body])
        row["waves"] = (own[0], own[-1] + 1) if own.size else (0, 0)


def wave_states(model: BearingModel) -> list[int]:
    """Return the free entries of the shared state that belong to waves."""
    first = len(BODIES)
    return [L.NS * (first + i) + entry for i in range(len(waves_of(model))) for entry in (*_AMPLITUDES, *_RATES)]


def weightless(model: BearingModel, per_body: int, force: int) -> NDArray[np.void]:
    """Return loads, records.TERM, that hold up the bodies of waves: gravity bends no ring."""
    masses = [waves.ring.mass(order) for _, order, waves in waves_of(model)]
    rows = np.zeros((len(masses), len(_AMPLITUDES)), R.TERM)
    rows["kind"] = R.CONSTANT
    for i, mass in enumerate(masses):
        for k, axis in enumerate(_AMPLITUDES):
            rows[i, k]["signal"] = per_body * (len(BODIES) + i) + force + axis
            rows[i, k]["value"] = -mass * model.gravity[axis]
    return rows.ravel()


def waves_at(bundle: L.Bundle, model: BearingModel, free: FloatArray) -> dict[BodyName, FloatArray]:
    """Return the amplitudes of every elastic body, shape (orders, 2) [m], from free entries of the shared state."""
    bodies = np.zeros((1, bundle.bodies.size), R.BODY_STATE)
    bodies[0].view(np.float64)[bundle.active] = free
    return {body: amplitudes[0] for body, amplitudes in _amplitudes(bodies, model).items()}


def _amplitudes(bodies: Any, model: BearingModel) -> dict[BodyName, FloatArray]:
    """Return the amplitudes of every elastic body, shape (n, orders, 2) [m], from states, shape (n, bodies)."""
    first, found = len(BODIES), {}
    for body, waves in model.elastic.items():
        found[body] = bodies["position"][:, first : first + len(waves.counts), 1:].copy()
        first += len(waves.counts)
    return found


def wave_values(bodies: Any, model: BearingModel) -> dict[str, FloatArray]:
    """Return the channels of elastic bodies from states of bodies, records.BODY_STATE of shape (n, bodies)."""
    found: dict[str, FloatArray] = {}
    for body, amplitudes in _amplitudes(bodies, model).items():
        for i, order in enumerate(model.elastic[body].counts):
            found[f"{body}_waves_{order}"] = amplitudes[:, i].copy()
        found[f"{body}_ovality"] = ovality(amplitudes)
    return found

"""Give each row of balls a cage of its own.

The first cage is a member of the assembly. The others follow the members, before the waves of elastic rings, and have
the mass, supports, loads and motions of the first. The place of each is that of its row.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, CAGE
from lambda_core.elements.ball.raceways import row_places
from lambda_core.model.bearing_model import BearingModel

if TYPE_CHECKING:
    from lambda_core.solver.drivers.assembly import Assembly


def cage_places(model: BearingModel) -> tuple[float, ...]:
    """Return where each cage is along the axis [m].

    One cage of all rows is in the middle of the bearing.
    """
    return row_places(model.geometry) if model.cage.per_row else (0.0,)


def further_cages(model: BearingModel) -> int:
    """Return the number of cages after the first."""
    return len(cage_places(model)) - 1


def own_bodies(model: BearingModel) -> int:
    """Return the number of rings and cages.

    Waves of elastic rings follow them.
    """
    return len(BODIES) + further_cages(model)


def cages_in(bodies: Sequence[int], model: BearingModel) -> tuple[int, ...]:
    """Return the bodies of the cages, row by row.

    Parameters
    ----------
    bodies : sequence of int
        Those of a bearing: inner ring, outer ring, first cage, further cages, waves.
    """
    return tuple(bodies[CAGE : own_bodies(model)])


def put_cages(assembly: Assembly, positions: FloatArray) -> None:
    """Put cages per row where their rows are.

    Parameters
    ----------
    positions : float64[:, :], shape (bodies, 3)
        Changed in place [m].
    """
    for bearing, span in zip(assembly.bearings, assembly.spans(), strict=True):
        if bearing.model.cage.per_row:
            positions[list(cages_in(span.bodies, bearing.model)), 0] = cage_places(bearing.model)


def start_cages(model: BearingModel, bodies: Any, balls: Any, orbit: float, tilt: tuple[float, float]) -> None:
    """Write the states of cages, centred on their balls.

    Parameters
    ----------
    bodies : records.BODY_STATE, shape (bodies,)
        Changed in place.
    balls : records of balls
        Of all rows.
    orbit : float
        Speed of the cages [rad/s].
    tilt : tuple of 2 floats
        y and z component of the axis of the inner ring where the rows lean with it; zeros elsewhere.
    """
    cages = bodies[CAGE : own_bodies(model)]
    cages.view(np.float64)[:] = 0.0
    for cage, row, place in zip(cages, balls.reshape(cages.size, -1), cage_places(model), strict=True):
        cage["position"] = float(np.mean(row["x"])), place * tilt[0], place * tilt[1]
        cage["angle"], cage["spin"], cage["tilt"] = row["azimuth"][0], orbit, tilt


def cage_values(bodies: Any, model: BearingModel) -> dict[str, FloatArray]:
    """Return the channels of the second row's cage.

    They come from states of bodies, records.BODY_STATE of shape (n, bodies).
    """
    if not further_cages(model):
        return {}
    cage = bodies[:, CAGE + 1]
    return {
        "second_cage_position": np.array(cage["position"]),
        "second_cage_tilt": np.column_stack([-cage["tilt"][:, 1], cage["tilt"][:, 0]]),
        "second_cage_spin_angle": np.array(cage["angle"]),
        "second_cage_spin": np.array(cage["spin"]),
    }

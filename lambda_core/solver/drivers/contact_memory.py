"""Name and initialise the states that contacts keep.

They follow the motion in the state vector.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.elements.ball.raceways import raceways, raceways_of_a_ball
from lambda_core.laws.state import ROLE
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.state_channels import state_channels, states_of
from lambda_core.solver.drivers.assembly import Assembly
from lambda_core.solver.drivers.tables import Tables, plain

_STEP = 1e-6  # of a state's scale, for the slopes of its rates


def state_arrays(assembly: Assembly, tables: Tables) -> dict[str, Any]:
    """Return the arrays of contact states.

    They are those of layout.Bundle, with every state at its start.
    """
    models = [bearing.model for bearing in assembly.bearings]
    counts = [model.geometry.ball_count for model in models for _ in raceways(model.geometry)]
    starts = []
    for raceway, balls in zip(plain(tables.raceways), counts, strict=True):
        end, count = int(raceway["parameters"][ROLE][1]), int(raceway["states"])
        starts.append(np.tile(tables.par[end - count : end], balls))
    start = np.concatenate(starts)
    most = int(tables.raceways["states"].max())
    return {
        "states": start,
        "state_rates": np.zeros(start.size),
        "state_steps": _STEP * np.concatenate([state_tail(model) for model in models]),
        "state_slopes": np.zeros((start.size, most)),
        "state_pivots": np.zeros(most, dtype=np.int64),
    }


def state_tail(model: BearingModel) -> FloatArray:
    """Return the scales of all contact states.

    They are those of a bearing.
    """
    rows = [
        np.tile([state.scale for state in states_of(model, raceway.element)], model.geometry.ball_count)
        for raceway in raceways(model.geometry)
    ]
    return np.concatenate(rows).astype(np.float64)


def channels_of_states(model: BearingModel, tails: FloatArray) -> dict[str, FloatArray]:
    """Return the channels of contact states.

    The ends of n state vectors hold them; the array has shape (n, balls, 2).

    Of four-point contact (n, balls, 4), by arc. NaN for a raceway whose law does not keep the state.
    """
    g = model.geometry
    count, z = len(tails), g.ball_count
    places = sum(raceway.end == 0 for raceway in raceways_of_a_ball(g))  # ribs of rollers keep nothing
    found = {channel.name: np.full((count, g.balls, places), np.nan) for channel in state_channels(model)}
    begin = 0
    for i, raceway in enumerate(raceway for raceway in raceways(g) if raceway.end == 0):
        states, row = states_of(model, raceway.element), slice(raceway.row * z, (raceway.row + 1) * z)
        own = tails[:, begin : begin + z * len(states)].reshape(count, z, len(states))
        for k, state in enumerate(states):
            found[state.name][:, row, i % places] = np.clip(own[:, :, k], state.lower, state.upper)
        begin += z * len(states)
    return found


def hand_over(model: BearingModel, bundle: Any, sample: Mapping[str, FloatArray], ball: int, place: int) -> None:
    """Write a sample's contact states for laws.

    The laws of the contact's raceway read them.

    Parameters
    ----------
    place : int
        Which one of the ball's contacts.
    """
    raceway = bundle.raceways[place]
    states = states_of(model, raceways_of_a_ball(model.geometry)[place].element)
    begin, end = raceway["slots"]
    for slot in bundle.slots[begin:end]:
        bundle.par[slot["place"]] = sample[states[slot["state"]].name][ball, place]

"""List the bodies that the balls of each row reach."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lambda_core.laws.jit.words import by_reference
from lambda_core.solver.arrays.bundle import INTEGERS, INTEGERS2, NS, SVX


@by_reference(
    INTEGERS2,
    **dict.fromkeys(("first", "states", "count", "width", "positions", "middles", "ends", "speeds", "among"), INTEGERS),
)
class Reach(NamedTuple):
    """Own bodies of each row of balls.

    It also has the places of their states.
    """

    first: Any  # int64 (rows + 1,): first ball of each row, in the end the number of balls
    states: Any  # int64 (rows + 1,): where its states begin in the state vector, in the end the shared ones
    count: Any  # int64 (rows,): own bodies
    bodies: Any  # int64 (rows, places): the own bodies, in the order of all
    place: Any  # int64 (rows, bodies): place of each body among the own ones, or -1
    width: Any  # int64 (rows,): free states of the own bodies
    columns: Any  # int64 (rows, widest): their positions among all free shared states
    index: Any  # int64 (rows, 12 places): position of each state of the own bodies among their free ones, or -1
    positions: Any  # int64 (p,): positions and angles among all free shared states
    middles: Any  # int64 (p,): the first speed of the body of each
    ends: Any  # int64 (p,): one behind the last free state of the body of each
    speeds: Any  # int64 (n - p,): the other ones, those of cages before those of the shaft
    among: Any  # int64 (n,): place of each state among the speeds, or -1


def _own_bodies(bundle: Any, row: Any) -> list[int]:
    """Return the bodies that a row touches.

    Its balls touch them; the bodies are in order.
    """
    begin = int(row["first_raceway"])
    raceways = bundle.raceways[begin : begin + int(row["raceways"])]
    touched = {int(body) for body in raceways["body"]}
    touched |= {int(body) for first, last in raceways["waves"] for body in bundle.waves["body"][first:last]}
    if row["caged"]:
        first, last = row["waves"]
        touched |= {int(row["cage"]), *bundle.waves["body"][first:last].tolist()}
    return sorted(touched)


def make_reach(bundle: Any) -> Reach:
    """Return the reach of each row.

    It is a row of the tables in a bundle.
    """
    own = [_own_bodies(bundle, row) for row in bundle.rows]
    rows, places = len(own), max(len(bodies) for bodies in own)
    positions = np.full(NS * bundle.bodies.size, -1, dtype=np.int64)
    positions[bundle.active] = np.arange(bundle.active.size)
    states = [np.concatenate([NS * body + np.arange(NS) for body in bodies]) for bodies in own]
    free = [positions[of][positions[of] >= 0] for of in states]
    is_speed, body = bundle.active % NS >= SVX, bundle.active // NS
    # What few others touch is eliminated first, and leaves the rest as it is: the tables end with cages and waves.
    speeds = np.flatnonzero(is_speed)[::-1].astype(np.int64)
    found = Reach(
        first=np.array([*bundle.rows["first_ball"], bundle.system["balls"][0]], dtype=np.int64),
        states=np.array([*bundle.rows["first_state"], bundle.system["tail"][0]], dtype=np.int64),
        count=np.array([len(bodies) for bodies in own], dtype=np.int64),
        bodies=np.zeros((rows, places), dtype=np.int64),
        place=np.full((rows, bundle.bodies.size), -1, dtype=np.int64),
        width=np.array([columns.size for columns in free], dtype=np.int64),
        columns=np.zeros((rows, max(columns.size for columns in free)), dtype=np.int64),
        index=np.full((rows, NS * places), -1, dtype=np.int64),
        positions=np.flatnonzero(~is_speed).astype(np.int64),
        middles=np.searchsorted(2 * body + is_speed, 2 * body[~is_speed] + 1).astype(np.int64),
        ends=np.searchsorted(body, body[~is_speed], side="right").astype(np.int64),
        speeds=speeds,
        among=np.full(bundle.active.size, -1, dtype=np.int64),
    )
    found.among[speeds] = np.arange(speeds.size)
    for r, (bodies, of, columns) in enumerate(zip(own, states, free, strict=True)):
        found.bodies[r, : len(bodies)] = bodies
        found.place[r, bodies] = np.arange(len(bodies))
        found.columns[r, : columns.size] = columns
        found.index[r, : of.size] = np.where(positions[of] >= 0, np.cumsum(positions[of] >= 0) - 1, -1)
    return found

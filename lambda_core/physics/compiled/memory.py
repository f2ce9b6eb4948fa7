"""What the integrator remembers, and the types of what it calls."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numba import types

from lambda_core.physics.compiled.blocks import blocks_t
from lambda_core.physics.compiled.layout import (
    BR,
    BVR,
    BVX,
    BWX,
    BX,
    NB,
    NI,
    NS,
    SSIGMA,
    SVX,
    SWY,
    SX,
    array1,
    array2,
    bundle_t,
    f8,
    i8,
    iarray1,
)

evaluate_sig = i8(f8, array1, bundle_t, array1, array1, i8)
jacobian_sig = i8(f8, array1, bundle_t, blocks_t)
evaluate_t = types.FunctionType(evaluate_sig)
jacobian_t = types.FunctionType(jacobian_sig)

# control: reals of the integrator. BDF_GAMMA, BDF_BACK: coefficients of the step in hand (see bdf).
# LEAK_FLOOR: energy that any step may lose [J]; LOST: power dissipated at control[T] [W].
(
    T,
    H,
    H1,
    H2,
    G_FACTORED,
    RATE,
    NEXT_SAMPLE,
    SAMPLE_STEP,
    H_MAX,
    H_MIN,
    T_LAST,
    BDF_GAMMA,
    BDF_BACK,
    TOLERANCE,
    LEAK_FLOOR,
    LOST,
) = range(16)
N_CONTROL = 16
# count: integers of the integrator
(
    HISTORY,
    STEPS,
    REJECTED,
    NEWTON,
    RHS,
    JACOBIANS,
    FACTORS,
    STALE,
    SAMPLES,
    AGE,
    FAILED,
    CAREFUL,
    LOCAL,
) = range(13)
N_COUNT = 16


class Memory(NamedTuple):
    """Everything the integrator remembers; saved as it is for a continuation."""

    y: Any  # (n,) at control[T]
    y1: Any  # (n,) one step before
    y2: Any  # (n,) two steps before
    shared: Any  # (3 NS,) the whole shared state at control[T]
    shared1: Any  # (3 NS,) and one step before
    integrals: Any  # (NI,)
    integrals1: Any  # (NI,) one step before
    rates: Any  # (NI,) rates of the integrals at the step in hand
    weight: Any  # (n,) 1 / (tolerance * scale)
    inertia: Any  # (n,) mass or moment of inertia of a speed, 0 for a position [kg, kg m2]
    place: Any  # int64 (n,): state that is the position of a speed along which contacts press, or -1
    control: Any  # (N_CONTROL,)
    count: Any  # int64 (N_COUNT,)
    predicted: Any  # (n,)
    base: Any  # (n,)
    new: Any  # (n,)
    slope: Any  # (n,)
    change: Any  # (n,)
    last_change: Any  # (n,) Newton correction of the iteration before
    last_move: Any  # (n,) and the move that was made of it
    sample_y: Any  # (capacity, n)
    sample_t: Any  # (capacity,)


memory_t = types.NamedTuple(
    [{"count": iarray1, "place": iarray1, "sample_y": array2}.get(name, array1) for name in Memory._fields],
    Memory,
)


def make_memory(y0: np.ndarray, scale: np.ndarray, tolerance: float, bundle: Any, capacity: int = 256) -> Memory:
    """Allocate for the initial state y0 and absolute scales, both (n,), of the bearing in `bundle`."""
    n = y0.size
    arrays: dict[str, np.ndarray] = {name: np.zeros(n) for name in Memory._fields}
    inertia = inertias(bundle.system[0], bundle.active)
    control = np.zeros(N_CONTROL)
    control[TOLERANCE] = tolerance
    # Differences of one tolerance in every speed are never too much.
    control[LEAK_FLOOR] = 0.25 * np.sum(inertia * (tolerance * scale) ** 2)
    arrays.update(
        y=y0.copy(),
        shared=np.zeros(3 * NS),
        shared1=np.zeros(3 * NS),
        integrals=np.zeros(NI),
        integrals1=np.zeros(NI),
        rates=np.zeros(NI),
        weight=1.0 / (tolerance * scale),
        inertia=inertia,
        place=places(bundle.system[0], bundle.active),
        control=control,
        count=np.zeros(N_COUNT, dtype=np.int64),
        sample_y=np.zeros((capacity, n)),
        sample_t=np.zeros(capacity),
    )
    return Memory(**arrays)


def inertias(system: Any, active: np.ndarray) -> np.ndarray:
    """Return what each state carries kinetic energy with, shape (n,): mass, moment of inertia, 0 for positions."""
    ball = np.zeros(NB)
    ball[BVX:BWX], ball[BWX:] = system["ball_mass"], system["ball_inertia"]
    bodies = np.zeros((3, NS))
    bodies[:, SVX:SWY] = system["mass"][:, None]
    bodies[:, SWY:SSIGMA] = system["transverse_inertia"][:, None]
    bodies[:, SSIGMA] = system["polar_inertia"]
    return np.concatenate([np.tile(ball, int(system["balls"])), bodies.ravel()[active]])


def places(system: Any, active: np.ndarray) -> np.ndarray:
    """Return the index of the position that belongs to a speed, shape (n,), or -1.

    Only where normal forces act: a ball's x and r, a body's x, y, z.
    """
    balls = int(system["balls"])
    found = np.full(NB * balls + active.size, -1, dtype=np.int64)
    for speed, position in ((BVX, BX), (BVR, BR)):
        found[speed : NB * balls : NB] = np.arange(position, NB * balls, NB)
    where = {int(entry): NB * balls + i for i, entry in enumerate(active)}
    for entry, i in where.items():
        if SVX <= entry % NS < SWY:
            found[i] = where.get(entry - SVX + SX, -1)
    return found

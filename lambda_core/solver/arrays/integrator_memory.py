"""Hold the memory of the integrator."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from lambda_core.laws.jit.words import FUNCTION, Array, by_reference
from lambda_core.solver.arrays.bundle import (
    ARRAY1,
    ARRAY2,
    BR,
    BVR,
    BVX,
    BX,
    ELEMENTS,
    INTEGERS,
    NS,
    SVX,
    SWY,
    SX,
    Bundle,
    power_count,
)
from lambda_core.solver.arrays.factors import Factors
from lambda_core.solver.arrays.jacobian_blocks import Blocks
from lambda_core.solver.records import BODY_STATE, ROLLERS

_NEWTON = 0.3  # of the error allowed per step, what the iteration may leave
_FINE_NEWTON = 0.03  # the same where vibrations are followed: what it leaves shakes the modes that nothing damps
PAST = 2  # slopes of the last step that a one-step formula keeps

# How far the integrator has come, and with which steps.
CONTROL = np.dtype(
    [
        ("time", np.float64),  # end of the last step [s]
        ("step", np.float64),  # length of the next one [s]
        ("last_step", np.float64),  # [s]
        ("step_before", np.float64),  # the one before the last [s]
        ("longest_step", np.float64),  # [s]
        ("stop", np.float64),  # time that no step passes; one that is behind `time` stops nothing [s]
        ("newton_tolerance", np.float64),  # of the iteration, over the error allowed per step [-]
        ("shortest_step", np.float64),  # below which the integrator gives up [s]
        ("gamma", np.float64),  # of the step in hand: new = base + gamma f(new) [s]
        ("back", np.float64),  # base = y + back (y - y1) [-]
        ("factored_gamma", np.float64),  # gamma that the arrow matrix was factored for, 0 when it is out of date [s]
        ("convergence_rate", np.float64),  # of Newton's iteration: change over the change before [-]
        ("tolerance", np.float64),  # of errors, in scales of the states [-]
        ("leak_floor", np.float64),  # energy that the longest step may lose though nothing flows [J]
        ("allowance", np.float64),  # energy that steps have left of what they might have lost [J]
        ("kept", np.float64),  # of it the step in hand [J]
        ("dissipated_power", np.float64),  # at `time` [W]
        ("fourth_powers", np.float64),  # of all steps, their sum: what the scheme takes of vibrations goes with it [s4]
        ("turned_over", np.float64),  # energy that went to and fro between motion and forces; 0: not counted [J]
        ("sample_interval", np.float64),  # [s]
        ("next_sample", np.float64),  # time of it [s]
        ("samples_taken", np.float64),  # since the start
    ],
    align=True,
)
# What the integrator counts; flags are 0 or 1.
COUNT = np.dtype(
    [
        ("history", np.int64),  # steps behind the present one that the formula may use: 0, 1, 2
        ("stale", np.int64),  # flag: the Jacobian is to be renewed before it is used
        ("careful", np.int64),  # steps for which the iteration is still damped (damped.solve_damped)
        ("jacobian_age", np.int64),  # steps since it was renewed for all balls
        ("samples_waiting", np.int64),  # in the buffer
        ("steps", np.int64),  # accepted
        ("rejected", np.int64),  # steps whose error was too large
        ("failed", np.int64),  # steps whose iteration did not converge
        ("newton_iterations", np.int64),
        ("rhs_calls", np.int64),
        ("jacobians", np.int64),  # of all balls
        ("ball_jacobians", np.int64),  # of single balls, during an iteration
        ("factorisations", np.int64),
        ("bypasses", np.int64),  # of bearings in iterations in which others were evaluated
    ],
    align=True,
)


@by_reference(
    ARRAY1,
    **dict.fromkeys(("stages", "stage_rates", "stage_shared", "sample_y"), ARRAY2),
    place=INTEGERS,
    control=Array(CONTROL),
    count=Array(COUNT),
)
class Memory(NamedTuple):
    """Memory of the integrator.

    It is saved as it is for a continuation.
    """

    y: Any  # (n,) at `control.time`
    y1: Any  # (n,) one step before
    y2: Any  # (n,) two steps before
    shared: Any  # (3 NS,) the whole shared state at `control.time`
    shared1: Any  # (3 NS,) and one step before
    shared_base: Any  # (3 NS,) base of the quotient D(u) of what is prescribed
    stages: Any  # (8, n) dy/dt at the stages of a step, at the start and a later stage of the last one; or (0, n)
    stage_rates: Any  # (6, powers) rates of the integrals at the stages of a step; or (0, powers)
    stage_shared: Any  # (6, 3 NS) d/dt of the shared state there; or (0, 3 NS)
    integrals: Any  # (powers,)
    integrals1: Any  # (powers,) one step before
    rates: Any  # (powers,) rates of the integrals at the step in hand
    weight: Any  # (n,) 1 / (tolerance * scale)
    inertia: Any  # (n,) mass or moment of inertia of a speed, 0 for a position [kg, kg m2]
    place: Any  # int64 (n,): state that is the position of a speed along which contacts press, or -1
    control: Any  # CONTROL record, shape (1,)
    count: Any  # COUNT record, shape (1,)
    predicted: Any  # (n,)
    base: Any  # (n,)
    new: Any  # (n,)
    slope: Any  # (n,)
    change: Any  # (n,)
    last_change: Any  # (n,) Newton correction of the iteration before
    last_move: Any  # (n,) and the move that was made of it
    since: Any  # (n,) all moves since the forces that stand were computed: of bearings that rest more than the last
    sample_y: Any  # (capacity, n)
    sample_t: Any  # (capacity,)


@by_reference(FUNCTION, bundle=Bundle, blocks=Blocks, factors=Factors, memory=Memory)
class Handle(NamedTuple):
    """Everything that an integration takes."""

    evaluate: Any  # pointer to forces.evaluate
    jacobian: Any  # pointer to jacobian.jacobian
    advance: Any  # pointer to bdf.advance or esdirk.advance
    observe: Any  # pointer to sampling.observe
    bundle: Any  # Bundle
    blocks: Any  # Blocks
    factors: Any  # Factors
    memory: Any  # Memory


def make_memory(
    y0: np.ndarray, scale: np.ndarray, tolerance: float, bundle: Any, capacity: int = 256, *, stages: int = 0
) -> Memory:
    """Allocate the memory of the integrator.

    The bearing in `bundle` gives the initial state y0 and the absolute scales, both of shape (n,).

    `stages` are those of a one-step formula; a multistep formula has none.
    """
    n, powers = y0.size, power_count(bundle)
    arrays: dict[str, np.ndarray] = {name: np.zeros(n) for name in Memory._fields}
    inertia = inertias(bundle)
    control = np.zeros(1, dtype=CONTROL)
    control["tolerance"], control["stop"] = tolerance, np.inf
    control["newton_tolerance"] = _FINE_NEWTON if stages else _NEWTON
    # Differences of one tolerance in every speed, over the longest step, are never too much.
    control["leak_floor"] = 0.25 * np.sum(inertia * (tolerance * scale) ** 2)
    arrays.update(
        y=y0.copy(),
        shared=np.zeros(bundle.shared.size),
        shared1=np.zeros(bundle.shared.size),
        shared_base=np.zeros(bundle.shared.size),
        stages=np.zeros((stages + PAST if stages else 0, n)),
        stage_rates=np.zeros((stages, powers)),
        stage_shared=np.zeros((stages, bundle.shared.size)),
        integrals=np.zeros(powers),
        integrals1=np.zeros(powers),
        rates=np.zeros(powers),
        weight=1.0 / (tolerance * scale),
        inertia=inertia,
        place=places(bundle),
        control=control,
        count=np.zeros(1, dtype=COUNT),
        sample_y=np.zeros((capacity, n)),
        sample_t=np.zeros(capacity),
    )
    return Memory(**arrays)


def inertias(bundle: Any) -> np.ndarray:
    """Return the inertia of each state.

    The array has shape (n,): a mass, a moment of inertia, or 0 for positions.
    """
    elements = np.zeros(int(bundle.system["tail"][0]))
    for row in bundle.rows:
        first, size = int(row["first_state"]), int(row["size"])
        its = elements[first : first + size * int(row["balls"])].view(ELEMENTS[size])
        its["velocity"], its["spin"] = row["ball_mass"], row["ball_inertia"]
        if row["kind"] == ROLLERS:
            its["spin"][:, 1:] = row["transverse_inertia"]
    bodies = np.zeros(bundle.bodies.size, BODY_STATE)
    bodies["velocity"] = bundle.bodies["mass"][:, None]
    bodies["tilt_velocity"] = bundle.bodies["transverse_inertia"][:, None]
    bodies["spin"] = bundle.bodies["polar_inertia"]
    kept = np.zeros(bundle.states.size)
    return np.concatenate([elements, bodies.view(np.float64)[bundle.active], kept])


def places(bundle: Any) -> np.ndarray:
    """Return the position index of each speed.

    The array has shape (n,); a state that is no speed has -1.

    Only where normal forces act: a ball's x and r, a body's x, y, z.
    """
    tail, active = int(bundle.system["tail"][0]), bundle.active
    found = np.full(tail + active.size + bundle.states.size, -1, dtype=np.int64)
    for row in bundle.rows:
        first = row["first_state"] + row["size"] * np.arange(row["balls"])
        for speed, position in ((BVX, BX), (BVR, BR)):
            found[first + speed] = first + position
    where = {int(entry): tail + i for i, entry in enumerate(active)}
    for entry, i in where.items():
        if SVX <= entry % NS < SWY:
            found[i] = where.get(entry - SVX + SX, -1)
    return found

"""Tables of compiled code for a whole: the lumps of a shaft, and of every bearing its rings, cage, balls and laws.

Bodies stand in the order: first lump, outer ring of the first bearing, the other lumps, then the other outer rings and
cages bearing by bearing. A bearing's inner ring is the lump at its place; every bearing has its own origin at its place
along the shaft, so that all positions are displacements. The bodies beside the shaft follow. Where the shaft twists and
the coupling turns it beside all lumps, a body without mass comes then, whose angle leads; last the waves of elastic
rings and cages, bearing by bearing.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, DOFS, INNER, OUTER
from lambda_core.elastic.beam import NODE
from lambda_core.shaft.lumps import LumpedShaft, unbalance_of_lumps
from lambda_core.shaft.structure import Rows, structure
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.solver_context import SolverContext, assemble
from lambda_core.solver.drivers.time_tables import FORCE, MOMENT, MOTION, PER_BODY
from lambda_core.system.bearing import DofState
from lambda_core.system.machine import GROUND, PLACES, Machine, MountedBearing

# State that each displacement of PLACES or POSE moves, and its sign: turning about +y moves a_z towards -.
STATES = np.array([L.SX, L.SY, L.SZ, L.SAZ, L.SAY])
SIGNS = np.array([1.0, 1.0, 1.0, -1.0, 1.0])
# The same of a lump, which twists, too: of the six rows of a node.
LUMP_STATES = np.array([L.SX, L.SY, L.SZ, L.STHETA, L.SAZ, L.SAY])
LUMP_SIGNS = np.array([1.0, 1.0, 1.0, 1.0, -1.0, 1.0])
_RATES = np.array([L.SVX, L.SVY, L.SVZ, L.SWY, L.SWZ])
_OFFSETS = {"guide_law": 3, "drag_law": 1}  # laws of one bearing in these tables


@dataclass(frozen=True)
class Part:
    """Where a bearing stands in the tables and states of the whole.

    Attributes
    ----------
    bearing : MountedBearing
    alone : SolverContext
        Of the bearing alone, rings and cage free in every direction: what its results are read by.
    bodies : tuple of ints
        Lump that carries the inner ring, outer ring, cage; then the waves of elastic ones.
    first_ball, first_row, first_raceway, first_state, first_slot, first_wave : int
    """

    bearing: MountedBearing
    alone: SolverContext
    bodies: tuple[int, ...]
    first_ball: int
    first_row: int
    first_raceway: int
    first_state: int
    first_slot: int
    first_wave: int

    @property
    def balls(self) -> int:
        """How many."""
        return self.alone.model.geometry.balls


def all_free(found: SolverContext) -> SolverContext:
    """Return the context of the same bearing whose bodies are free in every direction."""
    model = found.model
    loose = dict.fromkeys(DOFS, DofState("free"))
    bodies = {name: dataclasses.replace(getattr(model, name), dofs=loose)
              for name in ("inner_ring", "outer_ring", "cage_body")}  # fmt: skip
    return assemble(dataclasses.replace(model, **bodies, links={}), found.kernels, found.frame, found.oils)


def make_parts(model: Machine, shaft: LumpedShaft, contexts: list[SolverContext]) -> tuple[Part, ...]:
    """Give every bearing its places."""
    found: list[Part] = []
    balls, rows, raceways, states, slots, waves = 0, 0, 0, 0, 0, 0
    behind = table_size(model, shaft, ())
    for i, (bearing, context) in enumerate(zip(model.bearings, contexts, strict=True)):
        lump = shaft.at(bearing.position)
        inner = lump + 1 if lump else 0
        outer = 1 if i == 0 else shaft.positions.size + 2 * i
        cage = shaft.positions.size + 2 * i + 1
        count = context.bundle.waves.size
        bodies = (inner, outer, cage, *range(behind + waves, behind + waves + count))
        found.append(Part(bearing, context, bodies, balls, rows, raceways, states, slots, waves))
        balls += found[-1].balls
        rows += context.bundle.rows.size
        raceways += context.bundle.raceways.size
        states += context.bundle.states.size
        slots += context.bundle.slots.size
        waves += count
    return tuple(found)


def lump_bodies(shaft: LumpedShaft) -> NDArray[np.int64]:
    """Return the body of every lump."""
    return np.array([0, *range(2, shaft.positions.size + 1)])


def led_bodies(model: Machine, shaft: LumpedShaft) -> NDArray[np.int64]:
    """Return the bodies that the coupling turns: all lumps, or where the shaft twists one, or the body behind all."""
    lumps = lump_bodies(shaft)
    if not model.twists:
        return lumps
    return np.append(lumps, body_count(model, shaft))[[shaft.driven]]


def beside_bodies(model: Machine, shaft: LumpedShaft) -> NDArray[np.int64]:
    """Return the bodies beside the shaft."""
    return np.arange(body_count(model, shaft) - len(model.bodies), body_count(model, shaft))


def table_size(model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...]) -> int:
    """Return how many bodies there are: those with a mass, one that leads, waves of elastic parts."""
    led = int(led_bodies(model, shaft).max())
    return 1 + max(body_count(model, shaft) - 1, led, *(max(part.bodies) for part in parts), 0)


def body_count(model: Machine, shaft: LumpedShaft) -> int:
    """Return how many bodies have a mass: lumps, outer rings and cages, bodies beside the shaft."""
    return shaft.positions.size + 2 * len(model.bearings) + len(model.bodies)


def whole_bundle(model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...]) -> L.Bundle:
    """Return everything that compiled code works on; loads are those of :func:`add_loads`."""
    first, bundles = parts[0].alone.bundle, [part.alone.bundle for part in parts]
    spans = np.concatenate([[0], np.cumsum([b.par.size for b in bundles])])
    bodies = _bodies(model, shaft, parts)
    raceways = np.concatenate([_raceways(part, i, int(spans[i])) for i, part in enumerate(parts)])
    system = first.system.copy()
    system["balls"] = sum(part.balls for part in parts)
    system["surfaces"] = max(int(b.system["surfaces"][0]) for b in bundles)
    tied, stiffness, damping, rest = _ties(model, shaft, parts)
    inputs, now, rates = (np.zeros(bodies.size, kind) for kind in (R.INPUTS, R.BODY_STATE, R.BODY_STATE))
    states = np.concatenate([b.states for b in bundles])
    most = max(b.state_pivots.size for b in bundles)
    laws = (np.ascontiguousarray(np.concatenate(tables)) for tables in zip(*(b.laws for b in bundles), strict=True))
    return first._replace(
        system=system, bodies=bodies, rows=np.concatenate([_rows(p, i, int(spans[i])) for i, p in enumerate(parts)]),
        raceways=raceways, waves=np.concatenate([_waves(p) for p in parts]),
        lands=np.concatenate([_lands(p, i, int(spans[i])) for i, p in enumerate(parts)]),
        slots=np.concatenate([_slots(p, int(spans[i])) for i, p in enumerate(parts)]), tied=tied,
        tie_stiffness=stiffness, tie_damping=damping, tie_rest=rest,
        tie_moves=np.zeros(tied.size), tie_rates=np.zeros(damping.shape[1]),
        state_steps=np.concatenate([b.state_steps for b in bundles]),
        laws=L.Laws(*laws), par=np.concatenate([b.par for b in bundles]), terms=np.zeros(0, R.TERM),
        table=np.zeros(1), active=_active(bodies, parts), inputs=inputs, signals=inputs.view(R.SIGNAL),
        cells=np.zeros_like(first.cells), scratch=np.zeros(1, R.SCRATCH), shared=now.view(np.float64), bodies_now=now,
        shared_rates=rates.view(np.float64), body_rates=rates, body_wrenches=np.zeros(bodies.size, R.WRENCH),
        contact_wrenches=np.zeros(bodies.size, R.WRENCH), ball_wrenches=np.zeros(int(system["balls"][0]), R.WRENCH),
        resting=np.zeros(len(parts), dtype=np.int64), bearing_powers=np.zeros(len(parts), R.RUNNING),
        states=states, state_rates=np.zeros(states.size),
        state_slopes=np.zeros((states.size, most)), state_pivots=np.zeros(most, dtype=np.int64),
    )  # fmt: skip


def _bodies(model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...]) -> Any:
    led = led_bodies(model, shaft)
    bodies = np.zeros(table_size(model, shaft, parts), R.BODY)
    bodies["moves"], bodies["mode"] = 1, R.LOCKED
    lumps = bodies[lump_bodies(shaft)]
    lumps["mass"], lumps["polar_inertia"] = shaft.mass, shaft.polar_inertia
    lumps["transverse_inertia"] = shaft.transverse_inertia
    lumps["mode"], lumps["unbalance"] = R.FREE, unbalance_of_lumps(model, shaft)[0]
    bodies[lump_bodies(shaft)] = lumps
    bodies["mode"][led, 5] = R.PRESCRIBED
    for number, rigid in zip(beside_bodies(model, shaft), model.bodies, strict=True):
        own = bodies[number]
        own["mass"], own["polar_inertia"] = rigid.mass, rigid.polar_inertia
        own["transverse_inertia"] = rigid.transverse_inertia
        dofs = (*PLACES, 3)  # the turn about x comes last
        fixed = [R.PRESCRIBED if rigid.lead[dof].terms else R.LOCKED for dof in dofs]
        own["mode"] = np.where(np.isfinite([rigid.hold[dof] for dof in dofs]), R.FREE, fixed)
    for i, part in enumerate(parts):
        inner, outer, cage = part.bodies[: CAGE + 1]
        alone = part.alone.bundle.bodies
        for name in ("mass", "transverse_inertia", "polar_inertia"):  # the ring turns with its lump
            bodies[name][inner] += alone[name][INNER]
        bodies[outer], bodies[cage] = alone[OUTER], alone[CAGE]
        bodies["mode"][outer] = [*_outer_modes(model, i), R.LOCKED]
        bodies["mode"][cage] = R.FREE
        bodies[list(part.bodies[CAGE + 1 :])] = alone[CAGE + 1 :]
    bodies["bearing"] = -1
    for i, part in enumerate(parts):
        bodies["bearing"][list(part.bodies)] = i
    return bodies


def _outer_modes(model: Machine, i: int) -> list[int]:
    """Return how an outer ring is held: springs and elastic housings tie it, and it is free between them."""
    seating, carrier = model.bearings[i].seating, model.bearings[i].carrier
    found = []
    for stiffness, lead in zip(seating.stiffness, seating.lead, strict=True):
        if math.isfinite(stiffness) or (model.housing is not None and carrier == GROUND):
            found.append(R.FREE)
        else:
            found.append(R.PRESCRIBED if lead.terms else R.LOCKED)
    return found


def _active(bodies: Any, parts: tuple[Part, ...]) -> NDArray[np.int64]:
    """Return the free entries of the shared state."""
    found: list[int] = []
    for b, body in enumerate(bodies):
        if not body["moves"]:
            continue
        for mode, state, rate in zip(body["mode"][:5], STATES, _RATES, strict=True):
            if mode == R.FREE:
                found += [L.NS * b + int(state), L.NS * b + int(rate)]
        if body["mode"][5] != R.LOCKED:
            found.append(L.NS * b + L.STHETA)
        if body["mode"][5] == R.FREE:
            found.append(L.NS * b + L.SSIGMA)
    return np.array(sorted(found), dtype=np.int64)


def _raceways(part: Part, i: int, begin: int) -> Any:
    raceways = part.alone.bundle.raceways.copy()
    sets = len(part.alone.bundle.laws.raceways)  # one for each ring, however many raceways it has
    for k, raceway in enumerate(raceways):
        raceway["number"], raceway["body"] = part.first_raceway + k, part.bodies[int(raceway["body"])]
        raceway["laws"] += sets * i
        raceway["first_state"] += part.first_state - part.first_ball * int(raceway["states"])
        raceway["slots"] += part.first_slot
        raceway["waves"] += part.first_wave
        for role in R.RACEWAY_ROLES:
            raceway["parameters"][role] += begin
    return raceways


def _rows(part: Part, i: int, begin: int) -> Any:
    rows = part.alone.bundle.rows.copy()
    rows["number"] += part.first_row
    rows["bearing"] = i
    rows["first_ball"] += part.first_ball
    rows["first_raceway"] += part.first_raceway
    rows["waves"] += part.first_wave
    rows["cage"] = part.bodies[CAGE]
    for name, each in _OFFSETS.items():
        rows[name] += each * i
    rows["pocket"] += begin
    rows["drag"] += begin
    return rows


def _lands(part: Part, i: int, begin: int) -> Any:
    lands = part.alone.bundle.lands.copy()
    for land in lands:
        land["cage"], land["ring"] = part.bodies[int(land["cage"])], part.bodies[int(land["ring"])]
    lands["row"] += part.first_row
    lands["law"] += _OFFSETS["guide_law"] * i
    lands["waves"] += part.first_wave
    lands["parameters"] += begin
    return lands


def _waves(part: Part) -> Any:
    waves = part.alone.bundle.waves.copy()
    for wave in waves:
        wave["ring"], wave["body"] = part.bodies[int(wave["ring"])], part.bodies[int(wave["body"])]
    return waves


def _slots(part: Part, begin: int) -> Any:
    slots = part.alone.bundle.slots.copy()
    slots["place"] += begin
    return slots


def _ties(
    model: Machine, shaft: LumpedShaft, parts: tuple[Part, ...]
) -> tuple[NDArray[np.int64], FloatArray, FloatArray, FloatArray]:
    """Return the entries of the shared state that structures tie, their stiffness and damping, and where they rest.

    These are shaft, housing, seats, springs and dampers, and what holds the bodies beside the shaft.
    """
    lumps, beside = lump_bodies(shaft), beside_bodies(model, shaft)
    lead = [L.NS * body_count(model, shaft) + L.STHETA] if shaft.driven == lumps.size else []
    outer = [L.NS * part.bodies[OUTER] + STATES for part in parts]
    others = [L.NS * int(b) + LUMP_STATES for b in beside]
    tied = np.concatenate([*(L.NS * int(b) + LUMP_STATES for b in lumps), lead, *outer, *others]).astype(np.int64)
    signs = np.concatenate([
        np.tile(LUMP_SIGNS, lumps.size), np.ones(len(lead)), np.tile(SIGNS, len(parts)),
        np.tile(LUMP_SIGNS, beside.size),
    ])  # fmt: skip
    size = shaft.stiffness.shape[0]
    rings = slice(size, size + SIGNS.size * len(parts))
    rows = Rows(lambda x: NODE * shaft.at(x), rings.start, rings.stop, tied.size)
    stiffness, damping = structure(model, rows)
    stiffness[:size, :size] += shaft.stiffness
    if model.housing is not None:
        stiffness[rings, rings] += model.housing
    if model.housing_damping is not None:
        damping[rings, rings] += model.housing_damping
    rest = np.zeros(tied.size)
    rest[3 : 6 * lumps.size : 6] = unbalance_of_lumps(model, shaft)[1]  # a lump's angle 0 is that of its unbalance
    rest[rings] = np.concatenate([b.seating.shift for b in model.bearings])
    if not model.twists:
        turns = np.flatnonzero(tied[:size] % L.NS == L.STHETA)
        stiffness[turns] = stiffness[:, turns] = 0.0
    used = np.flatnonzero(np.abs(stiffness).sum(axis=1) + np.abs(damping).sum(axis=1))
    around = np.outer(signs, signs)
    stiffness, damping = ((matrix * around)[np.ix_(used, used)] for matrix in (stiffness, damping))
    if not damping.any():
        damping = np.zeros((0, 0))
    return tied[used], np.ascontiguousarray(stiffness), np.ascontiguousarray(damping), (rest * signs)[used]


def load_signals(body: int) -> list[int]:
    """Return the signals that forces and moments on a body have."""
    return [PER_BODY * body + signal for signal in (FORCE, FORCE + 1, FORCE + 2, MOMENT, MOMENT + 1, MOMENT + 2)]


def motion_signal(body: int, dof: int) -> int:
    """Return the signal of a prescribed degree of freedom."""
    return PER_BODY * body + MOTION + dof

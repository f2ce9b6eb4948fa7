"""Hold arrays and pointers of compiled code."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, OUTER
from lambda_core.elements.ball.raceways import raceways
from lambda_core.laws.context import Oil
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.factors import make_factors
from lambda_core.solver.arrays.integrator_memory import Handle, Memory
from lambda_core.solver.arrays.jacobian_blocks import make_blocks
from lambda_core.solver.core import core
from lambda_core.solver.drivers.assembly import AssembledBearing, Assembly, assembly_of
from lambda_core.solver.drivers.compiled_laws import Kernels
from lambda_core.solver.drivers.contact_grid import cell_block, contacts_at_once, unit_grid
from lambda_core.solver.drivers.contact_memory import state_arrays, state_tail
from lambda_core.solver.drivers.law_inputs import Oils
from lambda_core.solver.drivers.roller_tables import lines_of, roller_code
from lambda_core.solver.drivers.tables import build


def state_scales(assembly: Assembly, active: NDArray[np.int64]) -> FloatArray:
    """Return the absolute scales that the tolerance multiplies, shape (size,).

    Positions 50 um, velocities 0.1 m/s, ball spins 7 rad/s, tilts of rollers 50 um at their ends; angles and angular
    speeds of the big bodies and azimuths are the same lengths and velocities at the pitch radius; states of contacts
    have their own. Members that are no outer ring or cage have the mean over the bearings.
    """
    length, speed, spin = 50e-6, 0.1, 7.0
    spans, count = assembly.spans(), len(assembly.bearings)
    shared = np.zeros((len(assembly.members) + sum(len(span.bodies) - len(BODIES) for span in spans), L.NS))
    arms = [0.5 * bearing.model.geometry.pitch_diameter for bearing in assembly.bearings]
    bodies = [[length] * 3 + [length / arm] * 3 + [speed] * 3 + [speed / arm] * 3 for arm in arms]
    for body in bodies:
        shared += np.array(body) / count
    balls = []
    for bearing, span, arm, body in zip(assembly.bearings, spans, arms, bodies, strict=True):
        shared[list(span.bodies[OUTER:])] = body
        ball = [length, length, length / arm, speed, speed, speed, spin, spin, spin]
        if bearing.model.rollers is not None:
            ball += [2.0 * length / bearing.model.rollers.effective_length] * 2
        balls.append(np.tile(ball, span.balls))
    tails = [state_tail(bearing.model) for bearing in assembly.bearings]
    return np.concatenate([*balls, shared.ravel()[active], *tails])


@dataclass
class SolverContext:
    """Everything that compiled code needs.

    It belongs to one assembly at the contact frames of its bearings.

    Equilibrium, motion, stiffness and other integrators all take it, and work in its memory one after another.
    """

    assembly: Assembly
    bundle: L.Bundle
    scale: FloatArray
    blocks: Any = field(init=False)
    factors: Any = field(init=False)
    driven: NDArray[np.int64] = field(init=False)  # balls that the cage drives, in the last search for an equilibrium

    def __post_init__(self) -> None:
        self.driven = np.zeros(int(self.bundle.system[0]["balls"]), dtype=np.int64)
        self.blocks = make_blocks(self.bundle)
        coupled, size = self.blocks.cross.shape[0], self.blocks.a.shape[1]
        _, rollers = roller_code(core(), bool((self.bundle.rows["kind"] == R.ROLLERS).any()))
        self.factors = make_factors(self.blocks.reach, self.bundle.active.size, coupled, size, rollers)

    @property
    def bearing(self) -> AssembledBearing:
        """The bearing of an assembly that has one."""
        (found,) = self.assembly.bearings
        return found

    @property
    def model(self) -> BearingModel:
        """Of the only bearing."""
        return self.bearing.model

    @property
    def kernels(self) -> Kernels:
        """Compiled laws of the only bearing."""
        return self.bearing.kernels

    @property
    def frame(self) -> ContactFrame:
        """Frame of the only bearing.

        Radii and films are frozen at it.
        """
        return self.bearing.frame

    @property
    def oils(self) -> Oils:
        """Oils of the only bearing.

        They are those that the rheology of each raceway has.
        """
        return self.bearing.oils

    def handle(self, memory: Memory) -> Handle:
        """Return the handle for compiled code.

        It leads to all of it and to the integrator's memory, as one argument.

        The formula of integration is the one that the memory has room for.
        """
        c = core()
        advance = c.advance_finely_pointer if memory.stages.size else c.advance_pointer
        pointers = (c.evaluate_pointer, c.jacobian_pointer, advance, c.observe_pointer)
        return Handle(*pointers, self.bundle, self.blocks, self.factors, memory)

    def raceway(self, element: str) -> Any:
        """Return the record of a ring's raceway.

        It is the first one where the ring has several alike.
        """
        found = (raceway.element for raceway in raceways(self.model.geometry))
        return self.bundle.raceways[next(i for i, name in enumerate(found) if name == element)]

    def parameters(self, element: str, role: str) -> FloatArray:
        """Return the parameters of a raceway's law.

        A view of what compiled code reads.
        """
        begin, end = self.raceway(element)["parameters"][role]
        found: FloatArray = self.bundle.par[begin:end]
        return found

    def shared_part(self, state: FloatArray) -> FloatArray:
        """Return a state vector's free shared part.

        It is a view of the entries of the bodies' states.
        """
        end = self.size - self.bundle.states.size
        return state[end - self.bundle.active.size : end]

    @property
    def oil(self) -> Oil:
        """Oil by the inner contact's rheology.

        Cage, drag and methods use it.
        """
        return self.oils[0]

    @property
    def size(self) -> int:
        """Number of states."""
        return int(self.scale.size)


def assemble(model: BearingModel, kernels: Kernels, frame: ContactFrame, oils: Oils) -> SolverContext:
    """Return the context of a bearing alone.

    The frozen contact angles and mean loads are given.
    """
    return context_of(assembly_of(model, kernels, frame, oils))


def context_of(assembly: Assembly) -> SolverContext:
    """Return the context of an assembly.

    It has the tables of the assembly and room to work in.
    """
    tables, compiled, depth = build(assembly), core(), assembly.bearings[0].model.depth
    grid = unit_grid(depth.strips, depth.rows)
    bodies, balls = tables.bodies.size, int(tables.system[0]["balls"])
    lines = lines_of([bearing.model for bearing in assembly.bearings])
    inputs, now, rates = np.zeros(bodies, R.INPUTS), np.zeros(bodies, R.BODY_STATE), np.zeros(bodies, R.BODY_STATE)
    bundle = L.Bundle(
        **tables._asdict(),
        tie_moves=np.zeros(tables.tied.size),
        tie_rates=np.zeros(tables.tie_damping.shape[1]),
        wrench=compiled.wrench_pointer,
        tangent=compiled.tangent_pointer,
        grid=grid,
        inputs=inputs,
        signals=inputs.view(R.SIGNAL),
        cells=cell_block(grid.shape[1], contacts_at_once(grid.shape[1])),
        scratch=np.zeros(1, R.SCRATCH),
        shared=now.view(np.float64),
        bodies_now=now,
        ground=np.zeros(1, R.BODY_STATE),
        shared_rates=rates.view(np.float64),
        body_rates=rates,
        body_wrenches=np.zeros(bodies, R.WRENCH),
        contact_wrenches=np.zeros(bodies, R.WRENCH),
        ball_wrenches=np.zeros(balls, R.WRENCH),
        bypassed=np.zeros(len(assembly.bearings), dtype=np.int64),
        bearing_powers=np.zeros(len(assembly.bearings), R.RUNNING),
        rollers=roller_code(compiled, bool(lines.size))[0],
        lines=lines,
        slices=np.zeros((L.SLICE_ROWS, lines.shape[2])),
        line_cells=cell_block(lines.shape[2], 1),
        **state_arrays(assembly, tables),
    )
    return SolverContext(assembly, bundle, state_scales(assembly, tables.active))

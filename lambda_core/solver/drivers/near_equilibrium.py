"""Solve changed models from the equilibrium of another."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import SPIN
from lambda_core.domain.errors import EquilibriumError, SolverError
from lambda_core.domain.time_limit import is_late
from lambda_core.model.bearing_model import BearingModel
from lambda_core.model.laws.law_context import ContactFrame
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import Core, core
from lambda_core.solver.drivers.compiled_laws import Announce, Kernels, check_laws, derive_oils
from lambda_core.solver.drivers.equilibrium import (
    Equilibrium,
    contact_channels,
    continue_static,
    mean_frame,
    solution,
    solve,
    without_friction,
)
from lambda_core.solver.drivers.solver_context import SolverContext, assemble


@dataclass(frozen=True)
class Beginning:
    """Keep what a search needs of an equilibrium.

    Without the memory of the compiled code it takes a tenth of the place.
    """

    model: BearingModel
    frame: ContactFrame
    rolling: ContactFrame  # that of the contacts with friction
    state: FloatArray
    driven: NDArray[np.int64]
    phase: float


def beginning(found: Equilibrium) -> Beginning:
    """Return where a search near an equilibrium begins."""
    context = found.context
    rolling = mean_frame(context.model.geometry, found.arcs, context.frame)
    return Beginning(context.model, context.frame, rolling, found.state, context.driven.copy(), found.phase)


def _moved(compiled: Core, context: SolverContext, near: Beginning, state: FloatArray) -> ContactFrame | None:
    """Move contacts by Newton's method, in place.

    Return their frame; None where unloaded balls have far to go: without friction they find their places sooner.

    A frame is that of contacts without friction; it moves as much as that with friction does.
    """
    there = state.copy()
    try:
        continue_static(compiled, context, there, friction=True, is_near=True, once=True, driven=near.driven)
    except SolverError:
        return None
    state[:] = there
    rolling = mean_frame(context.model.geometry, contact_channels(compiled, context, state)[0], near.frame)
    each = zip(near.frame.angles, rolling.angles, near.rolling.angles, strict=True)
    inner, outer = (own + now - before for own, now, before in each)
    return ContactFrame((inner, outer), rolling.mean_loads)


def solve_near(
    model: BearingModel,
    near: Equilibrium | Beginning,
    kernels: Kernels | None = None,
    *,
    is_of_laws: bool = True,
    by_warmer_oil: bool = True,
) -> Equilibrium:
    """Find a changed model's equilibrium.

    The search starts from that of a solved model.

    Contact frame, first state, and the balls that the cage drives are those of the solution, which saves most of the
    work of :func:`solve`, and keeps balls that no ring loads in the same of several steady motions. A model whose state
    has another size, that has no solution near, or one in which the cage drives other balls, is solved anew.

    Parameters
    ----------
    near : Equilibrium or Beginning
        Of the same bearing under the same loads.
    is_of_laws : bool
        Whether only laws differ, or what only they see: then normal forces are as good as the same. Otherwise these are
        found anew, and the balls start with their speeds in the solution.
    by_warmer_oil : bool
        Of the search anew, as in :func:`solve`.

    Raises
    ------
    SolverError
        As :func:`solve`.
    """
    if isinstance(near, Equilibrium):
        near = beginning(near)
    frame, kernels = near.frame, kernels or Kernels(model)
    oils = derive_oils(model, kernels, frame)
    check_laws(model, kernels, frame, oils, near.model)
    compiled, context = core(None), assemble(model, kernels, frame, oils)
    if context.size != near.state.size:
        return solve(model, kernels, by_warmer_oil=by_warmer_oil, phase=near.phase)
    state, are_balls = near.state.copy(), model.rollers is None
    driven = near.driven if are_balls else None
    try:
        moved = _moved(compiled, context, near, state) if not is_of_laws and are_balls else None
        if moved is not None:
            context = assemble(model, kernels, moved, oils)
        elif not is_of_laws:
            without_friction(compiled, context, state)
            frame = mean_frame(model.geometry, contact_channels(compiled, context, state)[0], frame)
            context = assemble(model, kernels, frame, oils)
            now, before = L.elements_in(context.bundle, state), L.elements_in(context.bundle, near.state)
            now["velocity"], now["spin"] = before["velocity"], before["spin"]
        report = continue_static(compiled, context, state, friction=True, is_near=are_balls, driven=driven)
    except SolverError:
        return solve(model, kernels, by_warmer_oil=by_warmer_oil, phase=near.phase)
    if are_balls and (context.driven != near.driven).any():
        return solve(model, kernels, by_warmer_oil=by_warmer_oil, phase=near.phase)
    return solution(context, state, contact_channels(compiled, context, state), report, phase=near.phase)


def solve_or_roll(
    model: BearingModel, kernels: Kernels | None = None, announce: Announce = None, *, phase: float = 0.0
) -> Equilibrium:
    """Find an equilibrium, or rollers that roll.

    Where no steady motion of rollers is found they roll under the same loads, and the equilibrium is not `converged`;
    the way through warmer oil, which takes a minute, is left out.

    Raises
    ------
    SolverError
        As :func:`solve`; of rollers only where their loads have no equilibrium.
    """
    of_balls = model.rollers is None
    try:
        return solve(model, kernels, announce, by_warmer_oil=of_balls, phase=phase)
    except EquilibriumError:
        if of_balls or is_late():
            raise
    return solve(model, kernels, announce, with_friction=False, phase=phase)


def continue_at_speed(model: BearingModel, near: Equilibrium, kernels: Kernels | None = None) -> Equilibrium:
    """Follow an equilibrium of rollers to another speed.

    The search starts from that at a speed nearby, with the speeds of all rollers in proportion, and so keeps to one of
    several equilibria.

    Raises
    ------
    SolverError
        When none is found from there.
    """
    state, bundle = near.state.copy(), near.context.bundle
    inner, outer = (initial(ring.dofs[SPIN].motion) for ring in (model.inner_ring, model.outer_ring))
    share, elements = abs(inner - outer) / near.relative_speed, L.elements_in(bundle, state)
    elements["velocity"] *= share
    elements["spin"] *= share
    kernels = kernels or Kernels(model)
    context = assemble(model, kernels, near.context.frame, derive_oils(model, kernels, near.context.frame))
    compiled = core(None)
    report = continue_static(compiled, context, state, friction=True)
    return solution(context, state, contact_channels(compiled, context, state), report, phase=near.phase)

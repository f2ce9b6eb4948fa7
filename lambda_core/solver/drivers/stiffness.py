"""Compute the stiffness matrix of a bearing.

The matrix has shape (5, 5) about the quasi-static equilibrium; balls stay in equilibrium.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import core
from lambda_core.solver.drivers.equilibrium import Equilibrium, fault_sentence
from lambda_core.solver.drivers.solver_context import SolverContext, assemble

_FREED = ("x", "y", "z", "tilt_y", "tilt_z")
# State that each displacement moves, and the sign: turning about +y moves a_z towards -, about +z moves a_y towards +.
_STATES = (L.SX, L.SY, L.SZ, L.SAZ, L.SAY)
_SIGNS = np.array([1.0, 1.0, 1.0, -1.0, 1.0])
_RATES = (L.SVX, L.SVY, L.SVZ, L.SWY, L.SWZ)


def stiffness_matrix(equilibrium: Equilibrium) -> tuple[tuple[float, ...], ...]:
    """Return d(load)/d(displacement) at the equilibrium.

    The inner ring moves against the outer one.

    The balls follow: K = -(F_qq - F_qb F_bb^-1 F_bq), the Schur complement of the Jacobian of the contact forces
    F over the axial and radial positions b of the balls, q the ring's displacement and tilt. Centrifugal force and
    the azimuths of the balls stand still, friction is left out, as are elastic supports of the ring and force elements
    outside the bearing.

    Parameters
    ----------
    equilibrium : Equilibrium
        Any solution of :func:`lambda_core.solver.drivers.equilibrium.solve`; also with locked degrees of freedom.

    Returns
    -------
    tuple of 5 tuples of 5 floats
        Order x, y, z, tilt_y, tilt_z [N/m, N/rad, N m/m, N m/rad], symmetric.

    References
    ----------
    Jones 1960, J. Basic Eng. 82, 309; de Mul, Vree and Maas 1989, J. Tribol. 111, 142 (the same elimination).
    """
    matrix = stiffness_at(equilibrium.context, freed(equilibrium.context), equilibrium.state, equilibrium.displacement)
    return tuple(tuple(float(value) for value in row) for row in matrix)


def freed(found: SolverContext) -> SolverContext:
    """Return the context with a free inner ring.

    The bearing is the same, without supports and other force elements.
    """
    free = dataclasses.replace(found.model, inner_ring=found.model.inner_ring.freed(_FREED), links={})
    return assemble(free, found.kernels, found.frame, found.oils)


def stiffness_at(
    found: SolverContext, context: SolverContext, state: FloatArray, displacement: Sequence[float]
) -> FloatArray:
    """Return the stiffness at a state.

    It is that of `found`, by the context of the freed ring; the array has shape (5, 5).

    Raises
    ------
    SolverError
        When a law refuses, or a ball is held by nothing.
    """
    _fill_slopes(context, _moved(found, context, state, displacement))
    try:
        matrix = _eliminated(context)
    except np.linalg.LinAlgError:
        name = context.model.name
        raise SolverError(f"{name}: a ball has no contact, so the stiffness matrix is singular") from None
    # Contact forces are conservative at frozen radii: what is not symmetric is noise of the Jacobian's differences.
    return 0.5 * (matrix + matrix.T)


def _moved(
    found: SolverContext, context: SolverContext, state: FloatArray, displacement: Sequence[float]
) -> FloatArray:
    """Return a state in the freed layout.

    It is a state of `found`; the inner ring is free.
    """
    tail = int(found.bundle.system["tail"][0])
    shared = np.zeros(context.bundle.shared.size)
    shared[found.bundle.active] = found.shared_part(state)
    shared[list(_STATES)] = _SIGNS * np.array(displacement)
    return np.concatenate([state[:tail], shared[context.bundle.active], context.bundle.states])


def _fill_slopes(context: SolverContext, state: FloatArray) -> None:
    """Fill blocks with the normal forces' Jacobian.

    The blocks are the context's; no other forces count.
    """
    compiled, bundle = core(), context.bundle
    system = bundle.system[0]
    system["friction_on"], system["guides_on"] = 0, 0
    rates = np.zeros(L.power_count(bundle))
    ok = compiled.evaluate(0.0, state, bundle, np.zeros(state.size), rates, 0)
    if ok != 1 or compiled.jacobian(0.0, state, bundle, context.blocks) != 1:
        raise SolverError(f"the stiffness matrix failed: {fault_sentence(context)}")
    system["friction_on"], system["guides_on"] = 1, 1


def _eliminated(context: SolverContext) -> FloatArray:
    """Return the condensed stiffness.

    The balls' positions and the waves of rings are eliminated, shape (5, 5).
    """
    blocks, body, waves = context.blocks, context.model.inner_ring, context.bundle.waves["body"]
    amplitudes = [L.NS * int(wave) + axis for wave in waves for axis in (L.SY, L.SZ)]
    columns = blocks.index[[*_STATES, *amplitudes]]
    rows = blocks.index[[*_RATES, *(place + L.SVX for place in amplitudes)]]
    # what a ball touches: the inner ring, and the waves
    own_columns, own_rows = (np.searchsorted(blocks.reach.columns[0], places) for places in (columns, rows))
    masses = np.repeat(context.bundle.bodies["mass"][waves], 2)
    inertia = np.concatenate([[body.mass] * 3, [body.transverse_inertia] * 2, masses])
    positions, accelerations = [L.BX, L.BR], [L.BVX, L.BVR]
    slope = blocks.d[np.ix_(rows, columns)].copy()
    for ball, on_ball, on_ring in zip(blocks.a, blocks.b, blocks.c, strict=True):
        feel = on_ball[np.ix_(accelerations, own_columns)]
        if not np.any(feel):
            continue  # neither the inner ring nor waves touch this ball
        hold = ball[np.ix_(accelerations, positions)]
        slope -= on_ring[np.ix_(own_rows, positions)] @ np.linalg.solve(hold, feel)
    slope *= -inertia[:, None]
    bent = len(_STATES)
    if amplitudes:
        slope[:bent, :bent] -= slope[:bent, bent:] @ np.linalg.solve(slope[bent:, bent:], slope[bent:, :bent])
    matrix: FloatArray = slope[:bent, :bent] * _SIGNS[None, :]
    return matrix

"""Prepare the reaction slopes for rings with prescribed motion.

The solver's Jacobian holds the slopes of the forces on all bodies with their free states. Rings that a host moves have
none; so a second set of blocks is made, for the same tables, in which every motion of the host counts as free.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import BODIES, DOFS, SPIN
from lambda_core.laws.jit.portable import REAL, Entry
from lambda_core.solver import layout as T
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.jacobian_blocks import Blocks, make_blocks
from lambda_core.solver.core import Core
from lambda_core.solver.drivers.solver_context import SolverContext
from lambda_core.solver.integrator.blocks import blocks_t

# Of a tilt: its component of the axis, the sign there, and its rate. A small tilt (y, z) turns the axis to (1, z, -y).
TILT_STATES = {"tilt_y": (L.SAZ, -1.0, L.SWY), "tilt_z": (L.SAY, 1.0, L.SWZ)}
_FIRST: dict[str, int] = {body: L.NS * b for b, body in enumerate(BODIES)}


@dataclasses.dataclass(frozen=True)
class PrescribedRings:
    """Arrays for the slopes of reactions.

    Attributes
    ----------
    bundle : layout.Bundle
        The tables of the model, with the free states and those that the host prescribes as `active`.
    blocks : Blocks
        For it.
    state : float64[:]
        Where the Jacobian is taken: balls, active states, states of contacts.
    """

    bundle: L.Bundle
    blocks: Blocks
    state: FloatArray

    def sections(self) -> list[tuple[str, Any, Any]]:
        """Return what belongs into the image."""
        return [
            ("prescribed_bundle", T.bundle_t, self.bundle),
            ("prescribed_blocks", blocks_t, self.blocks),
            ("prescribed_state", T.array1, self.state),
        ]

    def workspaces(self) -> list[Any]:
        """Return the temporary arrays of slopes.

        Each request for slopes rewrites them; they are no part of a saved state.
        """
        return [self.state, *(array for array in self.blocks if isinstance(array, np.ndarray))]

    def entry(self, at: dict[str, int], core: Core) -> Entry:
        """Return the function of the library that fills the blocks."""
        return Entry(
            "lb_jacobian",
            core.jacobian_pointer,
            (REAL, at["prescribed_state"], at["prescribed_bundle"], at["prescribed_blocks"]),
        )


def prescribed_rings(context: SolverContext, given: Sequence[str]) -> PrescribedRings:
    """Return the arrays for slopes with the motions among `given`."""
    bundle = context.bundle
    columns = [column for name in given for field in ("value", "rate") if (column := axis_of(name, field)[0]) >= 0]
    active = np.union1d(bundle.active, columns).astype(np.int64)
    free = bundle._replace(active=active)
    tail = int(bundle.system["tail"][0])
    return PrescribedRings(free, make_blocks(free), np.zeros(tail + active.size + bundle.states.size))


def axis_of(name: str, field: str) -> tuple[int, float]:
    """Return the shared state of a signal's field.

    Also return its sign there; the state is -1 for none.

    Parameters
    ----------
    name : str
        As :func:`lambda_core.solver.drivers.coupling.given_names` has it.
    field : "value", "rate" or "acceleration"
    """
    body, word = name.split(".")
    if word not in DOFS or field == "acceleration" or (word == SPIN and field == "rate"):
        return -1, 1.0
    first = _FIRST[body]
    if word == SPIN:
        return first + L.SSIGMA, 1.0
    if word in TILT_STATES:
        at, sign, rate = TILT_STATES[word]
        return (first + at, sign) if field == "value" else (first + rate, 1.0)
    axis = DOFS.index(word)
    return first + (L.SX if field == "value" else L.SVX) + axis, 1.0

"""A bearing frozen at its start: everything that compiled code works on, in one image."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.channels import LOSSES, SHORTED
from lambda_core.domain.elements import BODIES
from lambda_core.fmu.image import Image, host_words
from lambda_core.laws.jit.portable import REAL, WORD, Entry
from lambda_core.solver import layout as L
from lambda_core.solver import records as R
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.given import Coupling, given_names, start
from lambda_core.solver.integrator.arrow import factors_t
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.integrator.memory import Memory, evaluate_t, jacobian_t, memory_t
from lambda_core.solver.sampling import observe_sig

if TYPE_CHECKING:
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.observation import Scratch
    from lambda_core.system.bearing import BearingModel

_CAPACITY = 4  # samples: nobody takes them, but the integrator keeps room for those of the step in hand
_HOST_WORDS = 8


@dataclass(frozen=True)
class Frozen:
    """A model at its start.

    Attributes
    ----------
    image : Image
    entries : tuple of Entry
        The functions of the library: advance, observe.
    given : tuple of str
        What the host gives.
    terms : records.TERM[:]
        Their rows.
    wrenches : float64[:, 6]
        What the bearing puts on its bodies.
    host : float64[:]
        Memory for the host.
    losses : int
        How many of the running integrals are losses.
    """

    model: BearingModel
    image: Image
    entries: tuple[Entry, ...]
    given: tuple[str, ...]
    terms: Any
    wrenches: Any
    memory: Memory
    scratch: Scratch
    fault: Any
    host: Any
    losses: int = len(LOSSES)

    def moves(self, body: str) -> bool:
        """Tell whether a body is there and can move."""
        if body == "cage":
            return bool(self.model.depth.cage)
        return any(dof.mode != "locked" for dof in getattr(self.model, body).dofs.values())

    def of_row(self, rows: Any, row: int, field: str) -> int:
        """Return the place of a field in a row of a table."""
        return self.image.place(rows) + row * int(rows.itemsize) + int(rows.dtype.fields[field][1])

    def of_totals(self, name: str) -> int:
        """Return the place of a field of records.TOTALS."""
        return self.image.place(self.scratch.extra) + int(R.TOTALS.fields[name][1])  # type: ignore[index]

    def integral(self, name: str) -> int:
        """Return the place of a running integral of records.RUNNING."""
        return self._running(self.memory.integrals, name)

    def rate(self, name: str) -> int:
        """Return the place of its rate, as observed last."""
        return self._running(self.scratch.rates, name)

    def _running(self, powers: Any, name: str) -> int:
        behind = powers.shape[-1] - L.RUNNING_SIZE
        return self.image.place(powers, behind) + int(R.RUNNING.fields[name][1])  # type: ignore[index]


def freeze(model: BearingModel, couple: Coupling, announce: Announce = None) -> Frozen:
    """Solve for the start of a model and freeze it there.

    Raises
    ------
    SolverError, UsageError
        As for :func:`lambda_core.solver.drivers.given.start`.
    """
    model, equilibrium = start(model, couple, announce)
    given = given_names(model, couple)
    engine = BearingEngine(model, announce, equilibrium, given=given, capacity=_CAPACITY)
    core, context, memory, scratch = engine.parts()
    memory.control["sample_interval"] = math.inf
    bundle, host = context.bundle, host_words(_HOST_WORDS)
    now = memory.control.view(np.float64)[:1]  # the field "time" is the first one
    sections = [
        ("evaluate", evaluate_t, core.evaluate_pointer),
        ("jacobian", jacobian_t, core.jacobian_pointer),
        ("bundle", L.bundle_t, bundle),
        ("blocks", blocks_t, context.blocks),
        ("factors", factors_t, context.factors),
        ("memory", memory_t, memory),
        ("times", L.array1, now),
        ("states", L.array2, memory.y.reshape(1, -1)),
        ("host", L.array1, host),
    ]
    kinds = observe_sig.args[-len(scratch._fields) :]
    sections += [(name, kind, array) for name, kind, array in zip(scratch._fields, kinds, scratch, strict=True)]
    pointers = [kernel.pointer for kernel in context.kernels.compiled.values()]
    image = Image(sections, bundle.laws, pointers)
    at = image.sections
    advance = core.advance_finely_pointer if memory.stages.size else core.advance_pointer
    steps = tuple(at[name] for name in ("bundle", "blocks", "factors", "memory"))
    looks = tuple(at[name] for name in scratch._fields)
    entries = (
        Entry("lb_advance", advance, (at["evaluate"], at["jacobian"], REAL, WORD, *steps)),
        Entry(
            "lb_observe",
            core.observe_pointer,
            (at["times"], at["states"], at["bundle"], at["evaluate"], float(SHORTED), *looks),
        ),
    )
    fault = bundle.scratch
    wrenches = bundle.body_wrenches.view(np.float64)
    rows = engine.given
    assert list(BODIES)[:2] == ["inner_ring", "outer_ring"]
    return Frozen(model, image, entries, given, rows, wrenches, memory, scratch, fault, host)

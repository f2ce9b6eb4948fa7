"""A bearing frozen at its start: everything that compiled code works on, in one image."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import SHORTED
from lambda_core.domain.elements import BODIES
from lambda_core.export.fmu.circuit_image import Circuit, circuit
from lambda_core.export.fmu.curves import Constant, constants
from lambda_core.export.fmu.image import Image, host_words
from lambda_core.export.fmu.led_rings import LedRings, led_rings
from lambda_core.export.fmu.starting import Start, prepare_start
from lambda_core.export.fmu.varied import Varied
from lambda_core.laws.jit.portable import REAL, WORD, Entry
from lambda_core.solver import layout as T
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import CONTROL, Memory
from lambda_core.solver.drivers.compiled_laws import derive_oils
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.given import Coupling, given_names, start
from lambda_core.solver.drivers.solver_context import assemble
from lambda_core.solver.integrator.arrow import factors_t
from lambda_core.solver.integrator.blocks import blocks_t
from lambda_core.solver.integrator.memory import evaluate_t, jacobian_t, memory_t
from lambda_core.solver.sampling import observe_sig

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.observation import Scratch

_CAPACITY = 4  # samples: nobody takes them, but the integrator keeps room for those of the step in hand
_HOST_WORDS = 8  # behind them stand the values of the options that vary
# Of the bundle, what the set-up of a model works out, and of the integrator's control.
_TABLES = (
    "system", "bodies", "rows", "raceways", "waves", "lands", "links", "tie_stiffness", "tie_damping", "tie_rest",
    "state_steps", "par", "terms", "table",
)  # fmt: skip
_CONTROL = ("longest_step", "leak_floor")


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
    start : Start
        For a start elsewhere.
    varied : tuple of Varied
        Options that the host may change.
    constants : list of Constant
        What follows them; their words are places in the image [bytes].
    losses : int
        How many of the running integrals are losses.
    circuit : Circuit, optional
    led : LedRings, optional
        For slopes of reactions, where the host leads the rings.
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
    system: Any
    start: Start
    varied: tuple[Varied, ...]
    constants: list[Constant]
    losses: int
    circuit: Circuit | None
    led: LedRings | None

    def moves(self, body: str) -> bool:
        """Tell whether a body is there and can move."""
        if body == "cage":
            return bool(self.model.depth.cage)
        return any(dof.mode != "locked" for dof in getattr(self.model, body).dofs.values())

    def of_row(self, rows: Any, row: int, field: str) -> int:
        """Return the place of a field in a row of a table."""
        return self.image.place(rows) + row * int(rows.itemsize) + int(rows.dtype.fields[field][1])

    def integral(self, name: str) -> int:
        """Return the place of a running integral of records.RUNNING."""
        return self._running(self.memory.integrals, name)

    def rate(self, name: str) -> int:
        """Return the place of its rate, as observed last."""
        return self._running(self.scratch.rates, name)

    def _running(self, powers: Any, name: str) -> int:
        behind = powers.shape[-1] - L.RUNNING_SIZE
        return self.image.place(powers, behind) + int(R.RUNNING.fields[name][1])  # type: ignore[index]


def freeze(
    model: BearingModel,
    couple: Coupling,
    announce: Announce = None,
    options: Sequence[Varied] = (),
    changed: Callable[[Mapping[str, float]], BearingModel] | None = None,
) -> Frozen:
    """Solve for the start of a model and freeze it there.

    Parameters
    ----------
    options : sequence of Varied
        What the host may change.
    changed : function
        The model with other values of these, by path.

    Raises
    ------
    SolverError, UsageError
        As for :func:`lambda_core.solver.drivers.given.start` and :func:`lambda_core.export.fmu.curves.constants`.
    """
    model, equilibrium = start(model, couple, announce)
    given = given_names(model, couple)
    begin = prepare_start(equilibrium)
    engine = BearingEngine(model, announce, equilibrium, given=given, capacity=_CAPACITY)
    core, context, memory, scratch = engine.parts()
    memory.control["sample_interval"] = math.inf
    bundle, host = context.bundle, host_words(_HOST_WORDS + len(options))
    host[_HOST_WORDS:] = [option.start for option in options]
    led = led_rings(context, given) if couple == "motion" else None
    electric = circuit(model, scratch.contacts.size // scratch.contacts.shape[-1], announce)
    now = memory.control.view(np.float64)[:1]  # the field "time" is the first one
    sections = [
        ("evaluate", evaluate_t, core.evaluate_pointer),
        ("jacobian", jacobian_t, core.jacobian_pointer),
        ("bundle", T.bundle_t, bundle),
        ("blocks", blocks_t, context.blocks),
        ("factors", factors_t, context.factors),
        ("memory", memory_t, memory),
        ("times", T.array1, now),
        ("states", T.array2, memory.y.reshape(1, -1)),
        ("host", T.array1, host),
        *begin.sections(),
        *(electric.sections() if electric else ()),
        *(led.sections() if led else ()),
    ]
    kinds = observe_sig.args[-len(scratch._fields) :]
    sections += [(name, kind, array) for name, kind, array in zip(scratch._fields, kinds, scratch, strict=True)]
    pointers = [kernel.pointer for kernel in context.kernels.compiled.values()]
    image = Image(sections, bundle.laws, pointers, led.workspaces() if led else ())
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
        begin.entry(at),
        *((electric.entry(image),) if electric else ()),
        *((led.entry(at, core),) if led else ()),
    )
    fault = bundle.scratch
    wrenches = bundle.body_wrenches.view(np.float64)
    rows = engine.given
    assert list(BODIES)[:2] == ["inner_ring", "outer_ring"]
    followed: list[Constant] = []
    if options and changed is not None:
        parts = _parts(engine)
        where = np.concatenate([image.place(part) + 8 * np.arange(part.size) for part in parts])

        def sample(values: Mapping[str, float]) -> FloatArray:
            return np.concatenate(_parts(_alike(changed(values), equilibrium, couple, given)))

        found = constants(options, np.concatenate(parts), sample)
        followed = [dataclasses.replace(each, word=int(where[each.word])) for each in found]
    return Frozen(
        model,
        image,
        entries,
        given,
        rows,
        wrenches,
        memory,
        scratch,
        fault,
        host,
        bundle.system,
        begin,
        tuple(options),
        followed,
        losses=scratch.rates.shape[-1] - L.BESIDE_LOSSES,
        circuit=electric,
        led=led,
    )


def _alike(model: BearingModel, base: Equilibrium, couple: Coupling, given: tuple[str, ...]) -> BearingEngine:
    """Return an engine of another model in the state and with the frame of the contacts of a base."""
    if couple == "motion":  # the host holds the rings where the base has them
        own = base.context.model
        inner = dataclasses.replace(model.inner_ring, dofs=own.inner_ring.dofs)
        outer = dataclasses.replace(model.outer_ring, dofs=own.outer_ring.dofs)
        model = dataclasses.replace(model, inner_ring=inner, outer_ring=outer)
    kernels, frame = base.context.kernels, base.context.frame
    context = assemble(model, kernels, frame, derive_oils(model, kernels, frame))
    return BearingEngine(model, None, dataclasses.replace(base, context=context), given=given, capacity=_CAPACITY)


def _parts(engine: BearingEngine) -> list[FloatArray]:
    """Return everything that the set-up of a model has worked out, as views of numbers."""
    _, context, memory, _ = engine.parts()
    tables = [getattr(context.bundle, name) for name in _TABLES]
    found = [table.view(np.float64).reshape(-1) for table in tables if table.size]
    control = memory.control.view(np.float64)
    at = [int(CONTROL.fields[name][1]) // 8 for name in _CONTROL]  # type: ignore[index]
    return [*found, memory.weight, memory.inertia, *(control[i : i + 1] for i in at)]

"""Freeze a bearing or a machine at its start.

One image contains everything that compiled code works on.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import SHORTED
from lambda_core.domain.elements import BODIES
from lambda_core.domain.errors import UsageError
from lambda_core.export.fmu.circuit_image import Circuit, circuit
from lambda_core.export.fmu.curves import Constant, constants
from lambda_core.export.fmu.image import Image, host_words
from lambda_core.export.fmu.prescribed_rings import PrescribedRings, prescribed_rings
from lambda_core.export.fmu.starting import Start, prepare_start
from lambda_core.export.fmu.varied import Varied
from lambda_core.laws.jit.portable import REAL, WORD, Entry
from lambda_core.solver import layout as T
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.arrays.integrator_memory import CONTROL, Memory
from lambda_core.solver.drivers.coupling import Coupling, alike, coupled_engine
from lambda_core.solver.drivers.dynamics import BearingEngine
from lambda_core.solver.drivers.machine_motion import MachineEngine, MachineStart
from lambda_core.solver.drivers.roller_tables import roller_pointers
from lambda_core.solver.integrator.blocks import blocks_t, factors_t
from lambda_core.solver.integrator.memory import evaluate_t, jacobian_t, memory_t
from lambda_core.solver.sampling import observe_sig

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.external_inputs import ExternalInputs
    from lambda_core.solver.drivers.observation import Scratch
    from lambda_core.solver.drivers.readings import ReadBearing

_CAPACITY = 4  # samples: nobody takes them, but the integrator keeps room for those of the step in hand
_HOST_WORDS = 8  # behind them stand what a machine is given, then the values of the options that vary
# Of the bundle, what the set-up of a model works out, and of the integrator's control.
_TABLES = (
    "system", "bodies", "rows", "raceways", "waves", "lands", "links", "tie_stiffness", "tie_damping", "tie_rest",
    "state_steps", "par", "terms", "table",
)  # fmt: skip
_CONTROL = ("longest_step", "leak_floor")
_ENDLESS = 1e300


@dataclass(frozen=True)
class Frozen:
    """A model at its start.

    Attributes
    ----------
    name : str
    image : Image
    entries : tuple of Entry
        The functions of the library: advance, observe.
    bearings : tuple of ReadBearing
    inputs : ExternalInputs
        What the host gives.
    wrenches : float64[:, 6]
        What bearings put on their bodies.
    host : float64[:]
        Memory for the host.
    start : Start, optional
        For a start elsewhere; a machine has none.
    varied : tuple of Varied
        Options that the host may change.
    constants : list of Constant
        What follows them; their words are places in the image [bytes].
    losses : int
        How many of the running integrals are losses.
    circuit : Circuit, optional
    prescribed : PrescribedRings, optional
        For slopes of reactions, where the host leads the rings.
    machine : MachineStart, optional
    """

    name: str
    duration: float | None
    image: Image
    entries: tuple[Entry, ...]
    bearings: tuple[ReadBearing, ...]
    inputs: ExternalInputs
    wrenches: Any
    memory: Memory
    scratch: Scratch
    bundle: L.Bundle
    host: Any
    start: Start | None
    varied: tuple[Varied, ...]
    constants: list[Constant]
    losses: int
    circuit: Circuit | None
    prescribed: PrescribedRings | None
    machine: MachineStart | None

    def moves(self, body: str) -> bool:
        """Tell whether a body can move.

        The bearing is alone and has the body.
        """
        model = self.bearings[0].context.model
        if body == "cage":
            return bool(model.depth.cage)
        return any(dof.mode != "locked" for dof in getattr(model, body).dofs.values())

    def input_place(self, name: str) -> int:
        """Return the place of a machine's input [bytes].

        The value comes first and its rate follows.
        """
        return self.image.place(self.host, _HOST_WORDS + 2 * self.inputs.names.index(name))

    def of_row(self, rows: Any, row: int, field: str) -> int:
        """Return the place of a field in a table.

        It is in a row of the table.
        """
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
    model: BearingModel | MachineModel,
    couple: Coupling,
    announce: Announce = None,
    options: Sequence[Varied] = (),
    changed: Callable[[Mapping[str, float]], BearingModel | MachineModel] | None = None,
) -> Frozen:
    """Solve for the start of a model and freeze it.

    The frozen model stays at that state.

    Parameters
    ----------
    options : sequence of Varied
        What the host may change.
    changed : function
        The model with other values of these, by path.

    Raises
    ------
    SolverError, UsageError
        As for :func:`lambda_core.solver.drivers.coupling.coupled_engine` and
        :func:`lambda_core.export.fmu.curves.constants`.
    """
    if any(one.cage.per_row for one in model.bearing_models.values()):
        raise UsageError("an FMU has one cage in each bearing: leave out per_row of the cage")
    engine = coupled_engine(model, couple, announce, _CAPACITY)
    core, context, memory, scratch = engine.parts()
    # What a machine is given goes from the host's memory to the terms that follow it.
    machine = engine.start if isinstance(engine, MachineEngine) else None
    given = np.zeros(0) if machine is None else engine.inputs.values[:, :2].ravel()
    memory.control["sample_interval"] = math.inf
    bundle = context.bundle
    host = host_words(_HOST_WORDS + given.size + len(options))
    host[_HOST_WORDS:] = [*given, *(option.start for option in options)]
    prescribed = prescribed_rings(context, engine.inputs.names) if couple == "motion" else None
    contacts = scratch.contacts.size // scratch.contacts.shape[-1]
    electric = circuit(engine.model, context.assembly.spans(), contacts, announce)
    # The search for a start in C is that of balls; rollers begin at the equilibrium of their case, as machines do.
    start_ = prepare_start(engine.begun) if isinstance(engine, BearingEngine) and not engine.model.rollers else None
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
        *(start_.sections() if start_ else ()),
        *(electric.sections() if electric else ()),
        *(prescribed.sections() if prescribed else ()),
    ]
    kinds = observe_sig.args[-len(scratch._fields) :]
    sections += [(name, kind, array) for name, kind, array in zip(scratch._fields, kinds, scratch, strict=True)]
    pointers = [kernel.pointer for bearing in context.assembly.bearings for kernel in bearing.kernels.compiled.values()]
    pointers += roller_pointers()
    functions = (*bundle.laws, *(table for table in (bundle.rollers, context.factors.rollers) if table.size))
    image = Image(sections, functions, pointers, prescribed.workspaces() if prescribed else ())
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
        *((start_.entry(at),) if start_ else ()),
        *((electric.entry(image),) if electric else ()),
        *((prescribed.entry(at, core),) if prescribed else ()),
    )
    assert list(BODIES)[:2] == ["inner_ring", "outer_ring"]
    followed: list[Constant] = []
    if options and changed is not None:
        parts = _parts(engine)
        where = np.concatenate([image.place(part) + 8 * np.arange(part.size) for part in parts])

        def sample(values: Mapping[str, float]) -> FloatArray:
            return _joined(_parts(alike(engine, changed(values), _CAPACITY)))

        found = constants(options, _joined(parts), sample)
        followed = [dataclasses.replace(each, word=int(where[each.word])) for each in found]
    return Frozen(
        name=model.name,
        duration=model.solver.duration,
        image=image,
        entries=entries,
        bearings=engine.bearings,
        inputs=engine.inputs,
        wrenches=(bundle.contact_wrenches if machine else bundle.body_wrenches).view(np.float64),
        memory=memory,
        scratch=scratch,
        bundle=bundle,
        host=host,
        start=start_,
        varied=tuple(options),
        constants=followed,
        losses=scratch.rates.shape[-1] - L.NOT_LOST,
        circuit=electric,
        prescribed=prescribed,
        machine=machine,
    )


def _parts(engine: BearingEngine | MachineEngine) -> list[FloatArray]:
    """Return everything that the set-up computed.

    The results are views of numbers.
    """
    _, context, memory, _ = engine.parts()
    tables = [getattr(context.bundle, name) for name in _TABLES]
    found = [table.view(np.float64).reshape(-1) for table in tables if table.size]
    control = memory.control.view(np.float64)
    at = [int(CONTROL.fields[name][1]) // 8 for name in _CONTROL]  # type: ignore[index]
    return [*found, memory.weight, memory.inertia, *(control[i : i + 1] for i in at)]


def _joined(parts: Sequence[FloatArray]) -> FloatArray:
    """Return all numbers one after another.

    A count below zero, which reads as no number, becomes -1. What has no end gets one that curves can be drawn to.
    """
    joined: FloatArray = np.nan_to_num(np.concatenate(parts), nan=-1.0, posinf=_ENDLESS, neginf=-_ENDLESS)
    return joined

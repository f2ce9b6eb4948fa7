"""Prepare the equilibrium search of a library at other inputs."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import CAGE, SPIN
from lambda_core.laws.jit.machine_code import Pointer
from lambda_core.laws.jit.portable import WORD, Entry
from lambda_core.model.bearing_model import TimeFunction
from lambda_core.model.laws.time_functions import initial
from lambda_core.solver import records as R
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.drivers.ball_paths import path_velocities
from lambda_core.solver.drivers.equilibrium import Equilibrium
from lambda_core.solver.drivers.first_state import roll
from lambda_core.solver.entry import UNITS, build
from lambda_core.solver.records import STATIC_REPORT


@dataclasses.dataclass(frozen=True)
class Start:
    """Arrays and numbers of a start.

    Attributes
    ----------
    state, weight, last, trust, held, report : arrays
        As :func:`lambda_core.solver.statics.continuation.solve_static` takes them; `state` is the case's equilibrium.
    rolling : float64[:, :, 4], shape (2, balls, 4)
        Orbital velocity [m/s] and spin [rad/s] of rolling balls: at rest of the inner ring, and per speed of it.
    slope : float64[:]
        Derivative with azimuth at the first ball of a row from values at every ball of it [1/rad].
    cage : tuple of (int, int)
        Entries of the state that are the cage's: where, and which of :data:`lambda_core.solver.records.BODY_STATE`.
    speed : float
        Of the inner ring in the case [rad/s].
    """

    state: FloatArray
    weight: FloatArray
    last: FloatArray
    trust: FloatArray
    held: Any
    report: Any
    rolling: FloatArray
    slope: FloatArray
    cage: tuple[tuple[int, int], ...]
    speed: float

    def sections(self) -> list[tuple[str, Any, Any]]:
        """Return what belongs into the image."""
        kinds = UNITS["solve_static"][1].args[5:11]
        names = ("state", "weight", "last", "trust", "held", "report")
        return [(f"start_{name}", kind, getattr(self, name)) for name, kind in zip(names, kinds, strict=True)]

    def entry(self, at: dict[str, int]) -> Entry:
        """Return the library's function for the equilibrium."""
        pointer = Pointer(build("solve_static"), UNITS["solve_static"][1])
        names = ("evaluate", "jacobian", "bundle", "blocks", "factors", *(name for name, *_ in self.sections()))
        return Entry("lb_static", pointer, (*(at[name] for name in names), WORD))


def prepare_start(found: Equilibrium) -> Start:
    """Return what a start from a case's equilibrium needs."""
    context, model = found.context, found.context.model
    size, balls = context.size, model.geometry.balls
    tail = size - context.bundle.states.size - context.bundle.active.size
    cage = [(tail + i, int(entry) - L.NS * CAGE) for i, entry in enumerate(context.bundle.active)]
    standing, turning = (_rolling(found, speed) for speed in (0.0, 1.0))
    row = np.zeros((model.geometry.ball_count,) * 2, R.BALL)
    row["radius"], row["velocity"][..., 2] = 1.0, 1.0
    row["x"] = np.eye(len(row))
    return Start(
        state=found.state.copy(),
        weight=1.0 / context.scale,
        last=np.zeros(size),
        trust=np.ones(balls),
        held=np.zeros(balls, dtype=np.int64),
        report=np.zeros(1, STATIC_REPORT),
        rolling=np.array([standing, turning - standing]),
        slope=np.array([path_velocities(each)[0, 0] for each in row]),
        cage=tuple((i, entry) for i, entry in cage if entry >= 0),
        speed=float(initial(model.inner_ring.dofs[SPIN].motion)),
    )


def _rolling(found: Equilibrium, speed: float) -> FloatArray:
    """Return orbital velocity and spin of the balls.

    They roll at a speed of the inner ring.
    """
    ring = found.context.model.inner_ring
    dof = dataclasses.replace(ring.dofs[SPIN], motion=TimeFunction.constant(speed))
    model = dataclasses.replace(
        found.context.model, inner_ring=dataclasses.replace(ring, dofs={**ring.dofs, SPIN: dof})
    )
    balls = L.elements_in(found.context.bundle, found.state.copy())
    roll(model, found.context.frame, balls, found.arcs)
    return np.column_stack([balls["velocity"][:, 2], balls["spin"]])

"""Resolve loads and motions whose course a law gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from lambda_core.case.signals import ByLaw, TimeTable, summands
from lambda_core.domain.elements import BODIES, DOFS
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import ROLES
from lambda_core.laws.calls import plain_call
from lambda_core.laws.par import flat_kernel, make_par
from lambda_core.laws.probe import trial_context
from lambda_core.model.bearing_model import TIME_PREFIX, ChosenLaw
from lambda_core.model.laws.given_parameters import law_by_name
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase
    from lambda_core.model.laws.resolve_laws import ModelSource

    C = TypeVar("C", Case, MachineCase)

ROLE = "time_function"
_USUAL, _LOOKS = 1.0, 4001  # time that is looked at where the case has no end [s]; how often
Course = tuple[str, float, float, float]  # element, f at t = 0, largest |f|, its highest frequency [Hz]


def signals_of(case: Case) -> Iterator[tuple[str, float | TimeTable | None]]:
    """Yield path and value of all time functions.

    Everything in a case that may change over time.
    """
    yield "operation.speed", case.operation.speed
    yield "operation.torque", case.operation.torque
    for name in ("radial", "axial", "moment_y", "moment_z"):
        yield f"loads.{name}", getattr(case.loads, name)
    for body in BODIES:
        own = getattr(case.loads, body)
        if own is not None:
            for name in type(own).model_fields:
                yield f"loads.{body}.{name}", getattr(own, name)
        for dof in DOFS:
            motion = getattr(getattr(getattr(case.bodies, body), dof), "motion", None)
            yield f"bodies.{body}.{dof}.motion", motion


Signals = Iterable[tuple[str, float | TimeTable | None]]


def _by_law(signals: Signals) -> Iterator[tuple[str, ByLaw[Any]]]:
    """Yield the signals that a law gives.

    Terms of sums are among them.
    """
    for path, term in summands(signals):
        if isinstance(term, ByLaw):
            yield path, term


def resolve_time_laws(
    case: C, signals: Callable[[C], Signals], registry: ModelSource, ledger: Ledger
) -> tuple[C, dict[str, dict[str, ChosenLaw]]]:
    """Return the case with resolved time laws.

    Its signals have their courses. Also return the laws under their names in the model.

    Parameters
    ----------
    signals : callable
        Path and value of everything in the case that may change over time.
    """
    if not any(True for _ in _by_law(signals(case))):
        return case, {}
    case = case.model_copy(deep=True)
    laws: dict[str, dict[str, ChosenLaw]] = {}
    for path, signal in _by_law(signals(case)):
        law = law_by_name(ROLE, signal.law, signal.parameters, path, registry, ledger)
        if law is None:
            continue
        element = f"{TIME_PREFIX}{path}"
        try:
            first, largest, frequency = _look(law, case.solver.duration or _USUAL)
        except PluginError as error:
            ledger.problem(f"{path}.law", str(error))
            continue
        laws[element] = {ROLE: law}
        signal.set_course((element, first, largest, frequency))
    return case, laws


def _look(law: ChosenLaw, until: float) -> tuple[float, float, float]:
    """Return f(0), largest |f| and frequency [Hz].

    The highest frequency of a law, which is called in plain Python.

    Of a sine of a frequency that changes slowly 2 pi times it is the root of |f''| over the largest |f|.
    """
    par = make_par(law.model, law.parameters, trial_context("time"))
    kernel, role = flat_kernel(law.model), ROLES[ROLE]
    rows = []
    for t in np.linspace(0.0, until, _LOOKS):
        outcome = plain_call(kernel, role, [t, par, np.full(len(role.outputs), np.nan)])
        if outcome.error or outcome.status != 1 or not np.isfinite(outcome.outputs[0]).all():
            said = law.model.errors.get(outcome.status, f"status {outcome.status}, {outcome.outputs}")
            raise PluginError(f"{law.model.label} has no value at t = {t:.6g} s: {outcome.error or said}")
        rows.append(outcome.outputs[0].copy())
    f, _, bend = np.abs(np.array(rows)).T
    largest = float(f.max())
    frequency = math.sqrt(float(bend.max()) / largest) / (2.0 * math.pi) if largest > 0.0 else 0.0
    return float(rows[0][0]), largest, frequency

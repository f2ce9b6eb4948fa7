"""Try out laws of others before anything is solved."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import Problem
from lambda_core.domain.installed import OWN, project_of
from lambda_core.domain.plugin_errors import PluginError
from lambda_core.domain.roles import RACEWAYS
from lambda_core.laws.check import check_choice, check_model
from lambda_core.laws.context import Context, Oil
from lambda_core.laws.par import flat_kernel
from lambda_core.laws.state import ROLE as STATES
from lambda_core.laws.state import names_behind
from lambda_core.model.bearing_model import BearingModel, ChosenLaw
from lambda_core.model.laws.law_context import ContactFrame, build_context, prepare

_STEP_P, _STEP_T = 1e6, 0.5  # for the slopes of the viscosity [Pa], [K]


def law_problems(model: BearingModel) -> tuple[Problem, ...]:
    """Test plugin laws with a case's parameters.

    Return the problems of each.

    The contacts stand at the angle 0 under an equal share of the load: what a law is asked is of the order of a run,
    not the same.

    Parameters
    ----------
    model : BearingModel
        From :func:`lambda_core.api.check`.

    Returns
    -------
    tuple of Problem
        Place in the case and sentence, one for each law; empty when all keep the rules of their roles.
    """
    foreign = [
        (element, role, law)
        for element, roles in model.laws.items()
        for role, law in roles.items()
        if project_of(law.model.distribution) != OWN
    ]
    circuit = model.electric.laws if model.electric is not None else {}
    films = [(role, law) for role, law in circuit.items() if project_of(law.model.distribution) != OWN]
    found: dict[str, Problem] = {}
    if foreign:
        frame = _frame(model)
        for element, role, law in foreign:
            message = _fault(model, element, law, frame)
            if message:
                found.setdefault(message.partition(" at ")[0], Problem(f"models.{role}", message))
    for role, law in films:
        for message in check_model(law.model, law.parameters).faults[:1]:
            found[message] = Problem(f"electric.{role}.law", message)
    return tuple(found.values())


def _fault(model: BearingModel, element: str, law: ChosenLaw, frame: ContactFrame) -> str:
    """Report a law's fault in one force element, if any."""
    oil = model.oil
    try:
        if law.model.role != "rheology":
            oil = _with_viscosity(model, element if element in RACEWAYS else RACEWAYS[0], frame)
        context = build_context(model, element, frame, oil)
        par = prepare(law, context)
        check_choice(law.model, par)
        if law.model.reads:
            check_choice(law.model, _at_the_start(model, element, law, par, context))
    except PluginError as error:
        return str(error)
    return ""


def _at_the_start(model: BearingModel, element: str, law: ChosenLaw, par: FloatArray, context: Context) -> FloatArray:
    """Return a law's parameters with initial states.

    It reads these states.
    """
    keeper = model.laws[element][STATES]
    starts = {state.name: state.at_start(keeper.parameters, context) for state in keeper.model.states}
    found, names = par.copy(), names_behind(law.model)
    for place, name in enumerate(law.model.reads):
        found[par.size - len(names) + place] = starts[name]
    return found


def _frame(model: BearingModel) -> ContactFrame:
    """Return contacts at the angle 0.

    The loads of the case are shared by the balls.
    """
    forces = [term.values[0] for f in model.inner_ring.force for term in f.terms if term.kind == "constant"]
    load = max(math.hypot(*forces) if forces else 0.0, 1.0) / model.geometry.ball_count
    return ContactFrame((0.0, 0.0), (load, load))


def _with_viscosity(model: BearingModel, element: str, frame: ContactFrame) -> Oil:
    """Return the oil with its rheology's values.

    The values hold at the bulk temperature; the law is called in plain Python.
    """
    law = model.laws[element]["rheology"]
    par = prepare(law, build_context(model, element, frame, model.oil))
    t = model.oil.temperature
    ln_eta, rho = np.full(4, np.nan), np.full(4, np.nan)
    pressures, temperatures = np.array([0.0, _STEP_P, 0.0, 0.0]), np.array([t, t, t - _STEP_T, t + _STEP_T])
    status = flat_kernel(law.model)(pressures, temperatures, par, ln_eta, rho)
    if status != 1 or not np.isfinite(ln_eta).all():
        raise PluginError(f"{law.model.label}: no finite viscosity and density at {t:.2f} K (status {status})")
    return replace(
        model.oil,
        viscosity=math.exp(ln_eta[0]),
        density=float(rho[0]),
        alpha_p=float((ln_eta[1] - ln_eta[0]) / _STEP_P),
        beta=float((ln_eta[2] - ln_eta[3]) / (2.0 * _STEP_T)),
    )

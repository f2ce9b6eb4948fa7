"""Compile and try the laws of a model."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import SolverError
from lambda_core.laws.context import Context, Oil
from lambda_core.laws.jit.words import addresses
from lambda_core.laws.kernels import compile_kernel
from lambda_core.laws.tried import Choice, try_out
from lambda_core.model.bearing_model import BearingModel, ChosenLaw
from lambda_core.model.laws.law_context import ContactFrame, build_context, prepare
from lambda_core.solver.arrays import bundle as L
from lambda_core.solver.core import begin
from lambda_core.solver.drivers.law_inputs import RACEWAYS, Oils, contacts_of, guides, links, oil_of, times
from lambda_core.solver.records import RACEWAY_ROLES

Announce = Callable[[str], None] | None
_Prepared = tuple[ChosenLaw, Context, FloatArray]
_KEPT = 2  # sets of parameters of a law: of the first guess of the contacts and of their place
# Hash of a law's code, force element and parameters of what was tried out and found in order.
_in_order: set[tuple[str, str, str]] = set()


class Kernels:
    """Compiled kernels of a model's laws.

    Pointers and code stay alive with this object.

    Parameters
    ----------
    model : BearingModel
        The model.
    announce : callable, optional
        Called with a sentence before something is compiled.
    near : Kernels, optional
        Of a model that shares laws with this one, whose code it takes over.
    """

    def __init__(self, model: BearingModel, announce: Announce = None, near: Kernels | None = None) -> None:
        self._laws, self._contacts = model.laws, contacts_of(model)
        self._guides, self._links, self._times = guides(model), links(model), times(model)
        begin(announce, has_rollers=model.rollers is not None)  # the solver is compiled at the same time
        # one model in several force elements is compiled once
        known: dict[tuple[str, str], Any] = {} if near is None else near.of_laws(model)
        self.compiled: dict[tuple[str, str], Any] = {}
        self._prepared: dict[tuple[str, str], list[_Prepared]] = {} if near is None else dict(near._prepared)
        for element, roles in model.laws.items():
            for role, law in roles.items():
                name = (role, law.model.label)  # two packages may have laws of one name
                if name not in known:
                    known[name] = compile_kernel(law.model, announce)
                self.compiled[element, role] = known[name]

    def of_laws(self, model: BearingModel) -> dict[tuple[str, str], Any]:
        """Return the kernels of laws that another model shares.

        The keys are role and label.
        """
        own = {
            (role, law.model.label): (law.model, self.compiled[element, role])
            for element, roles in self._laws.items()
            for role, law in roles.items()
        }
        wanted = {(role, law.model.label): law.model for roles in model.laws.values() for role, law in roles.items()}
        return {name: own[name][1] for name, law in wanted.items() if name in own and own[name][0] is law}

    def parameters(self, model: BearingModel, element: str, role: str, context: Context) -> FloatArray:
        """Return a law's parameters as its kernel reads them.

        They are those of an earlier call where law and context are the same: a model band solves some twenty models
        that differ in one law, and an equilibrium is found from a first guess of the contacts, then for their place.
        """
        law = model.laws[element][role]
        known = self._prepared.get((element, role), [])
        found = next((kept for kept in known if kept[0] is law and kept[1] == context), None)
        if found is None:
            found = law, context, prepare(law, context)
        others = [kept for kept in known if kept is not found]
        self._prepared[element, role] = [found, *others[: _KEPT - 1]]  # the last one used comes first
        return found[2]

    def keys(self) -> dict[str, str]:
        """Return "element/role/model" -> hash of everything the kernel reaches."""
        return {f"{e}/{r}/{self._laws[e][r].model.name}": k.key for (e, r), k in sorted(self.compiled.items())}

    def pointers(self) -> L.Laws:
        """Return the laws' addresses in order.

        The order is the solver's: one set per raceway, then pocket, inner and outer land.
        """

        def law(element: str, role: str) -> Any:
            return self.compiled[element, role].pointer

        def raceway(element: str) -> L.RacewayLaws:
            return L.RacewayLaws(*(law(element, role) for role in RACEWAY_ROLES))

        return L.Laws(
            addresses([raceway(element) for element in self._contacts]),
            addresses([[law(element, "cage_contact")] for element in self._guides]),
            addresses([[law("fluid_drag", "fluid_drag")]]),
            addresses([[law(element, "force_element")] for element in self._links]).reshape(-1, 1),
            addresses([[law(element, "time_function")] for element in self._times]).reshape(-1, 1),
        )


def check_laws(
    model: BearingModel, kernels: Kernels, frame: ContactFrame, oils: Oils, tried: BearingModel | None = None
) -> None:
    """Test every law with this run's parameters.

    It does so before any compiled code calls the laws.

    A law is tried once by a process for each choice of parameters: many runs of it take no longer for that.

    Parameters
    ----------
    tried : BearingModel, optional
        A model whose laws were tried: those that are the same objects need no look at their parameters.

    Raises
    ------
    PluginError
        With the first law that does not keep the contract of its role.
    """
    fresh: dict[tuple[str, str, str], Choice] = {}
    for element, roles in model.laws.items():
        context = build_context(model, element, frame, oil_of(oils, element))
        for role, law in roles.items():
            if tried is not None and tried.laws.get(element, {}).get(role) is law:
                continue
            compiled = kernels.compiled[element, role]
            key = (compiled.key, element, law.parameters.model_dump_json())
            if key not in _in_order:
                fresh[key] = Choice(law.model, prepare(law, context), compiled)
    _try_out(fresh)


def _try_out(fresh: dict[tuple[str, str, str], Choice]) -> None:
    """Try out what this process has not tried yet."""
    if fresh:
        try_out(list(fresh.values()))
        _in_order.update(fresh)


def derive_oils(model: BearingModel, kernels: Kernels, frame: ContactFrame) -> Oils:
    """Return the oil of each raceway contact.

    The rheology of the oil gives its constants.
    """
    inner, outer = (_derive_oil(model, kernels, frame, element) for element in RACEWAYS)
    return inner, outer


def _derive_oil(model: BearingModel, kernels: Kernels, frame: ContactFrame, element: str) -> Oil:
    """Return the oil with its rheology's constants.

    The rheology kernel of one contact gives viscosity, density, alpha_p and beta.

    alpha_p is the tangent d ln(eta)/dp at p = 0, beta is -d ln(eta)/dT at the bulk temperature.
    """
    law = model.laws[element]["rheology"]
    par = prepare(law, build_context(model, element, frame, model.oil))
    compiled = kernels.compiled[element, "rheology"]
    key = (compiled.key, element, law.parameters.model_dump_json())
    if key not in _in_order:
        _try_out({key: Choice(law.model, par, compiled)})
    t, dp, dt = model.oil.temperature, 1e6, 0.5
    p = np.array([0.0, dp, 2.0 * dp, 0.0, 0.0])
    temperatures = np.array([t, t, t, t - dt, t + dt])
    ln_eta, rho = np.full(5, np.nan), np.full(5, np.nan)
    status = compiled.dispatcher(p, temperatures, par, ln_eta, rho)
    if status != 1 or not np.all(np.isfinite(ln_eta)) or not np.all(rho > 0.0):
        raise SolverError(f"{law.model.label}: no finite viscosity and density at {t:.2f} K (status {status})")
    alpha = (-3.0 * ln_eta[0] + 4.0 * ln_eta[1] - ln_eta[2]) / (2.0 * dp)
    beta = (ln_eta[3] - ln_eta[4]) / (2.0 * dt)
    return dataclasses.replace(
        model.oil, viscosity=math.exp(ln_eta[0]), density=float(rho[0]), alpha_p=float(alpha), beta=float(beta)
    )

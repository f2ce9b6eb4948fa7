"""Resolve the parameters of the laws of rollers."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ValidationError

from lambda_core.case.problems import problems
from lambda_core.domain.elements import RIBS
from lambda_core.domain.errors import unknown_name
from lambda_core.domain.installed import OWN
from lambda_core.domain.roles import (
    DEFAULT_LINE_MODELS,
    DEFAULT_MODELS,
    DEFAULT_ROLLER_MODELS,
    DEFAULT_SHAPE_MODELS,
    MOTION_ROLES,
    ROLLER_CHOICES,
    ROLLER_FRICTION,
)

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.laws.law import Law
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.laws.resolve_laws import ModelSource
    from lambda_core.model.ledger import Ledger

_DEFAULTS = DEFAULT_MODELS | DEFAULT_ROLLER_MODELS | DEFAULT_LINE_MODELS | DEFAULT_SHAPE_MODELS
_OF_THE_OIL = ("rheology",)  # roles in which an oil has its own default
_ELECTRIC = ("permittivity", "capacitance")  # roles of the capacitance, see roller_dielectric


def written_parameters(law: Law, role: str, written: Mapping[str, Any], ledger: Ledger) -> BaseModel | None:
    """Return a law's parameters as in a case.

    The others have their defaults; None follows a problem.
    """
    try:
        found: BaseModel = law.parameters.model_validate(dict(written))
    except ValidationError as error:
        for problem in problems(error, law.parameters, dict(written)):
            ledger.problem(f"parameters.{role}.{problem.where}".rstrip("."), f"{law.name}: {problem.message}")
        return None
    return found


def law_of_rollers(law: Callable[[str, str], Law], role: str, name: str, ledger: Ledger) -> Law | None:
    """Return a law by role and name.

    None follows a problem: there is none, or it is one of balls.
    """
    found = ledger.ask(f"models.{role}", lambda: law(role, name))
    if found is None or found.contact != "point" or role not in DEFAULT_LINE_MODELS | DEFAULT_SHAPE_MODELS:
        return found
    ledger.problem(f"models.{role}", f'"{name}" is a law of balls: choose one of rollers')
    return None


def friction_of_case(case: Case, registry: ModelSource, ledger: Ledger) -> dict[str, Any]:
    """Return a case's friction data of rollers.

    Quasi-static friction, by names of FrictionParameters.

    Of parameters that it does not have the assumptions tell.
    """
    from lambda_core.model.laws.law_packages import law_called

    def law(role: str, name: str) -> Law:
        return law_called(registry, role, name, given=False)

    found: dict[str, Any] = {}
    chosen = {role: getattr(case.models, role) for role in type(case.models).model_fields}
    given = {role: name.removeprefix(f"{OWN}:") for role, name in chosen.items() if name and role not in _ELECTRIC}
    laws = {role: law_of_rollers(law, role, name, ledger) for role, name in given.items()}
    for role, name in given.items():
        names, _ = ROLLER_FRICTION.get(role, ((), {}))
        if name in names:
            found |= {ROLLER_CHOICES[role]: name} if role in ROLLER_CHOICES else {}
        else:
            known = f": the quasi-static answer has {names[0]}" if names else ""
            ledger.assume(f'models.{role} = "{name}" counts in motion only{known}')
    for role, written in case.parameters.items():
        if role in _ELECTRIC:
            continue
        if role not in MOTION_ROLES:
            ledger.problem(f"parameters.{role}", unknown_name("role", role, MOTION_ROLES))
            continue
        names, fields = ROLLER_FRICTION.get(role, ((), {}))
        name = given.get(role, _DEFAULTS[role])
        own = laws[role] if role in laws else None if role in _OF_THE_OIL else law(role, name)
        values = written_parameters(own, role, written, ledger) if own is not None and name != "none" else None
        told = fields if name in names else {}
        for key in told.keys() & written.keys() if values is not None else ():
            found[fields[key]] = float(getattr(values, key))
            ledger.given(f"parameters.{role}.{key}", found[fields[key]], "pressure" if key == "tau_eyring" else "")
        for key in written.keys() - told.keys():
            ledger.assume(f"parameters.{role}.{key} counts in motion only: the quasi-static answer has no such law")
    for rib in (name for name in RIBS if name in case.forces.model_fields_set):
        ledger.assume(f"forces.{rib} counts in motion only: the quasi-static answer has its own laws at ribs")
    for element in (name for name in case.forces.model_fields_set if name not in RIBS):
        ledger.assume(f"forces.{element} counts in motion only: the quasi-static answer has one law for both raceways")
    return found


def friction_of_model(model: BearingModel) -> dict[str, Any]:
    """Return a model's friction data of rollers.

    The model is resolved, with rollers in motion; its case has the data. What differs between the raceways counts in
    motion only.
    """
    found: dict[str, Any] = {}
    for role, (names, fields) in ROLLER_FRICTION.items():
        chosen, other = (model.laws[raceway][role] for raceway in ("ball_inner", "ball_outer"))
        name = chosen.model.name
        if name != other.model.name or name not in names:
            continue
        if role in ROLLER_CHOICES:
            found[ROLLER_CHOICES[role]] = name
        for key, field in fields.items():
            alike = getattr(chosen.parameters, key) == getattr(other.parameters, key)
            if chosen.origins.get(key) == "case" and alike:
                found[field] = float(getattr(chosen.parameters, key))
    return found

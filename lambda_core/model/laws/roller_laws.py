"""Resolve the parameters of the laws of rollers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ValidationError

from lambda_core.case.problems import problems
from lambda_core.domain.elements import RIBS
from lambda_core.domain.roles import ROLLER_CHOICES, ROLLER_FRICTION

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.laws.law import Law
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.laws.resolve_laws import ModelSource
    from lambda_core.model.ledger import Ledger


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


def friction_of_case(case: Case, registry: ModelSource, ledger: Ledger) -> dict[str, Any]:
    """Return a case's friction data of rollers.

    Quasi-static friction, by names of FrictionParameters.

    Of parameters that it does not have the assumptions tell.
    """
    from lambda_core.model.laws.law_packages import law_called

    found: dict[str, Any] = {}
    for role, (names, _) in ROLLER_FRICTION.items():
        name = getattr(case.models, role, None)
        if name is None:
            continue
        if role in ROLLER_CHOICES and name in names:
            found[ROLLER_CHOICES[role]] = name
        elif name not in names:
            ledger.assume(f'models.{role} = "{name}" counts in motion only: the quasi-static answer has {names[0]}')
    for role, written in case.parameters.items():
        names, fields = ROLLER_FRICTION.get(role, (("",), {}))
        name = getattr(case.models, role, None) or names[0]
        if name not in names:
            fields = {}
        if fields and written:
            values = written_parameters(law_called(registry, role, name, given=False), role, written, ledger)
            for key in fields.keys() & written.keys() if values is not None else ():
                found[fields[key]] = float(getattr(values, key))
                ledger.given(f"parameters.{role}.{key}", found[fields[key]], "pressure" if key == "tau_eyring" else "")
        for key in written.keys() - fields.keys():
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

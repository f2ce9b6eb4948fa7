"""Change one value or law of a resolved model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from lambda_core.analysis.band.graded import Graded, Resolver
from lambda_core.model.bearing_model import BearingModel, ChosenLaw

ROUGHNESS = "surface.roughness"


def is_of_laws(graded: Graded) -> bool:
    """Tell whether a parameter is one of laws or of what only laws see, and leaves the normal forces as they are."""
    return bool(graded.law) or graded.path == ROUGHNESS


def with_value(model: BearingModel, graded: Graded, number: float, resolver: Resolver) -> BearingModel:
    """Return a model with another value of a parameter of a law, of its roughness, or of an option of its case."""
    if is_of_laws(graded):
        return with_value_of_laws(model, graded, number)
    return resolved_anew(model, graded.changes(number), resolver)


def with_value_of_laws(model: BearingModel, graded: Graded, number: float) -> BearingModel:
    """Return a model with another value of a parameter of which :func:`is_of_laws` is True."""
    if graded.law:
        return _with_parameter(model, graded, number)
    return replace(model, roughness=graded.si(number))


def _with_parameter(model: BearingModel, graded: Graded, number: float) -> BearingModel:
    """Return a model whose laws of one role and name have another parameter, but where it was given apart."""
    _, role, name = graded.path.split(".")
    first = next(roles[role] for roles in model.laws.values() if _is_of(roles, role, graded.law))
    written = first.parameters.model_dump(mode="json") | {name: graded.written(number)}
    value = getattr(type(first.parameters).model_validate(written), name)
    own = getattr(first.parameters, name)
    laws = {
        element: {
            **roles,
            role: replace(roles[role], parameters=roles[role].parameters.model_copy(update={name: value})),
        }
        if _is_of(roles, role, graded.law) and getattr(roles[role].parameters, name) == own
        else roles
        for element, roles in model.laws.items()
    }
    return replace(model, laws=laws)


def _is_of(roles: Mapping[str, ChosenLaw], role: str, law: str) -> bool:
    return role in roles and roles[role].model.name == law


def with_laws(model: BearingModel, role: str, other: BearingModel) -> BearingModel:
    """Return a model with the laws of one role of another one."""
    laws = {
        element: {**roles, role: other.laws[element][role]} if role in roles else roles
        for element, roles in model.laws.items()
    }
    return replace(model, laws=laws)


def resolved_anew(model: BearingModel, changes: Sequence[str], resolver: Resolver) -> BearingModel:
    """Return the model of a changed case, under the loads and at the speed of a model.

    Those of a bearing of a machine are not in its case.
    """
    from lambda_core.case.case_io import apply_overrides, parse_case

    return as_loaded(resolver(apply_overrides(parse_case(model.case_toml, model.name), changes)), model)


def as_loaded(moved: BearingModel, model: BearingModel) -> BearingModel:
    """Return a model in the place of another one: with its loads, speed and mounting, and no search of temperatures."""
    return replace(
        moved,
        name=model.name,
        title=model.title,
        inner_ring=model.inner_ring,
        outer_ring=model.outer_ring,
        links=model.links,
        thermal=None,
    )

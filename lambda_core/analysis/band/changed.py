"""Change one value or law of a resolved model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from lambda_core.analysis.band.graded import Graded, Resolver
from lambda_core.model.bearing_model import BearingModel, ChosenLaw

ROUGHNESS = "surface.roughness"


def is_of_laws(graded: Graded) -> bool:
    """Tell whether a parameter belongs to laws alone.

    True for a parameter of laws or of what only laws read that leaves the normal forces unchanged.
    """
    return bool(graded.law) or graded.path == ROUGHNESS


def with_value(model: BearingModel, graded: Graded, number: float, resolver: Resolver) -> BearingModel:
    """Return a model with another value of a parameter.

    The parameter belongs to a law, to its roughness, or is an option of its case.
    """
    if is_of_laws(graded):
        return with_value_of_laws(model, graded, number)
    return resolved_anew(model, graded.changes(number), resolver)


def with_value_of_laws(model: BearingModel, graded: Graded, number: float) -> BearingModel:
    """Return a model with another parameter of its laws.

    :func:`is_of_laws` is True for the parameter.
    """
    if graded.law:
        return _with_parameter(model, graded, number)
    return replace(model, roughness=graded.si(number))


def _with_parameter(model: BearingModel, graded: Graded, number: float) -> BearingModel:
    """Return a model with another parameter of some laws.

    The laws have one role and name; a value that was given separately stays.
    """
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
    """Return a model with another model's laws of a role."""
    laws = {
        element: {**roles, role: other.laws[element][role]} if role in roles else roles
        for element, roles in model.laws.items()
    }
    return replace(model, laws=laws)


def resolved_anew(model: BearingModel, changes: Sequence[str], resolver: Resolver) -> BearingModel:
    """Return the model of a changed case.

    Loads and speed are those of the given model.

    Those of a bearing of a machine are not in its case.
    """
    from lambda_core.case.case_io import apply_overrides

    return as_loaded(resolver(apply_overrides(model.case, changes)), model)


def as_loaded(moved: BearingModel, model: BearingModel) -> BearingModel:
    """Return a model in the place of another one.

    It takes its loads, speed and mounting, and does not search for temperatures.
    """
    return replace(
        moved,
        name=model.name,
        title=model.title,
        inner_ring=model.inner_ring,
        outer_ring=model.outer_ring,
        links=model.links,
        thermal=None,
    )

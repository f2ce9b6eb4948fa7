"""Read parameters of laws, observers and events from a case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ValidationError

from lambda_core.case.problems import problems
from lambda_core.domain.errors import LambdaError, unknown_name
from lambda_core.model.bearing_model import ChosenLaw
from lambda_core.model.ledger import Ledger

if TYPE_CHECKING:
    from lambda_core.model.laws.resolve_laws import ModelSource


def given_parameters(what: str, model: type[BaseModel], texts: Mapping[str, Any], where: str, ledger: Ledger) -> Any:
    """Return an instance of `model`, or None after a mistake.

    The ledger takes every mistake.

    Parameters
    ----------
    what : str
        Whose parameters they are, for people: "discharge arc-voltage".
    where : str
        Path of the table in the case.
    """
    fields = list(model.model_fields)
    foreign = [key for key in texts if key not in fields]
    for key in foreign:
        # A plugin's class may be declared to ignore what it does not know; a typing slip is no less one.
        ledger.problem(f"{where}.{key}", unknown_name(f"parameter of {what}", key, fields))
    if foreign:
        return None
    try:
        return model.model_validate(dict(texts))
    except ValidationError as error:
        for problem in problems(error, model, dict(texts)):
            ledger.problem(f"{where}.{problem.where}", f"{what}: {problem.message}")
    return None


def record_parameters(parameters: BaseModel, texts: Mapping[str, Any], where: str, ledger: Ledger) -> dict[str, str]:
    """Write every parameter into the ledger.

    Return the origin of each, "case" or "default".
    """
    origins = {key: "case" if key in texts else "default" for key in type(parameters).model_fields}
    for key, value in parameters.model_dump(mode="json").items():
        plain = value if isinstance(value, int | float | str) else str(value)
        ledger.record(f"{where}.{key}", plain, "", origins[key], "given" if key in texts else "default")
    return origins


def law_by_name(
    role: str, name: str, texts: Mapping[str, Any], where: str, registry: ModelSource, ledger: Ledger
) -> ChosenLaw | None:
    """Return the law of a table, with parameters.

    The table of a case names it; None comes with every mistake in the ledger.

    Parameters
    ----------
    texts : mapping
        What stands in the table `parameters` after the name.
    where : str
        Path in the case of the table that has `law` and `parameters`.
    """
    try:
        chosen = registry.model(role, name)
    except LambdaError as error:
        ledger.problem(f"{where}.law", str(error))
        return None
    own = f"{where}.parameters"
    parameters = given_parameters(f"{role} {chosen.name}", chosen.parameters, texts, own, ledger)
    if parameters is None:
        return None
    ledger.record(f"{where}.law", chosen.name, "", chosen.distribution or "built-in", "given")
    return ChosenLaw(chosen, parameters, record_parameters(parameters, texts, own, ledger))

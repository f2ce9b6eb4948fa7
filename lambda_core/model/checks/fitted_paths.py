"""Check where the fitted values of a case stand."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from lambda_core.case.fitted import FitOrigin, FittedValue
from lambda_core.case.machine import place_in_machine
from lambda_core.domain.errors import Problem, unknown_name
from lambda_core.domain.units import parse
from lambda_core.domain.written_values import scale_of
from lambda_core.model.bearing_model import BearingModel, ChosenLaw, ResolvedValue

FITTED_TABLES = ("lubricant", "surface", "bearing", "loads", "operation")  # whose numbers a fit may vary
_KIND = "number of this case"


def fit_problems(fit: FitOrigin | None, known: Mapping[str, ResolvedValue | str | float]) -> list[Problem]:
    """Return problems of fitted values.

    They are those of paths and units.

    A value at a wrong path has no effect, and the range of the right one counts in its place.

    Parameters
    ----------
    known : mapping
        Numbers of the case by path, see :func:`known_numbers`.
    """
    found = []
    for number, row in enumerate(fit.parameters if fit is not None else ()):
        where = f"fit.parameters.{number}"
        if row.path not in known:
            found.append(Problem(f"{where}.path", unknown_name(_KIND, row.path, known)))
        elif wrong := _unit_problem(row, known[row.path]):
            found.append(Problem(f"{where}.unit", wrong))
    return found


def machine_fit_problems(
    fit: FitOrigin | None, tables: Mapping[str, Any], models: Mapping[str, BearingModel]
) -> list[Problem]:
    """Return problems of a machine's fitted values.

    They are those of paths and units.

    They are those of parameters that its bearings have, or of numbers that stand in its tables.
    """
    if fit is None or len(models) < len(tables["bearings"]):
        return []
    known: dict[str, ResolvedValue | str | float] = dict(_written(tables))
    for name, model in models.items():
        numbers = known_numbers(model.laws, model.values)
        own = {place_in_machine(tables, name, path): value for path, value in numbers.items()}
        known |= {f"bearings.{name}.{path}": value for path, value in numbers.items() if path.startswith("parameters.")}
        known |= {path: value for path, value in own.items() if path.split(".")[0] in ("parameters", "bearings")}
    return fit_problems(fit, known)


def _written(tables: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, str | float]]:
    """Yield the numbers in tables.

    They are with and without units.
    """
    for name, value in tables.items():
        if isinstance(value, Mapping):
            yield from _written(value, f"{before}{name}.")
        elif isinstance(value, int | float | str) and not isinstance(value, bool):
            yield f"{before}{name}", value


def known_numbers(
    laws: Mapping[str, Mapping[str, ChosenLaw]], values: Iterable[ResolvedValue]
) -> dict[str, ResolvedValue | str | float]:
    """Return the fittable numbers of a case.

    The keys are their paths; the values are quantities or numbers as written. The case is one of a bearing.
    """
    own = (value for value in values if value.path.split(".")[0] in FITTED_TABLES and isinstance(value.value, float))
    return {**dict(_of_laws(laws)), **{value.path: value for value in own}}


def _of_laws(laws: Mapping[str, Mapping[str, ChosenLaw]]) -> Iterator[tuple[str, str | float]]:
    for roles in laws.values():
        for role, law in roles.items():
            for name, value in law.parameters.model_dump(mode="json").items():
                if value is None or (isinstance(value, int | float | str) and not isinstance(value, bool)):
                    yield f"parameters.{role}.{name}", "" if value is None else value


def _unit_problem(row: FittedValue, known: ResolvedValue | str | float) -> str:
    """Return the problem of a fitted value's unit.

    It is empty when there is none.
    """
    text = f"{row.value!r} {row.unit}" if row.unit else row.value
    try:
        if isinstance(known, ResolvedValue):
            if known.quantity:
                parse(str(text), known.quantity)
        elif known != "" and scale_of([known, text]) is None:
            return f"{row.path} is not a number"
    except ValueError as error:
        return f"{row.path}: {error}"
    return ""

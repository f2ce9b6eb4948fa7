"""What is left of a case when its mistakes are taken out: so that later checks can add theirs at once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from lambda_core.case.case import Case
from lambda_core.case.problems import problems
from lambda_core.domain.errors import CaseError, Problem

# Stand-ins for required options that are missing or wrong; problems with them are never shown.
_STAND_INS: dict[tuple[str, ...], Any] = {
    ("name",): "case",
    ("bearing",): {},
    ("lubricant",): {"name": "FVA3", "temperature": "40 degC"},
    ("lubricant", "name"): "FVA3",
    ("lubricant", "temperature"): "40 degC",
    ("operation",): {"speed": "1000 rpm"},
    ("operation", "speed"): "1000 rpm",
}
_ROUNDS = 20


class InvalidCase(CaseError):
    """A case with mistakes of its own; `remainder` is the case without them, if one is left."""

    def __init__(self, source: str, problems: Sequence[Problem], remainder: Case | None) -> None:
        super().__init__(source, problems)
        self.remainder = remainder

    def joined(self, others: Sequence[Problem]) -> CaseError:
        """Return one error with these problems and those of `others` that do not follow from them."""
        known = [problem.where for problem in self.problems]
        new = [other for other in others if not any(_related(other.where, where) for where in known)]
        return CaseError(self.source, [*self.problems, *new])


def _related(one: str, other: str) -> bool:
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def invalid_case(source: str, error: ValidationError, data: Mapping[str, Any], folder: Path | None) -> InvalidCase:
    """Return the error that names every mistake in `data`, with what is left of the case."""
    return InvalidCase(source, problems(error, Case, data), _remainder(error, data, folder))


def _remainder(error: ValidationError, data: Mapping[str, Any], folder: Path | None) -> Case | None:
    rest = deepcopy(dict(data))
    for _ in range(_ROUNDS):
        for item in error.errors(include_url=False, include_context=False):
            path = tuple(p for p in item["loc"] if not str(p).startswith("kind:"))
            _take_out(rest, path[:-1] if item["type"] == "missing" and path not in _STAND_INS else path)
        try:
            return Case.model_validate(rest, context={"folder": folder})
        except ValidationError as again:
            error = again
    return None


def _take_out(data: dict[str, Any], path: tuple[int | str, ...]) -> None:
    """Remove what stands at `path` (a whole list for one of its entries), or put its stand-in there."""
    table: Any = data
    for depth, key in enumerate(path[:-1]):
        if not isinstance(table, dict) or not isinstance(table.get(key), dict):
            path = path[: depth + 1]
            break
        table = table[key]
    if path and isinstance(table, dict):
        if path in _STAND_INS:
            table[str(path[-1])] = deepcopy(_STAND_INS[path])  # type: ignore[index]
        else:
            table.pop(path[-1], None)

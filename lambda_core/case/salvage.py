"""Remove the faulty parts of a case.

Later checks can then report their own errors at once.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from lambda_core.case.problems import problems
from lambda_core.domain.errors import CaseError, Problem

StandIns = Mapping[tuple[str, ...], Any]

_ROUNDS = 20
# Stand-ins for required options that are missing or wrong; problems with them are never shown.
SHARED_STAND_INS: StandIns = {
    ("name",): "case",
    ("lubricant",): {"name": "FVA3", "temperature": "40 degC"},
    ("lubricant", "name"): "FVA3",
    ("lubricant", "temperature"): "40 degC",
    ("operation",): {"speed": "1000 rpm"},
    ("operation", "speed"): "1000 rpm",
}


class InvalidCase(CaseError):
    """Case with mistakes.

    `remainder` is the case without them, if one is left.
    """

    def __init__(self, source: str, problems: Sequence[Problem], remainder: Any) -> None:
        super().__init__(source, problems)
        self.remainder = remainder

    def joined(self, others: Sequence[Problem]) -> CaseError:
        """Return one error with these and other problems.

        Problems of `others` that follow from these are left out.
        """
        known = [problem.where for problem in self.problems]
        new = [other for other in others if not any(related(other.where, where) for where in known)]
        return CaseError(self.source, [*self.problems, *new])


def related(one: str, other: str) -> bool:
    """Tell whether one path contains the other."""
    return f"{one}.".startswith(f"{other}.") or f"{other}.".startswith(f"{one}.")


def invalid_case(
    source: str,
    error: ValidationError,
    data: Mapping[str, Any],
    folder: Path | None,
    root: type[BaseModel],
    stand_ins: StandIns,
) -> InvalidCase:
    """Return the error of every mistake in `data`.

    It has what is left of the case, of one bearing or a shaft.
    """
    return InvalidCase(source, problems(error, root, data), _remainder(error, data, folder, root, stand_ins))


def _remainder(
    error: ValidationError, data: Mapping[str, Any], folder: Path | None, root: type[BaseModel], stand_ins: StandIns
) -> BaseModel | None:
    rest = deepcopy(dict(data))
    for _ in range(_ROUNDS):
        for item in error.errors(include_url=False, include_context=False):
            path = tuple(p for p in item["loc"] if not str(p).startswith("kind:"))
            _take_out(rest, path, stand_ins)
        try:
            return root.model_validate(rest, context={"folder": folder})
        except ValidationError as again:
            error = again
    return None


def _take_out(data: dict[str, Any], path: tuple[int | str, ...], stand_ins: StandIns) -> None:
    """Remove what stands at `path`, or put its stand-in there.

    It is a whole list for one of its entries, and the whole table for an option that is missing in it.
    """
    table: Any = data
    for depth, key in enumerate(path[:-1]):
        if not isinstance(table, dict) or not isinstance(table.get(key), dict):
            path = path[: depth + 1]
            break
        table = table[key]
    if not path or not isinstance(table, dict):
        return
    if path in stand_ins:
        table[str(path[-1])] = deepcopy(stand_ins[path])  # type: ignore[index]
    elif path[-1] in table:
        table.pop(path[-1])
    else:
        _take_out(data, path[:-1], stand_ins)

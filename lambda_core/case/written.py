"""Define the base of every case: checks, name, folder, changes."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Self, TypeVar

from pydantic import PrivateAttr, ValidationError, model_validator

from lambda_core.case.option import NAME_PATTERN, Section, option
from lambda_core.case.salvage import InvalidCase, StandIns, invalid_case
from lambda_core.case.signals import is_signal
from lambda_core.domain.errors import CaseError, Problem
from lambda_core.domain.inline_laws import named, packed, unpack

_DEEPEST = 20  # levels of tables and lists
_LAWS_IN = ("models", "forces", "electric")  # where a program may hand over a law in place of its name


class Written(Section):
    """Part that every case has.

    It has a name and a folder, and can be changed.
    """

    name: str = option(description="short name, used for files", pattern=NAME_PATTERN)
    description: str = option("", "short text about the case")
    assumptions: list[str] = option([], "what the author of the case assumed, repeated with every result")
    # what stands in for required options that are missing or wrong, so that the rest of the case can be checked
    STAND_INS: ClassVar[StandIns] = {}
    _folder: Path | None = PrivateAttr(default=None)

    @model_validator(mode="after")
    def _remember_folder(self, info: Any) -> Self:
        self._folder = (info.context or {}).get("folder")
        return self

    @property
    def folder(self) -> Path | None:
        """Folder of the file names in the case.

        None is the working directory.
        """
        return self._folder

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self.model_dump() == other.model_dump()

    __hash__ = None  # type: ignore[assignment]

    def __getstate__(self) -> dict[Any, Any]:
        """Return the state for pickle.

        It has the laws that were passed as objects, which no other process knows.
        """
        return {**super().__getstate__(), "handed": packed()}

    def __setstate__(self, state: dict[Any, Any]) -> None:
        """Take what was pickled."""
        unpack(state.pop("handed", b""))
        super().__setstate__(state)

    def __dir__(self) -> list[str]:
        """Return the names that a notebook completes.

        They are sections, and the methods of a case.
        """
        return sorted({*type(self).model_fields, "folder", "written", "with_"})

    @classmethod
    def own_problems(cls, data: Mapping[str, Any]) -> list[Problem]:
        """Return problems of the names of parts.

        They are those of plain tables, each at its own path.
        """
        return []

    def written(self) -> dict[str, Any]:
        """Return the plain tables of the case's file.

        They have unit strings, and no defaults.
        """
        return self.model_dump(mode="json", exclude_unset=True, exclude_none=True)

    def with_(self, **changes: Any) -> Self:
        """Return a copy with `changes` merged in, section by section.

        Examples
        --------
        ``case.with_(operation={"speed": "2750 rpm"}, bearing={"clearance": "C3"})``; None
        takes an option back to its default. A law may stand as the function itself: ``case.with_(models={"traction":
        law})``, with ``@law(...)`` above it.

        Raises
        ------
        CaseError
            With every problem of the changed case.
        """
        return validate(type(self), merged(self.written(), changes), self.name, self._folder)


C = TypeVar("C", bound=Written)


def validate(root: type[C], data: Mapping[str, Any], source: str = "case", folder: Path | None = None) -> C:
    """Check plain tables as a case of a class.

    InvalidCase with every mistake at once, and what is left without.
    """
    if isinstance(data.get("parameters"), list) and "bearing" not in data:
        raise CaseError(source, [Problem("", f"is a study, not a case: lambda-bearing study run {source}")])
    if _is_deep(data):
        raise CaseError(source, [Problem("", "is nested too deeply")])
    data = {key: named(value) if key in _LAWS_IN else value for key, value in data.items()}
    found = root.own_problems(data)
    try:
        case = root.model_validate(data, context={"folder": folder})
    except ValidationError as error:
        wrong = invalid_case(source, error, data, folder, root, root.STAND_INS)
        raise InvalidCase(source, [*wrong.problems, *found], wrong.remainder) from None
    if found:
        raise InvalidCase(source, found, case)
    return case


def merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Merge tables key by key.

    None removes a key, a time function replaces completely.
    """
    result = dict(base)
    for key, value in changes.items():
        old = result.get(key)
        if value is None:
            result.pop(key, None)
        elif isinstance(value, Mapping) and isinstance(old, Mapping) and not is_signal(value):
            result[key] = merged(old, value)
        elif isinstance(value, Mapping):
            result[key] = merged({}, value)
        else:
            result[key] = value
    return result


def _is_deep(data: Any) -> bool:
    """Tell whether tables are nested too deeply.

    Beyond what any case needs; lists count. It makes no call for each level.
    """
    level = [data]
    for _ in range(_DEEPEST):
        level = [
            item for part in level if isinstance(part, (Mapping, list))
            for item in (part.values() if isinstance(part, Mapping) else part)
        ]  # fmt: skip
        if not level:
            return False
    return True

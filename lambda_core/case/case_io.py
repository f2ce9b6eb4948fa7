"""Read, change and write cases."""

from __future__ import annotations

import logging
import re
import tomllib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from os import PathLike
from pathlib import Path
from typing import Any, Protocol

from pydantic import BaseModel

from lambda_core.case.builtin import builtin_cases, builtin_text, is_builtin
from lambda_core.case.case import Case
from lambda_core.case.machine import MachineCase
from lambda_core.case.written import C, merged, validate
from lambda_core.domain.errors import CaseError, Problem, UsageError, nearest
from lambda_core.domain.files import read_text
from lambda_core.domain.lists import listed
from lambda_core.domain.option_tree import field_at

log = logging.getLogger("lambda_core")
# As ISO 5753-1 names the classes; normal clearance, CN, is not written.
_CLEARANCE_CLASS = re.compile(r"(?<=[/ ])C[1-5](?=[LHMP]?\b)")
_LOCATION = re.compile(r"\(at (?:line (\d+), column (\d+)|end of document)\)")
_BARE_UNIT = re.compile(r"^(\s*[\w.\"-]+\s*=\s*)([+-]?[\d.,]+\s*[A-Za-z/][^#\"]*?)\s*(#.*)?$")
_SOURCES = "give a file, the name of a built-in case, tables, a case or a machine"
_FILES = 8  # most names that an error lists


class CaseWriter(Protocol):
    """Source that can write a case.

    It is a case itself, or a machine built in Python.
    """

    @property
    def name(self) -> str:
        """Short name, for messages."""

    @property
    def folder(self) -> Path | None:
        """Folder of the file names in the case.

        None is the working directory.
        """

    def written(self) -> dict[str, Any]:
        """Return the plain tables of the case's file.

        They have unit strings.
        """


Source = str | Path | Mapping[str, Any] | CaseWriter  # a file, a built-in name, plain tables, a case, a machine


@dataclass(frozen=True)
class Tables:
    """Tables of a source, valid or not.

    Attributes
    ----------
    data : dict
        Plain tables.
    name : str
        Of the file or the case, for messages.
    folder : Path or None
        That file names in the tables are relative to; None: the working directory.
    first_root : type, optional
        Class of the case before it was changed: no change makes a machine of a bearing, or the other way round.
    """

    data: dict[str, Any]
    name: str
    folder: Path | None
    first_root: type[Case] | type[MachineCase] | None = None

    @property
    def root(self) -> type[Case] | type[MachineCase]:
        """Class of the case.

        It is a case of one bearing, or a machine.
        """
        return self.first_root or (MachineCase if is_machine_case(self.data) else Case)

    def changed(self, overrides: Iterable[str]) -> Tables:
        """Return the tables with ``path=value`` texts applied.

        They are applied in order, as ``--set`` does; a text without ``=`` raises a UsageError.
        """
        changes = listed(overrides, "overrides")
        if not changes:
            return self
        data = overridden(self.data, changes, self.root)
        _say_lost_classes(self.data, data)
        return replace(self, data=data, first_root=self.root)


def read_tables(source: Source, folder: Path | None = None) -> Tables:
    """Return the plain tables of a source.

    Parameters
    ----------
    source : str, Path, mapping or case
        TOML file, name of a built-in case, plain tables, or a case.
    folder : Path, optional
        That file names in plain tables are relative to.

    Raises
    ------
    UsageError
        When there is neither such a file nor such a built-in case.
    CaseError
        When the file is not TOML.
    """
    if isinstance(source, Mapping):
        return Tables(dict(source), str(source.get("name", "case")), folder)
    if not isinstance(source, str | PathLike):
        if not hasattr(source, "written"):
            raise UsageError(f"{type(source).__name__} is not a case: {_SOURCES}")
        return Tables(source.written(), source.name, source.folder)
    path = Path(source)
    if path.is_file():
        return Tables(toml_tables(case_text(path), path.name), path.name, path.resolve().parent)
    if is_builtin(str(source)):
        return Tables(toml_tables(builtin_text(str(source)), str(source)), str(source), None)
    if path.is_dir():
        raise UsageError(f'"{source}" is a folder: name a case file in it')
    raise UsageError(f'"{source}" is neither a file nor a built-in case; {_instead_of(path)}')


def _instead_of(path: Path) -> str:
    """Name an alternative to a missing file."""
    names = list(builtin_cases())
    close = nearest(str(path), names)
    files = sorted(file.name for file in path.parent.glob("*.toml")) if path.suffix == ".toml" else []
    if Path(f"{path}.toml").is_file():
        return f"the file is {path}.toml"
    if files:
        listed = ", ".join([*files[:_FILES], "..."] if len(files) > _FILES else files)
        likely = ", ".join(nearest(path.name, files))
        return f"nearest files there: {likely}" if likely else f"files there: {listed}"
    if close:
        return f"nearest built-in cases: {', '.join(close)}"
    return (
        f"built-in cases: {', '.join(names)}; lambda-bearing init starts one for any bearing (--bearing), "
        "or a machine (--template geared-shaft)"
    )


def read_case(source: Source, overrides: Iterable[str] = (), folder: Path | None = None) -> Case | MachineCase:
    """Read a case from any source.

    The source is a case of one bearing or of a machine.

    Parameters
    ----------
    source : str, Path, mapping or case
        TOML file, name of a built-in case, plain tables, or a case.
    overrides : iterable of str
        Changes ``path=value``, as ``--set`` takes them.
    folder : Path, optional
        That file names in plain tables are relative to.

    Raises
    ------
    UsageError
        When there is no such file or name, or an override has no ``=``.
    CaseError
        With every problem of the case.
    """
    changes = listed(overrides, "overrides")
    if isinstance(source, Case | MachineCase) and not changes:
        return source
    tables = read_tables(source, folder).changed(changes)
    return validate(tables.root, tables.data, _changed_name(tables.name, changes), tables.folder)


def bearing_case(source: Source, overrides: Iterable[str] = (), folder: Path | None = None) -> Case:
    """Read the case of one bearing.

    As :func:`read_case`; a machine is a CaseError.
    """
    changes = listed(overrides, "overrides")
    if isinstance(source, Case) and not changes:
        return source
    tables = read_tables(source, folder).changed(changes)
    name = _changed_name(tables.name, changes)
    if tables.root is MachineCase:
        raise CaseError(name, [Problem("", "is a machine, and this needs the case of one bearing")])
    return validate(Case, tables.data, name, tables.folder)


def _changed_name(name: str, changes: Sequence[str]) -> str:
    return f"{name} with {', '.join(changes)}" if changes else name


def case_text(path: Path) -> str:
    """Return the text of a case file.

    CaseError where it is no text, UsageError where it cannot be read.
    """
    try:
        return read_text(path)
    except UnicodeDecodeError:
        is_result = path.suffix == ".h5"
        told = "is a result: name the file of a case here" if is_result else "is not a text file in UTF-8"
        raise CaseError(path.name, [Problem("", told)]) from None
    except OSError as error:
        raise UsageError(f'cannot read "{path}": {error.strerror}') from None


def toml_tables(text: str, source: str) -> dict[str, Any]:
    """Return the plain tables of TOML text.

    CaseError with the line where it is not TOML.
    """
    try:
        return tomllib.loads(text)
    except ValueError as error:  # of TOML, or of a whole number that Python does not read
        raise CaseError(source, [syntax_problem(str(error), text)]) from None
    except RecursionError:
        raise CaseError(source, [Problem("", "is nested too deeply")]) from None


def is_machine(source: Any) -> bool:
    """Tell whether a source is a machine.

    A machine has a shaft in bearings.

    Parameters
    ----------
    source : str, Path, mapping, case or resolved model
        Whatever a function takes as a case.

    Returns
    -------
    bool

    Raises
    ------
    UsageError
        When it is no case, or there is no such file or built-in case.
    CaseError
        When the file is not TOML.
    """
    if isinstance(source, Case | MachineCase):
        return isinstance(source, MachineCase)
    if hasattr(source, "bearing_models"):
        return hasattr(source, "bearings")  # a resolved model
    return is_machine_case(read_tables(source).data)


def refuse_bearing(name: str | None) -> None:
    """Refuse a bearing's name for a one-bearing case.

    The error is a UsageError.
    """
    if name is not None:
        raise UsageError(f'this case has one bearing: leave out --bearing "{name}"')


def is_machine_case(data: Mapping[str, Any]) -> bool:
    """Tell whether plain tables are a machine.

    They have a table that only machines have, and no bearing that is alone.
    """
    return "bearing" not in data and not Case.INSTEAD.keys().isdisjoint(data)


def syntax_problem(message: str, text: str) -> Problem:
    """Explain an error of the TOML syntax.

    The text has the line and a fix for the usual slip.
    """
    if "integer string conversion" in message:
        return Problem("", "holds a whole number of more digits than any number of a case has")
    location = _LOCATION.search(message)
    if location is None or location[1] is None:
        return Problem("end of the file", message.split(" (at")[0])
    number, column = int(location[1]), int(location[2])
    lines = text.splitlines()
    line = lines[number - 1] if number <= len(lines) else ""
    bare = _BARE_UNIT.match(line)
    where = f"line {number}"
    if bare:
        value = re.sub(r"(\d),(\d)", r"\1.\2", bare[2].strip())
        return Problem(where, f'{line.strip()}: write the value in quotes: {bare[1].strip()} "{value}"')
    return Problem(where, f"{line.strip()}: {message[: location.start()].strip()} (column {column})")


def apply_overrides(case: C, overrides: Iterable[str]) -> C:
    """Return the case with ``path=value`` texts applied.

    They are applied in order, as ``--set`` does.

    Raises
    ------
    UsageError
        When a text is not of the form ``path=value``.
    CaseError
        When the changed case is invalid.
    """
    changes = listed(overrides, "overrides")
    return validate(
        type(case), overridden(case.written(), changes, type(case)), _changed_name(case.name, changes), case.folder
    )


def overridden(data: Mapping[str, Any], overrides: Iterable[str], root: type[BaseModel]) -> dict[str, Any]:
    """Return plain tables with ``path=value`` texts applied.

    They are applied in order; `root` says which options want text.

    Raises
    ------
    UsageError
        When a text is not of the form ``path=value``.
    """
    tables = dict(data)
    for text in overrides:
        if not isinstance(text, str):
            raise UsageError(f'{text!r} is not a change: write path=value, for example loads.radial="20 kN"')
        path, equals, value = text.partition("=")
        parts = [part.strip() for part in path.split(".")]
        if not equals or not all(parts):
            raise UsageError(f'"{text}": write path=value, for example loads.radial="20 kN"')
        change: Any = _value(".".join(parts), value.strip(), root)
        for part in reversed(parts):
            change = {part: change}
        tables = merged(tables, change)
    return tables


def _say_lost_classes(old: Mapping[str, Any], new: Mapping[str, Any]) -> None:
    """Warn of a clearance class that was lost.

    It was part of a designation that was replaced.
    """
    before, after = _designations(old), _designations(new)
    for path, designation in after.items():
        lost = _CLEARANCE_CLASS.search(before.get(path, ""))
        if lost and not _CLEARANCE_CLASS.search(designation):
            _warn_once(
                f'{path}.designation: "{designation}" replaces "{before[path]}" and names no clearance class: the '
                f'bearing has normal clearance; write "{designation}/{lost[0]}" to keep {lost[0]}'
            )


@cache
def _warn_once(sentence: str) -> None:
    """Warn once.

    A command that reads its case several times repeats nothing.
    """
    log.warning(sentence)


def _designations(data: Mapping[str, Any]) -> dict[str, str]:
    """Return the designations by path of the bearing.

    They are those in plain tables.
    """
    several = data.get("bearings")
    tables = {f"bearings.{name}": table for name, table in (several if isinstance(several, Mapping) else {}).items()}
    tables["bearing"] = data.get("bearing")
    found = {
        path: table.get("designation")
        for path, table in tables.items()
        if isinstance(table, Mapping) and "clearance" not in table
    }
    return {path: designation for path, designation in found.items() if isinstance(designation, str)}


def _value(path: str, text: str, root: type[BaseModel]) -> Any:
    """Read the right-hand side of an override.

    It is TOML where the option wants it, else the text itself.
    """
    try:
        parsed = tomllib.loads(f"value = {text}")["value"]
    except ValueError:
        return text
    info = field_at(root, path)
    wants_text = info is not None and "str" in str(info.annotation)
    return text if wants_text and isinstance(parsed, int | float) and not isinstance(parsed, bool) else parsed

"""Reading, changing and writing cases: TOML in, TOML out, every mistake at once."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from lambda_core.case.builtin import builtin_cases, builtin_text, is_builtin
from lambda_core.case.case import Case, merged
from lambda_core.case.salvage import invalid_case
from lambda_core.domain.errors import CaseError, LambdaError, Problem, UsageError, nearest
from lambda_core.domain.files import read_text
from lambda_core.domain.handed_laws import named
from lambda_core.domain.option_tree import field_at

_DEEPEST = 20  # levels of tables and lists
_LOCATION = re.compile(r"\(at (?:line (\d+), column (\d+)|end of document)\)")
_BARE_UNIT = re.compile(r"^(\s*[\w.\"-]+\s*=\s*)([+-]?[\d.,]+\s*[A-Za-z/][^#\"]*?)\s*(#.*)?$")
_LAWS_IN = ("models", "forces", "electric")  # where a program may hand over a law in place of its name
_FILES = 8  # most names that an error lists


def load_case(source: str | Path) -> Case:
    """Read a case from a TOML file, or a built-in case by its name.

    Raises
    ------
    UsageError
        When there is neither such a file nor such a built-in case.
    CaseError
        With every problem of the case.
    """
    path = Path(source)
    if path.is_file():
        return parse_case(case_text(path), source=path.name, folder=path.resolve().parent)
    if is_builtin(str(source)):
        return parse_case(builtin_text(str(source)), source=str(source))
    if path.is_dir():
        raise UsageError(f'"{source}" is a folder, not a case file')
    names = list(builtin_cases())
    close = nearest(str(source), names)
    files = sorted(file.name for file in path.parent.glob("*.toml")) if path.suffix == ".toml" else []
    if Path(f"{source}.toml").is_file():
        hint = f"the file is {source}.toml"
    elif files:
        listed = ", ".join([*files[:_FILES], "..."] if len(files) > _FILES else files)
        likely = ", ".join(nearest(path.name, files))
        hint = f"nearest files there: {likely}" if likely else f"files there: {listed}"
    elif close:
        hint = f"nearest built-in cases: {', '.join(close)}"
    else:
        hint = f"built-in cases: {', '.join(names)}; lambda-bearing init starts one for any bearing (--bearing)"
    raise UsageError(f'"{source}" is neither a file nor a built-in case; {hint}')


def case_text(path: Path) -> str:
    """Return the text of a case file; CaseError where it is no text, UsageError where it cannot be read."""
    try:
        return read_text(path)
    except UnicodeDecodeError:
        raise CaseError(path.name, [Problem("", "is not a text file in UTF-8")]) from None
    except OSError as error:
        raise UsageError(f'cannot read "{path}": {error.strerror}') from None


def parse_case(text: str, source: str = "case", folder: Path | None = None) -> Case:
    """Read a case from TOML text; `folder` is where its file names are looked up."""
    return validate_case(toml_tables(text, source), source, folder)


def toml_tables(text: str, source: str) -> dict[str, Any]:
    """Return the plain tables of TOML text; CaseError with the line where it is none."""
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise CaseError(source, [syntax_problem(str(error), text)]) from None
    except RecursionError:
        raise CaseError(source, [Problem("", "is nested too deeply")]) from None


def shaft_tables(source: str | Path) -> dict[str, Any]:
    """Return what stands in the TOML file of a shaft.

    Raises
    ------
    UsageError
        When there is no such file.
    CaseError
        When it is not TOML.
    """
    path = Path(source)
    if not path.is_file():
        how = "lambda-bearing init NAME --template geared-shaft writes one to start from"
        raise UsageError(f'"{source}" is not a file; {how}')
    return toml_tables(case_text(path), path.name)


def validate_case(data: Mapping[str, Any], source: str = "case", folder: Path | None = None) -> Case:
    """Check plain tables as a case; CaseError with every problem at once."""
    if isinstance(data.get("parameters"), list) and "bearing" not in data:
        raise CaseError(source, [Problem("", f"is a study, not a case: lambda-bearing study run {source}")])
    if is_shaft(data):
        raise CaseError(source, [Problem("", "is a machine of several bearings; this question is about one bearing")])
    if _is_deep(data):
        raise CaseError(source, [Problem("", "is nested too deeply")])
    data = {key: named(value) if key in _LAWS_IN else value for key, value in data.items()}
    try:
        return Case.model_validate(data, context={"folder": folder})
    except ValidationError as error:
        raise invalid_case(source, error, data, folder) from None


def is_machine(source: Any) -> bool:
    """Tell whether a source is a machine of several bearings, not one bearing; False where nothing can be read.

    Parameters
    ----------
    source : str, Path, mapping, case or resolved model
        Whatever a function takes as a case.
    """
    if isinstance(source, Mapping):
        return is_shaft(source)
    if not isinstance(source, str | Path):
        return hasattr(source, "bearings")  # a case or a model; that of one bearing has `bearing`, or is one
    try:
        return is_shaft(shaft_tables(source))
    except LambdaError:
        return False


def refuse_bearing(name: str | None) -> None:
    """Refuse the name of a bearing where the case has one only; UsageError."""
    if name is not None:
        raise UsageError(f'this case has one bearing: leave out --bearing "{name}"')


def is_shaft(data: Mapping[str, Any]) -> bool:
    """Tell whether plain tables are those of a shaft in bearings, not of one bearing."""
    return "bearing" not in data and ("shaft" in data or "bearings" in data)


def _is_deep(data: Any) -> bool:
    """Tell whether tables and lists are nested beyond what any case needs, without a call for each level."""
    level = [data]
    for _ in range(_DEEPEST):
        level = [
            item for part in level if isinstance(part, (Mapping, list))
            for item in (part.values() if isinstance(part, Mapping) else part)
        ]  # fmt: skip
        if not level:
            return False
    return True


def syntax_problem(message: str, text: str) -> Problem:
    """Say what is wrong with the TOML itself, with its line and a fix for the usual slip."""
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


def apply_overrides(case: Case, overrides: Iterable[str]) -> Case:
    """Return the case with ``path=value`` texts applied in order, as ``--set`` does.

    Raises
    ------
    UsageError
        When a text is not of the form ``path=value``.
    CaseError
        When the changed case is invalid.
    """
    texts = list(overrides)
    data = overridden(case.written(), texts, Case)
    return validate_case(data, f"{case.name} with {', '.join(texts)}" if texts else case.name, case.folder)


def overridden(data: Mapping[str, Any], overrides: Iterable[str], root: type[BaseModel]) -> dict[str, Any]:
    """Return plain tables with ``path=value`` texts applied in order; `root` says which options want text.

    Raises
    ------
    UsageError
        When a text is not of the form ``path=value``.
    """
    tables = dict(data)
    for text in overrides:
        path, equals, value = text.partition("=")
        parts = [part.strip() for part in path.split(".")]
        if not equals or not all(parts):
            raise UsageError(f'"{text}": write path=value, for example loads.radial="20 kN"')
        change: Any = _value(".".join(parts), value.strip(), root)
        for part in reversed(parts):
            change = {part: change}
        tables = merged(tables, change)
    return tables


def _value(path: str, text: str, root: type[BaseModel]) -> Any:
    """Read the right-hand side of an override: TOML where the option wants it, else the text itself."""
    try:
        parsed = tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text
    info = field_at(root, path)
    wants_text = info is not None and "str" in str(info.annotation)
    return text if wants_text and isinstance(parsed, int | float) and not isinstance(parsed, bool) else parsed

"""Write a case as TOML and keep its comments."""

from __future__ import annotations

import json
import os
import re
import tempfile
import tomllib
from collections.abc import Callable, Mapping
from difflib import SequenceMatcher
from pathlib import Path
from typing import Any, TypeVar

import tomlkit
from tomlkit.items import AoT, Array, Item, Table, Trivia
from tomlkit.toml_document import TOMLDocument

from lambda_core.case.builtin import builtin_cases, builtin_text
from lambda_core.case.case_io import read_case, toml_tables
from lambda_core.case.electric import Series
from lambda_core.case.machine import Housing, Shaft
from lambda_core.case.signals import Table as TimeTableFile
from lambda_core.case.written import Written, validate
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.domain.files import check_new, check_target

_PLAIN = re.compile(r"[\w .+/-]*", re.ASCII)  # texts without anything to escape
C = TypeVar("C", bound=Written)
_INLINE_KEYS = frozenset({"kind", "mode", "points"})  # small tables that read best on one line

# Option that names a file, relative to that of the case, by the section.
_FILES = {TimeTableFile: "file", Series: "file", Shaft: "reduced", Housing: "reduced"}


def case_toml(case: Written, original: str | None = None, folder: Path | None = None) -> str:
    """Write a case as TOML.

    Parameters
    ----------
    case : Case or MachineCase
        What to write.
    original : str, optional
        Text of the file it came from; its comments, order and the spelling of unchanged
        values are kept.
    folder : pathlib.Path, optional
        Where the text will stand: the files that the case names are found from there. Default: the case's own.
    """
    written = case.written() if folder is None else _relocated(case, folder)
    if original is None:
        return _fresh(written)
    try:
        before = validate(type(case), toml_tables(original, case.name), folder=case.folder).written()
    except CaseError:
        before = {}
    document = tomlkit.parse(original)
    _update(document, before, written)
    return tomlkit.dumps(document)


def standalone_toml(case: Written) -> str:
    """Write a case for any folder."""
    return _fresh(standalone(case))


def standalone(case: Written) -> dict[str, Any]:
    """Return tables that are read from any folder.

    CSV tables become points, paths of reduced models absolute.
    """

    def change(section: Any, written: Any) -> Any:
        if isinstance(section, TimeTableFile | Series) and section.file is not None:
            return section.inlined()
        if isinstance(section, Shaft | Housing) and section.reduced is not None:
            return {**written, "reduced": str(((case.folder or Path()) / section.reduced).absolute())}
        return None

    return dict(_replaced(case, case.written(), change))


def in_folder(case: C, folder: Path) -> C:
    """Name the files of a case from another folder."""
    return validate(type(case), _relocated(case, folder), case.name, folder)


def _relocated(case: Written, folder: Path) -> dict[str, Any]:
    """Return the tables of a case for another folder."""
    begin, end = (case.folder or Path()).resolve(), folder.resolve()

    def named_from_there(section: Any, written: Any) -> Any:
        key = next((key for kind, key in _FILES.items() if isinstance(section, kind)), None)
        if key is None or getattr(section, key) is None:
            return None
        try:
            way = os.path.relpath(begin / written[key], end)
        except ValueError:  # another drive
            way = str(begin / written[key])
        return {**written, key: written[key] if Path(written[key]).is_absolute() else Path(way).as_posix()}

    return case.written() if begin == end else dict(_replaced(case, case.written(), named_from_there))


def _fresh(tables: Mapping[str, Any]) -> str:
    document = tomlkit.document()
    _fill(document, tables)
    return tomlkit.dumps(document)


def tables_toml(tables: Mapping[str, Any], original: str = "") -> str:
    """Write plain tables as TOML, valid or not.

    Common parts with `original` keep its text.
    """
    original = _renamed(original, tables)
    document = tomlkit.parse(original)
    if original.strip():
        _update(document, tomllib.loads(original), tables)
    else:
        _fill(document, tables)
    return tomlkit.dumps(document)


def _renamed(original: str, tables: Mapping[str, Any]) -> str:
    """Return a text with new names of tables.

    The comments thus stay with their tables.

    A table is renamed where one of a section goes and one comes that says the same; of the others, where as many come
    as go, each in its turn: a new name stands where the old one stood.
    """
    text = original
    for section, before in tomllib.loads(original).items():
        after = tables.get(section)
        if not isinstance(before, dict) or not isinstance(after, Mapping):
            continue
        gone = [name for name in before if name not in after and isinstance(before[name], dict)]
        come = [name for name in after if name not in before and isinstance(after[name], Mapping)]
        pairs = []
        for old in list(gone):
            alike = [name for name in come if after[name] == before[old]]
            if alike:
                pairs.append((old, alike[0]))
                gone.remove(old)
                come.remove(alike[0])
        for old, new in [*pairs, *(zip(gone, come, strict=True) if len(gone) == len(come) else ())]:
            text = _with_name(text, section, old, new)
    return text


def _with_name(text: str, section: str, old: str, new: str) -> str:
    """Return a text with one table renamed.

    The table is one of a section; the text stays as it was where this would change anything else.
    """
    key = new if re.fullmatch(r"[\w-]+", new, re.ASCII) else json.dumps(new)
    one = rf"(\"?){re.escape(old)}\2"  # bare or quoted
    heads = rf"^(\s*\[+\s*{re.escape(section)}\s*\.\s*){one}(?=\s*[.\]])"
    dotted = rf"^(\s*{re.escape(section)}\s*\.\s*){one}(?=\s*[.=])"
    changed = text
    for pattern in (heads, dotted):
        changed = re.sub(pattern, lambda found: found[1] + key, changed, flags=re.MULTILINE)
    begin = re.search(rf"^\s*\[\s*{re.escape(section)}\s*\].*$", changed, re.MULTILINE)
    if begin is not None:  # keys below the section's own header
        following = re.compile(r"^\s*\[\s*[\w\"'\[]", re.MULTILINE).search(changed, begin.end())
        end = following.start() if following else len(changed)
        own = re.sub(
            rf"^(\s*){one}(?=\s*[.=])", lambda found: found[1] + key, changed[begin.end() : end], flags=re.MULTILINE
        )
        changed = changed[: begin.end()] + own + changed[end:]
    wanted = tomllib.loads(text)
    wanted[section] = {new if name == old else name: table for name, table in wanted[section].items()}
    try:
        return changed if tomllib.loads(changed) == wanted else text
    except tomllib.TOMLDecodeError:
        return text


def save_case(case: Written, path: str | Path, original: str | None = None) -> None:
    """Write a case to `path` in one step.

    A crash leaves the old file complete.

    `original` defaults to the text that stands in `path`, so that saving keeps comments.

    Raises
    ------
    UsageError
        When the file cannot be written.
    """
    target = Path(path)
    if original is None and target.is_file():
        try:
            original = target.read_text(encoding="utf-8-sig")
        except OSError as error:
            raise UsageError(f'cannot read "{target}": {error.strerror}') from None
    save_text(case_toml(case, original, target.resolve().parent), target)


def save_text(text: str, target: Path) -> None:
    """Write a file in one step.

    It holds the old text or the new one, never a part.

    Raises
    ------
    UsageError
        When the file cannot be written; nothing is left behind.
    """
    check_target(target)
    temporary = ""
    try:
        handle, temporary = tempfile.mkstemp(dir=target.resolve().parent, prefix=f".{target.name}.")
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
        os.chmod(temporary, target.stat().st_mode & 0o777 if target.exists() else 0o644)
        os.replace(temporary, target)
    except OSError as error:
        if temporary:
            Path(temporary).unlink(missing_ok=True)
        raise UsageError(f'cannot write "{target}": {error.strerror}') from None


def new_case(name: str, start: str, path: Path, overwrite: bool) -> Path:
    """Write the case `start` under another name.

    The comments are included; see :func:`lambda_core.api.init_case`.
    """
    original = builtin_text(start) if start in builtin_cases() else None
    source = read_case(start)
    try:
        renamed = source.with_(name=name)
    except CaseError as error:
        raise CaseError(f'new case "{name}"', error.problems) from None
    if original is None:
        original = Path(start).read_text(encoding="utf-8-sig")
    return write_new(renamed, original, path, overwrite)


def write_new(case: Written, original: str, path: Path, overwrite: bool) -> Path:
    """Write a case with comments to a new file.

    The comments are those of `original`.

    Raises
    ------
    UsageError
        When the file exists and may not be overwritten, or cannot be written.
    """
    save_case(case, check_new(path, overwrite), original)
    return path


def _replaced(section: Any, written: Any, change: Callable[[Any, Any], Any]) -> Any:
    """Replace tables for which `change` returns another one."""
    if (other := change(section, written)) is not None:
        return other
    if isinstance(written, Mapping):
        get = section.get if isinstance(section, Mapping) else lambda key: getattr(section, key)
        return {key: _replaced(get(key), value, change) for key, value in written.items()}
    if isinstance(written, list) and isinstance(section, list):
        return [_replaced(part, value, change) for part, value in zip(section, written, strict=True)]
    return written


def _is_inline(value: Mapping[str, Any]) -> bool:
    return bool(_INLINE_KEYS & value.keys())


def _item(value: Any, *, inside: bool = False) -> Any:
    """Return a value for a document.

    With `inside` every table is an inline table.
    """
    if isinstance(value, Mapping):
        inside = inside or _is_inline(value)
        table: Any = tomlkit.inline_table() if inside else tomlkit.table(is_super_table=_only_tables(value))
        _fill(table, value, inside=inside)
        return table
    if not inside and _are_tables(value):
        tables = tomlkit.aot()
        for part in value:
            tables.append(_item(part))
        return tables
    return _List(value) if isinstance(value, list) else tomlkit.item(value)


class _List(Array):
    """List that is written at once.

    The library's own takes time with the square of its length.
    """

    def __init__(self, values: list[Any]) -> None:
        super().__init__([], Trivia())
        self._text = _inline(values)

    def as_string(self) -> str:
        """Return the text."""
        return self._text


def _inline(value: Any) -> str:
    """Write a value on one line."""
    if isinstance(value, list):
        return f"[{', '.join(map(_inline, value))}]"
    if isinstance(value, Mapping):
        return f"{{{', '.join(f'{tomlkit.key(name).as_string()} = {_inline(item)}' for name, item in value.items())}}}"
    if isinstance(value, str) and _PLAIN.fullmatch(value):
        return f'"{value}"'
    return str(tomlkit.item(value).as_string())


def _only_tables(value: Mapping[str, Any]) -> bool:
    return bool(value) and all(isinstance(v, Mapping) and not _is_inline(v) for v in value.values())


def _are_tables(value: Any) -> bool:
    """Tell whether a value is a list of tables.

    They are written one below the other.
    """
    return isinstance(value, list) and bool(value) and all(isinstance(v, Mapping) and not _is_inline(v) for v in value)


def _fill(container: Any, values: Mapping[str, Any], *, inside: bool = False) -> None:
    """Add plain values first, then sub-tables.

    TOML reads that order without repeated headers.
    """
    plain = [
        key for key, value in values.items()
        if not _are_tables(value) and (not isinstance(value, Mapping) or _is_inline(value))
    ]  # fmt: skip
    for key in [*plain, *(key for key in values if key not in plain)]:
        if isinstance(container, TOMLDocument) and key not in plain:
            container.add(tomlkit.nl())
        container.add(key, _item(values[key], inside=inside))


def _update(container: Any, before: Mapping[str, Any], after: Mapping[str, Any]) -> None:
    """Change a parsed file from `before` to `after`.

    Only differences are written.
    """
    for key in [key for key in container if key not in after]:
        del container[key]
    for key, value in after.items():
        if key in container and key in before and before[key] == value:
            continue
        old = container.get(key)
        if isinstance(value, Mapping) and not _is_inline(value) and isinstance(old, Mapping):
            known = before.get(key)
            _update(old, known if isinstance(known, Mapping) else {}, value)
        elif isinstance(old, AoT) and _are_tables(value):
            _update_tables(old, before[key], value)
        else:
            container[key] = _apart(_item(value)) if old is None else _item(value)
            _keep_column(old, container[key])


def _keep_column(old: Any, new: Any) -> None:
    """Leave the comment of a replaced value in its column."""
    if isinstance(old, Item) and isinstance(new, Item) and new.trivia.comment and not isinstance(new, Table | AoT):
        longer = len(new.as_string()) - len(old.as_string())
        new.trivia.comment_ws = " " * max(1, len(old.trivia.comment_ws) - longer)


def _apart(item: Any) -> Any:
    """Return a table separated from the next one.

    The text comes into a file.
    """
    if isinstance(item, Table) and not item.is_super_table():
        item.add(tomlkit.nl())
    return item


def _update_tables(tables: AoT, before: list[Any], after: list[Any]) -> None:
    """Change the tables of a list to `after`.

    One that moves up or down keeps its text.
    """
    steps = SequenceMatcher(None, list(map(str, before)), list(map(str, after)), autojunk=False)
    for what, begin, end, first, last in reversed(steps.get_opcodes()):
        if what == "equal":
            continue
        same = min(end - begin, last - first)
        for i in range(same):
            _update(tables[begin + i], before[begin + i], after[first + i])
        for i in reversed(range(begin + same, end)):
            del tables[i]
        for i, part in enumerate(after[first + same : last]):
            tables.insert(begin + same + i, _apart(_item(part)))

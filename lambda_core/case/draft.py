"""Edit a case whose tables may still be wrong."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any, get_origin

from pydantic import BaseModel

from lambda_core.case.builtin import builtin_cases, builtin_text
from lambda_core.case.case import Case
from lambda_core.case.case_io import is_machine_case, read_tables, syntax_problem
from lambda_core.case.case_writer import save_text, tables_toml
from lambda_core.case.holding import Dof
from lambda_core.case.machine import MachineCase
from lambda_core.domain.errors import CaseError, UsageError
from lambda_core.domain.files import read_text
from lambda_core.domain.option_tree import model_at

Keys = tuple[str, ...]
_MODE, _STIFFNESS = "mode", "stiffness"


@dataclass(frozen=True)
class _Change:
    keys: Keys
    before: Any  # None: nothing was written
    after: Any


_SEAL = _Change((), None, None)


@dataclass
class Draft:
    """Contents of a case editor.

    Values are set one by one, may be wrong, can be undone, and are written to the file
    with everything else in it left as it was.

    Attributes
    ----------
    path : pathlib.Path or None
        The file; None for a case that has none yet.
    original : str
        Text of the file when it was last read or written: comments and spellings are kept from it.
    tables : dict
        What the file would say now.
    root : type of BaseModel
        What the file is to be: the case of one bearing (`Case`), or of a machine (`MachineCase`).
    """

    path: Path | None
    original: str
    tables: dict[str, Any]
    folder: Path | None = None  # that file names in the tables are relative to; None: the working directory
    root: type[BaseModel] = Case
    _saved: dict[str, Any] = field(default_factory=dict)
    _done: list[_Change] = field(default_factory=list)
    _undone: list[_Change] = field(default_factory=list)

    def __post_init__(self) -> None:
        self._saved = deepcopy(self.tables)

    # -- values --

    def get(self, *keys: str) -> Any:
        """Return the value at a place.

        None where nothing is written.
        """
        value: Any = self.tables
        for key in keys:
            value = _inner(_in_full(value), key) if self._is_dof(keys[:-1]) and key == keys[-1] else _inner(value, key)
        return value

    def set(self, *keys: str, value: Any) -> None:
        """Write a value, or remove it with None.

        Empty tables go with their last value.

        Changes of one place that follow each other are undone together. Tables of a list come and go with the list.

        Parameters
        ----------
        *keys : str
            Path of the option; of a table in a list its number, from "0" on.
        value : object
            What would stand in the file.
        """
        before = deepcopy(self.get(*keys))
        if before == value and type(before) is type(value):
            return
        self._put(keys, value)
        last = self._done[-1] if self._done else None
        if last is not None and last.keys == keys and not self._undone:
            self._done[-1] = _Change(keys, last.before, deepcopy(value))
        else:
            self._done.append(_Change(keys, before, deepcopy(value)))
        self._undone.clear()

    def replace(self, tables: Mapping[str, Any]) -> None:
        """Replace all tables.

        Each replacement is undone separately.
        """
        keys = dict.fromkeys((*self.tables, *tables))
        self.seal()
        for key in keys:
            self.set(key, value=tables.get(key))

    def seal(self) -> None:
        """End a series of changes of one place.

        The next one is undone separately.
        """
        if self._done and self._done[-1].keys:
            self._done.append(_SEAL)

    def undo(self) -> Keys | None:
        """Undo the last change.

        Return its place, None when there is none.
        """
        while self._done and not self._done[-1].keys:
            self._done.pop()
        if not self._done:
            return None
        change = self._done.pop()
        self._undone.append(change)
        self._put(change.keys, change.before)
        return change.keys

    def redo(self) -> Keys | None:
        """Redo what `undo` reverted.

        Return its place, None when there is nothing.
        """
        if not self._undone:
            return None
        change = self._undone.pop()
        self._done.append(change)
        self._put(change.keys, change.after)
        return change.keys

    def _put(self, keys: Keys, value: Any) -> None:
        tables: list[Any] = [self.tables]
        for key in keys[:-1]:
            inner = _inner(tables[-1], key)
            if not isinstance(inner, dict | list):
                inner = _in_full(inner) if isinstance(inner, str) and self._is_dof(keys[:-1]) else {}
                tables[-1][key] = inner
            tables.append(inner)
        if value is None:
            tables[-1].pop(keys[-1], None)
        else:
            tables[-1][keys[-1]] = deepcopy(value)
        for table, key in zip(reversed(tables[:-1]), reversed(keys[:-1]), strict=True):
            if isinstance(table, list):
                continue
            if not table[key] and not (table is not self.tables and table is tables[1] and self._names_tables(keys[0])):
                del table[key]
            elif len(table[key]) == 1 and self._is_dof(keys[:-1]) and (short := {_MODE, _STIFFNESS} & set(table[key])):
                table[key] = table[key][short.pop()]

    def _names_tables(self, section: str) -> bool:
        """Tell whether a section has named tables.

        Each of them means something even when empty.
        """
        info = self.root.model_fields.get(section)
        return info is not None and get_origin(info.annotation) is dict

    def _is_dof(self, keys: Keys) -> bool:
        """Tell whether a place holds a degree of freedom.

        It may have the short form.
        """
        return _stands_dof(self.root, keys)

    # -- what it means --

    @property
    def is_machine_case(self) -> bool:
        """True for the case of a machine."""
        return self.root is MachineCase

    def is_changed(self, *keys: str) -> bool:
        """Tell whether a place differs from the file.

        Without a place, tell whether anything differs.
        """
        saved: Any = self._saved
        for key in keys:
            saved = _inner(_in_full(saved) if self._is_dof(keys[:-1]) and key == keys[-1] else saved, key)
        return bool((self.get(*keys) if keys else self.tables) != saved)

    # -- the file --

    def text(self) -> str:
        """Return the file's text as it would be saved now."""
        return tables_toml(self.tables, self.original)

    def save(self, path: Path | None = None) -> Path:
        """Write the file in one step and return it.

        Raises
        ------
        UsageError
            When there is no path yet, or the file cannot be written; the draft stays as it is.
        """
        target = path or self.path
        if target is None:
            raise UsageError("this case has no file yet: give a name to save it")
        text = self.text()
        save_text(text, target)
        self.path, self.folder, self.original = target, target.resolve().parent, text
        self._saved = deepcopy(self.tables)
        self.seal()
        return target

    def changed_on_disk(self) -> bool:
        """Tell whether somebody else has changed the file.

        The change is later than the last reading or saving here.
        """
        if self.path is None:
            return False
        try:
            return self.path.read_text(encoding="utf-8-sig") != self.original
        except (OSError, UnicodeDecodeError):
            return True


@lru_cache(maxsize=4096)  # an editor asks for every option of a case after every change
def _stands_dof(root: type[BaseModel], keys: Keys) -> bool:
    table = model_at(root, keys) if keys else None
    return table is not None and issubclass(table, Dof)


def _inner(value: Any, key: str) -> Any:
    """Return the value of a table or list.

    The key is that of a table, or a number of a list; the result is None where there is nothing.
    """
    if isinstance(value, list):
        return value[int(key)] if key.isdecimal() and int(key) < len(value) else None
    return value.get(key) if isinstance(value, Mapping) else None


def _in_full(value: Any) -> Any:
    """Return the full table of a degree of freedom.

    The short form "free" gives {mode = "free"}.
    """
    if not isinstance(value, str):
        return value
    return {_STIFFNESS if value[:1].isdigit() else _MODE: value}


def new_draft(name: str = "untitled", *, is_machine: bool = False) -> Draft:
    """Return a draft with a name.

    It is the case of one bearing, or of a machine.

    The inner ring of one bearing does not tilt, as in every new case: a shaft on two bearings hardly does.
    """
    tables: dict[str, Any] = {"name": name}
    if not is_machine:
        tables["bodies"] = {"inner_ring": {"tilt_y": "locked", "tilt_z": "locked"}}
    return Draft(None, "", tables, Path.cwd(), MachineCase if is_machine else Case)


def open_draft(source: str | Path) -> Draft:
    """Open a case for editing.

    It is a case file, or a copy of a built-in case; it may hold mistakes.

    Raises
    ------
    UsageError
        When there is no such file or built-in case.
    CaseError
        When the file is not TOML at all.
    """
    path = Path(source)
    if path.is_file():
        return draft_of(_read(path), path)
    if str(source) in builtin_cases():
        return draft_of(builtin_text(str(source)), None)
    read_tables(source)  # says what there is instead
    raise AssertionError("neither a file nor a built-in case, and no error says so")


def draft_of(text: str, path: Path | None) -> Draft:
    """Return the draft of a file's text.

    CaseError when it is not TOML.
    """
    try:
        tables = tomllib.loads(text)
    except ValueError as error:
        raise CaseError(path.name if path else "case", [syntax_problem(str(error), text)]) from None
    root = MachineCase if is_machine_case(tables) else Case
    return Draft(path, text, tables, path.resolve().parent if path else Path.cwd(), root)


def _read(path: Path) -> str:
    try:
        return read_text(path)
    except UnicodeDecodeError:
        raise UsageError(f'"{path}" is not a text file in UTF-8') from None
    except OSError as error:
        raise UsageError(f'cannot read "{path}": {error.strerror}') from None

"""Turn pydantic's errors into one clear sentence per mistake."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from typing import Any, get_args

from pydantic import BaseModel, ValidationError

from lambda_core.case.option import Section, quantity_of
from lambda_core.case.signals import SIGNAL_KINDS
from lambda_core.domain.errors import Problem, nearest
from lambda_core.domain.option_tree import is_tag, model_at, option_paths
from lambda_core.domain.printable import printable
from lambda_core.domain.units import from_si, show, units_of

_SLIP = 0.8  # likeness of a name that one slip makes another
_LIMITS = {
    "greater_than": ("gt", "must be greater than"),
    "greater_than_equal": ("ge", "must be at least"),
    "less_than": ("lt", "must be less than"),
    "less_than_equal": ("le", "must be at most"),
}
_EXPECTED = {
    "string_type": "text in quotes",
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number without a unit",
    "float_parsing": "a number without a unit",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "list_type": "a list in brackets",
    "dict_type": "a table",
    "model_type": "a table",
    "model_attributes_type": "a table",
    "tuple_type": "a pair in brackets",
    "finite_number": "a finite number",
}


def problems(error: ValidationError, model: type[BaseModel], data: Any, prefix: str = "") -> list[Problem]:
    """Turn a failed validation into one sentence for every mistake.

    Parameters
    ----------
    error : pydantic.ValidationError
        From validating `data` with `model`.
    data : object
        What stands in the file, as plain tables.
    prefix : str
        Path of `data` within the whole file.
    """
    found: dict[str, Problem] = {}
    for told in error.errors(include_url=False):
        location = _option(told["loc"], model)
        item, path = {**told, "loc": location}, _path(location)
        where = ".".join(str(part) for part in ([prefix] if prefix else []) + path)
        sentence = printable(_message(item, path, model, data)).replace("\n", "\\n")  # one line, whatever was written
        found.setdefault(where, Problem(where, sentence))
    return list(found.values())


def _option(location: Sequence[int | str], model: type[BaseModel]) -> Sequence[int | str]:
    """Return an option's place, without the branch of its type.

    Pydantic puts it behind the option: ``profile.str``.
    """
    *keys, last = location or [""]
    table = model_at(model, keys[:-1]) if keys else None
    is_branch = last == "str" or str(last).startswith("literal[")
    return keys if is_branch and table is not None and keys[-1] in table.model_fields else location


def _path(location: Sequence[int | str]) -> list[int | str]:
    """Drop union tags from pydantic's location.

    They are no keys of the file.
    """
    return [part for part in location if not is_tag(part)]


def _parent(location: Sequence[int | str], model: type[BaseModel]) -> type[BaseModel] | None:
    """Return the table of a location's last key.

    Its tags say which of several it is.
    """
    keys = list(location)
    while keys and is_tag(keys[-1]):
        keys.pop()
    return model_at(model, keys[:-1])


def _written(data: Any, path: Sequence[int | str]) -> Any:
    """Return the value at a path of plain tables.

    None where there is none.
    """
    for key in path:
        if isinstance(data, Mapping):
            data = data.get(key)
        elif isinstance(data, list) and isinstance(key, int) and key < len(data):
            data = data[key]
        else:
            return None
    return data


def _limit(value: float, quantity: str, written: Any) -> str:
    """Write a limit in the unit of the value.

    It is in the first unit of its quantity where the value has none.
    """
    known = list(units_of(quantity))
    ends = [unit for unit in known if isinstance(written, str) and written.rstrip().endswith(unit)]
    unit = max(ends, key=len, default=known[0])
    return f"{from_si(value, quantity, unit):.6g} {unit}"


def _message(item: Any, path: list[int | str], model: type[BaseModel], data: Any) -> str:
    kind, value, context = item["type"], item.get("input"), item.get("ctx", {})
    parent, name = _parent(item["loc"], model), str(path[-1]) if path else ""
    if kind == "extra_forbidden":
        return _unknown_key(name, parent, model)
    if kind == "missing":
        return f"is required{_help(parent, name)}"
    if kind == "value_error":
        return str(context["error"])
    if kind == "union_tag_not_found":
        given = value.get("kind") if isinstance(value, dict) else None
        close = nearest(str(given), SIGNAL_KINDS)
        hint = f"; nearest: {close[0]}" if given and close else ""
        known = ", ".join(f'"{known}"' for known in SIGNAL_KINDS)
        what = f'"{given}" is not a kind of time function' if given else "a time function needs its kind"
        return f"{what}: write kind = one of {known}{hint}"
    if kind == "invalid_key":
        return f"{_quoted(value)} is no name of an option: names are texts"
    if kind == "too_short":
        return f"needs {context['min_length']} at least{_help(parent, name)}"
    if kind == "string_too_short":
        return f"is empty{_help(parent, name)}"
    if kind == "string_too_long":
        return f"has {len(value)} characters, at most {context['max_length']} are allowed{_help(parent, name)}"
    if kind == "literal_error":
        choices = _choices(parent, name)
        close = nearest(str(value), choices)
        hint = f"; nearest: {close[0]}" if close else ""
        return f"{_quoted(value)} is not allowed: write {' or '.join(_quoted(choice) for choice in choices)}{hint}"
    if kind in _LIMITS:
        key, words = _LIMITS[kind]
        quantity = quantity_of(parent, name) if parent else ""
        limit = _limit(float(context[key]), quantity, _written(data, path)) if quantity else f"{context[key]:g}"
        given = show(float(value), quantity) if quantity and isinstance(value, int | float) else value
        return f"{given if isinstance(given, str) else _quoted(given)}: {words} {limit}"
    if kind == "string_pattern_mismatch":
        return f"{_quoted(value)}: use letters, digits, dot, dash and underscore only, the first a letter or digit"
    if kind == "string_type" and isinstance(value, int | float) and not isinstance(value, bool):
        return f'write it in quotes: "{value}"'
    if kind == "string_type" and isinstance(value, Mapping):
        return f'is text in quotes, not a table: write {name} = "{value.get("name", "...")}"{_help(parent, name)}'
    if _EXPECTED.get(kind) == "a table":
        return f"{_quoted(value)} is not a table: write its options in [{'.'.join(map(str, path))}]"
    if kind in _EXPECTED:
        return f"{_quoted(value)} is not {_EXPECTED[kind]}{_help(parent, name)}"
    return str(item["msg"])


def _quoted(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, Mapping):
        return "a table"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _help(parent: type[BaseModel] | None, name: str) -> str:
    info = parent.model_fields.get(name) if parent else None
    return f": {info.description}" if info is not None and info.description else ""


def _choices(parent: type[BaseModel] | None, name: str) -> list[str]:
    info = parent.model_fields.get(name) if parent else None
    if info is None:
        return []
    members = [info.annotation, *get_args(info.annotation)]
    return [str(choice) for member in members for choice in get_args(member) if isinstance(choice, str)]


def _unknown_key(name: str, parent: type[BaseModel] | None, root: type[BaseModel]) -> str:
    """Suggest a name for an unknown option.

    The same name in another table counts more than a similar one here.
    """
    if parent is not None and issubclass(parent, Section) and name in parent.INSTEAD:
        return f"is not an option: {parent.INSTEAD[name]}"
    siblings = list(parent.model_fields) if parent else []
    close = nearest(name, siblings)
    paths = sorted((path for path in option_paths(root) if path.rpartition(".")[2] == name), key=lambda p: p.count("."))
    if elsewhere := paths[:3]:
        here = [sibling for sibling in close if SequenceMatcher(None, sibling, name).ratio() > _SLIP]
        return f"is not an option here; did you mean {' or '.join([*here, *elsewhere])}?"
    if close:
        return f"is not a known option; nearest: {', '.join(close)}"
    return f"is not a known option; here are: {', '.join(siblings)}"

"""Refuse wrong arguments of public functions in one sentence.

The types in a function's signature are what is checked, with pydantic; its docstring says what is allowed.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from functools import cache, wraps
from os import PathLike
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar, cast

from lambda_core.domain.errors import LambdaError, UsageError, name_parameters, nearest
from lambda_core.domain.files import system_refusal
from lambda_core.domain.late_collection import late_collection
from lambda_core.domain.lists import listed
from lambda_core.domain.printable import printable

if TYPE_CHECKING:
    from pydantic import TypeAdapter, ValidationError

P = ParamSpec("P")
R = TypeVar("R")
_CASE = re.compile(r"\b(Case|Source)\b")  # what reads cases says itself what is wrong with them
_SHOWN = 60  # characters of a wrong value
_WORDS = {  # what the type alone does not say
    "finite_number": "a finite number",
    "greater_than": "greater than {gt:g}",
    "greater_than_equal": "at least {ge:g}",
}
_KINDS = {"float": "a number", "int": "a whole number", "str": "a text", "bool": "True or False", "path-like": "a path"}


def public(function: Callable[P, R], home: str) -> Callable[P, R]:
    """Let an API function check its arguments.

    It refuses arguments of other types than its signature has.

    Parameters
    ----------
    function : callable
        With types in its signature and its arguments described as numpydoc wants it.
    home : str
        Module that hands the function out: there other processes find it.
    """

    @wraps(function)
    def called(*args: P.args, **options: P.kwargs) -> R:
        with late_collection():
            given = _bound(function, args, options)
            for name, value in given.arguments.items():
                given.arguments[name] = _checked(function, name, value)
            with _refusals(function.__name__):
                found: Any = function(*given.args, **given.kwargs)
        return cast("R", _guarded(function.__name__, found) if inspect.isgenerator(found) else found)

    called.__module__, called.__qualname__ = home, function.__name__
    return called


@contextmanager
def _refusals(name: str) -> Iterator[None]:
    """Say what the system refuses a function.

    Other errors name its parameters.
    """
    try:
        yield
    except LambdaError as error:
        name_parameters(error)
        raise
    except OSError as error:
        if refusal := system_refusal(error):
            raise UsageError(f"{name}: {refusal}") from error
        raise


def _guarded(name: str, steps: Iterator[Any]) -> Iterator[Any]:
    """Say what the system refuses an iterator."""
    with _refusals(name):
        yield from steps


def _bound(function: Callable[..., Any], args: Any, options: Mapping[str, Any]) -> inspect.BoundArguments:
    """Return the arguments by name.

    UsageError where there are too many, too few or unknown ones.
    """
    form = inspect.signature(function)
    try:
        return form.bind(*args, **options)
    except TypeError as error:
        unknown = [name for name in options if name not in form.parameters]
        close = [near for name in unknown for near in nearest(name, form.parameters, 1)]
        hint = f"; nearest: {', '.join(close)}" if close else ""
        takes = ", ".join(form.parameters) or "no argument"
        raise UsageError(f"{function.__name__}: {error}{hint}; it takes {takes}") from None


def _checked(function: Callable[..., Any], name: str, value: Any) -> Any:
    """Return an argument as its signature expects.

    An iterable becomes a list, a number of numpy one of Python; others stay as they are.
    """
    if isinstance(value, str | PathLike) and "\0" in str(value):
        raise UsageError(f"{function.__name__}: {name} holds a NUL character: no name and no unit has one")
    wanted = _adapter(function, name)
    if wanted is None:
        return value
    from pydantic import ValidationError

    from lambda_core.domain.call_types import plain_number

    value = plain_number(value)
    try:
        found = wanted.validate_python(value, strict=True)
    except ValidationError as error:
        raise UsageError(_sentence(function, name, value, error)) from None
    return found if isinstance(found, list) else value


def _sentence(function: Callable[..., Any], name: str, value: Any, error: ValidationError) -> str:
    """Explain which argument is wrong.

    The text has the allowed values; UsageError about a text in place of a list.
    """
    fault = min(error.errors(include_url=False), key=lambda each: each["type"] not in _WORDS)
    if fault["type"] == "list_type":
        listed(fault["input"], f"{function.__name__}: {'.'.join(map(str, (name, *fault['loc'])))}")
    limit = _WORDS.get(fault["type"], "").format(**fault.get("ctx", {}))
    kind, meaning = _described(function, name)
    written = printable(repr(value))
    shown = written if len(written) <= _SHOWN else f"{written[:_SHOWN]}..."
    kind = " or ".join(_KINDS.get(part, part) for part in kind.split(" or "))
    parts = (limit,) if (kind, limit) == ("a number", _WORDS["finite_number"]) else (kind, limit)
    allowed = ", ".join(part for part in parts if part)
    sentence = f"{function.__name__}: {name} = {shown} is not allowed: give {allowed}"
    return f"{sentence}. {meaning}" if meaning else sentence


@cache
def _adapter(function: Callable[..., Any], name: str) -> TypeAdapter[Any] | None:
    """Return what checks an argument; None where everything goes."""
    from lambda_core.domain.call_types import adapter

    plain = inspect.unwrap(function)
    text = plain.__annotations__.get(name)
    if text is None or name == "overrides" or (name == "source" and _CASE.search(text)):
        return None
    return adapter(text, sys.modules[plain.__module__])


def _described(function: Callable[..., Any], name: str) -> tuple[str, str]:
    """Return type and meaning of an argument.

    They come from the docstring.
    """
    text = inspect.getdoc(function) or ""
    block = text.partition("\nParameters\n----------\n")[2].partition("\n\n")[0]
    for names, kind, body in re.findall(r"^(\w[\w, ]*?)(?: : (.*))?\n((?:[ ]{4}.*(?:\n|$))*)", block, re.MULTILINE):
        if name in names.split(", "):
            meaning = re.split(r"(?<=[.])\s", " ".join(body.split()))[0]
            return kind.removesuffix(", optional"), meaning
    return str(inspect.unwrap(function).__annotations__[name]), ""

"""Make types in public signatures into checks of arguments.

Numbers of a range have a name here.
"""

from __future__ import annotations

import builtins
import inspect
import re
import sys
from collections.abc import Iterable, Mapping
from importlib import import_module
from os import PathLike
from pathlib import Path
from types import ModuleType
from typing import Annotated, Any

from pydantic import AfterValidator, BeforeValidator, ConfigDict, Field, TypeAdapter

Positive = Annotated[float, Field(gt=0.0)]
Count = Annotated[int, Field(ge=1)]


def adapter(text: str, module: ModuleType) -> TypeAdapter[Any] | None:
    """Return a checker of a type's values.

    The type is written in a module; None where every value is allowed.
    """
    kind = eval(text, {}, _Names(module))
    config = ConfigDict(arbitrary_types_allowed=True, allow_inf_nan=False)
    return None if kind is Any else TypeAdapter(kind, config=config)


def plain_number(value: Any) -> Any:
    """Return a number of numpy as one of Python.

    Anything else stays as it is.
    """
    numpy = sys.modules.get("numpy")
    return value.item() if numpy is not None and isinstance(value, numpy.generic) else value


class _Listed:
    """Replacement of ``Sequence`` and ``Iterable``.

    It turns any iterable into a list, but no text and no table.
    """

    def __class_getitem__(cls, item: Any) -> Any:
        return Annotated[list[item], BeforeValidator(_listed)]


class _PathLike:
    """Replacement of ``os.PathLike``.

    It leaves any object of that protocol as it is.
    """

    def __class_getitem__(cls, item: Any) -> Any:
        return _instances(PathLike)


def _instances(cls: type) -> Any:
    """Return the type of a class's objects.

    Pydantic alone would make an object of a table, too.
    """

    def checked(value: Any) -> Any:
        if not isinstance(value, cls):
            raise ValueError
        return value

    return Annotated[Any, AfterValidator(checked)]


def _listed(value: Any) -> Any:
    """Return a list of any iterable.

    A text, a table and any other value stay, and are refused.
    """
    if isinstance(value, str | bytes | Mapping) or not isinstance(value, Iterable):
        return value
    return [plain_number(item) for item in value]


class _Names(dict[str, Any]):
    """Names in the signatures of a module.

    They include those that only type checkers import.
    """

    def __init__(self, module: ModuleType) -> None:
        super().__init__(vars(builtins) | globals() | vars(module))
        self |= {"Path": Path, "PathLike": _PathLike, "Sequence": _Listed, "Iterable": _Listed}
        self._source = inspect.getsource(module)

    def __getitem__(self, name: str) -> Any:
        found = self._value(name)
        if getattr(found, "_is_protocol", False) and not getattr(found, "_is_runtime_protocol", False):
            return Any  # Python cannot tell
        is_ours = isinstance(found, type) and found.__module__.startswith("lambda_") and found.__module__ != __name__
        return _instances(found) if is_ours else found

    def _value(self, name: str) -> Any:
        if name in self:
            return super().__getitem__(name)
        for module, names in re.findall(r"^    from (\S+) import (\([^)]*\)|.*)", self._source, re.MULTILINE):
            if name in re.findall(r"\w+", names):
                return getattr(import_module(module), name)
        raise NameError(name)

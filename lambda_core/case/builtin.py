"""Find the built-in cases of this and other packages.

A package names the package of its case files under the entry-point group ``lambda_bearing.cases``.
"""

from __future__ import annotations

import logging
import tomllib
from functools import lru_cache
from importlib import resources
from importlib.resources.abc import Traversable
from typing import Any

from lambda_core.domain.errors import UsageError, nearest
from lambda_core.domain.installed import CASES, installed, switched_off

log = logging.getLogger("lambda_core")


def builtin_cases() -> dict[str, str]:
    """Return the built-in cases with their descriptions.

    The first item of each is its name.
    """
    return {name: _description(file) for name, file in _files(switched_off()).items()}


def is_builtin(name: str) -> bool:
    """Tell whether there is a built-in case of this name."""
    return name in _files(switched_off())


def builtin_text(name: str) -> str:
    """Return the file of a built-in case, comments included."""
    files = _files(switched_off())
    if name not in files:
        close = nearest(name, files) or list(files)
        raise UsageError(f'there is no built-in case "{name}"; there are: {", ".join(close) or "none"}')
    return files[name].read_text(encoding="utf-8")


@lru_cache(maxsize=4)
def _files(off: tuple[str, ...]) -> dict[str, Traversable]:
    """Return the files of the built-in cases.

    They are sorted by name; of two with one name the first package's file counts.
    """
    found: dict[str, Traversable] = {}
    for source in installed(CASES):
        if source.project in off or source.name in off:
            continue
        try:
            package: Any = source.load()
            entries = list(resources.files(package).iterdir())
        except Exception as error:  # a package of anyone's: its cases are missing, the program works
            log.warning("no cases from %s: %s", source.distribution, error)
            continue
        for entry in entries:
            if entry.name.endswith(".toml"):
                found.setdefault(entry.name.removesuffix(".toml"), entry)
    return dict(sorted(found.items()))


def _description(file: Traversable) -> str:
    """Return the description in a case.

    It is empty where the file is no TOML, since opening it reports the error.
    """
    try:
        return str(tomllib.loads(file.read_text(encoding="utf-8")).get("description", ""))
    except ValueError:
        return ""

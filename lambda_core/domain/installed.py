"""List installed packages that extend the program."""

from __future__ import annotations

import ast
import os
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec
from pathlib import Path

PLUGINS = "lambda_bearing.plugins"  # modules with hooks
COMMANDS = "lambda_bearing.commands"  # functions or typer applications
CASES = "lambda_bearing.cases"  # packages of case files
OFF_VARIABLE = "LAMBDA_BEARING_NO_PLUGIN"
ON_VARIABLE = "LAMBDA_BEARING_PLUGINS"  # files of one plugin each, and folders of such
OWN = "lambda-bearing"  # the distribution of the built-in plugins


@dataclass(frozen=True)
class Source:
    """One plugin to load.

    It has its origin and its loader.
    """

    project: str  # name of the distribution
    version: str
    name: str  # of the entry point
    load: Callable[[], object] = field(repr=False, compare=False)
    target: str = ""  # module:attribute

    @property
    def distribution(self) -> str:
        """Name and version, as messages show them."""
        return f"{self.project} {self.version}".rstrip()


def project_of(distribution: str) -> str:
    """Return the name in "name version".

    Names of files may hold blanks.
    """
    return distribution.rpartition(" ")[0] or distribution


def _source(point: EntryPoint) -> Source:
    distribution = point.dist
    if distribution is None:
        return Source(point.module, "", point.name, point.load, point.value)
    return Source(distribution.name, distribution.version, point.name, point.load, point.value)


def installed(group: str) -> list[Source]:
    """Return the installed plugins of `group`.

    The program's own come first; none is imported. To read what all packages declare takes 5 ms: it is read again where
    a folder of packages has changed.
    """
    return list(_found(group, tuple((place, _changed(place)) for place in sys.path)))


@lru_cache(maxsize=8)
def _found(group: str, _: tuple[tuple[str, int], ...]) -> tuple[Source, ...]:
    sources = {(s.project, s.name): s for s in map(_source, entry_points(group=group))}
    return tuple(sorted(sources.values(), key=lambda s: (s.project != OWN, s.project, s.name)))


def _changed(place: str) -> int:
    """Return when a folder has changed last [ns]."""
    try:
        return os.stat(place or ".").st_mtime_ns
    except OSError:
        return 0


def switched_off() -> tuple[str, ...]:
    """Return the names in ``LAMBDA_BEARING_NO_PLUGIN`` (comma separated)."""
    return tuple(name for name in map(str.strip, os.environ.get(OFF_VARIABLE, "").split(",")) if name)


def in_use(group: str) -> list[Source]:
    """Return the active plugins of `group`.

    The keys are names, without what is switched off; of one name the program's own comes first.
    """
    off = set(switched_off())
    found = [source for source in installed(group) if not off & {source.project, source.name}]
    return sorted(found, key=lambda source: (source.name, source.project != OWN, source.project))


def first_line(target: str) -> str:
    """Return the summary of an entry point's module.

    It is the first line of its docstring; nothing is imported.
    """
    top, *rest = target.partition(":")[0].split(".")
    spec = find_spec(top)
    for folder in (spec.submodule_search_locations or ()) if spec is not None else ():
        file = Path(folder).joinpath(*rest).with_suffix(".py")
        if rest and file.is_file():
            return (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").partition("\n")[0]
    return ""

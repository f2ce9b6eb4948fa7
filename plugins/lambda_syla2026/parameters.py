"""Read the blind and the anchored parameter set."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from lambda_core.domain.written_values import scale_of

if TYPE_CHECKING:
    from lambda_core.studies.design import Plan

FILE = "blind.toml"
ANCHORED_FILE = "anchored.toml"


@dataclass(frozen=True)
class Entry:
    """One value of the set.

    Attributes
    ----------
    path, value : str
        Option of the case, and its value as written in a case file.
    source : str
        Where value and range come from.
    range : tuple of str
        Lowest and highest published value; empty where nothing is varied.
    spacing : str
        "linear", or "log" where the range spans nearly a decade.
    alternatives : tuple of str
        Published laws that are sampled equally often.
    sampled : bool
        Whether the range is published and the band samples it.
    cage : bool
        Felt by the cage only, so by no quasi-static solution.
    """

    path: str
    value: str
    source: str
    range: tuple[str, ...] = ()
    spacing: str = "linear"
    alternatives: tuple[str, ...] = ()
    sampled: bool = True
    cage: bool = False

    @property
    def label(self) -> str:
        """Words for people."""
        return self.path.removeprefix("parameters.").removeprefix("models.").replace("_", " ").replace(".", ": ", 1)

    @property
    def ends(self) -> tuple[str, ...]:
        """Values at which the sensitivity is computed.

        The ends of the range, or the other laws.
        """
        return self.range or tuple(name for name in self.alternatives if name != self.value)


@cache
def blind_set() -> tuple[Entry, ...]:
    """Return the entries of the parameter file."""
    data = tomllib.loads(files(__package__).joinpath(FILE).read_text(encoding="utf-8"))
    return tuple(_entry(**table) for table in data["entry"])


def _entry(
    *, range: Sequence[str] = (), alternatives: Sequence[str] = (), path: str, value: str, source: str, **rest: Any
) -> Entry:
    return Entry(path, value, source, tuple(range), alternatives=tuple(alternatives), **rest)


def laws(replaced: Mapping[str, str | None] | None = None) -> tuple[str, ...]:
    """Return the general laws and constants of the set.

    They suit any bearing: the 6319, its oil, its cage and its bath are left out.
    """
    return tuple(
        change
        for change in changes(replaced)
        if change.startswith(("models.", "parameters.", "surface."))
        and not any(role in change for role in ("rheology", "cage_contact"))
    )


@cache
def anchored_set() -> tuple[tuple[str, str | None, str], ...]:
    """Return path, value and source of the anchored set.

    They are the entries that differ from the blind set; None removes an entry.
    """
    data = tomllib.loads(files(__package__).joinpath(ANCHORED_FILE).read_text(encoding="utf-8"))
    return tuple((table["path"], table.get("value"), table["source"]) for table in data["entry"])


def anchored() -> dict[str, str | None]:
    """Return the anchored set as replacements in the blind one."""
    return {path: value for path, value, _ in anchored_set()}


def entry(path: str) -> Entry:
    """Return one entry by its path."""
    return next(entry for entry in blind_set() if entry.path == path)


def changes(replaced: Mapping[str, str | None] | None = None) -> tuple[str, ...]:
    """Return the set as ``path=value`` texts.

    The arguments replace some values; None leaves an entry out.
    """
    values: dict[str, str | None] = {entry.path: entry.value for entry in blind_set()}
    values.update(replaced or {})
    return tuple(f"{path}={value}" for path, value in values.items() if value is not None)


def with_law(role: str, name: str) -> dict[str, str | None]:
    """Return the replacements that choose another law.

    Parameters of the blind one do not belong to it.
    """
    own = (entry.path for entry in blind_set() if entry.path.startswith(f"parameters.{role}."))
    return {**dict.fromkeys(own), f"models.{role}": name}


def samples(count: int, seed: int = 1) -> list[dict[str, str | None]]:
    """Return Latin hypercube samples of every published range.

    They are replacements of values (McKay, Beckman and Conover 1979).
    """
    points = _plan(count, seed).points()
    return [{path: value for path, _, value in (c.partition("=") for c in point.changes)} for point in points]


def _plan(count: int, seed: int) -> Plan:
    from lambda_core.studies.definition import validate_study
    from lambda_core.studies.design import Plan

    parameters = [
        {"path": e.path, "values": list(e.alternatives)}
        if e.alternatives
        else {"path": e.path, "range": _numbers(e.range), "spacing": e.spacing}
        for e in blind_set()
        if e.sampled and e.ends
    ]
    design = {"kind": "latin-hypercube", "samples": count, "seed": seed}
    return Plan(validate_study({"name": "band", "case": "6319", "parameters": parameters, "design": design}))


def _numbers(ends: tuple[str, ...]) -> list[str | float]:
    """Return the ends of a range for a study.

    They are unit strings or plain numbers.
    """
    return list(ends) if scale_of(ends) is not None else [float(end) for end in ends]

"""What is right and wrong with a draft, and on which node each mistake belongs."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.api import Case
from lambda_core.domain.errors import Problem
from lambda_core.domain.option_tree import model_at
from lambda_gui.outline import Keys, Node

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, Catalogue, ValueReport


@dataclass(frozen=True)
class Check:
    """The outcome of checking a draft: mistakes, or the resolved model and its values for people."""

    problems: tuple[Problem, ...] = ()
    model: BearingModel | None = None
    values: tuple[ValueReport, ...] = ()
    warnings: tuple[str, ...] = ()  # where a valid case leaves what bearing, oil and laws are made for


class Checker:
    """Checks drafts against one open catalogue: opening it takes as long as a check."""

    def __init__(self) -> None:
        self._catalogue: Catalogue | None = None
        self._turn = threading.Lock()

    def check(self, tables: Mapping[str, Any], folder: Path | None) -> Check:
        """Check tables as they would stand in a file; heavy parts are imported at the first call."""
        from lambda_core import api
        from lambda_core.api import operating_warnings, value_reports

        try:
            with self._turn:
                if self._catalogue is None:
                    self._catalogue = api.catalogue()
                model = api.check(_with_needed(tables), folder=folder, catalogue=self._catalogue)
        except api.CaseError as error:
            return Check(tuple(sorted(error.problems, key=_order)))
        except api.LambdaError as error:  # a broken catalogue or plugin: nothing can be checked
            return Check((Problem("", str(error)),))
        return Check((), model, tuple(value_reports(model)), tuple(operating_warnings(model)))

    def close(self) -> None:
        """Release the catalogue; the next check opens it anew, with what has been added meanwhile."""
        with self._turn:
            if self._catalogue is not None:
                self._catalogue.close()
                self._catalogue = None


def plugin_faults() -> list[str]:
    """Return a sentence for each plugin that is broken; one that was switched off on purpose is none."""
    from lambda_core.api import registry

    return [f"{fault.distribution}: {fault.message}" for fault in registry().faults if fault.is_broken]


def _order(problem: Problem) -> int:
    """Return the place of a problem's table in the case, so that mistakes come in the order of the tree."""
    names = list(Case.model_fields)
    first = problem.where.partition(".")[0]
    return names.index(first) if first in names else len(names)


def _with_needed(tables: Mapping[str, Any]) -> dict[str, Any]:
    """Return a copy with an empty table where a required one is missing: the mistakes are then about its options."""
    needed = (name for name, info in Case.model_fields.items() if info.is_required() and model_at(Case, (name,)))
    return {**{name: {} for name in needed}, **deepcopy(dict(tables))}


def belongs(problem: Problem, place: Keys) -> bool:
    """Tell whether a problem is about the option at a place, or about a part of it."""
    return f"{problem.where}.".startswith(f"{'.'.join(place)}.")


def node_of(problem: Problem, nodes: Iterable[Node]) -> Node | None:
    """Return the node with the option that a problem is about; the closest one when it has none of its own."""
    best: tuple[int, Node] | None = None
    near: Node | None = None
    beside: Node | None = None
    table = problem.where.rpartition(".")[0]
    for node in nodes:
        for place in node.places:
            if belongs(problem, place) and (best is None or len(place) > best[0]):
                best = (len(place), node)
            if near is None and ".".join(place).startswith(f"{problem.where}."):
                near = node
            if beside is None and ".".join(place[:-1]) == table:
                beside = node
    return best[1] if best else near or beside


def by_place(problems: Iterable[Problem], places: Sequence[Keys]) -> list[list[str]]:
    """Return the sentences about each of several options.

    Each problem stands once: at the innermost of the places that it is about, and one about the whole table of the
    first place at that one.
    """
    found: list[list[str]] = [[] for _ in places]
    for problem in problems:
        owners = [number for number, place in enumerate(places) if belongs(problem, place)]
        if owners:
            found[max(owners, key=lambda number: len(places[number]))].append(problem.message)
        elif places and problem.where == ".".join(places[0][:-1]):
            found[0].append(problem.message)
    return found

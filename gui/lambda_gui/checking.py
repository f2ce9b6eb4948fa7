"""Check a draft and assign each error to a node."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast, get_origin

from pydantic import BaseModel

from lambda_core.domain.errors import Problem
from lambda_core.domain.option_tree import model_at
from lambda_gui.nodes import Keys, Node

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, Catalogue, MachineModel, ValueReport


@dataclass(frozen=True)
class Check:
    """Outcome of a draft's check.

    It has mistakes, or the resolved model and its values.
    """

    problems: tuple[Problem, ...] = ()
    model: BearingModel | MachineModel | None = None
    values: tuple[ValueReport, ...] = ()
    warnings: tuple[str, ...] = ()  # where a valid case leaves the limits of bearing, oil and laws

    @property
    def alone(self) -> BearingModel | None:
        """The bearing, where the case has one without a shaft."""
        return None if hasattr(self.model, "bearings") else self.model

    @property
    def machine(self) -> MachineModel | None:
        """The machine, where the case has a shaft."""
        return None if self.alone is not None else cast("MachineModel | None", self.model)


class Checker:
    """Checker of drafts with one open catalogue.

    Opening it takes as long as a check.

    Parameters
    ----------
    root : type of BaseModel
        The class of the case.
    """

    def __init__(self, root: type[BaseModel]) -> None:
        self._root = root
        self._catalogue: Catalogue | None = None
        self._turn = threading.Lock()

    def check(self, tables: Mapping[str, Any], folder: Path | None) -> Check:
        """Check tables as in a file.

        Heavy parts are imported at the first call.
        """
        from lambda_core import api

        try:
            with self._turn:
                if self._catalogue is None:
                    self._catalogue = api.catalogue()
                model = api.check(_with_needed(tables, self._root), folder=folder, catalogue=self._catalogue)
                return Check((), model, tuple(api.value_reports(model)), tuple(api.model_warnings(model)))
        except api.CaseError as error:
            return Check(tuple(sorted(error.problems, key=self._order)))
        except api.LambdaError as error:  # a broken catalogue or plugin: nothing can be checked
            return Check((Problem("", str(error)),))

    def _order(self, problem: Problem) -> int:
        """Return a problem's order in the case.

        Mistakes then come in the order of the tree.
        """
        names = list(self._root.model_fields)
        first = problem.where.partition(".")[0]
        return names.index(first) if first in names else len(names)

    def close(self) -> None:
        """Release the catalogue.

        The next check opens it anew, with new rows.
        """
        with self._turn:
            if self._catalogue is not None:
                self._catalogue.close()
                self._catalogue = None


def plugin_faults() -> list[str]:
    """Return a sentence for each broken plugin.

    One that was switched off on purpose is none.
    """
    from lambda_core.api import registry

    return [f"{fault.distribution}: {fault.message}" for fault in registry().faults if fault.is_broken]


def _with_needed(tables: Mapping[str, Any], root: type[BaseModel]) -> dict[str, Any]:
    """Return a copy with all required tables.

    A missing one is empty: the mistakes are then about its options.
    """
    needed = (
        name for name, info in root.model_fields.items()
        if info.is_required() and get_origin(info.annotation) is not dict and model_at(root, (name,))
    )  # fmt: skip
    return {**{name: {} for name in needed}, **deepcopy(dict(tables))}


def belongs(problem: Problem, place: Keys) -> bool:
    """Tell whether a problem concerns a place.

    It is about the option there, or about a part of it.
    """
    return f"{problem.where}.".startswith(f"{'.'.join(place)}.")


def node_of(problem: Problem, nodes: Iterable[Node]) -> Node | None:
    """Return the node of a problem's option.

    The closest one when it has none of its own.
    """
    best: tuple[int, Node] | None = None
    near: Node | None = None
    sibling: Node | None = None
    table = problem.where.rpartition(".")[0]
    for node in nodes:
        for place in node.places:
            if belongs(problem, place) and (best is None or len(place) > best[0]):
                best = (len(place), node)
            if near is None and ".".join(place).startswith(f"{problem.where}."):
                near = node
            if sibling is None and ".".join(place[:-1]) == table:
                sibling = node
    return best[1] if best else near or sibling


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

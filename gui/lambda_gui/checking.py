"""Check a draft and assign each error to a node."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_origin

from pydantic import BaseModel

from lambda_core.api import Case, ShaftCase
from lambda_core.domain.errors import Problem
from lambda_core.domain.option_tree import model_at
from lambda_gui.nodes import Keys, Node

if TYPE_CHECKING:
    from lambda_core.api import BearingModel, Catalogue, MachineModel, ValueReport


@dataclass(frozen=True)
class Check:
    """The outcome of checking a draft: mistakes, or the resolved model and its values for people."""

    problems: tuple[Problem, ...] = ()
    model: BearingModel | None = None
    shaft: MachineModel | None = None  # in place of the model, of a shaft in several bearings
    values: tuple[ValueReport, ...] = ()
    warnings: tuple[str, ...] = ()  # where a valid case leaves what bearing, oil and laws are made for

    @property
    def resolved(self) -> BearingModel | MachineModel | None:
        """What the case is, resolved."""
        return self.model or self.shaft


class Checker:
    """Checks drafts of one bearing against one open catalogue: opening it takes as long as a check."""

    root: type[BaseModel] = Case

    def __init__(self) -> None:
        self._catalogue: Catalogue | None = None
        self._turn = threading.Lock()

    def check(self, tables: Mapping[str, Any], folder: Path | None) -> Check:
        """Check tables as they would stand in a file; heavy parts are imported at the first call."""
        from lambda_core import api

        try:
            with self._turn:
                if self._catalogue is None:
                    self._catalogue = api.catalogue()
                return self._resolved(_with_needed(tables, self.root), folder, self._catalogue)
        except api.CaseError as error:
            return Check(tuple(sorted(error.problems, key=self._order)))
        except api.LambdaError as error:  # a broken catalogue or plugin: nothing can be checked
            return Check((Problem("", str(error)),))

    def _resolved(self, tables: Mapping[str, Any], folder: Path | None, catalogue: Catalogue) -> Check:
        """Return the check of a case without mistakes; LambdaError where there are any."""
        from lambda_core import api
        from lambda_core.api import operating_warnings, value_reports

        model = api.check(tables, folder=folder, catalogue=catalogue)
        assert isinstance(model, api.BearingModel)
        return Check((), model, None, tuple(value_reports(model)), tuple(operating_warnings(model)))

    def _order(self, problem: Problem) -> int:
        """Return the place of a problem's table in the case, so that mistakes come in the order of the tree."""
        names = list(self.root.model_fields)
        first = problem.where.partition(".")[0]
        return names.index(first) if first in names else len(names)

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


class ShaftChecker(Checker):
    """Checks drafts of a shaft in several bearings."""

    root = ShaftCase

    def _resolved(self, tables: Mapping[str, Any], folder: Path | None, catalogue: Catalogue) -> Check:
        """Return the check of a shaft without mistakes, with what every bearing takes from the catalogue."""
        from lambda_core import api
        from lambda_core.api import value_reports

        shaft = api.check_shaft(tables, folder=folder, catalogue=catalogue)
        values = []
        for number, bearing in enumerate(shaft.bearings):
            own = f"bearings.{bearing.name}."
            values += [
                value.model_copy(update={"path": own + value.path.removeprefix("bearing.")})
                if value.path.startswith("bearing.") else value
                for value in value_reports(bearing.model) if number == 0 or value.path.startswith("bearing.")
            ]  # fmt: skip
        return Check((), None, shaft, tuple(values), tuple(api.machine_warnings(shaft)))


def _with_needed(tables: Mapping[str, Any], root: type[BaseModel]) -> dict[str, Any]:
    """Return a copy with an empty table where a required one is missing: the mistakes are then about its options."""
    needed = (
        name for name, info in root.model_fields.items()
        if info.is_required() and get_origin(info.annotation) is not dict and model_at(root, (name,))
    )  # fmt: skip
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

"""The case: one bearing, how it is held, loaded, lubricated and modelled, in the engineer's language."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Self

from pydantic import PrivateAttr, model_validator

from lambda_core.case.elastic import Elastic
from lambda_core.case.electric import Electric
from lambda_core.case.fitted import FitOrigin
from lambda_core.case.modelling import Depth, Forces, Models, Output, Parameters, Solver
from lambda_core.case.motion import BetweenBodies, Bodies, Gravity, Loads, Marker, Operation
from lambda_core.case.option import NAME_PATTERN, Section, option
from lambda_core.case.parts import Bearing, Lubricant, Materials, Surface
from lambda_core.case.requirements import Life, Requirements
from lambda_core.case.thermal import Thermal
from lambda_core.domain.handed_laws import packed, unpack


class Written(Section):
    """What the case of one bearing and that of a machine have in common: a name, a folder, and how they change."""

    name: str = option(description="short name, used for files", pattern=NAME_PATTERN)
    description: str = option("", "what this case is, for people")
    assumptions: list[str] = option([], "what the author of the case assumed, repeated with every result")
    _folder: Path | None = PrivateAttr(default=None)

    @model_validator(mode="after")
    def _remember_folder(self, info: Any) -> Self:
        self._folder = (info.context or {}).get("folder")
        return self

    @property
    def folder(self) -> Path | None:
        """Folder that file names in the case are relative to; None is the working directory."""
        return self._folder

    def __eq__(self, other: object) -> bool:
        return isinstance(other, type(self)) and self.model_dump() == other.model_dump()

    __hash__ = None  # type: ignore[assignment]

    def __getstate__(self) -> dict[Any, Any]:
        """Return what is pickled: with the laws that were handed over as objects, which no other process knows."""
        return {**super().__getstate__(), "handed": packed()}

    def __setstate__(self, state: dict[Any, Any]) -> None:
        """Take what was pickled."""
        unpack(state.pop("handed", b""))
        super().__setstate__(state)

    def __dir__(self) -> list[str]:
        """Return the names that a notebook completes: sections, and what a case can do."""
        return sorted({*type(self).model_fields, "folder", "written", "with_"})

    def written(self) -> dict[str, Any]:
        """Return what stands in the case's file: plain tables with unit strings, no defaults."""
        return self.model_dump(mode="json", exclude_unset=True, exclude_none=True)

    def with_(self, **changes: Any) -> Self:
        """Return a copy with `changes` merged in, section by section.

        Examples
        --------
        ``case.with_(operation={"speed": "2750 rpm"}, bearing={"clearance": "C3"})``; None
        takes an option back to its default. A law may stand as the function itself: ``case.with_(models={"traction":
        law})``, with ``@law(...)`` above it.

        Raises
        ------
        CaseError
            With every problem of the changed case.
        """
        from lambda_core.case.case_io import validate

        return validate(type(self), merged(self.written(), changes), self.name, self._folder)


class Case(Written):
    """What the case file of one bearing says; values in SI, written as unit strings.

    Build one with :func:`lambda_core.case.case_io.read_case`; change one with :meth:`with_`. Every field is declared
    once, with help and limits.
    """

    bearing: Bearing = option(description="the bearing")
    materials: Materials = option({}, "materials of the parts")
    lubricant: Lubricant = option(description="the oil")
    surface: Surface = option({}, "surfaces")
    loads: Loads = option({}, "external loads")
    operation: Operation = option(description="what drives the bearing")
    bodies: Bodies = option({}, "masses and boundary conditions")
    life: Life = option({}, "what modified rating lives need")
    requirements: Requirements = option({}, "what the bearing has to reach")
    thermal: Thermal = option({}, "thermal network of the bearing and its surroundings")
    markers: dict[str, Marker] = option({}, "named points whose motion is written")
    models: Models = option({}, "model by role")
    parameters: Parameters = option({}, "parameters by role, for every force element with that role")
    forces: Forces = option({}, "models and parameters of single force elements")
    elements: dict[str, BetweenBodies] = option({}, "additional force elements between bodies")
    elastic: Elastic = option({}, "parts of the bearing that bend")
    gravity: Gravity = option({}, "acceleration of gravity")
    depth: Depth = option({}, "modelling depth")
    solver: Solver = option({}, "integrator and averages")
    output: Output = option({}, "what is written")
    electric: Electric | None = option(None, "the bearing in the circuit of an electric machine")
    observers: Parameters = option({}, "channels that plugins add to the result: a table per observer, its parameters")
    events: Parameters = option(
        {}, "what plugins look out for: a table per event, action stop (default) or record, and its parameters"
    )
    fit: FitOrigin | None = option(None, "where fitted values come from; written by the command fit")


def merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Merge tables key by key; None removes a key, a table with a ``kind`` replaces completely."""
    result = dict(base)
    for key, value in changes.items():
        old = result.get(key)
        if value is None:
            result.pop(key, None)
        elif isinstance(value, Mapping) and isinstance(old, Mapping) and "kind" not in value:
            result[key] = merged(old, value)
        elif isinstance(value, Mapping):
            result[key] = merged({}, value)
        else:
            result[key] = value
    return result

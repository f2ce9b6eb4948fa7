"""Let answers remember their question.

They can answer it for a changed case, as tables with units, and as a picture.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from functools import partial, wraps
from inspect import signature
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec, Self, TypeVar

import numpy as np
from pydantic import PrivateAttr

from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed
from lambda_core.results.quantity import quantities
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.case.case_io import Tables

P = ParamSpec("P")
R = TypeVar("R")
_RESULT = ".h5"


class Answer(Record):
    """Base of answers about a case.

    They answer the same question for a changed case.
    """

    _again: Callable[[Mapping[str, Any]], Any] | None = PrivateAttr(default=None)

    def with_(self, **changes: Any) -> Self:
        """Answer the same question for a changed case.

        The changes are given section by section.

        Returns
        -------
        same class
            Of the changed case.

        Raises
        ------
        UsageError
            For an answer that was read from data, or is about a run.
        CaseError, SolverError
            As the question.

        Examples
        --------
        ``found.with_(gears={"wheel": {"power": "20 kW"}}).system_life_h``
        """
        if self._again is None:
            name = type(self).__name__
            raise UsageError(f"this {name} has no case: `with_` needs an answer about a case, not about a run")
        found: Self = self._again(changes)
        return found


def answers(question: Callable[P, R]) -> Callable[P, R]:
    """Let answers remember question and case.

    The case is the question's first argument, changed by `overrides`.
    """
    form = signature(question)
    first = next(iter(form.parameters))

    @wraps(question)
    def asked(*args: P.args, **options: P.kwargs) -> R:
        given = form.bind(*args, **options)
        changes = given.arguments["overrides"] = listed(given.arguments.get("overrides", ()), "overrides")
        found = question(*given.args, **given.kwargs)
        if isinstance(found, Answer) and (case := _case_of(given.arguments[first], changes)) is not None:
            left = (first, "overrides", "announce")  # a callback for progress cannot go to another process
            rest = {name: value for name, value in given.arguments.items() if name not in left}
            found._again = partial(_ask_again, asked, first, case, rest)
        return found

    return asked


def _case_of(source: Any, overrides: Sequence[str]) -> Tables | None:
    """Return the present content of a case.

    None where the question was about a run.
    """
    from lambda_core.case.case_io import Tables, read_tables, toml_tables  # `show` starts without cases

    toml = getattr(source, "case_toml", None)
    if toml is not None:  # a resolved model
        return Tables(toml_tables(toml, source.name), source.name, getattr(source, "folder", None))
    if isinstance(source, str | PathLike) and Path(source).suffix == _RESULT:
        return None
    tables = read_tables(source)
    return Tables(deepcopy(tables.data), tables.name, tables.folder).changed(overrides)


def _ask_again(
    question: Callable[..., Any], first: str, case: Tables, rest: Mapping[str, Any], changes: Mapping[str, Any]
) -> Any:
    """Ask about the changed case."""
    from lambda_core.case.written import merged, validate

    return question(**{first: validate(case.root, merged(case.data, changes), case.name, case.folder), **rest})


def drawn(model: Any, equilibrium: Any, modes: Any, name: str, options: Mapping[str, Any]) -> Any:
    """Return a view as a matplotlib figure.

    It shows a machine or a bearing at its operating point.

    Raises
    ------
    UsageError
        For a view or an option that does not exist.
    NotApplicable
        When there is nothing to show; the sentence says why.
    """
    from lambda_core.discovery.api import data_of, registry, view_of
    from lambda_core.views.view import MachineData

    view = view_of(registry(), name, "machine")
    return registry().figure(view, data_of(view, MachineData(model, equilibrium, modes), options))


def dataset(data: Mapping[str, Any], labels: Mapping[str, Any], facts: Mapping[str, Any]) -> Any:
    """Return an xarray.Dataset; UsageError when xarray is not installed."""
    try:
        import xarray
    except ImportError:
        raise UsageError('xarray comes with the extra "data": pip install "lambda-bearing[data]"') from None
    return xarray.Dataset(data, labels, facts)


def declared_numbers(records: Mapping[str, Record], dim: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return declared numbers as variables with labels.

    They belong to records of one class, along a dimension of their names.

    Vectors have a dimension named after their axes; lists of a smallest and a largest value are left out.
    """
    data: dict[str, Any] = {}
    labels: dict[str, Any] = {dim: list(records)}
    for name, one in quantities(type(next(iter(records.values())))).items():
        if one.is_list and not one.axes:
            continue
        values = [getattr(record, name) for record in records.values()]
        axes = "".join(one.axes)
        if axes:
            labels[axes] = list(one.axes)
            values = [value or [np.nan] * len(axes) for value in values]
        data[name] = ((dim, axes) if axes else (dim,), np.array(values, dtype=float),
                      {"units": one.unit, "long_name": one.label})  # fmt: skip
    return data, labels

"""Define views of plugins.

A view turns a run, several runs or a study into data with units (:class:`~lambda_core.views.chart.ViewData`).
Everything that people look at is drawn from that data: figures of the command line and of reports, plots of
the terminal. A view may bring a drawing of its own; otherwise the house draws it (hook ``lambda_figure``).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any, Literal, Protocol, get_args

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict

from lambda_core.domain.channels import Channel
from lambda_core.views.chart import ViewData

VIEW_API = 1
Subject = Literal["result", "results", "study", "machine"]


class RunData(Protocol):
    """Data of a run for a view.

    See :class:`lambda_core.results.reader.Result`.
    """

    path: Path
    title: str
    headline: str
    case: str

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels over time with those of observers.

        They have names, dimensions, units and meanings.
        """

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return one channel, first axis time, SI."""

    def blocks(self, names: Sequence[str], start: float = 0.0) -> Iterator[dict[str, NDArray[np.float64]]]:
        """Yield several channels in blocks of rows.

        They begin at time `start` [s].
        """

    def sample(self, row: int, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
        """Return several channels at one instant."""

    def integrals(self) -> NDArray[np.float64]:
        """Return the running integrals, shape (records, columns)."""

    def revolutions(self) -> NDArray[np.float64]:
        """Return the running integrals at whole cage revolutions."""

    def summary(self) -> Any:
        """Return the averages and the end state."""

    @property
    def model(self) -> dict[str, Any]:
        """The resolved model as plain data, SI."""

    @property
    def case_toml(self) -> str:
        """The case, complete."""

    @property
    def kernel_keys(self) -> dict[str, str]:
        """Hash of the code behind every law."""


@dataclass(frozen=True)
class MachineData:
    """Data of a machine for a view.

    The machine is at its operating point.

    Attributes
    ----------
    model : MachineModel
        The resolved machine.
    equilibrium : MachineEquilibrium or None
        Where it was solved.
    modes : MachineModes or None
        Where they were computed.
    """

    model: Any
    equilibrium: Any = None
    modes: Any = None


class Figure(Protocol):
    """Result of a drawing.

    A matplotlib figure, or anything that can be saved like one.
    """

    def savefig(self, fname: str | Path | IO[bytes], *, format: str, **options: Any) -> None:
        """Write the figure."""


class Options(BaseModel):
    """Base of a view's options.

    Text from the command line is converted, unknown names are an error.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)


@dataclass(frozen=True)
class View:
    """One way to look at results.

    Attributes
    ----------
    name : str
        Short and unique: "load-distribution".
    title : str
        One line for people.
    subject : str
        ``result``: one run; ``results``: two runs or more; ``study``: the table of a study; ``machine``: a machine at
        its operating point, without time.
    data : callable
        ``data(subject, options) -> ViewData``: `subject` is a :class:`RunData`, a sequence of them, a
        :class:`~lambda_core.views.table.StudyTable`, or a :class:`MachineData`. Raises
        :class:`~lambda_core.views.method.NotApplicable` with a sentence when there is nothing to show.
    options : type
        A subclass of :class:`Options` whose fields have defaults and descriptions.
    figure : callable, optional
        ``figure(data) -> Figure``; without it the house's drawing is used.
    reference : str
        Where the definition of what is shown comes from.
    offered : callable, optional
        ``offered(subject) -> bool``: whether reports and lists of every view ask for this one; it can be asked for by
        name at all times.
    view_api : int
        Version of this interface that it is written for, as a number: 1. Without it the view is refused.
    """

    name: str
    title: str
    subject: Subject
    data: Callable[[Any, Any], ViewData] = field(repr=False)
    options: type[Options] = Options
    figure: Callable[[ViewData], Figure] | None = field(default=None, repr=False)
    reference: str = ""
    offered: Callable[[Any], bool] | None = field(default=None, repr=False)
    view_api: int | None = None
    distribution: str = ""  # filled by the registry


def view_fault(item: object) -> str:
    """Say what keeps a view from being registered, or nothing."""
    if not isinstance(item, View):
        return f"lambda_views registers a {type(item).__name__}: wrap the function in View(name, title, subject, data)"
    if item.view_api is None:
        return f"the view {item.name} does not say for which version it is written: write view_api={VIEW_API}"
    if item.view_api != VIEW_API:
        return f"the view {item.name} is written for version {item.view_api} of the interface; this is {VIEW_API}"
    if item.subject not in get_args(Subject):
        return f'the view {item.name} looks at "{item.subject}"; possible: {", ".join(get_args(Subject))}'
    for part in ("data", *(["figure"] if item.figure is not None else [])):
        if not callable(getattr(item, part)):
            return f"the {part} of the view {item.name} is a {type(getattr(item, part)).__name__}, not a function"
    if not (isinstance(item.options, type) and issubclass(item.options, Options)):
        return f"the options of the view {item.name} are not a subclass of Options"
    required = [name for name, info in item.options.model_fields.items() if info.is_required()]
    if required:
        return f"the option {required[0]} of the view {item.name} has no default"
    return ""

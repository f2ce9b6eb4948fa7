"""Read a result file: finished, growing or incomplete."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import CHANNELS, Channel
from lambda_core.domain.errors import BearingNeededError, UsageError, unknown_name
from lambda_core.domain.printable import printable
from lambda_core.model.bearing_model import ResolvedValue
from lambda_core.results import checkpoint
from lambda_core.results import file_format as layout
from lambda_core.results.circuit_rows import CIRCUIT_GROUP, DISCHARGES_GROUP
from lambda_core.results.event_rows import EVENTS_GROUP
from lambda_core.results.integrity import check_machine, check_model
from lambda_core.results.opening import (
    channels_of,
    check_alone,
    integral_table,
    labels_of,
    opened,
    resolved_value,
)
from lambda_core.results.run_status import Status
from lambda_core.results.samples import TIME

if TYPE_CHECKING:
    from lambda_core.results.model_band import ModelBand
    from lambda_core.results.rating import Rating
    from lambda_core.results.summary import Summary

    Rerun = Callable[["Result", Mapping[str, Any], str | Path | None], "Result"]

_TIME = CHANNELS[0]
_BLOCK = 4096  # rows read at a time where a whole channel need not be in memory


class Result:
    """One run, read from its file.

    It stands for its file wherever a path is taken. The file is opened for each access and
    closed again, so a result that is still growing shows what is there now. Fields of the
    summary are attributes: ``result.friction_torque_Nmm``.

    Parameters
    ----------
    path : path-like
        A result file.
    bearing : str, optional
        Look at this bearing of a machine; default: at the only one, or where there are several at the machine, which
        is also what "" stands for.

    Attributes
    ----------
    bearing : str
        Name of the bearing that is looked at; empty where the result is of the whole machine.

    Raises
    ------
    ResultError
        When the file does not exist, is not a result, or is damaged.
    UsageError
        When it has no such bearing.

    Examples
    --------
    >>> result = Result("6319-cp10-1500.h5")  # doctest: +SKIP
    >>> result["load"].shape  # (time, ball, ring), N  # doctest: +SKIP
    (1000, 9, 2)
    >>> result.bearings["left"].plot("film")  # doctest: +SKIP
    """

    def __init__(self, path: str | PathLike[str], bearing: str | None = None) -> None:
        self.path = Path(path)
        with opened(self.path) as file:
            check_alone(file)
            self._read(file, bearing)
            self._family = {self.bearing: self}  # results of this file, which was checked once for all of them
            self.status()

    def _read(self, file: h5py.File, bearing: str | None) -> None:
        words = (printable(str(file.attrs[name])) for name in ("title", "headline", "case", "created"))
        self.title, self.headline, self.case, self.created = words
        self.bearing_names = tuple(map(printable, layout.bearing_names(file)))
        self.is_machine = layout.MACHINE in file
        if bearing is None:
            bearing = self.bearing_names[0] if len(self.bearing_names) == 1 else ""
        elif bearing not in self.bearing_names and (bearing or not self.is_machine):
            raise UsageError(f"{self.path}: {unknown_name('bearing', bearing, self.bearing_names)}")
        self.bearing = bearing
        self._rerun: Rerun | None = None
        self._summary: tuple[Any, Summary] | None = None  # of the file as it was
        group = file[self._place]
        if bearing and len(self.bearing_names) > 1:
            self.title, self.headline = (printable(str(group.attrs[name])) for name in ("title", "headline"))
        found = [(_TIME, {}), *channels_of(group)]
        self._channels = {channel.name: channel for channel, _ in found}
        paths = {dim: path for _, own in found for dim, path in own.items()}
        self._labels = {dim: labels_of(file[path]) for dim, path in paths.items()}

    # -- bearings of a machine --

    @cached_property
    def bearings(self) -> dict[str, Result]:
        """Results of the bearings by name, as of bearings alone."""
        return {name: self._part(name) for name in self.bearing_names}

    def of_machine(self) -> Result:
        """Return the result of the machine without its bearings."""
        return self._part("")

    def _part(self, bearing: str) -> Result:
        if bearing not in self._family:
            made = object.__new__(Result)
            made.path, made._family = self.path, self._family
            with opened(self.path) as file:
                made._read(file, bearing)
            self._family[bearing] = made
        return self._family[bearing]

    def of_bearing(self, name: str | None = None) -> Result:
        """Return the result of one bearing.

        Its `name` may be left out where there is one only; otherwise that is a UsageError, as is an unknown name.
        """
        if name is not None:
            return self._part(name)
        self._chosen()
        return self

    def _chosen(self) -> str:
        """Return the chosen bearing; UsageError where none was chosen."""
        if not self.bearing:
            raise BearingNeededError(
                f"{self.path} has {len(self.bearing_names)} bearings: choose one, {' or '.join(self.bearing_names)} "
                f'(--bearing {self.bearing_names[0]}, in Python result.bearings["{self.bearing_names[0]}"])'
            )
        return self.bearing

    @property
    def _place(self) -> str:
        """Place of the chosen part in the file."""
        return f"{layout.BEARINGS}/{self.bearing}" if self.bearing else layout.MACHINE

    # -- what the run wrote --

    @property
    def channels(self) -> tuple[Channel, ...]:
        """Channels over time: names, dimensions, units, meanings."""
        return tuple(self._channels.values())

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return one channel, first axis time, SI."""
        self._known(name)
        with opened(self.path) as file:
            return np.asarray(self._data(file, name)[: self._status(file).rows.samples])

    def blocks(self, names: Sequence[str], start: float = 0.0) -> Iterator[dict[str, NDArray[np.float64]]]:
        """Yield channels in blocks of rows from `start` [s]."""
        for name in names:
            self._known(name)
        with opened(self.path) as file:
            rows = self._status(file).rows.samples
            first = int(np.searchsorted(file["time"][:rows], start))
            for begin in range(first, rows, _BLOCK):
                stop = min(begin + _BLOCK, rows)
                yield {name: self._data(file, name)[begin:stop] for name in names}

    def sample(self, row: int, names: Sequence[str]) -> dict[str, NDArray[np.float64]]:
        """Return channels at one instant, negative rows from the end."""
        for name in names:
            self._known(name)
        with opened(self.path) as file:
            at = range(self._status(file).rows.samples)[row]
            return {name: np.asarray(self._data(file, name)[at]) for name in names}

    def labels(self, dim: str) -> tuple[int, ...] | tuple[float, ...] | tuple[str, ...]:
        """Return the labels (names, numbers, places [m]) along a dimension."""
        if dim not in self._labels:
            raise UsageError(f"{self.path}: {unknown_name('dimension', dim, self._labels)}")
        return self._labels[dim]

    def status(self) -> Status:
        """Return what the run has reached."""
        with opened(self.path) as file:
            return self._status(file)

    def integrals(self) -> FloatArray:
        """Return the running integrals, shape (records, len(averages.COLUMNS)), SI."""
        with opened(self.path) as file:
            group = file[layout.BEARINGS][self._chosen()][layout.INTEGRALS_GROUP]
            return integral_table(group, self._status(file).rows.records)

    def revolutions(self) -> FloatArray:
        """Return the integrals at whole cage revolutions from start."""
        with opened(self.path) as file:
            group = file[layout.BEARINGS][self._chosen()][layout.REVOLUTIONS_GROUP]
            return integral_table(group, self._status(file).rows.revolutions.get(self.bearing, 0))

    def checkpoint(self) -> checkpoint.Checkpoint | None:
        """Return the newest whole checkpoint, None when there is none."""
        with opened(self.path) as file:
            return checkpoint.latest(slot.tobytes() for slot in file[layout.SLOTS][()])

    def circuit(self) -> dict[str, NDArray[np.float64]]:
        """Return the columns of circuit_rows.CIRCUIT, empty without a circuit."""
        found = self._table(CIRCUIT_GROUP)
        if not self.bearing:
            return found
        number = self.bearing_names.index(self.bearing)
        return {name: values[:, number] if values.ndim > 1 else values for name, values in found.items()}

    def discharges(self) -> dict[str, NDArray[np.float64]]:
        """Return every breakdown as columns in SI, empty without circuit."""
        found = self._table(DISCHARGES_GROUP)
        if not self.bearing or "bearing" not in found:
            return found
        own = found.pop("bearing") == self.bearing_names.index(self.bearing)
        return {name: values[own] for name, values in found.items()}

    def events(self) -> dict[str, NDArray[np.float64]]:
        """Return ``time`` [s] and ``event`` (row of :attr:`watched_events`) of events."""
        return self._table(f"{layout.BEARINGS}/{self._chosen()}/{EVENTS_GROUP}")

    def _table(self, group: str) -> dict[str, NDArray[np.float64]]:
        with opened(self.path) as file:
            if group not in file:
                return {}
            count = layout.rows_of(f"{group}/time", self._status(file).rows)
            return {name: data[:count] for name, data in file[group].items() if layout.grows(data)}

    # -- where it comes from --

    @cached_property
    def model(self) -> dict[str, Any]:
        """Resolved model as plain data, SI."""
        with opened(self.path) as file:
            found: dict[str, Any] = json.loads(printable(str(self._inputs(file)["model_json"].asstr()[()])))
            check_model(found)
        return found

    @cached_property
    def machine(self) -> dict[str, Any]:
        """Machine without bearings as plain SI data; else empty."""
        return self._machine_json("model_json")

    @cached_property
    def machine_numbers(self) -> dict[str, float]:
        """Numbers of a machine's initial equilibrium; else empty."""
        return {name: float(value) for name, value in self._machine_json("numbers_json").items()}

    def _machine_json(self, name: str) -> dict[str, Any]:
        with opened(self.path) as file:
            if layout.MACHINE not in file:
                return {}
            text = str(file[layout.MACHINE][layout.INPUTS_GROUP][name].asstr()[()])
            found: dict[str, Any] = dict(json.loads(printable(text)))
            check_machine(name, found)
        return found

    @cached_property
    def case_toml(self) -> str:
        """The case, complete: it runs again as it stands."""
        with opened(self.path) as file:
            return printable(str(file[layout.INPUTS_GROUP]["case_toml"].asstr()[()]))

    @cached_property
    def values(self) -> tuple[ResolvedValue, ...]:
        """Every resolved value with source and grade."""
        return tuple(resolved_value(row) for row in self._input_table("values"))

    @cached_property
    def laws(self) -> list[dict[str, str]]:
        """Element, role, model, origins and kernel key of every law."""
        return self._input_table("laws")

    @cached_property
    def observers(self) -> list[dict[str, str]]:
        """Name, title, reference, parameters and numbers of every observer."""
        return self._input_table("observers")

    @cached_property
    def watched_events(self) -> list[dict[str, str]]:
        """Name, title, reference, parameters and action of every event."""
        return self._input_table("events")

    @cached_property
    def versions(self) -> dict[str, str]:
        """Versions of the program, Python and the libraries that ran."""
        with opened(self.path) as file:
            rows = layout.read_table(file[layout.INPUTS_GROUP]["versions"])
        return {printable(row["name"]): printable(row["value"]) for row in rows}

    @cached_property
    def kernel_keys(self) -> dict[str, str]:
        """Hashes of all laws' and the core's compiled code."""
        return {row["name"]: row["value"] for row in self._input_table("kernel_keys")}

    @cached_property
    def assumptions(self) -> tuple[str, ...]:
        """Assumptions, one sentence each."""
        return self._lines("assumptions")

    @cached_property
    def rating(self) -> Rating | None:
        """Life, safety and catalogue friction at the start."""
        from lambda_core.results.rating import Rating

        with opened(self.path) as file:
            text = self._inputs(file).get("rating_json")
            return Rating.model_validate_json(text.asstr()[()]) if text is not None else None

    @cached_property
    def model_band(self) -> ModelBand | None:
        """90 % model band at the start, if computed."""
        from lambda_core.results.model_band import ModelBand

        with opened(self.path) as file:
            text = self._inputs(file).get("model_band_json")
            return ModelBand.model_validate_json(text.asstr()[()]) if text is not None else None

    @cached_property
    def case_warnings(self) -> tuple[str, ...]:
        """Exceeded limits of bearing, oil and laws, one sentence each."""
        return self._lines("warnings")

    @cached_property
    def plugins(self) -> tuple[str, ...]:
        """Distribution and version of each plugin that was loaded."""
        with opened(self.path) as file:
            return tuple(printable(line) for line in file[layout.INPUTS_GROUP]["plugins"].asstr()[()])

    # -- for people and for other programs --

    def summary(self) -> Summary:
        """Return the averages and the end state (the machine interface).

        They are computed again when the file has changed.
        """
        from lambda_core.results.summary import summarise

        status, file = self.status(), self.path.stat()
        seen = (status, file.st_ino, file.st_size, file.st_mtime_ns)
        if self._summary is None or self._summary[0] != seen:
            self._summary = (seen, summarise(self))
        return self._summary[1]

    def __getattr__(self, name: str) -> Any:
        from lambda_core.results.summary import field_names

        if name in field_names():
            return getattr(self.summary(), name)
        raise AttributeError(f"a result has no {name}")

    def __dir__(self) -> list[str]:
        """Return methods and summary numbers for a notebook's completion."""
        from lambda_core.results.summary import field_names

        return sorted({*super().__dir__(), *field_names()})

    def __fspath__(self) -> str:
        """Return the file, since a result can replace a path."""
        return str(self.path)

    def __repr__(self) -> str:
        of = f" ({self.bearing})" if self.bearing and len(self.bearing_names) > 1 else ""
        return f"<Result {self.path}{of}: {self.title}, {self.status().state}>"

    def _repr_html_(self) -> str:
        """Return headline and summary as HTML for a notebook."""
        from html import escape

        try:
            text = self.summary().text()
        except UsageError as error:  # a run that has just begun holds no samples
            text = str(error)
        return f"<pre>{escape(self.headline)}\n{escape(text)}</pre>"

    def with_(self, *, out: str | Path | None = None, **changes: Any) -> Result:
        """Run the changed case and return its result.

        `changes` are section by section; the file is `out` or one of a free name.

        ``result.with_(operation={"speed": "2750 rpm"})``; errors as of :func:`lambda_core.api.run`.
        """
        if self._rerun is None:
            raise UsageError(f"{self.path}: open it with lambda_core.api.result to run its changed case")
        return self._rerun(self, changes, out)

    def rerun_by(self, function: Rerun) -> Result:
        """Remember what runs a changed case; returns this object."""
        self._rerun = function
        return self

    def plot(self, name: str, **options: Any) -> Any:
        """Return a view as a matplotlib figure, for a notebook.

        Parameters
        ----------
        name : str
            View (:func:`lambda_core.api.views`), for example ``"load-distribution"``.
        **options
            Options of the view by name.

        Returns
        -------
        matplotlib.figure.Figure
            ``savefig`` writes it.

        Raises
        ------
        UsageError
            For a view or an option that does not exist.
        NotApplicable
            When there is nothing to show; the sentence says why.
        """
        from lambda_core.discovery.api import data_of, registry, view_of

        view = view_of(registry(), name, "result")
        return registry().figure(view, data_of(view, self, options))

    def to_xarray(self) -> Any:
        """Return all channels as an xarray.Dataset.

        It has dimensions, labels, units and meanings; UsageError when xarray is not installed.
        """
        from lambda_core.results.answer import dataset

        with opened(self.path) as file:
            rows = self._status(file).rows.samples
            data = {
                channel.name: (
                    ("time", *channel.dims),
                    self._data(file, channel.name)[:rows],
                    {"units": channel.unit, "long_name": channel.meaning},
                )
                for channel in self.channels
            }
        coords = {"time": data.pop("time"), **{dim: list(labels) for dim, labels in self._labels.items()}}
        return dataset(data, coords, {"title": self.title, "case": self.case, "created": self.created})

    def to_pandas(self, *names: str) -> Any:
        """Return channels (all without names) as a pandas.DataFrame over time.

        A channel with dimensions becomes one column per entry: ``load/1/inner``.
        """
        import pandas

        columns: dict[str, NDArray[np.float64]] = {}
        for name in names or tuple(name for name in self._channels if name != "time"):
            values = self[name]
            dims = self._channels[name].dims
            for index in np.ndindex(values.shape[1:]):
                entry = [str(self.labels(dim)[i]) for dim, i in zip(dims, index, strict=True)]
                columns["/".join([name, *entry])] = values[(slice(None), *index)]
        return pandas.DataFrame(columns, index=pandas.Index(self["time"], name="time"))

    # -- inside --

    def _known(self, name: str) -> None:
        if name not in self._channels:
            if not self.bearing and len(self.bearing_names) > 1:
                with opened(self.path) as file:
                    if name in file[layout.BEARINGS][self.bearing_names[0]]:
                        self._chosen()
            raise UsageError(f"{self.path}: {unknown_name('channel', name, self._channels)}")

    def _data(self, file: h5py.File, name: str) -> h5py.Dataset:
        """Return the dataset of a channel."""
        return file[name] if name == TIME else file[self._place][name]

    def _inputs(self, file: h5py.File) -> h5py.Group:
        """Return where the bearing that is looked at comes from."""
        return file[layout.BEARINGS][self._chosen()][layout.INPUTS_GROUP]

    def _status(self, file: h5py.File) -> Status:
        return Status.from_bytes(bytes(file[layout.STATUS][()]))

    def _lines(self, name: str) -> tuple[str, ...]:
        """Return sentences about what is looked at."""
        with opened(self.path) as file:
            return tuple(printable(line) for line in file[self._place][layout.INPUTS_GROUP][name].asstr()[()])

    def _input_table(self, name: str) -> list[dict[str, str]]:
        with opened(self.path) as file:
            table = self._inputs(file).get(name)  # a case without observers or events has no such table
            rows = layout.read_table(table) if table is not None else []
            if rows and set(rows[0]) != set(layout.TABLES[name]):
                raise ValueError(f"columns of its table {name} are missing")
        return [{key: printable(text) for key, text in row.items()} for row in rows]

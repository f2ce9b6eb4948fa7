"""The layout of a result file: what stands where (the table for people is docs/results.md).

Everything is created before the first sample is written: HDF5 allows no new objects once
a file is written in SWMR mode, the mode that keeps it readable at every moment. Every
dimension is an HDF5 dimension scale, so netCDF readers (xarray with h5netcdf) find names
and labels.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np

from lambda_core.domain.channels import DIMENSIONS, Channel
from lambda_core.domain.printable import printable
from lambda_core.results.averages import INTEGRALS
from lambda_core.results.circuit_rows import CIRCUIT, CIRCUIT_GROUP, DISCHARGES, DISCHARGES_GROUP
from lambda_core.results.event_rows import (
    EVENT_COLUMNS,
    EVENTS,
    EVENTS_GROUP,
    OBSERVER_COLUMNS,
    event_rows,
    observer_rows,
)
from lambda_core.results.objects import attach, describe, scales_along, scales_in, texts_of
from lambda_core.results.run_status import Rows

if TYPE_CHECKING:
    from lambda_core.results.provenance import Provenance
    from lambda_core.system.bearing import BearingModel

LAYOUT = 1
LAYOUT_ATTRIBUTE = "lambda_bearing_layout"
STATUS = "status"
STATUS_BYTES = 8192
SHAFT_RUN, SHAFT_BEARING = "shaft_run", "shaft_bearing"  # attributes of a bearing's result in a shaft's run
SLOTS = "restart/slots"
INTEGRALS_GROUP = "integrals"
REVOLUTIONS_GROUP = "revolutions"
INPUTS_GROUP = "inputs"

ROWS = 1024  # of one chunk
_SLOT_CHUNK = 65536
_TEXT = h5py.string_dtype()
_LAW_COLUMNS = (
    "element",
    "role",
    "model",
    "distribution",
    "reference",
    "bibtex",
    "parameters",
    "origins",
    "kernel_key",
)
_VALUE_COLUMNS = ("path", "value", "type", "quantity", "source", "grade", "status")


def create(file: h5py.File, provenance: Provenance, channels: Sequence[Channel]) -> None:
    """Create every object and attribute of a result in an empty file."""
    from lambda_core.system.describe import headline

    model = provenance.model
    file.attrs[LAYOUT_ATTRIBUTE] = LAYOUT
    file.attrs["title"] = model.title
    file.attrs["case"] = model.name
    file.attrs["headline"] = "\n".join(headline(model))
    file.attrs["created"] = provenance.created()
    if provenance.part_of is not None:
        file.attrs[SHAFT_RUN], file.attrs[SHAFT_BEARING] = provenance.part_of
    file.attrs["frames"] = "x shaft axis, y horizontal, z up; azimuth from +y towards +z; SI units"
    _dimensions(file, model, channels)
    _series(file, channels, "time")
    _series(file.create_group(INTEGRALS_GROUP), INTEGRALS, "time")
    revolutions = file.create_group(REVOLUTIONS_GROUP)
    number = Channel("revolution", (), "-", "whole cage revolutions completed")
    _series(revolutions, (number, *INTEGRALS), "revolution")
    if model.events:
        _series(file.create_group(EVENTS_GROUP), EVENTS, "time")
    if model.electric is not None:
        _series(file.create_group(CIRCUIT_GROUP), CIRCUIT, "time")
        _series(file.create_group(DISCHARGES_GROUP), DISCHARGES, "time")
    _inputs(file.create_group(INPUTS_GROUP), provenance)
    file.create_dataset(SLOTS, (2, 0), np.uint8, maxshape=(2, None), chunks=(1, _SLOT_CHUNK)).attrs["long_name"] = (
        "checkpoints, written in turn; bytes with a checksum"
    )
    status = file.create_dataset(STATUS, (), f"S{STATUS_BYTES}")
    status.attrs["long_name"] = "state of the run, rows that are complete, statistics, wall time; JSON"


def part_of(file: h5py.File) -> tuple[str, str] | None:
    """Return the mark of the shaft's run that a result is part of, and its bearing there; None of one bearing's own."""
    run, bearing = (printable(str(file.attrs.get(name, ""))) for name in (SHAFT_RUN, SHAFT_BEARING))
    return (run, bearing) if run else None


def _dimensions(file: h5py.File, model: BearingModel, channels: Sequence[Channel]) -> None:
    """Create the labels of every dimension that a channel has."""
    ball = file.create_dataset("ball", data=np.arange(1, model.geometry.balls + 1))
    ball.attrs["long_name"] = "number of the ball"
    ball.make_scale("ball")
    known = {**DIMENSIONS, "marker": tuple(model.markers)}
    for name in dict.fromkeys(dim for channel in (*channels, *INTEGRALS) for dim in channel.dims if dim != "ball"):
        file.create_dataset(name, data=np.array(known[name], dtype=object), dtype=_TEXT).make_scale(name)


def _series(group: h5py.Group, channels: Sequence[Channel], along: str) -> None:
    """Create one growing dataset per channel; the one called `along` is the growing dimension."""
    root, first = group.file, None
    dims = {dim: root[dim] for dim in dict.fromkeys(dim for channel in channels for dim in channel.dims)}
    sizes = {dim: labels.size for dim, labels in dims.items()}
    for channel in sorted(channels, key=lambda channel: channel.name != along):
        shape = tuple(sizes[dim] for dim in channel.dims)
        data = group.create_dataset(
            channel.name, (0, *shape), np.float64, maxshape=(None, *shape), chunks=(ROWS, *shape)
        )
        describe(data, {"units": channel.unit, "long_name": channel.meaning})
        if channel.name == along:
            data.make_scale(along)
            first = data
            continue
        for axis, scale in enumerate((first, *(dims[dim] for dim in channel.dims))):
            attach(data, axis, scale)


def _inputs(group: h5py.Group, provenance: Provenance) -> None:
    from lambda_core.system.operating_limits import operating_warnings

    model = provenance.model
    group.attrs["case_toml"] = "the case, complete: it runs again as it stands"
    for name, text in (("case_toml", model.case_toml), ("model_json", provenance.model_json())):
        group.create_dataset(name, data=text, dtype=_TEXT)
    if provenance.rating is not None:
        group.create_dataset("rating_json", data=provenance.rating.model_dump_json(), dtype=_TEXT)
    texts = (("assumptions", model.assumptions), ("plugins", model.plugins), ("warnings", operating_warnings(model)))
    for name, lines in texts:
        group.create_dataset(name, data=np.array(lines, dtype=object), dtype=_TEXT).make_scale(name)
    _table(group, "values", _VALUE_COLUMNS, provenance.values())
    _table(group, "laws", _LAW_COLUMNS, provenance.laws())
    if model.observers:
        _table(group, "observers", OBSERVER_COLUMNS, observer_rows(model, provenance.kernel_keys))
    if model.events:
        _table(group, "events", EVENT_COLUMNS, event_rows(model, provenance.kernel_keys))
    for name, pairs in (("versions", provenance.versions()), ("kernel_keys", dict(provenance.kernel_keys))):
        rows = [{"name": key, "value": value} for key, value in pairs.items()]
        _table(group, name, ("name", "value"), rows)


def _table(group: h5py.Group, name: str, columns: Sequence[str], rows: Sequence[dict[str, str]]) -> None:
    """Create a group with one text dataset per column, along the first column."""
    table = group.create_group(name)
    index = table.create_dataset("row", data=np.arange(len(rows)))
    index.make_scale("row")
    for column in columns:
        data = table.create_dataset(column, data=np.array([row[column] for row in rows], dtype=object), dtype=_TEXT)
        attach(data, 0, index)


def read_table(group: h5py.Group) -> list[dict[str, str]]:
    """Return the rows of a table that `_table` wrote."""
    columns = {name: data.asstr()[()] for name, data in group.items() if name != "row"}
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def rows_of(name: str, rows: Rows) -> int:
    """Return how many rows of a growing dataset (path in the file) count."""
    by_group = {
        INTEGRALS_GROUP: rows.records,
        REVOLUTIONS_GROUP: rows.revolutions,
        CIRCUIT_GROUP: rows.circuit,
        DISCHARGES_GROUP: rows.discharges,
        EVENTS_GROUP: rows.events,
    }
    return by_group.get(name.rpartition("/")[0], rows.samples)


def grows(item: object) -> bool:
    """Tell whether an object of a file is a dataset that a run appends to."""
    return isinstance(item, h5py.Dataset) and bool(item.maxshape) and item.maxshape[0] is None


def chunk_bytes(item: h5py.Dataset) -> int:
    """Return the bytes of ROWS rows of a dataset."""
    return int(ROWS * math.prod(item.shape[1:]) * item.dtype.itemsize)


def size(source: h5py.File, rows: Rows) -> int:
    """Return an upper bound of the bytes that a copy with the first `rows` rows takes, metadata aside."""
    total = 0
    for name, item in _objects(source).items():
        if grows(item):
            total += math.ceil(rows_of(name, rows) / ROWS) * chunk_bytes(item)
        elif isinstance(item, h5py.Dataset):
            total += 2 * item.nbytes + 4096
    return total + total // 100


def _objects(file: h5py.File) -> dict[str, Any]:
    """Return every group and dataset of a file by its path."""
    found: dict[str, Any] = {}
    file.visititems(found.__setitem__)
    return found


Stop = Callable[[], bool]
PACKING = 0.5  # time of this process for packing a result that was asked to end [s]


def never() -> bool:
    """Do not stop."""
    return False


def soon() -> Stop:
    """Stop after a while: packing takes long after a long run, and is not for whoever waits for the end."""
    until = time.process_time() + PACKING
    return lambda: time.process_time() > until


def copy(source: h5py.File, target: h5py.File, rows: Rows, compress: bool, stop: Stop = never) -> None:
    """Copy a result with the first `rows` rows of its growing datasets.

    Parameters
    ----------
    source, target : h5py.File
        A result and an empty file.
    rows : Rows
        How many to copy.
    compress : bool
        Compress (gzip and shuffle, which every HDF5 reader knows) and trim chunks to the data.
    stop : callable
        Asked between chunks.

    Raises
    ------
    InterruptedError
        When `stop` says so.
    """
    target.attrs.update(source.attrs)
    objects, copies = _objects(source), {}
    for name, item in objects.items():
        if isinstance(item, h5py.Group):
            target.require_group(name).attrs.update(item.attrs)
        else:
            copies[name] = _copy_dataset(name, item, target, rows, compress, stop)
    scales = scales_in(objects)
    for name in scales.values():
        copies[name].make_scale(Path(name).name)
    for name, copied in copies.items():
        for axis, scale in enumerate(scales_along(objects[name], scales)):
            if scale:
                attach(copied, axis, copies[scale])


def _copy_dataset(
    name: str, item: h5py.Dataset, target: h5py.File, rows: Rows, compress: bool, stop: Stop
) -> h5py.Dataset:
    packing = {"compression": "gzip", "compression_opts": 4, "shuffle": True} if compress else {}
    if not grows(item):
        options = {"maxshape": item.maxshape, "chunks": item.chunks, **packing} if item.chunks else {}
        data = target.create_dataset(name, data=item[()], dtype=item.dtype, **options)
    else:
        count = rows_of(name, rows)
        shape = (count, *item.shape[1:])
        chunk = (min(ROWS, max(count, 1)) if compress else ROWS, *item.chunks[1:])
        data = target.create_dataset(name, shape, item.dtype, maxshape=item.maxshape, chunks=chunk, **packing)
        for start in range(0, count, ROWS):
            if stop():
                raise InterruptedError("asked to stop")
            end = min(start + ROWS, count)
            data[start:end] = item[start:end]
    describe(data, texts_of(item, ("units", "long_name")))
    return data

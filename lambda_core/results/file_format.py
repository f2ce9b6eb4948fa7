"""Lay out a result file.

docs/results.md describes it.

``/time`` and ``/machine`` are of the machine, ``/bearings/NAME`` of each bearing; with one bearing everything of it is
also linked at the root, so that readers of HDF5 find ``/load``.

Everything is created before the first sample is written: HDF5 allows no new objects once
a file is written in SWMR mode, the mode that keeps it readable at every moment. Every
dimension is an HDF5 dimension scale, so netCDF readers (xarray with h5netcdf) find names
and labels.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.channels import CHANNELS, DIMENSIONS, Channel
from lambda_core.results import objects as low
from lambda_core.results.averages import INTEGRALS
from lambda_core.results.circuit_rows import CIRCUIT_GROUP, DISCHARGES_GROUP, circuit_channels, discharge_channels
from lambda_core.results.event_rows import (
    EVENT_COLUMNS,
    EVENTS,
    EVENTS_GROUP,
    OBSERVER_COLUMNS,
    event_rows,
    observer_rows,
)
from lambda_core.results.objects import attach, describe, filled, make_scale, scales_along, scales_in, texts, texts_of
from lambda_core.results.run_status import Rows

if TYPE_CHECKING:
    from lambda_core.results.provenance import BearingOrigin, MachineOrigin, Provenance
    from lambda_core.results.samples import RunChannels

LAYOUT = 2
LAYOUT_ATTRIBUTE = "lambda_bearing_layout"
STATUS = "status"
STATUS_BYTES = 16384
BEARINGS, MACHINE = "bearings", "machine"  # groups; the first is also the attribute with the names in order
SLOTS = "restart/slots"
INTEGRALS_GROUP = "integrals"
REVOLUTIONS_GROUP = "revolutions"
INPUTS_GROUP = "inputs"

ROWS = 1024  # of one chunk of a packed result, and read at a time
NEW_ROWS = 64  # of one chunk while rows are added: a short run does not write thousands of empty ones
_SLOT_CHUNK = 65536
_TIME = CHANNELS[0]
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
_PAIR_COLUMNS = ("name", "value")
TABLES = {  # of a bearing's inputs, and their columns
    "values": _VALUE_COLUMNS,
    "laws": _LAW_COLUMNS,
    "observers": OBSERVER_COLUMNS,
    "events": EVENT_COLUMNS,
    "kernel_keys": _PAIR_COLUMNS,
}


def create(file: h5py.File, provenance: Provenance, channels: RunChannels) -> None:
    """Create all objects of a result.

    The file is empty before and has every group and attribute afterwards.
    """
    from lambda_core.model.checks.describe import headline

    machine = provenance.machine
    file.attrs[LAYOUT_ATTRIBUTE] = LAYOUT
    file.attrs["title"] = provenance.title
    file.attrs["case"] = provenance.name
    file.attrs["created"] = provenance.created()
    file.attrs["frames"] = "x shaft axis, y horizontal, z up; azimuth from +y towards +z; SI units"
    file.attrs[BEARINGS] = np.array(list(provenance.bearings), dtype=object)
    _dimensions(file, channels)
    _series(file, (_TIME,), "time")
    inputs = file.create_group(INPUTS_GROUP)
    inputs.attrs["case_toml"] = "the complete case, which can run again unchanged"
    filled(inputs, "case_toml", texts(provenance.case_toml))
    _sentences(inputs, "plugins", provenance.plugins)
    _pairs(inputs, "versions", provenance.versions())
    if machine is not None:
        _machine(file.create_group(MACHINE), machine, channels.machine)
    for name, origin in provenance.bearings.items():
        group = file.create_group(f"{BEARINGS}/{name}")
        group.attrs["title"] = origin.model.title
        group.attrs["headline"] = origin.headline or "\n".join(headline(origin.model))
        _bearing(group, origin, channels.bearings[name])
    first = next(iter(provenance.bearings))
    file.attrs["headline"] = file[f"{BEARINGS}/{first}"].attrs["headline"] if machine is None else machine.headline
    if any(model.electric is not None for model in provenance.models):
        names, circuit = list(provenance.bearings), file.create_group(CIRCUIT_GROUP)
        if len(names) > 1:
            _scale(circuit, "bearing", names)
        _series(circuit, circuit_channels(len(names)), "time")
        _series(file.create_group(DISCHARGES_GROUP), discharge_channels(len(names)), "time")
    file.create_dataset(SLOTS, (2, 0), np.uint8, maxshape=(2, None), chunks=(1, _SLOT_CHUNK)).attrs["long_name"] = (
        "checkpoints, written in turn; bytes with a checksum"
    )
    status = file.create_dataset(STATUS, (), f"S{STATUS_BYTES}")
    status.attrs["long_name"] = "state of the run, rows that are complete, statistics, wall time; JSON"
    _link_alone(file)


def _machine(group: h5py.Group, origin: MachineOrigin, channels: Sequence[Channel]) -> None:
    """Create the machine's objects of a result.

    What shaft and bodies of a machine write, and their origin.
    """
    for dim, labels in origin.labels.items():
        _scale(group, dim, labels)
    _series(group, [c for c in channels if all(dim not in origin.labels or len(origin.labels[dim]) for dim in c.dims)])
    inputs = group.create_group(INPUTS_GROUP)
    filled(inputs, "model_json", texts(json.dumps(origin.model, ensure_ascii=False)))
    filled(inputs, "numbers_json", texts(json.dumps(dict(origin.numbers))))
    for name, lines in (("assumptions", origin.assumptions), ("warnings", origin.warnings)):
        _sentences(inputs, name, lines)


def _bearing(group: h5py.Group, origin: BearingOrigin, channels: Sequence[Channel]) -> None:
    """Create what one bearing writes, and where it comes from."""
    model = origin.model
    _scale(group, "ball", np.arange(1, model.geometry.balls + 1))
    group["ball"].attrs["long_name"] = "number of the ball"
    if any("marker" in channel.dims for channel in channels):
        _scale(group, "marker", tuple(model.markers))
    if model.links:
        _scale(group, "element", tuple(model.links))
    _series(group, channels)
    _series(group.create_group(INTEGRALS_GROUP), INTEGRALS, "time")
    number = Channel("revolution", (), "-", "whole cage revolutions completed")
    _series(group.create_group(REVOLUTIONS_GROUP), (number, *INTEGRALS), "revolution")
    if model.events:
        _series(group.create_group(EVENTS_GROUP), EVENTS, "time")
    _inputs(group.create_group(INPUTS_GROUP), origin)


def bearing_names(file: h5py.File) -> tuple[str, ...]:
    """Return the bearings of a result.

    They have the order of the machine. A missing one raises a KeyError.
    """
    names = tuple(str(name) for name in file.attrs[BEARINGS])
    if set(names) != set(file[BEARINGS]) or not names:
        raise KeyError("the list of its bearings is not that of its groups")
    return names


def _linked(file: h5py.File) -> set[str]:
    """Return the root paths of the only bearing.

    They are its objects by another name.
    """
    groups = list(file.get(BEARINGS, ()))
    if len(groups) != 1:
        return set()
    own = file[BEARINGS][groups[0]]
    inputs = {f"{INPUTS_GROUP}/{name}" for name in own[INPUTS_GROUP]} if INPUTS_GROUP in own else set()
    return {name for name in own if name != INPUTS_GROUP} | inputs


def _link_alone(file: h5py.File) -> None:
    """Link everything of the only bearing at root."""
    if found := _linked(file):
        (name,) = file[BEARINGS]
        for path in found:
            low.link(file, path, f"{BEARINGS}/{name}/{path}")


def _dimensions(file: h5py.File, channels: RunChannels) -> None:
    """Create the labels of every dimension that bearings share."""
    every = (*channels.machine, *INTEGRALS, *(c for own in channels.bearings.values() for c in own))
    for name in dict.fromkeys(dim for channel in every for dim in channel.dims if dim in DIMENSIONS):
        _scale(file, name, DIMENSIONS[name])


def _scale(group: h5py.Group, name: str, labels: Sequence[str] | NDArray[Any]) -> None:
    """Create the labels of one dimension."""
    make_scale(filled(group, name, labels if isinstance(labels, np.ndarray) else texts(labels)), name)


def _series(group: h5py.Group, channels: Sequence[Channel], along: str = "") -> None:
    """Create one growing dataset per channel.

    `along` is the growing dimension, without one the samples' time.
    """
    first = None if along else group.file["time"].id
    dims = {dim: _nearest(group, dim) for dim in dict.fromkeys(dim for c in channels for dim in c.dims)}
    sizes = {dim: math.prod(labels.shape) for dim, labels in dims.items()}
    for channel in sorted(channels, key=lambda channel: channel.name != along):
        shape = tuple(sizes[dim] for dim in channel.dims)
        data = low.created(
            group, channel.name, low.NUMBER, (0, *shape), longest=(None, *shape), chunk=(NEW_ROWS, *shape)
        )
        describe(data, {"units": channel.unit, "long_name": channel.meaning})
        if channel.name == along:
            make_scale(data, along)
            first = data
            continue
        for axis, scale in enumerate((first, *(dims[dim] for dim in channel.dims))):
            attach(data, axis, scale)


def _nearest(group: h5py.Group, dim: str) -> h5py.h5d.DatasetID:
    """Return the labels of a dimension.

    This group has them, otherwise the nearest one above that does.
    """
    place = group.name.rstrip("/")
    while (found := low.dataset(group, f"{place}/{dim}")) is None:  # a bearing may have the name of one
        if not place:
            raise KeyError(dim)
        place = place.rpartition("/")[0]
    return found


def _inputs(group: h5py.Group, origin: BearingOrigin) -> None:
    from lambda_core.model.checks.operating_limits import operating_warnings

    model = origin.model
    filled(group, "model_json", texts(origin.model_json()))
    if origin.rating is not None:
        filled(group, "rating_json", texts(origin.rating.model_dump_json()))
    if origin.band is not None:
        filled(group, "model_band_json", texts(origin.band.model_dump_json()))
        for name, ends in origin.band.fields().items():
            filled(group, name, np.array(ends))
    _sentences(group, "assumptions", model.assumptions)
    _sentences(group, "warnings", [*origin.warnings, *operating_warnings(model, on_shaft=bool(origin.headline))])
    _table(group, "values", _VALUE_COLUMNS, origin.values())
    _table(group, "laws", _LAW_COLUMNS, origin.laws())
    if model.observers:
        _table(group, "observers", OBSERVER_COLUMNS, observer_rows(model, origin.kernel_keys))
    if model.events:
        _table(group, "events", EVENT_COLUMNS, event_rows(model, origin.kernel_keys))
    _pairs(group, "kernel_keys", origin.kernel_keys)


def _sentences(group: h5py.Group, name: str, lines: Sequence[str]) -> None:
    make_scale(filled(group, name, texts(lines)), name)


def _pairs(group: h5py.Group, name: str, pairs: Mapping[str, str]) -> None:
    _table(group, name, _PAIR_COLUMNS, [{"name": key, "value": value} for key, value in pairs.items()])


def _table(group: h5py.Group, name: str, columns: Sequence[str], rows: Sequence[dict[str, str]]) -> None:
    """Create a group of text datasets.

    Each column makes one dataset along the first column.
    """
    table = group.create_group(name)
    index = filled(table, "row", np.arange(len(rows)))
    make_scale(index, "row")
    for column in columns:
        attach(filled(table, column, texts([row[column] for row in rows])), 0, index)


def read_table(group: h5py.Group) -> list[dict[str, str]]:
    """Return the rows of a table that `_table` wrote."""
    columns = {name: data.asstr()[()] for name, data in group.items() if name != "row"}
    return [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]


def rows_of(path: str, rows: Rows) -> int:
    """Return the valid rows of a growing dataset.

    The dataset is given by its path in the file, as of :func:`objects`.
    """
    place = path.strip("/").rpartition("/")[0]
    counts = {CIRCUIT_GROUP: rows.circuit, DISCHARGES_GROUP: rows.discharges}
    if not place.startswith(f"{BEARINGS}/"):
        return counts.get(place, rows.samples)
    name, _, group = place.removeprefix(f"{BEARINGS}/").partition("/")
    if group == INTEGRALS_GROUP:
        return rows.records
    each = {REVOLUTIONS_GROUP: rows.revolutions, EVENTS_GROUP: rows.events}
    return each[group].get(name, 0) if group in each else rows.samples


def grows(item: object) -> bool:
    """Tell whether a run appends to an object.

    It is then a growing dataset of the file.
    """
    return isinstance(item, h5py.Dataset) and low.grows(item.id)


def row_bytes(data: h5py.h5d.DatasetID) -> int:
    """Return the bytes of one row of a dataset."""
    return int(math.prod(data.shape[1:]) * data.dtype.itemsize)


def size(originals: Mapping[str, Any], rows: Rows) -> int:
    """Return the size limit of a copy [bytes].

    It is an upper bound for these :func:`objects` with the first `rows` rows, without metadata.
    """
    total = 0
    for name, item in originals.items():
        if grows(item):
            total += math.ceil(rows_of(name, rows) / NEW_ROWS) * NEW_ROWS * row_bytes(item.id)
        elif isinstance(item, h5py.Dataset):
            total += 2 * item.nbytes + 4096
    return total + total // 100


def objects(file: h5py.File) -> dict[str, Any]:
    """Return every group and dataset by path.

    An object that the root has by another name counts once.
    """
    linked, found = _linked(file), dict[str, Any]()
    seen = {h5py.h5o.get_info(file["/"].id).addr}  # a damaged file may have a group that contains itself

    def look(group: h5py.Group, above: str) -> None:
        for name in group:
            path = f"{above}{name}"
            if path in linked:
                continue
            item = found[path] = group[name]
            if isinstance(item, h5py.Group) and (address := h5py.h5o.get_info(item.id).addr) not in seen:
                seen.add(address)
                look(item, f"{path}/")

    look(file, "")
    return found


Stop = Callable[[], bool]
PACKING = 0.5  # time of this process for packing a result that was asked to end [s]


def never() -> bool:
    """Do not stop."""
    return False


def soon() -> Stop:
    """Stop after a while.

    Packing takes long after a long run, and nobody should wait for it at the end.
    """
    until = time.process_time() + PACKING
    return lambda: time.process_time() > until


def copy(originals: Mapping[str, Any], target: h5py.File, rows: Rows, compress: bool, stop: Stop = never) -> None:
    """Copy a result with its first rows.

    It takes the first `rows` rows of its growing datasets.

    Parameters
    ----------
    originals : mapping
        The :func:`objects` of a result.
    target : h5py.File
        An empty file, with the attributes of the result.
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
    copies = {}
    for name, item in originals.items():
        if isinstance(item, h5py.Group):
            target.require_group(name).attrs.update(item.attrs)
        else:
            copies[name] = _copy_dataset(name, item, target, rows, compress, stop)
    scales = scales_in({name: originals[name].id for name in copies})
    for name in scales.values():
        make_scale(copies[name], name.rpartition("/")[2])
    for name, copied in copies.items():
        for axis, scale in enumerate(scales_along(originals[name].id, scales)):
            if scale:
                attach(copied, axis, copies[scale])
    _link_alone(target)


def _copy_dataset(
    name: str, item: h5py.Dataset, target: h5py.File, rows: Rows, compress: bool, stop: Stop
) -> h5py.h5d.DatasetID:
    old = item.id
    kind, (shape, longest) = old.get_type(), low.extent(old)
    if longest[:1] != (None,):
        chunk = low.chunk_of(old) if None in longest else None
        data = low.created(target, name, kind, shape, longest=longest, chunk=chunk, packed=compress)
        low.put(data, low.content(old))
    else:
        count = rows_of(name, rows)
        chunk = (min(ROWS, max(count, 1)) if compress else NEW_ROWS, *shape[1:])
        data = low.created(target, name, kind, (count, *shape[1:]), longest=longest, chunk=chunk, packed=compress)
        for start in range(0, count, ROWS):
            if stop():
                raise InterruptedError("asked to stop")
            low.put_rows(data, start, low.rows(old, start, min(start + ROWS, count)))
    describe(data, texts_of(old, ("units", "long_name")))
    return data

"""Open a result file and check it."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import Channel
from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.domain.printable import printable
from lambda_core.model.bearing_model import ResolvedValue
from lambda_core.results import file_format as layout
from lambda_core.results.averages import INTEGRALS
from lambda_core.results.hdf5 import open_for_reading, reason
from lambda_core.results.integrity import heaps_are_intact
from lambda_core.results.objects import datasets, grows, scales_along, scales_in, texts_of


class _Held(threading.local):
    """Files of this thread in blocks of :func:`opened`."""

    def __init__(self) -> None:
        self.files: dict[Path, h5py.File] = {}


_held = _Held()


class ResultError(UsageError):
    """A file is not a result, or is damaged."""


class BeingWrittenError(ResultError):
    """Another process is at work on a result."""

    def __init__(self, path: Path, pid: str) -> None:
        super().__init__(f"{path} is still being written by process {pid}")


@contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """Open a result of this layout.

    Any fault of the file, whenever it shows, raises a ResultError. Within a block that has opened it, a result is not
    opened again: a summary asks for some thirty parts one after another.
    """
    if (held := _held.files.get(path)) is not None:
        with _naming_damage(path):
            yield held
        return
    if not path.is_file():
        what = "does not exist: name a file that lambda-bearing run has written"
        if path.exists():
            what = "is a folder, not a result file" if path.is_dir() else "is not a regular file"
        raise ResultError(f"{path} {what}")
    try:
        file = open_for_reading(path)
    except (OSError, RuntimeError, KeyError) as error:
        if not h5py.is_hdf5(path):
            raise ResultError(
                f"{path} is not a result file (not HDF5): name a file that lambda-bearing run has written"
            ) from None
        raise ResultError(f"{path} cannot be read: {reason(error)}") from None
    with file, _naming_damage(path):
        version = file.attrs.get(layout.LAYOUT_ATTRIBUTE)
        if version is None:
            raise ResultError(f"{path} is an HDF5 file, but not a result of lambda-bearing")
        if version != layout.LAYOUT:
            raise ResultError(
                f"{path} has layout {version}; this program reads layout {layout.LAYOUT}: use the version that wrote it"
            )
        _held.files[path] = file
        try:
            yield file
        finally:
            del _held.files[path]


@contextmanager
def _naming_damage(path: Path) -> Iterator[None]:
    try:
        yield
    except LambdaError:
        raise
    except SystemError as error:
        if isinstance(error.__cause__, KeyboardInterrupt):  # Ctrl+C inside h5py, whose locks turn it into this
            raise KeyboardInterrupt from None
        raise ResultError(f"{path} is damaged: {_damage(error)}") from None
    except Exception as error:  # a garbled file misleads h5py into errors of every kind
        raise ResultError(f"{path} is damaged: {_damage(error)}") from None


def _damage(error: Exception) -> str:
    """Return the damage.

    h5py reports some of it with Python's words for a wrong type.
    """
    if isinstance(error, TypeError | AttributeError | AssertionError):
        return "a part of it is missing, or of another kind"
    return reason(error)


def check_alone(file: h5py.File) -> None:
    """Refuse a file that points at others, or damaged texts.

    The texts are looked at first: HDF5 would read damaged ones for ever. Somebody's link would show the content of
    other files of the user; a run writes none.
    """
    if not heaps_are_intact(Path(file.filename)):
        raise ResultError(f"{file.filename} is damaged: its texts cannot be read")
    seen = set[int]()

    def elsewhere(name: bytes, link: Any) -> bytes | None:  # HDF5 passes on what is returned, not what is raised
        if link.type != h5py.h5l.TYPE_HARD:
            return name
        if link.u in seen:  # by another name
            return None
        seen.add(link.u)
        item = h5py.h5o.open(file.id, name)
        made = item.get_create_plist() if isinstance(item, h5py.h5d.DatasetID) else None
        away = made is not None and (made.get_external_count() > 0 or made.get_layout() == h5py.h5d.VIRTUAL)
        return name if away else None

    # by the lower level: h5py's own objects take five times as long
    if found := file.id.links.visit(elsewhere, info=True):
        name = printable(found.decode("utf-8", "surrogateescape"))
        raise ResultError(f"{file.filename} is not a result of a run: {name} is a link or external data")


def channels_of(group: h5py.Group) -> Iterator[tuple[Channel, dict[str, str]]]:
    """Yield the channels of a group.

    Yield everything there that grows, with the path of the labels of each dimension.
    """
    root = group.file
    items = {f"{group.name}/{name}": data for name, data in datasets(group).items()}
    scales = scales_in({f"/{name}": data for name, data in datasets(root).items()} | items)
    for path, data in items.items():
        if grows(data):
            data.get_num_chunks()  # a damaged index raises here; read through, it would fill the memory
            along = [scale for scale in scales_along(data, scales) if scale.rpartition("/")[2] not in ("", "time")]
            paths = {scale.rpartition("/")[2]: scale for scale in along}
            dims = tuple(scale.rpartition("/")[2] for scale in along)
            texts = texts_of(data, ("units", "long_name"))
            yield Channel(path.rpartition("/")[2], dims, texts["units"], texts["long_name"]), paths


def labels_of(data: h5py.Dataset) -> tuple[int, ...] | tuple[float, ...] | tuple[str, ...]:
    """Return the labels of a dimension.

    They are names, numbers of balls or places [m].
    """
    if h5py.check_string_dtype(data.dtype):
        return tuple(printable(label) for label in data.asstr()[()])
    numbers = data[()]
    return tuple(numbers.tolist())


def integral_table(group: h5py.Group, rows: int) -> FloatArray:
    """Return the running integrals.

    The table has the order of INTEGRALS, shape (rows, n). Early files have no `support`: their dampers to the ground
    are among the losses.
    """
    columns = [
        np.zeros((rows, 1)) if channel.name == "support" and "support" not in group
        else group[channel.name][:rows].reshape(rows, -1)
        for channel in INTEGRALS
    ]  # fmt: skip
    return np.concatenate(columns, axis=1, dtype=np.float64)  # a TypeError where one holds texts


def resolved_value(row: dict[str, str]) -> ResolvedValue:
    """Return a value of the case with its origin.

    It comes from a row of the file's table.
    """
    fields: dict[str, Any] = dict(row)
    if fields.pop("type") == "number":
        fields["value"] = float(fields["value"])
    return ResolvedValue(**fields)

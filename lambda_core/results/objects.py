"""Read and write HDF5 datasets by h5py's lower level.

It takes a fifth of the time.

A result has about a hundred datasets, each with two texts and up to three scales: by h5py's own datasets, attributes
and dimensions they take longer than the numbers of a short run.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from typing import Any

import h5py
import numpy as np
from h5py import h5a, h5d, h5ds, h5o, h5p, h5r, h5s, h5t
from numpy.typing import NDArray

NUMBER = h5t.NATIVE_DOUBLE
_TEXT = h5py.string_dtype()
_TEXT_KIND, _ONE = h5t.py_create(_TEXT, logical=True), h5s.create(h5s.SCALAR)
_LISTS = h5py.vlen_dtype(h5py.ref_dtype)
_DEFLATE = 4
_NAMED = h5p.create(h5p.LINK_CREATE)
_NAMED.set_char_encoding(h5t.CSET_UTF8)
_SCALES = b"DIMENSION_LIST"  # the attribute in which HDF5's dimension scales stand, one list for each axis


def created(
    group: h5py.Group,
    name: str,
    kind: h5t.TypeID,
    shape: tuple[int, ...],
    *,
    longest: tuple[int | None, ...] | None = None,
    chunk: tuple[int, ...] | None = None,
    packed: bool = False,
) -> h5d.DatasetID:
    """Create a dataset below a group that exists.

    Parameters
    ----------
    longest : tuple, optional
        How far each dimension may grow, None without limit; default: not at all.
    chunk : tuple of int, optional
        What is written at a time of a dataset that may grow.
    packed : bool
        Compress chunks (gzip and shuffle, which every HDF5 reader knows).
    """
    ends = None if longest is None else tuple(h5s.UNLIMITED if end is None else end for end in longest)
    space = h5s.create_simple(shape, ends) if shape else _ONE
    return h5d.create(group.id, name.encode(), kind, space, _creation(chunk, packed), _NAMED)


@cache
def _creation(chunk: tuple[int, ...] | None, packed: bool) -> h5p.PropDCID:
    options = h5p.create(h5p.DATASET_CREATE)
    options.set_obj_track_times(False)  # as h5py does: equal runs, equal bytes
    if chunk is not None:
        options.set_chunk(chunk)
        if packed:
            options.set_shuffle()
            options.set_deflate(_DEFLATE)
    return options


def filled(group: h5py.Group, name: str, values: NDArray[Any]) -> h5d.DatasetID:
    """Create a dataset of fixed size with its values."""
    data = created(group, name, h5t.py_create(values.dtype, logical=True), values.shape)
    put(data, values)
    return data


def texts(words: str | Sequence[str]) -> NDArray[Any]:
    """Return a text, or several, as a dataset takes them."""
    return np.array(words, dtype=_TEXT)


def link(file: h5py.File, name: str, old: str) -> None:
    """Give an object another name."""
    file.id.links.create_hard(name.encode(), file.id, old.encode(), _NAMED)


def datasets(group: h5py.Group) -> dict[str, h5d.DatasetID]:
    """Return the datasets of a group by name."""
    found = {name.decode("utf-8", "surrogateescape"): h5o.open(group.id, name) for name in group.id}
    return {name: item for name, item in found.items() if isinstance(item, h5d.DatasetID)}


def dataset(group: h5py.Group, name: str) -> h5d.DatasetID | None:
    """Return a dataset, None where it is missing."""
    found = h5o.open(group.id, name.encode()) if name.encode() in group.id else None
    return found if isinstance(found, h5d.DatasetID) else None


def grows(data: h5d.DatasetID) -> bool:
    """Tell whether a run appends to a dataset."""
    return extent(data)[1][:1] == (None,)


def extent(data: h5d.DatasetID) -> tuple[tuple[int, ...], tuple[int | None, ...]]:
    """Return the shape, and how far each dimension may grow.

    None is without limit.
    """
    space = data.get_space()
    ends = space.get_simple_extent_dims(True)
    return space.shape, tuple(None if end == h5s.UNLIMITED else end for end in ends)


def chunk_of(data: h5d.DatasetID) -> tuple[int, ...] | None:
    """Return the shape of a chunk, None without chunks."""
    options = data.get_create_plist()
    return tuple(options.get_chunk()) if options.get_layout() == h5d.CHUNKED else None


def put(data: h5d.DatasetID, values: NDArray[Any]) -> None:
    """Write all of a dataset."""
    if values.size:
        data.write(h5s.ALL, h5s.ALL, np.asarray(values, order="C"))


def put_rows(data: h5d.DatasetID, start: int, values: NDArray[Any]) -> None:
    """Write rows of a dataset, from `start` on."""
    place, memory = data.get_space(), h5s.create_simple(values.shape)
    place.select_hyperslab((start, *(0,) * (values.ndim - 1)), values.shape)
    data.write(memory, place, np.ascontiguousarray(values))


def rows(data: h5d.DatasetID, start: int, stop: int) -> NDArray[Any]:
    """Return rows of a dataset."""
    place = data.get_space()
    found = np.empty((stop - start, *place.shape[1:]), data.dtype)
    place.select_hyperslab((start, *(0,) * (found.ndim - 1)), found.shape)
    data.read(h5s.create_simple(found.shape), place, found)
    return found


def content(data: h5d.DatasetID) -> NDArray[Any]:
    """Return all of a dataset."""
    found = np.empty(data.shape, data.dtype)
    if found.size:
        data.read(h5s.ALL, h5s.ALL, found)
    return found


def describe(item: h5d.DatasetID, texts: Mapping[str, str]) -> None:
    """Write missing texts of a dataset.

    It has none of these names yet.
    """
    for name, text in texts.items():
        h5a.create(item, name.encode(), _TEXT_KIND, _ONE).write(np.array(text, dtype=_TEXT))


def texts_of(data: h5d.DatasetID, names: Iterable[str]) -> dict[str, str]:
    """Return the texts among some names that a dataset has.

    Raises
    ------
    TypeError
        When one is no text: HDF5 would crash where :func:`describe` writes an empty array as one.
    """
    found: dict[str, str] = {}
    for name in names:
        if h5a.exists(data, name.encode()):
            text = np.empty((), _TEXT)
            h5a.open(data, name.encode()).read(text)
            if not isinstance(text[()], bytes):
                raise TypeError(f"{name} is not a text")
            found[name] = text[()].decode("utf-8", "surrogateescape")
    return found


def make_scale(data: h5d.DatasetID, name: str) -> None:
    """Make a dataset a dimension scale."""
    h5ds.set_scale(data, name.encode())


def attach(data: h5d.DatasetID, axis: int, scale: h5d.DatasetID) -> None:
    """Name an axis of a dataset by a dimension scale."""
    h5ds.attach_scale(data, scale, axis)


def scales_in(items: Mapping[str, h5d.DatasetID]) -> dict[h5d.DatasetID, str]:
    """Return the names of the scales among datasets."""
    return {data: name for name, data in items.items() if h5ds.is_scale(data)}


def scales_along(data: h5d.DatasetID, scales: Mapping[h5d.DatasetID, str]) -> list[str]:
    """Return the name of each axis's scale.

    It is empty where the axis has none.

    HDF5 looks a name up by going through the file; the object that is pointed at is known at once.

    Raises
    ------
    TypeError
        When a scale is none of `scales`: it was taken out of the file.
    """
    if not h5a.exists(data, _SCALES):
        return [""] * data.rank
    found = np.empty(data.rank, dtype=_LISTS)
    h5a.open(data, _SCALES).read(found)
    try:
        pointed = [h5r.dereference(each[0], data) if len(each) else None for each in found]
    except (KeyError, OSError, RuntimeError, ValueError):  # HDF5 finds no object at the place
        raise TypeError("the scale of an axis is missing") from None
    if any(len(each) and scale not in scales for each, scale in zip(found, pointed, strict=True)):
        raise TypeError("the scale of an axis is missing")
    return [scales.get(scale, "") for scale in pointed]

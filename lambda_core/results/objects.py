"""Read HDF5 texts and scales by h5py's lower level.

It takes a fifth of the time.

A result has about a hundred datasets, each with two texts and up to three scales: by h5py's own attributes and
dimensions they take longer than the numbers of a short run.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import h5py
import numpy as np
from h5py import h5a, h5ds, h5r, h5s, h5t

_TEXT = h5py.string_dtype()
_SCALES = b"DIMENSION_LIST"  # the attribute in which HDF5's dimension scales stand, one list for each axis


def describe(item: h5py.Dataset, texts: Mapping[str, str]) -> None:
    """Write missing texts of a dataset.

    It has none of these names yet.
    """
    kind, one = h5t.py_create(_TEXT, logical=True), h5s.create(h5s.SCALAR)
    for name, text in texts.items():
        h5a.create(item.id, name.encode(), kind, one).write(np.array(text, dtype=_TEXT))


def texts_of(item: h5py.Dataset, names: Iterable[str]) -> dict[str, str]:
    """Return the texts among some names that a dataset has.

    Raises
    ------
    TypeError
        When one is no text: HDF5 would crash where :func:`describe` writes an empty array as one.
    """
    found = {name: item.attrs[name] for name in names if h5a.exists(item.id, name.encode())}
    if any(not isinstance(text, str) for text in found.values()):
        raise TypeError(f"the {' or '.join(found)} of {item.name} is not a text")
    return found


def attach(data: h5py.Dataset, axis: int, scale: h5py.Dataset) -> None:
    """Name an axis of a dataset by a dimension scale."""
    h5ds.attach_scale(data.id, scale.id, axis)


def scales_in(items: Mapping[str, object]) -> dict[h5py.h5d.DatasetID, str]:
    """Return the dimension scales with their names.

    They are among the objects of a file.
    """
    return {item.id: name for name, item in items.items() if isinstance(item, h5py.Dataset) and h5ds.is_scale(item.id)}


def scales_along(data: h5py.Dataset, scales: Mapping[h5py.h5d.DatasetID, str]) -> list[str]:
    """Return the name of each axis's scale.

    It is empty where the axis has none.

    HDF5 looks a name up by going through the file; the object that is pointed at is known at once.

    Raises
    ------
    TypeError
        When a scale is none of `scales`: it was taken out of the file.
    """
    if not h5a.exists(data.id, _SCALES):
        return [""] * data.ndim
    lists = data.attrs.get_id(_SCALES)
    found = np.empty(lists.shape, dtype=lists.dtype)
    lists.read(found)
    pointed = [h5r.dereference(each[0], data.id) if len(each) else None for each in found]
    if any(len(each) and scale not in scales for each, scale in zip(found, pointed, strict=True)):
        raise TypeError(f"the scale of an axis of {data.name} is missing")
    return [scales.get(scale, "") for scale in pointed]

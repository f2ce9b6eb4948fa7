"""Check the integrity of a result file before use.

Its texts can be read and its model is complete.

The heaps in which HDF5 keeps texts are looked at before HDF5 reads them: a damaged one would keep it busy for ever.

HDF5 steps from object to object by the sizes that stand in the heap and does not ask whether a step is zero. The layout
is that of the HDF5 File Format Specification, version 3.0, III.E "Disk Format: Level 1E - Global Heap".
"""

from __future__ import annotations

import mmap
import struct
from collections.abc import Mapping
from dataclasses import MISSING, fields
from pathlib import Path
from typing import Any

from lambda_core.elements.ball.geometry import Geometry
from lambda_core.model.bearing_model import Solver

_SIGNATURE = b"GCOL\x01\x00\x00\x00"  # with version and reserved bytes
_SIZE = struct.Struct("<Q")
_OBJECT = struct.Struct("<HHIQ")  # index, references, reserved, size
_HDF5 = b"\x89HDF\r\n\x1a\n"
_SUPERBLOCK = 48  # [byte], as much of it as is read
_END, _END_OF_OLD = 28, 40  # place of the address of the file's end, versions 2 and 3; 0 and 1
_WORDS = ("series", "arrangement", "ribs")  # what a geometry says in words
_LOOKED_AT = 64 << 20  # [byte] from the beginning: a run writes its texts before its samples


def heaps_are_intact(path: Path) -> bool:
    """Tell whether the text heaps are intact.

    A reader can step through each heap near the beginning of a file to the heap's end.
    """
    with path.open("rb") as stream:
        if not stream.seek(0, 2):
            return True
        with mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ) as data:
            end = min(len(data), _LOOKED_AT)
            place = data.find(_SIGNATURE, 0, end)
            while place >= 0:
                if not _ends(data, place):
                    return False
                place = data.find(_SIGNATURE, place + 1, end)
    return True


def _ends(data: mmap.mmap, start: int) -> bool:
    """Step through one heap.

    True when each step goes on and none leaves the heap.
    """
    place = start + len(_SIGNATURE)
    if place + _SIZE.size > len(data):
        return False
    end = start + _SIZE.unpack_from(data, place)[0]
    place += _SIZE.size
    if not place < end <= len(data):
        return False
    while place + _OBJECT.size <= end:
        index, _, _, size = _OBJECT.unpack_from(data, place)
        step = _OBJECT.size + (size + 7) // 8 * 8 if index else size  # object 0 is the room left, header included
        if step < _OBJECT.size or place + step > end:
            return False
        place += step
    return True


def is_cut(path: Path) -> bool:
    """Tell whether a file was cut.

    It is shorter than the end in its superblock.

    What is behind the end of a file HDF5 reads as zeros where another process might still be writing. Whoever flushes
    makes the file as long before the superblock says so (HDF5 File Format Specification, II.A).
    """
    with path.open("rb") as stream:
        head = stream.read(_SUPERBLOCK)
        size = stream.seek(0, 2)
    if len(head) < _SUPERBLOCK or not head.startswith(_HDF5):
        return False
    end = _SIZE.unpack_from(head, _END_OF_OLD if head[len(_HDF5)] < 2 else _END)[0]
    return bool(size < end)


def check_model(model: Any) -> None:
    """Refuse an incomplete model with ValueError.

    It was read back as plain data, and every use of a result needs these values.
    """
    if not isinstance(model, dict):
        raise ValueError("its model is not a table")
    for part, kind in (("geometry", Geometry), ("solver", Solver)):
        table = model.get(part)
        needed = {field.name for field in fields(kind) if field.default is MISSING}
        if not isinstance(table, Mapping) or not needed <= set(table) <= {field.name for field in fields(kind)}:
            raise ValueError(f"the {part} of its model is incomplete")
        if wrong := [name for name, value in table.items() if name not in _WORDS and not _is_number(value)]:
            raise ValueError(f"{part}.{wrong[0]} of its model is not a number")
    depth = model.get("depth")
    if not isinstance(depth, Mapping) or "cage" not in depth or not _is_number(model.get("roughness")):
        raise ValueError("its model is incomplete")


def check_machine(name: str, found: Mapping[str, Any]) -> None:
    """Refuse an incomplete machine with ValueError.

    Its model or a number lacks what a summary needs.
    """
    needed = {"model_json": ("speed",), "numbers_json": ("drive_torque",)}[name]
    if not all(_is_number(found.get(key)) for key in needed):
        raise ValueError(f"its machine has no number {needed[0]}")
    seats = found.get("bearings", {}) if name == "model_json" else {}
    if not isinstance(seats, Mapping) or not all(
        isinstance(seat, Mapping) and _is_number(seat.get("position")) for seat in seats.values()
    ):
        raise ValueError("the bearings of its machine are incomplete")


def _is_number(value: object) -> bool:
    """Tell whether `float` reads a text.

    An infinite number is a word in it.
    """
    try:
        float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        return False
    return True

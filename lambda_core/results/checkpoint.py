"""Store the engine's state as bytes with a check.

Two slots in the result file are written in turn. A process killed in the middle of one
leaves the other, and a checksum tells which is whole; so a checkpoint is found at every
moment after the first was written.
"""

from __future__ import annotations

import io
import json
import struct
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field

import numpy as np
from numpy.typing import NDArray

from lambda_core.results.run_status import Rows

_HEADER = struct.Struct("<8sQI")  # magic, length of the body, CRC-32 of length and body
_MAGIC = b"LBCHECK1"


@dataclass(frozen=True)
class Position:
    """Place of a checkpoint in file and run."""

    sequence: int  # counts checkpoints
    rows: Rows  # of the file up to here
    wall: float  # wall time of integration up to here [s]
    statistics: dict[str, float] = field(default_factory=dict)
    summed: Rows = field(default_factory=Rows)  # that the checksums stand for: up to here, and an end off the grid
    sums: dict[str, int] = field(default_factory=dict)  # path of a dataset -> checksum of these rows


@dataclass(frozen=True)
class Checkpoint:
    """Everything that a continuation needs."""

    position: Position
    state: Mapping[str, NDArray[np.float64]]

    def to_bytes(self) -> bytes:
        """Return the checkpoint with header and checksum."""
        buffer = io.BytesIO()
        buffer.write(json.dumps(asdict(self.position)).encode() + b"\n")
        np.savez(buffer, **self.state)  # type: ignore[arg-type]  # numpy types the keyword allow_pickle only
        body = buffer.getvalue()
        return _HEADER.pack(_MAGIC, len(body), _checksum(body)) + body


def latest(slots: Iterable[bytes]) -> Checkpoint | None:
    """Return the newest complete checkpoint of `slots`.

    None when no slot holds one.
    """
    intact = [_read(body) for body in map(_body, slots) if body is not None]
    return max(intact, key=lambda checkpoint: checkpoint.position.sequence, default=None)


def _read(body: bytes) -> Checkpoint:
    stream = io.BytesIO(body)
    fields = json.loads(stream.readline())
    counts = {name: Rows.read(fields[name]) for name in ("rows", "summed") if name in fields}
    position = Position(**{**fields, **counts})
    with np.load(io.BytesIO(stream.read()), allow_pickle=False) as arrays:
        return Checkpoint(position, {name: arrays[name] for name in arrays.files})


def _body(slot: bytes) -> bytes | None:
    """Return the body of a slot.

    None when it is empty or torn.
    """
    if len(slot) < _HEADER.size:
        return None
    magic, length, checksum = _HEADER.unpack_from(slot)
    body = slot[_HEADER.size : _HEADER.size + length]
    intact = magic == _MAGIC and len(body) == length and _checksum(body) == checksum
    return body if intact else None


def _checksum(body: bytes) -> int:
    return zlib.crc32(body, len(body) & 0xFFFFFFFF)

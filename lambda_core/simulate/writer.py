"""Writing a result file while it is read, killed, or out of disk."""

from __future__ import annotations

import errno
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.errors import PartialResultError, UsageError
from lambda_core.physics.channels import Channel
from lambda_core.simulate import layout
from lambda_core.simulate.averages import INTEGRALS, FloatArray, spans
from lambda_core.simulate.checkpoint import Checkpoint
from lambda_core.simulate.provenance import Provenance
from lambda_core.simulate.status import Rows, Status


class DiskError(PartialResultError):
    """A result file cannot be written any further."""

    def __init__(self, path: Path, why: str) -> None:
        self.why = why
        super().__init__(
            f"cannot write {path}: {why}; what was written before is kept. "
            f"Make room, then continue with: lambda-bearing resume {path}"
        )


class ResultWriter:
    """Appends to one result file in SWMR mode (single writer, many readers).

    Rows gather in memory; `flush` puts them on disk and then says in ``/status`` how many
    there are, in this order, so that whatever the status counts is whole.
    """

    def __init__(self, file: h5py.File, path: Path, channels: Sequence[Channel], status: Status) -> None:
        self.path = path
        self._file = file
        self._channels = tuple(channels)
        self._written = status.rows
        self._samples: list[Mapping[str, NDArray[np.float64]]] = []
        self._records: list[FloatArray] = []
        self._revolutions: list[FloatArray] = []
        with self._guard():
            file.swmr_mode = True
        self._put_status(status)

    @classmethod
    def create(
        cls, path: Path, provenance: Provenance, channels: Sequence[Channel], status: Status, *, force: bool = False
    ) -> ResultWriter:
        """Create a result with everything but samples in it.

        Raises
        ------
        UsageError
            When the file exists and `force` is not set, or cannot be written.
        """
        file = _open_new(path, force)
        try:
            layout.create(file, provenance, channels)
            return cls(file, path, channels, status)
        except (OSError, RuntimeError, DiskError) as error:
            _detach(file)
            path.unlink(missing_ok=True)
            raise UsageError(f"cannot write {path}: {reason(error)}") from None

    @classmethod
    def continued(cls, path: Path, channels: Sequence[Channel], status: Status) -> ResultWriter:
        """Go on writing a result, from the rows that `status` counts; what came after them is dropped.

        The file is copied first: one whose writer was killed can be read, not written.
        """
        rewrite(path, status.rows, compress=False)
        return cls(h5py.File(path, "r+", libver="latest"), path, channels, status)

    def add(
        self, samples: Mapping[str, NDArray[np.float64]], record: FloatArray, revolutions: Sequence[FloatArray]
    ) -> None:
        """Take what one advance of the engine brought."""
        if samples and len(samples["time"]):
            self._samples.append(samples)
        self._records.append(record)
        self._revolutions.extend(revolutions)

    def pending(self) -> int:
        """Return how many samples wait in memory."""
        return sum(len(samples["time"]) for samples in self._samples)

    def written(self) -> Rows:
        """Return what was flushed."""
        return self._written

    def flush(self, status: Status) -> None:
        """Put everything on disk, then say so.

        Raises
        ------
        DiskError
            When the disk takes no more; what was there before stays readable.
        """
        with self._guard():
            self._append_samples()
            self._append_records()
            self._file.flush()
        self._put_status(status)

    def save(self, checkpoint: Checkpoint) -> None:
        """Put a checkpoint on disk, over the older of the two; flush the rows it counts before."""
        data = np.frombuffer(checkpoint.to_bytes(), dtype=np.uint8)
        with self._guard():
            slots = self._file[layout.SLOTS]
            if slots.shape[1] < data.size:
                slots.resize((2, data.size))
            slots[checkpoint.position.sequence % 2, : data.size] = data
            self._file.flush()

    def close(self, *, compress: bool) -> None:
        """Close the file; `compress` it where the disk has room for that."""
        with self._guard():
            self._file.close()
        if not self.path.exists():
            raise DiskError(self.path, "it was deleted or renamed during the run")
        if compress:
            try:
                rewrite(self.path, self._written, compress=True)
            except UsageError:
                # No room for a second copy or no right to make one: the result is complete as it is.
                return

    def _append_samples(self) -> None:
        if not self._samples:
            return
        start = self._written.samples
        count = self.pending()
        for channel in self._channels:
            values = np.concatenate([samples[channel.name] for samples in self._samples])
            _append(self._file[channel.name], start, values)
        self._written = replace(self._written, samples=start + count)
        self._samples.clear()

    def _append_records(self) -> None:
        for kind, group, rows in (
            ("records", self._file[layout.INTEGRALS_GROUP], self._records),
            ("revolutions", self._file[layout.REVOLUTIONS_GROUP], self._revolutions),
        ):
            if not rows:
                continue
            table = np.stack(rows)
            start = getattr(self._written, kind)
            for channel in INTEGRALS:
                data = group[channel.name]
                _append(data, start, table[:, spans()[channel.name]].reshape(-1, *data.shape[1:]))
            if kind == "revolutions":
                _append(group["revolution"], start, np.arange(start, start + len(rows), dtype=np.float64))
            self._written = replace(self._written, **{kind: start + len(rows)})
            rows.clear()

    def _put_status(self, status: Status) -> None:
        with self._guard():
            counted = replace(status, rows=self._written)
            self._file[layout.STATUS][()] = counted.to_bytes(layout.STATUS_BYTES)
            self._file.flush()

    @contextmanager
    def _guard(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError) as error:
            _detach(self._file)
            raise DiskError(self.path, reason(error)) from None


def rewrite(path: Path, rows: Rows, *, compress: bool) -> None:
    """Replace a result by a copy with the first `rows` rows, in one step.

    Raises
    ------
    UsageError
        When the copy cannot be written; the original is untouched.
    """
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    target: h5py.File | None = None
    try:
        with open_for_reading(path) as source:
            # SWMR needs the newest file format; for keeping, the oldest one is read by most programs.
            target = h5py.File(beside, "w", libver="earliest" if compress else "latest")
            layout.copy(source, target, rows, compress)
            target.close()
        os.replace(beside, path)
    except (OSError, RuntimeError) as error:
        if target is not None:
            _detach(target)
        beside.unlink(missing_ok=True)
        raise UsageError(f"cannot write beside {path}: {reason(error)}") from None


def open_for_reading(path: Path) -> h5py.File:
    """Open a result that is finished, being written, or left behind by a killed process."""
    try:
        return h5py.File(path, "r")
    except OSError:
        return h5py.File(path, "r", swmr=True)


def reason(error: Exception) -> str:
    """Return the system's words for what went wrong ("No space left on device")."""
    if isinstance(error, DiskError):
        return error.why
    code = error.errno if isinstance(error, OSError) else None
    found = re.search(r"errno = (\d+)", str(error))
    if found:
        code = int(found[1])
    if code:
        return os.strerror(code)
    return str(error).splitlines()[0] if str(error) else type(error).__name__


def _append(data: Any, start: int, values: NDArray[np.float64]) -> None:
    data.resize(start + len(values), axis=0)
    data[start:] = values.reshape(len(values), *data.shape[1:])


def _open_new(path: Path, force: bool) -> h5py.File:
    try:
        return h5py.File(path, "w" if force else "x", libver="latest")
    except FileExistsError:
        raise UsageError(f"{path} exists: choose another name with --out, or overwrite it with --force") from None
    except OSError as error:
        if error.errno == errno.EEXIST:
            raise UsageError(f"{path} exists: choose another name with --out, or overwrite it with --force") from None
        raise UsageError(f"cannot write {path}: {reason(error)}") from None


def _detach(file: h5py.File) -> None:
    """Close a file whose disk refuses writing, leaving on disk what is there.

    HDF5 writes again when it closes, fails again, and then crashes the process. Its
    descriptor is pointed to the null device first, where those last writes vanish.
    """
    if not file.id.valid:
        return
    null = os.open(os.devnull, os.O_RDWR)
    try:
        os.dup2(null, file.id.get_vfd_handle())
    finally:
        os.close(null)
    with suppress(OSError, RuntimeError):
        file.close()

"""Writing a result file while it is read, killed, or out of disk."""

from __future__ import annotations

import math
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import Channel
from lambda_core.domain.errors import PartialResultError, UsageError
from lambda_core.domain.files import check_target, taken
from lambda_core.results import file_format as layout
from lambda_core.results import hdf5
from lambda_core.results.averages import INTEGRALS, spans
from lambda_core.results.checkpoint import Checkpoint
from lambda_core.results.circuit_rows import CIRCUIT_GROUP, DISCHARGES_GROUP, CircuitRows
from lambda_core.results.event_rows import EVENTS_GROUP
from lambda_core.results.provenance import Provenance
from lambda_core.results.row_sums import RowSums, sums_of
from lambda_core.results.run_status import Rows, Status

# Bytes of chunks kept in memory per dataset: rows are only added at the end, HDF5's own 8 MiB would fill up in vain.
_CACHE = 2**17


class DiskError(PartialResultError):
    """A result file cannot be written any further."""

    def __init__(self, path: Path, why: str) -> None:
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
        self.path, self.closed = path, False
        self._file = file
        self._identity = _identity(Path(file.filename))
        self._channels = tuple(channels)
        self._status = status
        self._written = status.rows
        self._growing = {
            kind: {name: item for name, item in file[group].items() if layout.grows(item)}
            for kind, group in (
                ("samples", "/"),
                ("records", layout.INTEGRALS_GROUP),
                ("revolutions", layout.REVOLUTIONS_GROUP),
                ("circuit", CIRCUIT_GROUP),
                ("discharges", DISCHARGES_GROUP),
                ("events", EVENTS_GROUP),
            )
            if group in file
        }
        # What one more chunk of everything that grows together takes on disk.
        self._chunk = {kind: sum(map(layout.chunk_bytes, items.values())) for kind, items in self._growing.items()}
        self._samples: list[Mapping[str, NDArray[np.float64]]] = []
        self._records: list[FloatArray] = []
        self._revolutions: list[FloatArray] = []
        self._sums = RowSums()
        self._tables: dict[str, list[Mapping[str, FloatArray]]] = {"circuit": [], "discharges": [], "events": []}
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
        made = hdf5.beside(check_target(path))
        try:
            with h5py.File(made, "w", libver="latest") as file:
                hdf5.reserve(file, 0)
                layout.create(file, provenance, channels)
            # Under its name only when SWMR is on: from its first moment it can be read, whatever happens.
            writer = cls(h5py.File(made, "r+", libver="latest", rdcc_nbytes=_CACHE), path, channels, status)
            _publish(made, path, force)
            return writer
        except (OSError, RuntimeError) as error:
            made.unlink(missing_ok=True)
            raise UsageError(f"cannot write {path}: {hdf5.reason(error)}") from None

    @classmethod
    def continued(cls, path: Path, channels: Sequence[Channel], status: Status) -> ResultWriter:
        """Go on writing a result, from the rows that `status` counts; what came after them is dropped.

        The file is copied first: one whose writer was killed can be read, not written.
        """
        made = hdf5.copy(path, status.rows, compress=False)
        file = h5py.File(made, "r+", libver="latest", rdcc_nbytes=_CACHE)
        sums = sums_of(file, status.rows)
        writer = cls(file, path, channels, status)
        writer._sums = sums
        os.replace(made, path)
        return writer

    def add_samples(self, samples: Mapping[str, NDArray[np.float64]]) -> None:
        """Take samples, channel -> array."""
        if len(samples["time"]):
            self._samples.append(samples)

    def add_record(self, record: FloatArray, revolutions: Sequence[FloatArray]) -> None:
        """Take running integrals, and those at the cage revolutions that were completed since the last."""
        self._records.append(record)
        self._revolutions.extend(revolutions)

    def add_circuit(self, rows: CircuitRows) -> None:
        """Take what the electric circuit did."""
        for kind, table in (("circuit", rows.circuit), ("discharges", rows.discharges)):
            self._add_table(kind, table)

    def add_events(self, rows: Mapping[str, FloatArray]) -> None:
        """Take the events that began, columns of event_rows.EVENTS."""
        self._add_table("events", rows)

    def _add_table(self, kind: str, table: Mapping[str, FloatArray]) -> None:
        if len(table["time"]):
            self._tables[kind].append(table)

    def pending(self) -> int:
        """Return how many samples wait in memory."""
        return sum(len(samples["time"]) for samples in self._samples)

    def written(self) -> Rows:
        """Return what was flushed."""
        return self._written

    def sums(self) -> dict[str, int]:
        """Return the checksums of what was flushed, by path of the dataset."""
        return self._sums.by_name()

    def flush(self, status: Status) -> None:
        """Put everything on disk, then say so.

        Raises
        ------
        DiskError
            When the disk takes no more; what was there before stays readable.
        """
        self._reserve(self._growth())
        with self._guard():
            self._append_samples()
            self._append_records()
            self._append_tables()
            self._file.flush()
        self._put_status(status)

    def save(self, checkpoint: Checkpoint) -> None:
        """Put a checkpoint on disk, over the older of the two; flush the rows it counts before."""
        data = np.frombuffer(checkpoint.to_bytes(), dtype=np.uint8)
        self._reserve(4 * data.size)
        with self._guard():
            slots = self._file[layout.SLOTS]
            if slots.shape[1] < data.size:
                slots.resize((2, data.size))
            slots[checkpoint.position.sequence % 2, : data.size] = data
            self._file.flush()

    def close(self, *, compress: bool, stop: layout.Stop = layout.never) -> None:
        """Close the file; `compress` it where the disk has room for that, and nobody asks to `stop` on the way."""
        self.closed = True
        with self._guard():
            size = self._file.id.get_filesize()
            self._file.close()
        if _identity(self.path) != self._identity:
            raise PartialResultError(
                f"{self.path} was deleted, renamed or replaced during the run: its result no longer stands there"
            )
        if not compress:
            hdf5.trim(self.path, size)
            return
        try:
            os.replace(hdf5.copy(self.path, self._written, compress=True, stop=stop), self.path)
        except UsageError:
            # No room for a second copy, no right or no time to make one: the result is complete as it is.
            hdf5.trim(self.path, size)

    def _append_samples(self) -> None:
        if not self._samples:
            return
        start = self._written.samples
        count = self.pending()
        for channel in self._channels:
            values = np.concatenate([samples[channel.name] for samples in self._samples])
            self._append(self._growing["samples"][channel.name], start, values)
        self._written = replace(self._written, samples=start + count)
        self._samples.clear()

    def _append_records(self) -> None:
        for kind, rows in (("records", self._records), ("revolutions", self._revolutions)):
            if not rows:
                continue
            group = self._growing[kind]
            table = np.stack(rows)
            start = getattr(self._written, kind)
            for channel in INTEGRALS:
                data = group[channel.name]
                self._append(data, start, table[:, spans()[channel.name]].reshape(-1, *data.shape[1:]))
            if kind == "revolutions":
                self._append(group["revolution"], start, np.arange(start, start + len(rows), dtype=np.float64))
            self._written = replace(self._written, **{kind: start + len(rows)})
            rows.clear()

    def _append_tables(self) -> None:
        for kind, tables in self._tables.items():
            start = getattr(self._written, kind)
            count = sum(len(table["time"]) for table in tables)
            for name, data in self._growing[kind].items() if tables else ():
                self._append(data, start, np.concatenate([table[name] for table in tables]))
            self._written = replace(self._written, **{kind: start + count})
            tables.clear()

    def _append(self, data: Any, start: int, values: NDArray[np.float64]) -> None:
        data.resize(start + len(values), axis=0)
        data[start:] = values.reshape(len(values), *data.shape[1:])
        self._sums.add(data.name, values)

    def _put_status(self, status: Status) -> None:
        with self._guard():
            self._status = replace(status, rows=self._written)
            self._file[layout.STATUS][()] = self._status.to_bytes(layout.STATUS_BYTES)
            self._file.flush()

    def _growth(self) -> int:
        """Return the bytes of the chunks that the waiting rows will open."""
        waiting = {"samples": self.pending(), "records": len(self._records), "revolutions": len(self._revolutions)}
        waiting |= {kind: sum(len(table["time"]) for table in tables) for kind, tables in self._tables.items()}
        total = 0
        for kind, count in waiting.items():
            start = getattr(self._written, kind)
            opened = math.ceil((start + count) / layout.ROWS) - math.ceil(start / layout.ROWS)
            total += opened * self._chunk.get(kind, 0)
        return total

    def _reserve(self, growth: int) -> None:
        """Make sure of room; without it close the result as it is, in order and readable."""
        try:
            hdf5.reserve(self._file, growth)
        except OSError as error:
            full = DiskError(self.path, hdf5.reason(error))
            self._put_status(replace(self._status, state="interrupted", message=str(full)))
            self.close(compress=False)
            raise full from None

    @contextmanager
    def _guard(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError) as error:
            raise DiskError(self.path, hdf5.reason(error)) from None


def _identity(path: Path) -> tuple[int, int] | None:
    """Return what tells a file from another that takes its name, None where there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _publish(made: Path, path: Path, force: bool) -> None:
    """Give a complete file its name; a link refuses a taken one in the same step."""
    try:
        if force:
            os.replace(made, check_target(path))
        else:
            os.link(made, path)
            made.unlink()
    except FileExistsError:
        made.unlink()
        raise taken(path) from None

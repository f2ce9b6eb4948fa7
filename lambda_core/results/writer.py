"""Write a result file during a run.

It may be read or killed, and the disk may be full.
"""

from __future__ import annotations

import contextlib
import math
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import PartialResultError, UsageError
from lambda_core.domain.files import check_target, taken
from lambda_core.domain.processes import ON_WINDOWS
from lambda_core.results import file_format as layout
from lambda_core.results import hdf5
from lambda_core.results.averages import INTEGRALS, spans
from lambda_core.results.checkpoint import Checkpoint
from lambda_core.results.circuit_rows import CIRCUIT_GROUP, DISCHARGES_GROUP, CircuitRows
from lambda_core.results.event_rows import EVENTS_GROUP
from lambda_core.results.objects import datasets, grows, put_rows
from lambda_core.results.provenance import Provenance
from lambda_core.results.row_sums import RowSums, sums_of
from lambda_core.results.run_status import Rows, Status
from lambda_core.results.samples import TIME, RunChannels, Samples

_SAMPLES, _MACHINE, _CIRCUIT, _DISCHARGES = "", layout.MACHINE, CIRCUIT_GROUP, DISCHARGES_GROUP  # places in the file


class DiskError(PartialResultError):
    """A result file cannot be written any further."""

    def __init__(self, path: Path, why: str) -> None:
        super().__init__(
            f"cannot write {path}: {why}; earlier results are kept. "
            f"Make room, then continue with: lambda-bearing resume {path}"
        )


class ResultWriter:
    """Writer of one result in SWMR mode.

    Single writer, many readers; it appends.

    Rows gather in memory; `flush` puts them on disk and then says in ``/status`` how many
    there are, in this order, so that whatever the status counts is whole.
    """

    def __init__(self, file: h5py.File, path: Path, status: Status) -> None:
        self.path, self.closed = path, False
        self._file = file
        self._identity = _identity(Path(file.filename))
        self._status = status
        self._written = status.rows
        self._bearings = layout.bearing_names(file)
        groups = {_SAMPLES: "/", _MACHINE: layout.MACHINE, _CIRCUIT: CIRCUIT_GROUP, _DISCHARGES: DISCHARGES_GROUP}
        own = ("", layout.INTEGRALS_GROUP, layout.REVOLUTIONS_GROUP, EVENTS_GROUP)
        paths = [f"{layout.BEARINGS}/{name}/{group}".rstrip("/") for name in self._bearings for group in own]
        groups |= {path: path for path in paths}
        self._growing = {
            key: {name: data for name, data in datasets(file[group]).items() if grows(data)}
            for key, group in groups.items()
            if group in file
        }
        self._growing[_SAMPLES] = {TIME: file[TIME].id}  # the only bearing's channels are linked there, too
        # What one more chunk of everything that grows together takes on disk.
        self._chunk = {
            key: layout.NEW_ROWS * sum(map(layout.row_bytes, items.values())) for key, items in self._growing.items()
        }
        self._samples: list[Samples] = []
        self._records: list[Mapping[str, FloatArray]] = []
        self._revolutions: dict[str, list[FloatArray]] = {name: [] for name in self._bearings}
        self._sums = RowSums()
        tables = (_CIRCUIT, _DISCHARGES, *(self._place(name, EVENTS_GROUP) for name in self._bearings))
        self._tables: dict[str, list[Mapping[str, FloatArray]]] = {key: [] for key in tables}
        with self._guard():
            file.swmr_mode = True
        self._put_status(status)

    @classmethod
    def create(
        cls, path: Path, provenance: Provenance, channels: RunChannels, status: Status, *, overwrite: bool = False
    ) -> ResultWriter:
        """Create a result with everything but samples in it.

        Raises
        ------
        UsageError
            When the file exists and `overwrite` is not set, or cannot be written.
        """
        made = hdf5.sibling_path(check_target(path))
        try:
            with h5py.File(made, "w", libver="latest") as file:
                hdf5.reserve(file, 0)
                layout.create(file, provenance, channels)
            if ON_WINDOWS:  # no file can be renamed there while it is open
                _publish(made, path, overwrite)
                return cls(_growing(path), path, status)
            # Under its name only when SWMR is on: from its first moment it can be read, whatever happens.
            writer = cls(_growing(made), path, status)
            _publish(made, path, overwrite)
            return writer
        except (OSError, RuntimeError) as error:
            made.unlink(missing_ok=True)
            raise UsageError(f"cannot write {path}: {hdf5.reason(error)}") from None

    @classmethod
    def continued(cls, path: Path, status: Status, kept: Rows) -> ResultWriter:
        """Go on writing a result.

        Behind the rows that `status` counts.

        The file is copied first: one whose writer was killed can be read, not written. `kept` are the rows that come
        along, those that the checksums of the checkpoint stand for; what came after them is dropped. Rows behind those
        of `status` are written over.
        """
        made = hdf5.copy(path, kept, compress=False)
        if ON_WINDOWS:
            os.replace(made, path)
            made = path
        file = _growing(made)
        sums = sums_of(file, status.rows)
        writer = cls(file, path, status)
        writer._sums = sums
        if made != path:
            os.replace(made, path)
        return writer

    def add_samples(self, samples: Samples) -> None:
        """Take samples."""
        if len(samples.time):
            self._samples.append(samples)

    def add_record(self, record: Mapping[str, FloatArray], revolutions: Mapping[str, Sequence[FloatArray]]) -> None:
        """Take running integrals by bearing.

        Also take those at the cage revolutions that were completed since the last record.
        """
        self._records.append(record)
        for name, rows in revolutions.items():
            self._revolutions[name].extend(rows)

    def add_circuit(self, rows: CircuitRows) -> None:
        """Take what the electric circuit did."""
        for key, table in ((_CIRCUIT, rows.circuit), (_DISCHARGES, rows.discharges)):
            self._add_table(key, table)

    def add_events(self, bearing: str, rows: Mapping[str, FloatArray]) -> None:
        """Take the events that began, columns of event_rows.EVENTS."""
        self._add_table(self._place(bearing, EVENTS_GROUP), rows)

    def _add_table(self, key: str, table: Mapping[str, FloatArray]) -> None:
        if len(table["time"]):
            self._tables[key].append(table)

    def pending(self) -> int:
        """Return how many samples wait in memory."""
        return sum(len(samples.time) for samples in self._samples)

    def written(self) -> Rows:
        """Return what was flushed."""
        return self._written

    def sums(self) -> dict[str, int]:
        """Return the checksums of flushed data.

        The keys are paths of datasets.
        """
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
        """Put a checkpoint on disk.

        It replaces the older of the two. The rows that it counts are flushed before.
        """
        data = np.frombuffer(checkpoint.to_bytes(), dtype=np.uint8)
        self._reserve(4 * data.size)
        with self._guard():
            slots = self._file[layout.SLOTS]
            if slots.shape[1] < data.size:
                slots.resize((2, data.size))
            slots[checkpoint.position.sequence % 2, : data.size] = data
            self._file.flush()

    def close(self, *, compress: bool, stop: layout.Stop = layout.never) -> None:
        """Close the file.

        `compress` it where the disk has room for that, and nobody asks to `stop` on the way.
        """
        self.closed = True
        with self._guard():
            size = self._file.id.get_filesize()
            self._file.close()
        if _identity(self.path) != self._identity:
            raise PartialResultError(
                f"{self.path} was deleted, renamed or replaced during the run: the result is no longer there"
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
        stretches = self._samples
        self._append(_SAMPLES, TIME, start, np.concatenate([one.time for one in stretches]))
        for name in self._growing.get(_MACHINE, {}):
            self._append(_MACHINE, name, start, np.concatenate([one.machine[name] for one in stretches]))
        for bearing in self._bearings:
            place = self._place(bearing)
            for name in self._growing[place]:
                self._append(place, name, start, np.concatenate([one.bearings[bearing][name] for one in stretches]))
        self._written = replace(self._written, samples=start + self.pending())
        self._samples.clear()

    def _append_records(self) -> None:
        if self._records:
            start = self._written.records
            for bearing in self._bearings:
                table = np.stack([record[bearing] for record in self._records])
                self._append_integrals(self._place(bearing, layout.INTEGRALS_GROUP), start, table)
            self._written = replace(self._written, records=start + len(self._records))
            self._records.clear()
        for bearing, rows in self._revolutions.items():
            if not rows:
                continue
            place, start = self._place(bearing, layout.REVOLUTIONS_GROUP), self._written.revolutions.get(bearing, 0)
            self._append_integrals(place, start, np.stack(rows))
            self._append(place, "revolution", start, np.arange(start, start + len(rows), dtype=np.float64))
            counts = {**self._written.revolutions, bearing: start + len(rows)}
            self._written = replace(self._written, revolutions=counts)
            rows.clear()

    def _append_integrals(self, place: str, start: int, table: FloatArray) -> None:
        for channel in INTEGRALS:
            self._append(place, channel.name, start, table[:, spans()[channel.name]])

    def _append_tables(self) -> None:
        for key, tables in self._tables.items():
            if not tables:
                continue
            start = layout.rows_of(f"{key}/time", self._written)
            count = sum(len(table["time"]) for table in tables)
            for name in self._growing[key]:
                self._append(key, name, start, np.concatenate([table[name] for table in tables]))
            if key == _CIRCUIT:
                self._written = replace(self._written, circuit=start + count)
            elif key == _DISCHARGES:
                self._written = replace(self._written, discharges=start + count)
            else:
                bearing = key.split("/")[1]
                self._written = replace(self._written, events={**self._written.events, bearing: start + count})
            tables.clear()

    def _append(self, place: str, name: str, start: int, values: NDArray[np.float64]) -> None:
        data = self._growing[place][name]
        shape = (start + len(values), *data.shape[1:])
        data.set_extent(shape)
        put_rows(data, start, values.reshape(len(values), *shape[1:]))
        self._sums.add(f"{place}/{name}".lstrip("/"), values)

    def _place(self, bearing: str, group: str = "") -> str:
        """Return where a bearing's rows stand in the file."""
        return f"{layout.BEARINGS}/{bearing}/{group}".rstrip("/")

    def _put_status(self, status: Status) -> None:
        with self._guard():
            self._status = replace(status, rows=self._written)
            self._file[layout.STATUS][()] = self._status.to_bytes(layout.STATUS_BYTES)
            self._file.flush()

    def _growth(self) -> int:
        """Return the bytes of new chunks.

        The waiting rows will open them.
        """
        samples, records = self.pending(), len(self._records)
        waiting = {_SAMPLES: samples, _MACHINE: samples}
        for bearing, rows in self._revolutions.items():
            waiting |= {self._place(bearing): samples, self._place(bearing, layout.INTEGRALS_GROUP): records}
            waiting[self._place(bearing, layout.REVOLUTIONS_GROUP)] = len(rows)
        waiting |= {key: sum(len(table["time"]) for table in tables) for key, tables in self._tables.items()}
        total = 0
        for key, count in waiting.items():
            start = layout.rows_of(f"{key}/{TIME}", self._written)
            opened = math.ceil((start + count) / layout.NEW_ROWS) - math.ceil(start / layout.NEW_ROWS)
            total += opened * self._chunk.get(key, 0)
        return total

    def _reserve(self, growth: int) -> None:
        """Make sure of room.

        Without it, close the result as it is, in order and readable.
        """
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
            broken = DiskError(self.path, hdf5.reason(error))
            self._give_up(str(broken))
            raise broken from None

    def _give_up(self, message: str) -> None:
        """Leave the file after a failed write.

        Write the failure in it where this is possible, and close it.
        """
        self.closed = True
        with contextlib.suppress(OSError, RuntimeError, ValueError):
            left = replace(self._status, rows=self._written, state="interrupted", message=message)
            self._file[layout.STATUS][()] = left.to_bytes(layout.STATUS_BYTES)
            self._file.flush()
        with contextlib.suppress(OSError, RuntimeError, ValueError):
            self._file.close()


def _identity(path: Path) -> tuple[int, int] | None:
    """Return the identity of a file.

    It differs from that of another that takes its name; None where there is none.
    """
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _growing(path: Path) -> h5py.File:
    """Open a file to add rows."""
    return h5py.File(path, "r+", libver="latest", rdcc_nbytes=hdf5.CACHE)


def _publish(made: Path, path: Path, overwrite: bool) -> None:
    """Give a complete file its name.

    A link refuses a taken one in the same step; sticks and shares often have no links.
    """
    if overwrite:
        os.replace(made, check_target(path))
        return
    try:
        os.link(made, path)
        made.unlink()
    except FileExistsError:
        made.unlink()
        raise taken(path) from None
    except OSError:
        if path.exists():
            raise
        os.replace(made, path)

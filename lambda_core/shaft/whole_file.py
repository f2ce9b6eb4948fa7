"""The result of a shaft in motion: a folder with the whole in shaft.h5, and a result of its own for every bearing."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import Channel
from lambda_core.domain.errors import UsageError
from lambda_core.domain.printable import printable
from lambda_core.results.checkpoint import Checkpoint, latest
from lambda_core.results.file_format import STATUS_BYTES, part_of
from lambda_core.results.hdf5 import beside, open_for_reading, reason
from lambda_core.results.opening import ResultError
from lambda_core.results.reader import Result
from lambda_core.results.run_status import Rows, Status
from lambda_core.results.writer import DiskError

WHOLE = "shaft.h5"
LAYOUT, _ATTRIBUTE = 2, "lambda_bearing_shaft_layout"
_ROWS, _SLOT = 1024, 65536
NAMED = {"bearings": "bearing", "bodies": "body", "markers": "marker"}  # lists of names, and their dimensions
CHANNELS = (
    Channel("time", (), "s", "time"),
    Channel("shaft_position", ("lump", "axis"), "m", "displacement of the shaft at every lump"),
    Channel("shaft_tilt", ("lump", "tilt"), "rad", "tilt of the shaft at every lump about y and z"),
    Channel("shaft_twist", ("lump",), "rad", "turn of the shaft at every lump beyond that of the coupling"),
    Channel("body_position", ("body", "axis"), "m", "displacement of every other body"),
    Channel("body_tilt", ("body", "axis"), "rad", "rotation of every other body about x, y and z"),
    Channel("marker_position", ("marker", "axis"), "m", "displacement of every named place"),
    Channel("reaction_force", ("bearing", "axis"), "N", "force of every bearing on the shaft"),
    Channel("reaction_moment", ("bearing", "axis"), "N m", "moment of every bearing on the shaft about its centre"),
    Channel("power_loss", (), "W", "power that all bearings dissipate"),
)


class WholeWriter:
    """Appends samples of the whole to its file, which can be read meanwhile (single writer, many readers)."""

    def __init__(self, path: Path, file: h5py.File, rows: int) -> None:
        self.path, self.rows, self._file, self.closed = path, rows, file, False
        self._waiting: list[Mapping[str, FloatArray]] = []
        file.swmr_mode = True

    @classmethod
    def create(
        cls, path: Path, texts: Mapping[str, str], arrays: Mapping[str, Any], names: Mapping[str, list[str]]
    ) -> WholeWriter:
        """Create the file; `arrays` has places [m] of the lumps and the bearings, `names` those of NAMED."""
        made = beside(path)  # under its name once it can be read: a kill leaves no half of it
        file = h5py.File(made, "w", libver="latest")
        file.attrs[_ATTRIBUTE] = LAYOUT
        file.attrs["created"] = datetime.now(UTC).isoformat(timespec="seconds")
        for name, text in texts.items():
            file.attrs[name] = text
        for name, values in arrays.items():
            file.create_dataset(name, data=values)
        for what in NAMED:
            file.create_dataset(what, data=np.array(names[what], dtype=object), dtype=h5py.string_dtype())
        sizes = {"lump": len(arrays["lump_positions"]), "axis": 3, "tilt": 2}
        sizes |= {dim: len(names[what]) for what, dim in NAMED.items()}
        for channel in CHANNELS:
            shape = tuple(sizes[dim] for dim in channel.dims)
            if 0 in shape:
                continue
            data = file.create_dataset(
                channel.name, (0, *shape), np.float64, maxshape=(None, *shape), chunks=(_ROWS, *shape),
                compression="gzip", shuffle=True,
            )  # fmt: skip
            data.attrs["units"], data.attrs["long_name"] = channel.unit, channel.meaning
        file.create_dataset("slots", (2, 0), np.uint8, maxshape=(2, None), chunks=(1, _SLOT))
        file.create_dataset("status", (), f"S{STATUS_BYTES}")
        writer = cls(path, file, 0)
        os.replace(made, path)
        return writer

    @classmethod
    def continued(cls, path: Path, rows: int) -> WholeWriter:
        """Go on behind the first `rows` samples; what came after them is dropped.

        The file is copied first: one whose writer was killed can be read, not written.
        """
        made, sampled = beside(path), {channel.name for channel in CHANNELS}
        try:
            with open_for_reading(path) as source, h5py.File(made, "w", libver="latest") as target:
                target.attrs.update(source.attrs)
                for name, data in source.items():
                    values = data[:rows] if name in sampled else data[()]
                    copied = target.create_dataset_like(name, data, shape=np.shape(values), data=values)
                    copied.attrs.update(data.attrs)
            os.replace(made, path)
        except (OSError, RuntimeError, KeyError, ValueError) as error:
            made.unlink(missing_ok=True)
            raise UsageError(f"cannot write a copy of {path} in its folder: {reason(error)}") from None
        return cls(path, h5py.File(path, "r+", libver="latest"), rows)

    def add(self, samples: Mapping[str, FloatArray]) -> None:
        """Take samples."""
        self._waiting.append(samples)

    def flush(self, status: Status, rows: Rows) -> None:
        """Put everything on disk, then say so."""
        with self._guard():
            for channel in (c for c in CHANNELS if self._waiting and c.name in self._file):
                values = np.concatenate([samples[channel.name] for samples in self._waiting])
                data = self._file[channel.name]
                data.resize(self.rows + len(values), axis=0)
                data[self.rows :] = values
            self.rows += sum(len(samples["time"]) for samples in self._waiting)
            self._waiting.clear()
            self._file.flush()
            counted = Rows(self.rows, rows.records, rows.revolutions)
            self._file["status"][()] = Status(**{**vars(status), "rows": counted}).to_bytes(STATUS_BYTES)
            self._file.flush()

    def save(self, checkpoint: Checkpoint) -> None:
        """Put a checkpoint on disk, over the older of the two."""
        data = np.frombuffer(checkpoint.to_bytes(), dtype=np.uint8)
        with self._guard():
            slots = self._file["slots"]
            if slots.shape[1] < data.size:
                slots.resize((2, data.size))
            slots[checkpoint.position.sequence % 2, : data.size] = data
            self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self.closed = True
        with self._guard():
            self._file.close()

    @contextmanager
    def _guard(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError) as error:
            raise DiskError(self.path, reason(error)) from None


class WholeFile:
    """Reads the file of the whole.

    Parameters
    ----------
    path : path-like
        The folder of a run, or the file in it.
    """

    def __init__(self, path: str | Path) -> None:
        given = Path(path)
        self.path = given / WHOLE if given.is_dir() else given
        with self._opened() as file:
            self.case, self.case_toml, self.code = (
                printable(str(file.attrs[name])) for name in ("case", "case_toml", "code")
            )
            self.speed, self.drive_torque = float(file.attrs["speed"]), float(file.attrs["drive_torque"])
            # Results of old have none.
            self.run, warnings = (printable(str(file.attrs.get(name, ""))) for name in ("run", "warnings"))
            self.warnings = warnings.splitlines()
            names = {what: [printable(n) for n in file[what].asstr()[()]] if what in file else [] for what in NAMED}
            self.bearings, self.bodies, self.markers = names["bearings"], names["bodies"], names["markers"]
            self.lump_positions = np.asarray(file["lump_positions"])
            self.bearing_positions = np.asarray(file["bearing_positions"])

    @property
    def folder(self) -> Path:
        """Where the results of the bearings lie."""
        return self.path.parent

    def bearing(self, name: str) -> Path:
        """Return the result of a bearing."""
        return self.folder / f"{name}.h5"

    def results(self) -> dict[str, Result]:
        """Return the result of every bearing by name.

        Raises
        ------
        ResultError
            When one is missing, damaged, or of another bearing or run.
        """
        found = {name: Result(self.bearing(name)) for name in self.bearings}
        for name, result in found.items():
            run, bearing = result.part_of or ("", "")
            if self.run and run != self.run:
                raise ResultError(f"{result.path} belongs to another run than {self.path}")
            if self.run and bearing != name:
                raise ResultError(f'{result.path} is the result of "{bearing}", not of "{name}": it was renamed')
        return found

    def status(self) -> Status:
        """Return what the run has reached."""
        with self._opened() as file:
            return Status.from_bytes(file["status"][()])

    def channels(self, start: float = 0.0) -> dict[str, NDArray[np.float64]]:
        """Return every channel that there is from time `start` [s] on, first axis is time."""
        with self._opened() as file:
            rows = Status.from_bytes(file["status"][()]).rows.samples
            first = int(np.searchsorted(file["time"][:rows], start))
            return {c.name: np.asarray(file[c.name][first:rows]) for c in CHANNELS if c.name in file}

    def checkpoint(self) -> Checkpoint | None:
        """Return the newest whole checkpoint."""
        with self._opened() as file:
            return latest(slot.tobytes() for slot in file["slots"][()])

    @contextmanager
    def _opened(self) -> Iterator[h5py.File]:
        if not self.path.is_file():
            raise ResultError(f"{self.path} does not exist: no run of a shaft lies there")
        try:
            file = open_for_reading(self.path)
        except (OSError, RuntimeError, KeyError) as error:
            raise ResultError(f"{self.path} cannot be read: {reason(error)}") from None
        with file:
            if file.attrs.get(_ATTRIBUTE) != LAYOUT:
                raise ResultError(f"{self.path} is no run of a shaft that this program reads")
            try:
                yield file
            except (KeyError, OSError, RuntimeError, ValueError) as error:
                raise ResultError(f"{self.path} is damaged: {error}") from None


def earlier_files(folder: Path, bearings: Collection[str]) -> list[Path]:
    """Return the files of an earlier run that a run of these bearings replaces.

    These are the whole's file, the results of bearings that it names, and those that the new run writes.

    Raises
    ------
    UsageError
        Where the new run would overwrite a file that no run of a shaft has written.
    """
    written = (folder / WHOLE, *(folder / f"{name}.h5" for name in bearings))
    found = [path for path in written if path.exists()]
    for path in found:
        if _mark(path) is None:
            raise UsageError(
                f"{path} was not written by a run of a shaft and is not overwritten: "
                "move it, or choose another folder with --out"
            )
    with suppress(ResultError):  # none there, or one of another layout
        old = WholeFile(folder)
        others = [name for name in old.bearings if name not in bearings]
        found += [old.bearing(name) for name in others if _mark(old.bearing(name)) == (old.run, name)]
    return found


def _mark(path: Path) -> tuple[str, str] | None:
    """Return the run and the bearing that a file is of, both empty for a whole's; None for any other file."""
    with suppress(OSError, RuntimeError, KeyError), open_for_reading(path) as file:
        return ("", "") if _ATTRIBUTE in file.attrs else part_of(file)
    return None


def is_whole(path: str | Path) -> bool:
    """Tell whether a path is the folder of a shaft's run, or its file."""
    given = Path(path)
    return (given / WHOLE).is_file() if given.is_dir() else given.is_file() and given.name == WHOLE

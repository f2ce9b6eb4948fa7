"""Open, copy and write HDF5 files safely."""

from __future__ import annotations

import contextlib
import ctypes
import glob
import os
import re
import shutil
from pathlib import Path

import h5py

from lambda_core.domain.errors import UsageError
from lambda_core.domain.processes import exists
from lambda_core.results import file_format as layout
from lambda_core.results.integrity import is_cut
from lambda_core.results.run_status import Rows

_LOOKS = 24  # pauses of 1 ns and twice as long each time: 17 ms in all, a writer takes less
METADATA = 1 << 20  # more than HDF5 needs for indexes and headers at a time [byte]
# Bytes of chunks kept in memory per dataset of a file that is written: rows are only added at its end, and HDF5's own
# 8 MiB would fill up in vain.
CACHE = 2**17


def open_for_reading(path: Path, cache: int | None = None) -> h5py.File:
    """Open a result for reading.

    It is finished, being written, or left behind by a killed process. `cache` are the bytes of chunks kept in memory
    per dataset, by default HDF5's own 8 MiB.
    """
    try:
        return h5py.File(path, "r", rdcc_nbytes=cache)
    except (OSError, RuntimeError):
        if path.is_file() and is_cut(path):
            raise OSError("it is truncated: its end is missing") from None
        access = h5py.h5p.create(h5py.h5p.FILE_ACCESS)
        access.set_libver_bounds(h5py.h5f.LIBVER_EARLIEST, h5py.h5f.LIBVER_LATEST)
        if cache is not None:
            unused, slots, _, kept = access.get_cache()
            access.set_cache(unused, slots, cache, kept)
        _look_again(access, _LOOKS)
        flags = h5py.h5f.ACC_RDONLY | h5py.h5f.ACC_SWMR_READ
        return h5py.File(h5py.h5f.open(os.fsencode(path), flags, fapl=access))


def _look_again(access: h5py.h5p.PropFAID, times: int) -> None:
    """Limit the repeated reads of HDF5.

    Another process may be writing what it reads.

    Its own hundred times, with a pause that doubles, take longer than anybody lives when the place is damaged. h5py
    has no call for it, so the library behind h5py is asked; where it cannot be, as on Windows, the hundred stay.
    """
    with contextlib.suppress(OSError, AttributeError):
        ask = ctypes.CDLL(h5py.h5p.__file__).H5Pset_metadata_read_attempts
        ask.argtypes = [ctypes.c_int64, ctypes.c_uint]
        ask(access.id, times)


def reserve(file: h5py.File, growth: int) -> None:
    """Take `growth` bytes on disk.

    They are for the next writes.

    HDF5 crashes the process when a write fails that it had put off. So the disk is asked
    first, and a full one is found while everything in memory is still in order.

    Raises
    ------
    OSError
        When the disk, a quota or a limit of file size has no room.
    """
    end, needed = file.id.get_filesize(), growth + METADATA
    if hasattr(os, "posix_fallocate"):
        os.posix_fallocate(file.id.get_vfd_handle(), end, needed)
    elif shutil.disk_usage(Path(file.filename).parent).free < needed:
        raise OSError(28, os.strerror(28))


def sibling_path(path: Path) -> Path:
    """Return a hidden name in the same folder.

    It belongs to this process; those of dead ones are removed.
    """
    sweep(path.absolute().parent, glob.escape(path.name))
    return path.with_name(f".{path.name}.{os.getpid()}")


def sweep(folder: Path, name: str = "*.h5") -> None:
    """Remove half-made files of killed processes.

    It removes only names of :func:`sibling_path` in a folder.
    """
    for old in folder.glob(f".{name}.*"):
        number = old.name.rpartition(".")[2]
        if number.isdecimal() and not exists(int(number)) and not old.is_dir():
            old.unlink(missing_ok=True)


def trim(path: Path, size: int) -> None:
    """Release the reserved space of a file.

    It is past the end; the file is closed.
    """
    if path.stat().st_size > size:
        os.truncate(path, size)


def copy(path: Path, rows: Rows, *, compress: bool, stop: layout.Stop = layout.never) -> Path:
    """Copy a result into its own folder.

    The copy has the first `rows` rows; return its path. `stop` is asked on the way.

    Raises
    ------
    UsageError
        When the copy cannot be written, or `stop` said so.
    """
    made = sibling_path(path)
    try:
        with open_for_reading(path, CACHE) as source:
            # SWMR needs the newest file format; for keeping, the oldest one is read by most programs.
            version = "earliest" if compress else "latest"
            with h5py.File(made, "w", libver=version, rdcc_nbytes=CACHE) as target:
                originals = layout.objects(source)
                reserve(target, layout.size(originals, rows))
                target.attrs.update(source.attrs)
                layout.copy(originals, target, rows, compress, stop)
                target.flush()
                size = target.id.get_filesize()
            trim(made, size)
        return made
    except KeyboardInterrupt:
        made.unlink(missing_ok=True)
        raise
    except Exception as error:  # a garbled file misleads h5py into errors of every kind
        made.unlink(missing_ok=True)
        raise UsageError(f"cannot write a copy of {path} in its folder: {reason(error)}") from None


def reason(error: Exception) -> str:
    """Return the system's words for an error.

    An example is "No space left on device".
    """
    while isinstance(error, SystemError) and isinstance(error.__cause__, Exception):
        error = error.__cause__  # what h5py meant to raise
    code = error.errno if isinstance(error, OSError) else None
    found = re.search(r"errno = (\d+)", str(error))
    if found:
        code = int(found[1])
    if code:
        return os.strerror(code)
    text = str(error.args[0] if isinstance(error, KeyError) and error.args else error)  # whose str has quotes
    return text.splitlines()[0] if text else type(error).__name__

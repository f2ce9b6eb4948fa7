"""Read files of reduced bodies.

The formats are JSON, NumPy's .npz, HDF5, and TOML that names a CSV file for every matrix.
"""

from __future__ import annotations

import csv
import io
import json
import lzma
import tokenize
import tomllib
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from lambda_core.domain.errors import CaseError, Problem
from lambda_core.domain.files import read_bytes, read_text

MATRICES = ("stiffness", "mass", "gyroscopic", "damping")
_LARGEST = 512 * 2**20  # [byte] of a file
_MOST = 2**26  # numbers in one matrix, 8192 rows: more cannot be reduced to eigenvalues in a sensible time
_HEADER = 2**16  # [byte] that NumPy writes in front of the numbers, at most
# What the readers raise for files that are damaged, cut off or of another kind.
_FAULTS = (
    ValueError, OSError, EOFError, LookupError, ArithmeticError, RuntimeError, TypeError, SyntaxError,
    zipfile.BadZipFile, zlib.error, lzma.LZMAError, tokenize.TokenError,
)  # fmt: skip


def contents(path: Path) -> dict[str, Any]:
    """Return what stands in a file, by name.

    Raises
    ------
    CaseError
        With what is wrong, for a file that cannot be read, is of another kind, damaged or too large.
    """
    readers: dict[str, tuple[str, Callable[[bytes], Any]]] = {
        ".json": ("JSON", lambda content: json.loads(content.decode("utf-8-sig"))),
        ".npz": ("a file of np.savez", _of_npz),
        ".h5": ("HDF5", _of_hdf5),
        ".hdf5": ("HDF5", _of_hdf5),
        ".toml": ("TOML", lambda content: _of_toml(content.decode("utf-8-sig"), path.parent)),
    }
    if path.suffix.lower() not in readers:
        raise _wrong(path, f"must have a name that ends in {', '.join(readers)}")
    kind, read = readers[path.suffix.lower()]
    try:
        content = read_bytes(path, _LARGEST)
    except OSError as error:
        raise _wrong(path, f"cannot be read: {_reason(error)}") from None
    try:
        data = read(content)
    except CaseError as error:
        raise CaseError(path.name, error.problems) from None
    except MemoryError:
        raise _wrong(path, "is larger than the memory of this machine") from None
    except _FAULTS:
        raise _wrong(path, f"is not {kind}, or damaged") from None
    if not isinstance(data, dict):
        raise _wrong(path, "must be one object with nodes, stiffness and mass")
    return data


def _wrong(path: Path, message: str) -> CaseError:
    return CaseError(path.name, [Problem("", message)])


def _reason(error: OSError) -> str:
    if isinstance(error, FileNotFoundError):
        return "no such file"
    if isinstance(error, IsADirectoryError):
        return "it is a folder, not a regular file"
    words = error.strerror or "no file"
    return words[:1].lower() + words[1:]


def _check_size(name: str, numbers: int) -> None:
    """Refuse an array by its header.

    No memory has been taken for it yet.
    """
    if numbers > _MOST:
        raise CaseError("", [Problem(name, f"has {numbers} numbers, at most {_MOST} are read: reduce the model")])


def _of_npz(content: bytes) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for member in zipfile.ZipFile(io.BytesIO(content)).infolist():
        _check_size(member.filename.removesuffix(".npy"), (member.file_size - _HEADER) // 8)
    with np.load(io.BytesIO(content), allow_pickle=False) as file:
        for name in file.files:
            try:
                array = np.asarray(file[name])
            except ValueError:
                raise CaseError("", [Problem(name, "is damaged, or holds objects of Python: write numbers")]) from None
            found[name] = array.item() if array.ndim == 0 else array
    return found


def _of_hdf5(content: bytes) -> dict[str, Any]:
    import h5py

    found: dict[str, Any] = {}
    with h5py.File(io.BytesIO(content), "r") as file:
        for name, data in (*file.items(), *file.attrs.items()):
            if isinstance(data, h5py.Dataset):
                _check_size(str(name), data.size or 0)
            value = data[()] if isinstance(data, h5py.Dataset) else data
            if isinstance(value, h5py.Group):
                continue
            plain = np.asarray(value)
            if plain.dtype.kind in "SO":
                plain = np.array([one.decode() if isinstance(one, bytes) else str(one) for one in plain.ravel()])
                value = plain if np.ndim(value) else str(plain[0])
            found[str(name)] = value
    return found


def _of_toml(text: str, folder: Path) -> dict[str, Any]:
    """Return the tables of a TOML file.

    A name in place of a matrix is that of a CSV file in its folder.
    """
    found = tomllib.loads(text)
    for name in ("nodes", *MATRICES):
        if isinstance(found.get(name), str):
            try:
                rows = _of_csv(folder / found[name])
            except (OSError, ValueError) as error:
                reason = f"cannot be read: {_reason(error)}" if isinstance(error, OSError) else str(error)
                raise CaseError("", [Problem(name, f'"{found[name]}" {reason}')]) from None
            column = name == "nodes" and all(len(row) == 1 for row in rows)
            found[name] = [row[0] for row in rows] if column else rows
    return found


def _of_csv(path: Path) -> list[list[float]]:
    """Return the numbers of a CSV file.

    A failure raises an OSError or a ValueError that explains it.
    """
    try:
        reader = csv.reader(io.StringIO(read_text(path, _LARGEST), newline=""))
    except UnicodeDecodeError:
        raise ValueError("is not text in UTF-8") from None
    try:
        return [[float(cell) for cell in row] for row in reader if row]
    except (csv.Error, ValueError) as error:
        raise ValueError(f"line {reader.line_num}: {error}") from None

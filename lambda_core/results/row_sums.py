"""Keep checksums of the rows of a run.

A run continues only from numbers that it wrote itself.

HDF5 looks after its own structure, not after the numbers: a byte that a disk changes in them shows nowhere.
"""

from __future__ import annotations

import zlib
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from lambda_core.results import file_format as layout
from lambda_core.results.checkpoint import Position
from lambda_core.results.objects import rows as rows_of
from lambda_core.results.opening import ResultError, opened
from lambda_core.results.run_status import Rows


class RowSums:
    """CRC-32 of every growing dataset's rows.

    The keys are paths in the file; appended rows keep the sums up to date.
    """

    def __init__(self) -> None:
        self._sums: dict[str, int] = {}

    def add(self, name: str, values: NDArray[np.float64]) -> None:
        """Take rows that are appended to a dataset."""
        data = np.ascontiguousarray(values, dtype="<f8")
        self._sums[name] = zlib.crc32(data.tobytes(), self._sums.get(name, 0))

    def by_name(self) -> dict[str, int]:
        """Return the checksums so far, for a checkpoint."""
        return dict(self._sums)


def sums_of(file: h5py.File, rows: Rows) -> RowSums:
    """Return the checksums of a result's first rows.

    There are `rows` of them.
    """
    found = RowSums()
    for name, item in layout.objects(file).items():
        if not layout.grows(item):
            continue
        count = layout.rows_of(name, rows)
        for start in range(0, count, layout.ROWS):
            found.add(name, rows_of(item.id, start, min(start + layout.ROWS, count)))
    return found


def check_rows(path: Path, position: Position) -> None:
    """Compare the rows with their checksums.

    The rows are those up to a checkpoint. Results of earlier versions have no checksums.

    Raises
    ------
    ResultError
        Naming the first dataset whose numbers are not those that the run wrote.
    """
    with opened(path) as file:
        found = sums_of(file, position.summed).by_name()
        names = layout.bearing_names(file)
    at_root = f"{layout.BEARINGS}/{names[0]}/" if len(names) == 1 else ""  # what is also there is named as there
    for name, number in position.sums.items():
        if found.get(name) != number:
            raise ResultError(
                f"{path} is damaged: the numbers of {name.removeprefix(at_root)} are not those that the run wrote"
            )

"""Test how finished results are packed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

# Prints by how many MiB a copy of DATASETS datasets of 4 MiB raises the highest memory of its process.
DATASETS = 16
CODE = f"""
import resource, sys
from pathlib import Path
import h5py
import numpy as np
from lambda_core.results import hdf5
from lambda_core.results.file_format import MACHINE, NEW_ROWS
from lambda_core.results.run_status import Rows
path, rows, width = Path(sys.argv[1]), 16384, 32
with h5py.File(path, "w", libver="latest", rdcc_nbytes=hdf5.CACHE) as file:
    for i in range({DATASETS}):
        chunk = (NEW_ROWS, width)
        data = file.create_dataset(f"{{MACHINE}}/c{{i}}", (rows, width), float, maxshape=(None, width), chunks=chunk)
        data[:] = np.arange(rows)[:, None]
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
made = hdf5.copy(path, Rows(samples=rows), compress=True)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024)
with h5py.File(made) as file:
    assert all((file[f"{{MACHINE}}/c{{i}}"][:, -1] == np.arange(rows)).all() for i in range({DATASETS}))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="counts memory in KiB, as Linux does")
def test_packing_a_long_result_takes_little_memory(tmp_path: Path) -> None:
    """Bound the memory that packing adds.

    HDF5 by itself keeps 8 MiB of every dataset of both files.
    """
    command = [sys.executable, "-c", CODE, str(tmp_path / "r.h5")]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert float(done.stdout) < DATASETS

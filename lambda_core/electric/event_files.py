"""The table of discharges in a file: CSV for spreadsheets, HDF5 with everything that belongs to it."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import TYPE_CHECKING

import h5py
import numpy as np

from lambda_core.domain import files
from lambda_core.domain.errors import UsageError
from lambda_core.electric.circuit import bearing_capacitance
from lambda_core.results.circuit_rows import DISCHARGES

if TYPE_CHECKING:
    from lambda_core.electric.simulation import Simulation

_UNITS = {channel.name: channel.unit for channel in DISCHARGES}


def check_target(
    path: Path, overwrite: bool, what: str = "the table of discharges", endings: tuple[str, ...] = (".csv", ".h5")
) -> None:
    """Say before the work what would stop the writing at its end.

    Raises
    ------
    UsageError
        When the ending is none of `endings`, the file exists, or its folder does not.
    """
    if path.suffix not in endings:
        raise UsageError(f'"{path}": {what} is written as {" or ".join(endings)}')
    if not files.check_target(files.check_new(path, overwrite)).exists():
        files.check_folder(path.absolute().parent, path)


def write(simulation: Simulation, path: Path) -> Path:
    """Write the discharges; HDF5 also holds voltages and capacitance over time, and the outcome as JSON."""
    try:
        if path.suffix == ".csv":
            _write_csv(simulation, path)
        else:
            _write_hdf5(simulation, path)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror or error}") from None
    return path


def _write_csv(simulation: Simulation, path: Path) -> None:
    events = simulation.events
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([f"{name} [{unit}]" if unit else name for name, unit in _UNITS.items()])
        writer.writerows(zip(*(getattr(events, name).tolist() for name in _UNITS), strict=True))


def _write_hdf5(simulation: Simulation, path: Path) -> None:
    films, (low, high) = simulation.films, simulation.solution.extremes.T
    with h5py.File(path, "w") as file:
        file.attrs["title"], file.attrs["case"] = "bearing currents", simulation.case
        file["outcome_json"] = simulation.outcome.model_dump_json()
        group = file.create_group("events")
        for channel in DISCHARGES:
            group[channel.name] = getattr(simulation.events, channel.name)
            group[channel.name].attrs["units"], group[channel.name].attrs["long_name"] = channel.unit, channel.meaning
        series = {
            "time": (films.time, "s", "time of the samples"),
            "bearing_capacitance": (
                bearing_capacitance(films),
                "F",
                "balls in parallel, films of a ball in series",
            ),
            "least_voltage": (np.append(low, np.nan), "V", "until the next sample, inner less outer"),
            "largest_voltage": (np.append(high, np.nan), "V", "until the next sample"),
        }
        for name, (values, unit, meaning) in series.items():
            file[name] = values
            file[name].attrs["units"], file[name].attrs["long_name"] = unit, meaning

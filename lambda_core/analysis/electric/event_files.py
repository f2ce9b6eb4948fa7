"""Write the table of discharges as CSV or HDF5."""

from __future__ import annotations

import csv
from pathlib import Path

import h5py
import numpy as np

from lambda_core.analysis.electric.circuit import bearing_capacitance
from lambda_core.analysis.electric.simulation import CircuitSimulation, Simulation
from lambda_core.domain import files
from lambda_core.domain.errors import UsageError
from lambda_core.results.circuit_rows import DISCHARGES

_UNITS = {channel.name: channel.unit for channel in DISCHARGES}


def check_target(
    path: Path, overwrite: bool, what: str = "the table of discharges", endings: tuple[str, ...] = (".csv", ".h5")
) -> None:
    """Report early what would stop the writing.

    The work comes before the writing.

    Raises
    ------
    UsageError
        When the ending is none of `endings`, the file exists, or its folder does not.
    """
    if path.suffix not in endings:
        raise UsageError(f'"{path}": {what} is written as {" or ".join(endings)}')
    if not files.check_target(files.check_new(path, overwrite)).exists():
        files.check_folder(path.absolute().parent, path)


def write(simulation: Simulation | CircuitSimulation, path: Path) -> Path:
    """Write the discharges to a file.

    HDF5 also holds voltages and capacitance over time, and the outcome as JSON.
    """
    try:
        if path.suffix == ".csv":
            _write_csv(simulation, path)
        else:
            _write_hdf5(simulation, path)
    except OSError as error:
        raise UsageError(f"cannot write {path}: {error.strerror or error}") from None
    return path


def _write_csv(simulation: Simulation | CircuitSimulation, path: Path) -> None:
    """Write a row per film that broke down.

    With several bearings the first column has the name of the bearing.
    """
    header = [f"{name} [{unit}]" if unit else name for name, unit in _UNITS.items()]
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if isinstance(simulation, Simulation):
            writer.writerow(header)
            writer.writerows(_rows(simulation))
            return
        writer.writerow(["bearing", *header])
        every = [(row[0], name, row) for name, one in simulation.bearings.items() for row in _rows(one)]
        writer.writerows([name, *row] for _, name, row in sorted(every))


def _rows(simulation: Simulation) -> list[tuple[float, ...]]:
    return list(zip(*(getattr(simulation.events, name).tolist() for name in _UNITS), strict=True))


def _write_hdf5(simulation: Simulation | CircuitSimulation, path: Path) -> None:
    with h5py.File(path, "w") as file:
        file.attrs["title"] = "bearing currents"
        file["outcome_json"] = simulation.outcome.model_dump_json()
        if isinstance(simulation, Simulation):
            file.attrs["case"] = simulation.case
            _put(file, simulation)
            return
        file.attrs["case"] = simulation.first.case
        for name, one in simulation.bearings.items():
            _put(file.create_group(f"bearings/{name}"), one)


def _put(place: h5py.Group, simulation: Simulation) -> None:
    """Write events, voltages and capacitance of one bearing."""
    films, (low, high) = simulation.films, simulation.solution.extremes.T
    group = place.create_group("events")
    for channel in DISCHARGES:
        group[channel.name] = getattr(simulation.events, channel.name)
        group[channel.name].attrs["units"], group[channel.name].attrs["long_name"] = channel.unit, channel.meaning
    series = {
        "time": (simulation.time, "s", "time of the samples"),
        "bearing_capacitance": (
            np.interp(simulation.time, films.time, bearing_capacitance(films)),
            "F",
            "balls in parallel, films of a ball in series",
        ),
        "least_voltage": (np.append(low, np.nan), "V", "until the next sample, inner less outer"),
        "largest_voltage": (np.append(high, np.nan), "V", "until the next sample"),
    }
    for name, (values, unit, meaning) in series.items():
        place[name] = values
        place[name].attrs["units"], place[name].attrs["long_name"] = unit, meaning

"""Write the discharges of a circuit computation."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lambda_core.analysis.electric.simulation import CircuitSimulation, Simulation


def check_discharges_file(path: str | Path, *, overwrite: bool = False) -> None:
    """Check early that discharges can be written to a file.

    Parameters
    ----------
    path, overwrite
        As for :func:`write_discharges`.

    Raises
    ------
    UsageError
        When the file exists, its folder does not, or the ending is unknown.
    """
    from lambda_core.analysis.electric.event_files import check_target

    check_target(Path(path), overwrite)


def write_discharges(simulation: Simulation | CircuitSimulation, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write the discharges of a simulation as a table.

    Parameters
    ----------
    simulation : Simulation
        From :func:`electric`.
    path : path-like
        ``.csv``: the table alone; ``.h5``: with voltages and capacitance over time and the outcome.
    overwrite : bool
        Replace a file that stands there.

    Returns
    -------
    pathlib.Path
        The file.

    Raises
    ------
    UsageError
        When the file exists or cannot be written, or the ending is neither.
    """
    from lambda_core.analysis.electric.event_files import write

    check_discharges_file(path, overwrite=overwrite)
    return write(simulation, Path(path))

"""The bearing in an electric circuit: voltages, discharges, and the film seen from outside."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.results.reader import Result
from lambda_core.system.checking import model_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from lambda_core.case.case import Case
    from lambda_core.electric.inversion import FilmOutcome
    from lambda_core.electric.simulation import Simulation
    from lambda_core.system.bearing import BearingModel


@one_blas_thread()
def electric(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    overrides: Iterable[str] = (),
    *,
    window: tuple[float, float] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Simulation:
    """Compute bearing voltage, discharges and impedance of a run, or of a case on quasi-static films.

    Parameters
    ----------
    source
        A result file, or what :func:`check` takes, or a resolved model.
    overrides : iterable of str
        Changes ``path=value``; of a run only those of the section ``electric``.
    window : tuple of float, optional
        Times between which every corner of the voltages is recorded [s].
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    Simulation
        ``outcome`` has the numbers with units in their names, ``events`` every film that broke down.

    Raises
    ------
    UsageError, CaseError, SolverError
        With a sentence about the source, the case, or about why there is no solution.
    """
    from lambda_core.electric.case_or_run import electric_of_model, electric_of_run, is_result

    if is_result(source):
        return electric_of_run(Result(str(source)), overrides, announce, window=window)
    return electric_of_model(model_of(source, overrides), announce, window=window)


def check_discharges_file(path: str | Path, *, overwrite: bool = False) -> None:
    """Say before the work what would stop :func:`write_discharges` at its end.

    Parameters
    ----------
    path, overwrite
        As for :func:`write_discharges`.

    Raises
    ------
    UsageError
        When the file exists, its folder does not, or the ending is unknown.
    """
    from lambda_core.electric.event_files import check_target

    check_target(Path(path), overwrite)


def write_discharges(simulation: Simulation, path: str | Path, *, overwrite: bool = False) -> Path:
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
    from lambda_core.electric.event_files import write

    check_discharges_file(path, overwrite=overwrite)
    return write(simulation, Path(path))


def film_from_capacitance(
    source: str | Path | Mapping[str, Any] | Case | BearingModel,
    measured: str | Path,
    overrides: Iterable[str] = (),
    *,
    frequency: str | None = None,
    uncertainty: float = 0.02,
    announce: Callable[[str], None] | None = None,
) -> FilmOutcome:
    """Find film thickness and starvation that belong to a measured capacitance or impedance of the bearing.

    Parameters
    ----------
    source, overrides
        The case, as for :func:`check`.
    measured : path-like
        CSV file, ``time [s],capacitance [pF]`` or ``time [s],impedance [kOhm]``.
    frequency : str, optional
        Of a measured impedance, "10 kHz".
    uncertainty : float
        Standard deviation of the measured capacitance, relative.
    announce : callable, optional
        Called with a sentence before something is compiled.

    Returns
    -------
    FilmOutcome
        Numbers in the units of their names.

    Raises
    ------
    UsageError, CaseError, SolverError
        With a sentence about the series, the case, or about why no film has this capacitance.
    """
    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import parse
    from lambda_core.electric.contacts import equilibria
    from lambda_core.electric.inversion import film_from_series

    try:
        hertz = None if frequency is None else parse(frequency, "frequency")
    except ValueError as error:
        raise UsageError(f"frequency: {error}") from None
    if hertz is not None and not hertz > 0.0:
        raise UsageError(f"frequency {frequency}: must be greater than 0 Hz")
    if not 0.0 < uncertainty < 1.0:
        raise UsageError(f"the uncertainty is a share of the capacitance between 0 and 1, not {uncertainty:g}")
    found = equilibria(model_of(source, overrides), announce=announce)
    return film_from_series(found, Path(measured), frequency=hertz, uncertainty=uncertainty)

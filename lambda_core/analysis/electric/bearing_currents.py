"""Compute bearing currents of cases, machines and runs."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.blas_threads import one_blas_thread
from lambda_core.results.answer import answers
from lambda_core.results.reader import Result

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from lambda_core.analysis.electric.inversion import FilmOutcome
    from lambda_core.analysis.electric.simulation import CircuitSimulation, Simulation
    from lambda_core.case.case_io import Source
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel


@answers
@one_blas_thread()
def electric(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str] = (),
    *,
    window: tuple[float, float] | None = None,
    announce: Callable[[str], None] | None = None,
) -> Simulation | CircuitSimulation:
    """Compute bearing voltages, discharges and impedance.

    A case is computed on the films of its quasi-static equilibria. All bearings of a machine stand in one circuit.

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
    Simulation or CircuitSimulation
        Of one bearing, or of a machine with ``bearings`` by name. ``outcome`` has the numbers with units in their
        names; ``events`` of a bearing has every film that broke down.

    Raises
    ------
    UsageError, CaseError, SolverError
        With a sentence about the source, the case, or about why there is no solution.
    """
    from lambda_core.analysis.electric.case_or_run import circuit_of_run, electric_of_model, is_result
    from lambda_core.analysis.thermal.temperatures import ready

    if is_result(source):
        found = circuit_of_run(Result(str(source)), overrides, announce, window=window)
    else:
        found = electric_of_model(ready(source, overrides, announce, is_static=True), announce, window=window)
    return found if len(found.bearings) > 1 else found.first


def film_from_capacitance(
    source: Source | BearingModel | MachineModel,
    measured: str | Path,
    overrides: Iterable[str] = (),
    *,
    bearing: str | None = None,
    frequency: str | None = None,
    uncertainty: float = 0.02,
    announce: Callable[[str], None] | None = None,
) -> FilmOutcome:
    """Find the film that fits a measured capacitance or impedance.

    Parameters
    ----------
    source, overrides
        The case, as for :func:`check`.
    measured : path-like
        CSV file, ``time [s],capacitance [pF]`` or ``time [s],impedance [kOhm]``.
    bearing : str, optional
        Which one of a machine; it is measured apart from the others, under the load that it carries there.
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
    from lambda_core.analysis.electric.contacts import equilibria
    from lambda_core.analysis.electric.inversion import film_from_series, read_measured
    from lambda_core.domain.errors import UsageError
    from lambda_core.domain.units import parse

    try:
        hertz = None if frequency is None else parse(frequency, "frequency")
    except ValueError as error:
        raise UsageError(f"frequency: {error}") from None
    if hertz is not None and not hertz > 0.0:
        raise UsageError(f"frequency {frequency}: must be greater than 0 Hz")
    if not 0.0 < uncertainty < 1.0:
        raise UsageError(f"the uncertainty is a share of the capacitance between 0 and 1, not {uncertainty:g}")
    values = read_measured(Path(measured), hertz)  # before anything is solved
    found = equilibria(_alone(source, overrides, bearing, announce), announce=announce)
    return film_from_series(found, values, uncertainty=uncertainty)


def _alone(
    source: Source | BearingModel | MachineModel,
    overrides: Iterable[str],
    bearing: str | None,
    announce: Callable[[str], None] | None,
) -> BearingModel:
    """Return one bearing of a case or machine.

    A bearing of a machine has the load that it carries there.
    """
    from lambda_core.analysis.rotor.bearing_alone import bearing_alone
    from lambda_core.analysis.thermal.temperatures import ready

    return bearing_alone(ready(source, overrides, announce, is_static=True), bearing, announce)

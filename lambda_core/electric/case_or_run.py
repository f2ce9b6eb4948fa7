"""Select the source of a circuit computation.

It is a run's samples or a case with quasi-static equilibria, with their options.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.case.case import Case
from lambda_core.case.case_io import apply_overrides, parse_case
from lambda_core.domain.errors import UsageError
from lambda_core.electric.circuit_bearing import of_model, of_run
from lambda_core.electric.contacts import contacts_of_equilibria, contacts_of_run, equilibria
from lambda_core.electric.simulation import Simulation, simulate
from lambda_core.electric.voltage_sources import reach
from lambda_core.results.convergence import window as averaged
from lambda_core.system.bearing import Solver

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.system.bearing import BearingModel

Span = tuple[float, float]
_SECTION = "electric."


def electric_of_model(model: BearingModel, announce: Announce = None, *, window: Span | None = None) -> Simulation:
    """Compute a case on the films of its quasi-static equilibria; the circuit is the section electric of the case.

    Raises
    ------
    SolverError
        When there is no equilibrium, or the circuit cannot be solved.
    """
    bearing = of_model(model)
    contacts = contacts_of_equilibria(equilibria(model, announce=announce), bearing.options.duration)
    return simulate(contacts, bearing, announce=announce, window=window)


def case_of_run(result: Result, overrides: Iterable[str] = ()) -> Case:
    """Return the case of a run with other options of the circuit.

    Raises
    ------
    UsageError
        When an override is of anything but the section electric: the run is over.
    """
    changes = list(overrides)
    for text in changes:
        if not text.strip().startswith(_SECTION):
            raise UsageError(f'"{text}": the run is over, only options of the section electric can be changed')
    case = parse_case(result.case_toml, str(result.path))
    return apply_overrides(case, changes) if changes else case


def electric_of_run(
    result: Result, overrides: Iterable[str] = (), announce: Announce = None, *, window: Span | None = None
) -> Simulation:
    """Compute the circuit on the samples of a run, after the revolutions that its averages discard.

    Raises
    ------
    UsageError
        When there are too few samples, or an override does not belong here.
    SolverError
        When the circuit cannot be solved.
    """
    bearing = of_run(result, case_of_run(result, overrides).electric)
    settled, contacts = settled_from(result), contacts_of_run(result)
    if bearing.options.duration is not None:
        stop = settled + bearing.options.duration + reach(bearing.options.source)
        contacts = contacts.part(slice(0, int(np.searchsorted(contacts.time, stop, side="right"))))
    return simulate(contacts, bearing, settled=settled, announce=announce, window=window)


def settled_from(result: Result) -> float:
    """Return the time from which a run counts [s]."""
    settings = Solver(**{name: float(value) for name, value in result.model["solver"].items()})
    return float(averaged(settings, result.revolutions(), result.integrals()[-1]).interval.first[0])


def is_result(source: object) -> bool:
    """Tell whether a source is a result file."""
    import h5py

    return isinstance(source, str | Path) and Path(source).is_file() and bool(h5py.is_hdf5(source))

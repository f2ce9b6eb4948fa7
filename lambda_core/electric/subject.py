"""What is computed: a run's samples, or a case by quasi-static equilibria, with the options that belong to it."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lambda_core.case.case import Case
from lambda_core.case.case_io import apply_overrides, parse_case
from lambda_core.case.electric import Electric
from lambda_core.domain.errors import UsageError
from lambda_core.electric.circuit_run import Simulation, simulate
from lambda_core.electric.contacts import contacts_of_equilibria, contacts_of_run, equilibria
from lambda_core.results.convergence import window
from lambda_core.system.bearing import Solver

if TYPE_CHECKING:
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.system.bearing import BearingModel

_SECTION = "electric."


def electric_of_model(model: BearingModel, announce: Announce = None, **settings: Any) -> Simulation:
    """Compute a case on the films of its quasi-static equilibria; the circuit is the section electric of the case.

    Raises
    ------
    SolverError
        When there is no equilibrium, or the circuit cannot be solved.
    """
    options = parse_case(model.case_toml, model.name).electric or Electric()
    contacts = contacts_of_equilibria(equilibria(model, announce=announce), options.duration)
    return simulate(
        contacts, options, dataclasses.asdict(model.geometry), case=model.name, announce=announce, **settings
    )


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
    result: Result, overrides: Iterable[str] = (), announce: Announce = None, **settings: Any
) -> Simulation:
    """Compute the circuit on the samples of a run, after the revolutions that its averages discard.

    Raises
    ------
    UsageError
        When there are too few samples, or an override does not belong here.
    SolverError
        When the circuit cannot be solved.
    """
    options = case_of_run(result, overrides).electric or Electric()
    contacts = contacts_of_run(result, settled_from(result), options.duration)
    geometry = {name: float(value) for name, value in result.model["geometry"].items() if name != "series"}
    return simulate(contacts, options, geometry, case=result.case, announce=announce, **settings)


def settled_from(result: Result) -> float:
    """Return the time from which a run counts [s]."""
    settings = Solver(**{name: float(value) for name, value in result.model["solver"].items()})
    return float(window(settings, result.revolutions(), result.integrals()[-1]).interval.first[0])


def is_result(source: object) -> bool:
    """Tell whether a source is a result file."""
    import h5py

    return isinstance(source, str | Path) and Path(source).is_file() and bool(h5py.is_hdf5(source))

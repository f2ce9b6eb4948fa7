"""Select the source of a circuit computation.

It is a run's samples or a case with quasi-static equilibria, with their options.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.analysis.electric.circuit_bearing import CircuitBearing, circuit_bearings, of_run, usual_options
from lambda_core.analysis.electric.contacts import (
    contacts_of_equilibria,
    contacts_of_run,
    default_duration,
    equilibria,
    spins,
)
from lambda_core.analysis.electric.simulation import CircuitSimulation, Simulation, simulate_circuit
from lambda_core.analysis.electric.voltage_sources import reach
from lambda_core.case.case_io import read_case, toml_tables
from lambda_core.case.electric import Electric
from lambda_core.domain.errors import UsageError
from lambda_core.domain.lists import listed
from lambda_core.model.bearing_model import Solver
from lambda_core.results.convergence import window as averaged

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Announce
    from lambda_core.solver.drivers.equilibrium import Equilibrium

Span = tuple[float, float]
_SECTION = "electric."


def electric_of_model(
    model: BearingModel | MachineModel, announce: Announce = None, *, window: Span | None = None
) -> CircuitSimulation:
    """Compute all bearings of a case in one circuit.

    The films are those of their quasi-static equilibria. The circuit is the section electric of the case.

    Raises
    ------
    UsageError
        When the rings of a bearing rest against each other.
    SolverError
        When there is no equilibrium, or the circuit cannot be solved.
    """
    from lambda_core.analysis.static_point import static_point

    for one in model.bearing_models.values():
        spins(one)  # refuses rings at rest before anything is solved
    each = static_point(model, announce).bearings.values()
    found = [equilibria(one.in_place, announce=announce) for one in each]
    return electric_of_equilibria(circuit_bearings(model), found, announce, window=window)


def electric_of_equilibria(
    bearings: Sequence[CircuitBearing],
    found: Sequence[list[Equilibrium]],
    announce: Announce = None,
    *,
    window: Span | None = None,
) -> CircuitSimulation:
    """Compute bearings in one circuit.

    `found` are the equilibria of each at several positions of its balls.
    """
    duration = bearings[0].options.duration or max(map(default_duration, found))
    contacts = [contacts_of_equilibria(each, duration) for each in found]
    return simulate_circuit(contacts, bearings, announce=announce, window=window)


def options_of_run(result: Result, overrides: Iterable[str] = ()) -> Electric | None:
    """Return the circuit in the case of a run.

    Other options replace those of the case where they are given.

    Raises
    ------
    UsageError
        When an override is of anything but the section electric: the run is over.
    """
    changes = listed(overrides, "overrides")
    for text in changes:
        if not text.strip().startswith(_SECTION):
            raise UsageError(f'"{text}": a finished run accepts options of [electric] only')
    return read_case(toml_tables(result.case_toml, str(result.path)), changes).electric


def circuit_of_run(
    result: Result, overrides: Iterable[str] = (), announce: Announce = None, *, window: Span | None = None
) -> CircuitSimulation:
    """Compute the circuit on the samples of a run.

    It starts after the revolutions that the averages discard.

    Raises
    ------
    UsageError
        When there are too few samples, or an override does not belong here.
    SolverError
        When the circuit cannot be solved.
    """
    options, results = options_of_run(result, overrides), result.bearings
    options = options or usual_options(on_shaft=result.is_machine)
    bearings = [
        replace(of_run(one, options.of_bearing(name)), name=name, case=result.case) for name, one in results.items()
    ]
    settled = max(settled_from(one) for one in results.values())
    contacts = [contacts_of_run(one) for one in results.values()]
    first = bearings[0].options
    if first.duration is not None:
        stop = settled + first.duration + reach(first.source)
        rows = slice(0, int(np.searchsorted(contacts[0].time, stop, side="right")))
        contacts = [each.part(rows) for each in contacts]
    return simulate_circuit(contacts, bearings, settled=settled, announce=announce, window=window)


def electric_of_run(
    result: Result, overrides: Iterable[str] = (), announce: Announce = None, *, window: Span | None = None
) -> Simulation:
    """Compute a run's circuit for the result's bearing.

    See :func:`circuit_of_run`.
    """
    found = circuit_of_run(result, overrides, announce, window=window)
    return found.bearings[result.bearing] if len(found.bearings) > 1 else found.first


def settled_from(result: Result) -> float:
    """Return the time from which a run counts [s]."""
    settings = Solver(**{name: float(value) for name, value in result.model["solver"].items()})
    return float(averaged(settings, result.revolutions(), result.integrals()[-1]).interval.first[0])


def is_result(source: object) -> bool:
    """Tell whether a source is a result file."""
    import h5py

    return isinstance(source, str | Path) and Path(source).is_file() and bool(h5py.is_hdf5(source))

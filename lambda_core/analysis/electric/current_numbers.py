"""Summarise bearing currents of an operating point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lambda_core.results.quantity import quantities, quantity
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.analysis.electric.simulation import Simulation
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.compiled_laws import Kernels
    from lambda_core.solver.drivers.equilibrium import Equilibrium
    from lambda_core.solver.drivers.machine_statics import MachineState

PHASES = 3  # equilibria per ball pitch: a map has many points


class CurrentNumbers(Record):
    """Films, voltages and discharges; None where nothing discharges."""

    film_um: float | None = quantity(
        "smallest central film of a loaded contact", "um", label="smallest film", group="currents"
    )
    film_parameter: float | None = quantity(
        "Lambda of the smallest central film", label="film parameter Lambda", group="currents"
    )
    bearing_capacitance_pF: float | None = quantity(
        "capacitance of the balls, touching films by their area", "pF", label="bearing capacitance", group="currents"
    )
    bearing_voltage_ratio: float | None = quantity(
        "bearing over common-mode voltage", label="bearing voltage ratio", group="currents"
    )
    bearing_voltage_V: float | None = quantity(
        "largest bearing voltage, either sign", "V", label="largest bearing voltage", group="currents"
    )
    metal_share: float | None = quantity(
        "share of contacts and time in which asperities touch", label="share of metal contact", group="currents"
    )
    discharges_per_s: float | None = quantity("discharges through the bearing", "1/s", group="currents")
    breakdown_voltage_V: float | None = quantity(
        "bearing voltage at discharges, median", "V", label="breakdown voltage", group="currents"
    )
    peak_current_A: float | None = quantity(
        "peak current of discharges, median", "A", label="peak current", group="currents"
    )
    current_density_A_per_mm2: float | None = quantity(
        "median peak current over the Hertzian area, J_b", "A/mm2", label="current density J_b", group="currents"
    )
    arc_power_mW: float | None = quantity("power of arcs", "mW")


UNITS: Mapping[str, str] = {name: one.unit for name, one in quantities(CurrentNumbers).items()}


def meaning(name: str) -> str:
    """Return one line about a number."""
    return quantities(CurrentNumbers)[name].meaning


def code_folder() -> Path:
    """Return the folder of the compiled circuit.

    Other code gives other numbers.
    """
    return Path(__file__).parent / "compiled"


def numbers_of(simulation: Simulation) -> CurrentNumbers:
    """Return the numbers of a circuit that was computed."""
    outcome, contacts = simulation.outcome, simulation.contacts
    film = np.where(contacts.loaded, contacts.film, np.inf)
    thinnest = np.unravel_index(int(np.argmin(film)), film.shape)
    low, high = outcome.bearing_voltage_V

    def middle(values: Sequence[float] | None) -> float | None:
        return None if values is None else values[1]

    return CurrentNumbers(
        film_um=1e6 * float(film[thinnest]),
        film_parameter=float(contacts.film_parameter[thinnest]),
        bearing_capacitance_pF=outcome.bearing_capacitance_pF[1],
        bearing_voltage_ratio=outcome.bearing_voltage_ratio,
        bearing_voltage_V=max(abs(low), abs(high)),
        metal_share=outcome.shorted_share,
        discharges_per_s=outcome.discharges_per_s,
        breakdown_voltage_V=middle(outcome.breakdown_voltage_V),
        peak_current_A=middle(outcome.peak_current_A),
        current_density_A_per_mm2=outcome.current_density_A_per_mm2,
        arc_power_mW=outcome.arc_power_mW,
    )


def static_numbers(found: Equilibrium, kernels: Any) -> CurrentNumbers:
    """Compute a circuit on quasi-static films.

    The balls take three positions; `found` is the first of them.

    A case without the section electric gets its defaults, and ten turns of the cage without a duration.

    Raises
    ------
    SolverError
        When there is no equilibrium at another position, or the circuit cannot be solved.
    """
    from lambda_core.analysis.electric.case_or_run import electric_of_equilibria
    from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
    from lambda_core.solver.drivers.equilibrium import solve

    model = found.context.model
    others = [solve(model, kernels, phase=k / PHASES) for k in range(1, PHASES)]
    return numbers_of(electric_of_equilibria(circuit_bearings(model), [[found, *others]]).first)


def machine_numbers(
    machine: MachineModel, state: MachineState, kernels: Sequence[Kernels]
) -> dict[str, CurrentNumbers]:
    """Compute the circuit of a machine's bearings.

    All bearings have quasi-static films at three positions of the balls.

    Parameters
    ----------
    state : MachineState
        The equilibrium of the machine.
    kernels : sequence of Kernels
        Compiled laws of each bearing.

    Returns
    -------
    dict of str to CurrentNumbers
        Of each bearing by its name.
    """
    from lambda_core.analysis.electric.case_or_run import electric_of_equilibria, held_bearings
    from lambda_core.analysis.electric.circuit_bearing import circuit_bearings
    from lambda_core.analysis.electric.contacts import equilibria

    each = zip(held_bearings(machine, state), kernels, strict=True)
    solved = [equilibria(one, PHASES, kernels=own) for one, own in each]
    found = electric_of_equilibria(circuit_bearings(machine), solved)
    return {name: numbers_of(one) for name, one in found.bearings.items()}


def circuit_numbers(result: Result) -> dict[str, CurrentNumbers]:
    """Compute the circuit of a machine's run.

    It works as :func:`run_numbers`, with each bearing by its name.
    """
    from lambda_core.analysis.electric.case_or_run import circuit_of_run

    return {name: numbers_of(one) for name, one in circuit_of_run(result).bearings.items()}


def run_numbers(result: Result) -> CurrentNumbers:
    """Compute the circuit of a run on samples.

    The samples begin where averages begin.

    Raises
    ------
    UsageError
        When there are too few samples.
    SolverError
        When the circuit cannot be solved.
    """
    from lambda_core.analysis.electric.case_or_run import electric_of_run

    return numbers_of(electric_of_run(result))

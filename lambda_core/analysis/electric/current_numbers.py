"""Summarise bearing currents of an operating point."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.results.quantity import quantities, quantity
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.analysis.electric.simulation import Simulation
    from lambda_core.model.bearing_model import BearingModel
    from lambda_core.model.machine_model import MachineModel
    from lambda_core.results.reader import Result
    from lambda_core.solver.drivers.equilibrium import Equilibrium

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


def static_numbers(
    model: BearingModel | MachineModel, solved: Sequence[list[Equilibrium]]
) -> dict[str, CurrentNumbers]:
    """Compute the circuit of a model on quasi-static films.

    A case without the section electric gets its defaults, and ten turns of the cage without a duration.

    Parameters
    ----------
    solved : sequence of list of Equilibrium
        Of each bearing, at PHASES positions of its balls.

    Returns
    -------
    dict of str to CurrentNumbers
        Of each bearing by its name in results.

    Raises
    ------
    SolverError
        When the circuit cannot be solved.
    """
    from lambda_core.analysis.electric.case_or_run import electric_of_equilibria
    from lambda_core.analysis.electric.circuit_bearing import circuit_bearings

    found = electric_of_equilibria(circuit_bearings(model), solved)
    return {name: numbers_of(one) for name, one in found.bearings.items()}


def circuit_numbers(result: Result) -> dict[str, CurrentNumbers]:
    """Compute the circuit of a run on samples.

    The samples begin where averages begin.

    Returns
    -------
    dict of str to CurrentNumbers
        Of each bearing by its name.

    Raises
    ------
    UsageError
        When there are too few samples.
    SolverError
        When the circuit cannot be solved.
    """
    from lambda_core.analysis.electric.case_or_run import circuit_of_run

    return {name: numbers_of(one) for name, one in circuit_of_run(result).bearings.items()}

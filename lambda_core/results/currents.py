"""Summarise the bearing currents of a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from lambda_core.domain.arrays import FloatArray
from lambda_core.results.quantity import FLOATING, quantity
from lambda_core.results.record import Record

if TYPE_CHECKING:
    from lambda_core.results.reader import Result


class Currents(Record):
    """Voltages and discharges of the averages' span.

    Spans are 10, 50 and 90 %.
    """

    seconds: float = Field(description="that are counted [s]")
    bearing_voltage_V: list[float] = quantity(
        "smallest and largest, inner less outer ring", "V", label="bearing voltage, smallest and largest",
        column="bearing voltage", decimals=1, group="currents",
    )  # fmt: skip
    bearing_capacitance_pF: list[float] = quantity(
        "smallest and largest", "pF", label="capacitance", decimals=1, digits=4, group="currents"
    )
    discharges_per_s: float = quantity(
        "through both contacts of a ball: the rotor's charge flows", "1/s", label="discharges through the bearing",
        column="discharges", decimals=FLOATING, digits=4, group="currents",
    )  # fmt: skip
    partial_discharges_per_s: float = quantity(
        "through one film, while the other holds: only the ball's charge", "1/s", label="discharges through one film",
        decimals=FLOATING, digits=4, group="currents",
    )  # fmt: skip
    breakdown_voltage_V: list[float] | None = quantity(
        "of the bearing at discharges", "V", label="voltage of discharges (10, 50, 90 %)", group="currents"
    )
    peak_current_A: list[float] | None = quantity(
        "of discharges", "A", label="peak current (10, 50, 90 %)", group="currents"
    )
    arc_power_mW: float = quantity(
        "heat of all arcs over the time", "mW", label="heat in arcs", column="in arcs", decimals=FLOATING, digits=3,
        group="currents",
    )  # fmt: skip


def currents_of(result: Result, start: float) -> Currents | None:
    """Return the circuit's results from a time [s].

    A run wrote them; None where it has none, or nothing yet.
    """
    circuit, events = result.circuit(), result.discharges()
    later = circuit["time"][circuit["time"] >= start] if circuit else np.zeros(0)
    if later.size < 2:
        return None
    begin = float(later[0]) if start > 0.0 else 0.0  # a sample; the first one of a run is not in the table
    inside = circuit["time"] > begin
    seconds = float(later[-1] - begin)
    counted = {name: values[events["time"] >= begin] for name, values in events.items()}
    numbers, each = np.unique(counted["discharge"], return_inverse=True)
    joined = counted.get("joined", np.zeros(each.size))  # results of earlier versions do not say
    through = (np.bincount(each, minlength=numbers.size) > 1) | (np.bincount(each, joined, numbers.size) > 0)
    voltage, peak = np.zeros(numbers.size), np.zeros(numbers.size)
    np.maximum.at(voltage, each, np.abs(counted["bearing_voltage"]))
    np.maximum.at(peak, each, counted["peak"])
    least, largest, farad = (
        circuit[name][inside] for name in ("bearing_voltage_least", "bearing_voltage_largest", "bearing_capacitance")
    )
    reached = np.concatenate([least, largest, counted["bearing_voltage"]])  # between discharges, and where they began
    return Currents(
        seconds=seconds,
        bearing_voltage_V=[float(np.nanmin(reached)), float(np.nanmax(reached))],
        bearing_capacitance_pF=[1e12 * float(farad.min()), 1e12 * float(farad.max())],
        discharges_per_s=float(through.sum()) / seconds,
        partial_discharges_per_s=float((~through).sum()) / seconds,
        breakdown_voltage_V=_spread(voltage[through]),
        peak_current_A=_spread(peak[through]),
        arc_power_mW=1e3 * float(counted["energy"].sum()) / seconds,
    )


def _spread(values: FloatArray) -> list[float] | None:
    return [float(value) for value in np.quantile(values, (0.1, 0.5, 0.9))] if values.size else None

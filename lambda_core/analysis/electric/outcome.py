"""Summarise bearing voltage, discharges and impedance."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import Field

from lambda_core.analysis.electric import columns as L
from lambda_core.analysis.electric.circuit import bearing_capacitance, impedance, rotor_capacitance, voltage_ratio
from lambda_core.analysis.electric.current_limits import LIMITS, Limit
from lambda_core.analysis.electric.events import discharges_of, sector_shares
from lambda_core.analysis.electric.voltage_sources import period_of
from lambda_core.case.electric import Electric, Inverter, Sine, Step
from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.elements import ALONE
from lambda_core.domain.number_text import number
from lambda_core.domain.wrapping import lines_under
from lambda_core.model.settings.resolve_electric import assumed
from lambda_core.results.answer import Answer
from lambda_core.results.record import INTERFACE, Record, by_bearing
from lambda_core.results.text import line

if TYPE_CHECKING:
    from collections.abc import Sequence

    from lambda_core.analysis.electric.circuit_bearing import CircuitBearing
    from lambda_core.analysis.electric.events import Events
    from lambda_core.analysis.electric.simulation import CircuitSimulation, Simulation


_CERAMIC = re.compile(r"ceramic|si3n4|silicon.?nitride|zro2|zirconia", re.IGNORECASE)
_FREQUENCIES = (1e3, 1e4, 1e5, 1e6)
_BINS = 20


class Histogram(Record):
    """Number of discharges between edges."""

    unit: str
    edges: list[float]
    counts: list[int]


class Outcome(Answer):
    """Outcome of one bearing's circuit.

    Spans are smallest, middle (median) and largest.
    """

    interface: int = INTERFACE
    case: str
    source: str = Field(description="common-mode voltage")
    films: str = Field(description="where the films come from")
    simulated_s: float
    speed_rpm: float
    bearing_capacitance_pF: list[float]
    unloaded_share: float = Field(description="of the capacitance: balls that one ring does not touch under load")
    rings_capacitance_pF: float
    rotor_capacitance_pF: float = Field(description="everything between the rotor and its surroundings")
    shorted_share: float = Field(description="of contacts and time: asperities touch, metal conducts")
    bearing_voltage_ratio: float = Field(description="bearing over common-mode voltage, by capacitances alone")
    bearing_voltage_V: list[float] = Field(description="smallest and largest between the rings")
    impedance_kOhm: dict[str, float] = Field(description="frequency -> magnitude, mean over time")
    impedance_phase_deg: dict[str, float]
    discharges: int = Field(description="through both contacts of a ball: the rotor's charge flows")
    discharges_per_s: float
    partial_discharges: int = Field(description="through one film, while the other holds: only the ball's charge")
    floor_share: float = Field(description="of the breakdowns, at the least voltage of the case and not of the law")
    breakdown_voltage_V: list[float] | None = Field(description="of the bearing at discharges: 10, 50, 90 %")
    peak_current_A: list[float] | None = Field(description="10, 50, 90 % of discharges")
    energy_nJ: list[float] | None = Field(description="heat of one discharge: 10, 50, 90 %")
    arc_power_mW: float
    hertz_area_mm2: float = Field(description="of the loaded contacts of one raceway, mean of both")
    current_density_A_per_mm2: float | None = Field(description="median peak current over that area, J_b")
    power_density_VA_per_mm2: float | None = Field(description="median of voltage times peak current over it, S_b")
    sector_share_inner: list[float] = Field(description="of breakdowns, sectors from +y towards +z, turning with it")
    sector_share_outer: list[float]
    voltage_histogram: Histogram | None
    energy_histogram: Histogram | None
    energy_residual: float = Field(description="of the energy that flowed")
    charge_residual: float = Field(description="of the charge that flowed")
    seed: int
    wall_per_simulated_second: float
    limits: list[Limit] = Field(description="in circulation; nothing is decided by them")
    assumptions: list[str]

    def text(self) -> str:
        """Return the lines for people."""
        return outcome_text(self)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON.

        What the bearing sees is in ``bearings``, by its name, as in a machine.
        """
        around = MachineOutcome.model_fields.keys() & Outcome.model_fields
        totals = ("discharges_per_s", "arc_power_mW")
        return by_bearing(self, ALONE, [key for key in Outcome.model_fields if key in around - {*totals}], totals)


def outcome_of(simulation: Simulation) -> Outcome:
    """Put a simulation into the units of the interface."""
    events = simulation.events
    each = discharges_of(events)
    through = each.through
    voltage, peak, energy = each.voltage[through], each.peak[through], each.energy[through]
    films, circuit, contacts = simulation.films, simulation.circuit, simulation.contacts
    capacitance = bearing_capacitance(films)
    area = 1e6 * float(contacts.area.sum(axis=1).mean())  # [mm2]
    around = circuit.bearings[simulation.number]
    meter = impedance(films, around, np.array(_FREQUENCIES)).mean(axis=0)
    names = [f"{frequency:g} Hz" for frequency in _FREQUENCIES]
    total, length = simulation.solution.total, simulation.duration
    some = bool(through.any())
    return Outcome(
        case=simulation.case,
        source=source_words(simulation.options),
        films=contacts.origin,
        simulated_s=length,
        speed_rpm=simulation.speed * 30.0 / math.pi,
        bearing_capacitance_pF=[1e12 * float(f(capacitance)) for f in (np.min, np.median, np.max)],
        unloaded_share=unloaded_share(simulation),
        rings_capacitance_pF=1e12 * around.rings,
        rotor_capacitance_pF=1e12 * rotor_capacitance(circuit, simulation.capacitances),
        shorted_share=float(contacts.shorted.mean()),
        bearing_voltage_ratio=voltage_ratio(circuit, simulation.capacitances, simulation.number),
        bearing_voltage_V=voltage_range(simulation),
        impedance_kOhm=dict(zip(names, (1e-3 * np.abs(meter)).tolist(), strict=True)),
        impedance_phase_deg=dict(zip(names, np.degrees(np.angle(meter)).tolist(), strict=True)),
        discharges=int(through.sum()),
        discharges_per_s=float(through.sum()) / length,
        partial_discharges=int((~through).sum()),
        floor_share=floor_share(events, simulation.options.breakdown.least_voltage),
        breakdown_voltage_V=_quantiles(voltage) if some else None,
        peak_current_A=_quantiles(peak) if some else None,
        energy_nJ=_quantiles(1e9 * energy) if some else None,
        arc_power_mW=1e3 * simulation.solution.arc_energy / length,
        hertz_area_mm2=area,
        current_density_A_per_mm2=float(np.median(peak)) / area if some else None,
        power_density_VA_per_mm2=float(np.median(voltage * peak)) / area if some else None,
        sector_share_inner=sector_shares(events, 0).tolist(),
        sector_share_outer=sector_shares(events, 1).tolist(),
        voltage_histogram=_histogram(voltage, "V") if some else None,
        energy_histogram=_histogram(1e9 * energy, "nJ") if some else None,
        energy_residual=energy_residual(total),
        charge_residual=charge_residual(simulation),
        seed=simulation.options.seed,
        wall_per_simulated_second=simulation.wall / length,
        limits=list(LIMITS),
        assumptions=assumptions(simulation.bearing, simulation.events),
    )


def floor_share(events: Events, least: float) -> float:
    """Return the share of breakdowns at least voltage.

    Below it films hold, whatever the law returns.
    """
    return float(np.mean(np.abs(events.contact_voltage) < 1.001 * least)) if events.time.size else 0.0


def voltage_range(simulation: Simulation) -> list[float]:
    """Return the smallest and largest bearing voltage [V].

    The voltages occur between discharges. Also return where they began.
    """
    low, high = simulation.solution.extremes.T
    began = simulation.events.bearing_voltage
    every = np.concatenate([low, high, began])
    return [float(np.fmin.reduce(every)), float(np.fmax.reduce(every))]


def unloaded_share(simulation: Simulation) -> float:
    """Return the unloaded balls' share of capacitance.

    A ring does not press on these balls.
    """
    capacitance = simulation.films.capacitance
    each = capacitance[:, :, 0] * capacitance[:, :, 1] / capacitance.sum(axis=2)
    open_ = ~simulation.contacts.loaded.all(axis=2)
    return float((each * open_).sum() / each.sum())


def energy_residual(total: FloatArray) -> float:
    """Return the relative energy residual.

    Source work + work of moving surfaces - heat - arcs - stored, over the sum of their absolute values.
    """
    flows = total[[L.T_SOURCE, L.T_MOTION, L.T_OHMIC, L.T_ARC]]
    stored = total[L.T_STORED] - total[L.T_STORED_0]
    rest = flows[0] + flows[1] - flows[2] - flows[3] - stored
    scale = float(np.abs(flows).sum() + abs(stored))
    return float(rest) / scale if scale > 0.0 else 0.0


def charge_residual(simulation: Simulation) -> float:
    """Return the relative charge residual.

    It is the charge that the source brought less the leaked, discharged and kept charge, over the charge that it moved.
    """
    total, (times, volts) = simulation.solution.total, simulation.source
    begin, end = np.interp((total[L.T_BEGAN], total[L.T_TIME]), times, volts)
    winding = simulation.circuit.winding
    rest = winding * (end - begin) - total[L.T_LEAK] - total[L.T_ARC_CHARGE]
    rest -= total[L.T_CHARGE] - total[L.T_CHARGE_0]
    scale = winding * float(np.abs(np.diff(volts)).sum() + abs(volts[0]))
    return float(rest) / scale if scale > 0.0 else 0.0


def source_words(options: Electric) -> str:
    """Say what feeds the circuit."""
    source = options.source
    if isinstance(source, Inverter):
        return (
            f"two-level inverter, dc link {source.dc_link:g} V, {1e-3 * source.switching_frequency:g} kHz, "
            f"edges {1e9 * source.rise_time:g} ns, modulation {source.modulation:g}"
        )
    if isinstance(source, Sine):
        return f"sine, {source.amplitude:g} V, {source.frequency:g} Hz"
    if isinstance(source, Step):
        return f"step to {source.amplitude:g} V in {1e9 * source.rise_time:g} ns"
    rows = np.array(source.rows)
    if not source.repeat:
        return f"measured series, {len(rows)} rows to {1e3 * rows[-1, 0]:.6g} ms, {rows[-1, 1]:.6g} V from there on"
    return f"measured series, {len(rows)} rows, repeated every {1e3 * period_of(rows):.6g} ms"


def assumptions(bearing: CircuitBearing, events: Events | None = None) -> list[str]:
    """Return the unmeasured defaults of the options.

    No measurement of this machine supports them.

    Parameters
    ----------
    events : Events, optional
        What broke down, for the share of it that the floor of breakdown decided.
    """
    options, found = bearing.options, []
    if not any((options.inverter, options.sine, options.step, options.series)):
        found.append(f"the case names no source: {source_words(options)} feeds the circuit")
    written = options.machine.model_fields_set
    for name, words in (("winding_rotor", "C_wr"), ("rotor_frame", "C_rf")):
        if name not in written:
            value = 1e12 * getattr(options.machine, name)
            found.append(f"{words} is {value:g} pF: an order of magnitude; measure it on your machine")
    if options.twins:
        found.append(
            "the machine has a second bearing with the same capacitance at every moment, whose films never break down: "
            "every discharge goes through this one"
        )
    if options.film.surroundings is None:
        found.append("between the rings there is air outside the rolling elements")
    if options.film.seals == 0.0:
        found.append("seals are left out")
    if options.cage is None and not bearing.full_complement:
        found.append("the cage does not conduct")
    if bearing.of_lines:
        found.append("at quasi-static points rollers roll where no steady motion with friction is found")
    found += assumed(bearing.laws)
    found.append(
        "circulating currents, from a voltage along the shaft through two bearings and the frame, are not modelled"
    )
    if options.film.ball_permittivity is not None:
        found.append("balls insulate: no film breaks down, field lines outside the Hertzian areas are neglected")
        return found
    ball = bearing.contexts[0].ball
    if _CERAMIC.search(ball.name):
        found.append(
            f"balls of {ball.name} are computed as conductors: electric.film.ball_permittivity makes them insulate"
        )
    least = options.breakdown.least_voltage
    floor = f"no film breaks down below {least:g} V"
    if events is not None and events.time.size:
        share = floor_share(events, least)
        if share:
            floor += f" (assumed): {100.0 * share:.0f} % of the breakdowns occur there, not at the voltage of the law"
    found.append(floor)
    found.append("each patch of one contact width has its own breakdown voltage")
    found.append("contacts without load do not break down; craters do not change the surfaces")
    return found


def _quantiles(values: FloatArray) -> list[float]:
    return [float(x) for x in np.quantile(values, (0.1, 0.5, 0.9))]


def _histogram(values: FloatArray, unit: str) -> Histogram:
    counts, edges = np.histogram(values, bins=_BINS)
    return Histogram(unit=unit, edges=edges.tolist(), counts=counts.tolist())


def outcome_text(found: Outcome) -> str:
    """Return the text of one bearing's circuit.

    It has a line per subject.
    """
    lines = [
        line("source", found.source),
        *bearing_lines(found),
        line("balance", f"energy {found.energy_residual:.1e}", f"charge {found.charge_residual:.1e}"),
        line("wall time", f"{found.wall_per_simulated_second:.2g} s per simulated second"),
        *lines_under("limits", map(_limit, found.limits)),
        *lines_under("assumed", found.assumptions),
    ]
    return "\n".join(lines)


def bearing_lines(found: Outcome) -> list[str]:
    """Return the lines about one bearing: films, voltages, discharges."""
    least, middle, most = found.bearing_capacitance_pF
    low, high = found.bearing_voltage_V
    return [
        line("films", found.films, f"{found.simulated_s:.4g} s", f"{found.speed_rpm:.5g} 1/min"),
        line(
            "capacitance",
            f"bearing {least:.1f} .. {middle:.1f} .. {most:.1f} pF",
            f"unloaded elements {100 * found.unloaded_share:.1f} %",
            f"rings {found.rings_capacitance_pF:.1f} pF",
        ),
        line("impedance", *(f"{name} {value:.3g} kOhm" for name, value in found.impedance_kOhm.items())),
        line("bearing voltage", f"{low:.1f} .. {high:.1f} V", f"BVR {100 * found.bearing_voltage_ratio:.2f} %"),
        line(
            "discharges",
            f"{_rate(found.discharges_per_s)} 1/s through the bearing",
            f"{_rate(found.partial_discharges / found.simulated_s)} 1/s through one film",
            *([_floor(found.floor_share)] if found.floor_share > 0.0 else []),
            f"metal {100 * found.shorted_share:.2g} %",
        ),
        line("  voltage", _three(found.breakdown_voltage_V, "V")),
        line("  peak current", _three(found.peak_current_A, "A")),
        line("  energy", _three(found.energy_nJ, "nJ"), f"{found.arc_power_mW:.3g} mW in arcs"),
        line(
            "density",
            f"J_b {_one(found.current_density_A_per_mm2)} A/mm2",
            f"S_b {_one(found.power_density_VA_per_mm2)} VA/mm2",
            f"Hertzian area {found.hertz_area_mm2:.3g} mm2",
        ),
        line("worst sectors", _worst("inner", found.sector_share_inner), _worst("outer", found.sector_share_outer)),
    ]


def _floor(share: float) -> str:
    return f"{100 * share:.0f} % of the breakdowns at breakdown.least_voltage, an assumed lower limit"


def _floor_of_all(found: MachineOutcome) -> float:
    """Return all bearings' share of breakdowns at least voltage."""
    each = [(one.discharges + one.partial_discharges, one.floor_share) for one in found.bearings.values()]
    return sum(count * share for count, share in each) / max(sum(count for count, _ in each), 1)


def _rate(value: float) -> str:
    """Write a rate with four digits without an exponent."""
    return f"{value:.4g}" if value < 1e3 else number(float(f"{value:.4g}"), 0)


def _limit(limit: Limit) -> str:
    mark = "" if limit.read_in_the_original else "; not read in the original"
    return f"{limit.quantity}: {limit.value} ({limit.source}{mark})"


def _three(values: Sequence[float] | None, unit: str) -> str:
    if values is None:
        return "-"
    return f"{values[0]:.3g} / {values[1]:.3g} / {values[2]:.3g} {unit} (10/50/90 %)"


def _one(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}"


def _worst(ring: str, shares: Sequence[float]) -> str:
    most = max(shares)
    if most == 0.0:
        return f"{ring} -"
    width = 360.0 / len(shares)
    at = shares.index(most) * width
    return f"{ring} {100 * most:.0f} % at {at:.0f}..{at + width:.0f} deg"


class MachineOutcome(Answer):
    """All bearings of a shaft in one circuit."""

    interface: int = INTERFACE
    case: str
    source: str = Field(description="common-mode voltage")
    simulated_s: float
    speed_rpm: float
    shaft_voltage_V: list[float] = Field(description="smallest and largest of the rotor against the frame")
    rotor_capacitance_pF: float = Field(description="everything between the rotor and its surroundings")
    discharges_per_s: float = Field(description="through one of the bearings: the rotor's charge flows")
    arc_power_mW: float = Field(description="in all bearings")
    energy_residual: float = Field(description="of the energy that flowed")
    charge_residual: float = Field(description="of the charge that flowed")
    seed: int
    wall_per_simulated_second: float
    bearings: dict[str, Outcome] = Field(description="the circuit as each bearing sees it")
    assumptions: list[str] = Field(description="of all bearings")

    def text(self) -> str:
        """Return the lines for people."""
        return machine_outcome_text(self)

    def to_dict(self) -> dict[str, Any]:
        """Return plain data, ready for JSON."""
        return self.model_dump(mode="json")


def machine_outcome(found: CircuitSimulation) -> MachineOutcome:
    """Return the shaft's outcome in interface units."""
    each = {name: one.outcome for name, one in found.bearings.items()}
    first, outcome = found.first, next(iter(each.values()))
    low, high = found.solution.extremes[:, -1].T
    every = [one.assumptions for one in each.values()]
    return MachineOutcome(
        case=first.case,
        source=outcome.source,
        simulated_s=outcome.simulated_s,
        speed_rpm=outcome.speed_rpm,
        shaft_voltage_V=[float(np.fmin.reduce(low)), float(np.fmax.reduce(high))],
        rotor_capacitance_pF=outcome.rotor_capacitance_pF,
        discharges_per_s=sum(one.discharges_per_s for one in each.values()),
        arc_power_mW=sum(one.arc_power_mW for one in each.values()),
        energy_residual=outcome.energy_residual,
        charge_residual=outcome.charge_residual,
        seed=outcome.seed,
        wall_per_simulated_second=outcome.wall_per_simulated_second,
        bearings=each,
        assumptions=[text for text in every[0] if all(text in other for other in every)],
    )


def machine_outcome_text(found: MachineOutcome) -> str:
    """Return the text of a shaft's circuit.

    It has a block per bearing.
    """
    low, high = found.shaft_voltage_V
    lines = [
        line("source", found.source),
        line("shaft", f"{low:.1f} .. {high:.1f} V", f"C_rotor {found.rotor_capacitance_pF:.1f} pF"),
        line(
            "discharges",
            f"{_rate(found.discharges_per_s)} 1/s in all",
            *([_floor(share)] if (share := _floor_of_all(found)) > 0.0 else []),
            f"{found.arc_power_mW:.3g} mW in arcs",
        ),
        line("balance", f"energy {found.energy_residual:.1e}", f"charge {found.charge_residual:.1e}"),
        line("wall time", f"{found.wall_per_simulated_second:.2g} s per simulated second"),
    ]
    for name, one in found.bearings.items():
        lines += ["", f"bearing {name}", *bearing_lines(one)]
    limits = next(iter(found.bearings.values())).limits
    lines += ["", *lines_under("limits", map(_limit, limits)), *lines_under("assumed", found.assumptions)]
    for name, one in found.bearings.items():
        lines += [line("", f"{name}: {text}") for text in one.assumptions if text not in found.assumptions]
    return "\n".join(lines)

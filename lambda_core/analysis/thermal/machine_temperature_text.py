"""Write the temperatures of a machine for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from lambda_core.analysis.thermal.temperature_lines import gain_text, node_words, temperature_sources
from lambda_core.domain.number_text import counted, number
from lambda_core.domain.unit_systems import UnitSystem
from lambda_core.model.settings.machine_heat import BEARING_NODES, is_numbered
from lambda_core.results.band_text import ends
from lambda_core.results.text import assumption_lines, line

if TYPE_CHECKING:
    from lambda_core.analysis.thermal.machine_temperature_report import MachineTemperatures, MachineTemperaturesOverTime

_ROWS = 12  # of the table over time
_LEAST = 0.005  # of the loss: smaller flows are left out
_LABEL, _COLUMN = 28, 12


def steady_text(found: MachineTemperatures, units: UnitSystem) -> str:
    """Return the text of steady temperatures.

    Bearings, shaft and housing, flows, the balance.
    """
    at = found.temperatures_degC
    loss = units.text(found.power_loss_W, "W", 1)
    return "\n".join(
        [
            _headline(found, [one.title for one in found.bearings.values()]),
            line("losses", f"{loss} in {counted(len(found.bearings), 'bearing')}", found.losses_from),
            line("temperatures", units.unit("degC"), f"conductances {found.conductances}"),
            *_bearing_table(found, units),
            line("shaft", f"position {units.unit('mm')}, temperature {units.unit('degC')}, heat {units.unit('W')}"),
            *(
                _row(place.node, [units.number(place.position_mm, "mm"), units.number(place.temperature_degC, "degC"),
                                  units.number(found.heat_W[place.node], "W")])
                for place in found.shaft
                if not is_numbered(place.node)
            ),
            line("housing", units.text(at["housing"], "degC", 1)) if "housing" in at else line("housing", "not joined"),
            line("ambient", units.text(at["ambient"], "degC", 1)),
            line("heat flows", f"{units.unit('W')}, between parts"),
            *(
                f"  {source:>14} -> {target:<14}{units.number(heat, 'W', 2):>10}"
                for source, target, heat in ways(found)
            ),
            line("loop gain", gain_text(found.gain)),
            line("energy residual", f"{found.energy_residual:.1e} of input"),
            *temperature_sources(found.model_band),
            *_assumed(found, units),
        ]
    )  # fmt: skip


def _bearing_table(found: MachineTemperatures, units: UnitSystem) -> list[str]:
    """Return a table with a column for every bearing."""
    names = list(found.bearings)
    lines, elements = [_row("", names)], elements_in(found)
    for node in BEARING_NODES:
        values = [found.temperatures_degC.get(f"{name}.{node}") for name in names]
        if any(value is not None for value in values):
            lines.append(_row(node_words(node, elements), [units.number(value, "degC") for value in values]))
            if found.temperatures_degC_band:
                known = [found.temperatures_degC_band.get(f"{name}.{node}", []) for name in names]
                lines.append(_row("  model band", [ends(one, "degC", units) for one in known]))
    rows: list[tuple[str, str, Callable[[str], float | None], int]] = [
        ("power loss", "W", lambda name: found.bearings[name].state.power_loss_W, 2),
        ("friction torque", "N mm", lambda name: found.bearings[name].state.friction_torque_Nmm, 1),
        ("clearance in operation", "um", lambda name: found.bearings[name].state.clearance_um, 1),
        ("growth shaft - housing", "um", lambda name: found.bearings[name].growth_um, 1),
        ("viscosity at inlets", "mm2/s", lambda name: found.bearings[name].state.viscosity_mm2_per_s, 2),
        ("smallest film", "um", lambda name: found.bearings[name].state.film_um, 3),
        ("smallest Lambda", "", lambda name: found.bearings[name].state.film_parameter, 2),
        ("largest pressure", "GPa", lambda name: found.bearings[name].state.max_pressure_GPa, 3),
    ]
    for label, unit, of, digits in rows:
        shown = [units.number(of(name), unit, digits) for name in names]
        lines.append(_row(f"{label} {units.unit(unit)}".rstrip(), shown))
    return lines


def elements_in(found: MachineTemperatures) -> str:
    """Return the word for the rolling elements of all bearings."""
    words = {one.elements for one in found.bearings.values()}
    return words.pop() if len(words) == 1 else "rolling elements"


def course_text(found: MachineTemperaturesOverTime, units: UnitSystem) -> str:
    """Return the text of temperatures over time.

    It has a table, the times of rise and the balance.
    """
    nodes = [f"{name}.{part}" for name in found.bearings for part in ("inner_ring", "outer_ring", "oil")]
    nodes = [name for name in (*nodes, "housing") if name in found.temperatures_degC]
    width = max(_COLUMN, *(len(name) + 2 for name in nodes))
    loss = f"loss {units.unit('W')}"
    table = [f"{'time s':>9}{''.join(f'{name:>{width}}' for name in nodes)}{loss:>{_COLUMN}}"]
    last = len(found.time_s) - 1
    for k in sorted({round(i * last / (_ROWS - 1)) for i in range(_ROWS)}):
        values = [units.number(found.temperatures_degC[name][k], "degC") for name in nodes]
        shown = "".join(f"{value:>{width}}" for value in values)
        table.append(f"{found.time_s[k]:>9.0f}{shown}{units.number(found.power_loss_W[k], 'W'):>{_COLUMN}}")
    rises = [f"{name} {number(value, 0)} s" for name in nodes if (value := found.rise_63_s[name])]
    least = [f"{name} {units.text(min(one.clearance_um), 'um', 1)}" for name, one in found.bearings.items()]
    lines = [
        _headline(found, [one.title for one in found.bearings.values()]),
        line("temperatures", units.unit("degC"), f"conductances {found.conductances}"),
        *table,
        line("63 % of rise", "until the end:", *rises),
        line("least clearance", *least),
        line(
            "heat",
            f"in {number(found.heat_in_J / 1e3)} kJ",
            f"out {number(found.heat_out_J / 1e3)} kJ",
            f"stored {number(found.heat_stored_J / 1e3)} kJ",
            f"residual {found.energy_residual:.1e}",
        ),
        line("points", f"{found.points_solved} equilibria of the machine solved"),
    ]
    if found.gain is not None:
        lines.append(line("loop gain", gain_text(found.gain)))
    lines += _assumed(found, units)
    if found.reason:
        lines.append(line("ENDED EARLY", units.sentence(found.reason)))
    return "\n".join(lines)


def ways(found: MachineTemperatures) -> list[tuple[str, str, float]]:
    """Return the flows between parts [W].

    Each has source, target and heat; the largest comes first.

    A bearing with its oil is one part, the shaft another.
    """
    part = {place.node: "shaft" for place in found.shaft}
    part |= {f"{name}.{node}": name for name in found.bearings for node in BEARING_NODES if node != "shaft"}
    total: dict[tuple[str, str], float] = {}
    for flow in found.flows:
        one, other = (part.get(name, name) for name in (flow.source, flow.target))
        if one == other:
            continue
        is_back = (other, one) in total
        pair, heat = ((other, one), -flow.heat_W) if is_back else ((one, other), flow.heat_W)
        total[pair] = total.get(pair, 0.0) + heat
    directed = [(a, b, heat) if heat >= 0.0 else (b, a, -heat) for (a, b), heat in total.items()]
    wanted = [way for way in directed if way[2] >= _LEAST * found.power_loss_W]
    return sorted(wanted, key=lambda way: -way[2])


def _headline(found: MachineTemperatures | MachineTemperaturesOverTime, titles: Sequence[str]) -> str:
    bearings = ", ".join(
        f"{name} {title.split(' (', maxsplit=1)[0]}" for name, title in zip(found.bearings, titles, strict=True)
    )
    return f"{found.case}: {found.speed_rpm:.5g} 1/min, {bearings}"


def _row(label: str, cells: Sequence[str]) -> str:
    return f"  {label:<{_LABEL}}{''.join(f'{cell:>{max(_COLUMN, len(cell) + 2)}}' for cell in cells)}"


def _assumed(found: MachineTemperatures | MachineTemperaturesOverTime, units: UnitSystem) -> list[str]:
    return [
        *(line("network" if i == 0 else "", units.sentence(text)) for i, text in enumerate(found.network_assumptions)),
        *assumption_lines(found.assumptions),
    ]

"""Write temperatures for people."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import counted, number
from lambda_core.domain.unit_systems import UnitSystem
from lambda_core.domain.wrapping import lines_under
from lambda_core.model.settings.machine_heat import is_numbered
from lambda_core.model.settings.resolve_thermal import SUPPLY
from lambda_core.results.band_text import ends, source_lines
from lambda_core.results.text import assumption_lines, line

if TYPE_CHECKING:
    from lambda_core.analysis.thermal.report import BearingState, LoopGain, SteadyTemperatures, TemperaturesOverTime
    from lambda_core.results.model_band import ModelBand

_ROWS = 12  # of the table over time
_LEAST = 0.005  # of the loss: smaller flows are left out
_LABEL, _COLUMN = 28, 12
_EXPLAINED = ("oil", "inner ring", "outer ring", "housing")  # nodes whose bands are explained
_FEW = ("inner_ring", "outer_ring", "oil")  # parts of each of several bearings that are shown over time


@dataclass(frozen=True)
class Way:
    """Heat from one part to another [W].

    Attributes
    ----------
    conductance : float or None
        [W/K]; None where more than one pair of nodes joins the parts.
    """

    source: str
    target: str
    heat: float
    conductance: float | None


def labels(found: SteadyTemperatures | TemperaturesOverTime) -> dict[str, str]:
    """Return what the nodes are called for people.

    Parts of several bearings have the name of their bearing.
    """
    words = {name: name.replace("_", " ") for name in found.temperatures_degC}
    for bearing, one in found.bearings.items():
        before = f"{bearing} " if len(found.bearings) > 1 else ""
        words |= {node: before + part_words(part, one.elements) for part, node in one.nodes.items()}
    return words


def part_words(part: str, elements: str) -> str:
    """Return what a bearing's part is called for people."""
    return elements if part == "balls" else part.replace("_", " ")


def elements_in(found: SteadyTemperatures | TemperaturesOverTime) -> str:
    """Return the word for the rolling elements of all bearings."""
    words = {one.elements for one in found.bearings.values()}
    return words.pop() if len(words) == 1 else "rolling elements"


def ways(found: SteadyTemperatures) -> list[Way]:
    """Return the flows between parts; the largest comes first.

    The shaft is one part. So is each of several bearings with its oil; of a single one every node is.
    """
    part = labels(found)
    if len(found.bearings) > 1:
        inside = [(name, own) for name, one in found.bearings.items() for own in one.nodes.items()]
        part |= {node: name for name, (own, node) in inside if own != SUPPLY}
    part |= {place.node: "shaft" for place in found.shaft}
    total: dict[tuple[str, str], float] = {}
    joined: dict[tuple[str, str], list[float]] = {}
    for flow in found.flows:
        one, other = part[flow.source], part[flow.target]
        if one == other:
            continue
        is_back = (other, one) in total
        pair, heat = ((other, one), -flow.heat_W) if is_back else ((one, other), flow.heat_W)
        total[pair] = total.get(pair, 0.0) + heat
        joined.setdefault(pair, []).append(flow.conductance_W_per_K)
    directed = [
        Way(*(pair if heat >= 0.0 else pair[::-1]), abs(heat), joined[pair][0] if len(joined[pair]) == 1 else None)
        for pair, heat in total.items()
    ]
    wanted = [way for way in directed if way.heat >= _LEAST * found.power_loss_W]
    return sorted(wanted, key=lambda way: -way.heat)


def steady_text(found: SteadyTemperatures, units: UnitSystem) -> str:
    """Return the text of steady temperatures.

    Bearings, other nodes, flows, the balance.
    """
    loss = units.text(found.power_loss_W, "W", 1)
    return "\n".join(
        [
            units.sentence(found.headline),
            line("losses", f"{loss} in {counted(len(found.bearings), 'bearing')}", found.losses_from),
            line("temperatures", units.unit("degC"), f"conductances {found.conductances}"),
            *_bearing_table(found, units),
            *_other_nodes(found, units),
            line("heat flows", units.unit("W")),
            *(
                f"  {way.source:>14} -> {way.target:<14}{units.number(way.heat, 'W', 2):>10}"
                + (f"   at {number(way.conductance, 2)} W/K" if way.conductance is not None else "")
                for way in ways(found)
            ),
            line("loop gain", _gain_text(found.gain)),
            line("energy residual", f"{found.energy_residual:.1e} of input"),
            *_sources(found.model_band),
            *_assumed(found, units),
        ]
    )


def _bearing_table(found: SteadyTemperatures, units: UnitSystem) -> list[str]:
    """Return a table with a column for every bearing."""
    bearings = list(found.bearings.values())
    lines, elements = [_row("", list(found.bearings))], elements_in(found)
    for part in dict.fromkeys(part for one in bearings for part in one.nodes if part != "shaft"):
        nodes = [one.nodes.get(part, "") for one in bearings]
        at = [found.temperatures_degC.get(node) for node in nodes]
        lines.append(_row(part_words(part, elements), [units.number(value, "degC") for value in at]))
        if found.temperatures_degC_band:
            known = [found.temperatures_degC_band.get(node, []) for node in nodes]
            lines.append(_row("  model band", [ends(one, "degC", units) for one in known]))
        heat = [found.heat_W.get(node) for node in nodes]
        if any(heat):
            lines.append(_row(f"  heat put in {units.unit('W')}", [units.number(value, "W", 2) for value in heat]))
    rows: list[tuple[str, str, Callable[[BearingState], float | None], int]] = [
        ("power loss", "W", lambda one: one.state.power_loss_W, 2),
        ("friction torque", "N mm", lambda one: one.state.friction_torque_Nmm, 1),
        ("clearance in operation", "um", lambda one: one.state.clearance_um, 1),
        *([("growth shaft - housing", "um", lambda one: one.growth_um, 1)] if len(found.shaft) > 1 else []),
        ("oil at inlets", "degC", lambda one: one.state.inlet_degC, 1),
        ("viscosity at inlets", "mm2/s", lambda one: one.state.viscosity_mm2_per_s, 2),
        ("smallest film", "um", lambda one: one.state.film_um, 3),
        ("smallest Lambda", "", lambda one: one.state.film_parameter, 2),
        ("largest pressure", "GPa", lambda one: one.state.max_pressure_GPa, 3),
    ]
    for label, unit, of, digits in rows:
        shown = [units.number(of(one), unit, digits) for one in bearings]
        lines.append(_row(f"{label} {units.unit(unit)}".rstrip(), shown))
    return lines


def _other_nodes(found: SteadyTemperatures, units: UnitSystem) -> list[str]:
    """Return a table of shaft, housing and other nodes."""
    own = {node for one in found.bearings.values() for part, node in one.nodes.items() if part != "shaft"}
    along = {place.node: units.number(place.position_mm, "mm") for place in found.shaft}
    rest = [name for name in found.temperatures_degC if name not in own and name not in along]
    head = [f"position {units.unit('mm')}", f"temperature {units.unit('degC')}", f"heat put in {units.unit('W')}"]
    lines, words = [line("other nodes", ", ".join(head))], labels(found)
    for name in (*(place for place in along if not is_numbered(place)), *rest):
        numbers = [
            along.get(name, ""),
            units.number(found.temperatures_degC[name], "degC"),
            units.number(found.heat_W[name], "W"),
        ]
        band = found.temperatures_degC_band.get(name)
        lines.append(_row(words[name], numbers) + (f"   model {ends(band, 'degC', units)}" if band else ""))
    return lines


def course_text(found: TemperaturesOverTime, units: UnitSystem) -> str:
    """Return the text of temperatures over time.

    It has a table, the times of rise and the balance.
    """
    words = labels(found)
    least = [
        f"{name if len(found.bearings) > 1 else ''} {units.text(min(one.clearance_um), 'um', 1)}".strip()
        for name, one in found.bearings.items()
    ]
    rises = [f"{words[node]} {number(value, 0)} s" for node in shown_nodes(found) if (value := found.rise_63_s[node])]
    lines = [
        units.sentence(found.headline),
        line("temperatures", units.unit("degC"), f"conductances {found.conductances}"),
        *_course_table(found, units),
        line("63 % of rise", "until the end:", *rises),
        line("least clearance", *least),
        line(
            "heat",
            f"in {number(found.heat_in_J / 1e3)} kJ",
            f"out {number(found.heat_out_J / 1e3)} kJ",
            f"stored {number(found.heat_stored_J / 1e3)} kJ",
            f"residual {found.energy_residual:.1e}",
        ),
        line("points", f"{counted(found.points_solved, 'quasi-static point')} solved"),
    ]
    if found.gain is not None:
        lines.append(line("loop gain", _gain_text(found.gain)))
    lines.append(line("model band", "of steady temperatures only (without --transient)"))
    lines += _assumed(found, units)
    if found.reason:
        lines.append(line("ENDED EARLY", units.sentence(found.reason)))
    return "\n".join(lines)


def shown_nodes(found: TemperaturesOverTime) -> list[str]:
    """Return the nodes that are shown over time.

    They are all of one bearing, and of several their rings, oil and housing.
    """
    if len(found.bearings) == 1 and len(found.shaft) <= 1:
        return list(found.temperatures_degC)
    nodes = [one.nodes[part] for one in found.bearings.values() for part in _FEW if part in one.nodes]
    return [*nodes, *(["housing"] if "housing" in found.temperatures_degC else [])]


def _course_table(found: TemperaturesOverTime, units: UnitSystem) -> list[str]:
    words, nodes = labels(found), shown_nodes(found)
    columns = [(words[node], found.temperatures_degC[node], "degC") for node in nodes]
    columns.append((f"loss {units.unit('W')}", found.power_loss_W, "W"))
    if len(found.bearings) == 1:
        (one,) = found.bearings.values()
        columns.append((f"clear. {units.unit('um')}", one.clearance_um, "um"))
    widths = [max(_COLUMN, len(head) + 2) for head, _, _ in columns]
    table = [f"{'time s':>9}" + "".join(f"{head:>{n}}" for (head, _, _), n in zip(columns, widths, strict=True))]
    last = len(found.time_s) - 1
    for k in sorted({round(i * last / (_ROWS - 1)) for i in range(_ROWS)}):
        cells = [units.number(values[k], unit) for _, values, unit in columns]
        table.append(f"{found.time_s[k]:>9.0f}" + "".join(f"{c:>{n}}" for c, n in zip(cells, widths, strict=True)))
    return table


def _sources(band: ModelBand | None) -> list[str]:
    """Return the sources of the bands of temperatures.

    They are those of oil, rings and housing.
    """
    if band is None:
        return []
    ending = tuple(f"{node} temperature" for node in _EXPLAINED)
    shown = band.model_copy(update={"bands": [one for one in band.bands if one.quantity.endswith(ending)]})
    return lines_under("model band", source_lines(shown))


def _gain_text(gain: LoopGain) -> str:
    """Return the gain of the loop.

    It is the gain from torque to temperature and back, with its two parts.
    """
    # what rounds to nothing has no sign; a format of numbers would say -0.00
    clearance, viscosity, loop = (round(part, 2) + 0.0 for part in (gain.clearance, gain.viscosity, gain.loop))
    return f"{loop:.2f}   (clearance alone {clearance:+.2f}, viscosity alone {viscosity:+.2f}; from 1 on: runaway)"


def _row(label: str, cells: Sequence[str]) -> str:
    return f"  {label:<{_LABEL}}{''.join(f'{cell:>{max(_COLUMN, len(cell) + 2)}}' for cell in cells)}"


def _assumed(found: SteadyTemperatures | TemperaturesOverTime, units: UnitSystem) -> list[str]:
    """Return the network's assumptions.

    They are complete; further lines say where the other assumptions are.
    """
    return [
        *lines_under("network", map(units.sentence, found.network_assumptions)),
        *assumption_lines(found.assumptions),
    ]

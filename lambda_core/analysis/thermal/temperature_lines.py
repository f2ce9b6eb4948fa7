"""Print temperatures as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lambda_core.domain.number_text import number
from lambda_core.results.band_text import ends, source_lines
from lambda_core.results.text import assumption_lines, line

if TYPE_CHECKING:
    from lambda_core.analysis.thermal.report import LoopGain, SteadyTemperatures, TemperaturesOverTime
    from lambda_core.results.model_band import ModelBand

_ROWS = 12  # of the table over time
_NODES = ("oil", "inner ring", "outer ring", "housing")  # whose bands are explained


def node_words(node: str, elements: str) -> str:
    """Return what a node is called for people."""
    return elements if node == "balls" else node.replace("_", " ")


def steady_text(found: SteadyTemperatures) -> str:
    """Return the text of steady temperatures.

    Nodes, flows, effect on the contacts.
    """
    state = found.state
    nodes = [
        f"  {node_words(name, found.elements):<14}{number(value):>9} degC{number(found.heat_W[name], 2):>11} W"
        f"{_band(found, name)}"
        for name, value in found.temperatures_degC.items()
    ]
    flows = [
        f"  {node_words(flow.source, found.elements):>14} -> {node_words(flow.target, found.elements):<14}"
        f"{number(flow.heat_W, 2):>9} W"
        f"{number(flow.conductance_W_per_K, 2):>11} W/K"
        for flow in found.flows
    ]
    return "\n".join(
        [
            found.headline,
            line("losses", found.losses_from, f"{number(state.power_loss_W)} W"),
            line("temperatures", f"conductances {found.conductances}", "(heat input in the last column)"),
            *nodes,
            line("heat flows"),
            *flows,
            line("friction torque", f"{number(state.friction_torque_Nmm)} N mm"),
            line(
                "contacts",
                f"inlets {number(state.inlet_degC)} degC",
                f"{number(state.viscosity_mm2_per_s, 2)} mm2/s",
                f"film {number(state.film_um, 3)} um",
                f"Lambda {number(state.film_parameter, 2)}",
                f"p_max {number(state.max_pressure_GPa, 3)} GPa",
            ),
            line("clearance", f"{number(state.clearance_um)} um in operation"),
            line("loop gain", gain_text(found.gain)),
            line("energy residual", f"{found.energy_residual:.1e} of input"),
            *temperature_sources(found.model_band),
            *_assumed(found),
        ]
    )


def _band(found: SteadyTemperatures, node: str) -> str:
    """Return a temperature's band as it follows the number."""
    known = found.temperatures_degC_band.get(node)
    return f"   model {ends(known, 'degC')}" if known else ""


def temperature_sources(band: ModelBand | None) -> list[str]:
    """Return the sources of the bands of temperatures.

    They are those of oil, rings and housing.
    """
    if band is None:
        return []
    ending = tuple(f"{node} temperature" for node in _NODES)
    shown = band.model_copy(update={"bands": [one for one in band.bands if one.quantity.endswith(ending)]})
    return [line("" if i else "model band", text) for i, text in enumerate(source_lines(shown))]


def course_text(found: TemperaturesOverTime) -> str:
    """Return the text of temperatures over time.

    It has a table, the times of rise and the balance.
    """
    names = list(found.temperatures_degC)
    last = len(found.time_s) - 1
    rows = sorted({round(k * last / (_ROWS - 1)) for k in range(_ROWS)})
    head = "".join(f"{node_words(name, found.elements):>12}" for name in names)
    table = [f"{'time s':>9}{head}{'loss W':>10}{'clear. um':>11}"]
    for k in rows:
        values = "".join(f"{found.temperatures_degC[name][k]:>12.1f}" for name in names)
        table.append(f"{found.time_s[k]:>9.0f}{values}{found.power_loss_W[k]:>10.1f}{found.clearance_um[k]:>11.1f}")
    rises = [
        f"{node_words(name, found.elements)} {number(value, 0)} s" for name, value in found.rise_63_s.items() if value
    ]
    lines = [
        found.headline,
        line("temperatures", f"degC, conductances {found.conductances}"),
        *table,
        line("63 % of rise", "until the end:", *rises),
        line("clearance", f"smallest {number(found.smallest_clearance_um)} um"),
        line(
            "heat",
            f"in {number(found.heat_in_J / 1e3)} kJ",
            f"out {number(found.heat_out_J / 1e3)} kJ",
            f"stored {number(found.heat_stored_J / 1e3)} kJ",
            f"residual {found.energy_residual:.1e}",
        ),
        line("points", f"{found.points_solved} quasi-static points solved"),
    ]
    if found.gain is not None:
        lines.append(line("loop gain", gain_text(found.gain)))
    lines += _assumed(found)
    if found.reason:
        lines.append(line("ENDED EARLY", found.reason))
    return "\n".join(lines)


def _assumed(found: SteadyTemperatures | TemperaturesOverTime) -> list[str]:
    """Return the network's assumptions.

    They are complete; further lines say where the other assumptions are.
    """
    return [
        *(line("network" if i == 0 else "", text) for i, text in enumerate(found.network_assumptions)),
        *assumption_lines(found.assumptions),
    ]


def gain_text(gain: LoopGain) -> str:
    """Return the gain of the loop.

    It is the gain from torque to temperature and back, with its two parts.
    """
    # what rounds to nothing has no sign; a format of numbers would say -0.00
    clearance, viscosity, loop = (round(part, 2) + 0.0 for part in (gain.clearance, gain.viscosity, gain.loop))
    return f"{loop:.2f}   (clearance alone {clearance:+.2f}, viscosity alone {viscosity:+.2f}; from 1 on: runaway)"

"""Show the summary of a result in a narrow column."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from rich.text import Text

from lambda_core import api
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_gui.shown_units import fact_in_units

if TYPE_CHECKING:
    from lambda_core.api import Summary

_LABEL = 16


def _currents(summary: Summary) -> Sequence[tuple[str, str, str]]:
    """Return bearing voltage and discharges.

    The run has a circuit.
    """
    found = summary.currents
    if found is None:
        return ()
    return [(one.column, one.number(value), one.unit) for one, value in api.shown_numbers(found, ("currents",))]


def summary_view(summary: Summary, colours: Mapping[str, str], units: UnitSystem = SI) -> Text:
    """Return the summary of a run.

    It shows friction, kinematics, films, capacitance and accuracy.
    """
    text = Text()
    for line in units.sentence(summary.headline).splitlines():
        text.append(f"{line}\n", style="dim")
    verdict, style = (
        ("converged", colours["success"])
        if summary.converged
        else (f"not converged, {summary.state}", colours["warning"])
    )
    torque, scatter = _torque(summary, units)
    text.append(f"\nfriction torque {torque}", style="bold").append(f"   {verdict}\n", style=style)
    turns = "roller orbits" if summary.full_complement else "cage revolutions"
    if summary.revolutions_averaged:
        text.append(f"{scatter}mean over {summary.revolutions_averaged} {turns}, 95 % confidence\n", style="dim")
    for reason in summary.reasons:
        text.append(f"  {reason}\n", style=colours["warning"])
    for warning in summary.warnings:
        text.append("▲ ", style=colours["warning"]).append(f"{units.sentence(warning)}\n")
    _breakdown(text, summary, units)
    rows: list[tuple[str, str, str]] = [
        *_declared(summary, ("friction",), units),
        *_rated(summary, units),
        *_declared(summary, ("cage", "place", "contact", "film", "capacitance"), units),
        *(fact_in_units(row, units) for row in _currents(summary)),
        *_declared(summary, ("trust",), units),
        ("wall time", f"{summary.wall_s:.2f}", f"s for {summary.simulated_s:.4g} s"),
    ]
    width = max(_LABEL, *(len(label) + 2 for label, *_ in rows))
    for label, value, unit in rows:
        text.append(f"{label:<{width}}", style="dim").append(value).append(f" {unit}\n", style="dim")
    if summary.assumptions:
        text.append("\nassumed\n", style="dim")
        for assumption in summary.assumptions:
            text.append("· ", style="dim").append(f"{units.sentence(assumption)}\n")
    return text


def _torque(summary: Summary, units: UnitSystem) -> tuple[str, str]:
    """Return the torque and its scatter.

    They are separate, with the digits that its model band leaves.
    """
    width = summary.friction_torque_ci_Nmm
    if not summary.friction_torque_Nmm_band:
        return units.plus_minus(summary.friction_torque_Nmm, width, "N mm"), ""
    scatter = "" if width is None else f"scatter ± {units.value(width, 'N mm'):.2g} {units.unit('N mm')}, "
    return api.shown(summary, "friction_torque_Nmm", units), scatter


def _declared(summary: Summary, groups: Sequence[str], units: UnitSystem) -> list[tuple[str, str, str]]:
    """Return the declared numbers of groups.

    Each has a name, a number and a unit.
    """
    return [
        (one.column, api.shown(summary, one.name, units), "")
        if getattr(summary, f"{one.name}_band", [])
        else (one.column, one.number(value, units), units.unit(one.unit))
        for one, value in api.shown_numbers(summary, groups)
        if one.name != "friction_torque_Nmm"
    ]


def _rated(summary: Summary, units: UnitSystem) -> list[tuple[str, str, str]]:
    """Return the ratings of standards and catalogues for the run."""
    rating = summary.rating
    if rating is None:
        return []
    shown = api.shown_numbers(rating, ("catalogue", "life"))
    return [(one.column, one.number(value, units), units.unit(one.unit)) for one, value in shown]


def _breakdown(text: Text, summary: Summary, units: UnitSystem) -> None:
    """Append the parts of the friction torque.

    The rings stand side by side; the rest follows.
    """
    parts = summary.friction_breakdown_Nmm
    text.append(f"\n{units.unit('N mm'):<{_LABEL}}{'inner':>9}{'outer':>9}{'both':>9}\n", style="dim")
    for mechanism in dict.fromkeys(name.rpartition("_")[0] for name in parts if name.endswith(("_inner", "_outer"))):
        text.append(f"{mechanism:<{_LABEL}}", style="dim")
        rings = [parts.get(f"{mechanism}_{ring}") for ring in ("inner", "outer")]
        for value in (*rings, sum(part for part in rings if part is not None)):
            text.append(f"{units.number(value, 'N mm'):>9}")
        text.append("\n")
    for name, value in parts.items():
        if not name.endswith(("_inner", "_outer")):
            shown = "neighbours" if name == "cage" and summary.full_complement else name
            text.append(f"{shown:<{_LABEL}}", style="dim").append(f"{units.number(value, 'N mm'):>27}\n")
    text.append("\n")

"""The summary of a result, laid out for a narrow column."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from rich.text import Text

from lambda_core.domain.number_text import NONE, hours, interval, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_gui.shown_units import fact_in_units

if TYPE_CHECKING:
    from lambda_core.api import Summary

_LABEL = 16


def _currents(summary: Summary) -> Sequence[tuple[str, str, str]]:
    """Return bearing voltage and discharges of a run with a circuit."""
    found = summary.currents
    if found is None:
        return ()
    return (
        ("bearing voltage", interval(found.bearing_voltage_V, 1), "V"),
        ("discharges", f"{found.discharges_per_s:.4g}", "1/s"),
        ("in arcs", f"{found.arc_power_mW:.3g}", "mW"),
    )


def summary_view(summary: Summary, colours: Mapping[str, str], units: UnitSystem = SI) -> Text:
    """Return what a run found: friction, kinematics, films, capacitance, how far it can be trusted."""
    text = Text()
    for line in units.sentence(summary.headline).splitlines():
        text.append(f"{line}\n", style="dim")
    verdict, style = (
        ("converged", colours["success"])
        if summary.converged
        else (f"not converged, {summary.state}", colours["warning"])
    )
    torque = units.plus_minus(summary.friction_torque_Nmm, summary.friction_torque_ci_Nmm, "N mm")
    text.append(f"\nfriction torque {torque}", style="bold").append(f"   {verdict}\n", style=style)
    if summary.revolutions_averaged:
        text.append(f"mean over {summary.revolutions_averaged} cage revolutions, 95 % confidence\n", style="dim")
    for reason in summary.reasons:
        text.append(f"  {reason}\n", style=colours["warning"])
    for warning in summary.warnings:
        text.append("▲ ", style=colours["warning"]).append(f"{units.sentence(warning)}\n")
    _breakdown(text, summary, units)
    x, y, z = (number(value, 2) for value in summary.inner_ring_displacement_um)
    slip = summary.cage_speed_over_epicyclic
    rows: Sequence[tuple[str, str, str]] = (
        ("power loss", number(summary.power_loss_W, 1), "W"),
        *_rated(summary),
        ("input torque", number(summary.input_torque_Nmm), "N mm"),
        ("cage speed", number(summary.cage_speed_ratio, 4), "of inner ring"),
        ("  slip", "-" if slip is None else f"{100.0 * (1.0 - slip):.2f}", "% against epicyclic"),
        ("inner ring", f"{x}  {y}  {z}", "um (x, y, z)"),
        ("tilt", "  ".join(number(angle, 2) for angle in summary.inner_ring_tilt_mrad), "mrad (y, z)"),
        ("p_max", number(summary.max_pressure_GPa, 3), "GPa"),
        ("smallest film", number(summary.min_film_um, 2), "um (minimum)"),
        ("central film", interval(summary.film_um, 2), "um"),
        ("Lambda", interval(summary.film_parameter, 1), ""),
        ("C of contacts", interval(summary.contact_capacitance_pF, 0), "pF"),
        ("C of bearing", number(summary.bearing_capacitance_nF, 3), "nF"),
        *_currents(summary),
        ("energy residual", "-" if summary.energy_residual is None else f"{summary.energy_residual:.1e}", "of input"),
        ("wall time", f"{summary.wall_s:.2f}", f"s for {summary.simulated_s:.4g} s"),
    )
    for label, value, unit in (fact_in_units(row, units) for row in rows):
        text.append(f"{label:<{_LABEL}}", style="dim").append(value).append(f" {unit}\n", style="dim")
    if summary.assumptions:
        text.append("\nassumed\n", style="dim")
        for assumption in summary.assumptions:
            text.append("· ", style="dim").append(f"{units.sentence(assumption)}\n")
    return text


def _rated(summary: Summary) -> list[tuple[str, str, str]]:
    """Return the ratings of standards and catalogues for the run."""
    rating = summary.rating
    if rating is None:
        return []
    return [
        ("  SKF", number(rating.skf_torque_Nmm, 0), "N mm"),
        ("  Schaeffler", number(rating.schaeffler_torque_Nmm, 0), "N mm"),
        ("life L10rh", _life(rating.reference_life_h), "h (ISO/TS 16281)"),
        ("life L10h", _life(rating.basic_life_h), "h (ISO 281)"),
        ("static safety", number(rating.static_safety, 1), "C0/P0"),
        ("kappa", number(rating.viscosity_ratio, 1), ""),
    ]


def _life(life_h: float | None) -> str:
    return NONE if life_h is None else hours(life_h).removesuffix(" h")


def _breakdown(text: Text, summary: Summary, units: UnitSystem) -> None:
    """Append the parts of the friction torque: per ring side by side, then the rest."""
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
            text.append(f"{name:<{_LABEL}}", style="dim").append(f"{units.number(value, 'N mm'):>27}\n")
    text.append("\n")

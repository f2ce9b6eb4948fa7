"""Tables of a report: key figures, losses, contacts, points of a study, values and laws with their sources."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.units import show
from lambda_core.views.table import StudyTable

if TYPE_CHECKING:
    from lambda_core.model.bearing_model import ResolvedValue


_ROWS = 1000  # of a study's table


# Sections of a case whose entries are parts: materials.inner, forces.ball_inner ...
_IN_PARTS = ("materials", "forces", "bodies")


_CONTACT = "contacts at the end state"


@dataclass(frozen=True)
class Table:
    """One table of a page: a caption, headings, rows of text."""

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def key_figures(summary: Any, units: UnitSystem = SI) -> list[tuple[str, str, str]]:
    """Return what an engineer looks for first: loss, life, safety, lubrication; each name, number, unit."""
    rating, torque = summary.rating, units.unit("N mm")
    mean = units.plus_minus(summary.friction_torque_Nmm, summary.friction_torque_ci_Nmm, "N mm").removesuffix(torque)
    found = [("friction torque (95 %)", mean.strip(), torque), _figure("power loss", summary.power_loss_W, "W", units)]
    if rating is not None:
        found += [
            _figure("friction torque, SKF's catalogue", rating.skf_torque_Nmm, "N mm", units),
            _figure("friction torque, Schaeffler's catalogue", rating.schaeffler_torque_Nmm, "N mm", units),
            ("rating life L10rh, ISO/TS 16281", _life(rating.reference_life_h), ""),
            ("rating life L10h, ISO 281", _life(rating.basic_life_h), ""),
            ("static safety C0/P0, ISO 76", rounded(rating.static_safety, 2), ""),
            ("viscosity ratio kappa, ISO 281", rounded(rating.viscosity_ratio, 2), ""),
        ]
    tilt = ", ".join(number(angle, 2) for angle in summary.inner_ring_tilt_mrad)
    return [
        *found,
        _figure("smallest minimum film", summary.min_film_um, "um", units),
        ("Lambda, central film over roughness", "..".join(rounded(v, 2) for v in summary.film_parameter), ""),
        _figure("largest contact pressure", summary.max_pressure_GPa, "GPa", units),
        ("tilt of the inner ring y, z", tilt, "mrad"),
    ]


def _figure(name: str, value: float | None, unit: str, units: UnitSystem, digits: int = 3) -> tuple[str, str, str]:
    return name, rounded(None if value is None else units.value(value, unit), digits), units.unit(unit)


def run_figures(summary: Any, units: UnitSystem = SI) -> Table:
    """Return the remaining averages of a run."""
    position = ", ".join(units.number(value, "um", 2) for value in summary.inner_ring_displacement_um)
    rows = (
        _figure("input torque", summary.input_torque_Nmm, "N mm", units, 4),
        ("cage over inner ring speed", rounded(summary.cage_speed_ratio, 4), ""),
        ("cage over kinematic speed", rounded(summary.cage_speed_over_epicyclic, 4), ""),
        ("capacitance of the bearing", rounded(summary.bearing_capacitance_nF), "nF"),
        ("inner ring x, y, z (mean)", position, units.unit("um")),
        ("energy residual", rounded(summary.energy_residual, 2), "of input"),
        ("ends of Newton's iterations", rounded(summary.iteration_residual, 2), "of input"),
        *([("vibrations", summary.vibrations.sentence(), "")] if summary.vibrations else []),
    )
    return Table("averages of the run", ("", "value", "unit"), rows)


def currents(summary: Any) -> tuple[Table, ...]:
    """Return what the circuit of a run did; nothing where the case has none."""
    found = summary.currents
    if found is None:
        return ()
    rows = [
        ("bearing voltage, smallest and largest", "..".join(rounded(v) for v in found.bearing_voltage_V), "V"),
        ("capacitance", "..".join(rounded(v, 4) for v in found.bearing_capacitance_pF), "pF"),
        ("discharges through the bearing", rounded(found.discharges_per_s), "1/s"),
        ("discharges through one film", rounded(found.partial_discharges_per_s), "1/s"),
    ]
    for name, values, unit in (
        ("voltage of discharges", found.breakdown_voltage_V, "V"),
        ("peak current", found.peak_current_A, "A"),
    ):
        if values is not None:
            rows.append((f"{name} (10, 50, 90 %)", ", ".join(rounded(v) for v in values), unit))
    rows.append(("heat in arcs", rounded(found.arc_power_mW), "mW"))
    return (Table("bearing currents", ("", "value", "unit"), tuple(rows)),)


def watched(summary: Any) -> tuple[Table, ...]:
    """Return what observers and events of plugins say; nothing where the case has none."""
    tables = []
    if summary.observed:
        rows = tuple((f"{n.meaning} ({n.observer})", rounded(n.value, 4), n.unit) for n in summary.observed)
        tables.append(Table("observers", ("", "value", "unit"), rows))
    if summary.events:
        times = tuple(
            (f"{e.title} ({e.event})", str(e.count), rounded(e.first_s, 4), rounded(e.last_s, 4))
            for e in summary.events
        )
        tables.append(Table("events", ("", "times", "first s", "last s"), times))
    return tuple(tables)


def _life(life: float | None) -> str:
    return "–" if life is None else hours(life)


def rounded(value: float | None, digits: int = 3) -> str:
    """Write a number to a few significant digits, thousands in groups; a dash for what does not exist."""
    if value is None or not math.isfinite(value):
        return "–"
    short = float(f"{value:.{digits}g}")
    return f"{short:,.0f}".replace(",", " ") if abs(short) >= 1000.0 else f"{short:g}"


def breakdown(summary: Any, units: UnitSystem = SI) -> Table:
    total = summary.friction_torque_Nmm
    rows = [
        (
            name.replace("_", " "),
            in_unit("", value, "N mm", units)[1],
            f"{100.0 * value / total:.1f}" if total and value is not None else "",
        )
        for name, value in summary.friction_breakdown_Nmm.items()
    ]
    return Table("friction torque by mechanism", ("mechanism", units.unit("N mm"), "%"), tuple(rows))


def contacts(summary: Any, units: UnitSystem = SI) -> Table:
    load, film = units.unit("N"), units.unit("um")
    head = ("ball", "ring", "azimuth deg", f"load {load}", "contact angle deg", f"film {film}", "capacitance pF")
    rows = tuple(
        (
            str(c.ball), c.ring, f"{c.azimuth_deg:.1f}", f"{units.value(c.load_N, 'N'):.1f}",
            f"{c.contact_angle_deg:.2f}", in_unit("", c.film_um, "um", units)[1], written(c.capacitance_pF),
        )
        for c in summary.contacts
    )  # fmt: skip
    return Table(_CONTACT, head, rows)


def in_unit(name: str, value: Any, unit: str, units: UnitSystem) -> tuple[str, str, str]:
    """Return a row: a name, a value in the unit in which it is shown, that unit."""
    if isinstance(value, float):
        value = units.value(value, unit)
    return name, written(value), units.unit(unit)


def convergence(summary: Any, units: UnitSystem = SI) -> Table:
    rows = [
        ("simulated time", written(summary.simulated_s), "s"),
        ("cage revolutions discarded", str(summary.revolutions_discarded), ""),
        ("cage revolutions averaged", str(summary.revolutions_averaged), ""),
        in_unit("95 % half-width of the friction torque", summary.friction_torque_ci_Nmm, "N mm", units),
        ("energy residual", written(summary.energy_residual), "of input"),
        ("ends of Newton's iterations", written(summary.iteration_residual), "of input"),
        ("wall time", written(summary.wall_s), "s"),
        *((name.replace("_", " "), f"{count:.0f}", "") for name, count in summary.solver_statistics.items()),
    ]
    return Table("convergence", ("", "value", "unit"), tuple(rows))


def study_points(table: StudyTable, units: UnitSystem = SI) -> Table:
    columns = [*table.parameters, *(c for c in table.responses if not c.is_part)]
    head = ("point", *(f"{c.label} [{units.unit(c.unit)}]" if c.unit else c.label for c in columns), "state")
    shown = table.rows()[:_ROWS]
    rows = tuple(
        (
            str(row["point"]),
            *(in_unit("", row[c.name], c.unit, units)[1] for c in columns),
            f"{row['state']}: {row['reason']}" if row["reason"] else row["state"],
        )
        for row in shown
    )
    left = f" (the first {_ROWS} of {len(table)})" if len(table) > _ROWS else ""
    return Table(f"points{left}", head, rows)


def value_tables(values: Iterable[ResolvedValue], units: UnitSystem = SI) -> tuple[Table, ...]:
    """Return the resolved values with their sources, a table for each section of the case.

    What parts of a section share (the material of rings and balls, the laws of both raceways) stands there once.
    """
    sections: dict[str, dict[tuple[str, ...], list[str]]] = {}
    for value in values:
        section, _, name = value.path.partition(".")
        part = ""
        if section in _IN_PARTS:
            part, _, name = name.partition(".")
        shown = units.sentence(_shown(value))
        row = (name or section.removesuffix("s"), shown, value.status, value.source, value.grade)
        sections.setdefault(section, {}).setdefault(row, []).append(part.replace("_", " "))
    head = ("", "value", "status", "source", "grade")
    return tuple(
        Table(
            section, ("", "of", *head[1:]), tuple((row[0], ", ".join(parts), *row[1:]) for row, parts in rows.items())
        )
        if section in _IN_PARTS
        else Table(section, head, tuple(rows))
        for section, rows in sections.items()
    )


def _shown(value: ResolvedValue) -> str:
    if value.quantity and isinstance(value.value, float):
        return show(value.value, value.quantity, 6)
    return written(value.value)


def law_table(laws: Sequence[Mapping[str, str]]) -> Table:
    """Return every law with the force elements that use it and its parameters."""
    import json

    found: dict[tuple[str, str, str, str], list[str]] = {}
    for row in laws:
        found.setdefault((row["role"], row["model"], row["parameters"], row["distribution"]), []).append(row["element"])
    rows = []
    for (role, name, parameters, distribution), elements in found.items():
        values = ", ".join(f"{key} {written(value)}" for key, value in json.loads(parameters).items())
        rows.append((role, name, ", ".join(elements).replace("_", " "), values, distribution))
    return Table("laws", ("role", "law", "force elements", "parameters (SI)", "package"), tuple(rows))


def written(value: object) -> str:
    """Write one entry of a table; a dash for what does not exist."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.5g}" if isinstance(value, float) else str(value)

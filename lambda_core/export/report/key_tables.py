"""Make the tables of a report."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.results.band_text import ends
from lambda_core.results.bearing_summary import BearingSummary
from lambda_core.results.machine_numbers import total
from lambda_core.results.model_band import sum_of_bands
from lambda_core.results.quantity import quantities, quantity_of, remaining
from lambda_core.results.text import PLACED

if TYPE_CHECKING:
    from lambda_core.results.quasistatic import RollerStatics
    from lambda_core.results.verdict import Verdict


_NOTHING = 1e-9  # a number in the units of the interface below which there is nothing
_UNKNOWN = ("–", "-", "")  # what is written for a value that does not exist
_LEAST_PART = 5e-4  # of the friction torque that a mechanism has to have
_LEAST_LOAD = 0.01  # of the largest load of a contact, as in `loaded balls`


@dataclass(frozen=True)
class Table:
    """One table of a page.

    It has a caption, headings and rows of text.
    """

    caption: str
    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def key_figures(found: Any, units: UnitSystem = SI) -> list[tuple[str, str, str]]:
    """Return loss, lives, safety, film and pressure.

    Each has a name, a number and a unit; a table over the bearings of a machine has the same.

    `found` is a run, an equilibrium, or a bearing of one.
    """
    rating, torque = getattr(found, "rating", None), units.unit("N mm")
    width = getattr(found, "friction_torque_ci_Nmm", None)
    mean = units.plus_minus(found.friction_torque_Nmm, width, "N mm").removesuffix(torque)
    rows = [(f"friction torque{'' if width is None else ' (95 %)'}", mean.strip(), torque)]
    rows += _band(found, "friction_torque_Nmm", "N mm", "friction torque, 90 % model band", units)
    rows.append(_figure(found, "power_loss_W", units))
    rows += _band(found, "power_loss_W", "W", "power loss, 90 % model band", units)
    rows += [(f"{text} {symbol}, {standard}", _life(life), "") for text, symbol, standard, life in _every_life(found)]
    if rating is not None:
        rows.append(_figure(rating, "static_safety", units, "static safety C0/P0, ISO 76"))
    film = getattr(found, "min_film_um", None)
    rows.append(
        _figure(found, "min_film_um", units)
        if film is not None
        else (
            "smallest central film",
            rounded(units.value(min(found.film_um, default=math.nan), "um")),
            units.unit("um"),
        )
    )
    return _known([*rows, _figure(found, "max_pressure_GPa", units)])


def more_figures(found: Any, units: UnitSystem = SI) -> list[tuple[str, str, str]]:
    """Return catalogues' torques, lubrication, tilt and the rest."""
    rating, rows = getattr(found, "rating", None), []
    if rating is not None:
        rows = [
            _figure(rating, "skf_torque_Nmm", units),
            _figure(rating, "schaeffler_torque_Nmm", units),
            _figure(rating, "viscosity_ratio", units, "viscosity ratio kappa, ISO 281"),
        ]
    if found.film_parameter:
        label = quantity_of(found, "film_parameter").label
        rows.append((label, "..".join(rounded(v, 2) for v in found.film_parameter), ""))
    rows += [*_ribs(getattr(found, "rollers", None), units), _vector(found, "inner_ring_tilt_mrad", units)]
    return _known([*rows, *(_remaining(found, units) if not isinstance(found, BearingSummary) else ())])


def _ribs(found: RollerStatics | None, units: UnitSystem) -> list[tuple[str, str, str]]:
    """Return what ribs of rollers carry, where they do."""
    if found is None or found.rib_load_N <= 0.0:
        return []
    film = None if found.rib_film_um is None else units.value(found.rib_film_um, "um")
    return [
        ("largest load of a rib", rounded(units.value(found.rib_load_N, "N")), units.unit("N")),
        ("smallest film of a rib", rounded(film), units.unit("um")),
        ("coefficient of friction of a rib", rounded(found.rib_friction), ""),
    ]


def _known(rows: Iterable[tuple[str, str, str]]) -> list[tuple[str, str, str]]:
    """Return the figures that have a value."""
    return [row for row in rows if row[1] not in _UNKNOWN]


def _remaining(found: Any, units: UnitSystem) -> list[tuple[str, str, str]]:
    """Return the remaining declared numbers.

    No table here places them by hand.
    """
    return [(one.label, one.cell(value, units), units.unit(one.unit)) for one, value in remaining(found, PLACED)]


def _band(found: Any, field: str, unit: str, name: str, units: UnitSystem) -> list[tuple[str, str, str]]:
    """Return the row of a model band.

    The list is empty where there is none.
    """
    own = getattr(found, f"{field}_band", [])
    return [(name, ends(own, unit, units, named=True), "")] if own else []


def _every_life(found: Any) -> list[tuple[str, str, str, float | None]]:
    """Return the rating lives: meaning, symbol, standard, hours."""
    rating = getattr(found, "rating", None)
    if rating is None:
        return []
    lives_h = (rating.basic_life_h, rating.modified_life_h, rating.reference_life_h, rating.modified_reference_life_h)
    names = (
        ("rating life", "L10h", "ISO 281"),
        ("modified life", "Lnmh", "ISO 281"),
        ("rating life", "L10rh", "ISO/TS 16281"),
        ("modified life", "Lnmrh", "ISO/TS 16281"),
    )
    return [(*name, life) for name, life in zip(names, lives_h, strict=True)]


def lives(found: Any, element: str = "ball") -> Table:
    """Return rating lives with what they count."""
    counts = {
        "L10h": "catalogue's C and equivalent load",
        "Lnmh": "with a_ISO: cleanliness, film, fatigue limit",
        "L10rh": f"load of every {element}: clearance, tilt, preload",
        "Lnmrh": f"load of every {element}, and a_ISO",
    }
    rows = [(symbol, _life(life), standard, counts[symbol]) for _, symbol, standard, life in _every_life(found)]
    rating = getattr(found, "rating", None)
    caption = "rating lives, 90 % reach them"
    if rating is not None and rating.contamination is not None:
        given = "" if rating.contamination_given else ", normal cleanliness: the case gives none"
        caption += f" (e_C {rating.contamination:g}{given})"
    return Table(caption, ("", "hours", "standard", "counts"), tuple(rows))


def margins(verdict: Verdict, units: UnitSystem = SI) -> Table:
    """Return every requirement and limit with number, limit and share."""
    rows = tuple(
        (
            one.name if one.name != "load" else "load P, least",
            one.number(one.value, units),
            f"{one.side} {one.number(one.limit, units)}",
            f"{100.0 * one.share:.3g} %" if one.side == "at most" else f"{rounded(one.share)} times",
            "yes" if one.met else "NO",
            one.basis,
        )
        for one in verdict.margins
    )
    return Table("", ("", "found", "limit", "of limit", "met", "from"), rows)


def margins_of_two(tables: Mapping[str, Table]) -> Table:
    """Return the margins of two bearings in one table.

    Parameters
    ----------
    tables : mapping
        Name of a bearing -> its table of :func:`margins`.
    """
    own = [{row[0]: row for row in table.rows} for table in tables.values()]
    rows = []
    for name in dict.fromkeys(name for each in own for name in each):
        found = [each.get(name) for each in own]
        cells = [_margin_cells(row) for row in found]
        bases = dict.fromkeys(row[-1] for row in found if row is not None)
        rows.append((name, *cells[0], *cells[1], "; ".join(bases)))
    head = [cell for name in tables for cell in (name, "limit", "of limit")]
    return Table("", ("", *head, "from"), tuple(rows))


def _margin_cells(row: tuple[str, ...] | None) -> tuple[str, str, str]:
    """Return number, limit and share of a margin."""
    if row is None:
        return "", "", ""
    _, value, limit, share, met, _ = row
    return value, limit, share if met == "yes" else f"{share}, NOT met"


def machine_figures(found: Any, units: UnitSystem = SI, run: Any = None) -> Table:
    """Return the key figures of a machine.

    Each bearing has a column, and one column is for all of them.

    Parameters
    ----------
    found : MachineEquilibrium
        Loads, lives and films.
    run : Summary, optional
        Of a run: friction and losses are its averages.
    """
    each = list(found.bearings.values())
    moving = [run.bearings[one.name] for one in each] if run is not None else each
    torque = (run if run is not None else found).friction_torque_Nmm
    power = run.power_loss_W if run is not None else total(one.power_loss_W for one in each)

    def row(name: str, owners: Sequence[Any] = each, last: float | None = None) -> tuple[str, ...]:
        one = quantity_of(owners[0], name)
        cells = [getattr(bearing, name) for bearing in owners] + ([] if last is None else [last])
        shown = [None if value is None else units.value(value, one.unit) for value in cells]
        head = f"{one.label} {units.unit(one.unit)}".rstrip()
        return (head, *(rounded(value, one.digits) for value in shown), *([""] if last is None else []))

    def band(name: str, unit: str, label: str) -> list[tuple[str, ...]]:
        each = [getattr(one, f"{name}_band", []) for one in moving]
        each.append(sum_of_bands(each))
        return [(f"  {label}, 90 % model band", *(ends(own, unit, units) for own in each))] if any(each) else []

    rows = [
        ("bearing", *(one.title for one in each), ""),
        row("position_mm"),
        row("radial_load_N"),
        row("axial_load_N"),
        *(
            (f"{symbol}, {standard}", *(_life(_every_life(one)[i][3]) for one in each),
             _life(found.system_life_h) if symbol == "L10rh" else "")
            for i, (_, symbol, standard, _) in enumerate(_every_life(each[0]))
        ),
        row("static_safety", [one.rating for one in each]),
        row("max_pressure_GPa", moving),
        row("friction_torque_Nmm", moving, torque),
        *band("friction_torque_Nmm", "N mm", "torque"),
        row("power_loss_W", moving, power),
        *band("power_loss_W", "W", "loss"),
        (f"film {units.unit('um')}", *("..".join(rounded(units.value(v, "um"), 2) for v in one.film_um)
                                       for one in moving), ""),
    ]  # fmt: skip
    return Table("loads, lives and losses", ("", *(one.name for one in each), "all bearings"), tuple(rows))


def machine_reactions(found: Any, units: UnitSystem = SI) -> Table:
    """Return the reactions of a machine.

    They are forces and moments of the bearings on the shaft, and the forces of gears.
    """
    force, moment = units.unit("N"), units.unit("N m")
    head = ("", f"x {force}", f"y {force}", f"z {force}", f"about y {moment}", f"about z {moment}")
    rows = [
        (
            one.name,
            *(rounded(units.value(value, "N")) for value in one.force_N),
            *(rounded(units.value(value, "N m")) for value in one.moment_Nm),
        )
        for one in found.bearings.values()
    ]
    rows += [
        (f"gear {name}: F_t, F_r, F_a", *(rounded(units.value(value, "N")) for value in forces), "", "")
        for name, forces in found.gears.items()
    ]
    return Table("forces and moments of the bearings on the shaft", head, tuple(rows))


def _figure(record: Any, name: str, units: UnitSystem, label: str = "") -> tuple[str, str, str]:
    """Return name, number and unit of a field.

    They are declared.
    """
    one, value = quantity_of(record, name), getattr(record, name)
    number = None if value is None else units.value(value, one.unit)
    return label or one.label, rounded(number, one.digits), units.unit(one.unit)


def _vector(record: Any, name: str, units: UnitSystem) -> tuple[str, str, str]:
    """Return name, numbers and unit of a declared vector."""
    one, axes = quantity_of(record, name), getattr(record, name)
    numbers = (number(None if value is None else units.value(value, one.unit), one.decimals) for value in axes)
    return f"{one.label} {', '.join(one.axes)}", ", ".join(numbers), units.unit(one.unit)


def run_figures(summary: Any, units: UnitSystem = SI) -> Table:
    """Return the remaining averages of a run."""
    full = summary.full_complement
    rows = (
        _figure(summary, "input_torque_Nmm", units),
        _figure(summary, "cage_speed_ratio", units, "roller orbit over inner ring speed" if full else ""),
        _figure(summary, "cage_speed_over_epicyclic", units, "roller orbit over kinematic orbit" if full else ""),
        *_known([_figure(summary, "second_cage_speed_ratio", units)]),
        _figure(summary, "bearing_capacitance_nF", units),
        _vector(summary, "inner_ring_displacement_um", units),
        (*_figure(summary, "energy_residual", units)[:2], "of input"),
        (*_figure(summary, "iteration_residual", units)[:2], "of input"),
        *_remaining(summary, units),
        *([("vibrations", summary.vibrations.sentence(), "")] if summary.vibrations else []),
    )
    return Table("averages of the run", ("", "value", "unit"), rows)


def currents(summary: Any) -> tuple[Table, ...]:
    """Return the circuit's results of a run.

    Nothing where the case has none.
    """
    found = summary.currents
    if found is None:
        return ()
    numbers = [one for one in quantities(type(found)).values() if getattr(found, one.name) is not None]
    rows = [(one.label, one.cell(getattr(found, one.name)), one.unit) for one in numbers]
    return (Table("bearing currents", ("", "value", "unit"), tuple(rows)),)


def watched(summary: Any) -> tuple[Table, ...]:
    """Return the results of observers and events.

    They belong to plugins; nothing where the case has none.
    """
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
    """Write a number to few significant digits.

    Thousands in groups; a dash for what does not exist.
    """
    if value is None or not math.isfinite(value):
        return "–"
    short = float(f"{value:.{digits}g}") if abs(value) > _NOTHING else 0.0
    return f"{short:,.0f}".replace(",", " ") if abs(short) >= 1000.0 else f"{short:g}"


def breakdown(summary: Any, units: UnitSystem = SI) -> Table:
    total = summary.friction_torque_Nmm
    parts = getattr(summary, "friction_breakdown_Nmm", {})
    other = {"cage": "neighbours"} if getattr(summary, "full_complement", False) else {}
    rows = [
        (
            other.get(name, name.replace("_", " ")),
            rounded(None if value is None else units.value(value, "N mm")),
            f"{100.0 * value / total:.1f}" if total and value is not None else "",
        )
        for name, value in parts.items()
        if value is None or not total or abs(value) > _LEAST_PART * abs(total)
    ]
    return Table("friction torque by mechanism", ("mechanism", units.unit("N mm"), "%"), tuple(rows))


def contacts(summary: Any, units: UnitSystem = SI, element: str = "ball") -> Table:
    load, film = units.unit("N"), units.unit("um")
    head = (element, "ring", "azimuth deg", f"load {load}", "contact angle deg", f"film {film}", "capacitance pF")
    most = max((c.load_N for c in summary.contacts), default=0.0)
    rows = tuple(
        (
            str(c.element), c.ring, f"{c.azimuth_deg:.1f}", f"{units.value(c.load_N, 'N'):.1f}",
            number(c.contact_angle_deg, 2), rounded(None if c.film_um is None else units.value(c.film_um, "um")),
            rounded(c.capacitance_pF),
        )
        for c in summary.contacts
        if c.load_N > _LEAST_LOAD * most
    )  # fmt: skip
    return Table("contacts that carry load", head, rows)


def in_unit(name: str, value: Any, unit: str, units: UnitSystem) -> tuple[str, str, str]:
    """Return a row of name, value and unit.

    The value is in the displayed unit.
    """
    if isinstance(value, float):
        value = units.value(value, unit)
    return name, written(value), units.unit(unit)


def convergence(summary: Any, units: UnitSystem = SI) -> Table:
    label = {name: one.label for name, one in quantities(type(summary)).items()}
    turns = "roller orbits" if summary.full_complement else "cage revolutions"
    rows = [
        (label["simulated_s"], written(summary.simulated_s), "s"),
        (f"{turns} discarded", str(summary.revolutions_discarded), ""),
        (f"{turns} averaged", str(summary.revolutions_averaged), ""),
        in_unit(label["friction_torque_ci_Nmm"], summary.friction_torque_ci_Nmm, "N mm", units),
        (label["energy_residual"], written(summary.energy_residual), "of input"),
        (label["iteration_residual"], written(summary.iteration_residual), "of input"),
        ("wall time", written(summary.wall_s), "s"),
        *((name.replace("_", " "), f"{count:.0f}", "") for name, count in summary.solver_statistics.items()),
    ]
    return Table("convergence", ("", "value", "unit"), tuple(rows))


def written(value: object) -> str:
    """Write one entry of a table.

    A dash for what does not exist.
    """
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.5g}" if isinstance(value, float) else str(value)

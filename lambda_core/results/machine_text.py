"""Write the summary of a machine in lines."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import NONE, hours
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import lines_under, wrapped
from lambda_core.results.band_text import band_row, other_band_rows
from lambda_core.results.bearing_table import band_lines, bearing_table, digits
from lambda_core.results.quantity import quantities, shown
from lambda_core.results.rating import Rating
from lambda_core.results.text import assumption_lines, element_lines, line, warning_lines, watched_lines

if TYPE_CHECKING:
    from lambda_core.results.bearing_summary import BearingSummary
    from lambda_core.results.machine_numbers import Swing
    from lambda_core.results.summary import Summary


def machine_text(found: Summary, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the text of a machine's run.

    The arguments `width` and `units` are those for one bearing.
    """
    each = list(found.bearings.values())
    rows = [("bearing", [one.title.split(" (")[0] for one in each]), *_rows(found, units)]
    judged = [(name, one.verdict.lines(units)[0]) for name, one in found.bearings.items() if one.verdict]
    lines = [
        *wrapped([line(f"verdict {name}", sentence) for name, sentence in judged], width),
        f"{found.case}, {found.speed_rpm:.5g} 1/min",
        "",
        *bearing_table(list(found.bearings), rows),
        "",
    ]
    largest = max(found.orbit, key=lambda one: math.hypot(*one.swing_um[1:]))
    places = (*found.bodies.items(), *found.markers.items())
    verdict = "converged" if found.converged else "NOT CONVERGED"
    torque = units.plus_minus(found.friction_torque_Nmm, found.friction_torque_ci_Nmm, "N mm")
    rest = [
        line("friction torque", f"{torque} of all bearings", verdict),
        *lines_under("not converged", found.reasons),
        *band_lines(
            found.friction_torque_Nmm_band, {name: one.model_band for name, one in found.bearings.items()}, units
        ),
        line("power loss", f"{shown(found, 'power_loss_W', units)} of all bearings"),
        line("drive torque", shown(found, "drive_torque_Nm", units)),
        *([line("rating life", f"{hours(found.system_life_h)} of all bearings together (ISO/TS 16281, 90 %)")]
          if found.system_life_h is not None and len(each) > 1 else []),
        line(
            "largest orbit", f"y ± {_length(largest.swing_um[1], units)}", f"z ± {_length(largest.swing_um[2], units)}",
            f"at {units.text(largest.position_mm, 'mm', 2)}",
        ),
        *(line(name, *(f"{axis} {_swung(one, k, units)}" for k, axis in enumerate("xyz"))) for name, one in places),
        *element_lines(found, units),
        *(text for one in each for text in watched_lines(one)),
        *lines_under("failed", found.plugin_faults),
        *warning_lines([units.sentence(warning) for warning in found.warnings], width),
        line("energy residual", f"{shown(found, 'energy_residual')} of input"),
        *([line("vibrations", found.vibrations.sentence())] if found.vibrations else []),
        line("wall time", f"{found.wall_s:.2f} s for {found.simulated_s:.4g} s"),
        *assumption_lines(found.assumptions, found.file),
        line("result", f"{found.file}; of one bearing: --bearing {next(iter(found.bearings))}"),
    ]  # fmt: skip
    return "\n".join([*lines, *wrapped(rest, width)])


_GROUPS = ("friction", "catalogue", "life", "cage", "film", "contact")  # of numbers, in the order of their rows
_NO_ROW = ("place", "capacitance", "trust")  # groups that the text of a machine leaves to its bearings


def _rows(found: Summary, units: UnitSystem) -> list[tuple[str, list[str]]]:
    """Return a row for every number of bearings.

    A row has the name with its unit, and a cell for each bearing.
    """
    each = list(found.bearings.values())
    groups = {one.group for source in (each[0], each[0].rating) if source for one in quantities(type(source)).values()}
    others = sorted(groups - {*_GROUPS, *_NO_ROW})
    rows = [row for group in (*_GROUPS, *others) for row in _of_group(each, group, units)]
    if any(one.currents for one in each):
        voltages = [max(map(abs, one.currents.bearing_voltage_V)) if one.currents else None for one in each]
        rates = [one.currents.discharges_per_s if one.currents else None for one in each]
        rows += [("bearing voltage V", [digits(volts, 3) for volts in voltages])]
        rows += [("discharges 1/s", [digits(rate) for rate in rates])]
    for k, axis in enumerate("xyz"):
        head = f"{'force on shaft' if axis == 'x' else ' '} {axis} {units.unit('N')}"
        rows.append((head, [_pair(one.force_N[k], one.force_swing_N[k], "N", units) for one in each]))
    kinds = (type(each[0]), Rating)
    placed = {
        one.name for kind in kinds for one in quantities(kind).values() if one.column and one.group not in _NO_ROW
    }
    return [*rows, *other_band_rows(each, placed, units)]


def _of_group(each: Sequence[BearingSummary], group: str, units: UnitSystem) -> Iterator[tuple[str, list[str]]]:
    """Yield the rows of a group.

    They are of the bearings, then of their ratings, without rows that no bearing has.
    """
    sources: tuple[list[BearingSummary] | list[Rating | None], ...] = (list(each), [one.rating for one in each])
    for source in sources:
        kind = next((type(one) for one in source if one is not None), None)
        for name, one in quantities(kind).items() if kind is not None else ():
            values = [getattr(record, name, None) for record in source]
            if one.group != group or not one.column or all(value is None for value in values):
                continue
            if name == "friction_torque_Nmm":
                cells = [_pair(b.friction_torque_Nmm, b.friction_torque_ci_Nmm, one.unit, units) for b in each]
            else:
                cells = [one.cell(value, units) for value in values]
            yield one.head(units), cells
            yield from band_row(each, name, one.unit, units)


def _pair(value: float | None, width: float | None, unit: str, units: UnitSystem) -> str:
    """Write a number with its swing or uncertainty.

    It has no unit.
    """
    if value is None:
        return NONE
    text = digits(units.value(value, unit))
    return text if width is None else f"{text} ± {digits(units.value(width, unit), 2)}"


def _length(value: float, units: UnitSystem) -> str:
    return f"{units.value(value, 'um'):.3g} {units.unit('um')}"


def _swung(one: Swing, axis: int, units: UnitSystem) -> str:
    mean, swing = (units.value(values[axis], "um") for values in (one.mean_um, one.swing_um))
    return f"{digits(mean, 3)} ± {digits(swing, 2)} {units.unit('um')}"

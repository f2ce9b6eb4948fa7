"""Write the equilibrium and the modes of a machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import NONE, digits
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import lines_under, wrapped
from lambda_core.results.machine_numbers import total
from lambda_core.results.model_band import sum_of_bands
from lambda_core.results.quantity import banded_text, quantities, shown
from lambda_core.results.text import (
    by_axis,
    headed,
    life_line,
    line,
    statics_lines,
    verdict_line,
    warning_lines,
)

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import MachineModes

_AT_REST = "none: nothing turns"
_FAR = 10  # times the running speed: critical speeds beyond it are counted only
_ACROSS = ("bending", "lateral")  # kinds of modes that whirl
_HEAD, _COLUMN = 24, 14  # least widths of a table
# Matrix, its label, its unit and SI in that unit.
_MATRICES = (
    ("stiffness", "stiffness", "N/um", 1e-6),
    ("housed_stiffness", "with housing", "N/um", 1e-6),
    ("damping", "damping", "N s/m", 1.0),
)


def equilibrium_text(found: MachineEquilibrium, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the page of a machine in equilibrium.

    The shaft and the sums come first, and a section for each bearing follows.
    """
    lines = _machine_lines(found, width, units)
    for name in found.bearings:
        lines += ["", *statics_lines(found.of_bearing(name), width, units, is_section=True)]
    return "\n".join(wrapped(lines, width))


def _machine_lines(found: MachineEquilibrium, width: int | None, units: UnitSystem) -> list[str]:
    """Return what holds for all bearings and for the shaft."""
    forces = quantities(type(next(iter(found.bearings.values()))))["force_N"]
    own = [text for text in found.assumptions if not found.assumed(text)[0]]
    rest = f"and {len(found.assumptions) - len(own)} of the bearings and their laws: lambda-bearing check, --json"
    tooth = ("F_t", "F_r", "F_a")
    parts = [
        *(line(f"gear {name}", *_signed(tooth, each, "N", units)) for name, each in found.gears.items()),
        *(line(f"spring {name}", "force", *_signed("xyz", each, "N", units)) for name, each in found.springs.items()),
        *(line(name, "moves", *_signed("xyz", moved.displacement_um, "um", units))
          for name, moved in (*found.bodies.items(), *found.markers.items())),
    ]  # fmt: skip
    return [
        f"{found.case}, {found.speed_rpm:.5g} 1/min",
        *verdict_line({name: one.verdict for name, one in found.bearings.items()}),
        *(
            line(forces.column, by_axis(forces, one.force_N, units), f"of {name}")
            for name, one in found.bearings.items()
        ),
        *parts,
        headed(found, "drive_torque_Nm", units),
        *_loss_lines(found, units),
        *life_line(found.system_life_h),
        *_bending_lines(found, units),
        *warning_lines(list(map(units.sentence, found.warnings)), width),
        *lines_under("assumption", [*map(units.sentence, own), rest]),
    ]


def _signed(heads: Sequence[str], values: Sequence[float], unit: str, units: UnitSystem) -> list[str]:
    """Write the parts of a vector."""
    return [f"{head} {digits(units.value(v, unit))} {units.unit(unit)}" for head, v in zip(heads, values, strict=True)]


def _loss_lines(found: MachineEquilibrium, units: UnitSystem) -> list[str]:
    """Return torque and loss of all bearings.

    Bearings whose torque is unknown have their names here.
    """
    facts = quantities(type(next(iter(found.bearings.values()))))
    torque, loss = facts["friction_torque_Nmm"].column, facts["power_loss_W"]
    if found.speed_rpm == 0.0:
        return [line(torque, _AT_REST)]
    unknown = [name for name, one in found.bearings.items() if one.friction_torque_Nmm is None]
    if unknown:
        return [line(torque, f"unknown: no steady motion was found in {', '.join(unknown)}")]
    power = total(one.power_loss_W for one in found.bearings.values())
    ends = sum_of_bands([one.power_loss_W_band for one in found.bearings.values()])
    return [
        line(torque, shown(found, "friction_torque_Nmm", units), "of all bearings"),
        line(loss.column, banded_text(loss, power, ends, units), "of all bearings"),
    ]


def _bending_lines(found: MachineEquilibrium, units: UnitSystem) -> list[str]:
    """Return the largest deflection and bending moment, with their places."""
    bends = [math.hypot(y, z) for _, y, z in found.deflection_um]
    moments = [math.hypot(y, z) for y, z in found.bending_moment_Nm]
    each = [("deflection", bends, "um", found.positions_mm), ("bending moment", moments, "N m", found.cut_positions_mm)]
    lines = []
    for head, values, unit, places in each:
        if values:
            most, place = max(zip(values, places, strict=True))
            there = f"{digits(units.value(place, 'mm'))} {units.unit('mm')}"
            lines.append(line(head, f"{digits(units.value(most, unit))} {units.unit(unit)} at {there}"))
    return lines


def modes_text(found: MachineModes, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the text of modes and bearing matrices.

    The text has the critical speeds, too.
    """
    far = _FAR * abs(found.speed_rpm) or math.inf
    near = [one for one in found.critical_speeds if one.speed_rpm <= far] or found.critical_speeds[:1]
    speeds = [
        f"{_grouped(one.speed_rpm)} 1/min {_way(one.direction)}{_mostly(one.kind)}{_with_bodies(one.bodies_share)}"
        for one in near
    ]
    beyond = len(found.critical_speeds) - len(near)
    more = f"{beyond} more beyond {_FAR} times the speed: --json" if beyond else ""
    lines = [line("critical speeds", ", ".join(speeds) or NONE, more), ""]
    table = [f"{'frequency Hz':<{_HEAD}}{'damping %':>{_COLUMN}}   motion"]
    table += [
        f"{f'{mode.frequency_Hz:.5g}':<{_HEAD}}{f'{1e2 * mode.damping_ratio:.2g}':>{_COLUMN}}   "
        f"{mode.kind}{f', {_way(mode.direction)}' if mode.kind in _ACROSS else ''}{_with_bodies(mode.bodies_share)}"
        for mode in found.modes
    ]
    notes = lines_under("assumption", found.assumptions)
    head = [f"{found.case}, {found.speed_rpm:.5g} 1/min", ""]
    return "\n".join([*head, *wrapped(lines, width), *table, "", *_matrices(found, units), *wrapped(notes, width)])


def _matrices(found: MachineModes, units: UnitSystem) -> list[str]:
    """Return the diagonals of all bearings as a table.

    A row has the unit of the one for x; the builder asks for the modes alone.
    """
    if not found.bearings:
        return []
    rows = [("", list(found.bearings))]
    for field, label, unit, factor in _MATRICES:
        for k, axis in enumerate("xyz"):
            head = f"{label} x {units.unit(unit)}" if axis == "x" else f"  {axis}"
            values = (units.value(factor * getattr(one, field)[k][k], unit) for one in found.bearings.values())
            rows.append((head, [digits(value, 3) for value in values]))
    wide = max(_COLUMN, *(2 + len(cell) for _, cells in rows for cell in cells))
    return [*(f"{head:<{_HEAD}}" + "".join(f"{cell:>{wide}}" for cell in cells) for head, cells in rows), ""]


def _grouped(speed: float) -> str:
    """Write a speed to five digits, without an exponent."""
    return f"{float(f'{speed:.5g}'):.0f}" if speed >= 1e5 else f"{speed:.5g}"


def _mostly(kind: str) -> str:
    """Return the mark of a mode with transverse motion.

    The shaft moves across its axis among other things.
    """
    return "" if kind in _ACROSS else f" mostly {kind}"


def _with_bodies(share: float) -> str:
    """Return the mark of a mode of other bodies.

    Most of its kinetic energy is not in the shaft.
    """
    return " with bodies" if share > 0.5 else ""


def _way(direction: float) -> str:
    return "forward" if direction > 0.5 else "backward" if direction < -0.5 else "elliptic"

"""Write the equilibrium and the modes of a machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from lambda_core.domain.number_text import NONE, hours
from lambda_core.domain.unit_systems import SI, UnitSystem
from lambda_core.domain.wrapping import HEAD, lines_under, wrapped
from lambda_core.results.band_text import band_row, other_band_rows
from lambda_core.results.bearing_table import COLUMN, band_lines, bearing_table, digits
from lambda_core.results.bearing_table import HEAD as TABLE_HEAD
from lambda_core.results.quantity import Quantity, quantities
from lambda_core.results.rating import Rating
from lambda_core.results.text import contamination_text, line

if TYPE_CHECKING:
    from lambda_core.analysis.rotor.machine_equilibrium import BearingEquilibrium, MachineEquilibrium
    from lambda_core.analysis.rotor.machine_modes import BearingMatrices, MachineModes

_AT_REST, _NO_LIFE = "none: nothing turns", "none: no bearing has a rating life"
_FAR = 10  # times the running speed: critical speeds beyond it are counted only


@dataclass(frozen=True)
class _Row:
    """One line of a table over bearings.

    A number in `unit`, or text that is ready.
    """

    label: str
    unit: str
    value: Callable[[Any], float | str | None]
    digits: int = 4
    quantity: Quantity | None = None  # how the number is written

    def head(self, units: UnitSystem) -> str:
        """Return what stands before the numbers."""
        return f"{self.label} {units.unit(self.unit)}" if self.unit else self.label

    def cell(self, bearing: object, units: UnitSystem) -> str:
        """Return the number of one bearing."""
        found = self.value(bearing)
        if isinstance(found, str):
            return found
        if self.quantity is not None:
            return self.quantity.cell(found, units)
        return digits(None if found is None else units.value(found, self.unit), self.digits)


# The unit of a direction that stands below the first one is that of the first.
_STIFFNESS = (
    _Row("stiffness x", "N/um", lambda b: 1e-6 * b.stiffness[0][0], 3),
    _Row("  y", "N/um", lambda b: 1e-6 * b.stiffness[1][1], 3),
    _Row("  z", "N/um", lambda b: 1e-6 * b.stiffness[2][2], 3),
)
_MATRICES = (
    *_STIFFNESS,
    _Row("with housing x", "N/um", lambda b: 1e-6 * b.housed_stiffness[0][0], 3),
    _Row("  y", "N/um", lambda b: 1e-6 * b.housed_stiffness[1][1], 3),
    _Row("  z", "N/um", lambda b: 1e-6 * b.housed_stiffness[2][2], 3),
    _Row("damping x", "N s/m", lambda b: b.damping[0][0], 3),
    _Row("  y", "N s/m", lambda b: b.damping[1][1], 3),
    _Row("  z", "N s/m", lambda b: b.damping[2][2], 3),
)


def _equilibrium_rows(bearings: Sequence[BearingEquilibrium], units: UnitSystem) -> tuple[_Row, ...]:
    """Return a row for every number of bearings.

    Numbers of an axis stand one below the other.
    """
    rows, placed = [_Row("bearing", "", lambda b: str(b.title.split(" (")[0]))], set()

    def place(one: Quantity, row: _Row) -> None:
        placed.add(one.name)
        rows.extend((row, *_ready(bearings, band_row(bearings, one.name, one.unit, units))))

    declared = quantities(type(bearings[0]))
    for name in type(bearings[0]).model_fields:
        if name == "rating":  # its lives and safety have rows, friction of catalogues has none
            for one in quantities(Rating).values():
                if one.column and one.group == "life":
                    place(one, _of_rating(one))
        if (one := declared.get(name)) is None or not one.column:
            continue
        if one.axes:
            rows += [_axis(one, k) for k in range(len(one.axes))]
        else:
            place(one, _Row(one.column, one.unit, lambda b, q=one: getattr(b, q.name), quantity=one))  # type: ignore[misc]
    return (*rows, *_ready(bearings, other_band_rows(bearings, placed, units)), *_STIFFNESS)


def _ready(bearings: Sequence[BearingEquilibrium], written: Sequence[tuple[str, list[str]]]) -> list[_Row]:
    """Return rows whose cells are written."""
    found = []
    for head, cells in written:
        texts = {bearing.name: cell for bearing, cell in zip(bearings, cells, strict=True)}
        found.append(_Row(head, "", lambda b, texts=texts: texts[b.name]))  # type: ignore[misc]
    return found


def _of_rating(one: Quantity) -> _Row:
    """Return the row of a number of the ratings."""
    return _Row(one.column, one.unit, lambda b: getattr(b.rating, one.name), quantity=one)


def _axis(one: Quantity, k: int) -> _Row:
    """Return the row of one axis of a vector."""
    label = f"{one.column} {one.axes[k]}" if k == 0 else f"  {one.axes[k]}"
    return _Row(label, one.unit, lambda b: getattr(b, one.name)[k], quantity=one)


def _table(
    rows: tuple[_Row, ...], bearings: Sequence[BearingEquilibrium | BearingMatrices], units: UnitSystem
) -> list[str]:
    """Return a table with a column for each bearing."""
    cells = [
        (
            row.label if row.label.startswith(" ") else row.head(units),
            [row.cell(bearing, units) for bearing in bearings],
        )
        for row in rows
    ]
    return bearing_table([bearing.name for bearing in bearings], cells)


def equilibrium_text(found: MachineEquilibrium, width: int | None = None, units: UnitSystem = SI) -> str:
    """Return the text of one equilibrium.

    The bearings stand side by side, and the shaft follows.
    """
    own = [units.sentence(line) for line in _shaft_lines(found, units)]
    judged = [(one.name, one.verdict) for one in found.bearings]
    verdicts = [line(f"verdict {name}", verdict.lines(units)[0]) for name, verdict in judged]
    margins = [line(f"margins {name}", *verdict.lines(units)[1]) for name, verdict in judged if verdict.lines(units)[1]]
    head = [*wrapped([*verdicts, *margins], width), "", f"{found.case}, {found.speed_rpm:.5g} 1/min", ""]
    return "\n".join(
        [*head, *_table(_equilibrium_rows(found.bearings, units), found.bearings, units), "", *wrapped(own, width)]
    )


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
    more = f"   {beyond} more beyond {_FAR} times the speed: --json" if beyond else ""
    lines = [f"{'critical speeds':<{HEAD}}{', '.join(speeds) or NONE}{more}", ""]
    table = [f"{'frequency Hz':<{TABLE_HEAD}}{'damping %':>{COLUMN}}   motion"]
    table += [
        f"{f'{mode.frequency_Hz:.5g}':<{TABLE_HEAD}}{f'{1e2 * mode.damping_ratio:.2g}':>{COLUMN}}   "
        f"{mode.kind}{f', {_way(mode.direction)}' if mode.kind == 'bending' else ''}{_with_bodies(mode.bodies_share)}"
        for mode in found.modes
    ]
    notes = lines_under("assumption", found.assumptions)
    head = [f"{found.case}, {found.speed_rpm:.5g} 1/min", ""]
    # the builder asks for the modes alone
    matrices = [*_table(_MATRICES, found.bearings, units), ""] if found.bearings else []
    return "\n".join([*head, *wrapped(lines, width), *table, "", *matrices, *wrapped(notes, width)])


def _torque(report: MachineEquilibrium) -> str:
    """Return the torque of all bearings.

    The text names the bearings whose torque is unknown.
    """
    if report.friction_torque_Nmm is not None:
        return f"{digits(report.friction_torque_Nmm)} N mm of all bearings"
    unknown = [one.name for one in report.bearings if one.friction_torque_Nmm is None]
    return f"unknown: no steady motion was found in {', '.join(unknown)}"


def _grouped(speed: float) -> str:
    """Write a speed to five digits, without an exponent."""
    return f"{float(f'{speed:.5g}'):.0f}" if speed >= 1e5 else f"{speed:.5g}"


def _shaft_lines(report: MachineEquilibrium, units: UnitSystem) -> list[str]:
    """Return the lines about the shaft and the machine."""
    largest = max(
        ((y * y + z * z) ** 0.5, place)
        for (_, y, z), place in zip(report.deflection_um, report.positions_mm, strict=True)
    )
    moments = [
        ((y * y + z * z) ** 0.5, place)
        for (y, z), place in zip(report.bending_moment_Nm, report.cut_positions_mm, strict=True)
    ]
    bending = [f"{'bending moment':<{HEAD}}{max(moments)[0]:.4g} N m at {max(moments)[1]:.4g} mm"] if moments else []
    resting = report.speed_rpm == 0.0
    life = f"{hours(report.system_life_h)} (L_10rh of all bearings)" if report.system_life_h is not None else _NO_LIFE
    clean = {
        contamination_text(one.contamination, is_given=one.contamination_given)
        for one in (bearing.rating for bearing in report.bearings)
        if one.contamination is not None and one.modified_life_h is not None
    }
    lines = [
        f"{'deflection':<{HEAD}}{largest[0]:.3g} um at {largest[1]:.4g} mm",
        *bending,
        f"{'system life':<{HEAD}}{_AT_REST if resting else life}",
        *(f"{'modified lives':<{HEAD}}with {text}" for text in sorted(clean)),
        f"{'friction torque':<{HEAD}}{_AT_REST if resting else _torque(report)}",
        *band_lines(report.friction_torque_Nmm_band, {one.name: one.model_band for one in report.bearings}, units),
        f"{'drive torque':<{HEAD}}{digits(report.drive_torque_Nm)} N m",
    ]
    for name, (tangential, radial, axial) in report.gears.items():
        lines.append(f"{'gear ' + name:<{HEAD}}F_t {tangential:.4g} N   F_r {radial:.4g} N   F_a {axial:.4g} N")
    for name, (x, y, z) in report.springs.items():
        lines.append(f"{'spring ' + name:<{HEAD}}force x {digits(x)} N   y {digits(y)} N   z {digits(z)} N")
    for name, moved in (*report.bodies.items(), *report.markers.items()):
        each = zip("xyz", moved.displacement_um, strict=True)
        lines.append(f"{name:<{HEAD}}moves " + "   ".join(f"{axis} {digits(um, 3)} um" for axis, um in each))
    lines += [f"{'WARNING':<{HEAD}}{warning}" for warning in report.warned()]
    own = [text for text in report.assumptions if not text.startswith(_of_bearings(report))]
    rest = f"and {len(report.assumptions) - len(own)} of the bearings and their laws: lambda-bearing check, --json"
    return lines + lines_under("assumption", [*own, rest])


def _of_bearings(report: MachineEquilibrium) -> tuple[str, ...]:
    """Return the start of an assumption about bearings.

    It has one name, or several.
    """
    return tuple(f"{bearing.name}{mark}" for bearing in report.bearings for mark in (":", ","))


def _mostly(kind: str) -> str:
    """Return the mark of a mode with transverse motion.

    The shaft moves across its axis among other things.
    """
    return "" if kind == "bending" else f" mostly {kind}"


def _with_bodies(share: float) -> str:
    """Return the mark of a mode of other bodies.

    Most of its kinetic energy is not in the shaft.
    """
    return " with bodies" if share > 0.5 else ""


def _way(direction: float) -> str:
    return "forward" if direction > 0.5 else "backward" if direction < -0.5 else "elliptic"

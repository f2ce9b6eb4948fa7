"""The equilibrium of a shaft in lines for people."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from lambda_core.domain.number_text import NONE
from lambda_core.domain.wrapping import HEAD, wrapped
from lambda_core.system.operating_limits import operating_warnings

if TYPE_CHECKING:
    from lambda_core.shaft.shaft_report import BearingOnShaft, ShaftReport
    from lambda_core.system.machine import Machine

_HEAD, _COLUMN = 24, 14
_LONG_LIFE = 1e6  # beyond, a rating life says no more than that [h]


def _digits(value: float | None, digits: int = 4) -> str:
    if value is None:
        return NONE
    return f"{0.0 if abs(value) < 5e-5 else value:.{digits}g}"


def _span(values: list[float], digits: int = 3) -> str:
    return "..".join(f"{value:.{digits}g}" for value in dict.fromkeys(values)) or NONE


def hours(value: float | None) -> str:
    """Write a life."""
    if value is None:
        return NONE
    return f"> {_LONG_LIFE:.0f}" if value > _LONG_LIFE else f"{value:.0f}" if value >= 10.0 else f"{value:.2g}"


_ROWS: tuple[tuple[str, Callable[[BearingOnShaft], str]], ...] = (
    ("bearing", lambda b: b.title.split(" (")[0]),
    ("position mm", lambda b: _digits(b.position_mm, 5)),
    ("radial load N", lambda b: _digits(b.radial_load_N)),
    ("axial load N", lambda b: _digits(b.axial_load_N)),
    ("force on shaft x N", lambda b: _digits(b.force_N[0])),
    ("  y", lambda b: _digits(b.force_N[1])),
    ("  z", lambda b: _digits(b.force_N[2])),
    ("moment about y N m", lambda b: _digits(b.moment_Nm[0], 3)),
    ("  about z", lambda b: _digits(b.moment_Nm[1], 3)),
    ("displacement x um", lambda b: _digits(b.displacement_um[0], 3)),
    ("  y", lambda b: _digits(b.displacement_um[1], 3)),
    ("  z", lambda b: _digits(b.displacement_um[2], 3)),
    ("misalignment y mrad", lambda b: _digits(b.misalignment_mrad[0], 3)),
    ("  z", lambda b: _digits(b.misalignment_mrad[1], 3)),
    ("clearance um", lambda b: _digits(b.clearance_um, 3)),
    ("loaded balls", lambda b: str(b.loaded_balls)),
    ("Q_max N", lambda b: _digits(b.max_load_N)),
    ("p_max GPa", lambda b: _digits(b.max_pressure_GPa, 3)),
    ("contact angles deg", lambda b: _span(b.contact_angle_deg)),
    ("L_10h h", lambda b: hours(b.basic_rating_life_h)),
    ("L_10rh h", lambda b: hours(b.reference_rating_life_h)),
    ("L_nmrh h", lambda b: hours(b.modified_rating_life_h)),
    ("static safety", lambda b: _digits(b.static_safety, 3)),
    ("friction torque N mm", lambda b: _digits(b.friction_torque_Nmm, 3)),
    ("power loss W", lambda b: _digits(b.power_loss_W, 3)),
    ("film um", lambda b: _span(b.film_um, 2)),
    ("stiffness x N/um", lambda b: _digits(1e-6 * b.stiffness[0][0], 3)),
    ("  y", lambda b: _digits(1e-6 * b.stiffness[1][1], 3)),
    ("  z", lambda b: _digits(1e-6 * b.stiffness[2][2], 3)),
    ("damping x N s/m", lambda b: _digits(b.damping[0][0], 3)),
    ("  y", lambda b: _digits(b.damping[1][1], 3)),
    ("  z", lambda b: _digits(b.damping[2][2], 3)),
)


def report_text(report: ShaftReport, width: int | None = None) -> str:
    """Return what one equilibrium says: the bearings side by side, then the shaft."""
    names = [bearing.name for bearing in report.bearings]
    cells = [(head, [value(bearing) for bearing in report.bearings]) for head, value in _ROWS]
    wide = max(_COLUMN, 1 + max(len(text) for row in (names, *(row for _, row in cells)) for text in row))
    lines = [
        f"{report.case}, {report.speed_rpm:.5g} 1/min",
        "",
        f"{'':<{_HEAD}}" + "".join(f"{n:>{wide}}" for n in names),
    ]
    table = [f"{head:<{_HEAD}}" + "".join(f"{text:>{wide}}" for text in row) for head, row in cells]
    return "\n".join([*lines, *table, "", *wrapped(_shaft_lines(report), width)])


def _shaft_lines(report: ShaftReport) -> list[str]:
    """Return what there is to say of the shaft and of the whole."""
    largest = max(
        ((y * y + z * z) ** 0.5, place)
        for (_, y, z), place in zip(report.deflection_um, report.positions_mm, strict=True)
    )
    moment = max(
        ((y * y + z * z) ** 0.5, place)
        for (y, z), place in zip(report.bending_moment_Nm, report.cut_positions_mm, strict=True)
    )
    lines = [
        f"{'deflection':<{HEAD}}{largest[0]:.3g} um at {largest[1]:.4g} mm",
        f"{'bending moment':<{HEAD}}{moment[0]:.4g} N m at {moment[1]:.4g} mm",
        f"{'system life':<{HEAD}}{hours(report.system_life_h)} h (L_10rh of all bearings)",
        f"{'friction torque':<{HEAD}}{_digits(report.friction_torque_Nmm)} N mm of all bearings",
        f"{'drive torque':<{HEAD}}{_digits(report.drive_torque_Nm)} N m",
    ]
    for name, (tangential, radial, axial) in report.gears.items():
        lines.append(f"{'gear ' + name:<{HEAD}}F_t {tangential:.4g} N   F_r {radial:.4g} N   F_a {axial:.4g} N")
    for name, (x, y, z) in report.springs.items():
        lines.append(f"{'spring ' + name:<{HEAD}}force x {_digits(x)} N   y {_digits(y)} N   z {_digits(z)} N")
    for name, moved in (*report.bodies.items(), *report.markers.items()):
        each = zip("xyz", moved.displacement_um, strict=True)
        lines.append(f"{name:<{HEAD}}moves " + "   ".join(f"{axis} {_digits(um, 3)} um" for axis, um in each))
    speeds = [
        f"{one.speed_rpm:.5g} {_way(one.direction)}{_mostly(one.kind)}{_with_bodies(one.bodies_share)}"
        for one in report.critical_speeds[:4]
    ]
    lines.append(f"{'critical speeds':<{HEAD}}{', '.join(speeds) or NONE} 1/min")
    bending = [mode for mode in report.modes if mode.kind == "bending"][:4]
    told = [
        f"{mode.frequency_Hz:.4g} ({1e2 * mode.damping_ratio:.2g} %){_with_bodies(mode.bodies_share)}"
        for mode in bending
    ]
    lines.append(f"{'bending modes':<{HEAD}}{', '.join(told) or NONE} Hz (damping)")
    told = [*report.warnings, *(f"{one.name}: {warning}" for one in report.bearings for warning in one.warnings)]
    lines += [f"{'WARNING':<{HEAD}}{warning}" for warning in told]
    own = [text for text in report.assumptions if not text.startswith(_of_bearings(report))]
    rest = f"and {len(report.assumptions) - len(own)} of the bearings and their laws: lambda-bearing check, --json"
    return lines + [f"{'assumption' if i == 0 else '':<{HEAD}}{text}" for i, text in enumerate([*own, rest])]


def _of_bearings(report: ShaftReport) -> tuple[str, ...]:
    """Return how an assumption of bearings begins: with a name, or with several."""
    return tuple(f"{bearing.name}{mark}" for bearing in report.bearings for mark in (":", ","))


def _mostly(kind: str) -> str:
    """Return a mark for a mode in which the shaft moves across its axis among other things."""
    return "" if kind == "bending" else f" mostly {kind}"


def _with_bodies(share: float) -> str:
    """Return a mark for a mode whose kinetic energy is mostly in the bodies beside the shaft."""
    return " with bodies" if share > 0.5 else ""


def _way(direction: float) -> str:
    return "forward" if direction > 0.5 else "backward" if direction < -0.5 else "elliptic"


def shaft_warnings(model: Machine) -> list[str]:
    """Return what does not fit on a shaft, and what of its bearings is beyond a limit, before anything is solved.

    Parameters
    ----------
    model : Machine
        From :func:`check_shaft`.

    Returns
    -------
    list of str
        Sentences with the names of what they are about.
    """
    beyond = [(one.name, operating_warnings(one.model, on_shaft=True)) for one in model.bearings]
    return [*model.warnings, *(f"{name}: {warning}" for name, told in beyond for warning in told)]


def model_text(model: Machine) -> str:
    """Return what a resolved shaft is."""
    length = 1e3 * model.outline[-1][1]
    lines = [
        f"{model.name}: shaft of {length:.6g} mm, {model.body.total_mass:.4g} kg, "
        f"{30.0 / math.pi * model.speed:.5g} 1/min, {len(model.bearings)} bearings",
    ]
    for bearing in model.bearings:
        side = {1: ", takes +x", -1: ", takes -x", 0: ""}[bearing.takes]
        lines.append(
            f"{bearing.name:<{HEAD}}{bearing.model.title} at {1e3 * bearing.position:.6g} mm, clearance "
            f"{1e6 * bearing.model.geometry.clearance:.4g} um, C {1e-3 * bearing.dynamic_rating:.4g} kN, "
            f"C_0 {1e-3 * bearing.static_rating:.4g} kN{side}"
        )
    for body in model.bodies:
        lines.append(f"{body.name:<{HEAD}}body of {body.mass:.4g} kg at {1e3 * body.centre[0]:.6g} mm")
    for name, forces in model.gears.items():
        x, y, z = forces.force
        lines.append(f"{'gear ' + name:<{HEAD}}force x {x:.4g} N, y {y:.4g} N, z {z:.4g} N")
    lines += [f"{'assumption' if i == 0 else '':<{HEAD}}{text}" for i, text in enumerate(model.assumptions)]
    return "\n".join(lines + [f"{'WARNING':<{HEAD}}{text}" for text in shaft_warnings(model)])

"""Show numbers derived from a case, or its errors."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Any

from rich.text import Text
from textual.widgets import Static

from lambda_core.domain.value_status import ESTIMATED
from lambda_gui.checking import Check
from lambda_gui.shown_units import fact_in_units

if TYPE_CHECKING:
    from lambda_core.api import (
        BearingEquilibrium,
        BearingModel,
        Estimate,
        MachineEquilibrium,
        ValueReport,
    )
    from lambda_core.domain.unit_systems import UnitSystem

Fact = tuple[str, str, str]  # name, number, unit


class Derived(Static):
    """Derived quantities or the mistakes.

    They are grey while they are solved anew; mistakes prevent them.
    """

    DEFAULT_CSS = """
    Derived { width: 1fr; height: 1fr; padding: 0 1; }
    """

    def __init__(self) -> None:
        super().__init__(id="derived")
        self._check: Check | None = None
        self.estimate: Estimate | None = None
        self._say = ""
        self.is_current = False  # whether the numbers are those of the case as it stands

    def show_check(self, check: Check) -> None:
        """Take the outcome of a check.

        An estimate of the case before is shown as such.
        """
        self._check = check
        self.is_current = False
        self.draw()

    def show_estimate(self, estimate: Estimate | None, say: str) -> None:
        """Take an estimate, or what is being done about it."""
        if estimate is not None:
            self.estimate, self.is_current = estimate, True
        self._say = say
        self.draw()

    def on_resize(self) -> None:
        """Draw for the new size."""
        self.draw()

    def draw(self) -> None:
        """Draw the known numbers, in the colours of the theme."""
        check: Check | None = self._check
        if check is None:
            self.update(Text("checking ...", style="dim"))
        elif check.model is None:
            self.update(self._mistakes(check))
        else:
            self.update(self._numbers(check, self.app.units))  # type: ignore[attr-defined]

    def warnings(self) -> list[str]:
        """Return the warnings of the case.

        It leaves the limits of bearing, oil and laws: before solving, and after.
        """
        if self._check is None or self._check.model is None:
            return []
        solved = _warned_by(self.estimate.equilibrium) if self.estimate is not None and self.is_current else []
        return list(dict.fromkeys([*self._check.warnings, *solved]))

    # -- numbers --

    def _numbers(self, check: Check, units: UnitSystem) -> Text:
        """Write the numbers under the warnings.

        With several bearings each has a line, and the numbers of the shaft follow.
        """
        warned = list(map(units.sentence, self.warnings()))
        found = _of_the_case(self.estimate) if self.estimate else ()
        numbers = [fact_in_units(fact, units) for fact in found]
        if check.alone is None:
            told = self._tabled(numbers, units, max(3, self.size.height - bool(warned)))
        else:
            geometry = [fact_in_units(fact, units) for fact in _geometry(check.alone, check.values)]
            if self.size.height > len(geometry) + len(numbers) + 1 + 2 * len(warned):
                told = self._listed(geometry, numbers)
            else:
                told = self._inline([] if warned else geometry[1:], numbers)  # balls or rollers stand in the tree
        return Text("\n").join([*self._warned(warned, told), told])

    def _tabled(self, numbers: Sequence[Fact], units: UnitSystem, room: int) -> Text:
        """Write the bearings' table over the shaft's numbers.

        It has at most `room` lines.
        """
        if self.estimate is None:
            return Text(self._say or "solving ...", style="dim italic")
        report: Any = self.estimate.equilibrium
        table = _table(report, units, max(20, self.size.width), self._style())
        lines = [*table, *self._inline([], numbers).split("\n")]
        return Text("\n").join(lines if len(lines) <= room else [*lines[: room - 1], lines[-1]])

    def _warned(self, warnings: Sequence[str], told: Text) -> list[Text]:
        """Write the warnings.

        They are whole sentences as far as they leave room for the numbers; otherwise each is cut to one line.
        """
        width, colour = max(20, self.size.width), self.app.theme_variables["warning"]
        room = max(1, self.size.height - len(told.wrap(self.app.console, width)))
        lines = [Text.assemble(("▲ ", colour), warning) for warning in warnings]
        if sum(len(line.wrap(self.app.console, width)) for line in lines) <= room:
            return lines
        for line in lines:
            line.truncate(width, overflow="ellipsis")
        return lines if len(lines) <= room else [*lines[: room - 1], Text(f"▲ {len(lines)} warnings: F8", colour)]

    def _style(self) -> str:
        return "" if self.is_current else "dim"

    def _inline(self, geometry: Sequence[Fact], numbers: Sequence[Fact]) -> Text:
        """Pack the facts into as few lines as they take."""
        room, text, used = max(20, self.size.width), Text(), 0
        styled = [(fact, "") for fact in geometry] + [(fact, self._style()) for fact in numbers]
        for (name, number, unit), style in styled:
            value = f"{number} {unit}".strip()
            width = len(name) + 1 + len(value)
            if used and used + 2 + width > room:
                text.append("\n")
                used = 0
            text.append("  " if used else "").append(f"{name} ", style="dim").append(value, style=style)
            used += width + (2 if used else 0)
        if self._say:
            text.append(f"\n{self._say}", style="dim italic")
        return text

    def _listed(self, geometry: Sequence[Fact], numbers: Sequence[Fact]) -> Text:
        text = Text()
        for facts, style in ((geometry, ""), (numbers, self._style())):
            for name, number, unit in facts:
                text.append(f"{_LONG.get(name, name):<22}", style="dim").append(f"{number:>12}", style=style)
                text.append(f" {unit}\n", style="dim")
        if self._say:
            text.append(self._say, style="dim italic")
        return text

    # -- mistakes --

    def _mistakes(self, check: Check) -> Text:
        """Write as many complete mistakes as fit.

        F8 goes to the others.
        """
        width, room = max(20, self.size.width), max(self.size.height, 1)
        shown: list[Text] = []
        used = 0
        for number, problem in enumerate(check.problems):
            where = f"{problem.where}  " if problem.where else ""
            line = Text.assemble(("▲ ", self.app.theme_variables["error"]), f"{where}{problem.message}")
            lines = len(line.wrap(self.app.console, width))
            is_last = number == len(check.problems) - 1
            if used + lines > room - (0 if is_last else 1):
                break
            shown.append(line)
            used += lines
        left = len(check.problems) - len(shown)
        if left:
            more = f"and {left} more: F8" if shown else f"▲ {left} mistake{'s' * (left > 1)}: F8"
            shown.append(Text(more, style="dim"))
        return Text("\n").join(shown)


_LONG_LIFE = 1e6  # a longer rating life is only said to be longer [h]
_GAP = 2  # columns between two numbers of a table
_LONG = {
    "pitch": "pitch diameter",
    "clearance": "radial clearance",
    "α free": "free contact angle",
    "α max": "largest contact angle",
    "Q max": "largest contact load",
    "p": "largest pressure",
    "h": "film",
    "Λ": "Lambda",
    "κ": "viscosity ratio κ",
    "L10": "rating life L10h",
    "S0": "static safety",
    "M ≈": "friction torque ≈",
    "SKF": "  after SKF",
    "run ≈": "run takes ≈",
}


def _warned_by(found: Any) -> list[str]:
    """Return unmet requirements and warnings.

    Those of several bearings begin with their names.
    """
    return [
        f"{name}: {text}" if len(found.bearings) > 1 else text
        for name, one in found.bearings.items() for text in (*_not_met(one.verdict), *one.warnings)
    ]  # fmt: skip


def _not_met(verdict: Any) -> list[str]:
    return [] if verdict is None else [one.text() for one in verdict.margins if one.is_required and not one.met]


def _geometry(model: BearingModel, values: Sequence[ValueReport]) -> Iterable[Fact]:
    geometry = model.geometry
    paths, rollers = ("bearing.ball_diameter", "bearing.rollers.roller_diameter"), model.rollers
    mark = "≈ " if any(v.path in paths and v.status in ESTIMATED for v in values) else ""
    size = f"{mark}{geometry.ball_count} x {geometry.ball_diameter * 1e3:.2f}"
    if rollers is None:
        yield "balls", size, "mm"
    else:
        yield "rollers", f"{size} x {rollers.length * 1e3:.5g}", "mm"
    yield "pitch", f"{geometry.pitch_diameter * 1e3:.2f}", "mm"
    yield "clearance", f"{geometry.clearance * 1e6:.3g}", "um"
    if geometry.contact_angle:
        yield "α free", f"{math.degrees(geometry.contact_angle):.3g}", "°"


def _of_the_case(estimate: Estimate) -> Iterable[Fact]:
    """Yield the numbers of a bearing or a shaft."""
    state: Any = estimate.equilibrium
    yield from _of_the_shaft(estimate) if hasattr(state, "deflection_um") else _of_a_bearing(state)
    if estimate.processor_s is not None:
        yield "run ≈", duration(estimate.processor_s), ""


def _of_a_bearing(state: Any) -> Iterable[Fact]:
    rating = state.rating
    loaded = [contact for contact in state.contacts if contact.load_N > 0.01 * state.max_load_N]
    angles = [abs(contact.contact_angle_deg) for contact in loaded]
    if angles and (state.rollers is None or max(angles) > 0.0):
        yield "α max", f"{max(angles):.1f}", "°"
    yield "Q max", grouped(state.max_load_N), f"N {state.max_load_ring}"
    yield "p", f"{state.max_pressure_GPa:.2f}", "GPa"
    if state.film_um:
        yield "h", between(state.film_um, 2), "um"
        yield "Λ", between(state.film_parameter, 1), ""
    if rating.viscosity_ratio is not None:
        yield "κ", f"{rating.viscosity_ratio:.1f}", ""
    if rating.basic_life_h is not None:
        yield "L10", _life(rating.basic_life_h), "h"
    if rating.static_safety is not None:
        yield "S0", f"{rating.static_safety:.1f}", ""
    if state.friction_torque_Nmm is not None:
        yield "M ≈", grouped(state.friction_torque_Nmm), "N mm"
    if rating.skf_torque_Nmm is not None:
        yield "SKF", grouped(rating.skf_torque_Nmm), "N mm"


def _table(report: MachineEquilibrium, units: UnitSystem, width: int, style: str) -> list[Text]:
    """Return one line per bearing.

    Two lines of heads stand above; it has as many columns as there is room for.
    """
    names = list(report.bearings)
    first = min(max(map(len, names)), 12)
    shown: list[tuple[int, list[str]]] = []
    used = first
    for head, unit, value, rank in sorted(_COLUMNS, key=lambda column: column[-1]):
        facts = [fact_in_units((head, value(bearing), unit), units) for bearing in report.bearings.values()]
        cells = [head, facts[0][2] if unit else "", *(fact[1] for fact in facts)]
        wide = _GAP - (width < 48) + max(map(len, cells))
        if used + wide > width:
            break
        used += wide
        shown.append((rank, [f"{cell:>{wide}}" for cell in cells]))
    order = [column[-1] for column in _COLUMNS]
    columns = [cells for _, cells in sorted(shown, key=lambda column: order.index(column[0]))]
    lines = [Text(" " * first + "".join(cells[at] for cells in columns), style="dim") for at in (0, 1)]
    for at, name in enumerate(names):
        line = Text(f"{name[:first]:<{first}}", style="bold")
        lines.append(line.append("".join(cells[at + 2] for cells in columns), style=f"not bold {style}"))
    return lines


def _of_the_shaft(answer: Estimate) -> Iterable[Fact]:
    report: Any = answer.equilibrium
    modes = answer.modes
    bends = ((math.hypot(y, z), x) for (_, y, z), x in zip(report.deflection_um, report.positions_mm, strict=True))
    bend, place = max(bends)
    yield "bends", f"{bend:.3g}", "um"
    yield "at", f"{place:.4g}", "mm"
    if modes is not None and modes.critical_speeds:
        first = modes.critical_speeds[0].speed_rpm
        times = f", {first / abs(report.speed_rpm):.2g} x" if report.speed_rpm else ""
        yield "critical", grouped(float(f"{first:.4g}")), f"1/min{times}"
    if report.system_life_h is not None:
        yield "all bearings", _life(report.system_life_h), "h"
    yield "drive torque", f"{report.drive_torque_Nm:.4g}", "N m"
    yield "friction torque", _number(report.friction_torque_Nmm), "N mm"


def _life(value: float | None) -> str:
    if value is None:
        return "-"
    return f">{grouped(_LONG_LIFE)}" if value > _LONG_LIFE else grouped(float(f"{value:.2g}"))


def _number(value: float | None, digits: int = 3) -> str:
    return "-" if value is None else f"{0.0 if abs(value) < 5e-4 else value:.{digits}g}"


# Head, unit, what stands there, and how soon it is left out where there is little room
_COLUMNS: tuple[tuple[str, str, Callable[[BearingEquilibrium], str], int], ...] = (
    ("radial", "N", lambda b: grouped(b.radial_load_N), 0),
    ("axial", "N", lambda b: grouped(b.axial_load_N) if abs(b.axial_load_N) > 0.5 else "0", 1),
    ("p", "GPa", lambda b: f"{b.max_pressure_GPa:.2f}", 3),
    ("Q max", "N", lambda b: grouped(b.max_load_N), 5),
    ("tilt", "mrad", lambda b: f"{math.hypot(*b.misalignment_mrad):.2f}", 4),
    ("clearance", "um", lambda b: _number(b.clearance_um), 8),
    ("film", "um", lambda b: f"{min(b.film_um):.2f}" if b.film_um else "-", 7),
    ("torque", "N mm", lambda b: _number(b.friction_torque_Nmm), 9),
    ("S0", "", lambda b: _number(b.rating.static_safety), 6),
    ("L10rh", "h", lambda b: _life(b.rating.reference_life_h), 2),
)


def grouped(value: float) -> str:
    """Write a number in groups of three.

    It has three digits or more.
    """
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 100.0 else f"{value:.3g}"


def between(ends: Sequence[float], digits: int) -> str:
    """Write the smallest and the largest number.

    One where they read alike.
    """
    low, high = (f"{end:.{digits}f}" for end in (min(ends), max(ends)))
    return low if low == high else f"{low}..{high}"


def duration(seconds: float) -> str:
    """Write a duration for people."""
    if seconds < 1.0:
        return "1 s"
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 6000.0 else f"{seconds / 3600.0:.1f} h"

"""Show the results of a shaft next to its drawing.

These are reactions, lives, deflection and critical speed, or the errors that prevent them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from rich.text import Text

from lambda_gui.derived import Derived, duration, grouped
from lambda_gui.shown_units import fact_in_units

if TYPE_CHECKING:
    from lambda_core.api import BearingEquilibrium, MachineEquilibrium, MachineEstimate
    from lambda_core.domain.unit_systems import UnitSystem

_LONG_LIFE = 1e6  # beyond, a rating life says no more than that [h]
_GAP = 2


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
    ("S0", "", lambda b: _number(b.static_safety), 6),
    ("L10rh", "h", lambda b: _life(b.reference_rating_life_h), 2),
)


class ShaftAnswer(Derived):
    """Numbers of the equilibrium; grey while they are solved anew."""

    @property
    def answer(self) -> MachineEstimate | None:
        """The equilibrium and the modes that are shown."""
        return self._estimate  # type: ignore[no-any-return]

    def draw(self) -> None:
        """Draw what is known, in the colours of the theme."""
        if self._check is None:
            self.update(Text("checking ...", style="dim"))
        elif self._check.shaft is None:
            self.update(self._mistakes(self._check))
        elif self._estimate is None:
            self.update(Text(self._say or "solving ...", style="dim italic"))
        else:
            self.update(self._told(self._estimate, self.app.units))  # type: ignore[attr-defined]

    def warnings(self) -> list[str]:
        """Return where the case leaves what bearings, oil and laws are made for: before solving, and after."""
        if self._check is None or self._check.shaft is None:
            return []
        found = list(self._check.warnings)
        if self._estimate is not None and self.is_current:
            found += [
                f"{bearing.name}: {text}"
                for bearing in self._estimate.equilibrium.bearings
                for text in bearing.warnings
            ]
        return list(dict.fromkeys(found))

    def _told(self, answer: MachineEstimate, units: UnitSystem) -> Text:
        width, room = max(20, self.size.width), max(3, self.size.height)
        style = "" if self.is_current else "dim"
        state = "" if self.is_current else f"stale: {self._say or 'solving'}"
        warned = self.warnings()
        lines = _table(answer.equilibrium, units, width, style)
        lines += [Text(line, style=style) for line in _of_the_shaft(answer, units)]
        head = [Text(state, style="italic", no_wrap=True, overflow="ellipsis")] if state else []
        if warned:
            words = units.sentence(warned[0]) if len(warned) == 1 else f"{len(warned)} warnings: F8"
            head.append(
                Text(f"▲ {words}", style=self.app.theme_variables["warning"], overflow="ellipsis", no_wrap=True)
            )
        for line in head:
            line.truncate(width, overflow="ellipsis")
        return Text("\n").join([*head, *lines][:room])


def _table(report: MachineEquilibrium, units: UnitSystem, width: int, style: str) -> list[Text]:
    """Return one line per bearing under two lines of heads, with as many columns as there is room for."""
    names = [bearing.name for bearing in report.bearings]
    first = min(max(map(len, names)), 12)
    shown: list[tuple[int, list[str]]] = []
    used = first
    for head, unit, value, rank in sorted(_COLUMNS, key=lambda column: column[-1]):
        facts = [fact_in_units((head, value(bearing), unit), units) for bearing in report.bearings]
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


def _of_the_shaft(answer: MachineEstimate, units: UnitSystem) -> list[str]:
    """Return the text about the complete shaft."""
    report, modes = answer.equilibrium, answer.modes
    bends = ((math.hypot(y, z), x) for (_, y, z), x in zip(report.deflection_um, report.positions_mm, strict=True))
    bend, place = max(bends)
    told = [f"bends {bend:.3g} um at {place:.4g} mm"]
    if modes.critical_speeds:
        first = modes.critical_speeds[0].speed_rpm
        times = f", {first / abs(report.speed_rpm):.2g} x" if report.speed_rpm else ""
        told.append(f"critical {grouped(float(f'{first:.4g}'))} 1/min{times}")
    if report.system_life_h is not None:
        told.append(f"all bearings {_life(report.system_life_h)} h")
    if answer.processor_s is not None:
        told.append(f"run ≈ {duration(answer.processor_s)}")
    told.append(f"drive torque {report.drive_torque_Nm:.4g} N m")
    told.append(f"friction torque {_number(report.friction_torque_Nmm)} N mm")
    return [units.sentence(line) for line in told]

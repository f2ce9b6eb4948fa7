"""Show the numbers derived from a case next to its form."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from rich.text import Text
from textual.widgets import Static

from lambda_gui.checking import Check
from lambda_gui.shown_units import fact_in_units

if TYPE_CHECKING:
    from lambda_core.api import Estimate
    from lambda_core.domain.unit_systems import UnitSystem

Fact = tuple[str, str, str]  # name, number, unit


class Derived(Static):
    """Derived quantities, or the mistakes that stand in their way."""

    DEFAULT_CSS = """
    Derived { width: 1fr; height: 1fr; padding: 0 1; }
    """

    def __init__(self) -> None:
        super().__init__(id="derived")
        self._check: Check | None = None
        self._estimate: Any = None  # an Estimate; of a machine its MachineEstimate
        self._say = ""
        self.is_current = False  # whether the numbers are those of the case as it stands

    def show_check(self, check: Check) -> None:
        """Take the outcome of a check; an estimate of the case before is shown as such."""
        self._check = check
        self.is_current = False
        self.draw()

    def show_estimate(self, estimate: Any, say: str) -> None:
        """Take an estimate, or what is being done about it."""
        if estimate is not None:
            self._estimate, self.is_current = estimate, True
        self._say = say
        self.draw()

    def on_resize(self) -> None:
        """Draw for the new size."""
        self.draw()

    def draw(self) -> None:
        """Draw what is known, in the colours of the theme."""
        if self._check is None:
            self.update(Text("checking ...", style="dim"))
        elif self._check.model is None:
            self.update(self._mistakes(self._check))
        else:
            units: UnitSystem = self.app.units  # type: ignore[attr-defined]
            geometry = [fact_in_units(fact, units) for fact in _geometry(self._check)]
            warned = list(map(units.sentence, self.warnings()))
            found = _numbers(self._estimate) if self._estimate else ()
            numbers = [fact_in_units(fact, units) for fact in found]
            if self.size.height > len(geometry) + len(numbers) + 1 + 2 * len(warned):
                told = self._listed(geometry, numbers)
            else:
                told = self._inline([] if warned else geometry[1:], numbers)  # the balls stand in the tree
            self.update(Text("\n").join([*self._warned(warned, told), told]))

    def warnings(self) -> list[str]:
        """Return where the case leaves what bearing, oil and laws are made for: before solving, and after."""
        if self._check is None or self._check.model is None:
            return []
        solved = self._estimate.equilibrium.warnings if self._estimate is not None and self.is_current else []
        return list(dict.fromkeys([*self._check.warnings, *solved]))

    def _warned(self, warnings: Sequence[str], told: Text) -> list[Text]:
        """Write the warnings, as whole sentences as far as they leave room for the numbers, else cut to one line."""
        width, colour = max(20, self.size.width), self.app.theme_variables["warning"]
        room = max(1, self.size.height - len(told.wrap(self.app.console, width)))
        lines = [Text.assemble(("▲ ", colour), warning) for warning in warnings]
        if sum(len(line.wrap(self.app.console, width)) for line in lines) <= room:
            return lines
        for line in lines:
            line.truncate(width, overflow="ellipsis")
        return lines if len(lines) <= room else [*lines[: room - 1], Text(f"▲ {len(lines)} warnings: F8", colour)]

    def _mistakes(self, check: Check) -> Text:
        """Write as many complete mistakes as there is room for; F8 goes to the others."""
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


_LONG_LIFE = 1e6  # beyond, a rating life says no more than that [h]
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


def _geometry(check: Check) -> Iterable[Fact]:
    assert check.model is not None
    geometry = check.model.geometry
    estimated = any(v.path == "bearing.ball_diameter" and v.status != "published" for v in check.values)
    mark = "≈ " if estimated else ""
    yield "balls", f"{mark}{geometry.ball_count} x {geometry.ball_diameter * 1e3:.2f}", "mm"
    yield "pitch", f"{geometry.pitch_diameter * 1e3:.2f}", "mm"
    yield "clearance", f"{geometry.clearance * 1e6:.3g}", "um"
    if geometry.contact_angle:
        yield "α free", f"{math.degrees(geometry.contact_angle):.3g}", "°"


def _numbers(estimate: Estimate) -> Iterable[Fact]:
    state = estimate.equilibrium
    loaded = [contact for contact in state.contacts if contact.load_N > 0.01 * state.max_load_N]
    angles = [abs(contact.contact_angle_deg) for contact in loaded]
    if angles:
        yield "α max", f"{max(angles):.1f}", "°"
    yield "Q max", grouped(state.max_load_N), f"N {state.max_load_ring}"
    yield "p", f"{state.max_pressure_GPa:.2f}", "GPa"
    if state.film_um:
        yield "h", between(state.film_um, 2), "um"
        yield "Λ", between(state.film_parameter, 1), ""
    if estimate.viscosity_ratio is not None:
        yield "κ", f"{estimate.viscosity_ratio:.1f}", ""
    if estimate.rating_life_h is not None:
        life = float(f"{estimate.rating_life_h:.2g}")
        yield "L10", grouped(life) if life < _LONG_LIFE else f"> {grouped(_LONG_LIFE)}", "h"
    rating = estimate.rating
    if rating.static_safety is not None:
        yield "S0", f"{rating.static_safety:.1f}", ""
    if state.friction_torque_Nmm is not None:
        yield "M ≈", grouped(state.friction_torque_Nmm), "N mm"
    if rating.skf_torque_Nmm is not None:
        yield "SKF", grouped(rating.skf_torque_Nmm), "N mm"
    if estimate.processor_s is not None:
        yield "run ≈", duration(estimate.processor_s), ""


def grouped(value: float) -> str:
    """Write a number with three digits or more, in groups of three."""
    return f"{value:,.0f}".replace(",", " ") if abs(value) >= 100.0 else f"{value:.3g}"


def between(ends: Sequence[float], digits: int) -> str:
    """Write the smallest and the largest number, one where they read alike."""
    low, high = (f"{end:.{digits}f}" for end in ends)
    return low if low == high else f"{low}..{high}"


def duration(seconds: float) -> str:
    """Write a duration for people."""
    if seconds < 1.0:
        return "1 s"
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 6000.0 else f"{seconds / 3600.0:.1f} h"

"""Convert the form of a duty cycle, and show results."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from rich.table import Table
from rich.text import Text

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import UnitSystem
from lambda_gui.study_values import card, card_of

if TYPE_CHECKING:
    from lambda_core.api import DutyCycle, FieldCard

NAME, TIME = "name", "time"
# Columns of the spectrum: key or path of an option, head, width
COLUMNS = (
    (NAME, "phase", 13),
    (TIME, "time", 9),
    ("loads.radial", "radial load", 11),
    ("loads.axial", "axial load", 11),
    ("operation.speed", "speed", 11),
    ("lubricant.temperature", "oil", 10),
)
_TIMES = ["h", "min", "s"]
FIRST_TIME = "1 h"


@dataclass
class Phase:
    """One line of the spectrum: texts by column, "" where the case's own value holds."""

    texts: dict[str, str] = field(default_factory=dict)


def column_card(key: str) -> FieldCard:
    """Return the card of a column: its units, what it is."""
    if key == NAME:
        return card("phase", "what it is, for people")
    if key == TIME:
        return card("time", "how long it lasts in one cycle").model_copy(update={"units": _TIMES, "kind": "quantity"})
    return card_of(key)


def cycle_tables(name: str, phases: list[Phase]) -> dict[str, Any]:
    """Return the duty cycle as it would stand in a file; what is missing or wrong is for its check to say."""
    return {
        "name": name,
        "case": "case.toml",
        "phases": [_phase(number, phase.texts) for number, phase in enumerate(phases, start=1)],
    }


def _phase(place: int, texts: dict[str, str]) -> dict[str, Any]:
    changes = {key: text for key, text in texts.items() if text and key not in (NAME, TIME)}
    found: dict[str, Any] = {"name": texts.get(NAME) or f"phase {place}", "time": texts.get(TIME) or FIRST_TIME}
    return found | ({"changes": changes} if changes else {})


def _life(life_h: float | None) -> str:
    """Return a life in hours as it can be known: two digits."""
    return "-" if life_h is None else hours(life_h).removesuffix(" h")


def cycle_view(found: DutyCycle, units: UnitSystem, warning: str) -> tuple[Table, Text]:
    """Return the sum in words, and a table of the phases that fits 80 columns."""
    table = Table(box=None, padding=(0, 2, 0, 0), pad_edge=False, header_style="dim")
    heads = ("time %", "rpm", f"P {units.unit('N')}", "L10rh h", "damage %", f"loss {units.unit('W')}", "energy kJ")
    table.add_column("phase", no_wrap=True, max_width=16)
    for head in heads:
        table.add_column(head, justify="right", no_wrap=True)
    for phase in found.phases:
        table.add_row(
            phase.name,
            number(100.0 * phase.share),
            number(phase.speed_rpm, 0),
            units.number(phase.equivalent_load_N, "N", 0),
            _life(phase.reference_life_h),
            number(None if phase.damage is None else 100.0 * phase.damage),
            units.number(phase.power_loss_W, "W"),
            number(phase.energy_loss_kJ),
        )
    table.add_row(
        "together", "100.0", number(found.mean_speed_rpm, 0), units.number(found.mean_load_N, "N", 0),
        _life(found.reference_life_h), "", units.number(found.mean_power_loss_W, "W"), number(found.energy_loss_kJ),
        style="bold",
    )  # fmt: skip
    text = Text.assemble(
        ("life    ", "dim"),
        (f"{_life(found.reference_life_h)} h", "bold"),
        (f" (ISO/TS 16281)   {_life(found.basic_life_h)} h (ISO 281), damages added\n", "dim"),
        ("energy  ", "dim"),
        (f"{number(found.energy_loss_kJ)} kJ", "bold"),
        f" lost in a cycle of {number(found.cycle_h, 2)} h, {number(found.energy_loss_kWh_per_year)} kWh in a year\n",
    )
    for phase in found.phases:
        for words in phase.warnings:
            text.append("▲ ", style=warning).append(f"{phase.name}: {units.sentence(words)}\n")
    for words in found.assumptions:
        text.append("· ", style="dim").append(f"{units.sentence(words)}\n", style="dim")
    return table, text

"""Convert the form of a duty cycle, and show results."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, get_origin

from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from lambda_core.domain.number_text import hours, number
from lambda_core.domain.unit_systems import UnitSystem
from lambda_gui.study_values import card, card_of

if TYPE_CHECKING:
    from lambda_core.api import Draft, DutyCycle, FieldCard, MachineDutyCycle
    from lambda_gui.nodes import Keys

NAME, TIME = "name", "time"
_TIMES = ["h", "min", "s"]
FIRST_TIME = "1 h"
_WIDE = 11  # columns of a value


@dataclass(frozen=True)
class Column:
    """Column of the spectrum.

    It has the key or path of an option, a head, a width, and the quantity of its values.
    """

    key: str
    head: str
    width: int
    card: FieldCard

    @property
    def keys(self) -> Keys:
        """Place in the case; () where it is none."""
        return tuple(self.key.split(".")) if self.key not in (NAME, TIME) else ()


def columns_of(draft: Draft, width: int) -> list[Column]:
    """Return the columns for a case.

    Name, time, its loads, speed and oil temperature, as many as there is room for.

    Parameters
    ----------
    width : int
        Columns of the screen.
    """
    time = card("time", "duration in one cycle").model_copy(update={"units": _TIMES, "kind": "quantity"})
    found = [Column(NAME, "phase", 13, card("phase", "name of the phase")), Column(TIME, "time", 9, time)]
    last = [("operation.speed", "speed"), ("lubricant.temperature", "oil")]
    room = (width - 2 - sum(column.width + 1 for column in found)) // (_WIDE + 1) - len(last)
    for path, head in [*list(_loads(draft))[: max(1, room)], *last]:
        found.append(Column(path, head, _WIDE, card_of(draft.root, path)))
    return found


def _loads(draft: Draft) -> Iterator[tuple[str, str]]:
    """Yield path and head of each load.

    Radial and axial of one bearing, or the loads on the shaft.
    """
    if get_origin(draft.root.model_fields["loads"].annotation) is not dict:
        yield from (("loads.radial", "radial load"), ("loads.axial", "axial load"))
        return
    for section, kinds in (("gears", ("power", "torque")), ("loads", None)):
        for name, table in (draft.get(section) or {}).items():
            for option in table if isinstance(table, dict) else ():
                kind = card_of(draft.root, f"{section}.{name}.{option}").kind
                if option in kinds if kinds else kind == "signal":
                    head = option.replace("force_", "F").replace("moment_", "M")
                    yield f"{section}.{name}.{option}", _short(f"{name} {head}")


def _short(head: str) -> str:
    """Return a head that fits its column.

    The name is cut first.
    """
    name, _, what = head.rpartition(" ")
    return head if len(head) <= _WIDE else f"{name[: _WIDE - len(what) - 1]} {what}"


@dataclass
class Phase:
    """One line of the spectrum.

    Texts by column, "" where the case's own value applies.
    """

    texts: dict[str, str] = field(default_factory=dict)


def cycle_tables(name: str, phases: list[Phase]) -> dict[str, Any]:
    """Return the duty cycle as in a file.

    Its check reports what is missing or wrong.
    """
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
    """Return a life in hours to two digits.

    It is not known better.
    """
    return "-" if life_h is None else hours(life_h).removesuffix(" h")


def cycle_view(
    found: DutyCycle | MachineDutyCycle, units: UnitSystem, warning: str
) -> tuple[list[RenderableType], Text]:
    """Return tables of phases and the sum.

    They fit 80 columns, one for each bearing; the sum is in words.
    """
    tables: list[RenderableType] = []
    for name, own in found.bearings.items():
        tables += [*([Text(name, style="bold")] if len(found.bearings) > 1 else []), _table(own, units), Text()]
    (life, words), *others = found.lives
    further = "".join(f"   {_life(other)} h {of}" for other, of in others)
    text = Text.assemble(
        ("life    ", "dim"),
        (f"{_life(life)} h", "bold"),
        (f" {words}{further}\n", "dim"),
        ("energy  ", "dim"),
        (f"{number(found.energy_loss_kJ)} kJ", "bold"),
        f" lost in a cycle of {number(found.cycle_h, 2)} h, {number(found.energy_loss_kWh_per_year)} kWh in a year\n",
    )
    for phase, words in found.told():
        text.append("▲ ", style=warning).append(f"{phase}: " if phase else "").append(f"{units.sentence(words)}\n")
    for words in found.assumptions:
        text.append("· ", style="dim").append(f"{units.sentence(words)}\n", style="dim")
    return tables, text


def _table(found: DutyCycle, units: UnitSystem) -> Table:
    """Return one bearing's phases and their sum.

    They form a table.
    """
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
    return table

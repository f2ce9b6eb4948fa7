"""Edit a user row that begins as a copy."""

from __future__ import annotations

from typing import Any, ClassVar

from lambda_db.catalogue import SqlCatalogue
from rich.text import Text
from textual import events
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.screen import ModalScreen
from textual.widgets import Static

from lambda_core.api import BearingRow, FieldCard, Kind, LubricantRow
from lambda_core.domain.errors import LambdaError
from lambda_core.domain.units import UNITS
from lambda_gui.fields import row_for
from lambda_gui.footer import KeyLine
from lambda_gui.nodes import Keys
from lambda_gui.option_help import OptionHelp
from lambda_gui.places import Held
from lambda_gui.rows import Row, Rows, Surroundings, row_of


class OwnRow(ModalScreen[str | None]):
    """Form of a changed catalogue row.

    It takes differences and their source, saves, and answers with the new row's name.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f1", "app.help", "Help", priority=True),
        Binding("ctrl+s", "save", "Save as my own", priority=True),
        Binding("escape", "dismiss(None)", "Back"),
        Binding("down", "app.focus_next", show=False),
        Binding("up", "app.focus_previous", show=False),
    ]
    DEFAULT_CSS = """
    OwnRow { background: $background; }
    OwnRow Rows { height: 1fr; padding: 0 1; }
    OwnRow .title { height: auto; width: 1fr; background: $panel; padding: 0 1; }
    OwnRow OptionHelp { height: 4; border-top: hkey $border-blurred; }
    OwnRow .group { width: 1fr; height: 1; color: $primary; margin-top: 1; }
    """

    def __init__(self, catalogue: SqlCatalogue, row: BearingRow | LubricantRow) -> None:
        super().__init__()
        self._catalogue, self._row = catalogue, row
        self._values: dict[Keys, Any] = {}
        self._first: dict[Keys, Any] = {}

    def compose(self) -> ComposeResult:
        """Lay out the values of the copy."""
        title = Text("A row of your own", style="bold")
        title.append("  values that you change get the source and grade below", style="not bold dim")
        yield Static(title, classes="title")
        with Rows():
            for group, cells in self._groups():
                yield Static(group, classes="group")
                for keys, card, value in cells:
                    self._values[keys] = value
                    yield row_for(Held(self._values, keys), card, Surroundings())
        yield OptionHelp()
        yield KeyLine()

    def on_descendant_focus(self, event: events.DescendantFocus) -> None:
        """Show the focused value's meaning and origin."""
        row = row_of(event.widget)
        if row is not None:
            self.query_one(OptionHelp).show(row.help())

    def on_row_done(self, event: Row.Done) -> None:
        """Go on to the next value."""
        self.focus_next()

    def on_mount(self) -> None:
        """Remember what the copy began with."""
        self._first = dict(self._values)
        for row in self.query(Row):
            row.fit(28)
        self.call_after_refresh(self.focus_next)

    def _groups(self) -> list[tuple[str, list[tuple[Keys, FieldCard, Any]]]]:
        from lambda_db.presentation import parameters_of, values_of

        row = self._row
        provenance = [
            _text("source", "", "where the values that you change come from: publication, drawing, measurement"),
            _choice(
                "grade",
                "B",
                ["A", "B", "C"],
                "of what you change: A published and cross-read, B good, C weak",
            ),
        ]
        if isinstance(row, BearingRow):
            names = [_text("designation", row.designation, "of the new row"), _text("maker", "own", "of the new row")]
            values = [_value(("value", v["name"]), v) for v in values_of(row)]
            known = {keys[-1] for keys, _, _ in values}
            blank = [name for name in type(row).model_fields if name in _OPTIONAL and name not in known]
            values += [_value(("value", n), {"name": n, "unit": _OPTIONAL[n], "value": None}) for n in blank]
            return [("Name", names), ("Origin", provenance), ("Values", values)]
        names = [_text("name", f"{row.name}-own", "of the new row"), _text("note", "", "what it is")]
        groups = [("Name", names), ("Origin", provenance)]
        groups.append(("Properties", [_value(("property", v["name"]), v) for v in values_of(row)]))
        laws: dict[str, list[tuple[Keys, FieldCard, Any]]] = {}
        for p in parameters_of(row):
            law = f"{p['role']} {p['model']}".replace("_", " ")
            laws.setdefault(law, []).append(_value(("parameter", p["role"], p["model"], p["name"]), p))
        return [*groups, *laws.items()]

    def action_save(self) -> None:
        """Write the row into the user's own catalogue."""
        from lambda_db.copies import copy_bearing, copy_lubricant

        row, get = self._row, self._values.get
        changed = {k: v for k, v in self._values.items() if len(k) > 1 and v != self._first.get(k)}
        source, grade = get(("source",)), str(get(("grade",)) or "B")
        if changed and not source:
            self.notify("the field source is empty: enter where the values come from", severity="error")
            return
        origin = {"source": str(source or "copy"), "grade": grade}
        try:
            if isinstance(row, BearingRow):
                names = {name: get((name,)) for name in ("designation", "maker")}
                changes = {**names, **{keys[1]: v for keys, v in changed.items()}}
                copy_bearing(self._catalogue, (row.designation, row.maker), changes, **origin)
                saved = f"{names['designation']} {names['maker']}"
            else:
                saved = str(get(("name",)) or "")
                properties = {k[1]: _number(v) for k, v in changed.items() if k[0] == "property"}
                parameters = {(k[1], k[2], k[3]): _number(v) for k, v in changed.items() if k[0] == "parameter"}
                note = str(get(("note",)) or "")
                copy_lubricant(self._catalogue, row.name, saved, properties, parameters, note=note, **origin)
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=12)
            return
        self.notify(f"saved {saved} in your own catalogue")
        self.dismiss(saved)


# Values that a bearing of the catalogue may lack -> unit
_OPTIONAL = {
    **dict.fromkeys(("dynamic_rating", "static_rating", "fatigue_limit"), "kN"),
    "ball_count": "",
    **dict.fromkeys(
        (
            "ball_diameter",
            "pitch_diameter",
            "race_diameter_inner",
            "race_diameter_outer",
            "groove_radius_inner",
            "groove_radius_outer",
            "shoulder_diameter_inner",
            "shoulder_diameter_outer",
        ),
        "mm",
    ),
}


def _card(
    name: str, description: str, *, units: list[str] | None = None, choices: list[str] | None = None
) -> FieldCard:
    kind: Kind = "choice" if choices else "quantity" if units else "text"
    return FieldCard(
        name=name,
        description=description,
        default="",
        required=bool(choices),
        quantity="",
        units=units or [],
        limits=[],
        kind=kind,
        choices=choices or [],
        reference="",
    )


def _text(name: str, value: str, description: str) -> tuple[Keys, FieldCard, Any]:
    return (name,), _card(name, description), value or None


def _choice(name: str, value: str, choices: list[str], description: str) -> tuple[Keys, FieldCard, Any]:
    return (name,), _card(name, description, choices=choices), value


def _value(keys: Keys, value: dict[str, Any]) -> tuple[Keys, FieldCard, Any]:
    unit, source = value["unit"], value.get("source", "")
    units = next(
        (list(units) for units in UNITS.values() if unit and unit == next(iter(units))), [unit] if unit else []
    )
    number = value["value"]
    told = f"now {source}" if source else "not in the catalogue"
    written = None if number is None else f"{number:.10g} {unit}".strip()
    return keys, _card(value["name"], told, units=units), written


def _number(value: Any) -> float | None:
    """Return the number of a text.

    An example is "12 mm2/s"; values of oils keep the unit they have.
    """
    return None if value is None else float(str(value).split(" ")[0])

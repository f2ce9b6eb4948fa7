"""Define the screen of the catalogue.

It filters while the user types, shows sources and grades, and takes or copies a row.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar

from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, VerticalScroll
from textual.screen import Screen
from textual.timer import Timer
from textual.widgets import DataTable, Input, Static

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.value_status import ESTIMATED
from lambda_gui.details import bearing_text, lubricant_text
from lambda_gui.footer import KeyLine
from lambda_gui.from_catalogue import Kind, Taken, bearing_taken
from lambda_gui.lifecycle import is_here
from lambda_gui.sketch import drawn

if TYPE_CHECKING:
    from lambda_db.presentation import AnyBearing

    from lambda_core.api import Catalogue, LubricantRow

_MOST = 200  # rows in the list
_COLUMNS: dict[Kind, tuple[str, ...]] = {
    "bearing": ("bearing", "maker", "d", "D", "B", "C kN", "C0 kN", "Z x Dw", "geometry"),
    "lubricant": ("name", "base", "ν40 mm2/s", "ν100 mm2/s", "α40 1/GPa", "rheology"),
}
_HINT: dict[Kind, str] = {
    "bearing": 'name, maker, series, a dimension, "d=40" or "C>30"',
    "lubricant": "name, base oil, law",
}


class CatalogueScreen(Screen[Taken | None]):
    """Bearings or lubricants."""

    HORIZONTAL_BREAKPOINTS = [(0, "-narrow"), (112, "-wide")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("enter", "take", "Take", priority=True),
        Binding("f4", "edit", "Edit a copy", priority=True),
        Binding("f2", "other", "Oils or bearings", priority=True),
        Binding("f1", "app.help", "Help", priority=True),
        Binding("escape", "dismiss(None)", "Back"),
        Binding("down", "move(1)", show=False, priority=True),
        Binding("up", "move(-1)", show=False, priority=True),
        Binding("pagedown", "scroll(1)", "Details", show=False, priority=True),
        Binding("pageup", "scroll(-1)", "Details", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    CatalogueScreen { background: $background; }
    CatalogueScreen #find { height: 1; background: $panel; }
    CatalogueScreen #kind { width: 14; padding: 0 1; text-style: bold; background: $panel; }
    CatalogueScreen #find Input { width: 1fr; background: $panel; }
    CatalogueScreen #count { width: 12; background: $panel; color: $text-muted; text-align: right; padding: 0 1 0 0; }
    CatalogueScreen DataTable { height: 9; background: $background; scrollbar-size-vertical: 1; }
    CatalogueScreen #details { height: 1fr; border-top: hkey $border-blurred; }
    CatalogueScreen #details > Horizontal { height: auto; }
    CatalogueScreen #drawing { width: 34; height: auto; padding: 0 1; }
    CatalogueScreen #about { width: 1fr; height: auto; padding: 0 1; }
    CatalogueScreen.-wide DataTable { height: 16; }
    CatalogueScreen.-wide #drawing { width: 54; }
    """

    def __init__(self, catalogue: Catalogue, kind: Kind, designation: str = "") -> None:
        super().__init__()
        self.catalogue, self._kind, self._before = catalogue, kind, designation
        self._bearings: list[AnyBearing] = []
        self._lubricants: list[LubricantRow] = []
        self._timer: Timer | None = None
        self._listed = ""  # what the list has been filtered by

    def compose(self) -> ComposeResult:
        """Lay out filter, list and details."""
        with Horizontal(id="find"):
            yield Static(id="kind")
            yield Input(compact=True, select_on_focus=False)
            yield Static(id="count")
        yield DataTable(cursor_type="row", zebra_stripes=False)
        with VerticalScroll(id="details"), Horizontal():
            yield Static(id="drawing")
            yield Static(id="about")
        yield KeyLine()

    def on_mount(self) -> None:
        """Show everything of the kind."""
        self.query_one("#details").can_focus = False
        self.query_one(DataTable).can_focus = False
        self.query_one(Input).focus()
        self.app.theme_changed_signal.subscribe(self, lambda _: self._show_details())
        self._show_kind()

    def on_unmount(self) -> None:
        """Release the catalogue."""
        self.catalogue.close()

    def on_resize(self) -> None:
        """Draw the details for the new size."""
        self.call_after_refresh(self._show_details)

    def _show_kind(self) -> None:
        self.query_one("#kind", Static).update("Bearings" if self._kind == "bearing" else "Lubricants")
        self.query_one(Input).placeholder = _HINT[self._kind]
        self.find()

    def on_input_changed(self, event: Input.Changed) -> None:
        """Filter once the keys rest for a moment."""
        if self._timer is not None:
            self._timer.stop()
        self._timer = self.set_timer(0.03, self.find)

    def find(self, keep: str = "") -> None:
        """Fill the list with matches.

        `keep` is the name to stay on.
        """
        text, table = self.query_one(Input).value, self.query_one(DataTable)
        self._listed = text
        table.clear(columns=True)  # columns are as wide as what is listed now
        for column in _COLUMNS[self._kind]:
            table.add_column(column)
        if self._kind == "bearing":
            self._bearings = self._found(text)
            for row in self._bearings:
                table.add_row(*_bearing_cells(row))
            names = [f"{row.designation} {row.maker}" for row in self._bearings]
        else:
            self._lubricants = self.catalogue.lubricants(text, _MOST)
            for oil in self._lubricants:
                table.add_row(*_lubricant_cells(oil))
            names = [oil.name for oil in self._lubricants]
        count = len(names)
        self.query_one("#count", Static).update(f"{count}{'+' if count == _MOST else ''} found")
        if keep in names:
            table.move_cursor(row=names.index(keep))
        self._show_details()

    def _found(self, text: str) -> list[AnyBearing]:
        """Return the bearings that match, rollers after balls.

        Without a filter the list has room for some of each.
        """
        from lambda_db.presentation import rollers_found

        rollers = rollers_found(self.catalogue, text)
        found: list[AnyBearing] = [*self.catalogue.bearings(text, max(_MOST - len(rollers), _MOST // 2)), *rollers]
        return found[:_MOST]

    def on_data_table_row_highlighted(self, event: DataTable.RowHighlighted) -> None:
        """Show the row under the cursor."""
        self._show_details()

    def on_data_table_row_selected(self, event: DataTable.RowSelected) -> None:
        """Take a row that was clicked twice."""
        self.action_take()

    def _catch_up(self) -> None:
        """Filter now when keys have come faster than the filter."""
        if self.query_one(Input).value != self._listed:
            self.find()

    @property
    def _row(self) -> AnyBearing | LubricantRow | None:
        rows = self._bearings if self._kind == "bearing" else self._lubricants
        at = self.query_one(DataTable).cursor_row
        return rows[at] if 0 <= at < len(rows) else None

    def _show_details(self) -> None:
        from lambda_db.drawing import section_of
        from lambda_db.roller_drawing import section_of_rollers

        from lambda_core.api import RollerRow

        if not is_here(self):
            return
        row, about, drawing = self._row, self.query_one("#about", Static), self.query_one("#drawing", Static)
        drawing.display = self._kind == "bearing" and row is not None
        if row is None:
            about.update(Text(self._nothing(), style="dim"))
            drawing.update("")
        elif self._kind == "bearing":
            section = section_of_rollers(row) if isinstance(row, RollerRow) else section_of(row)  # type: ignore[arg-type]
            wide = self.size.width >= 112
            size = (16, 50) if wide else (9, 32)
            drawing.update(drawn(section, *size, self.app.theme_variables) if section else "")
            about.update(bearing_text(row, self.catalogue))  # type: ignore[arg-type]
        else:
            about.update(lubricant_text(row))  # type: ignore[arg-type]
        self.query_one("#details", VerticalScroll).scroll_home(animate=False)

    def _nothing(self) -> str:
        """Say that nothing matches, and where something does."""
        count = self._others()
        if not count:
            return "nothing matches"
        one, other = ("bearing", "lubricant") if self._kind == "bearing" else ("lubricant", "bearing")
        verb = "matches" if count == 1 else "match"
        return f"no {one} matches, but {count} {other}{'s' * (count > 1)} {verb}: F2"

    def _others(self) -> int:
        """Return how many rows of the other kind match."""
        text = self.query_one(Input).value
        if not text.strip():
            return 0
        try:
            found = self.catalogue.lubricants(text, _MOST) if self._kind == "bearing" else self._found(text)
        except LambdaError:
            return 0
        return len(found)

    def action_move(self, by: int) -> None:
        """Move in the list while the filter keeps the keyboard."""
        self._catch_up()
        table = self.query_one(DataTable)
        table.move_cursor(row=max(0, min(table.row_count - 1, table.cursor_row + by)))

    def action_scroll(self, by: int) -> None:
        """Scroll the details."""
        details = self.query_one("#details", VerticalScroll)
        details.scroll_relative(y=by * max(1, details.size.height - 1), animate=False)

    def action_other(self) -> None:
        """Change between bearings and lubricants.

        A filter that matches only the other kind stays.
        """
        self._catch_up()
        text = self.query_one(Input).value if self._row is None and self._others() else ""
        self._kind = "lubricant" if self._kind == "bearing" else "bearing"
        with self.prevent(Input.Changed):
            self.query_one(Input).value = text
        self._show_kind()

    def action_take(self) -> None:
        """Take the row into the case."""
        self._catch_up()
        row = self._row
        if row is None:
            self.app.bell()
        elif self._kind == "bearing":
            typed = self.query_one(Input).value
            self.dismiss(bearing_taken(row, typed, self._before, self.catalogue))  # type: ignore[arg-type]
        else:
            self.dismiss(Taken("lubricant", row.name))  # type: ignore[union-attr]

    def action_edit(self) -> None:
        """Copy this row to an own one."""
        from lambda_db.catalogue import SqlCatalogue

        from lambda_core.api import RollerRow
        from lambda_gui.own_row import OwnRow

        self._catch_up()
        row = self._row
        if not isinstance(self.catalogue, SqlCatalogue):
            self.notify("the catalogue comes from another plugin: add rows there", severity="warning")
        elif isinstance(row, RollerRow):
            self.notify("single values of rollers are replaced in the case: Bearing, Rollers", severity="warning")
        elif row is not None:
            self.app.push_screen(OwnRow(self.catalogue, row), self._saved)

    def _saved(self, name: str | None) -> None:
        if name is None:
            return
        with self.prevent(Input.Changed):
            self.query_one(Input).value = name
        try:
            self.find(keep=name)
        except LambdaError as error:
            self.notify(str(error), severity="error")


def _bearing_cells(row: AnyBearing) -> list[Text]:
    from lambda_db.presentation import bearing_summary

    s = bearing_summary(row)
    design, grade = "", "not known"
    mark = "≈" if s["geometry_status"] in ESTIMATED else ""
    if "roller_count" in s:
        design = f"{mark}{s['roller_count']} x {s['roller_diameter_mm']:g}"
    elif s["ball_count"] is not None:
        design = f"{mark}{s['ball_count']} x {s['ball_diameter_mm']:g}"
    if design:
        grade = f"{s['geometry_grade']} {s['geometry_status']}"
    own = "" if row.layer == "core" else f" ({'own' if row.layer == 'user' else 'plugin'})"
    # inch sizes have more digits than a narrow screen has room
    numbers = ("" if s[name] is None else f"{s[name]:.4g}" for name in ("bore_mm", "outside_mm", "width_mm"))
    ratings = ("" if s[name] is None else f"{s[name]:g}" for name in ("C_kN", "C0_kN"))
    cells = [Text(row.designation, style="bold"), Text(row.maker)]
    cells += [Text(number, justify="right") for number in (*numbers, *ratings, design)]
    return [*cells, Text(grade + own, style="dim")]


def _lubricant_cells(row: LubricantRow) -> list[Text]:
    from lambda_db.presentation import kind_of, lubricant_summary

    s = lubricant_summary(row)
    numbers = ("" if s[n] is None else f"{s[n]:.4g}" for n in ("nu40_mm2s", "nu100_mm2s", "alpha40_per_GPa"))
    own = "" if row.layer == "core" else " (own)"
    cells = [Text(row.name + own, style="bold"), Text(kind_of(row))]
    return [*cells, *(Text(number, justify="right") for number in numbers), Text(row.rheology, style="dim")]

"""Define the help screen: keys, marks, axes and signs."""

from __future__ import annotations

from typing import ClassVar

from rich.table import Table
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import VerticalScroll
from textual.screen import ModalScreen
from textual.widgets import Static

from lambda_gui.axes import MORE_SIGNS, SIGNS, axes_sketch

_ALL = (("F1", "this help"), ("Ctrl+P", "all commands"), ("F9", "light or dark"), ("Ctrl+Q", "quit"))
_ASKING = (("↑ ↓ or ← →", "between the answers"), ("Enter", "take the answer"), ("Esc", "back, nothing is done"))

# Class of the screen -> title, what it is for, keys
ABOUT: dict[str, tuple[str, str, tuple[tuple[str, str], ...]]] = {
    "BuilderScreen": (
        "The model",
        "The tree mirrors the multibody set-up. The form of the selected node is at its right, the derived numbers are "
        "below or at the right of the form, grey while the solver works. A shaft is drawn below, to scale, with its "
        "deflection (z vertical, y horizontal). The builder checks every input as you type.",
        (
            ("↑ ↓", "move in the tree, or between the fields of a form"),
            ("→ ←", "open or close a node; → on an open node goes into its form"),
            ("+  Del", "in the tree: add a piece, a bearing, a marker ... after the node; remove it"),
            ("Enter", "into the form; in a field: complete the unit and go on; on a choice: open its list"),
            ("Esc", "from the form back to the tree"),
            ("F2", "catalogue: bearings for the bearing whose form is shown; oils on the form of the lubricant"),
            ("F3", "a study: the option under the keyboard varies, or any other"),
            ("F4", "a duty cycle: life and losses over phases that differ in load, speed, oil temperature"),
            ("Ctrl+F", "a fit: parameters of the case from a file of measured points"),
            ("F5 or Ctrl+R", "run the present case, saved or not"),
            ("F6  F7", "results; runs"),
            ("F8", "go to the next mistake and correct it; without mistakes show the warnings"),
            ("F10 or Ctrl+G", "answers without a run: equilibrium, temperatures, currents, friction, assumptions"),
            ("Ctrl+S", "save; only what you changed is changed in the file"),
            ("Ctrl+Z  Ctrl+Y", "undo, redo"),
            ("Ctrl+O", "open another case, a built-in one, or an empty model"),
            ("Ctrl+P", "all commands; type the name of any option to go to it"),
            ("F9", "light or dark"),
            ("Ctrl+Q", "quit; asks for unsaved changes and runs that go on"),
            ("⊢left⊣  ~b~", "a bearing that holds the shaft both ways along x; one that floats; ⊢b or b⊣: one way"),
            (
                "→ ← ↑ ↓ ⊗ ⊙",
                "direction in which a load, a gear or a bearing pushes the shaft; ⊗ along +y, into the picture",
            ),
            ("● ╱ ╲", "a ball; the contact line of an angular contact bearing: ╱ ╲ is O, ╲ ╱ is X"),
        ),
    ),
    "AnswerScreen": (
        "Answers",
        "Answers about the present case, saved or not, without a run in time: the equilibrium of all bearings "
        "(of a shaft also its deflection, moments and critical speeds), steady temperatures under the case's own "
        "losses, bearing voltages and discharges, friction over speed, and all assumptions.",
        (
            ("← →", "between the questions"),
            ("↑ ↓ PgUp PgDn", "scroll the answer; Space scrolls on, too"),
            ("Esc or F10", "back"),
            *_ALL,
        ),
    ),
    "CatalogueScreen": (
        "The catalogue",
        "Type to filter: words of designation, maker or series, a dimension, or conditions such as d=40 and C>30. "
        "Each value has a grade (A published and cross-read, B good, C weak) and the number of its source.",
        (
            ("type", "filter the list"),
            ("↑ ↓", "move in the list"),
            ("PgUp PgDn", "scroll the details: values, clearance classes, designs that fit, sources"),
            ("Enter", "take the row into the case"),
            ("F4", "begin a row of your own with a copy of this one"),
            ("F2", "bearings or lubricants"),
            ("Esc", "back, the case stays as it is"),
            *_ALL,
        ),
    ),
    "OwnRow": (
        "A catalogue row of your own",
        "A copy of a row, to be changed. Values that you change get the source and grade that you give; all others "
        "keep theirs. Your own catalogue stores it; the published one does not change.",
        (
            ("↑ ↓ or Tab", "between the values"),
            ("Ctrl+S", "save the row"),
            ("Esc", "back, nothing is stored"),
            *_ALL,
        ),
    ),
    "StudyScreen": (
        "A study",
        "One or two options of the case take many values; each point is an equilibrium, or a run. The estimate of "
        "the run time is below. Pictures show simulation and catalogues on one axis.",
        (
            ("↑ ↓ or Tab", "between the rows"),
            ("Enter", "complete the unit or the path, and go on"),
            ("F5", "run it: it waits for its turn under Runs, its folder appears under Results"),
            ("Ctrl+S", "save it as a file for the shell: lambda-bearing study run FILE"),
            ("F6  F7", "results; runs"),
            ("Esc", "back to the case"),
            *_ALL,
        ),
    ),
    "DutyScreen": (
        "A duty cycle",
        "Each line is a phase of the case: its time and its differences. Empty fields have the value of the case "
        "(grey). Phases are solved without time; damages add (Palmgren, Miner), and so do losses.",
        (
            ("↑ ↓", "between the phases"),
            ("Tab or Enter", "complete the unit, and go on to the next value"),
            ("Ctrl+N", "a new phase below, a copy of this one"),
            ("Ctrl+D", "remove the phase"),
            ("F5", "solve every phase, and add up life and losses"),
            ("Ctrl+S", "save it as a file for the shell: lambda-bearing duty FILE"),
            ("Esc", "back to the case"),
            *_ALL,
        ),
    ),
    "FitScreen": (
        "A fit",
        "Parameters of the case are fitted to the measured points of a CSV file. Below are the values with their "
        "errors, what the points do not determine, each point with its prediction, and pictures.",
        (
            ("↑ ↓ or Tab", "between the rows"),
            ("Enter", "complete the name and go on"),
            ("F5", "fit"),
            ("F8", "stop, and keep the best values so far"),
            ("PgUp PgDn", "scroll the results"),
            ("Ctrl+S", "save the case with the fitted values"),
            ("Esc", "back to the case"),
            *_ALL,
        ),
    ),
    "RunScreen": (
        "Runs",
        "Runs wait for each other and go on when the builder is closed. The traces show the run under the cursor: "
        "friction torque now with its running mean and its 95 % band, cage speed, and the load of each element.",
        (
            ("↑ ↓", "between the runs"),
            ("Enter or F6", "look at the result, finished or not"),
            ("c", "cancel: the run ends in order and keeps what it has"),
            ("g", "go on with a run that was cancelled or did not converge"),
            ("x", "take ended runs off the list; their results stay"),
            ("Esc or F7", "back"),
            *_ALL,
        ),
    ),
    "ResultsScreen": (
        "Results",
        "The results and studies (with a /) in the folder of the case, the newest first; the screen follows one that "
        "grows. The list below has the summary and all views. The screen compares two or more marked results: "
        "differences of their cases, numbers in columns, pictures with catalogues on the same axis.",
        (
            ("Tab", "between the results and the views"),
            ("↑ ↓", "move in the list; the entry under the cursor is shown"),
            ("PgUp PgDn", "scroll the text"),
            ("Space", "mark a result (in the upper list)"),
            ("e", "export the view as SVG and PNG"),
            ("p", "pictures or text charts, in a terminal with kitty's graphics or sixel"),
            ("t", "write a report (HTML)"),
            ("c", "write the case of the result into a file of its own"),
            ("o", "open a result or a folder from elsewhere"),
            ("Esc or F6", "back"),
            *_ALL,
        ),
    ),
    "OpenCase": (
        "Open a case",
        "An empty model or shaft, a case file of this folder, or a copy of a built-in case.",
        (("type", "filter the list, or write the path of a file"), *_ASKING),
    ),
    "PickList": (
        "A choice",
        "The first entry holds if the case has none; the line below explains the entry.",
        (("↑ ↓", "between the entries"), ("Enter", "take the entry"), ("Esc", "back, nothing is changed")),
    ),
    "Ask": ("A question", "Nothing happens before you answer.", _ASKING),
    "AskText": ("A name", "Enter takes the text, Esc goes back.", (("Enter", "take it"), ("Esc", "back"))),
}

_MARKS = (
    ("●", "differs from the file"),
    ("▲2", "two mistakes here or below"),
    ("≈", "estimated or assumed, with its grade"),
    ("grey text", "what holds when nothing is written; clearing a field goes back to it"),
    ("units", "a bare number gets the unit that is proposed in grey: 16 becomes 16 N, 16 k becomes 16 kN"),
)
_COLUMN = 14


class HelpScreen(ModalScreen[None]):
    """Help for one screen.

    Parameters
    ----------
    screen : str
        Class of the screen that is explained.
    option : rich.text.Text, optional
        Help of the option under the keyboard, put before everything else.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape,f1,q", "dismiss", "Back"),
        Binding("down", "scroll(2)", show=False),
        Binding("up", "scroll(-2)", show=False),
    ]
    DEFAULT_CSS = """
    HelpScreen { align: center middle; background: $background 60%; }
    HelpScreen > VerticalScroll { width: 104; max-width: 98%; height: auto; max-height: 98%; background: $surface;
        border: round $border; border-subtitle-color: $text-muted; padding: 0 2; scrollbar-size-vertical: 1; }
    HelpScreen Static { width: 1fr; height: auto; }
    """

    def __init__(self, screen: str, option: Text | None = None) -> None:
        super().__init__()
        self._screen, self._option = screen, option

    def compose(self) -> ComposeResult:
        """Lay out the option, keys, marks and axes."""
        with VerticalScroll() as box:
            box.can_focus = True
            box.border_subtitle = "↑ ↓ scroll   Esc back"
            if self._option is not None:
                yield Static(self._option)
                yield Static()
            title, about, keys = ABOUT[self._screen]
            yield Static(Text.assemble((f"{title}\n", "bold"), f"{about}\n"))
            yield Static(Text("Keys", style="bold"))
            yield Static(_table(keys))
            yield Static(Text("\nMarks", style="bold"))
            yield Static(_table(_MARKS))
            yield Static(Text.assemble(("\nAxes and signs\n", "bold"), axes_sketch(self.app.theme_variables)))
            yield Static(f"{SIGNS} {MORE_SIGNS}")

    def action_scroll(self, by: int) -> None:
        """Scroll."""
        self.query_one(VerticalScroll).scroll_relative(y=by, animate=False)


def _table(rows: tuple[tuple[str, str], ...]) -> Table:
    table = Table.grid(padding=(0, 2, 0, 0))
    table.add_column(width=_COLUMN, style="bold", no_wrap=True)
    table.add_column(ratio=1)
    for row in rows:
        table.add_row(*row)
    return table

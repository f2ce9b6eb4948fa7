"""Define small dialogs: answers, a text, a case."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import ClassVar

from rich.table import Table
from rich.text import Text
from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.screen import ModalScreen
from textual.widgets import Button, Input, OptionList, Static
from textual.widgets.option_list import Option

_BOX = """
    {name} {{ align: center middle; background: $background 60%; }}
    {name} > Vertical {{ width: {width}; max-width: 96%; height: auto; max-height: 94%; background: $surface;
        border: round $border; padding: 0 2; }}
    {name} .buttons {{ height: 1; margin: 1 0 0 0; }}
    {name} Button {{ margin-right: 2; min-width: 4; }}
"""


class Ask(ModalScreen[str]):
    """Question with a few answers.

    Enter takes the first, Esc gives "".
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "dismiss('')", "Back"),
        Binding("f1", "app.help", "Help", priority=True),
        Binding("left,up", "app.focus_previous", show=False),
        Binding("right,down", "app.focus_next", show=False),
    ]
    DEFAULT_CSS = _BOX.format(name="Ask", width="64")

    def __init__(self, question: str, answers: Sequence[str]) -> None:
        super().__init__()
        self._question, self._answers = question, answers

    def compose(self) -> ComposeResult:
        """Lay out the question over its answers."""
        with Vertical():
            yield Static(self._question, markup=False)
            with Horizontal(classes="buttons"):
                for number, answer in enumerate(self._answers):
                    yield Button(answer, compact=True, variant="primary" if number == 0 else "default", name=answer)

    def on_button_pressed(self, event: Button.Pressed) -> None:
        """Answer."""
        self.dismiss(event.button.name or "")


class AskText(ModalScreen[str | None]):
    """A line of text; None when left with Esc."""

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "dismiss(None)", "Back"),
        Binding("f1", "app.help", "Help", priority=True),
    ]
    DEFAULT_CSS = _BOX.format(name="AskText", width="70")

    def __init__(self, question: str, text: str) -> None:
        super().__init__()
        self._question, self._text = question, text

    def compose(self) -> ComposeResult:
        """Lay out the question over the entry."""
        with Vertical():
            yield Static(self._question, markup=False)
            yield Input(self._text, compact=True)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Answer."""
        self.dismiss(event.value.strip() or None)


EMPTY = ""
EMPTY_MACHINE = "machine:"
TEMPLATE = "template:"  # what stands before the name of a machine to start from
_NAMES = 18  # columns for the names of cases; what is longer is wrapped


def _short(folder: Path) -> str:
    """Return a folder relative to home.

    A folder elsewhere stays as it is.
    """
    home = Path.home()
    return f"~/{folder.relative_to(home)}" if folder.is_relative_to(home) else str(folder)


class OpenCase(ModalScreen[str | None]):
    """Choice of a case.

    It is empty, a new machine, a file, a machine or a built-in name; None when left with Esc.
    """

    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("escape", "dismiss(None)", "Back"),
        Binding("f1", "app.help", "Help", priority=True),
        Binding("down", "into_list", show=False),
    ]
    DEFAULT_CSS = (
        _BOX.format(name="OpenCase", width="114")
        + """
    OpenCase OptionList { height: auto; max-height: 65vh; background: $surface; border: none; padding: 0;
        margin: 1 0 0 0; }
    OpenCase Input { margin: 1 0 0 0; }
    """
    )

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        self._offers: list[tuple[str, str, str]] = []  # what is opened, its name, what it is

    def compose(self) -> ComposeResult:
        """Lay out an entry over the list of cases."""
        with Vertical():
            yield Static(Text.assemble(("λ lambda-bearing", "bold"), "   which case?"))
            yield Input(placeholder="type to filter, or a file name", compact=True)
            yield OptionList(markup=False)

    def on_mount(self) -> None:
        """Offer everything."""
        from lambda_db.recent import recent_cases

        from lambda_core import api

        self._offers = [
            (EMPTY, "empty model", "one bearing, start from nothing"),
            (EMPTY_MACHINE, "new machine", "a shaft in several bearings, start from nothing"),
        ]
        here = [f for f in sorted(self._folder.glob("*.toml")) if f.name[0] != "." and f.name != "pyproject.toml"]
        self._offers += [(str(file), file.name, f"in {self._folder.name or self._folder}") for file in here]
        known = {file.resolve() for file in here}
        self._offers += [(str(f), f.name, f"recent, in {_short(f.parent)}") for f in recent_cases() if f not in known]
        self._offers += [(f"{TEMPLATE}{name}", name, text) for name, text in api.templates().items()]
        self._offers += [(name, name, text) for name, text in api.builtin_cases().items()]
        self._filter("")

    def _filter(self, text: str) -> None:
        options = self.query_one(OptionList)
        options.clear_options()
        words = text.casefold().split()
        for value, name, about in self._offers:
            if all(word in f"{name} {about}".casefold() for word in words):
                line = Table.grid(padding=(0, 1, 0, 0))
                line.add_column(style="bold", width=_NAMES, overflow="fold")
                line.add_column(style="dim")
                line.add_row(name, about)
                options.add_option(Option(line, id=f"case-{value}"))
        options.highlighted = 0 if options.option_count else None

    def on_input_changed(self, event: Input.Changed) -> None:
        """Narrow the list."""
        self._filter(event.value)

    def on_input_submitted(self, event: Input.Submitted) -> None:
        """Take a typed file or the first.

        The first is that of the list.
        """
        options = self.query_one(OptionList)
        if Path(event.value).is_file() or not options.option_count:
            self.dismiss(event.value)
        else:
            self._take(options.get_option_at_index(options.highlighted or 0))

    def on_option_list_option_selected(self, event: OptionList.OptionSelected) -> None:
        """Take a case."""
        self._take(event.option)

    def _take(self, option: Option) -> None:
        self.dismiss((option.id or "").removeprefix("case-"))

    def action_into_list(self) -> None:
        """Go from the entry to the list."""
        self.query_one(OptionList).focus()

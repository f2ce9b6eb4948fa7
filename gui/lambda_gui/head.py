"""Show name, unsaved changes, errors and runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.text import Text
from textual.widgets import Static

from lambda_gui.checking import Check

if TYPE_CHECKING:
    from lambda_core.api import Draft


class Head(Static):
    """One line about the case."""

    DEFAULT_CSS = """
    Head { height: 1; width: 1fr; background: $panel; padding: 0 1; }
    """

    def show(self, draft: Draft, check: Check, beyond: int, running: str) -> None:
        """Say how the case stands.

        Parameters
        ----------
        beyond : int
            How many warnings there are: of the case, and of what is solved of it.
        running : str
            A few words about the runs that are going on.
        """
        colours = self.app.theme_variables
        name = draft.path.name if draft.path else f"{draft.get('name') or 'untitled'} (no file)"
        left = Text.assemble((" λ ", "bold reverse"), " ", (name, "bold"))
        if draft.is_changed():
            left.append(" ● unsaved, Ctrl+S saves", style=colours["accent"])
        right = Text()
        count = len(check.problems)
        if count:
            right.append(f"▲ {count} mistake{'s' * (count > 1)}  F8", style=colours["error"])
        elif check.model is not None:
            right.append("ready", style=colours["warning" if beyond else "success"])
            if beyond:
                right.append(f", ▲ {beyond} warning{'s' * (beyond > 1)}  F8", style=colours["warning"])
            right.append(f"  {len(check.model.assumptions)} assumptions", style="dim")
        if running:
            right = Text.assemble((running, "bold"), "   ", right)
        left.pad_right(max(1, self.app.size.width - 2 - left.cell_len - right.cell_len))
        self.update(left.append_text(right))

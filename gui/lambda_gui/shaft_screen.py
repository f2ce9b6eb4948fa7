"""The builder's screen for a shaft in several bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from textual.app import ComposeResult
from textual.binding import Binding, BindingType
from textual.containers import Horizontal, Vertical
from textual.widgets import Footer

from lambda_gui.builder import BuilderScreen
from lambda_gui.head import Head
from lambda_gui.option_help import OptionHelp
from lambda_gui.shaft_answer import ShaftAnswer
from lambda_gui.shaft_sketch import ShaftSketch
from lambda_gui.tree import ModelTree

if TYPE_CHECKING:
    from lambda_gui.nodes import Keys


class ShaftScreen(BuilderScreen):
    """One shaft: tree and form over the drawing and what it does."""

    VERTICAL_BREAKPOINTS = [(0, "-low"), (34, "-middle"), (44, "-high")]  # noqa: RUF012
    BINDINGS: ClassVar[list[BindingType]] = [
        Binding("f3", "answer", "Answer", priority=True),
        Binding("f4", "one_bearing", show=False, priority=True),
    ]
    DEFAULT_CSS = """
    ShaftScreen #tree { width: 39; }
    ShaftScreen #side { height: 4; border-top: hkey $border-blurred; }
    ShaftScreen #help { height: 3; border-bottom: none; }
    ShaftScreen #below { height: 10; border-top: hkey $border-blurred; }
    ShaftScreen #sketch { display: block; width: 1fr; height: 1fr; }
    ShaftScreen #derived { width: 38; height: 1fr; border-bottom: none; }
    ShaftScreen.-middle #below { height: 15; }
    ShaftScreen.-high #below { height: 21; }
    ShaftScreen.-wide #derived { width: 66; }
    ShaftScreen.-wide #right { layout: horizontal; }
    ShaftScreen.-wide #side { width: 46; height: 1fr; border-top: none; border-left: vkey $border-blurred; }
    ShaftScreen.-wide #help { height: 1fr; }
    """

    def compose(self) -> ComposeResult:
        """Lay out head, tree and form, and the shaft below them."""
        yield Head()
        with Horizontal(id="body"):
            yield ModelTree(self.draft, self.around)
            with Vertical(id="right"), Vertical(id="side"):
                yield OptionHelp(id="help")
        with Horizontal(id="below"):
            yield ShaftSketch()
            yield ShaftAnswer()
        yield Footer()

    @property
    def bearing(self) -> Keys:
        """The bearing whose form is shown, else the first one."""
        table = self.form.node.table[:2] if self.form is not None else ()
        if table[:1] == ("bearings",) and len(table) == 2:
            return table
        return ("bearings", next(iter(self.draft.get("bearings") or ("left",))))

    def show_estimate(self, estimate: Any, say: str) -> None:
        """Show what the shaft does."""
        super().show_estimate(estimate, say)
        if self.is_here and estimate is not None:
            self.query_one(ShaftSketch).show_report(estimate.equilibrium)

    def action_answer(self) -> None:
        """Show everything that the equilibrium says."""
        from lambda_gui.shaft_answer_screen import ShaftAnswerScreen

        answer = self.query_one(ShaftAnswer)
        if self.check.shaft is None or answer.answer is None or not answer.is_current:
            count = len(self.check.problems)
            text = f"{count} mistake{'s' * (count != 1)} to mend first: F8" if count else "still solving"
            self.notify(text, severity="warning", timeout=4)
            return
        self.app.push_screen(ShaftAnswerScreen(self.check.shaft, answer.answer))

    def action_one_bearing(self) -> None:
        """Say what a shaft has not."""
        self.notify("of a machine: lambda-bearing study, lambda-bearing duty", severity="warning", timeout=4)

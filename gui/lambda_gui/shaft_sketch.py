"""The shaft of the case that is being edited, and how it bends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rich.text import Text

from lambda_gui.shaft_drawing import drawn_shaft
from lambda_gui.sketch import Sketch

if TYPE_CHECKING:
    from lambda_core.api import MachineEquilibrium, MachineModel
    from lambda_gui.checking import Check
    from lambda_gui.nodes import Node


class ShaftSketch(Sketch):
    """The drawing of a shaft; with mistakes in the case the last one stays."""

    def __init__(self) -> None:
        super().__init__()
        self._shaft: MachineModel | None = None
        self._report: MachineEquilibrium | None = None

    def show_check(self, check: Check) -> None:
        """Take a shaft without mistakes; what it did before has nothing to say about it."""
        if check.shaft is not None:
            self._shaft, self._report = check.shaft, None
            self.draw()

    def show_report(self, report: MachineEquilibrium) -> None:
        """Take the equilibrium of the shaft."""
        self._report = report
        self.draw()

    def show_node(self, node: Node) -> None:
        """Show the same shaft whatever form is shown."""

    def draw(self) -> None:
        """Draw the shaft in the colours of the theme."""
        width, height = self.size.width - 2, self.size.height
        if width < 16 or height < 5:
            return
        if self._shaft is None:
            words = "the shaft is drawn here as soon as it has a piece, a bearing, a speed and an oil"
            self.update(Text(words, style="dim"))
        else:
            self.update(drawn_shaft(self._shaft, self._report, width, height, self.app.theme_variables))

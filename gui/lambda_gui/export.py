"""Export figures, reports and the case from results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from textual import work
from textual.screen import Screen

from lambda_core.domain.errors import LambdaError
from lambda_core.domain.unit_systems import UnitSystem
from lambda_gui.dialogs import AskText
from lambda_gui.helper import Helper
from lambda_gui.lifecycle import is_here
from lambda_gui.new_files import save_new

SUMMARY, DIFFERENCES = "summary", "what differs"  # words, no pictures


class ExportScreen(Screen[None]):
    """Screen of chosen results and a view.

    The view is shown.

    Parameters
    ----------
    folder : pathlib.Path
        Where figures are proposed to go.
    """

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self._folder = folder
        self._helper = Helper(self.say, lambda: is_here(self))
        self._view = SUMMARY
        self._bearing: str | None = None  # of a machine; None: the machine

    @property
    def _units(self) -> UnitSystem:
        found: UnitSystem = self.app.units  # type: ignore[attr-defined]
        return found

    def say(self, words: str = "") -> None:
        """Say what is going on."""
        raise NotImplementedError

    def current(self) -> Path | None:
        """Return the result under the cursor."""
        raise NotImplementedError

    def chosen(self) -> list[Path]:
        """Return the results that are shown."""
        raise NotImplementedError

    def action_figure(self) -> None:
        """Write the view as SVG and PNG."""
        if self._view in (SUMMARY, DIFFERENCES):
            self.notify("choose a view first; words go into the report", severity="warning")
        else:
            self._export("draw", "figures into the folder", sources=True)

    def action_report(self) -> None:
        """Write a report of the results."""
        self._export("report", "report into the file", sources=True)

    def action_case(self) -> None:
        """Write the case of the result, complete, into a file."""
        path = self.current()
        if path is not None:
            self._ask_case(path)

    @work
    async def _ask_case(self, path: Path) -> None:
        try:
            text = await self._helper.ask("case_text", path=str(path))
        except LambdaError as error:
            self.notify(str(error), severity="error")
            return
        answer = await self.app.push_screen_wait(AskText("Write the case as", str(path.with_suffix(".toml"))))
        if answer is None:
            return
        target = save_new(self, text, answer)
        if target is not None:
            self.notify(f"wrote {target}")

    @work
    async def _export(self, what: str, words: str, *, sources: bool) -> None:
        paths = [str(path) for path in self.chosen()]
        if not paths:
            return
        proposal = self._folder if what == "draw" else Path(paths[0]).with_suffix(".html")
        answer = await self.app.push_screen_wait(AskText(f"Write the {words}", str(proposal)))
        if answer is None:
            return
        target = str(Path(answer).expanduser())
        figure = {"name": self._view, "folder": target, "units": self._units.name, "formats": ["svg", "png"]}
        more: Mapping[str, object] = figure if what == "draw" else {"target": target}
        try:
            written: Sequence[str] = await self._helper.ask(what, sources=paths, bearing=self._bearing, **more)
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=10)
            return
        self.notify("wrote " + ", ".join(written), timeout=8)
        self.say()

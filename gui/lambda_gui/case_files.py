"""Open and save case files; keep unsaved work."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from lambda_db.recent import remember
from textual.app import App

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from lambda_gui import recovery
from lambda_gui.builder import BuilderScreen
from lambda_gui.dialogs import EMPTY, EMPTY_MACHINE, TEMPLATE, Ask, AskText, OpenCase

if TYPE_CHECKING:
    from lambda_core.api import Draft


class CaseApp(App[None]):
    """Application for one case at a time.

    Nothing unsaved is lost without a question.
    """

    @property
    def builder(self) -> BuilderScreen:
        """Screen of the case.

        There is one, whatever lies over it.
        """
        (screen,) = (shown for shown in self.screen_stack if isinstance(shown, BuilderScreen))
        return screen

    def open(self, source: str) -> None:
        """Open a case.

        A case file, a copy of a built-in case, what is usual in a machine, an empty model or machine.
        """
        try:
            if source.startswith(TEMPLATE):
                draft = api.draft(template=source.removeprefix(TEMPLATE))
            elif source == EMPTY_MACHINE:
                draft = api.draft(is_machine=True)
            else:
                draft = api.draft(source or None)
        except LambdaError as error:
            self.notify(str(error), severity="error", timeout=10)
            if not any(isinstance(screen, BuilderScreen) for screen in self.screen_stack):
                self._open(None)
            return
        if draft.path is not None:
            remember(draft.path)
        self._open(draft)

    def _open(self, draft: Draft | None, then: Callable[[], None] | None = None) -> None:
        """Open a draft in place of another.

        `then` is called unless unsaved work on it is recovered.
        """
        draft = draft or api.draft()
        screen = BuilderScreen(draft)
        if any(isinstance(shown, BuilderScreen) for shown in self.screen_stack):
            while not isinstance(self.screen, BuilderScreen):
                self.pop_screen()  # whatever lies over the case belongs to the case before
            self.switch_screen(screen)
        else:
            self.push_screen(screen)
        self._offer_rescue(draft, then)

    def _offer_rescue(self, draft: Draft, then: Callable[[], None] | None) -> None:
        found = recovery.rescues(draft.path)
        if not found:
            if then is not None:
                self.call_after_refresh(then)
            return
        rescue = found[0]
        what = draft.path.name if draft.path else "a case without a file"

        def answered(answer: str | None) -> None:
            if answer == "recover":
                self._recover(rescue, draft)
                return
            if answer == "discard":
                recovery.forget(rescue)
            if then is not None:
                then()

        self.call_after_refresh(
            self.push_screen,
            Ask(f"There is unsaved work on {what} from {rescue.age()}.", ["recover", "discard", "decide later"]),
            answered,
        )

    def _recover(self, rescue: recovery.Rescue, draft: Draft) -> None:
        """Put rescued work into the draft.

        Work without a file has another outline where it is a machine.
        """
        if draft.path is not None or rescue.is_machine == draft.is_machine_case:
            recovery.take(rescue, draft)
            self.builder.edited()
            return
        other = api.draft(is_machine=rescue.is_machine)
        recovery.take(rescue, other)
        self._open(other)

    def action_open_case(self) -> None:
        """Ask for another case."""

        def chosen(source: str | None) -> None:
            if source is not None and (source != EMPTY or self.builder.draft.is_changed() or self.builder.draft.path):
                self.open(source)

        def go() -> None:
            self.push_screen(OpenCase(Path.cwd()), chosen)

        self.unless_unsaved(go)

    def unless_unsaved(self, then: Callable[[], None]) -> None:
        """Go on when everything is saved or given up."""
        draft = self.builder.draft
        if not draft.is_changed():
            then()
            return

        def answered(answer: str | None) -> None:
            if answer == "save":
                self.save_case(then)
            elif answer == "discard the changes":
                self.builder.keeper.drop()
                then()

        name = draft.path.name if draft.path else "This case"
        self.push_screen(Ask(f"{name} has unsaved changes.", ["save", "discard the changes", "go back"]), answered)

    def save_case(self, then: Callable[[], None] | None = None) -> None:
        """Save, with questions where needed.

        They are about a name or about overwriting.
        """
        draft = self.builder.draft
        if draft.path is None:
            self.action_save_as(then)
        elif draft.changed_on_disk():

            def answered(answer: str | None) -> None:
                if answer == "overwrite":
                    self._write(None, then)
                elif answer == "save under another name":
                    self.action_save_as(then)

            question = f"{draft.path.name} has been changed by another program since it was opened here."
            self.push_screen(Ask(question, ["save under another name", "overwrite", "go back"]), answered)
        else:
            self._write(None, then)

    def action_save_as(self, then: Callable[[], None] | None = None) -> None:
        """Ask where to save."""
        draft = self.builder.draft
        proposal = draft.path or Path(f"{draft.get('name') or 'untitled'}.toml")

        def named(text: str | None) -> None:
            if text is None:
                return
            path = Path(text).expanduser()
            path = path if path.suffix else path.with_suffix(".toml")
            if path.exists() and path != draft.path:

                def answered(answer: str | None) -> None:
                    if answer == "overwrite":
                        self._write(path, then)

                self.push_screen(Ask(f"{path} exists.", ["go back", "overwrite"]), answered)
            else:
                self._write(path, then)

        self.push_screen(AskText("Save the case as", str(proposal)), named)

    def _write(self, path: Path | None, then: Callable[[], None] | None) -> None:
        builder = self.builder
        try:
            written = builder.draft.save(path)
        except LambdaError as error:
            self.notify(f'{error}. Nothing is lost: save elsewhere with "Save as".', severity="error", timeout=12)
            return
        remember(written)
        builder.saved()
        self.notify(f"saved {written}", timeout=3)
        if then is not None:
            then()

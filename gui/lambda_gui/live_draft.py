"""Check, estimate and back up a draft as it changes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

from textual import work
from textual.screen import Screen
from textual.timer import Timer
from textual.worker import get_current_worker

from lambda_core.domain.errors import LambdaError
from lambda_gui.case_context import CaseContext
from lambda_gui.checking import Check, Checker, plugin_faults
from lambda_gui.helper import Estimator
from lambda_gui.lifecycle import is_here
from lambda_gui.recovery import Keeper

if TYPE_CHECKING:
    from lambda_core.api import Draft

_CHECK_AFTER = 0.1  # of quiet [s]
_KEEP_AFTER = 2.0  # of unsaved work [s]


class LiveDraft(Screen[None]):
    """Draft with checks and estimates.

    Checks run in a thread, estimates in a process; unsaved work is kept.

    Parameters
    ----------
    draft : Draft
        The case.
    """

    def __init__(self, draft: Draft) -> None:
        super().__init__()
        self.draft = draft
        self.around = CaseContext(draft)
        self.check = Check()
        self.checked_in = 0.0  # how long the last check took [s]
        self.keeper = Keeper()
        self._estimator = Estimator(self.show_estimate)
        self._checker = Checker(draft.root)
        self._check_timer: Timer | None = None
        self._changes, self._checked_changes = 0, -1  # how many there were, and when what was checked last began
        self._after_check: Callable[[], None] | None = None
        self._has_told_faults = False

    def begin(self) -> None:
        """Check in the background once the first picture stands."""
        self.set_interval(_KEEP_AFTER, self._keep)
        self.call_after_refresh(self._check_now)

    async def on_unmount(self) -> None:
        """End the estimator's process and release the catalogue."""
        await self._estimator.close()
        self._checker.close()

    def edited(self) -> None:
        """Check a change soon."""
        self._changes += 1
        if self._check_timer is not None:
            self._check_timer.stop()
        self._check_timer = self.set_timer(_CHECK_AFTER, self._check_now)

    @property
    def is_checked(self) -> bool:
        """True if the present draft is checked."""
        return self._checked_changes == self._changes

    @property
    def is_here(self) -> bool:
        """True while a screen can show something."""
        return is_here(self)

    def when_checked(self, then: Callable[[], None]) -> None:
        """Call a function after the present check.

        Keys may come faster than checks.
        """
        if self.is_checked:
            then()
        else:
            self._after_check = then
            self.notify("checking first", timeout=2)

    def catalogue_changed(self) -> None:
        """Look things up anew: rows may have been added."""
        self.around.forget_names()
        self._checker.close()

    def show_check(self) -> None:
        """Show what the last check found."""
        raise NotImplementedError

    def show_estimate(self, estimate: Any, say: str) -> None:
        """Show an estimate, or the progress of its computation."""
        raise NotImplementedError

    def _check_now(self) -> None:
        # A copy: the draft may change while a thread goes through it.
        self._check(deepcopy(self.draft.tables), self.draft.folder, self._changes)

    @work(thread=True, exclusive=True, group="check")
    def _check(self, tables: Mapping[str, Any], folder: Path | None, changes: int) -> None:
        worker = get_current_worker()
        begin = time.perf_counter()
        found = self._checker.check(tables, folder)
        took = time.perf_counter() - begin
        if worker.is_cancelled:  # a newer check has begun, and may have ended before this one
            return
        self.app.call_from_thread(self._checked, found, took, changes)
        if not self._has_told_faults:
            self._has_told_faults = True
            self.app.call_from_thread(self._tell_faults, plugin_faults())

    def _tell_faults(self, faults: Sequence[str]) -> None:
        if not self.is_here:
            return
        self.app.stands()  # type: ignore[attr-defined]
        for fault in faults:
            self.notify(fault, title="not in use", severity="warning", timeout=12)

    def _checked(self, found: Check, took: float, changes: int) -> None:
        if not self.is_here:
            return
        self.check, self.checked_in, self._checked_changes = found, took, changes
        self.around.learn(found.values)
        self.show_check()
        if found.model is not None:
            self.run_worker(self._estimator.ask(deepcopy(self.draft.tables), self.draft.folder), group="estimate")
        if self.is_checked and self._after_check is not None:
            then, self._after_check = self._after_check, None
            then()

    def _keep(self) -> None:
        """Keep unsaved work aside, so that a crash loses seconds."""
        try:
            if self.draft.is_changed():
                self.keeper.keep(self.draft)
            else:
                self.keeper.drop()
        except LambdaError as error:
            self.notify(f"unsaved work cannot be backed up: {error}", severity="warning")

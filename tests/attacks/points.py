"""Kill runs around each writing call, resume and compare."""

from __future__ import annotations

import os
import random
import signal
from collections import Counter
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

from lambda_core.results import hdf5
from lambda_core.results.writer import ResultWriter
from tests.attacks.damage import LIMIT, Said, command, gone_on_with, line, made_once, undisturbed_result, work_left
from tests.attacks.trial import Trial, attempt

_TRIES = 12  # at meeting a run that has work left


def killed_at_a_point(seed: int, number: int, folder: Path) -> Said:
    """Kill a run at a write, compare.

    Before or behind one of its writes; it has work left and goes on.
    """
    undisturbed, counts = undisturbed_result(folder), _counts(folder)
    pick = random.Random(seed * 1_000_003 + number)
    for _ in range(_TRIES):  # some calls follow the clock, and some come at the end alone: those leave no work
        name = pick.choice(sorted(counts))
        call, behind = pick.randrange(counts[name]), pick.random() < 0.5
        at = {"point": f"{'after' if behind else 'before'} call {call} of {name}"}
        (folder / "out.h5").unlink(missing_ok=True)
        ended = Trial(command(folder), folder, before=partial(_patch, name, call, behind)).wait(LIMIT)
        if ended.verdict == "killed" and (left := work_left(folder, undisturbed)) > 0.0:
            return gone_on_with(folder, undisturbed), line(command(folder)), at | {"left": left}
    return ended.but("missed", "no run had work left when it was killed"), line(command(folder)), at


def _points() -> dict[str, tuple[Any, str]]:
    """Return a run's writing functions by name."""
    owned = [(ResultWriter, name) for name in ("_put_status", "flush", "save", "close")]
    owned += [(hdf5, "copy"), (os, "replace")]
    return {f"{owner.__name__.rsplit('.', 1)[-1]}.{name}": (owner, name) for owner, name in owned}


def _counts(folder: Path) -> dict[str, int]:
    """Return how often a run writes.

    Calls of each function by an undisturbed run once its file is there.
    """

    def make(place: Path) -> None:
        attempt(command(folder), place, 2.0 * LIMIT, before=partial(_count, place / "counts"))

    lines = (made_once(folder, "counts", make) / "counts").read_text(encoding="utf-8").splitlines()
    return dict(Counter(lines))


def _count(log: Path) -> None:
    """Write a line for each call.

    In the process that runs.
    """
    for name, (owner, attribute) in _points().items():
        setattr(owner, attribute, _counted(getattr(owner, attribute), name, log))


def _counted(function: Callable[..., Any], name: str, log: Path) -> Callable[..., Any]:
    def call(*arguments: Any, **options: Any) -> Any:
        if Path("out.h5").exists():
            with log.open("a", encoding="utf-8") as file:
                file.write(f"{name}\n")
        return function(*arguments, **options)

    return call


def _patch(name: str, number: int, behind: bool) -> None:
    """Kill the process at a call.

    Before or behind that number, counted once its file is there.
    """
    owner, attribute = _points()[name]
    function, seen = getattr(owner, attribute), [0]

    def call(*arguments: Any, **options: Any) -> Any:
        if not Path("out.h5").exists():
            return function(*arguments, **options)
        seen[0] += 1
        if seen[0] <= number:
            return function(*arguments, **options)
        if behind:
            function(*arguments, **options)
        os.kill(os.getpid(), signal.SIGKILL)
        raise AssertionError("killed")

    setattr(owner, attribute, call)

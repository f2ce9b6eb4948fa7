"""Fill disks and lock folders while the program writes.

Full is a limit of the size of a file, or where this process may mount, a file system of so many bytes. Read-only is a
file system that is mounted so, or a process without the right to write.
"""

from __future__ import annotations

import os
import random
import resource
import shutil
import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from tests.attacks.damage import CASE, RUN, Said, differences, half, hidden, line, undisturbed_result
from tests.attacks.trial import Outcome, attempt

_LIMIT = 60.0  # [s] of wall time
_SMALLEST = 30_000  # [byte] beyond what a command prints
_STUDY = """
name = "disks"
case = "6208-axial-1300"
responses = ["friction_torque_Nmm"]

[[parameters]]
path = "loads.axial"
values = ["1 kN", "1.1 kN"]
"""
_COMMANDS = (
    *(RUN,) * 4,
    *(("resume", "out.h5"),) * 2,
    ("view", "out.h5", "film", "--out", "pictures"),
    ("report", "out.h5", "--out", "report.html"),
    ("init", CASE, "--out", "case.toml"),
    ("study", "run", "study.toml", "--workers", "1"),
    ("quasistatic", CASE),
    ("db", "export", "rows"),
)


def full_disk(seed: int, number: int, folder: Path) -> Said:
    """Let a command write without room.

    Or without the right; then give it both and compare.
    """
    pick = random.Random(seed * 1_000_003 + number)
    arguments = pick.choice(_COMMANDS)
    before = _inputs(arguments, folder)
    room = int(_SMALLEST * (100.0 ** pick.random()))
    kind = pick.choice(("file", "small", "read-only"))
    with _place(kind, room, folder, before) as (place, limit):
        # The words of a command are kept elsewhere: what it prints has room.
        outcome = attempt(arguments, folder / "said", _LIMIT, before=_in(place, limit))
        for path in place.iterdir():
            if path.is_file():
                shutil.copy(path, folder / path.name)
        left = hidden(place)
    if outcome.good and left:
        outcome = outcome.but("litter", f"left behind: {', '.join(left)}")
    elif outcome.good and arguments[0] in ("run", "resume"):
        outcome = _gone_on_with(outcome, folder, arguments)
    return outcome, line(arguments), {"disk": kind, "room": room}


def _inputs(arguments: tuple[str, ...], folder: Path) -> dict[str, bytes]:
    """Return a command's input files by name."""
    if arguments[0] == "study":
        return {"study.toml": _STUDY.encode()}
    if arguments[0] == "resume":
        return {"out.h5": half(folder).read_bytes()}
    return {"out.h5": undisturbed_result(folder).read_bytes()} if arguments[0] in ("view", "report") else {}


@contextmanager
def _place(kind: str, room: int, folder: Path, files: dict[str, bytes]) -> Iterator[tuple[Path, int]]:
    """Make a full folder with files.

    Return it with the limit of a file's size that goes with it.
    """
    place = folder / "place"
    place.mkdir()
    mounted = kind != "file" and _mount(place, f"size={room + sum(map(len, files.values()))}")
    for name, content in files.items():
        (place / name).write_bytes(content)
    if kind == "read-only" and not (mounted and _mount(place, "remount,ro")):
        place.chmod(0o555)
    try:
        yield place, resource.RLIM_INFINITY if mounted else room
    finally:
        if mounted:
            subprocess.run(["umount", "-l", str(place)], check=False, capture_output=True)
        else:
            place.chmod(0o755)


def _mount(place: Path, options: str) -> bool:
    """Mount a file system in memory.

    False where this process may not.
    """
    command = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", str(place)]
    return os.geteuid() == 0 and subprocess.run(command, check=False, capture_output=True).returncode == 0


def _in(place: Path, limit: int) -> Callable[[], None]:
    """Return a child's first function.

    It goes there, and takes its limit.
    """

    def before() -> None:
        os.chdir(place)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))

    return before


def _gone_on_with(outcome: Outcome, folder: Path, arguments: tuple[str, ...]) -> Outcome:
    """Go on after a full disk, compare.

    Every number must be that of the run that had room.
    """
    file = folder / "out.h5"
    if not file.is_file():
        told = outcome.verdict == "usage" or arguments[0] == "resume"
        return outcome if told else outcome.but("lost", "no file, and it does not say so")
    longer = attempt(("resume", "out.h5"), folder, _LIMIT)
    over = longer.verdict == "usage" and "is finished: nothing is left to do" in longer.said
    if longer.verdict not in ("fine", "partial") and not over:
        return longer.but("lost", "could not be continued") if longer.good else longer
    if wrong := differences(undisturbed_result(folder), file):
        return longer.but("different", f"not bit for bit: {', '.join(wrong)}")
    return outcome

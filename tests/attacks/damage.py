"""Kill runs, damage their files, run two on one file.

What is compared is what a user would see: every number of a run that was killed and continued, every word of a
command that reads a damaged file. A damaged file may be refused or called damaged; it may not look whole and differ.
"""

from __future__ import annotations

import math
import os
import random
import re
import shlex
import shutil
import time
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from lambda_core import api
from lambda_core.model.machine_templates import shaft_text
from lambda_core.results import hdf5
from tests.attacks.trial import Outcome, Trial, attempt

CASE = "6208-axial-1300"
DURATION = "40 ms"  # of simulated time
# Checkpoints in quick succession, so that many kills meet one that is being written.
RUN = (
    *("run", CASE, "--out", "out.h5"),
    *("--set", f"solver.duration={DURATION}", "--set", "output.checkpoint_interval=20 ms"),
)
# The same of a machine; its file stands in a folder of its own, see victims.
MACHINE = "geared-shaft"
_MACHINE_DURATION = "60 ms"
OF_MACHINES = "_of_machines"  # how the names of parts about machines end
# Of the time that the undisturbed run had its file open: when a run is killed in its middle. That time may have been
# measured on a busier machine, so small shares follow, and all of them several times.
_SHARES = (0.5, 0.7, 0.3, 0.6, 0.8, 0.4, 0.2, 0.9, 0.1, 0.05, 0.02) * 3
_TRIES = 12  # at meeting a run that has work left; each waits three quarters as long as the one before at most
LIMIT = 60.0  # [s] of wall time for any command on such a file
_READS = (
    ("show", "out.h5"),
    ("show", "out.h5", "--json"),
    ("show", "out.h5", "--assumptions"),
    ("cite", "out.h5"),
    ("view", "out.h5", "film", "--out", "pictures"),
    ("resume", "out.h5", "--json"),
)
Said = tuple[Outcome, str, dict[str, Any]]


def line(arguments: tuple[str, ...] | list[str]) -> str:
    """Return a command line as it is typed."""
    return "lambda-bearing " + shlex.join(arguments)


def made_once(folder: Path, name: str, make: Callable[[Path], object]) -> Path:
    """Return a folder shared by a part's trials.

    Each process makes it once: the program may change.
    """
    place = folder.parent / f"{_part(folder)}.{os.getpid()}.{name}"
    if not (place / "done").is_file():
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        make(place)
        (place / "done").touch()
    return place


def _part(folder: Path) -> str:
    """Return the part of a trial's folder.

    Each may run in a process of its own.
    """
    return re.split("[-.]", folder.name)[0]


def command(folder: Path) -> tuple[str, ...]:
    """Return the attacked run's command.

    Of one bearing, or of a machine.
    """
    if not _part(folder).endswith(OF_MACHINES):
        return RUN
    made = made_once(folder, "case", lambda place: (place / "box.toml").write_text(shaft_text("geared-shaft", "box")))
    return ("run", str(made / "box.toml"), *RUN[2:4], "--set", f"solver.duration={_MACHINE_DURATION}", *RUN[6:])


def undisturbed_result(folder: Path) -> Path:
    """Return the result of the run that nobody disturbed."""
    return made_once(folder, "whole", lambda place: _must(command(folder), place)) / "out.h5"


def half(folder: Path) -> Path:
    """Return the same run, killed in the middle."""

    def make(place: Path) -> None:
        open_s = float((undisturbed_result(folder).parent / "open").read_text(encoding="utf-8"))
        for share in _SHARES:
            (place / "out.h5").unlink(missing_ok=True)
            if _kill(place, share * open_s) and _is_midway(place / "out.h5"):
                return
        raise RuntimeError("no run could be killed in its middle")

    return made_once(folder, "half", make) / "out.h5"


def _is_midway(file: Path) -> bool:
    """Tell whether a result is unfinished.

    It has samples: a quick machine may be done before the blow.
    """
    status = api.result(file).status()
    return status.rows.samples > 1 and status.state != "finished"


def _must(arguments: tuple[str, ...], place: Path) -> None:
    outcome = attempt(arguments, place, 2.0 * LIMIT, watched=place / "out.h5")
    if outcome.verdict not in ("fine", "partial"):
        raise RuntimeError(f"{line(arguments)}: {outcome.verdict}: {outcome.said}")
    (place / "open").write_text(str(outcome.open_s), encoding="utf-8")


def killed_run(seed: int, number: int, folder: Path) -> Said:
    """Kill a run, go on and compare.

    Every number must be that of the undisturbed run; it has work left.
    """
    undisturbed = undisturbed_result(folder)
    pick = random.Random(seed * 1_000_003 + number)
    longest = float((undisturbed.parent / "open").read_text(encoding="utf-8"))
    for again in range(_TRIES):
        (folder / "out.h5").unlink(missing_ok=True)
        if _kill(folder, pick.uniform(0.0, longest * 0.75**again)) and (left := work_left(folder, undisturbed)) > 0.0:
            return gone_on_with(folder, undisturbed), line(command(folder)), {"left": left}
    return Outcome("missed", said="no run had work left when it was killed"), line(command(folder)), {"left": 0.0}


def work_left(folder: Path, undisturbed: Path) -> float:
    """Return a killed run's missing share.

    Of its samples; 0 where it was at its end.
    """
    ends = [api.result(path).status() for path in (folder / "out.h5", undisturbed)]
    if ends[0].state == "finished":
        return 0.0
    written, every = (status.rows.samples for status in ends)
    return 1.0 - written / every


def gone_on_with(folder: Path, undisturbed: Path) -> Outcome:
    """Go on with a killed run, compare.

    Every number must be that of the undisturbed run.
    """
    file = folder / "out.h5"
    outcome = attempt(("resume", "out.h5"), folder, LIMIT)
    if outcome.verdict not in ("fine", "partial"):
        outcome = outcome.but("lost", "could not be continued") if outcome.good else outcome
    elif wrong := differences(undisturbed, file):
        outcome = outcome.but("different", f"not bit for bit: {', '.join(wrong)}")
    elif left := hidden(folder):
        outcome = outcome.but("litter", f"left behind: {', '.join(left)}")
    return outcome


def _kill(folder: Path, after_s: float) -> bool:
    """Start and kill a run.

    So long after it has opened its file [s]; tell whether it was in its midst.
    """
    victim = Trial(command(folder), folder)
    end = time.monotonic() + LIMIT
    while not (folder / "out.h5").is_file() and time.monotonic() < end:
        time.sleep(0.001)
    time.sleep(after_s)
    victim.kill()
    # on a busy machine a run may need longer to begin
    return victim.wait(math.inf).verdict == "killed" and (folder / "out.h5").is_file()


def hidden(folder: Path) -> list[str]:
    """Return the hidden files of a folder.

    No command may leave any.
    """
    return sorted(path.name for path in folder.iterdir() if path.name.startswith("."))


def differences(one: Path, other: Path) -> list[str]:
    """Return the differences of two results.

    Datasets of every kind and attributes, and how far and in what state each run is.

    Left out are only wall times, the day, checkpoints, and references from one dataset to another.
    """
    found: list[str] = []
    with hdf5.open_for_reading(one) as a, hdf5.open_for_reading(other) as b:
        names: list[list[str]] = [[], []]
        for file, its in zip((a, b), names, strict=True):
            file.visit(its.append)
        found += sorted(set(names[0]) ^ set(names[1]))
        found += _attributes("", a, b)
        for name in names[0]:
            if name not in b or name.split("/")[0] in ("restart", "status"):
                continue
            found += _attributes(name, a[name], b[name])
            if isinstance(a[name], h5py.Dataset) and not _equal(a[name], b[name]):
                found.append(name)
    if not found:
        ends = [api.result(path).status() for path in (one, other)]
        found += [name for name in ("state", "rows", "message") if getattr(ends[0], name) != getattr(ends[1], name)]
    return found


def _attributes(name: str, one: Any, other: Any) -> list[str]:
    """Return the attributes that differ.

    Without scales of dimensions and the day.
    """
    aside = ("DIMENSION_LIST", "REFERENCE_LIST", "created")
    keys = sorted({*one.attrs, *other.attrs} - {*aside})
    return [
        f"{name}@{key}"
        for key in keys
        if key not in one.attrs or key not in other.attrs or not np.array_equal(one.attrs[key], other.attrs[key])
    ]


def _equal(one: Any, other: Any) -> bool:
    if one.shape != other.shape or one.dtype != other.dtype:
        return False
    return bool(np.array_equal(one[...], other[...], equal_nan=one.dtype.kind == "f"))


def corrupted(seed: int, number: int, folder: Path) -> Said:
    """Damage a result and ask for answers.

    They are as before, or report the damage.
    """
    pick = random.Random(seed * 1_000_003 + number)
    arguments = pick.choice(_READS)
    if arguments[0] == "view" and _part(folder).endswith(OF_MACHINES):
        arguments = (*arguments, "--bearing", "left")
    source = half(folder) if arguments[0] == "resume" or pick.random() < 0.3 else undisturbed_result(folder)
    before = _answers(source, folder, arguments)
    data = bytearray(source.read_bytes())
    _damage(data, pick)
    (folder / "out.h5").write_bytes(data)
    outcome = attempt(arguments, folder, LIMIT)
    told = _what_differs(outcome, arguments, folder, before)
    if outcome.good and told:
        outcome = outcome.but("different", told)
    return outcome, line(arguments), {"sha256": sha256(data).hexdigest()[:16]}


def _damage(data: bytearray, pick: random.Random) -> None:
    """Damage a file.

    Overwrite places, half of them near the beginning, or cut the end off.
    """
    for _ in range(pick.choice((1, 1, 8, 64))):
        start = pick.randrange(len(data) if pick.random() < 0.5 else min(len(data), 65536))
        length = pick.choice((1, 1, 16, 4096))
        data[start : start + length] = bytes(length) if pick.random() < 0.5 else pick.randbytes(length)
    if pick.random() < 0.2:
        del data[pick.randrange(len(data)) :]


def _answers(source: Path, folder: Path, arguments: tuple[str, ...]) -> Path:
    """Return the answers for an undamaged file.

    Their folder is made once per campaign.
    """

    def make(place: Path) -> None:
        shutil.copy(source, place / "out.h5")
        _must(arguments, place)

    name = sha256(repr((source.parent.name, arguments)).encode()).hexdigest()[:8]
    return made_once(folder, f"answers-{name}", make)


def _what_differs(outcome: Outcome, arguments: tuple[str, ...], folder: Path, before: Path) -> str:
    """Explain an answer that hides damage.

    It differs from that of the file before; "" if it does not.
    """
    if outcome.verdict not in ("fine", "partial") or "damage" in outcome.said:
        return ""
    if arguments[0] == "resume":
        return ", ".join(differences(before / "out.h5", folder / "out.h5"))
    if arguments[0] == "view":
        pictures = [sorted(path.name for path in (place / "pictures").iterdir()) for place in (folder, before)]
        if pictures[0] != pictures[1]:
            return f"other pictures: {pictures}"
        same = all(_drawn(folder / "pictures" / name) == _drawn(before / "pictures" / name) for name in pictures[0])
        return "" if same else "another picture"
    return "" if (folder / "stdout").read_bytes() == (before / "stdout").read_bytes() else "another answer"


def _drawn(file: Path) -> str:
    """Return the hash of a picture.

    SVG without the lines that carry random names and the date.
    """
    content = file.read_bytes()
    if file.suffix == ".svg":
        content = b"\n".join(row for row in content.splitlines() if b"dc:date" not in row and b"id=" not in row)
    return sha256(content).hexdigest()


def race(seed: int, number: int, folder: Path) -> Said:
    """Let two runs write one file.

    The later one has it, the file is complete, nothing else is left.
    """
    pick = random.Random(seed * 1_000_003 + number)
    arguments = [*command(folder)[:2], "--set", "solver.duration=5 ms", "--out", str(folder / "out.h5"), "--force"]
    one = Trial(arguments, folder / "one")
    time.sleep(pick.uniform(0.0, 0.3))
    other = Trial(arguments, folder / "two")
    ends = [one.wait(LIMIT), other.wait(LIMIT)]
    bad = next((end for end in ends if not end.good), None)
    shown = attempt(["show", str(folder / "out.h5")], folder / "show", LIMIT)
    if bad is None and shown.verdict != "fine":
        bad = shown.but("torn", "the file of two runs is not whole") if shown.good else shown
    if bad is None and (left := hidden(folder)):
        bad = Outcome("litter", said=f"left behind: {', '.join(left)}")
    return bad or shown, line(arguments), {}

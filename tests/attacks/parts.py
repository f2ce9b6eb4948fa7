"""The parts of a campaign: each is a number of trials, told apart by their number, repeatable by seed."""

from __future__ import annotations

import random
import shlex
import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from tests.attacks import cases, hostile
from tests.attacks.record import Record
from tests.attacks.trial import Outcome, Trial, attempt

_SHORT_CASE = "6208-axial-1300"
_SHORT_RUN = "40 ms"  # of simulated time
_WRITING = 0.1  # wall time within which such a run is killed after it has opened its file [s]


@dataclass(frozen=True)
class Part:
    """One kind of attack."""

    name: str
    about: str
    count: int  # of a full campaign
    trial: Callable[[int, int, Path], tuple[Outcome, str, dict[str, Any]]]  # (seed, number, folder)


def _line(arguments: list[str]) -> str:
    return "lambda-bearing " + shlex.join(arguments)


def hostile_input(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Meet a case, study or command line with one hostile value."""
    arguments, computes = hostile.attack(seed * 1_000_003 + number, folder)
    outcome = attempt(arguments, folder, 60.0)
    behind = computes and outcome.verdict not in ("usage", "refused")
    return outcome, _line(arguments), {"behind": behind}


def _reference(folder: Path) -> Path:
    """Return a finished short result, made once per campaign."""
    made = folder.parent / "reference" / "out.h5"
    if not made.is_file():
        arguments = ["run", _SHORT_CASE, "--set", f"solver.duration={_SHORT_RUN}", "--out", "out.h5"]
        attempt(arguments, made.parent, 120.0)
    return made


def killed_run(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Kill a run while its file is open, go on, and compare every number with the run that nobody killed."""
    whole = _reference(folder)
    pick = random.Random(seed * 1_000_003 + number)
    arguments = ["run", _SHORT_CASE, "--set", f"solver.duration={_SHORT_RUN}", "--out", "out.h5"]
    file = folder / "out.h5"
    victim = Trial(arguments, folder)
    _wait_for(file)
    time.sleep(pick.uniform(0.0, _WRITING))
    victim.kill()
    victim.wait(1.0)
    if not file.is_file():
        return Outcome("fine", said="killed before there was a file"), _line(arguments), {"met": False}
    outcome = attempt(["resume", "out.h5"], folder, 60.0)
    if outcome.verdict in ("fine", "partial") and (wrong := _different(whole, file)):
        outcome = outcome.but("different", f"not bit for bit: {', '.join(wrong)}")
    return outcome, _line(arguments), {"met": True}


def _wait_for(file: Path) -> None:
    end = time.monotonic() + 30.0
    while not file.is_file() and time.monotonic() < end:
        time.sleep(0.001)


def _different(one: Path, other: Path) -> list[str]:
    """Return the datasets of samples, records and revolutions that differ; wall times do."""
    found: list[str] = []
    with h5py.File(one, "r") as a, h5py.File(other, "r") as b:

        def look(name: str, item: Any) -> None:
            if not isinstance(item, h5py.Dataset) or "wall" in name or "checkpoint" in name or item.dtype.kind != "f":
                return
            if name not in b or item.shape != b[name].shape or not np.array_equal(item[...], b[name][...], True):
                found.append(name)

        a.visititems(look)
    return found


def corrupted(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Damage a result file and ask for what it says."""
    whole = _reference(folder)
    pick = random.Random(seed * 1_000_003 + number)
    folder.mkdir(parents=True, exist_ok=True)
    data = bytearray(whole.read_bytes())
    for _ in range(pick.choice((1, 1, 8, 64))):
        start = pick.randrange(len(data)) if pick.random() < 0.5 else pick.randrange(min(len(data), 8192))
        length = pick.choice((1, 1, 16, 4096))
        data[start : start + length] = bytes(length) if pick.random() < 0.5 else pick.randbytes(length)
    if pick.random() < 0.2:
        del data[pick.randrange(len(data)) :]
    (folder / "out.h5").write_bytes(data)
    arguments = pick.choice(
        (["show", "out.h5"], ["show", "out.h5", "--json"], ["resume", "out.h5"], ["cite", "out.h5"],
         ["view", "out.h5", "film", "--out", "pictures"], ["show", "out.h5", "--assumptions"])
    )  # fmt: skip
    outcome = attempt(arguments, folder, 60.0)
    return outcome, _line(arguments), {"sha256": sha256(data).hexdigest()[:16]}


def race(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Let two runs write one file at the same time; the second to end decides, and the file must be whole."""
    arguments = ["run", _SHORT_CASE, "--set", "solver.duration=5 ms", "--out", str(folder / "out.h5"), "--force"]
    both = [Trial(arguments, folder / name) for name in ("one", "two")]
    ends = [trial.wait(60.0) for trial in both]
    bad = next((end for end in ends if not end.good), None)
    shown = attempt(["show", str(folder / "out.h5")], folder / "show", 60.0)
    left = [path.name for path in folder.iterdir() if path.name.startswith(".")]
    if bad is None and left:
        bad = Outcome("litter", said=f"left behind: {', '.join(left)}")
    return bad or shown, _line(arguments), {}


PARTS = {
    part.name: part
    for part in (
        Part("cases", "random cases over catalogue, laws and regimes", 1000, cases.random_case),
        Part("hostile", "one hostile value behind validation; studies; command lines", 10000, hostile_input),
        Part("kills", "runs killed with a file open, gone on with, compared bit for bit", 200, killed_run),
        Part("corruption", "damaged results, shown, drawn and gone on with", 200, corrupted),
        Part("races", "two runs on one output", 20, race),
    )
}


def run(part: Part, seed: int, count: int, folder: Path, deadline: float) -> None:
    """Do the trials of a part that are not recorded yet, until all are done or the clock says stop."""
    record = Record(folder, part.name)
    done = record.done()
    for number in range(count):
        if number in done or time.monotonic() > deadline:
            continue
        place = folder / "work" / f"{part.name}-{number}"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        outcome, command, more = part.trial(seed, number, place)
        record.add(number, outcome, command, place, seed=seed, **more)
        shutil.rmtree(place, ignore_errors=True)

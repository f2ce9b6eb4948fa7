"""List the parts of a campaign, repeatable by seed."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.attacks import (
    cases,
    damage,
    disks,
    guests,
    hostile,
    machines,
    points,
    questions,
    soak,
    stores,
    sweeps,
    visitors,
)
from tests.attacks.damage import line
from tests.attacks.record import Record
from tests.attacks.trial import Outcome, attempt


@dataclass(frozen=True)
class Part:
    """One kind of attack."""

    name: str
    about: str
    count: int  # of a full campaign
    trial: Callable[[int, int, Path], tuple[Outcome, str, dict[str, Any]]]  # (seed, number, folder)


def hostile_input(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Meet an input with a hostile value.

    A case, study or command line.
    """
    arguments, computes = hostile.attack(seed * 1_000_003 + number, folder)
    outcome = attempt(arguments, folder, 60.0)
    behind = computes and outcome.verdict not in ("usage", "refused")
    return outcome, line(arguments), {"behind": behind}


PARTS = {
    part.name: part
    for part in (
        Part("cases", "random cases over catalogue, laws and regimes", 1000, cases.random_case),
        Part("hostile", "one hostile value behind validation; studies; command lines", 10000, hostile_input),
        Part("kills", "runs killed with a file open, continued, compared bit for bit", 200, damage.killed_run),
        Part("corruption", "damaged results, shown, drawn and continued", 200, damage.corrupted),
        Part("disks", "disks that are full and folders that are read-only, then room again", 200, disks.full_disk),
        Part("code", "compiled code damaged on disk", 30, stores.damaged_code),
        Part("catalogues", "the catalogue's cache and a catalogue of one's own damaged", 200, stores.damaged_catalogue),
        Part("plugins", "packages of laws, methods and views with faults", 200, guests.plugin),
        Part("studies", "studies killed and continued, or run by two processes", 20, sweeps.study),
        Part("served", "bursts of 20 hostile requests to the served builder", 50, visitors.visit),
        Part("soak", "a run of 60 simulated seconds, its memory watched", 1, soak.soak),
        Part("races", "two runs on one output", 20, damage.race),
        Part("points", "runs killed before or behind a write, continued, compared", 60, points.killed_at_a_point),
        Part("kills_of_machines", "machines in motion killed at random times, likewise", 200, damage.killed_run),
        Part("points_of_machines", "machines in motion killed before or behind a write", 60, points.killed_at_a_point),
        Part("corruption_of_machines", "damaged results of machines", 100, damage.corrupted),
        Part("races_of_machines", "two runs of a machine on one output", 20, damage.race),
        Part("machines", "one hostile value in a machine, circuit, network, duty cycle, fit", 1000, machines.hostile),
        Part("questions", "hostile options and files of db choose, measured, fit and FMUs", 1000, questions.question),
        Part("calls", "calls of the Python API with one hostile argument", 2000, machines.call),
    )
}


def _commit() -> str:
    """Return the attacked program's commit.

    "+" behind it where files differ from it.
    """
    command = ["git", "describe", "--always", "--dirty=+", "--exclude=*"]
    return subprocess.run(command, cwd=Path(__file__).parent, capture_output=True, text=True).stdout.strip()


def run(part: Part, seed: int, numbers: Iterable[int], folder: Path, deadline: float) -> None:
    """Do the unrecorded trials of a part.

    Until all are done or the time is over.
    """
    record, commit = Record(folder, part.name), _commit()
    done = record.done()
    for number in numbers:
        if number in done or time.monotonic() > deadline:
            continue
        place = folder / "work" / f"{part.name}-{number}"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        outcome, command, more = part.trial(seed, number, place)
        record.add(number, outcome, command, place, seed=seed, commit=commit, **more)
        shutil.rmtree(place, ignore_errors=True)
    for made in (folder / "work").glob(f"{part.name}.{os.getpid()}.*"):
        shutil.rmtree(made, ignore_errors=True)

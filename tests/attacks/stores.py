"""Damage the program's own stores.

These are compiled code, the catalogue's cache and the user's catalogue.

It may be made again, or named with what to do; the answer may not differ, and the process may not die of it. Compiled
code is loaded once per process, so each trial of it starts Python anew.
"""

from __future__ import annotations

import os
import random
import shutil
from pathlib import Path
from typing import Any

from lambda_core.laws.kernels import cache_folder
from tests.attacks.damage import CASE, Said, line, made_once
from tests.attacks.trial import attempt

_LIMIT = 300.0  # [s] of wall time: a part of the solver may have to be compiled anew
_HOST = 0.1  # share of trials that hit a part of the solver, which takes longest to compile
_CHECKED = ("quasistatic", CASE, "--json")
_ASKED = (
    ("db", "search", "6208", "--json"),
    ("db", "check"),
    ("check", CASE),
    ("quasistatic", CASE, "--json"),
    ("db", "export", "rows", "--mine"),
)
_ROW = (
    *("db", "add", "bearing", "designation=6208", "maker=mine", "bore_diameter=40 mm", "outside_diameter=80 mm"),
    *("width=18 mm", "source=a drawing", "grade=B"),
)


def damaged_code(seed: int, number: int, folder: Path) -> Said:
    """Damage one file of compiled code.

    The program compiles it again and answers the same.
    """
    pick = random.Random(seed * 1_000_003 + number)
    store = folder / "cache"
    _linked(cache_folder(), store / "kernels")
    # What the command needs; the file that says which functions there are, and the one with machine code.
    places = [path for path in (store / "kernels").iterdir() if path.is_dir() and any(path.iterdir())]
    host = pick.random() < _HOST
    chosen = sorted(path for path in places if path.name.startswith("host-") == host)
    victims = pick.sample(chosen, min(len(chosen), 1 if host else 8))
    for place in victims:
        _damage(pick.choice(sorted(place.iterdir())), pick)
    before = made_once(folder, "said", lambda place: attempt(_CHECKED, place, _LIMIT))
    outcome = attempt(_CHECKED, folder, _LIMIT, {"LAMBDA_BEARING_CACHE": str(store)}, fresh=True)
    if outcome.verdict == "fine" and (folder / "stdout").read_bytes() != (before / "stdout").read_bytes():
        outcome = outcome.but("different", "another answer")
    shutil.rmtree(store)
    return outcome, line(_CHECKED), {"damaged": [place.name for place in victims]}


def damaged_catalogue(seed: int, number: int, folder: Path) -> Said:
    """Damage a catalogue and ask.

    Its cache, or the user's own.
    """
    pick = random.Random(seed * 1_000_003 + number)
    arguments = pick.choice(_ASKED)
    before = made_once(folder, f"said-{_ASKED.index(arguments)}", lambda place: _ask(arguments, place, place))
    for name in ("cache", "data"):
        shutil.copytree(before / name, folder / name, symlinks=True)
    files = sorted(path for name in ("cache", "data") for path in (folder / name).rglob("*.sqlite"))
    victim = pick.choice(files)
    _damage(victim, pick)
    outcome = attempt(arguments, folder, _LIMIT, _stores(folder))
    if outcome.verdict == "fine" and "cannot be read" not in outcome.said and _told(folder) != _told(before):
        outcome = outcome.but("different", "another answer")
    shutil.rmtree(folder / "cache")
    return outcome, line(arguments), {"damaged": victim.name}


def _ask(arguments: tuple[str, ...], place: Path, folder: Path) -> None:
    """Make a cache and catalogue, and ask.

    The catalogue has one row.
    """
    (folder / "cache").mkdir()
    (folder / "cache" / "kernels").symlink_to(cache_folder())
    added = attempt(_ROW, place, _LIMIT, _stores(folder))
    asked = attempt(arguments, place, _LIMIT, _stores(folder))
    for outcome in (added, asked):
        if outcome.verdict != "fine":
            raise RuntimeError(outcome.said)


def _stores(folder: Path) -> dict[str, str]:
    return {"LAMBDA_BEARING_CACHE": str(folder / "cache"), "LAMBDA_BEARING_DATA": str(folder / "data")}


def _told(folder: Path) -> dict[str, bytes]:
    """Return what a command printed, and what it exported."""
    rows = (folder / "rows").iterdir() if (folder / "rows").is_dir() else ()
    return {path.name: path.read_bytes() for path in (folder / "stdout", *rows)}


def _linked(source: Path, target: Path) -> None:
    """Copy a folder by links.

    A file that is to be changed has to be replaced.
    """
    target.parent.mkdir(parents=True)
    shutil.copytree(source, target, copy_function=_link)


def _link(source: str, target: str) -> Any:
    try:
        os.link(source, target)
    except OSError:  # on another file system
        shutil.copy2(source, target)


def _damage(file: Path, pick: random.Random) -> None:
    data = bytearray(file.read_bytes())
    kind = pick.choice(("flip", "flip", "cut", "empty", "noise"))
    if kind == "flip" and data:
        for _ in range(pick.choice((1, 16))):
            data[pick.randrange(len(data))] ^= 1 << pick.randrange(8)
    elif kind == "cut":
        del data[pick.randrange(len(data) or 1) :]
    elif kind == "empty":
        data.clear()
    else:
        data[:] = pick.randbytes(len(data))
    file.unlink()
    file.write_bytes(data)

"""Kill and resume studies, or run two in one folder."""

from __future__ import annotations

import random
import time
from pathlib import Path

from tests.attacks.damage import Said, line, made_once
from tests.attacks.trial import Outcome, Trial, attempt

_LIMIT = 180.0  # [s] of wall time
_STUDY = """
name = "swept"
case = "6208-axial-1300"
mode = "{mode}"
responses = ["friction_torque_Nmm", "min_film_um"]
{more}
[[parameters]]
path = "loads.axial"
range = ["0.8 kN", "1.6 kN"]
points = 4
"""
_MODES = {"quasi-static": "", "dynamic": '\n[set]\n"solver.duration" = "4 ms"\n'}
_RUN = ("study", "run", "study.toml", "--workers", "2", "--quiet")
_SHOW = ("study", "show", "swept", "--json")
_RESUME = ("study", "resume", "swept", "--workers", "2", "--quiet")


def study(seed: int, number: int, folder: Path) -> Said:
    """Kill or duplicate a study, compare.

    Its table in the end.
    """
    pick = random.Random(seed * 1_000_003 + number)
    mode = pick.choice(tuple(_MODES))
    (folder / "study.toml").write_text(_STUDY.format(mode=mode, more=_MODES[mode]), encoding="utf-8")
    quiet = made_once(folder, mode, lambda place: _quiet(mode, place))
    took = float((quiet / "took").read_text(encoding="utf-8"))
    ends = _raced(folder, pick, took) if pick.random() < 0.3 else _killed(folder, pick, took)
    shown = attempt(_SHOW, folder, _LIMIT)
    bad = next((end for end in (*ends, shown) if not end.good), None)
    if bad is None and _table(folder) != _table(quiet):
        bad = shown.but("different", "another table than that of a quiet study")
    if bad is None and (left := [str(path.name) for path in (folder / "swept").rglob(".*") if path.is_file()]):
        bad = shown.but("litter", f"left behind: {', '.join(left)}")
    return bad or shown, line(_RUN), {"mode": mode}


def _quiet(mode: str, place: Path) -> None:
    (place / "study.toml").write_text(_STUDY.format(mode=mode, more=_MODES[mode]), encoding="utf-8")
    outcome = attempt(_RUN, place, _LIMIT)
    (place / "took").write_text(str(outcome.wall_s), encoding="utf-8")
    if attempt(_SHOW, place, _LIMIT).verdict != "fine":
        raise RuntimeError(outcome.said)


def _killed(folder: Path, pick: random.Random, took: float) -> list[Outcome]:
    """Kill a study, then go on.

    With its workers; a study that had not begun is started again.
    """
    victim = Trial(_RUN, folder)
    time.sleep(pick.uniform(0.1, 1.0) * took)
    victim.kill()
    victim.wait(_LIMIT)
    if not (folder / "swept").is_dir():
        return [attempt(_RUN, folder, _LIMIT)]
    return [attempt(_RESUME, folder, _LIMIT)]


def _raced(folder: Path, pick: random.Random, took: float) -> list[Outcome]:
    """Continue a study that still runs.

    From another process.
    """
    one = Trial(_RUN, folder)
    time.sleep(pick.uniform(0.3, 0.9) * took)
    other = Trial(("study", "resume", str(folder / "swept"), *_RESUME[3:]), folder / "other")
    return [one.wait(_LIMIT), other.wait(_LIMIT)]


def _table(folder: Path) -> bytes:
    return (folder / "stdout").read_bytes()

"""Run random cases and judge how each one ends.

A case is *accepted* unless it is refused for a reason that was tried and holds: taken away, the case is accepted.
It is *physically sensible* when it is accepted and its shaft always turns at 10 rpm at least: below, catalogues size a
bearing as one that stands still (SKF, Rolling bearings, 2018, "static load rating"; ISO 76). It *ends usable* when
there is a result with a finite friction torque that is not negative and an energy residual of 1e-3 at most, over a
whole turn of the cage or as much of it as the case's own limit of wall time allowed. A sensible one that was stopped
too early for that is continued once, for longer.
"""

from __future__ import annotations

import json
import math
import shlex
from pathlib import Path
from typing import Any

import h5py

from lambda_core import api
from lambda_core.domain.errors import LambdaError
from tests.attacks import draw
from tests.attacks.trial import Outcome, attempt
from tests.attacks.written import toml

WALL = 4.0  # limit of wall time that each case sets itself [s]
OVER = 2.0  # by which it may be passed, measured from when the result file is there to the end of the process [s]
ENERGY = 1e-3  # |energy residual| that a usable result may have
LONGER = 45.0  # limit of wall time with which such a case is continued [s]
_START = 60.0  # for start, equilibrium and a busy machine, beyond which a trial hangs [s]
_SLOWEST = 10.0  # speed of a sensible case [rpm]
_TURN = 0.999  # of the cage; the last record may end within the last step
_LONGEST = 1000.0  # times as long may a run become that has not turned its cage, within the longer limit
_WANTED = ("energy_residual", "friction_torque_Nmm", "converged", "state", "reasons", "simulated_s")


def random_case(seed: int, number: int, folder: Path) -> tuple[Outcome, str, dict[str, Any]]:
    """Run a random case.

    At least one cage revolution, or as far as its own wall limit allows.
    """
    made = draw.case(seed * 1_000_003 + number)
    made.setdefault("solver", {})["max_wall"] = f"{WALL:g} s"
    (folder / "case.toml").write_text(toml(made), encoding="utf-8")
    arguments = ["run", "case.toml", "--out", "out.h5", "--json"]
    outcome = attempt(arguments, folder, WALL + _START, watched=folder / "out.h5")
    found, turns = _numbers(folder), _turns(folder / "out.h5")
    first = outcome
    outcome, end = _judge(first, made, found, turns)
    if end == "failed" and outcome.verdict == "short":  # balls that skid turn less than was planned
        outcome, _ = _gone_on_with(first, folder, "--duration", f"{_LONGEST * float(found['simulated_s']):g} s")
        turns = _turns(folder / "out.h5")
        found = _numbers(folder / "longer") or found
        outcome, end = _judge(outcome, made, found, turns)
    slow = _lowest_speed(made) < _SLOWEST
    usable = end in ("converged", "named", "at its limit") and _is_usable(found)
    if end == "at its limit" and not usable and not slow:
        outcome, usable = _gone_on_with(outcome, folder)
    more = {
        "end": end,
        "slow": slow,
        "usable": usable,
        "turns": round(turns, 3),
        "load": _busy(),
        **found,
    }
    return outcome, "lambda-bearing " + shlex.join(arguments), more


def _busy() -> float:
    """Return the load of the last minute.

    Processes that wanted the processors.
    """
    return round(float(Path("/proc/loadavg").read_text(encoding="ascii").split()[0]), 1)


def _lowest_speed(made: dict[str, Any]) -> float:
    """Return the lowest speed of the shaft [rpm]."""
    speed = made["operation"]["speed"]
    texts = [speed["start"], speed["end"]] if isinstance(speed, dict) else [speed]
    return min(float(text.removesuffix(" rpm")) for text in texts)


def _judge(outcome: Outcome, made: dict[str, Any], found: dict[str, Any], turns: float) -> tuple[Outcome, str]:
    """Return the outcome and the case's class.

    It is worse where a check fails.
    """
    if not outcome.good:
        return outcome, "failed"
    if outcome.verdict == "usage":  # a damaged result ends so, too
        return outcome.but("misuse", "a command without a mistake was refused"), "failed"
    if outcome.verdict == "refused":
        reason = "" if "not a known" in outcome.said else _reason_that_holds(made)  # that is no case, but a bad draw
        return (outcome, f"refused: {reason}") if reason else (outcome.but("unfounded", "no reason found"), "failed")
    if outcome.open_s > WALL + OVER:
        return outcome.but("late", f"{outcome.open_s:.1f} s with its file open, {WALL:g} s were allowed"), "failed"
    if outcome.verdict == "unsolved":
        return outcome, "without a solution"
    residual, torque = found.get("energy_residual"), found.get("friction_torque_Nmm")
    reasons = " ".join(found.get("reasons", ()))
    if residual is None or (abs(residual) > ENERGY and "energy residual" not in reasons):
        return outcome.but("leaking", f"energy residual {residual}, and nothing says so"), "failed"
    if torque is None or torque < 0.0 or not math.isfinite(torque):
        return outcome.but("absurd", f"friction torque {torque} N mm"), "failed"
    if outcome.verdict == "fine":
        return outcome, "converged"
    if not reasons:
        return outcome.but("silent", "not converged, and no reason"), "failed"
    if found.get("state") == "stopped":
        return outcome, "at its limit"
    if turns < _TURN:
        return outcome.but("short", f"ended after {turns:.3f} turns of the cage"), "failed"
    return outcome, "named"


def _is_usable(found: dict[str, Any]) -> bool:
    return abs(float(found["energy_residual"])) <= ENERGY


def _gone_on_with(outcome: Outcome, folder: Path, *longer_than: str) -> tuple[Outcome, bool]:
    """Resume or extend a run.

    It was stopped early.

    Returns the outcome, worse where that fails, and whether it is usable now.
    """
    place = folder / "longer"
    arguments = ["resume", str(folder / "out.h5"), "--max-wall", f"{LONGER:g} s", "--json", *longer_than]
    longer = attempt(arguments, place, LONGER + _START)
    if longer.verdict not in ("fine", "partial"):
        return (longer.but("lost", "could not be continued") if longer.good else longer), False
    return outcome, _is_usable(_numbers(place))


def _reason_that_holds(made: dict[str, Any]) -> str:
    """Verify the reason of a refusal.

    Without the reason the case must be accepted.
    """
    bearing = {key: value for key, value in made["bearing"].items() if key != "clearance"}
    for reason, without in (
        ("a law whose data the oil lacks", {"models": {}}),
        ("a clearance class that is not tabulated for this bore", {"bearing": bearing}),
        ("a cage for which the estimated balls leave no room", {"depth": {"cage": False}}),
    ):
        other = {**made, **without}
        try:
            api.check(other)
        except LambdaError:
            continue
        return reason
    return ""


def _numbers(folder: Path) -> dict[str, Any]:
    """Return the summary numbers for the verdict."""
    try:
        said = json.loads((folder / "stdout").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {name: said[name] for name in _WANTED if said.get(name) is not None}


def _turns(file: Path) -> float:
    """Return the cage turns in a result.

    0 without a file; of the balls where there is no cage.
    """
    try:
        with h5py.File(file, "r") as stream:
            angle = stream["integrals/cage_angle"][...]
    except (OSError, KeyError):
        return 0.0
    return abs(float(angle[-1])) / (2.0 * math.pi) if len(angle) else 0.0

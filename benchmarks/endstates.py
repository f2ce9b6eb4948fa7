"""``python -m benchmarks.endstates --against PYTHON``: do two versions end in the same bits?

Every built-in case is run by this version and by the one that the interpreter PYTHON belongs to, with the laws and
constants named that b7aec9b had by default, so that later defaults do not count as a difference. A channel that only
one of them knows is named and not compared. Bits depend on the processor, so both run on one machine.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
CASES = (
    "6208-axial-700",
    "6208-axial-1300",
    "6208-axial-2000",
    "6220-excited",
    "6319-cp10-500",
    "6319-cp10-1500",
    "6319-cp10-3000",
    "6319-cp6.5-500",
    "6319-cp6.5-1500",
    "6319-cp6.5-3000",
)
States = dict[str, dict[str, str]]


def constants(newer: bool) -> dict[str, Any]:
    """Return the laws and constants of b7aec9b as changes of a case; with `newer` also for options it did not have."""
    found = tomllib.loads((HERE / "endstates.toml").read_text(encoding="utf-8"))
    changes: dict[str, Any] = found["b7aec9b"]
    if newer:
        for section, values in found.get("newer", {}).items():
            changes[section] = changes.get(section, {}) | values
    return changes


def ask(python: str, cases: Sequence[str], duration: float, newer: bool) -> States:
    """Return channel -> hash of each case, as the version of that interpreter computes them.

    Raises
    ------
    RuntimeError
        With what the other version said when it failed.
    """
    question = {"cases": list(cases), "duration": duration, "overrides": constants(newer)}
    done = subprocess.run(
        [python, "-P", str(HERE / "endstate_worker.py")], input=json.dumps(question), capture_output=True, text=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{python} could not run the cases:\n{done.stderr}")
    answer: States = json.loads(done.stdout)
    return answer


def differences(one: States, other: States) -> dict[str, list[str]]:
    """Return the channels that both know and that differ, by case."""
    return {
        case: sorted(name for name in one[case].keys() & other[case].keys() if one[case][name] != other[case][name])
        for case in one
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, print a line per case; returns 1 when any bit differs."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.endstates", description=__doc__)
    parser.add_argument("cases", nargs="*", default=CASES, help="built-in cases, default all")
    parser.add_argument("--against", metavar="PYTHON", help="interpreter of the other version; default: print hashes")
    parser.add_argument("--recent", action="store_true", help="the other version is one after b7aec9b")
    parser.add_argument("--duration", type=float, default=0.05, help="simulated time of each case [s]")
    options = parser.parse_args(arguments)
    mine = ask(sys.executable, options.cases, options.duration, newer=True)
    if options.against is None:
        print(json.dumps(mine, indent=1))
        return 0
    theirs = ask(options.against, options.cases, options.duration, newer=options.recent)
    wrong = differences(mine, theirs)
    for case, channels in wrong.items():
        both = mine[case].keys() & theirs[case].keys()
        alone = sorted(mine[case].keys() ^ theirs[case].keys())
        verdict = f"DIFFERENT in {', '.join(channels)}" if channels else "same bits"
        note = f"   (not compared: {', '.join(alone)})" if alone else ""
        print(f"{case:18} {len(both)} channels: {verdict}{note}")
    return 1 if any(wrong.values()) else 0


if __name__ == "__main__":
    sys.exit(main())

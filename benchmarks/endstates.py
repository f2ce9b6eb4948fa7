"""Compare the results of two versions bit by bit.

``python -m benchmarks.endstates --against PYTHON``.

This version and the one that the interpreter PYTHON belongs to run the same cases. The built-in cases run with the laws
and constants that b7aec9b had by default, so that later defaults do not count as a difference. With ``--recent`` the
cases of endstate_cases.toml follow, with today's default laws: every kind of bearing, elastic parts, grease, a live
circuit, prescribed motion, resumed runs, shafts. Channels that only one version has are listed and not compared. Bits
depend on the processor, so both versions run on one machine.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from lambda_core.domain.errors import unknown_name

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
KINDS = ("bearings", "shafts")
States = dict[str, dict[str, str]]


def constants(newer: bool) -> dict[str, Any]:
    """Return laws and constants of b7aec9b.

    As changes of a case; with `newer` also for options it did not have.
    """
    found = tomllib.loads((HERE / "endstates.toml").read_text(encoding="utf-8"))
    changes: dict[str, Any] = found["b7aec9b"]
    if newer:
        for section, values in found.get("newer", {}).items():
            changes[section] = changes.get(section, {}) | values
    return changes


def recent_cases() -> dict[str, dict[str, Any]]:
    """Return the cases with today's default laws.

    Bearings and shafts, by kind and name.
    """
    found: dict[str, dict[str, Any]] = tomllib.loads((HERE / "endstate_cases.toml").read_text(encoding="utf-8"))
    return found


def ask(
    python: str,
    cases: Sequence[str],
    duration: float,
    newer: bool,
    recent: Mapping[str, Mapping[str, Any]] = MappingProxyType({}),
) -> States:
    """Return channel -> hash of each case.

    As the version of that interpreter computes them.

    Parameters
    ----------
    python : str
        Interpreter of the version.
    cases : sequence of str
        Built-in cases, run with the laws of b7aec9b.
    duration : float
        Simulated time of each built-in case [s].
    newer : bool
        Whether the version has the options that b7aec9b did not have.
    recent : mapping
        Entries of endstate_cases.toml: bearings and shafts by name.

    Raises
    ------
    RuntimeError
        With the error output of the other version when it failed.
    """
    question = {"cases": list(cases), "duration": duration, "overrides": constants(newer)}
    question |= {kind: recent.get(kind, {}) for kind in KINDS}
    done = subprocess.run(
        [python, "-P", str(HERE / "endstate_worker.py")], input=json.dumps(question), capture_output=True, text=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{python} could not run the cases:\n{done.stderr}")
    answer: States = json.loads(done.stdout)
    return answer


def differences(one: States, other: States) -> dict[str, list[str]]:
    """Return the differing channels by case.

    Both versions know them.
    """
    return {
        case: sorted(name for name in one[case].keys() & other[case].keys() if one[case][name] != other[case][name])
        for case in one
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare the channels of all cases.

    Print a line per case: return 1 when any bit differs.
    """
    parser = argparse.ArgumentParser(prog="python -m benchmarks.endstates", description=__doc__)
    parser.add_argument("cases", nargs="*", help="built-in cases or cases of endstate_cases.toml, default all")
    parser.add_argument("--against", metavar="PYTHON", help="interpreter of the other version; default: print hashes")
    parser.add_argument("--recent", action="store_true", help="the other version is one after b7aec9b")
    parser.add_argument("--duration", type=float, default=0.05, help="simulated time of each built-in case [s]")
    options = parser.parse_args(arguments)
    has_recent = options.recent or options.against is None
    recent = recent_cases() if has_recent else {}
    known = [*CASES, *(name for entries in recent.values() for name in entries)]
    for name in options.cases:
        if name not in known:
            parser.error(unknown_name("case", name, known))
    wanted = options.cases or known
    built_in = [name for name in CASES if name in wanted]
    chosen = {
        kind: {name: entry for name, entry in entries.items() if name in wanted} for kind, entries in recent.items()
    }
    mine = ask(sys.executable, built_in, options.duration, newer=True, recent=chosen)
    if options.against is None:
        print(json.dumps(mine, indent=1))
        return 0
    theirs = ask(options.against, built_in, options.duration, newer=options.recent, recent=chosen)
    return 1 if tell(mine, theirs) else 0


def tell(mine: States, theirs: States) -> list[str]:
    """Print a line for each case.

    Return those that differ or have no channel in common.
    """
    wrong = []
    for case, channels in differences(mine, theirs).items():
        both = mine[case].keys() & theirs[case].keys()
        alone = sorted(mine[case].keys() ^ theirs[case].keys())
        verdict = f"DIFFERENT in {', '.join(channels)}" if channels else "same bits"
        if not both:
            verdict = "NOT COMPARED: no channel in common"
        note = f"   (not compared: {', '.join(alone)})" if alone else ""
        print(f"{case:26} {len(both)} channels: {verdict}{note}", flush=True)
        wrong += [case] if channels or not both else []
    return wrong


if __name__ == "__main__":
    sys.exit(main())

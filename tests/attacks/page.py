"""Write the figures of a campaign to text and page."""

from __future__ import annotations

import platform
import re
import subprocess
from collections import Counter
from collections.abc import Callable, Mapping
from datetime import date
from pathlib import Path
from typing import Any

from tests.attacks import cases
from tests.attacks.parts import PARTS
from tests.attacks.record import Record
from tests.attacks.trial import GOOD, MEMORY

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reliability.md"
_BLOCK = re.compile(r"(<!-- figures -->\n).*?(<!-- end of figures -->)", re.S)
Entries = list[dict[str, Any]]


def figures(records: Mapping[str, Record]) -> str:
    """Return the table of trials.

    How they ended, which failed; and under it the further counts of each part.
    """
    lines = ["| attack | trials | failed | how they ended |", "|---|---|---|---|"]
    notes: list[str] = []
    for name, record in records.items():
        entries = list(record.entries())
        counts = Counter(str(entry["verdict"]) for entry in entries)
        failed = sum(count for verdict, count in counts.items() if verdict not in GOOD)
        ends = ", ".join(f"{verdict} {count}" for verdict, count in counts.most_common())
        lines.append(f"| {PARTS[name].about} | {len(entries)} | {failed} | {ends or 'not run'} |")
        if entries:
            notes += [f"- **{name}**: {text}" for text in (*_NOTES.get(name, _nothing)(entries), _cost(entries))]
    return "\n".join([*lines, "", *notes]).rstrip() + "\n"


def _nothing(entries: Entries) -> list[str]:
    return []


def _cost(entries: Entries) -> str:
    memory = max(int(entry["memory"]) for entry in entries) / 2**20
    longest = max(float(entry["wall_s"]) - float(entry.get("waited_s", 0.0)) for entry in entries)
    seeds = ", ".join(sorted({str(entry["seed"]) for entry in entries}))
    commits = ", ".join(f"{count} at {commit}" for commit, count in Counter(e["commit"] for e in entries).items())
    return (
        f"highest resident memory of a trial {memory:.0f} MiB (allowed {MEMORY / 2**20:.0f} MiB), "
        f"longest trial {longest:.1f} s; seed {seeds}; trials: {commits}"
    )


def _of_cases(entries: Entries) -> list[str]:
    ends = Counter(str(entry["end"]) for entry in entries)
    opened = [float(entry["open_s"]) for entry in entries if entry["open_s"]]
    residuals = [abs(float(entry["energy_residual"])) for entry in entries if "energy_residual" in entry]
    over = sum(residual > cases.ENERGY for residual in residuals)
    accepted = [entry for entry in entries if not entry["end"].startswith("refused")]
    sensible = [entry for entry in accepted if not entry["slow"]]
    slow = [entry for entry in accepted if entry["slow"]]
    return [
        "; ".join(f"{end} {count}" for end, count in ends.most_common()),
        f"each of at least one cage revolution or its own wall limit of {cases.WALL:g} s; the longest had its file "
        f"open for {max(opened, default=0.0):.1f} s ({cases.WALL + cases.OVER:g} s are allowed; time in which it "
        "waited for a processor that others had is not counted)",
        f"energy residual at most {cases.ENERGY:g} in {len(residuals) - over} of {len(residuals)} results, named among "
        f"the reasons in the other {over}",
        f"usable: {_share(sensible)} of those physically sensible, {_share(slow)} of those slower than 10 rpm",
        f"a sensible one that was stopped before it was usable was continued for {cases.LONGER:g} s",
    ]


def _share(entries: Entries) -> str:
    usable = sum(bool(entry["usable"]) for entry in entries)
    return f"{usable} of {len(entries)} ({100.0 * usable / max(len(entries), 1):.1f} %)"


def _of_hostile(entries: Entries) -> list[str]:
    behind = sum(bool(entry.get("behind")) for entry in entries)
    return [
        f"behind validation (accepted, and computed with): {behind} of {len(entries)} "
        f"({100.0 * behind / len(entries):.0f} %)"
    ]


def _of_kills(entries: Entries) -> list[str]:
    left = [float(entry["left"]) for entry in entries if entry.get("left")]
    if not left:
        return ["killed with work left: none"]
    shares = f"{100.0 * min(left):.0f} to {100.0 * max(left):.0f} % of the samples left"
    return [f"killed with work left: {len(left)} of {len(entries)}, {shares}"]


def _of_soak(entries: Entries) -> list[str]:
    growth = max(float(entry["growth_MiB_per_s"]) for entry in entries)
    return [f"memory grows by {growth:.3f} MiB per simulated second after the first quarter"]


_NOTES: dict[str, Callable[[Entries], list[str]]] = {
    "cases": _of_cases,
    "hostile": _of_hostile,
    "kills": _of_kills,
    "points": _of_kills,
    "kills_of_machines": _of_kills,
    "points_of_machines": _of_kills,
    "soak": _of_soak,
}


def write(text: str) -> None:
    """Put the figures into the page.

    With date, commit and machine.
    """
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout
    said = f"{date.today().isoformat()}, commit {commit.strip()}, Python {platform.python_version()}"
    page = PAGE.read_text(encoding="utf-8")
    block = f"{said}\n\n{text}"
    PAGE.write_text(_BLOCK.sub(lambda match: match[1] + block + match[2], page), encoding="utf-8")

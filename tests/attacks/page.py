"""Figures of a campaign, as text and as the block of docs/reliability.md that this command owns."""

from __future__ import annotations

import platform
import re
import subprocess
from collections.abc import Mapping
from datetime import date
from pathlib import Path

from tests.attacks.parts import PARTS
from tests.attacks.record import Record
from tests.attacks.trial import GOOD

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "reliability.md"
_BLOCK = re.compile(r"(<!-- figures -->\n).*?(<!-- end of figures -->)", re.S)


def figures(records: Mapping[str, Record]) -> str:
    """Return a table: trials, how they ended, which failed."""
    lines = ["| attack | trials | ended well | failed | how they ended |", "|---|---|---|---|---|"]
    for name, record in records.items():
        counts = record.counts()
        total = sum(counts.values())
        good = sum(count for verdict, count in counts.items() if verdict in GOOD)
        ends = ", ".join(f"{verdict} {count}" for verdict, count in counts.most_common())
        lines.append(f"| {PARTS[name].about} | {total} | {good} | {total - good} | {ends or 'not run'} |")
    notes = []
    for name, record in records.items():
        entries = list(record.entries())
        if name == "hostile" and entries:
            behind = sum(bool(entry.get("behind")) for entry in entries)
            notes.append(f"Behind validation: {behind} of {len(entries)} hostile inputs.")
        if name == "kills" and entries:
            met = sum(bool(entry.get("met")) for entry in entries)
            notes.append(f"Killed with the file open: {met} of {len(entries)} runs.")
    return "\n".join([*lines, "", *notes]).rstrip() + "\n"


def write(text: str, seed: int) -> None:
    """Put the figures into the page, with date, commit and machine."""
    commit = subprocess.run(["git", "rev-parse", "--short", "HEAD"], cwd=ROOT, capture_output=True, text=True).stdout
    said = f"{date.today().isoformat()}, commit {commit.strip()}, seed {seed}, Python {platform.python_version()}"
    page = PAGE.read_text(encoding="utf-8")
    block = f"{said}\n\n{text}"
    PAGE.write_text(_BLOCK.sub(lambda match: match[1] + block + match[2], page), encoding="utf-8")

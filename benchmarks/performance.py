"""Write a report as text, JSON and part of docs/performance.md."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from benchmarks.tables import Section, Table, Target, as_markdown, as_text, number, target_table

PAGE = Path(__file__).resolve().parent.parent / "docs" / "performance.md"
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"
VERSION = 1  # of the JSON


@dataclass
class Report:
    """Hold all measurements of one call."""

    machine: dict[str, str]
    clock: str
    quick: bool
    load: float  # load average of the machine at the beginning
    sections: list[Section] = field(default_factory=list)

    @property
    def targets(self) -> tuple[Target, ...]:
        """Return the targets of all sections."""
        return tuple(target for section in self.sections for target in section.targets)

    def data(self) -> dict[str, Any]:
        """Return the report for JSON.

        Numbers that do not exist are null.
        """
        plain = _finite({"interface": VERSION, **dataclasses.asdict(self)})
        assert isinstance(plain, dict)
        plain["targets"] = [{**_finite(dataclasses.asdict(t)), "verdict": t.verdict} for t in self.targets]
        return plain

    def circumstances(self) -> str:
        """Return clock, date, machine, versions and load in one sentence."""
        clock = {"wall": "Wall time", "cpu": "Processor time of the measuring thread, not wall time"}[self.clock]
        loads = [self.load, *(section.load for section in self.sections)]
        told = [load for load in loads if math.isfinite(load)]
        busy = f"load average {min(told):.1f} to {max(told):.1f}" if told else "load average unknown"
        words = [self.machine[key] for key in ("date", "processor", "system", "versions")]
        effort = ", quick" if self.quick else ""
        return f"{clock}, minima over repeats{effort}; {'; '.join(words)}; {busy} (the measurement itself is 1 of it)."


def section_text(section: Section) -> str:
    """Return one section for a terminal."""
    parts = [as_text(table) for table in section.tables]
    if section.missing:
        parts.append(f"{section.name}: not measured: {section.missing}")
    return "\n\n".join([*parts, f"({section.name}: {section.seconds:.0f} s, load average {number(section.load)})", ""])


def report_text(report: Report) -> str:
    """Return the targets and the circumstances of the measurement."""
    parts = [as_text(target_table(report.targets))] if report.targets else []
    return "\n\n".join([*parts, report.circumstances()])


def markdown(report: Report) -> str:
    """Return the measured part of the page."""
    parts = [report.circumstances()]
    if report.targets:
        parts.append(as_markdown(_renamed(target_table(report.targets), "Targets and results"), 2))
    parts.append("## Measurements")
    for section in report.sections:
        parts += [as_markdown(table) for table in section.tables]
        if section.missing:
            parts.append(f"*{section.name}* was not measured: {section.missing}")
    return "\n\n".join(parts)


def write(report: Report, page: Path = PAGE) -> None:
    """Put the measurements into the page.

    Between its two marks: the text around them stays.

    Raises
    ------
    ValueError
        When the page lacks a mark.
    """
    text = page.read_text(encoding="utf-8")
    if BEGIN not in text or END not in text:
        raise ValueError(f"{page} has no {BEGIN} and {END}")
    before, _, rest = text.partition(BEGIN)
    after = rest.partition(END)[2]
    page.write_text(f"{before}{BEGIN}\n\n{markdown(report)}\n\n{END}{after}", encoding="utf-8")


def _renamed(table: Table, title: str) -> Table:
    return dataclasses.replace(table, title=title)


def _finite(value: Any) -> Any:
    """Return plain data for JSON.

    None replaces numbers that JSON does not know.
    """
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value

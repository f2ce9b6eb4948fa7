"""Repeat experiments, write figures and pages, and report the findings."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal, get_args

from pydantic import Field

from lambda_core.discovery.api import Registry
from lambda_core.domain.errors import UsageError, unknown_name
from lambda_core.results.record import Record
from lambda_core.studies.pool import usable_cores
from lambda_core.studies.scheduler import Report
from lambda_syla2026 import anchor_pages, charts, text
from lambda_syla2026.anchors import Anchors, anchors
from lambda_syla2026.fig5 import Fig5, fig5
from lambda_syla2026.fig7 import Fig7, fig7
from lambda_syla2026.job_runner import JobResult, JobRunner
from lambda_syla2026.page import Chapter, write
from lambda_syla2026.table4 import Table4, table4

What = Literal["table4", "anchors", "fig5", "fig7", "all"]
MOST_WORKERS = 4
_NAMED = 10  # points without a result that a note names


class Effort(Record):
    """Cost of an experiment."""

    experiment: str
    jobs: int = Field(description="runs and quasi-static solutions that were asked for, each counted once")
    computed: int = Field(description="of these by this call; the others stood in the folder already")
    processor_s: float = Field(description="processor time of all of them, whenever they were computed")
    wall_s: float = Field(description="of this call")


class Reproduction(Record):
    """Everything that was repeated; null what was not asked for."""

    table4: Table4 | None = None
    anchors: Anchors | None = None
    fig5: Fig5 | None = None
    fig7: Fig7 | None = None
    files: list[str] = Field(description="figures and the page")
    unconverged: dict[str, list[str]] = Field(
        description="by experiment: runs whose torque or energy balance has not converged, with reasons"
    )
    failed: dict[str, list[str]] = Field(description="by experiment: points without a result, with reasons")
    effort: list[Effort] = Field(description="processor and wall time by experiment")
    workers: int

    def text(self) -> str:
        """Return bars, tables and notes for people."""
        parts = [text.plain(c.title, c.bars, c.tables, c.notes) for c in chapters(self)]
        return "\n\n".join([*parts, *(f"written: {name}" for name in self.files), self.spent()])

    def spent(self) -> str:
        """Return what it took, in words."""
        single = [
            f"{e.experiment} {e.processor_s:.0f} s ({e.computed} of {e.jobs} jobs computed now)" for e in self.effort
        ]
        processor, wall = (sum(getattr(e, name) for e in self.effort) for name in ("processor_s", "wall_s"))
        return (
            f"processor time {processor:.0f} s: {', '.join(single)}; "
            f"wall time of this call {wall:.0f} s with {self.workers} workers"
        )


def reproduce(
    registry: Registry,
    what: str,
    folder: Path,
    *,
    workers: int | None = None,
    quick: bool = False,
    progress: Report | None = None,
    announce: Callable[[str], None] | None = None,
) -> Reproduction:
    """Repeat one experiment or all.

    Results of an earlier call in the same folder are used again.

    Raises
    ------
    UsageError
        For an unknown experiment, or a folder that cannot be written.
    """
    if what not in get_args(What):
        raise UsageError(unknown_name("experiment", what, get_args(What)))
    say = announce or (lambda sentence: None)
    found: dict[str, Table4 | Anchors | Fig5 | Fig7] = {}
    unconverged: dict[str, list[str]] = {}
    failed: dict[str, list[str]] = {}
    effort: list[Effort] = []
    workers = workers or min(usable_cores(), MOST_WORKERS)
    with JobRunner(folder, workers, progress) as runner:
        for name, run in (("table4", table4), ("anchors", anchors), ("fig7", fig7), ("fig5", fig5)):
            if what in (name, "all"):
                say(f"repeating {name}")
                before, lost = len(runner.failures), len(runner.lost)
                known, started = set(runner.answers), time.monotonic()
                found[name] = run(runner, quick=quick)
                new = [answer for job, answer in runner.answers.items() if job not in known]
                effort.append(_effort(name, new, time.monotonic() - started))
                unconverged[name], failed[name] = runner.failures[before:], runner.lost[lost:]
        result = Reproduction.model_validate(
            {**found, "files": [], "unconverged": unconverged, "failed": failed, "effort": effort, "workers": workers}
        )
    files = [str(path) for path in write(registry, chapters(result), folder)]
    return result.model_copy(update={"files": files})


def _effort(name: str, answers: Sequence[JobResult], wall: float) -> Effort:
    return Effort(
        experiment=name,
        jobs=len(answers),
        computed=sum(answer.fresh for answer in answers),
        processor_s=sum(answer.processor_s for answer in answers),
        wall_s=wall,
    )


def chapters(found: Reproduction) -> list[Chapter]:
    """Return texts, figures and tables of each experiment.

    Points without a result are marked.
    """
    return [
        replace(each, bars=tuple(text.marked(bar) for bar in each.bars), tables=text.marked_tables(each.tables))
        for each in _chapters(found)
    ]


def _chapters(found: Reproduction) -> list[Chapter]:
    result = []
    if found.table4 is not None:
        t = found.table4
        pictures = (charts.table4_chart(t), charts.sensitivity_chart(t))
        tables = (*text.table4_tables(t), text.blind_table())
        notes = _notes(found, "table4", (f"90 % band: {t.band}", *t.notes))
        result.append(Chapter("table4", "Table 4: friction torque of the 6319", tuple(t.bars), pictures, tables, notes))
    if found.anchors is not None:
        result.append(anchor_pages.chapter(found.anchors, _notes(found, "anchors", found.anchors.notes)))
    if found.fig5 is not None:
        f = found.fig5
        title = "Fig. 5: altered running of the 6220"
        tables = text.fig5_tables(f)
        result.append(
            Chapter("fig5", title, tuple(f.bars), (charts.fig5_chart(f),), tables, _notes(found, "fig5", f.notes))
        )
    if found.fig7 is not None:
        c = found.fig7
        title = "Fig. 7: capacitance of the 6208"
        result.append(
            Chapter(
                "fig7",
                title,
                tuple(c.bars),
                (charts.fig7_chart(c),),
                text.fig7_tables(c),
                _notes(found, "fig7", c.notes),
            )
        )
    return result


def _notes(found: Reproduction, name: str, notes: Sequence[str]) -> tuple[str, ...]:
    """Return the notes of an experiment.

    They name its points without a result and count the runs that have not converged.
    """
    lost = found.failed.get(name, [])
    wrong = [sentence for sentence in found.unconverged.get(name, []) if sentence not in lost]
    more = [f"{len(lost)} points have no result, marked {text.LOST}: {'; '.join(lost[:_NAMED])}"] if lost else []
    more += [f"{len(wrong)} runs have not converged, as {wrong[0]}"] if wrong else []
    return (*notes, *more)

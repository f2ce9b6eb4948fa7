"""Start, resume and inspect studies in folders."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, ConfigDict, Field

from lambda_core.domain.errors import LambdaError, UsageError
from lambda_core.laws.pack import NATIVE, code, other_code
from lambda_core.results.model_band import FIELDS, MachineBand, ModelBand
from lambda_core.studies.definition import Study, read_study, validate_study
from lambda_core.studies.design import Plan
from lambda_core.studies.job import RUNS, Outcome, Task, lost, point_model, work
from lambda_core.studies.optimise import Best, best_row, search
from lambda_core.studies.pool import HERE, pool, usable_cores
from lambda_core.studies.responses import asks_currents
from lambda_core.studies.scheduler import Director, Report
from lambda_core.studies.store import BANDS, Manifest, readable
from lambda_core.studies.study_check import Announce, Ready, check, duration
from lambda_core.views.table import StudyTable

if TYPE_CHECKING:
    from lambda_core.case.case import Case
    from lambda_core.case.machine import MachineCase

Where = str | Executor
_BAND = "model_band"  # name in the manifest
_BANDED = "banded"  # entry of a study whose points get model bands
_ALONE = 6.0  # estimated work that other processes do not make shorter [s]


class StudyStatus(BaseModel):
    """State of a study."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    version: int = 1
    name: str
    title: str
    folder: str
    mode: str
    design: str
    points: int
    done: int = Field(description="with a result")
    partial: int = Field(description="runs that have not converged; they have a result too")
    failed: int
    pending: int
    worker_seconds: float = Field(description="time that workers spent on points")
    wall_s: float = Field(description="wall time of the sessions of the study")
    parallel_efficiency: float | None = Field(description="worker time over wall time times workers, last session")
    reasons: list[str] = Field(description="why points failed, are partial or were left, the first few")
    best: dict[str, Any] | None = Field(description="the best point of an optimisation")
    message: str = Field(description="how an optimisation ended")
    interrupted: bool = Field(default=False, description="somebody stopped this session; otherwise pending points wait")
    model_band: ModelBand | MachineBand | None = Field(
        description="90 % model band of the case that the study varies; null without one", default=None
    )

    def text(self) -> str:
        """Return the lines for people."""
        states = [f"{self.done} done"]
        states += [f"{n} {name}" for name, n in (("partial", self.partial), ("failed", self.failed)) if n]
        states += [f"{self.pending} to do"] if self.pending else []
        lines = [f"{self.title or self.name}: {self.points} points, {', '.join(states)}   {self.mode}, {self.design}"]
        wall = duration(self.wall_s) if self.wall_s else "unknown"  # the director was killed
        spent = f"{wall} ({duration(self.worker_seconds)} of workers)"
        if self.parallel_efficiency is not None:
            spent += f", parallel efficiency {100.0 * self.parallel_efficiency:.0f} %"
        lines.append(f"time       {spent}")
        if self.best is not None:
            lines.append("best       " + ", ".join(f"{name} {_short(value)}" for name, value in self.best.items()))
        if self.message:
            lines.append(f"search     {self.message}")
        if self.model_band is not None:
            shares = self.model_band.shares()
            lines += [f"{'' if i else 'model band':<10} {text}" for i, text in enumerate(shares)]
        lines += [f"{'reasons' if i == 0 else '':<10} {reason}" for i, reason in enumerate(self.reasons)]
        hint = (
            f"lambda-bearing study resume {self.folder}" if self.pending else f"lambda-bearing study show {self.folder}"
        )
        return "\n".join([*lines, f"next       {hint}"])


def _short(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def prepare(
    source: str | Path | Mapping[str, Any] | Study,
    workers: int | None,
    announce: Announce = None,
    case: Case | MachineCase | None = None,
) -> Ready:
    """Read and check a study.

    Errors as in :func:`lambda_core.studies.study_check.check`, `case` as there.
    """
    folder: Path | None = None
    if isinstance(source, Study):
        study = source
    elif isinstance(source, Mapping):
        study = validate_study(source)
    else:
        study, folder = read_study(source)
    ready = check(study, folder, workers or usable_cores(), announce, case)
    return ready if workers or not _is_short(ready) else replace(ready, estimate=ready.estimate.alone())


def _is_short(ready: Ready) -> bool:
    """Tell whether further processes would not help.

    They need time to start.
    """
    return ready.study.optimise is None and ready.estimate.points * ready.estimate.seconds_per_point < _ALONE


def start(
    ready: Ready,
    folder: Path | None = None,
    *,
    where: Where = "processes",
    workers: int | None = None,
    report: Report | None = None,
    band: bool = False,
) -> StudyStatus:
    """Start a study and finish it.

    The study takes a new folder, by default one with its name.

    A study of a few seconds is done by this process alone, where nobody says how many are to work.
    """
    import tomlkit

    if where == "processes" and workers is None and _is_short(ready):
        where = HERE
    target = folder or Path(ready.study.name)
    text = tomlkit.dumps(ready.study.model_dump(mode="json", exclude_unset=True))
    manifest = Manifest.create(
        target, ready.study, text, ready.case_toml, ready.study.title or ready.study.name, ready.headings
    )
    with closing(manifest):
        manifest.write_meta("code", code())
        manifest.write_meta("fingerprint", _fingerprint(ready.plan, ready.case_toml, ready.names))
        if band:
            manifest.write_meta(_BANDED, "yes")
        manifest.add(list(ready.plan.points()))
        return _work(manifest, ready.plan, ready.names, where, workers, report, retry=False)


def _band_of(case_toml: str) -> ModelBand | MachineBand | None:
    """Return the model band of a study's case.

    None where it cannot be computed alone.
    """
    from lambda_core.analysis.band.model_band import model_band
    from lambda_core.case.case_io import toml_tables

    try:
        return model_band(toml_tables(case_toml, "the case of the study"))
    except LambdaError:  # the case is not whole before a point completes it
        return None


def resume(
    folder: Path,
    *,
    where: Where = "processes",
    workers: int | None = None,
    retry: bool = False,
    report: Report | None = None,
) -> StudyStatus:
    """Go on with a study.

    With `retry` it does failed points again.

    Raises
    ------
    UsageError
        When there is no such study, another process works on it, or catalogue, laws or code have changed since it
        was started, so that its points would not belong together.
    """
    with closing(Manifest(folder, write=True)) as manifest:
        with readable(folder):
            manifest.verify()
        study = manifest.study
        plan = Plan(study)
        if manifest.counts().total < plan.fixed_count:  # killed while it was being set up
            manifest.add([plan.point(number) for number in range(manifest.counts().total, plan.fixed_count)])
        names = tuple(h.name for h in manifest.headings() if h.kind == "response")
        if why := other_code(manifest.meta("code") or NATIVE):
            raise UsageError(f"{folder} cannot go on: {why}")
        now, then = _fingerprint(plan, manifest.case_toml, names), manifest.meta("fingerprint")
        if then and now != then:
            raise UsageError(
                f"{folder} cannot go on: the catalogue, a law or the program has changed since it was started, its "
                "points would not belong together; start it again: lambda-bearing study run "
                f"{folder / 'study.toml'} --out {folder}-2"
            )
        return _work(manifest, plan, names, where, workers, report, retry=retry)


def status(folder: Path) -> StudyStatus:
    """Return the state of a study, even while it works."""
    with closing(Manifest(folder)) as manifest, readable(folder):
        return _status(manifest)


def table(folder: Path) -> StudyTable:
    """Return the known table of a study."""
    with closing(Manifest(folder)) as manifest, readable(folder):
        return manifest.table()


def files(folder: Path) -> tuple[str, str]:
    """Return a study's file and case.

    Complete, as they were when the study was started.
    """
    import tomlkit

    with closing(Manifest(folder)) as manifest, readable(folder):
        return tomlkit.dumps(manifest.study.model_dump(mode="json", exclude_unset=True)), manifest.case_toml


def is_study(path: Path) -> bool:
    """Tell whether a path is the folder of a study."""
    from lambda_core.studies.store import FILE

    return (path / FILE).is_file()


def _fingerprint(plan: Plan, case_toml: str, names: tuple[str, ...]) -> str:
    """Return the hash of a study.

    It covers the first point with all its laws, and the compiled code of the responses.
    """
    from lambda_core.analysis.electric.current_numbers import code_folder
    from lambda_core.laws.kernels import sources_key
    from lambda_core.model.resolve import model_hash
    from lambda_core.solver.code_files import compiled_sources

    model = point_model(case_toml, plan.point(0).changes)
    sources = (*compiled_sources(), code_folder()) if asks_currents(names) else compiled_sources()
    return f"{model_hash(model)} {sources_key(*sources)}"


def _work(
    manifest: Manifest,
    plan: Plan,
    names: tuple[str, ...],
    where: Where,
    workers: int | None,
    report: Report | None,
    *,
    retry: bool,
) -> StudyStatus:
    """Work until every point has an outcome."""
    from lambda_core.results.hdf5 import sweep

    stop = False
    with manifest.directed():
        sweep(manifest.folder / RUNS)  # a worker that was killed while it packed a finished run
        is_banded, todo = bool(manifest.meta(_BANDED)), manifest.pending(retry)
        if is_banded and not manifest.meta(_BAND) and (band := _band_of(manifest.case_toml)) is not None:
            manifest.write_meta(_BAND, band.model_dump_json())
        study = manifest.study
        begun = time.monotonic()
        before = manifest.seconds()
        if todo or study.optimise is not None:
            count = min(workers or usable_cores(), max(len(todo), 1))
            workers_pool = pool(where, count)
            stop = True
            try:
                director = Director[Task, Outcome](manifest, workers_pool, work, lost, report)
                done = director.run(_tasks(manifest, todo, names))
                if done and study.optimise is not None and not manifest.counts().pending:
                    _optimise(manifest, plan, names, director)
                stop = not done
            finally:
                workers_pool.close(stop=stop)
                if not stop and is_banded:
                    _write_bands(manifest)
                wall = time.monotonic() - begun
                manifest.write_meta("wall", repr(float(manifest.meta("wall") or 0.0) + wall))
                spent = manifest.seconds() - before
                manifest.write_meta("efficiency", repr(spent / (wall * workers_pool.workers)) if wall > 0.0 else "")
        elif is_banded and not manifest.meta(BANDS):
            _write_bands(manifest)  # it was killed after its last point
    return _status(manifest).model_copy(update={"interrupted": stop})


def _write_bands(manifest: Manifest) -> None:
    """Compute the model bands of the points that have results."""
    from lambda_core.analysis.band.neighbours import places_of
    from lambda_core.analysis.band.over_points import bands_over
    from lambda_core.analysis.thermal.temperatures import ready

    points, names = manifest.done(), {h.name for h in manifest.headings() if h.kind == "response"}
    if not points or not names.intersection(_banded(manifest.case_toml)):
        return
    places = places_of(list(zip(*(coordinates for _, _, coordinates in points), strict=True)))
    shares = bands_over(lambda row: ready(point_model(manifest.case_toml, points[row][1])), places)
    rows = {number: row for row, (number, _, _) in enumerate(points)}
    none = [1.0, 1.0]  # of a point without a result
    found = {
        name: [share[rows[n]].tolist() if n in rows else none for n in range(manifest.counts().total)]
        for name, share in shares.items()
        if name in names
    }
    manifest.write_meta(BANDS, json.dumps(found))


def _banded(case_toml: str) -> set[str]:
    """Return the names of the results that have model bands."""
    from lambda_core.case.case_io import toml_tables

    bearings = toml_tables(case_toml, "the case of the study").get("bearings", {})
    return {*FIELDS.values(), *(f"{name}.{field}" for name in bearings for field in FIELDS.values())}


def _tasks(manifest: Manifest, todo: list[tuple[int, tuple[str, ...]]], names: tuple[str, ...]) -> Iterator[Task]:
    from lambda_core.discovery.api import guests

    study, case_toml, folder, plugins = manifest.study, manifest.case_toml, str(manifest.folder.resolve()), guests()
    return (Task(number, case_toml, changes, study.mode, names, folder, plugins) for number, changes in todo)


def _optimise(manifest: Manifest, plan: Plan, names: tuple[str, ...], director: Director[Task, Outcome]) -> None:
    """Search from the first points.

    Every new point joins the study.
    """
    goal = manifest.study.optimise
    assert goal is not None

    def evaluate(shares: Any) -> dict[str, float | None]:
        point = plan.at(shares)
        known = manifest.find(point)
        number = manifest.add([point]) if known is None else int(known["number"])
        if known is not None and known["state"] != "pending":
            responses: dict[str, float | None] = known["responses"]
            return responses
        return dict(director.one(next(_tasks(manifest, [(number, point.changes)], names))).values)

    rows = manifest.table().rows()[: plan.fixed_count]
    count, message = search(goal, plan.shares, rows, evaluate)
    manifest.write_meta("search", f"{message} ({count} evaluations after {plan.fixed_count} first points)")


def _status(manifest: Manifest) -> StudyStatus:
    study, counts = manifest.study, manifest.counts()
    efficiency = manifest.meta("efficiency")
    best: dict[str, Any] | None = None
    message = manifest.meta("search")
    if study.optimise is not None and counts.done + counts.partial:
        best, message = _best(manifest, message)
    return StudyStatus(
        name=study.name,
        title=manifest.meta("title"),
        folder=str(manifest.folder),
        mode=study.mode,
        design=study.design.kind,
        points=counts.total,
        done=counts.done,
        partial=counts.partial,
        failed=counts.failed,
        pending=counts.pending,
        worker_seconds=manifest.seconds(),
        wall_s=float(manifest.meta("wall") or 0.0),
        parallel_efficiency=float(efficiency) if efficiency else None,
        reasons=[f"point {number}: {reason}" for number, reason in manifest.failures(5)],
        best=best,
        message=message,
        model_band=_band_from(manifest.meta(_BAND)),
    )


def _band_from(text: str) -> ModelBand | MachineBand | None:
    if not text:
        return None
    return (MachineBand if '"bearings"' in text else ModelBand).model_validate_json(text)


def _best(manifest: Manifest, message: str) -> tuple[dict[str, Any] | None, str]:
    found = manifest.table()
    goal = manifest.study.optimise
    assert goal is not None
    best: Best = best_row(goal, found, message)
    if best.row is None:
        return None, best.message
    row = found.rows()[best.row]
    wanted = [*(c.name for c in found.parameters), goal.response, *(c.response for c in goal.constraints)]
    return {"point": best.row + 1, **{name: row[name] for name in dict.fromkeys(wanted)}}, best.message

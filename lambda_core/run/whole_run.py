"""A run of a shaft in its bearings: one integration, a result for the whole and one for every bearing."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING
from uuid import uuid4

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import SolverError, UsageError
from lambda_core.domain.files import check_folder, held
from lambda_core.laws.pack import NATIVE, other_code
from lambda_core.results.averages import COLUMNS, Interval, boundaries, finite, row
from lambda_core.results.checkpoint import Checkpoint, Position
from lambda_core.results.convergence import Window, are_converged, revolutions_wanted, torque_together, window
from lambda_core.results.provenance import Provenance
from lambda_core.results.run_status import Rows, State, Status, this_process
from lambda_core.results.writer import ResultWriter
from lambda_core.run.law_blame import BlamingMachineEngine, naming_laws
from lambda_core.run.progress import Progress, Report, StopRequest, stop_request
from lambda_core.run.record_times import RECORDS_PER_REVOLUTION, next_multiple
from lambda_core.run.whole_provenance import bearing_alone, channels_of_bearings, code_of, kernel_keys
from lambda_core.shaft.machine_motion import MachineEngine, machine_start
from lambda_core.shaft.whole_file import WHOLE, WholeFile, WholeWriter, earlier_files
from lambda_core.solver.drivers.engine import SAMPLES_PER_REVOLUTION

if TYPE_CHECKING:
    from lambda_core.system.machine import Machine

_FLUSH_AFTER, _REPORT_AFTER, _SAVE_AFTER = 1.0, 0.1, 10.0  # wall time [s]


@dataclasses.dataclass(frozen=True)
class Ends:
    """When a run ends: SI, 0 and inf for not at all."""

    duration: float = 0.0  # simulated; 0: once every bearing's averages are known [s]
    max_wall: float = math.inf  # of this start [s]


def launch_whole(
    model: Machine, out: Path | None, ends: Ends, *, force: bool, report: Report | None,
    announce: Callable[[str], None] | None,
) -> WholeFile:  # fmt: skip
    """Run a shaft from its quasi-static equilibrium into a new folder."""
    folder = _folder(model, out, force)
    engine = _started(model, announce)
    if announce is not None:
        announce(
            f"{len(engine.bearings)} bearings, {engine.start.shaft.positions.size} lumps of the shaft, "
            f"{engine.states} states"
        )
    folder.mkdir(exist_ok=True)
    with held(folder):
        return _launch(engine, folder, ends, report, force=force)


def _started(model: Machine, announce: Callable[[str], None] | None) -> BlamingMachineEngine:
    with naming_laws(*(bearing.model for bearing in model.bearings)):
        return BlamingMachineEngine(machine_start(model, announce), announce)


def _launch(engine: MachineEngine, folder: Path, ends: Ends, report: Report | None, *, force: bool) -> WholeFile:
    """Begin the results of a run in its folder, and drive it."""
    model = engine.machine
    for old in earlier_files(folder, model.names["bearings"]) if force else ():
        old.unlink()
    channels, writers, status, run = channels_of_bearings(engine), [], Status(process=this_process()), uuid4().hex
    for i, own in enumerate(channels):
        name = engine.bearings[i].name
        provenance = Provenance(bearing_alone(engine, i), kernel_keys(engine, i), part_of=(run, name))
        writers.append(ResultWriter.create(folder / f"{name}.h5", provenance, own, status))
    texts = {"case": model.name, "case_toml": model.case_toml, "code": code_of(engine), "run": run}
    texts["warnings"] = "\n".join(model.warnings)
    whole = WholeWriter.create(
        folder / WHOLE,
        {**texts, "speed": model.speed, "drive_torque": engine.start.drive_torque},  # type: ignore[dict-item]
        {
            "lump_positions": engine.start.shaft.positions,
            "bearing_positions": [bearing.position for bearing in model.bearings],
        },
        model.names,
    )
    session = _Session(engine, whole, writers, ends, report)
    session.begin()
    return session.drive()


def resume_whole(
    path: Path, model: Machine, ends: Ends, *, report: Report | None, announce: Callable[[str], None] | None
) -> WholeFile:
    """Go on with a run from its last checkpoint, bit for bit as if it had not been interrupted."""
    found = WholeFile(path)
    with held(found.folder):
        return _resume(found, model, ends, report, announce)


def _resume(
    found: WholeFile, model: Machine, ends: Ends, report: Report | None, announce: Callable[[str], None] | None
) -> WholeFile:
    """Go on in a folder that is held."""
    status = found.status()
    if status.alive():
        raise UsageError(f"{found.path} is still being written by process {status.process['pid']}")
    checkpoint = found.checkpoint()
    if checkpoint is None:
        raise UsageError(f"{found.path} holds no checkpoint: start the run anew")
    before = {result.kernel_keys.get("code", NATIVE) for result in found.results().values()}
    if why := next(filter(None, map(other_code, sorted(before))), ""):
        raise UsageError(f"{found.path} cannot go on: {why}")
    engine = _started(model, announce)
    if code_of(engine) != found.code:
        raise UsageError(f"{found.path} cannot go on: the code or the case has changed since")
    engine.restore({k: v for k, v in checkpoint.state.items() if k != "rows"})
    position, revolutions = checkpoint.position, checkpoint.state["rows"].astype(int)
    if status.state == "finished" and not engine.time < ends.duration:
        raise UsageError(f"{found.folder} is finished: nothing is left to do; a longer --duration continues it")
    running, writers, known = Status(process=this_process(), wall=position.wall), [], []
    last: list[FloatArray] = []
    turned = False
    results = found.results()
    for bearing, own, count in zip(engine.bearings, channels_of_bearings(engine), revolutions, strict=True):
        result = results[bearing.name]
        known.append(list(result.revolutions()[:count]))
        records = result.integrals()[: position.rows.records]
        last.append(records[-1])
        turned |= len(records) > 1 and known[-1][-1][0] > records[-2][0]
        rows = Rows(position.rows.samples, position.rows.records, int(count))
        writers.append(ResultWriter.continued(result.path, own, dataclasses.replace(running, rows=rows)))
    whole = WholeWriter.continued(found.path, position.rows.samples)
    session = _Session(engine, whole, writers, ends, report)
    session.go_on(known, last, position, turned=turned)
    return session.drive()


def _folder(model: Machine, out: Path | None, force: bool) -> Path:
    """Return the folder of the run; UsageError where that cannot be."""
    folder, number = out or Path(f"{model.name}-run"), 1
    while out is None and folder.exists():
        number += 1
        folder = Path(f"{model.name}-run-{number}")
    if folder.is_file():
        raise UsageError(f"{folder} is a file: a run of a shaft goes into a folder")
    if folder.exists() and not force and any(folder.iterdir()):
        raise UsageError(f"{folder} exists: choose another folder with --out, or overwrite it with --force")
    earlier_files(folder, model.names["bearings"])  # a refusal comes before the equilibrium that takes a while
    check_folder(folder.absolute().parent, folder)
    return folder


class _Session:
    """One stretch of a run, from a start or a checkpoint to an end."""

    def __init__(
        self, engine: MachineEngine, whole: WholeWriter, writers: list[ResultWriter], ends: Ends, report: Report | None
    ) -> None:
        self._engine, self._whole, self._writers, self._ends, self._report = engine, whole, writers, ends, report
        self._solvers = [
            dataclasses.replace(p.model.solver, duration=ends.duration or 0.0) for p in engine.machine.bearings
        ]
        self._end = ends.duration or max(solver.max_duration for solver in self._solvers)
        self._interval = engine.sample_interval * SAMPLES_PER_REVOLUTION / RECORDS_PER_REVOLUTION
        self._known: list[list[FloatArray]] = []
        self._last: list[FloatArray] = []
        self._windows: list[Window] = []
        self._converged = False
        self._off_grid: list[int] | None = None  # revolutions of a record that a longer run would not have
        self._sequence, self._wall, self._records = 0, 0.0, 0
        self._before: dict[str, float] = {}
        self._from, self._loads = engine.time, ()
        self._started = self._flushed = self._reported = self._saved = time.perf_counter()

    def begin(self) -> None:
        """Keep the start."""
        now = [row(self._engine.time, found) for found in self._engine.integrals()]
        self._known, self._last = [[record] for record in now], now
        for writer, record in zip(self._writers, now, strict=True):
            writer.add_record(record, [record])
        self._records = 1
        self._judge()
        self._save()

    def go_on(self, known: list[list[FloatArray]], last: list[FloatArray], position: Position, *, turned: bool) -> None:
        """Stand where a checkpoint stood; `turned`: a cage completed a revolution since the record before the last."""
        self._known, self._last = known, last
        self._sequence, self._wall, self._records = position.sequence, position.wall, position.rows.records
        self._before = dict(position.statistics)
        self._judge()
        self._converged &= turned  # looked at where a revolution ends, nowhere else

    def drive(self) -> WholeFile:
        """Advance until the end, a limit or a request to stop."""
        state: State = "failed"
        try:
            with stop_request() as stop:
                state, message = self._loop(stop)
                self._finish(state, message)
        except BaseException as error:
            if not self._whole.closed:
                self._finish("interrupted" if isinstance(error, KeyboardInterrupt) else "failed",
                             str(error) or type(error).__name__, save=False)  # fmt: skip
            raise
        if state == "failed":
            raise SolverError(
                f"{message}; the result up to t = {self._engine.time:.6g} s is kept in {self._whole.path.parent}"
            )
        return WholeFile(self._whole.path)

    def _loop(self, stop: StopRequest) -> tuple[State, str]:
        def pause() -> bool:
            self._housekeeping()
            return bool(stop) or self._late()

        if self._done() and self._engine.time > self._last[0][0]:
            self._keep(math.inf)  # killed between its last checkpoint, which has no end off the grid, and its last word
        while not self._done():
            if stop:
                return "interrupted", f"stopped by {stop.words()} at t = {self._engine.time:.6g} s"
            before = self._engine.time
            target = next_multiple(before, self._interval)
            advance = self._engine.advance(min(target, self._end), pause)
            if not advance.ok:
                return "failed", advance.message
            if self._engine.time <= before and not pause():
                return "failed", f"the solver does not get past t = {before:.9g} s"
            self._keep(target)
            self._housekeeping()
            if self._late() and not self._done():
                return "stopped", f"the limit of wall time was reached at t = {self._engine.time:.6g} s"
        return "finished", ""

    def _late(self) -> bool:
        return time.perf_counter() - self._started >= self._ends.max_wall

    def _done(self) -> bool:
        return self._engine.time >= self._end or (self._ends.duration == 0.0 and self._converged)

    def _keep(self, target: float) -> None:
        """Keep a record of every bearing."""
        now = [row(self._engine.time, found) for found in self._engine.integrals()]
        self._collect()
        turned = []
        for writer, record, last, known in zip(self._writers, now, self._last, self._known, strict=True):
            crossed = boundaries(last, record, len(known) - 1)
            writer.add_record(record, crossed)
            known.extend(crossed)
            turned.append(len(crossed))
        self._last, self._records = now, self._records + 1
        self._off_grid = turned if self._engine.time < target else None
        if any(turned):
            self._judge()

    def _judge(self) -> None:
        """Look whether every bearing has converged."""
        each = list(zip(self._solvers, self._known, self._last, strict=True))
        self._windows = [window(solver, np.stack(known), last) for solver, known, last in each]
        self._converged = are_converged(self._solvers, self._windows, self._known, self._last)

    def _collect(self) -> None:
        found = self._engine.samples()
        if not found.whole["time"].size:
            return
        self._whole.add(found.whole)
        for writer, samples in zip(self._writers, found.each, strict=True):
            writer.add_samples(samples)
        heaviest = max(found.each, key=lambda samples: float(samples["load"][-1].max()))
        self._loads = tuple(heaviest["load"][-1, :, RINGS.index("inner")].tolist())

    def _housekeeping(self) -> None:
        now = time.perf_counter()
        if self._report is not None and now - self._reported >= _REPORT_AFTER:
            self._reported = now
            self._report(self._progress())
        if now - self._saved >= _SAVE_AFTER:
            self._save()
        elif now - self._flushed >= _FLUSH_AFTER:
            self._flush("running", "")

    def _status(self, state: State, message: str) -> Status:
        counters = {name: self._before.get(name, 0.0) + count for name, count in self._engine.statistics().items()}
        if self._before:  # the integrator's own counters go on from the checkpoint
            counters = self._engine.statistics()
        wall = self._wall + time.perf_counter() - self._started
        # Of six bearings they take two seconds: who stops a run is not made to wait.
        modes = tuple(self._engine.modes()) if state == "finished" else ()
        return Status(state, message, wall=wall, statistics=counters, modes=modes, process=this_process())

    def _flush(self, state: State, message: str) -> None:
        self._collect()
        status = self._status(state, message)
        for writer in self._writers:
            writer.flush(status)
        self._whole.flush(status, Rows(0, self._records, 0))
        self._flushed = time.perf_counter()

    def _save(self) -> None:
        """Flush, then write a checkpoint of what was flushed."""
        self._flush("running", "")
        status, off = self._status("running", ""), self._off_grid
        revolutions = [len(known) - (off[i] if off else 0) for i, known in enumerate(self._known)]
        rows = Rows(self._whole.rows, self._records - (1 if off else 0), 0)
        self._sequence += 1
        position = Position(self._sequence, rows, status.wall, status.statistics)
        self._whole.save(Checkpoint(position, {**self._engine.state(), "rows": np.array(revolutions, dtype=float)}))
        self._saved = time.perf_counter()

    def _finish(self, state: State, message: str, *, save: bool = True) -> None:
        if save and state != "failed":
            self._save()
        self._flush(state, message)
        for writer in self._writers:
            writer.close(compress=True)
        self._whole.close()
        if self._report is not None and save:
            self._report(self._progress())

    def _progress(self) -> Progress:
        now = self._engine.time
        turns = [abs(last[COLUMNS.index("cage_angle")]) / (2.0 * math.pi) for last in self._last]
        pairs, together = zip(self._solvers, self._windows, strict=True), torque_together(self._windows)
        wanted = [revolutions_wanted(solver, w, together) for solver, w in pairs]
        slowest = max(range(len(turns)), key=lambda i: wanted[i] / max(turns[i], 1e-9))
        end = self._end
        if not self._ends.duration and turns[slowest] > 0.2:
            end = max(min(now * wanted[slowest] / turns[slowest], end), now)
        spent, advanced = time.perf_counter() - self._started, now - self._from
        torques = [w.interval.torque() for w in self._windows]
        widths = [w.torque.half_width for w in self._windows]
        left = (end - now) * spent / advanced if advanced > 0.0 else math.nan
        return Progress(
            time_s=now,
            percent=min(100.0 * now / end, 100.0) if end > 0.0 else 0.0,
            cage_revolutions=turns[slowest],
            cage_revolutions_wanted=float(wanted[slowest])
            if not self._ends.duration
            else end / max(now, 1e-12) * turns[slowest],
            averaged=min(w.revolutions for w in self._windows),
            friction_torque_Nmm=finite(1e3 * sum(torques)),
            friction_torque_ci_Nmm=finite(1e3 * math.hypot(*widths)),
            friction_torque_now_Nmm=None,
            cage_speed_ratio=None,
            energy_residual=finite(Interval(self._known[0][0], self._last[0]).energy_residual()),
            inner_loads_N=self._loads,
            wall_s=self._wall + spent,
            left_s=finite(max(left, 0.0)),
        )

"""Runs: an engine is advanced, its samples and integrals are written, and the run knows when it is done.

The running integrals are recorded 40 times per nominal cage revolution, at the ends of the
first steps past a fixed grid of times. Neither records nor samples depend on when the
file is flushed, so a resumed run writes what an uninterrupted one would have written.
"""

from __future__ import annotations

import glob
import math
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import PartialResultError, SolverError, UsageError
from lambda_core.domain.kinematics import epicyclic_ratio
from lambda_core.results import hdf5
from lambda_core.results.averages import COLUMNS, Interval, boundaries, finite, row
from lambda_core.results.checkpoint import Checkpoint, Position
from lambda_core.results.convergence import Window, is_converged, revolutions_wanted, window
from lambda_core.results.file_format import never, soon
from lambda_core.results.opening import ResultError
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.results.run_status import Rows, State, Status, this_process
from lambda_core.results.writer import ResultWriter
from lambda_core.run.progress import Progress, Report, StopRequest, stop_request
from lambda_core.run.record_times import RECORDS_PER_REVOLUTION, next_multiple, record_interval
from lambda_core.solver.drivers.engine import Advance, Engine
from lambda_core.system.bearing import BearingModel, Solver

if TYPE_CHECKING:
    from lambda_core.electric.live import Live

_FLUSH_AFTER = 1.0  # wall time [s]
_REPORT_AFTER = 0.1  # wall time [s]


def run(
    engine: Engine,
    provenance: Provenance,
    path: Path,
    *,
    force: bool = False,
    report: Report | None = None,
    live: Live | None = None,
) -> Result:
    """Simulate from the start until the end, into a new result file.

    Parameters
    ----------
    engine : Engine
        At t = 0.
    provenance : Provenance
        The model and the keys of the code that `engine` runs.
    path : pathlib.Path
        Where the result goes; must not exist unless `force` is set.
    report : callable, optional
        Called with a :class:`Progress` some ten times a second.
    live : Live, optional
        The electric circuit beside the motion.

    Returns
    -------
    Result
        Also when the run was stopped early (its ``status`` says so).

    Raises
    ------
    SolverError
        When the engine cannot go on; the file keeps what there is.
    PartialResultError
        When the disk takes no more; the file keeps what there is.
    """
    writer = ResultWriter.create(path, provenance, engine.channels, Status(process=this_process()), force=force)
    return _begin(engine, provenance, writer, report, live)


def _begin(
    engine: Engine, provenance: Provenance, writer: ResultWriter, report: Report | None, live: Live | None
) -> Result:
    start = row(engine.time, engine.integrals())
    writer.add_record(start, [start])
    return _Session(engine, provenance.model, writer, [start], start, Position(0, Rows(), 0.0), report, live).drive()


def resume(
    engine: Engine, provenance: Provenance, path: Path, *, report: Report | None = None, live: Live | None = None
) -> Result:
    """Continue a run that was killed, stopped or finished, from its last checkpoint.

    Parameters and errors as for :func:`run`; `engine` is new and its model's `solver` says
    when to end.

    Raises
    ------
    ResultError
        When the run is still going on.
    UsageError
        When it has nothing left to do.
    """
    result = Result(path)
    status = result.status()
    if status.alive():
        raise ResultError(f"{path} is still being written by process {status.process['pid']}")
    hdf5.sweep(path.absolute().parent, glob.escape(path.name))
    checkpoint = result.checkpoint()
    if checkpoint is None:  # killed before the first one: the beginning is as good
        return _begin(
            engine,
            provenance,
            ResultWriter.continued(path, engine.channels, Status(process=this_process())),
            report,
            live,
        )
    position = checkpoint.position
    engine.restore(checkpoint.state)
    records = result.integrals()[: position.rows.records]
    start, known = records[-1], list(result.revolutions()[: position.rows.revolutions])
    if status.state == "finished" and not _left_to_do(provenance.model.solver, engine.time, known, start):
        raise UsageError(f"{path} is finished: nothing is left to do; a longer --duration continues it")
    status = replace(status, state="running", message="", rows=position.rows, process=this_process())
    if live is not None:
        live.catch_up(result, position.rows)
    writer = ResultWriter.continued(path, engine.channels, status)
    session = _Session(engine, provenance.model, writer, known, start, position, report, live)
    # Convergence is looked at where a revolution ends: a run that was killed right behind that has nothing left to do.
    if len(records) > 1 and known[-1][0] > records[-2][0]:
        session.judge()
    return session.drive()


def _left_to_do(solver: Solver, now: float, known: list[FloatArray], last: FloatArray) -> bool:
    if solver.duration > 0.0:
        return now < solver.duration
    return now < solver.max_duration and not is_converged(solver, known, last)


class _Session:
    """One stretch of a run, from a start or a checkpoint to an end."""

    def __init__(
        self,
        engine: Engine,
        model: BearingModel,
        writer: ResultWriter,
        known: list[FloatArray],
        last: FloatArray,
        position: Position,
        report: Report | None,
        live: Live | None,
    ) -> None:
        self._live = live
        self._engine = engine
        self._solver = model.solver
        self._writer = writer
        self._known = known  # rows at whole cage revolutions, the first is t = 0
        self._last = last
        self._before = position  # what earlier sessions spent
        self._counters = engine.statistics()
        self._sequence = position.sequence
        self._report = report
        self._interval = record_interval(engine, model)
        self._checkpoint_after = model.output.checkpoint_interval
        self._end = model.solver.duration or model.solver.max_duration
        self._window: Window = window(self._solver, np.stack(known), last)
        self._converged = False
        self._off_grid = Rows()  # records and revolutions at the tail that a longer run would not have
        self._recent = Interval(last, last)
        self._loads: tuple[float, ...] = ()
        self._geometry = model.geometry
        self._epicyclic = math.nan
        self._from = engine.time
        self._started = time.perf_counter()
        self._flushed = self._saved = self._reported = self._started

    def drive(self) -> Result:
        """Advance until the end, a limit or a request to stop; return the result."""
        try:
            self._save()
            with stop_request() as stop:
                state, message = self._loop(stop)
                asked = bool(stop)
                self._finish(state, message, save=state != "failed", stop=lambda: not asked and bool(stop))
        except PartialResultError:
            raise
        except BaseException as error:
            if not self._writer.closed:
                state = "interrupted" if isinstance(error, KeyboardInterrupt) else "failed"
                self._finish(state, str(error) or type(error).__name__, save=False)  # maybe in the middle of a step
            raise
        if state == "failed":
            raise SolverError(
                f"{message}; the result up to t = {self._engine.time:.6g} s is kept in {self._writer.path}"
            )
        return Result(self._writer.path)

    def judge(self) -> None:
        """Look whether the run has converged."""
        self._converged = is_converged(self._solver, self._known, self._last)

    def _loop(self, stop: StopRequest) -> tuple[State, str]:
        def pause() -> bool:  # a checkpoint between two records is as good as one behind them
            self._housekeeping()
            return bool(stop) or self._late()

        if self._done() and self._engine.time > self._last[0]:
            self._keep(math.inf)  # killed between its last checkpoint, which has no end off the grid, and its last word
        while not self._done():
            if stop:
                return "interrupted", f"stopped by {stop.words()} at t = {self._engine.time:.6g} s"
            advance = self._advance(pause)
            if not advance.ok:
                return "failed", advance.message
            self._housekeeping()
            # Looked at behind a step: however short the limit, every start gets on.
            if self._late() and not self._done():
                return "stopped", f"the limit of wall time was reached at t = {self._engine.time:.6g} s"
        return "finished", ""

    def _late(self) -> bool:
        return time.perf_counter() - self._started >= self._solver.max_wall

    def _advance(self, pause: Callable[[], bool]) -> Advance:
        """Take the engine past the next record, or to where it has to pause, and keep what it brings."""
        engine = self._engine
        before = engine.time
        target = next_multiple(before, self._interval)
        advance = engine.advance(min(target, self._end), pause)
        if advance.ok and engine.time <= before:
            if pause():  # asked to before its first step was through: that is no failure
                return advance
            advance = Advance(False, f"the engine does not get past t = {before:.9g} s")
        self._keep(target)
        return advance

    def _keep(self, target: float) -> None:
        """Keep a record of now; `target` is the time of the grid that it stands for [s]."""
        record = row(self._engine.time, self._engine.integrals())
        crossed = boundaries(self._last, record, len(self._known) - 1)
        self._writer.add_record(record, crossed)
        self._recent, self._last = Interval(self._last, record), record
        self._known.extend(crossed)
        if crossed or not self._window.revolutions:
            self._window = window(self._solver, np.stack(self._known), record)
            self._converged = bool(crossed) and is_converged(self._solver, self._known, record)
        # An end between two records is none of the grid's: a longer run would not have stopped here.
        self._off_grid = Rows(0, 1, len(crossed)) if self._engine.time < target else Rows()

    def _done(self) -> bool:
        if self._engine.time >= self._end:
            return True
        return self._solver.duration == 0.0 and self._converged

    def _housekeeping(self) -> None:
        """Report, flush and save when it is time to; none of it touches the simulation."""
        now = time.perf_counter()
        if self._report is not None and now - self._reported >= _REPORT_AFTER:
            self._reported = now
            self._collect()
            self._report(self._progress())
        if now - self._saved >= self._checkpoint_after:
            self._save()
        elif now - self._flushed >= _FLUSH_AFTER:
            self._flush("running", "")

    def _save(self) -> None:
        """Flush, then write a checkpoint of what was flushed."""
        self._flush("running", "")
        status = self._status("running", "")
        written, tail = self._writer.written(), self._off_grid
        rows = replace(
            written, records=written.records - tail.records, revolutions=written.revolutions - tail.revolutions
        )
        self._sequence += 1
        position = Position(self._sequence, rows, status.wall, status.statistics)
        self._writer.save(Checkpoint(position, self._engine.state()))
        self._saved = time.perf_counter()

    def _collect(self) -> None:
        """Take the samples that the engine has gathered; each call of it costs, so not after every record."""
        samples = self._engine.samples()
        if len(samples["time"]):
            self._loads = tuple(samples["load"][-1, :, RINGS.index("inner")].tolist())
            self._epicyclic = self._without_slip(samples["load"], samples["contact_angle"])
        self._writer.add_samples(samples)
        if self._live is not None:
            self._writer.add_circuit(self._live.take(samples))

    def _without_slip(self, load: FloatArray, angle: FloatArray) -> float:
        """Return cage speed over inner ring speed without slip; contact angles are weighted by load."""
        carried = float(load.sum())
        mean = float((load * np.cos(angle)).sum()) / carried if carried > 0.0 else math.nan
        return epicyclic_ratio(self._geometry.ball_diameter, self._geometry.pitch_diameter, mean)

    def _flush(self, state: State, message: str) -> None:
        self._collect()
        self._writer.flush(self._status(state, message))
        self._flushed = time.perf_counter()

    def _finish(self, state: State, message: str, *, save: bool = True, stop: Callable[[], bool] = never) -> None:
        if save:
            self._save()
        self._flush(state, message)
        self._writer.close(compress=True, stop=stop if state == "finished" else soon())
        if self._report is not None and save:
            self._report(self._progress())

    def _status(self, state: State, message: str) -> Status:
        """Return the state of the run; the writer fills in the rows."""
        spent = self._before.statistics
        counters = {
            name: spent.get(name, 0.0) + count - self._counters.get(name, 0.0)
            for name, count in self._engine.statistics().items()
        }
        wall = self._before.wall + time.perf_counter() - self._started
        return Status(state, message, wall=wall, statistics=counters, process=this_process())

    def _progress(self) -> Progress:
        turns = abs(self._last[COLUMNS.index("cage_angle")]) / (2.0 * math.pi)
        wanted, end = self._expected(turns)
        status = self._status("running", "")
        now = self._engine.time
        session = time.perf_counter() - self._started
        advanced = now - self._from
        left = (end - now) * session / advanced if advanced > 0.0 else math.nan
        return Progress(
            time_s=now,
            percent=min(100.0 * now / end, 100.0),
            cage_revolutions=turns,
            cage_revolutions_wanted=wanted,
            averaged=self._window.revolutions,
            friction_torque_Nmm=finite(1e3 * self._window.interval.torque()),
            friction_torque_ci_Nmm=finite(1e3 * self._window.torque.half_width),
            friction_torque_now_Nmm=finite(1e3 * self._recent.torque()),
            cage_speed_ratio=finite(self._recent.ratio("cage_angle", "inner_angle")),
            epicyclic_ratio=finite(self._epicyclic),
            energy_residual=finite(Interval(self._known[0], self._last).energy_residual()),
            inner_loads_N=self._loads,
            wall_s=status.wall,
            left_s=finite(max(left, 0.0)),
            bearing_voltage_V=self._live.voltage if self._live is not None else None,
            films_broken_per_s=self._live.rate if self._live is not None else None,
        )

    def _expected(self, turns: float) -> tuple[float, float]:
        """Return the cage revolutions and the simulated time [s] that the run will take in all, by what is known."""
        now = self._engine.time
        per_turn = now / turns if turns > 0.2 else self._interval * RECORDS_PER_REVOLUTION
        if self._solver.duration > 0.0:
            return self._end / per_turn, self._end
        wanted = revolutions_wanted(self._solver, self._window)
        return float(wanted), max(min(wanted * per_turn, self._end), now)

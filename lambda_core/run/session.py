"""One stretch of a run, from a start or a checkpoint to an end: the engine is advanced, what it brings is written."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import PartialResultError, SolverError
from lambda_core.results.averages import COLUMNS, Interval, boundaries, finite, row
from lambda_core.results.checkpoint import Checkpoint, Position
from lambda_core.results.convergence import Window, is_converged, revolutions_wanted, window
from lambda_core.results.file_format import never, soon
from lambda_core.results.reader import Result
from lambda_core.results.rolling import rolling_of
from lambda_core.results.run_status import Rows, State, Status, this_process
from lambda_core.results.writer import ResultWriter
from lambda_core.run.progress import Progress, Report, StopRequest, stop_request
from lambda_core.run.record_times import RECORDS_PER_REVOLUTION, next_multiple, record_interval
from lambda_core.run.watch import Watch
from lambda_core.solver.drivers.engine import Advance, Engine
from lambda_core.system.bearing import BearingModel

if TYPE_CHECKING:
    from lambda_core.electric.live import Live

_FLUSH_AFTER = 1.0  # wall time [s]
_REPORT_AFTER = 0.1  # wall time [s]


@dataclass(frozen=True)
class Beside:
    """What a run computes from its samples in addition to the motion."""

    live: Live | None  # the electric circuit
    watch: Watch

    def catch_up(self, result: Result, rows: Rows) -> None:
        """Stand where the run stood when it was left."""
        if self.live is not None:
            self.live.catch_up(result, rows)
        self.watch.catch_up(result, rows)


class Session:
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
        beside: Beside,
    ) -> None:
        self._live, self._watch = beside.live, beside.watch
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
            if self._watch.prompt:
                self._collect()
            if self._watch.ended_by:
                return "finished", self._watch.ended_by
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
        position = Position(self._sequence, rows, status.wall, status.statistics, written, self._writer.sums())
        self._writer.save(Checkpoint(position, self._engine.state()))
        self._saved = time.perf_counter()

    def _collect(self) -> None:
        """Take the samples that the engine has gathered; each call of it costs, so not after every record."""
        samples = self._engine.samples()
        if len(samples["time"]):
            self._loads = tuple(samples["load"][-1, :, RINGS.index("inner")].tolist())
            self._epicyclic = rolling_of(samples, self._geometry.ball_diameter)
            if self._watch.any:
                seen = self._watch.take(samples)
                samples = {**samples, **seen.channels}
                self._writer.add_events(seen.events)
        self._writer.add_samples(samples)
        if self._live is not None:
            self._writer.add_circuit(self._live.take(samples))

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
        return Status(
            state,
            message,
            wall=wall,
            statistics=counters,
            process=this_process(),
            faults=self._watch.faults,
            modes=tuple(self._engine.modes()) if state != "running" else (),
        )

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

"""Advance a run from its start or checkpoint."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.channels import RINGS
from lambda_core.domain.errors import PartialResultError, SolverError
from lambda_core.model.bearing_model import BearingModel
from lambda_core.results.averages import COLUMNS, Interval, boundaries, finite, row
from lambda_core.results.checkpoint import Checkpoint, Position
from lambda_core.results.convergence import (
    Window,
    are_converged,
    half_width_together,
    revolutions_wanted,
    torque_together,
    window,
)
from lambda_core.results.file_format import never, soon
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.results.rolling import rolling_of
from lambda_core.results.run_status import Rows, State, Status, this_process
from lambda_core.results.samples import RunChannels, Samples
from lambda_core.results.writer import ResultWriter
from lambda_core.runs.observers import Watch
from lambda_core.runs.progress import Progress, Report, StopRequest, stop_request
from lambda_core.runs.record_times import RECORDS_PER_REVOLUTION, next_multiple, record_interval
from lambda_core.runs.run_engine import RunEngine
from lambda_core.solver.drivers.engine import Advance

if TYPE_CHECKING:
    from lambda_core.analysis.electric.live import Live

_FLUSH_AFTER = 1.0  # wall time [s]
_REPORT_AFTER = 0.1  # wall time [s]


@dataclass(frozen=True)
class Attachments:
    """Computations from a run's samples.

    They are in addition to the motion.
    """

    live: Live | None  # the electric circuit
    watches: Mapping[str, Watch]  # observers and events by bearing

    @classmethod
    def of(cls, provenance: Provenance, live: Live | None) -> Attachments:
        """Return a circuit, observers and events.

        The latter two belong to every bearing.
        """
        return cls(live, {name: Watch(origin.model) for name, origin in provenance.bearings.items()})

    def channels(self, engine: RunEngine) -> RunChannels:
        """Return what the engine and the observers write."""
        each = {name: (*own, *self.watches[name].channels) for name, own in engine.channels.bearings.items()}
        return RunChannels(engine.channels.machine, each)

    def catch_up(self, result: Result, rows: Rows) -> None:
        """Stand where the run stood when it was left."""
        if self.live is not None:
            self.live.catch_up(result, rows)
        for name, watch in self.watches.items():
            watch.catch_up(result.of_bearing(name), rows)

    @property
    def is_prompt(self) -> bool:
        """True if samples are needed at once.

        An event may end the run.
        """
        return any(watch.prompt for watch in self.watches.values())

    @property
    def ended_by(self) -> str:
        """Sentence about the event that stopped the run.

        It is None before an event has stopped the run.
        """
        return next((watch.ended_by for watch in self.watches.values() if watch.ended_by), "")

    @property
    def faults(self) -> tuple[str, ...]:
        """Reasons for stopped observers and events.

        Each reason is one sentence.
        """
        return tuple(dict.fromkeys(fault for watch in self.watches.values() for fault in watch.faults))


Known = Mapping[str, list[FloatArray]]  # by bearing: rows at whole cage revolutions, the first is t = 0
Last = Mapping[str, FloatArray]  # by bearing: the newest row


class Session:
    """One stretch of a run.

    It lasts from a start or a checkpoint to an end.
    """

    def __init__(
        self,
        engine: RunEngine,
        models: Mapping[str, BearingModel],
        writer: ResultWriter,
        known: Known,
        last: Last,
        position: Position,
        report: Report | None,
        attached: Attachments,
        began: float | None = None,
    ) -> None:
        self._live, self._attached = attached.live, attached
        self._engine = engine
        self._models = models
        self._solvers = [model.solver for model in models.values()]
        self._solver = self._solvers[0]
        self._writer = writer
        self._known = known
        self._last = last
        self._before = position  # what earlier sessions spent
        self._counters = engine.statistics()
        self._sequence = position.sequence
        self._report = report
        self._interval = record_interval(engine, list(models.values()))
        self._checkpoint_after = min(model.output.checkpoint_interval for model in models.values())
        self._end = self._solver.duration or max(solver.max_duration for solver in self._solvers)
        self._windows = self._now_averaged()
        self._converged = False
        self._off_grid = Rows()  # records and revolutions at the tail that a longer run would not have
        self._recent = {name: Interval(row, row) for name, row in last.items()}
        self._loads: tuple[float, ...] = ()
        self._epicyclic = math.nan
        self._from = engine.time
        self._started = time.perf_counter()
        self._late_at = (self._started if began is None else began) + self._solver.max_wall
        self._flushed = self._saved = self._reported = self._started

    def drive(self) -> Result:
        """Advance until the end or a stop.

        A limit or a request may stop it; return the result.
        """
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
        each = list(self._known)
        rows, now = [self._known[name] for name in each], [self._last[name] for name in each]
        self._converged = are_converged(self._solvers, self._windows, rows, now)

    def _now_averaged(self) -> list[Window]:
        """Return the present averaging revolutions by bearing."""
        each = zip(self._solvers, self._known.values(), self._last.values(), strict=True)
        return [window(solver, np.stack(known), last) for solver, known, last in each]

    @property
    def _recorded(self) -> float:
        """Time of the newest record [s]."""
        return float(next(iter(self._last.values()))[0])

    def _loop(self, stop: StopRequest) -> tuple[State, str]:
        def pause() -> bool:  # a checkpoint between two records is as good as one behind them
            self._housekeeping()
            return bool(stop) or self._late()

        if self._done() and self._engine.time > self._recorded:
            self._keep(math.inf)  # killed between its last checkpoint, which has no end off the grid, and its last word
        while not self._done():
            if stop:
                return "interrupted", f"stopped by {stop.words()} at t = {self._engine.time:.6g} s"
            advance = self._advance(pause)
            if not advance.ok:
                return "failed", advance.message
            if ended_by := self._attached.ended_by:
                return "finished", ended_by
            self._housekeeping()
            # Looked at behind a step: however short the limit, every start gets on.
            if self._late() and not self._done():
                return "stopped", f"the limit of wall time was reached at t = {self._engine.time:.6g} s"
        return "finished", ""

    def _late(self) -> bool:
        return time.perf_counter() >= self._late_at

    def _advance(self, pause: Callable[[], bool]) -> Advance:
        """Take the engine past the next record.

        It stops earlier where it has to pause, and keeps what the engine brings.
        """
        engine = self._engine
        before = engine.time
        target = next_multiple(before, self._interval)
        advance = self._advance_to(min(target, self._end), pause)
        if advance.ok and engine.time <= before:
            if pause():  # asked to before its first step was through: that is no failure
                return advance
            advance = Advance(False, f"the engine does not get past t = {before:.9g} s")
        self._keep(target)
        return advance

    def _advance_to(self, until: float, pause: Callable[[], bool]) -> Advance:
        """Advance the engine to a time.

        Where an event may end the run, it goes from sample to sample, to stop behind the right one.
        """
        engine = self._engine
        if not self._attached.is_prompt:
            return engine.advance(until, pause)
        paused = False

        def noted() -> bool:
            nonlocal paused
            paused = pause()
            return paused

        while True:
            before = engine.time
            advance = engine.advance(min(until, next_multiple(before, engine.sample_interval)), noted)
            self._collect()
            if not advance.ok or paused or self._attached.ended_by or not before < engine.time < until:
                return advance

    def _keep(self, target: float) -> None:
        """Keep a record of now.

        `target` is the time of the grid that it belongs to [s].
        """
        now = records_of(self._engine)
        crossed = {
            name: boundaries(self._last[name], record, len(self._known[name]) - 1) for name, record in now.items()
        }
        self._writer.add_record(now, crossed)
        self._recent = {name: Interval(self._last[name], record) for name, record in now.items()}
        self._last = now
        for name, rows in crossed.items():
            self._known[name].extend(rows)
        turned = any(crossed.values())
        if turned or not all(chosen.revolutions for chosen in self._windows):
            self._windows = self._now_averaged()
            self._converged = False
            if turned:
                self.judge()
        # An end between two records is none of the grid's: a longer run would not have stopped here.
        tail = {name: len(rows) for name, rows in crossed.items()}
        self._off_grid = Rows(records=1, revolutions=tail) if self._engine.time < target else Rows()

    def _done(self) -> bool:
        if self._engine.time >= self._end:
            return True
        return self._solver.duration == 0.0 and self._converged

    def _housekeeping(self) -> None:
        """Report, flush and save in due time.

        None of it changes the simulation.
        """
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
        turns = {name: count - tail.revolutions.get(name, 0) for name, count in written.revolutions.items()}
        rows = replace(written, records=written.records - tail.records, revolutions=turns)
        self._sequence += 1
        position = Position(self._sequence, rows, status.wall, status.statistics, written, self._writer.sums())
        self._writer.save(Checkpoint(position, self._engine.state()))
        self._saved = time.perf_counter()

    def _collect(self) -> None:
        """Take the samples of the engine.

        A call costs time, so it is not made after every record.
        """
        samples = self._engine.samples()
        if len(samples.time):
            self._look(samples)
            each = dict(samples.bearings)
            for name, watch in self._attached.watches.items():
                if watch.any:
                    seen = watch.take(each[name])
                    each[name] = {**each[name], **seen.channels}
                    self._writer.add_events(name, seen.events)
            samples = replace(samples, bearings=each)
        self._writer.add_samples(samples)
        if self._live is not None and len(samples.time):
            self._writer.add_circuit(self._live.take(samples.bearings))

    def _look(self, samples: Samples) -> None:
        """Keep the newest samples for the progress.

        They are those of the bearing with the largest contact load.
        """
        name = max(samples.bearings, key=lambda name: float(samples.bearings[name]["load"][-1].max()))
        shown = samples.bearings[name]
        self._loads = tuple(shown["load"][-1, :, RINGS.index("inner")].tolist())
        model = self._models[name]
        self._epicyclic = rolling_of(shown, vars(model.geometry), are_rollers=model.rollers is not None)

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
        """Return the state of the run.

        The writer adds the rows.
        """
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
            faults=self._attached.faults,
            modes=tuple(self._engine.modes()) if self._asks_for_modes(state) else (),
        )

    def _asks_for_modes(self, state: State) -> bool:
        """Tell whether the modes are due.

        With six bearings they take two seconds, in which a user would wait for a stop.
        """
        return state == "finished" if len(self._models) > 1 else state != "running"

    def _progress(self) -> Progress:
        turns = [abs(last[COLUMNS.index("cage_angle")]) / (2.0 * math.pi) for last in self._last.values()]
        together = torque_together(self._windows) if len(self._windows) > 1 else 0.0
        pairs = zip(self._solvers, self._windows, strict=True)
        each = [float(revolutions_wanted(solver, chosen, together)) for solver, chosen in pairs]
        slowest = max(range(len(turns)), key=lambda i: each[i] / max(turns[i], 1e-9))
        wanted, end = self._expected(turns[slowest], each[slowest])
        name = list(self._models)[slowest]
        status = self._status("running", "")
        now = self._engine.time
        session = time.perf_counter() - self._started
        advanced = now - self._from
        left = (end - now) * session / advanced if advanced > 0.0 else math.nan
        one = Interval(self._known[name][0], self._last[name])  # energy is balanced for the machine
        return Progress(
            time_s=now,
            percent=min(100.0 * now / end, 100.0),
            cage_revolutions=turns[slowest],
            cage_revolutions_wanted=wanted,
            averaged=min(chosen.revolutions for chosen in self._windows),
            friction_torque_Nmm=finite(1e3 * sum(chosen.interval.torque() for chosen in self._windows)),
            friction_torque_ci_Nmm=finite(1e3 * half_width_together(self._windows)),
            friction_torque_now_Nmm=finite(1e3 * sum(interval.torque() for interval in self._recent.values())),
            cage_speed_ratio=finite(self._recent[name].ratio("cage_angle", "inner_angle")),
            epicyclic_ratio=finite(self._epicyclic),
            energy_residual=finite(one.energy_residual()),
            inner_loads_N=self._loads,
            wall_s=status.wall,
            left_s=finite(max(left, 0.0)),
            bearing_voltage_V=self._live.voltage if self._live is not None else None,
            films_broken_per_s=self._live.rate if self._live is not None else None,
        )

    def _expected(self, turns: float, wanted: float) -> tuple[float, float]:
        """Return expected cage revolutions and time [s].

        They are those of the complete run, by what is known.
        """
        now = self._engine.time
        per_turn = now / turns if turns > 0.2 else self._interval * RECORDS_PER_REVOLUTION
        if self._solver.duration > 0.0:
            return self._end / per_turn, self._end
        return wanted, max(min(wanted * per_turn, self._end), now)


def records_of(engine: RunEngine) -> dict[str, FloatArray]:
    """Return the running integrals of every bearing now, as rows."""
    return {name: row(engine.time, found) for name, found in engine.integrals().items()}

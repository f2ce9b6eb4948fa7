"""Runs: an engine is advanced, its samples and integrals are written, and the run knows when it is done.

The running integrals are recorded 40 times per nominal cage revolution, at the ends of the
first steps past a fixed grid of times. Neither records nor samples depend on when the
file is flushed, so a resumed run writes what an uninterrupted one would have written.
"""

from __future__ import annotations

import glob
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from lambda_core.domain.arrays import FloatArray
from lambda_core.domain.errors import UsageError
from lambda_core.results import hdf5
from lambda_core.results.averages import row
from lambda_core.results.checkpoint import Position
from lambda_core.results.convergence import is_converged
from lambda_core.results.opening import BeingWrittenError
from lambda_core.results.provenance import Provenance
from lambda_core.results.reader import Result
from lambda_core.results.row_sums import check_rows
from lambda_core.results.run_status import Rows, Status, this_process
from lambda_core.results.writer import ResultWriter
from lambda_core.run.progress import Report
from lambda_core.run.session import Beside, Session
from lambda_core.run.watch import Watch
from lambda_core.solver.drivers.engine import Engine
from lambda_core.system.bearing import Solver

if TYPE_CHECKING:
    from lambda_core.electric.live import Live


class NothingLeftError(UsageError):
    """A run that is to go on has come to its end."""


def run(
    engine: Engine,
    provenance: Provenance,
    path: Path,
    *,
    force: bool = False,
    report: Report | None = None,
    live: Live | None = None,
    watch: Watch | None = None,
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
        The electric circuit of the run.
    watch : Watch, optional
        Observers and events.

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
    beside = Beside(live, watch or Watch(provenance.model))
    channels = (*engine.channels, *beside.watch.channels)
    writer = ResultWriter.create(path, provenance, channels, Status(process=this_process()), force=force)
    return _begin(engine, provenance, writer, report, beside)


def _begin(
    engine: Engine, provenance: Provenance, writer: ResultWriter, report: Report | None, beside: Beside
) -> Result:
    start = row(engine.time, engine.integrals())
    writer.add_record(start, [start])
    return Session(engine, provenance.model, writer, [start], start, Position(0, Rows(), 0.0), report, beside).drive()


def resume(
    engine: Engine,
    provenance: Provenance,
    path: Path,
    *,
    report: Report | None = None,
    live: Live | None = None,
    watch: Watch | None = None,
) -> Result:
    """Continue a run that was killed, stopped or finished, from its last checkpoint.

    Parameters and errors as for :func:`run`; `engine` is new and its model's `solver` says
    when to end.

    Raises
    ------
    BeingWrittenError
        When the run is still going on.
    NothingLeftError
        When it has nothing left to do.
    UsageError
        When the disk has no room to go on.
    """
    result = Result(path)
    status = result.status()
    if status.alive():
        raise BeingWrittenError(path, status.process["pid"])
    hdf5.sweep(path.absolute().parent, glob.escape(path.name))
    checkpoint = result.checkpoint()
    beside = Beside(live, watch or Watch(provenance.model))
    channels = (*engine.channels, *beside.watch.channels)
    if checkpoint is None:  # killed before the first one: the beginning is as good
        writer = ResultWriter.continued(path, channels, Status(process=this_process()))
        return _begin(engine, provenance, writer, report, beside)
    position = checkpoint.position
    check_rows(path, position)
    engine.restore(checkpoint.state)
    records = result.integrals()[: position.rows.records]
    start, known = records[-1], list(result.revolutions()[: position.rows.revolutions])
    if status.state == "finished" and not _left_to_do(provenance.model.solver, engine.time, known, start):
        raise NothingLeftError(f"{path} is finished: nothing is left to do; a longer --duration continues it")
    status = replace(status, state="running", message="", rows=position.rows, process=this_process())
    beside.catch_up(result, position.rows)
    writer = ResultWriter.continued(path, channels, status)
    session = Session(engine, provenance.model, writer, known, start, position, report, beside)
    # Convergence is looked at where a revolution ends: a run that was killed right behind that has nothing left to do.
    if len(records) > 1 and known[-1][0] > records[-2][0]:
        session.judge()
    return session.drive()


def _left_to_do(solver: Solver, now: float, known: list[FloatArray], last: FloatArray) -> bool:
    if solver.duration > 0.0:
        return now < solver.duration
    return now < solver.max_duration and not is_converged(solver, known, last)
